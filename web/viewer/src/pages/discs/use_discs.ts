// All that the page of growing discs asks of the engine.
import type { AlphaBridge, Decomposition, FeatureBar } from 'dymsum';
import { useEffect, useMemo } from 'preact/hooks';
import { useAnswer } from '../../engine/use_answer';
import { useOperand, type Operand } from '../../operands/use_operand';
import type { Shell } from '../../shell/page';
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
}

export function useDiscs(shell: Shell, state: DiscState): DiscData {
  const { engine } = shell, { shape, operation, alpha, event } = state;
  const operand = useOperand(shell, shape), ready = operand.ready, outside = operation === 'sum' || operation === 'closed';
  const set = useAnswer(engine, 'discSet', ready ? { shape, operation, alpha, event } : undefined);
  const events = useAnswer(engine, 'discEvents', ready ? { shape, operation } : undefined);
  const bars = useAnswer(engine, 'bars', ready ? { shape } : undefined);
  const bridges = useAnswer(engine, 'bridges', ready && state.bridges && outside ? { shape, alpha } : undefined);
  const persistence = useSettled(state.persistence, 60);
  const cuts = useAnswer(engine, 'cuts', ready && state.cuts && persistence ? { shape, persistence } : undefined);
  const all = bars.of?.shape === shape ? bars.value : undefined, chosen = state.bar === null ? undefined : all?.[state.bar];
  const texts = useAnswer(engine, 'barTexts', chosen && { shape, birth: chosen.birth, death: chosen.death });
  const longest = useMemo(
    () => (all ?? []).map((bar, k) => [k, bar] as const).sort(([, a], [, b]) => lifeOf(b) - lifeOf(a) || a.birthAlpha - b.birthAlpha).slice(0, kMostBars),
    [all],
  );
  const error = set.error ?? events.error ?? bars.error ?? bridges.error ?? cuts.error;
  useEffect(() => {
    if (error) shell.report(error);
  }, [shell, error]);
  return {
    operand, answer: set.value, bars: longest, barCount: all?.length ?? 0,
    events: events.of?.shape === shape && events.of.operation === operation ? events.value : undefined,
    bridges: state.bridges && outside && bridges.of?.shape === shape ? (bridges.value ?? kNoBridges) : kNoBridges,
    cuts: state.cuts && cuts.of?.shape === shape ? cuts.value : undefined,
    texts: chosen && texts.of?.birth === chosen.birth && texts.of.death === chosen.death ? texts.value : undefined,
  };
}
