// What the page knows of the state it shows: answers of the engine, for drawing.
import { useEffect, useMemo } from 'preact/hooks';
import { EngineError } from '../../engine/client';
import type { Shape } from '../../engine/shape';
import { useAnswer } from '../../engine/use_answer';
import type { Shell } from '../../shell/page';
import { useSettled } from '../../shell/use_settled';
import type { Placement } from '../../view3d/placement';
import { placementOf } from './placing';
import type { SolidDepthAnswer, Unknown } from './depth';
import type { SolidFrame, SolidNumbers, SolidOperand, SolidSection } from './service';
import type { SumArgs } from './standing';
import type { SolidsState } from './state';

export interface SolidsData {
  p: SolidOperand | undefined;
  q: SolidOperand | undefined;
  placement: Placement | undefined;
  args: SumArgs;
  frame: SolidFrame | undefined;
  /** what `frame` is of */
  of: SumArgs | undefined;
  numbers: SolidNumbers | undefined;
  depth: SolidDepthAnswer | Unknown | undefined;
  section: SolidSection | null | undefined;
}

export function useSolid(shell: Shell, shape: Shape, thin: boolean): SolidOperand | undefined {
  const asked = useAnswer(shell.engine, 'solidOperand', { shape, thin }), answer = asked.of?.shape === shape && asked.of.thin === thin ? asked.value : undefined;
  const refusal = useMemo(() => (answer?.error ? new EngineError(answer.error) : undefined), [answer]);
  const error = refusal ?? asked.error;
  useEffect(() => {
    if (error) shell.report(error);
  }, [shell, error]);
  return answer;
}

export function useSolids(shell: Shell, state: SolidsState): SolidsData {
  const { p, q, thin, sum, semantics, moving, axis, angle, scale, at, slice } = state, { engine } = shell;
  const first = useSolid(shell, p, thin), second = useSolid(shell, q, thin);
  const ready = first !== undefined && second !== undefined && !first.error && !second.error;
  const args = useMemo<SumArgs>(
    () => ({ p, q, thin, sum, semantics, moving, axis, angle, scale }),
    [p, q, thin, sum, semantics, moving, axis, angle, scale],
  );
  const frame = useAnswer(engine, 'solidFrame', ready ? args : undefined);
  const settled = useSettled(args), known = ready && settled && frame.of === settled;
  const numbers = useAnswer(engine, 'solidNumbers', known ? { args: settled } : undefined);
  const depth = useAnswer(engine, 'solidDepth', ready && sum === 'hits' ? { ...args, at } : undefined);
  const isSection = known && slice !== null && angle === 0;
  const section = useAnswer(engine, 'solidSection', isSection ? { args: settled, z: slice } : undefined);
  const error = frame.error ?? numbers.error ?? depth.error ?? section.error;
  useEffect(() => {
    if (error) shell.report(error);
  }, [shell, error]);
  const of = frame.of, isCurrent = of?.p === p && of.q === q && of.sum === sum;
  return {
    p: first, q: second, args, of,
    placement: useMemo(() => first && second && placementOf(first, second), [first, second]),
    frame: isCurrent && !frame.error ? frame.value : undefined,
    numbers: numbers.of?.args === args ? numbers.value : undefined,
    depth: sum === 'hits' && !depth.error && depth.of?.p === p && depth.of.q === q ? depth.value : undefined,
    section: section.of?.args === args && section.of.z === slice ? section.value : undefined,
  };
}
