// What is known of the sum, and of the place that was picked.
import type { PlanarDistance } from 'dymsum';
import { short, shortText } from '../../numbers/display';
import { Readouts, Section } from '../../shell/controls';
import { ExactText } from '../../shell/exact_text';
import type { Shell } from '../../shell/page';
import { Results } from '../../shell/results';
import type { Wording } from './provenance';
import type { SumArgs } from './service';
import type { Shown } from './state';
import type { SumData } from './use_sum';

/** What is shown is the set of ... */
export const kSetNames: Record<Shown, string> = { sum: 'Sum', hits: 'Places of Q that hit P', fit: 'Places of Q inside P' };

/** Places of Q are vertices of P less vertices of Q. */
export function wordingOf({ shown }: Pick<SumArgs, 'shown'>): Wording {
  return { names: ['P', 'Q'], between: shown === 'sum' ? '+' : '−' };
}

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
  const refused = data.p.error ?? data.q.error, { error } = data.standing;
  const counts = refused ? undefined : data.sum?.counts, area = refused ? undefined : data.area;
  return (
    <Section title={kSetNames[data.args.shown]}>
      <Results {...data.standing} refused={refused !== undefined}>
        <Readouts
          rows={[
            ['parts', counts?.parts],
            ['holes', counts?.holes],
            ['vertices', counts?.vertices],
            ['tight points, segments', counts && `${counts.tightPoints}, ${counts.tightSegments}`],
            ['computed in', refused || data.ms === undefined ? undefined : `${data.ms.toFixed(1)} ms`],
            ['area', area ? shortText(area.decimal) : refused ?? error ? undefined : '…'],
          ]}
        />
        {area?.exact && <ExactText label="the exact area" text={area.exact} shell={shell} />}
      </Results>
    </Section>
  );
}

const kMeetings = { overlapping: 'overlaps P, depth ', touching: 'touches P', apart: 'is apart from P by ' } as const;

/** How Q stands to P where it is: the shortest way out, or to it. */
export function DepthSection({ depth, shell }: { depth: PlanarDistance | undefined; shell: Shell }) {
  if (!depth) return null;
  const { meeting, distance, squared, ways } = depth, [way] = ways;
  return (
    <Section title="Q where it stands">
      <Readouts rows={[['Q', kMeetings[meeting] + (meeting === 'touching' ? '' : short(distance))], ['shortest move', way && meeting !== 'touching' ? `${short(way.approx.x)}, ${short(way.approx.y)}` : undefined]]} />
      {meeting !== 'touching' && <ExactText label="the square of the distance" text={squared} shell={shell} />}
    </Section>
  );
}
