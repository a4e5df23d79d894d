// All that the page of sums asks of the engine.
import type { PlanarDistance, PlanarTrace } from 'dymsum';
import { useMemo } from 'preact/hooks';
import { together, useAnswer, type Standing } from '../../engine/use_answer';
import { add, fromDouble, toNumber, type Rational } from '../../numbers/rational';
import { useOperand, type Operand } from '../../operands/use_operand';
import type { Shell } from '../../shell/page';
import { useReport } from '../../shell/use_report';
import { useSettled } from '../../shell/use_settled';
import { SumPicture } from '../../view2d/sum_shape';
import { isStill, type SumArea, type SumArgs } from './service';
import type { SumState } from './state';
import { scaleRange } from './tools';

export type Pull = NonNullable<SumArgs['pull']>;

export interface SumData {
  p: Operand;
  q: Operand;
  /** what is asked now */
  args: SumArgs;
  sum: SumPicture | undefined;
  /** what `sum` is the answer to */
  of: SumArgs | undefined;
  ms: number | undefined;
  error: unknown;
  /** of the sum and its area */
  standing: Standing;
  area: SumArea | undefined;
  trace: PlanarTrace | undefined;
  /** of Q where it stands, where that is asked for */
  depth: PlanarDistance | undefined;
}

const kStages = ['convolution', 'cells', 'crossings', 'dropped'] as const;

/** Where Q stands as P sees it; nothing where no doubles say that. */
function placeOfQ({ atP, atQ }: SumState): { x: number; y: number } | undefined {
  const between = (k: 0 | 1): Rational => add(fromDouble(atQ[k]), fromDouble(-atP[k]));
  const [x, y] = [between(0), between(1)].map((r) => ({ r, double: toNumber(r) }));
  const isDouble = ({ r, double }: { r: Rational; double: number }): boolean => fromDouble(double).n === r.n && fromDouble(double).d === r.d;
  return isDouble(x!) && isDouble(y!) ? { x: x!.double, y: y!.double } : undefined;
}

export function useSum(shell: Shell, state: SumState, pull: Pull | undefined): SumData {
  const { engine } = shell, { shown, semantics, moving, motion, scale, tanHalf } = state;
  const p = useOperand(shell, state.p), q = useOperand(shell, state.q);
  const [low, high] = scaleRange(state).map(String) as [string, string];
  const args = useMemo<SumArgs>(
    () => ({ p: state.p, q: state.q, shown, semantics, moving, motion, scale, tanHalf, low, high, pull }),
    [state.p, state.q, shown, semantics, moving, motion, scale, tanHalf, low, high, pull],
  );
  const ready = p.ready && q.ready;
  const frame = useAnswer(engine, 'sumFrame', ready ? args : undefined);
  const settled = useSettled(ready && !pull ? args : undefined);
  const area = useAnswer(engine, 'sumArea', settled);
  const staged = kStages.some((layer) => state.layers.includes(layer));
  const trace = useAnswer(engine, 'sumTrace', staged ? settled : undefined);
  const place = shown === 'hits' && ready && isStill(args) ? placeOfQ(state) : undefined;
  const depth = useAnswer(engine, 'sumDepth', place && { p: state.p, q: state.q, ...place });
  const sum = useMemo(() => frame.value && new SumPicture(frame.value.shape), [frame.value]);
  const error = frame.error ?? area.error ?? trace.error ?? depth.error;
  useReport(shell, error);
  return {
    p, q, args, sum, of: frame.of, ms: frame.value?.ms, error, standing: { ...together(frame, area), waiting: frame.waiting },
    area: area.of === settled ? area.value : undefined,
    trace: staged && trace.of === settled ? (trace.value ?? undefined) : undefined,
    depth: place && depth.of?.p === state.p && depth.of.q === state.q ? depth.value : undefined,
  };
}
