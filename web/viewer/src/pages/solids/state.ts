// What the page of solids shows.
import type { Semantics } from 'dymsum';
import { parseShape, type Shape } from '../../engine/shape';
import { parseSemantics } from '../options';
import { factorsOf, isOversized, isSize, kSizes } from '../scale';

export type Triple = readonly [number, number, number];
export const kAxes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1], skew: [1, 2, 3] } as const satisfies Record<string, Triple>;

/** Of the choice whether they do. */
export const kThinHint = 'Open surfaces, segments and points in files take part in the sum; else a file with one is refused.';

export interface SolidsState {
  p: Shape;
  q: Shape;
  /** parts without volume in files count as operands, too */
  thin: boolean;
  /** the sum P ⊕ Q; P ⊕ −Q, the places of Q at which it hits P; or the places at which Q fits into P */
  sum: 'sum' | 'hits' | 'fit';
  semantics: Semantics;
  /** the one that turns and is scaled */
  moving: 'p' | 'q';
  /** about this axis through its origin, in degrees, */
  axis: Triple;
  angle: number;
  /** by these factors, exactly, see scale.ts */
  scale: string;
  /** the scales that the slider covers */
  range?: readonly [number, number];
  /** where Q stands */
  at: Triple;
  /** the height at which the sum is cut */
  slice: number | null;
  /** the part of the sum that is looked at: low x, y, z, high x, y, z */
  look?: readonly [number, number, number, number, number, number];
  changes: boolean;
  through: boolean;
}
/** One solid alone is shown as it is. */
export type AloneState = Omit<SolidsState, 'q'> & { q: null };
export type SolidsPageState = SolidsState | AloneState;

export function isPair(state: SolidsPageState): state is SolidsState {
  return state.q !== null;
}

export function solidsState(p: Shape, q: Shape, changes: Partial<SolidsState> = {}): SolidsState {
  const start = { p, q, thin: false, moving: 'q', axis: kAxes.skew, angle: 0, scale: '1', at: [0, 0, 0], slice: null, changes: true, through: false } as const;
  return { ...start, ...kSets.sum, ...changes };
}

/** Each set with what touching counts in it: Q hits P only where they overlap, unless something else is asked for. */
export const kSets = {
  sum: { sum: 'sum', semantics: 'closed' }, hits: { sum: 'hits', semantics: 'open' }, fit: { sum: 'fit', semantics: 'closed' },
} as const satisfies Record<SolidsState['sum'], Pick<SolidsState, 'sum' | 'semantics'>>;

/** The inner fit is computed of solids whose coordinates are doubles: what turns has others. */
export function withSet(state: SolidsState, sum: SolidsState['sum']): SolidsState {
  return { ...state, ...kSets[sum], ...(sum === 'fit' ? { angle: 0 } : {}) };
}

/** A place on an axis: larger and smaller ones would overflow where they are drawn. */
export function isPlace(value: unknown): value is number {
  return typeof value === 'number' && (value === 0 || isSize(value));
}
function arePlaces(value: unknown, count: number): value is number[] {
  return Array.isArray(value) && value.length === count && value.every(isPlace);
}
const kMostDegrees = 1e6;

/** Throws an Error for numbers that are some, but too large or too small: nothing else is to be shown in their place. */
function refuseOversized({ at, axis, look, range, slice, scale }: Partial<Record<keyof SolidsState, unknown>>): void {
  const oversized = [at, axis, look, range, slice].flat().find((x) => typeof x === 'number' && !Number.isNaN(x) && !isPlace(x));
  const refused = oversized ?? (typeof scale === 'string' && isOversized(scale) ? scale : undefined);
  if (refused !== undefined) throw new Error(`This page cannot compute with ${refused}: it takes numbers from ${kSizes} in size.`);
}

/** Nothing for numbers that are no axis. */
export function axisOf(value: unknown): Triple | undefined {
  return arePlaces(value, 3) && value.some((x) => x !== 0) ? (value as unknown as Triple) : undefined;
}

/** Throws an Error for what is no state of this page. What is left out is as in a new one. */
export function parseSolidsState(value: unknown): SolidsPageState {
  const v = (value ?? {}) as Partial<Record<keyof SolidsState, unknown>>;
  refuseOversized(v);
  const set = v.sum === 'hits' || v.sum === 'fit' ? v.sum : 'sum', p = parseShape(v.p), start = solidsState(p, v.q === null ? p : parseShape(v.q), kSets[set]);
  const named = typeof v.axis === 'string' && v.axis in kAxes ? kAxes[v.axis as keyof typeof kAxes] : undefined; // as older pages wrote it
  const state: SolidsState = {
    ...start,
    thin: v.thin === true,
    semantics: parseSemantics(v.semantics, start.semantics),
    moving: v.moving === 'p' ? 'p' : 'q',
    axis: named ?? axisOf(v.axis) ?? start.axis,
    angle: set !== 'fit' && typeof v.angle === 'number' && Math.abs(v.angle) <= kMostDegrees ? v.angle : 0,
    scale: typeof v.scale === 'string' && factorsOf(v.scale, 3) ? v.scale : '1',
    ...(arePlaces(v.range, 2) ? { range: [v.range[0]!, v.range[1]!] as const } : {}),
    at: arePlaces(v.at, 3) ? (v.at as unknown as Triple) : start.at,
    slice: isPlace(v.slice) ? v.slice : null,
    ...(arePlaces(v.look, 6) ? { look: v.look as unknown as NonNullable<SolidsState['look']> } : {}),
    changes: v.changes !== false,
    through: v.through === true,
  };
  return v.q === null ? { ...state, q: null } : state;
}
