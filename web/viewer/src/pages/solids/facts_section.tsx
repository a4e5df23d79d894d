// Numbers of the sum, of its section, and of how deep Q is in P.
import { useEffect, useState } from 'preact/hooks';
import { short } from '../../numbers/display';
import { Readouts, Section, Slider, Toggle } from '../../shell/controls';
import { ExactText } from '../../shell/exact_text';
import type { Change, Shell } from '../../shell/page';
import { Results } from '../../shell/results';
import type { SolidDepthAnswer } from './depth';
import { contactOf, contactText, kindText, touchingText } from './faces';
import { kFaceColours } from './pictures';
import type { SolidFrame } from './service';
import type { SolidsState } from './state';
import type { SolidsData } from './use_solids';

interface FactsProps {
  state: SolidsState;
  change: Change<SolidsState>;
  data: SolidsData;
  shell: Shell;
}

const kLegend = ['a face of P, a vertex of Q (fv)', 'a vertex of P, a face of Q (fv)', 'an edge of each (ee)', 'changed since the last frame'] as const;

export function SumSection({ state, data, shell }: FactsProps) {
  const { frame, numbers } = data;
  const isFit = state.sum === 'fit', tight = frame && [frame.tightTriangles.length > 0 && 'faces', frame.tightSegments.length > 0 && 'segments', frame.tightPoints.length > 0 && 'points'].filter(Boolean).join(', ');
  return (
    <Section title={isFit ? 'Inner fit' : 'Sum'}>
      <Results {...data.standing} refused={data.refused}>
        <Readouts
          rows={[
            ...(isFit ? [['Q', frame && fitText(frame, tight !== '', state)] as const] : []),
            ['Vertices, faces', frame && `${frame.vertexCount}, ${frame.faceCount}`],
            ['Changed', frame && `${frame.changed} faces`],
            ['Tight', frame && (tight === '' ? 'nothing' : tight)],
            ['Volume', numbers && short(numbers.volume)],
            ['Updated in', frame && `${short(Math.round(10 * frame.ms) / 10)} ms${frame.convex ? ', convex' : ''}`],
          ]}
        />
        {numbers?.volumeExact && <ExactText label="the exact volume" text={numbers.volumeExact} shell={shell} />}
      </Results>
    </Section>
  );
}

/** What the colours say, and how the sum is drawn. */
export function LookSection({ state, change }: Pick<FactsProps, 'state' | 'change'>) {
  return (
    <Section title="Show">
      <div class="legend">
        {kLegend.map((text, k) => (
          <div key={text}>
            <span style={{ color: `var(${kFaceColours[k]!})` }}>■</span> {text}
          </div>
        ))}
      </div>
      <Toggle label="Colour what changes" hint="Marks the faces that are new, or others, since the frame before." value={state.changes} onChange={(changes) => change({ ...state, changes })} />
      <Toggle label="See through" hint="Draws the sum half transparent." value={state.through} onChange={(through) => change({ ...state, through })} />
    </Section>
  );
}

function fitText({ triangles }: SolidFrame, isTight: boolean, { semantics }: SolidsState): string {
  if (triangles.length > 0) return 'fits in P';
  if (isTight) return 'fits in P without room to move';
  return semantics === 'regular' ? 'fits nowhere in P with room to move' : 'fits nowhere in P';
}

export function DepthSection({ state, data, shell }: FactsProps) {
  if (state.sum !== 'hits') return null;
  const { depth } = data, known = depth && !('unknown' in depth) ? depth : undefined, inside = known?.inside ? known : undefined;
  return (
    <Section title="Depth of Q in P">
      <Results {...data.depthStanding} refused={data.refused}>
        <Readouts
          rows={[
            ['Q', depth && !known ? 'not known exactly' : known && meetingText(known)],
            ['Way out', inside && `${inside.direction.map(short).join(', ')}${(inside.ways ?? 1) > 1 ? `: one of ${inside.ways}` : ''}`],
            ['Touches then', inside && touchingText(inside.contacts)],
          ]}
        />
        {depth && 'unknown' in depth && <p class="quiet">{depth.unknown}</p>}
        {inside && <p class="quiet">The square of the depth, exactly:</p>}
        {inside && <ExactText label="the square of the depth" text={inside.squared} shell={shell} />}
      </Results>
    </Section>
  );
}

function meetingText({ inside, depth, within }: SolidDepthAnswer): string {
  if (inside) return `overlaps P, depth ${short(depth)}`;
  return within === 0 ? 'does not overlap P' : `does not overlap P, to within ${Number(within.toPrecision(1))}`;
}

/** Low and high z of the frame. */
function heights({ vertices }: SolidFrame): [number, number] {
  let low = Infinity, high = -Infinity;
  for (let k = 2; k < vertices.length; k += 3) {
    low = Math.min(low, vertices[k]!);
    high = Math.max(high, vertices[k]!);
  }
  return low < high && Number.isFinite(high - low) ? [low, high] : [-1, 1];
}

export function SliceSection({ state, change, data, shell }: FactsProps) {
  const { frame, section } = data, { slice } = state;
  const [low, high] = frame ? heights(frame) : [-1, 1], step = 2 ** Math.floor(Math.log2((high - low) / 200));
  const middle = Math.round((low + high) / 2 / step) * step;
  return (
    <Section title="Slice">
      <Toggle label="Cut the sum at a height" hint="Leaves out what lies above z, and shows the section there." value={slice !== null} onChange={(on) => change({ ...state, slice: on ? middle : null })} />
      {slice !== null && (
        <>
          <Slider
            label="z" value={slice} min={Math.floor(low / step) * step} max={Math.ceil(high / step) * step} step={step} text={short(slice)}
            onInput={(z) => change({ ...state, slice: z }, 'live')} onDone={(z) => change({ ...state, slice: z })}
          />
          <Readouts rows={[['Area of the section', section ? short(section.area) : undefined]]} />
          {section?.exact && <ExactText label="the exact area" text={section.exact} shell={shell} />}
          {state.sum === 'fit' && <p class="quiet">The exact section is that of sums only.</p>}
          {state.sum !== 'fit' && (state.angle !== 0 || section === null) && <p class="quiet">The exact section is there while nothing is turned and scaled coordinates are doubles.</p>}
        </>
      )}
    </Section>
  );
}

const kMostCorners = 12;

/** The face that was chosen: what makes it, and where its corners are. */
export function FaceSection({ data, shell, face }: FactsProps & { face: number | undefined }) {
  const { frame, args } = data, [exact, setExact] = useState<string[] | undefined>();
  useEffect(() => {
    setExact(undefined);
    if (!frame || face === undefined) return;
    const corners = [...new Set([...frame.faceOf.keys()].filter((t) => frame.faceOf[t] === face).flatMap((t) => [...frame.triangles.subarray(3 * t, 3 * t + 3)]))];
    shell.engine.ask('solidExact', { args, vertices: corners.slice(0, kMostCorners) }).then(setExact, shell.report);
  }, [frame, face]); // eslint-disable-line react-hooks/exhaustive-deps -- the frame is that of the arguments
  if (!frame || face === undefined) return null;
  const contact = contactOf(frame.contacts, face);
  return (
    <Section title="Chosen face">
      <p class="quiet">
        {kindText(contact)}: {contactText(contact)}
      </p>
      {exact?.map((text, k) => <ExactText key={k} label={`corner ${k}`} text={text} shell={shell} />)}
    </Section>
  );
}
