// All that the page of growing discs asks of the engine.
import type { AlphaBridge, Decomposition, FeatureBar } from 'dymsum';
import { useMemo } from 'preact/hooks';
import { together, useAnswer, type Standing } from '../../engine/use_answer';
import { useOperand, type Operand } from '../../operands/use_operand';
import type { Shell } from '../../shell/page';
import { useReport } from '../../shell/use_report';
import { useSettled } from '../../shell/use_settled';
import { lifeOf } from './barcode';
import type { DiscAnswer } from './service';
import type { DiscState } from './state';

const kMostBars = 120;
const kNoBridges: AlphaBridge[] = [];

export interface DiscData {
  operand: Operand;
  answer: DiscAnswer | undefined;
  /** radii of events; nothing before they are known */
  events: Float64Array | undefined;
  /** the longest, with their indices */
  bars: readonly (readonly [number, FeatureBar])[];
  barCount: number;
  bridges: AlphaBridge[];
  cuts: Decomposition | undefined;
  texts: { birth: string; death: string } | undefined;
  /** of the set */
  standing: Standing;
  /** of bars, bridges and cuts */
  barsStanding: Standing;
}

export function useDiscs(shell: Shell, state: DiscState): DiscData {
  const { engine } = shell, { shape, operation, semantics, alpha, event, concavity, hybridTolerance, alphaFrom, alphaTo } = state, of = { shape, concavity, hybridTolerance };
  const operand = useOperand(shell, shape), ready = operand.ready, outside = operation === 'sum' || operation === 'closed';
  const set = useAnswer(engine, 'discSet', ready ? { shape, operation, semantics, alpha, event } : undefined);
  const events = useAnswer(engine, 'discEvents', ready ? { shape, operation } : undefined);
  const bars = useAnswer(engine, 'bars', ready ? of : undefined);
  const bridges = useAnswer(engine, 'bridges', ready && state.bridges && outside ? { ...of, alpha } : undefined);
  const persistence = useSettled(state.persistence, 60);
  const cuts = useAnswer(engine, 'cuts', ready && state.cuts && persistence ? { ...of, persistence, alphaFrom, alphaTo } : undefined);
  const all = bars.of?.shape === shape && bars.of.concavity === concavity ? bars.value : undefined, chosen = state.bar === null ? undefined : all?.[state.bar];
  const texts = useAnswer(engine, 'barTexts', chosen && { ...of, birth: chosen.birth, death: chosen.death });
  const longest = useMemo(
    () => {
      const within = { from: alphaFrom, to: alphaTo }, life = (bar: FeatureBar): number => lifeOf(bar, within);
      return (all ?? []).map((bar, k) => [k, bar] as const).sort(([, a], [, b]) => life(b) - life(a) || a.birthAlpha - b.birthAlpha).slice(0, kMostBars);
    },
    [all, alphaFrom, alphaTo],
  );
  const error = set.error ?? events.error ?? bars.error ?? bridges.error ?? cuts.error;
  useReport(shell, error);
  return {
    operand, standing: set, barsStanding: together(bars, bridges, cuts), answer: ready && set.of?.shape === shape ? set.value : undefined, bars: longest, barCount: all?.length ?? 0,
    events: events.of?.shape === shape && events.of.operation === operation ? events.value : undefined,
    bridges: state.bridges && outside && bridges.of?.shape === shape ? (bridges.value ?? kNoBridges) : kNoBridges,
    cuts: state.cuts && cuts.of?.shape === shape ? cuts.value : undefined,
    texts: chosen && texts.of?.birth === chosen.birth && texts.of.death === chosen.death ? texts.value : undefined,
  };
}
