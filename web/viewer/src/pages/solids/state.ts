// What the page of solids shows.
import { parseShape, type Shape } from '../../engine/shape';
import { parseRational } from '../../numbers/rational';

export type Triple = readonly [number, number, number];
export const kAxes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1], skew: [1, 2, 3] } as const satisfies Record<string, Triple>;
export type Axis = keyof typeof kAxes;

export interface SolidsState {
  p: Shape;
  q: Shape;
  /** the sum P ⊕ Q; or P ⊕ −Q, the places of Q at which it hits P */
  sum: 'sum' | 'hits';
  /** Q turns about this axis through its origin, in degrees, */
  axis: Axis;
  angle: number;
  /** is scaled, exactly, */
  scale: string;
  /** and stands here */
  at: Triple;
  /** the height at which the sum is cut */
  slice: number | null;
  changes: boolean;
  through: boolean;
}

export function solidsState(p: Shape, q: Shape, changes: Partial<SolidsState> = {}): SolidsState {
  return { p, q, sum: 'sum', axis: 'skew', angle: 0, scale: '1', at: [0, 0, 0], slice: null, changes: true, through: false, ...changes };
}

export function isScale(text: string): boolean {
  const scale = parseRational(text);
  return scale !== undefined && scale.n > 0n;
}

function isTriple(value: unknown): value is Triple {
  return Array.isArray(value) && value.length === 3 && value.every((x) => Number.isFinite(x));
}

/** Throws an Error for what is no state of this page. What is left out is as in a new one. */
export function parseSolidsState(value: unknown): SolidsState {
  const v = (value ?? {}) as Partial<Record<keyof SolidsState, unknown>>;
  const start = solidsState(parseShape(v.p), parseShape(v.q));
  return {
    ...start,
    sum: v.sum === 'hits' ? 'hits' : 'sum',
    axis: typeof v.axis === 'string' && v.axis in kAxes ? (v.axis as Axis) : start.axis,
    angle: Number.isFinite(v.angle) ? (v.angle as number) : 0,
    scale: typeof v.scale === 'string' && isScale(v.scale) ? v.scale : '1',
    at: isTriple(v.at) ? v.at : start.at,
    slice: Number.isFinite(v.slice) ? (v.slice as number) : null,
    changes: v.changes !== false,
    through: v.through === true,
  };
}
