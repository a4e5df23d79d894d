import { useEffect, useMemo } from 'preact/hooks';
import { together, useAnswer, type Standing } from '../../engine/use_answer';
import { short, shortText } from '../../numbers/display';
import { OperandCard } from '../../operands/operand_card';
import { useOperand, type Operand } from '../../operands/use_operand';
import { Choice, Readouts, Section } from '../../shell/controls';
import { ExactText } from '../../shell/exact_text';
import type { PageProps, Shell } from '../../shell/page';
import { Panel, Stage } from '../../shell/parts';
import { Results } from '../../shell/results';
import { useReport } from '../../shell/use_report';
import { appliedToBox, inverted, placed as placing } from '../../view2d/affine';
import { unionOf, type Point } from '../../view2d/camera';
import { isInside } from '../../view2d/edge_grid';
import type { Grip } from '../../view2d/gestures';
import { PlaneView } from '../../view2d/plane_view';
import { SumPicture } from '../../view2d/sum_shape';
import { kSemantics } from '../options';
import { originText } from '../sum/provenance';
import { paintNesting } from './picture';
import type { Pair, Placed } from './service';
import { placementNear } from './snapping';
import { kFree, type NestingState, type Placement } from './state';
import { useOpened } from './use_opened';

export const kSummary = 'The no-fit polygon: where B’s reference point may stand so that A and B meet. Drag B; it snaps to exact fits.';

function meetingText({ meeting, distance }: Placed): string {
  if (meeting === 'touching') return 'A and B touch, exactly.';
  return meeting === 'apart' ? `A and B are apart by ${short(distance)}.` : `A and B overlap: ${short(distance)} deep.`;
}

function useNesting(shell: Shell, state: NestingState) {
  const a = useOperand(shell, state.a), b = useOperand(shell, state.b), ready = a.ready && b.ready;
  const pair = { a: state.a, b: state.b, semantics: state.semantics };
  const nfp = useAnswer(shell.engine, 'nfp', ready ? pair : undefined);
  const place = useAnswer(shell.engine, 'placed', ready ? { ...pair, at: state.at } : undefined);
  const isOfBoth = (of: Pair | undefined): boolean => ready && of?.a === state.a && of.b === state.b;
  const picture = useMemo(() => nfp.value && new SumPicture(nfp.value.shape), [nfp.value]);
  useReport(shell, nfp.error ?? place.error);
  return { a, b, nfp: isOfBoth(nfp.of) ? picture : undefined, placed: isOfBoth(place.of) ? place.value : undefined, placedAt: place.of?.at,
    sum: nfp as Standing, place: together(nfp, place),
    /** the shapes that all of it is of */
    of: nfp.of && place.of?.a === nfp.of.a && place.of.b === nfp.of.b ? nfp.of : undefined };
}

function wrongPlaces(a: Operand, b: Operand): Point[] {
  return [a.error, b.error].flatMap((e) => (e?.evidence.x !== undefined && e.evidence.y !== undefined ? [{ x: e.evidence.x, y: e.evidence.y }] : []));
}

function PlaceSection({ state, change, shell, placed, nfp, standing, refused }: PageProps<NestingState> & { placed: Placed | undefined; nfp: SumPicture | undefined; standing: Standing; refused: boolean }) {
  const { at } = state, free = at.kind === 'free' && placed?.meeting !== 'touching';
  const contact = nfp && (at.kind === 'vertex' || at.kind === 'edge') ? originText(nfp.shape, at, { names: ['A', 'B'], between: 'and' }) : undefined;
  return (
    <Section title="B stands">
      <Results {...standing} refused={refused}>
        <p role="status" style={{ margin: '0 0 6px', fontWeight: 600 }}>{placed ? meetingText(placed) : standing.error === undefined && !refused ? '…' : ''}</p>
        {contact && <p style={{ margin: '0 0 6px' }}>Contact: {contact}</p>}
        {placed && <ExactText label="the exact position" text={`(${placed.x}, ${placed.y})`} shell={shell} />}
        {placed && placed.meeting !== 'touching' && (
          <>
            <Readouts rows={[['distance squared', shortText(placed.squared)]]} />
            <ExactText label="the square of the distance" text={placed.squared} shell={shell} />
          </>
        )}
      </Results>
      <div class="row">
        <button disabled={!free} onClick={() => at.kind === 'free' && change({ ...state, at: { ...at, kind: 'nearest' } })}>
          To the nearest fit
        </button>
      </div>
    </Section>
  );
}

/** Where B stands, by itself: the vertices of another no-fit polygon are others. */
function freeAt(placed: Placed | undefined): Placement {
  return { kind: 'free', x: placed?.approx.x ?? 0, y: placed?.approx.y ?? 0 };
}

const kFiles = { svg: 'Picture (SVG)', wkt: 'No-fit polygon, rounded (WKT)', json: 'No-fit polygon, exact (JSON)' } as const;

function useDownloads({ engine, setDownloads }: Shell, { a, b, semantics }: NestingState, isThere: boolean): void {
  useEffect(() => {
    const formats = isThere ? (Object.keys(kFiles) as (keyof typeof kFiles)[]) : [];
    setDownloads(formats.map((format) => ({ label: kFiles[format], fileName: `nfp.${format}`, make: () => engine.ask('nfpFile', { a, b, semantics, format }) })));
  }, [engine, setDownloads, a, b, semantics, isThere]);
}

export function View(props: PageProps<NestingState>) {
  const { state, change, shell } = props, data = useNesting(shell, state), { a, b, nfp, placed } = data;
  const refusedFile = useOpened(props);
  useDownloads(shell, state, nfp !== undefined);
  const byB = placing(1, 0, placed?.approx.x ?? 0, placed?.approx.y ?? 0);
  const failed = a.error ?? b.error;
  const homeKey = failed ? `${a.of?.name} ${b.of?.name}` : data.of ? `${data.of.a.name} ${data.of.b.name}` : '';
  const home = useMemo(
    () => (homeKey ? unionOf([a.outline?.box, appliedToBox(byB, b.outline?.box), nfp?.box]) : undefined),
    [homeKey], // eslint-disable-line react-hooks/exhaustive-deps -- of the picture as it is then
  );
  const put = (at: Placement, how: 'live' | 'done'): void => change({ ...state, at }, how);
  const grip = (at: Point, reach: number): Grip | undefined => {
    const own = inverted(byB, at), start = placed?.approx;
    if (!b.outline || !start || (!isInside(b.outline.rings, own) && !b.outline.grid.nearest(own, reach))) return undefined;
    const to = (from: Point, now: Point): Placement => placementNear(nfp, { x: start.x + now.x - from.x, y: start.y + now.y - from.y }, reach * 1.25);
    return { drag: (from, now) => put(to(from, now), 'live'), drop: (from, now) => put(now ? to(from, now) : state.at, 'done') };
  };
  const nudge = (by: Point): void => {
    if (placed) put(placementNear(nfp, { x: placed.approx.x + by.x, y: placed.approx.y + by.y }, Math.hypot(by.x, by.y) / 2), 'done');
  };
  // B is drawn where the engine says it stands, so contacts are of that placement, too.
  const scene = { a: a.outline, b: b.outline, nfp, at: data.placedAt ?? state.at, placed, wrong: wrongPlaces(a, b) };
  return (
    <>
      <Stage>
        <PlaneView
          label={`The no-fit polygon of ${state.b.name} around ${state.a.name}. ${placed ? meetingText(placed) : ''}`} home={home} homeKey={homeKey}
          camera={state.camera} onCamera={(camera) => change({ ...state, camera }, 'aside')} grip={grip} nudge={nudge} shows={nfp && placed} stale={data.sum.waiting} paint={(painter) => paintNesting(painter, scene)}
        />
        <div class="status">{placed && meetingText(placed)}</div>
      </Stage>
      <Panel summary={kSummary}>
        <Section title="Shapes">
          <OperandCard shell={shell} role="A" tint="p" shape={state.a} operand={a} choices={state.parts} onShape={(shape) => change({ ...state, a: shape, at: kFree })} />
          <OperandCard shell={shell} role="B" tint="q" shape={state.b} operand={b} choices={state.parts} onShape={(shape) => change({ ...state, b: shape, at: kFree })} />
          {refusedFile && (
            <>
              <p class="refused">{refusedFile.file.name} is not opened: {refusedFile.reason}</p>
              <div class="row">
                <button onClick={refusedFile.repair}>Repair and nest the shapes of {refusedFile.file.name}</button>
              </div>
            </>
          )}
        </Section>
        <PlaceSection {...props} placed={placed} nfp={nfp} standing={data.place} refused={failed !== undefined} />
        <Section title="No-fit polygon">
          <Choice label="What touching counts" options={kSemantics} value={state.semantics} onChange={(semantics) => change({ ...state, semantics, at: freeAt(placed) })} />
          <Results {...data.sum} refused={failed !== undefined}>
            <Readouts
              rows={[['parts', nfp?.counts.parts], ['holes', nfp?.counts.holes], ['vertices', nfp?.counts.vertices], ['exact fits: points, segments', nfp && `${nfp.counts.tightPoints}, ${nfp.counts.tightSegments}`]]}
            />
          </Results>
        </Section>
      </Panel>
    </>
  );
}
