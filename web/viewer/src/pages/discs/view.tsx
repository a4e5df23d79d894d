import { useEffect, useMemo } from 'preact/hooks';
import { short } from '../../numbers/display';
import { OperandCard } from '../../operands/operand_card';
import { Readouts, Section } from '../../shell/controls';
import { ExactText } from '../../shell/exact_text';
import type { PageProps, Shell } from '../../shell/page';
import { Panel, Stage } from '../../shell/parts';
import { Results } from '../../shell/results';
import type { Point } from '../../view2d/camera';
import { PlaneView } from '../../view2d/plane_view';
import { NestingOffer } from '../nesting/offer';
import { AlphaSection, alphaOf, alphaText } from './alpha_section';
import { reachOf } from './barcode';
import { BarsSection } from './bars_section';
import { paintDiscs, type DiscScene } from './picture';
import { discState, type DiscState } from './state';
import { useDiscs, type DiscData } from './use_discs';

export const kSummary = 'A disc grows around a shape. It sees pockets and gaps, from their birth to their death; long bars are worth a cut.';

const kFiles = { svg: 'Picture (SVG)', json: 'Set with true arcs (JSON)', wkt: 'Polygons (WKT)' } as const;

function useDownloads({ engine, setDownloads }: Shell, { shape, operation, semantics, alpha, event }: DiscState, isThere: boolean): void {
  useEffect(() => {
    const formats = isThere ? (Object.keys(kFiles) as (keyof typeof kFiles)[]) : [];
    setDownloads(formats.map((format) => ({
      label: kFiles[format], fileName: `disc.${format}`, make: () => engine.ask('discFile', { shape, operation, semantics, alpha, event, format }),
    })));
  }, [engine, setDownloads, shape, operation, semantics, alpha, event, isThere]);
}

function sceneOf({ bar }: DiscState, data: DiscData): DiscScene {
  const chosen = data.bars.find(([k]) => k === bar)?.[1], { error, outline } = data.operand, { x, y } = error?.evidence ?? {};
  const wrong: Point[] = x !== undefined && y !== undefined ? [{ x, y }] : [];
  const marked = [chosen?.vertex, chosen?.minimum].filter((k): k is number => typeof k === 'number');
  return { outline, set: data.answer?.set, bridges: data.bridges, cuts: data.cuts, marked, wrong };
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
  useEffect(() => {
    const radius = state.event === null ? undefined : data.events?.[state.event], alpha = radius === undefined ? state.alpha : alphaText(radius);
    if (alpha !== state.alpha) change({ ...state, alpha }, 'aside'); // a command names an event and knows no diameter
  }, [state, data.events, change]);
  return (
    <>
      <Stage>
        <PlaneView
          label={`${state.shape.name} and a disc of diameter ${short(alphaOf(state))}`} home={home} homeKey={operand.of?.name ?? ''} camera={state.camera}
          onCamera={(camera) => change({ ...state, camera }, 'aside')} shows={answer} stale={data.standing.waiting} paint={(painter) => paintDiscs(painter, scene, set?.radius ?? alphaOf(state) / 2)}
        />
      </Stage>
      <Panel summary={kSummary}>
        <Section title="Shape">
          <OperandCard shell={shell} role="P" tint="p" shape={state.shape} operand={operand} onShape={(shape) => change(discState(shape, { operation: state.operation }))} />
          <NestingOffer shape={state.shape} error={operand.error} shell={shell} />
        </Section>
        <AlphaSection state={state} change={change} events={data.events} reach={reach} />
        <Section title="Set">
          <Results {...data.standing} refused={operand.error !== undefined}>
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
          </Results>
        </Section>
        <BarsSection {...props} data={data} />
      </Panel>
    </>
  );
}
