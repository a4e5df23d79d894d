// What the page of sums shows.
import type { Semantics } from 'dymsum';
import { parseShape, type Shape } from '../../engine/shape';
import type { Camera } from '../../view2d/camera';
import { isAngle } from '../angle';
import { parseSemantics } from '../options';
import { checkScale } from '../scale';

export type Which = 'p' | 'q';
export const kLayers = ['p', 'q', 'sum', 'tight', 'convolution', 'cells', 'crossings', 'dropped'] as const;
export type Layer = (typeof kLayers)[number];

/** The sum; P ⊕ −Q, the places of Q at which it hits P; the places at which Q fits into P. */
export const kShown = [
  ['sum', 'P ⊕ Q', 'The sum: every point of P added to every point of Q.'],
  ['hits', 'P ⊕ −Q', 'The places of Q at which it hits P: the no-fit polygon.'],
  ['fit', 'Fit in P', 'The places of Q at which all of it lies inside P: the inner fit.'],
] as const;
export type Shown = (typeof kShown)[number][0];

export interface SumState {
  p: Shape;
  q: Shape;
  shown: Shown;
  semantics: Semantics;
  /** the one that is scaled or turned, about the origin of its coordinates */
  moving: Which;
  motion: 'scale' | 'turn';
  /** see scale.ts; only that of `motion` counts */
  scale: string;
  /** see angle.ts */
  tanHalf: string;
  /** what the slider covers: scales or radians */
  range?: readonly [number, number];
  /** where the origins of P and Q stand */
  atP: [number, number];
  atQ: [number, number];
  layers: Layer[];
  /** the part that is looked at: low x, low y, high x, high y */
  look?: readonly [number, number, number, number];
  camera?: Camera;
}
/** One shape alone is shown as it is. */
export type AloneState = Omit<SumState, 'q'> & { q: null };
export type SumPageState = SumState | AloneState;

export function isPair(state: SumPageState): state is SumState {
  return state.q !== null;
}

export function sumState(p: Shape, q: Shape, changes: Partial<SumState> = {}): SumState {
  return { p, q, shown: 'sum', semantics: 'closed', moving: 'p', motion: 'scale', scale: '1', tanHalf: '0', atP: [0, 0], atQ: [0, 0], layers: ['p', 'q', 'sum', 'tight'], ...changes };
}

/** The inner fit is computed of operands whose coordinates are doubles: what turns has others. */
export function withShown(state: SumState, shown: Shown): SumState {
  return shown === 'fit' ? { ...state, shown, motion: 'scale', tanHalf: '0' } : { ...state, shown };
}

function areNumbers(value: unknown, count: number): value is number[] {
  return Array.isArray(value) && value.length === count && value.every((x) => Number.isFinite(x));
}

export function parseCamera(value: unknown): { camera?: Camera } {
  const { x, y, zoom } = (value ?? {}) as Partial<Camera>;
  return [x, y, zoom].every((n) => Number.isFinite(n)) && zoom! > 0 ? { camera: { x: x!, y: y!, zoom: zoom! } } : {};
}

export function parseRange(value: unknown): { range?: readonly [number, number] } {
  return areNumbers(value, 2) ? { range: [value[0]!, value[1]!] } : {};
}

function parsePair(value: unknown): [number, number] {
  return areNumbers(value, 2) ? [value[0]!, value[1]!] : [0, 0];
}

/** Why a text is no scale that can be drawn; nothing where it is one. */
export function checkSumScale(text: string): string | undefined {
  return checkScale(text, 2);
}

/** Throws an Error for what is no state of this page. What is left out is as in a new one. */
export function parseSumState(value: unknown): SumPageState {
  const v = (value ?? {}) as Partial<Record<keyof SumState, unknown>>;
  const p = parseShape(v.p), start = sumState(p, v.q === null ? p : parseShape(v.q));
  const state = withShown({
    ...start,
    semantics: parseSemantics(v.semantics, 'closed'),
    moving: v.moving === 'q' ? 'q' : 'p',
    motion: v.motion === 'turn' ? 'turn' : 'scale',
    scale: typeof v.scale === 'string' && checkSumScale(v.scale) === undefined ? v.scale : '1',
    tanHalf: typeof v.tanHalf === 'string' && isAngle(v.tanHalf) ? v.tanHalf : '0',
    ...parseRange(v.range),
    atP: parsePair(v.atP),
    atQ: parsePair(v.atQ),
    layers: Array.isArray(v.layers) ? kLayers.filter((l) => (v.layers as unknown[]).includes(l)) : start.layers,
    ...(areNumbers(v.look, 4) ? { look: v.look as unknown as NonNullable<SumState['look']> } : {}),
    ...parseCamera(v.camera),
  }, kShown.find(([name]) => name === v.shown)?.[0] ?? 'sum');
  return v.q === null ? { ...state, q: null } : state;
}
