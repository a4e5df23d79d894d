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
import { gripOf } from './dragging';
import { LayersSection } from './layers_section';
import { MotionSection } from './motion_section';
import { paintSum, type SumScene } from './picture';
import { placing, sumPlacing } from './placing';
import { originText } from './provenance';
import { PickedSection, ResultSection } from './result_section';
import type { SumArgs } from './service';
import type { SumState } from './state';
import { draggedState, kTools, type Tool } from './tools';
import { usePointing, type Pointing } from './use_pointing';
import { useSum, type Pull, type SumData } from './use_sum';

export const kSummary = 'P ⊕ Q: every point of P added to every point of Q, exactly. Drag a shape; hover over the sum to see which pair made it.';

const kFiles = {
  svg: 'Picture (SVG)', wkt: 'Sum, rounded (WKT)', json: 'Sum, exact (JSON)', geojson: 'Sum, rounded (GeoJSON)', poly: 'Sum, rounded (.poly)',
} as const;

function useDownloads({ engine, setDownloads }: Shell, args: SumArgs, isThere: boolean): void {
  useEffect(() => {
    const download = (format: keyof typeof kFiles): Download => ({
      label: kFiles[format], fileName: `sum.${format}`, make: () => engine.ask('sumFile', { ...args, format }),
    });
    setDownloads(isThere ? (Object.keys(kFiles) as (keyof typeof kFiles)[]).map(download) : []);
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
function sceneOf(state: SumState, data: SumData, pull: Pull | undefined, { chosen, hovered }: Pointing): SumScene {
  const { moving, motion, scale, tanHalf } = data.of ?? state, shown = { ...state, moving, motion, scale, tanHalf };
  const byP = placing(shown, 'p'), byQ = placing(shown, 'q'), p = data.p.outline, q = data.q.outline;
  return {
    layers: state.layers, byP, byQ, bySum: sumPlacing(state), trace: data.trace,
    p: pull?.which === 'p' ? p?.withVertex(pull.vertex, pull) : p,
    q: pull?.which === 'q' ? q?.withVertex(pull.vertex, pull) : q,
    sum: data.p.error ?? data.q.error ? undefined : data.sum,
    marked: [chosen, hovered].filter((place) => place !== undefined),
    pulled: pull && applied(pull.which === 'p' ? byP : byQ, pull),
    wrong: wrongPlaces(data, byP, byQ),
  };
}

/** The same for a shape of which a vertex was pulled. */
const withoutEdits = (shape: Shape | undefined): string => shape?.name.replace(/\*?(\.\w+)?$/, '') ?? '';

/** What fits into the picture, and a name of it that changes when it is to be fitted again: with the shapes, but not while they are dragged. */
function useHome(scene: SumScene, { sum, of, p, q }: SumData): { home: Box | undefined; homeKey: string } {
  const failed = p.error ?? q.error, isKnown = failed ? p.of && q.of : sum && of;
  const homeKey = isKnown ? `${withoutEdits(failed ? p.of : of?.p)} ${withoutEdits(failed ? q.of : of?.q)}` : '';
  const home = useMemo(
    () => (homeKey ? unionOf([appliedToBox(scene.byP, scene.p?.box), appliedToBox(scene.byQ, scene.q?.box), appliedToBox(scene.bySum, scene.sum?.box)]) : undefined),
    [homeKey], // eslint-disable-line react-hooks/exhaustive-deps -- of the scene as it is then
  );
  return { home, homeKey };
}

export function View({ state, change, shell }: PageProps<SumState>) {
  const [tool, setTool] = useState<Tool>('move');
  const [pull, setPull] = useState<Pull | undefined>();
  const data = useSum(shell, state, pull), { sum } = data;
  const pointing = usePointing(shell, state, data.args, sum);
  useDownloads(shell, data.args, sum !== undefined && !data.p.error && !data.q.error);
  const scene = sceneOf(state, data, pull, pointing);
  const nearest = (at: Point, reach: number) => sum?.nearest(inverted(scene.bySum, at), reach);
  const context = { shell, state, change, outlines: { p: data.p.outline, q: data.q.outline }, tool, setPull };
  return (
    <>
      <Stage>
        <PlaneView
          label={`The sum of ${state.p.name} and ${state.q.name}: ${sum ? `${sum.counts.vertices} vertices, ${sum.counts.holes} holes` : 'not known yet'}`}
          {...useHome(scene, data)} camera={state.camera}
          onCamera={(camera) => change({ ...state, camera }, 'aside')} cursor={pointing.hovered ? 'pointer' : 'grab'}
          nudge={(by) => change(draggedState('move', state, state.moving, { x: 0, y: 0 }, by, Math.hypot(by.x, by.y) / 4))}
          grip={(at, reach) => gripOf(context, at, reach)} hover={(at, reach) => pointing.hover(at && nearest(at, reach))}
          click={(at, reach) => pointing.pick(nearest(at, reach))} shows={scene.sum} paint={(painter) => paintSum(painter, scene)}
        />
        <div class="status">{pointing.hovered && sum ? originText(sum.shape, pointing.hovered) : ''}</div>
      </Stage>
      <Panel summary={kSummary}>
        <Section title="Shapes">
          <OperandCard shell={shell} role="P" tint="p" shape={state.p} operand={data.p} onShape={(p) => change({ ...state, p })} />
          <OperandCard shell={shell} role="Q" tint="q" shape={state.q} operand={data.q} onShape={(q) => change({ ...state, q })} />
          <Choice label="What dragging a shape does" options={kTools} value={tool} onChange={setTool} />
        </Section>
        <MotionSection state={state} change={change} shell={shell} args={data.args} />
        <ResultSection data={data} shell={shell} />
        <PickedSection picked={pointing.picked} shell={shell} />
        <LayersSection state={state} change={change} />
      </Panel>
    </>
  );
}
