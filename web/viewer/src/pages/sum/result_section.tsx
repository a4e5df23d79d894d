// What is known of the sum, and of the place that was picked.
import { short } from '../../numbers/display';
import { Readouts, Section } from '../../shell/controls';
import { ExactText } from '../../shell/exact_text';
import type { Shell } from '../../shell/page';
import type { SumData } from './use_sum';

/** A place of the sum, with its exact position. */
export interface Picked {
  origin: string;
  /** one for a vertex, two for an edge */
  positions: readonly { x: string; y: string }[];
}

export function positionText({ x, y }: { x: string; y: string }): string {
  return `(${x}, ${y})`;
}

export function PickedSection({ picked, shell }: { picked: Picked | undefined; shell: Shell }) {
  return (
    <Section title="Picked">
      {!picked && <span style={{ color: 'var(--quiet)' }}>Click a vertex or an edge of the sum for its exact position.</span>}
      {picked && <p style={{ margin: '0 0 6px' }}>{picked.origin}</p>}
      {picked?.positions.map((at, k) => (
        <ExactText key={k} label="the exact position" text={positionText(at)} shell={shell} />
      ))}
    </Section>
  );
}

export function ResultSection({ data, shell }: { data: SumData; shell: Shell }) {
  const refused = data.p.error ?? data.q.error;
  const counts = refused ? undefined : data.sum?.counts, area = refused ? undefined : data.area;
  return (
    <Section title="Sum">
      <Readouts
        rows={[
          ['parts', counts?.parts],
          ['holes', counts?.holes],
          ['vertices', counts?.vertices],
          ['tight points, segments', counts && `${counts.tightPoints}, ${counts.tightSegments}`],
          ['computed in', refused || data.ms === undefined ? undefined : `${data.ms.toFixed(1)} ms`],
          ['area', area ? short(Number(area.decimal)) : refused ? undefined : '…'],
        ]}
      />
      {area?.exact && <ExactText label="the exact area" text={area.exact} shell={shell} />}
    </Section>
  );
}
