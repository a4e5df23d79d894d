// What the page of growing discs shows.
import { parseShape, type Shape } from '../../engine/shape';
import { parseRational } from '../../numbers/rational';
import type { Camera } from '../../view2d/camera';
import { parseCamera } from '../sum/state';

export const kOperations = [['sum', 'Grown'], ['closed', 'Closed'], ['eroded', 'Shrunk'], ['opened', 'Opened']] as const;
export type Operation = (typeof kOperations)[number][0];

export interface DiscState {
  shape: Shape;
  operation: Operation;
  /** the diameter, an exact number as text */
  alpha: string;
  /** with this the diameter is exactly the one of an event, and `alpha` near it */
  event: number | null;
  /** the bar that is looked at */
  bar: number | null;
  bridges: boolean;
  cuts: boolean;
  /** bars that last at least so long are cut at */
  persistence: string;
  camera?: Camera;
}

export function discState(shape: Shape, changes: Partial<DiscState> = {}): DiscState {
  return { shape, operation: 'sum', alpha: '1/2', event: null, bar: null, bridges: true, cuts: false, persistence: '1', ...changes };
}

/** Throws an Error for what is no state of this page. What is left out is as in a new one. */
export function parseDiscState(value: unknown): DiscState {
  const v = (value ?? {}) as Partial<Record<keyof DiscState, unknown>>, start = discState(parseShape(v.shape));
  const number = (text: unknown, otherwise: string): string => {
    const r = typeof text === 'string' ? parseRational(text) : undefined;
    return r && r.n >= 0n ? (text as string) : otherwise;
  };
  const index = (n: unknown): number | null => (Number.isInteger(n) ? (n as number) : null);
  return {
    ...start,
    operation: kOperations.find(([name]) => name === v.operation)?.[0] ?? 'sum',
    alpha: number(v.alpha, start.alpha),
    event: index(v.event),
    bar: index(v.bar),
    bridges: v.bridges !== false,
    cuts: v.cuts === true,
    persistence: number(v.persistence, start.persistence),
    ...parseCamera(v.camera),
  };
}
