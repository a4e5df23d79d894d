// What the page knows of the state it shows: answers of the engine, for drawing.
import { useMemo } from 'preact/hooks';
import { EngineError } from '../../engine/client';
import type { Shape } from '../../engine/shape';
import { together, useAnswer, type Standing } from '../../engine/use_answer';
import type { Shell } from '../../shell/page';
import { useReport } from '../../shell/use_report';
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
  /** of the sum and its numbers */
  standing: Standing;
  /** of the depth */
  depthStanding: Standing;
  refused: boolean;
}

export function useSolid(shell: Shell, shape: Shape, thin: boolean): SolidOperand | undefined {
  const asked = useAnswer(shell.engine, 'solidOperand', { shape, thin }), answer = asked.of?.shape === shape && asked.of.thin === thin ? asked.value : undefined;
  const refusal = useMemo(() => (answer?.error ? new EngineError(answer.error) : undefined), [answer]);
  const error = refusal ?? asked.error;
  useReport(shell, error);
  return answer;
}

export function useSolids(shell: Shell, state: SolidsState): SolidsData {
  const { p, q, thin, sum, semantics, moving, axis, angle, scale, at, slice } = state, { engine } = shell;
  const first = useSolid(shell, p, thin), second = useSolid(shell, q, thin);
  const refused = (first?.error ?? second?.error) !== undefined, ready = first !== undefined && second !== undefined && !refused;
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
  useReport(shell, error);
  const of = frame.of, isCurrent = of?.p === p && of.q === q && of.sum === sum;
  return {
    p: first, q: second, args, of,
    placement: useMemo(() => first && second && placementOf(first, second), [first, second]),
    frame: isCurrent && !refused ? frame.value : undefined,
    numbers: ready && numbers.of?.args === args ? numbers.value : undefined,
    refused, standing: { ...together(frame, numbers), waiting: frame.waiting }, depthStanding: depth,
    depth: sum === 'hits' && ready && depth.of?.p === p && depth.of.q === q ? depth.value : undefined,
    section: section.of?.args === args && section.of.z === slice ? section.value : undefined,
  };
}
