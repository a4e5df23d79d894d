// All that the page of sums asks of the engine.
import { useEffect, useMemo } from 'preact/hooks';
import { useAnswer } from '../../engine/use_answer';
import { useOperand, type Operand } from '../../operands/use_operand';
import type { Shell } from '../../shell/page';
import { useSettled } from '../../shell/use_settled';
import { SumPicture } from '../../view2d/sum_shape';
import type { SumArgs, SumArea } from './service';
import type { SumState } from './state';
import type { PlanarTrace } from 'dymsum';

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
  area: SumArea | undefined;
  trace: PlanarTrace | undefined;
}

const kStages = ['convolution', 'cells', 'crossings', 'dropped'] as const;

export function useSum(shell: Shell, state: SumState, pull: Pull | undefined): SumData {
  const { engine } = shell, { moving, motion, scale, tanHalf } = state;
  const p = useOperand(shell, state.p), q = useOperand(shell, state.q);
  const args = useMemo<SumArgs>(
    () => ({ p: state.p, q: state.q, moving, motion, scale, tanHalf, pull }),
    [state.p, state.q, moving, motion, scale, tanHalf, pull],
  );
  const ready = p.ready && q.ready;
  const frame = useAnswer(engine, 'sumFrame', ready ? args : undefined);
  const settled = useSettled(ready && !pull ? args : undefined);
  const area = useAnswer(engine, 'sumArea', settled);
  const staged = kStages.some((layer) => state.layers.includes(layer));
  const trace = useAnswer(engine, 'sumTrace', staged ? settled : undefined);
  const sum = useMemo(() => frame.value && new SumPicture(frame.value.shape), [frame.value]);
  const error = frame.error ?? area.error ?? trace.error;
  useEffect(() => {
    if (error) shell.report(error);
  }, [shell, error]);
  return {
    p, q, args, sum, of: frame.of, ms: frame.value?.ms, error,
    area: area.of === settled ? area.value : undefined,
    trace: staged && trace.of === settled ? (trace.value ?? undefined) : undefined,
  };
}
