import { useMemo } from 'preact/hooks';
import { EngineError } from '../engine/client';
import type { Shape } from '../engine/shape';
import { useAnswer } from '../engine/use_answer';
import type { Shell } from '../shell/page';
import { useReport } from '../shell/use_report';
import { Outline } from './outline';

export interface Operand {
  outline: Outline | undefined;
  error: EngineError | undefined;
  /** what `outline` and `error` are of */
  of: Shape | undefined;
  /** a valid operand of the shape that was asked about */
  ready: boolean;
}

/** The operand for drawing; errors are shown with their place. */
export function useOperand(shell: Shell, shape: Shape): Operand {
  const asked = useAnswer(shell.engine, 'operand', { shape });
  const answer = asked.value;
  const outline = useMemo(() => (answer?.shape ? new Outline(answer.shape) : undefined), [answer]);
  const refusal = useMemo(() => (answer?.error ? new EngineError(answer.error) : undefined), [answer]);
  const error = refusal ?? (asked.error as EngineError | undefined);
  useReport(shell, error);
  return { outline, error, of: asked.error ? shape : asked.of?.shape, ready: asked.of?.shape === shape && !error };
}
