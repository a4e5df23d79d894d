// What the page of sums shows.
import { parseShape, type Shape } from '../../engine/shape';
import { parseRational } from '../../numbers/rational';
import type { Camera } from '../../view2d/camera';

export type Which = 'p' | 'q';
export const kLayers = ['p', 'q', 'sum', 'tight', 'convolution', 'cells', 'crossings', 'dropped'] as const;
export type Layer = (typeof kLayers)[number];

export interface SumState {
  p: Shape;
  q: Shape;
  /** the one that is scaled or turned, about the origin of its coordinates */
  moving: Which;
  motion: 'scale' | 'turn';
  /** exact numbers as text; only that of `motion` counts */
  scale: string;
  /** the tangent of half the angle, or "inf" */
  tanHalf: string;
  /** where the origins of P and Q stand */
  atP: [number, number];
  atQ: [number, number];
  layers: Layer[];
  camera?: Camera;
}

export function sumState(p: Shape, q: Shape, changes: Partial<SumState> = {}): SumState {
  return { p, q, moving: 'p', motion: 'scale', scale: '1', tanHalf: '0', atP: [0, 0], atQ: [0, 0], layers: ['p', 'q', 'sum', 'tight'], ...changes };
}

function isPair(value: unknown): value is [number, number] {
  return Array.isArray(value) && value.length === 2 && value.every((x) => Number.isFinite(x));
}

export function parseCamera(value: unknown): { camera?: Camera } {
  const { x, y, zoom } = (value ?? {}) as Partial<Camera>;
  return [x, y, zoom].every((n) => Number.isFinite(n)) && zoom! > 0 ? { camera: { x: x!, y: y!, zoom: zoom! } } : {};
}

/** Throws an Error for what is no state of this page. What is left out is as in a new one. */
export function parseSumState(value: unknown): SumState {
  const v = (value ?? {}) as Partial<Record<keyof SumState, unknown>>;
  const start = sumState(parseShape(v.p), parseShape(v.q));
  const number = (text: unknown, otherwise: string): string =>
    typeof text === 'string' && (text === 'inf' || parseRational(text)) ? text : otherwise;
  return {
    ...start,
    moving: v.moving === 'q' ? 'q' : 'p',
    motion: v.motion === 'turn' ? 'turn' : 'scale',
    scale: number(v.scale, '1'),
    tanHalf: number(v.tanHalf, '0'),
    atP: isPair(v.atP) ? v.atP : start.atP,
    atQ: isPair(v.atQ) ? v.atQ : start.atQ,
    layers: Array.isArray(v.layers) ? kLayers.filter((l) => (v.layers as unknown[]).includes(l)) : start.layers,
    ...parseCamera(v.camera),
  };
}
