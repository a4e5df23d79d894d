import { useEffect, useMemo } from 'preact/hooks';
import { short } from '../../numbers/display';
import { OperandCard } from '../../operands/operand_card';
import { Readouts, Section, Slider, Toggle } from '../../shell/controls';
import { ExactText } from '../../shell/exact_text';
import type { PageProps, Shell } from '../../shell/page';
import { Panel, Stage } from '../../shell/parts';
import type { Point } from '../../view2d/camera';
import { PlaneView } from '../../view2d/plane_view';
import { AlphaSection, alphaOf } from './alpha_section';
import { Barcode, reachOf, significanceOf } from './barcode';
import { paintDiscs, type DiscScene } from './picture';
import { discState, type DiscState } from './state';
import { useDiscs, type DiscData } from './use_discs';

export const kSummary = 'A disc grows around a shape. It sees pockets and gaps, from their birth to their death; long bars are worth a cut.';

const kFiles = { svg: 'Picture (SVG)', json: 'Set with true arcs (JSON)', wkt: 'Polygons (WKT)' } as const;

function useDownloads({ engine, setDownloads }: Shell, { shape, operation, alpha, event }: DiscState, isThere: boolean): void {
  useEffect(() => {
    const formats = isThere ? (Object.keys(kFiles) as (keyof typeof kFiles)[]) : [];
    setDownloads(formats.map((format) => ({
      label: kFiles[format], fileName: `disc.${format}`, make: () => engine.ask('discFile', { shape, operation, alpha, event, format }),
    })));
  }, [engine, setDownloads, shape, operation, alpha, event, isThere]);
}

function sceneOf({ bar }: DiscState, data: DiscData): DiscScene {
  const chosen = data.bars.find(([k]) => k === bar)?.[1], { error, outline } = data.operand, { x, y } = error?.evidence ?? {};
  const wrong: Point[] = x !== undefined && y !== undefined ? [{ x, y }] : [];
  const marked = [chosen?.vertex, chosen?.minimum].filter((k): k is number => typeof k === 'number');
  return { outline, set: error ? undefined : data.answer?.set, bridges: data.bridges, cuts: data.cuts, marked, wrong };
}

function BarsSection({ state, change, shell, data }: PageProps<DiscState> & { data: DiscData }) {
  const { bars, barCount, texts, cuts } = data, reach = reachOf(bars), persistence = Number(state.persistence), most = Math.max(0, ...bars.map(([, b]) => significanceOf(b)).filter(Number.isFinite)) * 1.05 || reach;
  const chosen = bars.find(([k]) => k === state.bar)?.[1];
  const to = (value: number, how: 'live' | 'done'): void => change({ ...state, cuts: true, persistence: String(value) }, how);
  return (
    <Section title={`Barcode: ${bars.length < barCount ? `the longest ${bars.length} of ` : ''}${barCount} bars`}>
      <Barcode bars={bars} alpha={alphaOf(state)} persistence={state.cuts ? persistence : undefined} chosen={state.bar} onChoose={(bar) => change({ ...state, bar })} />
      {chosen && texts && (
        <>
          <p style={{ margin: '6px 0' }}>{`Born ${chosen.born === 'corner' ? `at the corner of vertex ${chosen.vertex}` : 'in a neck'}, ${chosen.died === 'never' ? 'never dies' : `${chosen.died} at ${short(chosen.deathAlpha)}`}.`}</p>
          <ExactText label="the exact birth" text={`birth: ${texts.birth}`} shell={shell} />
          <ExactText label="the exact death" text={`death: ${texts.death}`} shell={shell} />
        </>
      )}
      <Toggle label="cuts" value={state.cuts} onChange={(on) => change({ ...state, cuts: on })} />
      <Slider label="at pockets that last and are deep, at least τ" value={persistence} min={0} max={most} step={10 ** Math.floor(Math.log10(most / 500))} text={short(persistence)} onInput={(v) => to(v, 'live')} onDone={(v) => to(v, 'done')} />
      {state.cuts && cuts && <Readouts rows={[['cuts', cuts.cuts.length], ['pieces', cuts.areas.length]]} />}
    </Section>
  );
}

export function View(props: PageProps<DiscState>) {
  const { state, change, shell } = props, data = useDiscs(shell, state), { operand, answer } = data;
  useDownloads(shell, state, answer !== undefined);
  const scene = sceneOf(state, data), box = operand.outline?.box;
  const reach = reachOf(data.bars) === 1 && box ? Math.max(box.x1 - box.x0, box.y1 - box.y0) / 2 : reachOf(data.bars);
  const home = useMemo(() => {
    if (!box) return undefined;
    const margin = 0.12 * Math.max(box.x1 - box.x0, box.y1 - box.y0);
    return { x0: box.x0 - margin, y0: box.y0 - margin, x1: box.x1 + margin, y1: box.y1 + margin };
  }, [box]);
  const { set } = answer ?? {};
  return (
    <>
      <Stage>
        <PlaneView
          label={`${state.shape.name} and a disc of diameter ${short(alphaOf(state))}`} home={home} homeKey={operand.of?.name ?? ''} camera={state.camera}
          onCamera={(camera) => change({ ...state, camera }, 'aside')} shows={answer} paint={(painter) => paintDiscs(painter, scene, set?.radius ?? alphaOf(state) / 2)}
        />
      </Stage>
      <Panel summary={kSummary}>
        <Section title="Shape">
          <OperandCard shell={shell} role="P" tint="p" shape={state.shape} operand={operand} onShape={(shape) => change(discState(shape, { operation: state.operation }))} />
        </Section>
        <AlphaSection state={state} change={change} events={data.events} reach={reach} />
        <BarsSection {...props} data={data} />
        <Section title="Set">
          <Readouts
            rows={[
              ['parts', set?.parts.length],
              ['holes', set?.parts.reduce((n, p) => n + p.holes.length, 0)],
              ['tight points, segments', set && `${set.tightPoints.length / 2}, ${set.tightSegments.length / 4}`],
              ['area', answer && short(answer.area.value)],
              ['perimeter', answer && short(answer.perimeter.value)],
            ]}
          />
          {set && <ExactText label="the exact radius" text={`radius ${set.radiusExact}`} shell={shell} />}
          <Toggle label="discs that touch twice, and their bridges" value={state.bridges} onChange={(bridges) => change({ ...state, bridges })} />
        </Section>
      </Panel>
    </>
  );
}
