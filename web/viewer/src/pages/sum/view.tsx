import { useEffect, useMemo, useState } from 'preact/hooks';
import { EngineError } from '../../engine/client';
import type { Shape } from '../../engine/shape';
import { OperandCard } from '../../operands/operand_card';
import { Choice, Section } from '../../shell/controls';
import type { Download, PageProps, Shell } from '../../shell/page';
import { Panel, Stage } from '../../shell/parts';
import { applied, appliedToBox, inverted, type Affine } from '../../view2d/affine';
import { unionOf, type Box, type Point } from '../../view2d/camera';
import { PlaneView } from '../../view2d/plane_view';
import { NestingOffer } from '../nesting/offer';
import { kSemantics } from '../options';
import { AloneView } from './alone_view';
import { gripOf } from './dragging';
import { LayersSection } from './layers_section';
import { MotionSection } from './motion_section';
import { paintSum, type SumScene } from './picture';
import { placing, sumPlacing } from './placing';
import { originText } from './provenance';
import { DepthSection, kSetNames, PickedSection, ResultSection, wordingOf } from './result_section';
import type { SumArgs, SumFormat } from './service';
import { isPair, kShown, withShown, type Shown, type SumPageState, type SumState } from './state';
import { draggedState, toolsOf, type Tool } from './tools';
import { lifeText, type Alive } from './living';
import { useEvents } from './use_events';
import { useLiving } from './use_living';
import { usePointing, type Pointing } from './use_pointing';
import { useSum, type Pull, type SumData } from './use_sum';

export const kSummary = 'P ⊕ Q: every point of P added to every point of Q, exactly. Drag a shape; hover over the sum to see which pair made it.';
const kSummaries: Record<Shown, string> = {
  sum: kSummary,
  hits: 'P ⊕ −Q: the places of Q at which it hits P, exactly. Drag Q; hover over the boundary to see what touches there.',
  fit: '{ x : x + Q ⊂ P }: the places of Q at which it lies inside P, exactly. Drag Q; hover over the boundary to see what touches there.',
};

const kFiles = { wkt: 'rounded (WKT)', json: 'exact (JSON)', geojson: 'rounded (GeoJSON)', poly: 'rounded (.poly)' } as const satisfies Partial<Record<SumFormat, string>>;

function useDownloads({ engine, setDownloads }: Shell, args: SumArgs, isThere: boolean): void {
  useEffect(() => {
    const name = args.shown === 'fit' ? 'Inner fit' : 'Sum';
    const download = (format: SumFormat, label: string): Download => ({
      label, fileName: `${name.toLowerCase().replace(' ', '_')}.${format}`, make: () => engine.ask('sumFile', { ...args, format }),
    });
    const files = Object.entries(kFiles).map(([format, text]) => download(format as SumFormat, `${name}, ${text}`));
    setDownloads(isThere ? [download('svg', 'Picture (SVG)'), ...files] : []);
  }, [engine, setDownloads, args, isThere]);
}

/** Where errors are, in the picture. */
function wrongPlaces(data: SumData, byP: Affine, byQ: Affine): Point[] {
  const of = (error: unknown, by: Affine): Point[] => {
    const { x, y } = error instanceof EngineError ? error.evidence : {};
    return x !== undefined && y !== undefined ? [applied(by, { x, y })] : [];
  };
  const pulled = data.args.pull ? of(data.error, data.args.pull.which === 'p' ? byP : byQ) : [];
  return [...of(data.p.error, byP), ...of(data.q.error, byQ), ...pulled];
}

/** Operands are drawn as they were when the sum that is shown was computed. */
function sceneOf(state: SumState, data: SumData, pull: Pull | undefined, { chosen, hovered }: Pointing, alive: Alive): SumScene {
  const { moving, motion, scale, tanHalf } = data.of ?? state, shown = { ...state, moving, motion, scale, tanHalf };
  const byP = placing(shown, 'p'), byQ = placing(shown, 'q'), p = data.p.outline, q = data.q.outline, [way] = data.depth?.ways ?? [];
  return {
    layers: state.layers, byP, byQ, bySum: sumPlacing(state), trace: data.trace, look: state.look,
    p: pull?.which === 'p' ? p?.withVertex(pull.vertex, pull) : p,
    q: pull?.which === 'q' ? q?.withVertex(pull.vertex, pull) : q,
    sum: data.p.error ?? data.q.error ? undefined : data.sum,
    way: way && { from: { x: state.atQ[0], y: state.atQ[1] }, by: way.approx },
    marked: [chosen, hovered].filter((place) => place !== undefined), alive,
    pulled: pull && applied(pull.which === 'p' ? byP : byQ, pull),
    wrong: wrongPlaces(data, byP, byQ),
  };
}

/** The same for a shape of which a vertex was pulled. */
const withoutEdits = (shape: Shape | undefined): string => shape?.name.replace(/\*?(\.\w+)?$/, '') ?? '';

/** What fits into the picture, and a name of it that changes when it is to be fitted again: with the shapes, but not while they are dragged. */
function useHome({ look }: SumState, scene: SumScene, { sum, of, p, q }: SumData): { home: Box | undefined; homeKey: string } {
  const failed = p.error ?? q.error, isKnown = failed ? p.of && q.of : sum && of;
  const homeKey = isKnown ? `${withoutEdits(failed ? p.of : of?.p)} ${withoutEdits(failed ? q.of : of?.q)} ${of?.shown} ${look?.join() ?? ''}` : '';
  const home = useMemo(() => {
    if (look) return { x0: look[0], y0: look[1], x1: look[2], y1: look[3] };
    return homeKey ? unionOf([appliedToBox(scene.byP, scene.p?.box), appliedToBox(scene.byQ, scene.q?.box), appliedToBox(scene.bySum, scene.sum?.box)]) : undefined;
  }, [homeKey]); // eslint-disable-line react-hooks/exhaustive-deps -- of the scene as it is then
  return { home, homeKey };
}

function SetSection({ state, change }: Pick<PageProps<SumState>, 'state' | 'change'>) {
  const showAll = (): void => {
    const everywhere = { ...state };
    delete everywhere.look;
    delete everywhere.camera;
    change(everywhere);
  };
  return (
    <Section title="What is computed">
      <Choice label="What is computed" options={kShown} value={state.shown} onChange={(shown) => change(withShown(state, shown))} />
      <Choice label="What touching counts" options={kSemantics} value={state.semantics} onChange={(semantics) => change({ ...state, semantics })} />
      {state.look && (
        <div class="row">
          <button onClick={showAll}>Show all, not only the part</button>
        </div>
      )}
    </Section>
  );
}

function PairView({ state, change, shell }: PageProps<SumState> & { change: PageProps<SumPageState>['change'] }) {
  const [tool, setTool] = useState<Tool>('move');
  const [pull, setPull] = useState<Pull | undefined>();
  const data = useSum(shell, state, pull), { sum } = data;
  const pointing = usePointing(shell, state, data.args, sum), events = useEvents(shell, data.args), living = useLiving(shell, data, events.found?.lives);
  useDownloads(shell, data.args, sum !== undefined && !data.p.error && !data.q.error);
  const scene = sceneOf(state, data, pull, pointing, living.alive), wording = wordingOf(state), tools = toolsOf(state);
  const nearest = (at: Point, reach: number) => sum?.nearest(inverted(scene.bySum, at), reach);
  const context = { shell, state, change, outlines: { p: data.p.outline, q: data.q.outline }, tool: tools.some(([t]) => t === tool) ? tool : 'move', setPull };
  return (
    <>
      <Stage>
        <PlaneView
          label={`${kSetNames[state.shown]}, of ${state.p.name} and ${state.q.name}: ${sum ? `${sum.counts.vertices} vertices, ${sum.counts.holes} holes` : 'not known yet'}`}
          {...useHome(state, scene, data)} camera={state.look ? undefined : state.camera}
          onCamera={(camera) => change({ ...state, camera }, 'aside')} cursor={pointing.hovered ? 'pointer' : 'grab'}
          nudge={(by) => change(draggedState('move', state, state.moving, { x: 0, y: 0 }, by, Math.hypot(by.x, by.y) / 4))}
          grip={(at, reach) => gripOf(context, at, reach)} hover={(at, reach) => pointing.hover(at && nearest(at, reach))}
          click={(at, reach) => pointing.pick(nearest(at, reach))} shows={scene.sum} stale={data.standing.waiting} paint={(painter) => paintSum(painter, scene)}
        />
        <div class="status">{pointing.hovered && sum ? originText(sum.shape, pointing.hovered, wording) : living.hovered ? lifeText(living.hovered, wording) : ''}</div>
      </Stage>
      <Panel summary={kSummaries[state.shown]}>
        <Section title="Shapes">
          <OperandCard shell={shell} role="P" tint="p" shape={state.p} operand={data.p} onShape={(p) => change({ ...state, p })} />
          <NestingOffer shape={state.p} error={data.p.error} shell={shell} />
          <OperandCard shell={shell} role="Q" tint="q" shape={state.q} operand={data.q} onShape={(q) => change({ ...state, q })} onNone={() => change({ ...state, q: null })} />
          <NestingOffer shape={state.q} error={data.q.error} shell={shell} />
          <Choice label="What dragging a shape does" options={tools} value={context.tool} onChange={setTool} />
        </Section>
        <SetSection state={state} change={change} />
        <ResultSection data={data} shell={shell} />
        <MotionSection state={state} change={change} shell={shell} events={events} living={living} />
        <DepthSection depth={data.depth} shell={shell} />
        <PickedSection picked={pointing.picked} shell={shell} />
        <LayersSection state={state} change={change} />
      </Panel>
    </>
  );
}

export function View({ state, ...props }: PageProps<SumPageState>) {
  return isPair(state) ? <PairView {...props} state={state} /> : <AloneView {...props} state={state} />;
}
