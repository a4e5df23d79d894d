// What the page of nesting shows.
import type { Semantics } from 'dymsum';
import { parseShape, type FileShape, type Shape } from '../../engine/shape';
import { parseRational } from '../../numbers/rational';
import type { Camera } from '../../view2d/camera';
import { parseSemantics } from '../options';
import { parseCamera } from '../sum/state';

/** Where B's reference point stands. All but `free` are exact fits, named by the no-fit polygon, not by coordinates. */
export type Placement =
  | { kind: 'free'; x: number; y: number }
  | { kind: 'vertex'; index: number }
  /** `along`: an exact share of the edge from one vertex to the next */
  | { kind: 'edge'; index: number; next: number; along: string }
  /** the nearest position at which A and B touch */
  | { kind: 'nearest'; x: number; y: number };

export const kFree: Placement = { kind: 'free', x: 0, y: 0 };

export interface NestingState {
  a: Shape;
  b: Shape;
  /** all that A and B may be, where more than two files were taken */
  parts: Shape[];
  semantics: Semantics;
  /** a file that was taken and not looked into: it is A, or holds all parts */
  unopened?: FileShape;
  at: Placement;
  camera?: Camera;
}

function isShare(text: string): boolean {
  const r = parseRational(text);
  return r !== undefined && r.n >= 0n && r.n <= r.d;
}

function parsePlacement(value: unknown): Placement {
  const { kind, x, y, index, next, along } = (value ?? {}) as Record<string, unknown>;
  const isIndex = (n: unknown): n is number => Number.isInteger(n) && (n as number) >= 0;
  if (kind === 'vertex' && isIndex(index)) return { kind, index };
  if (kind === 'edge' && isIndex(index) && isIndex(next) && typeof along === 'string' && isShare(along)) return { kind, index, next, along };
  if ((kind === 'free' || kind === 'nearest') && Number.isFinite(x) && Number.isFinite(y)) return { kind, x: x as number, y: y as number };
  throw new Error('The document holds no place for B.');
}

/** Throws an Error for what is no state of this page. */
export function parseNestingState(value: unknown): NestingState {
  const v = (value ?? {}) as Record<string, unknown>;
  const parts = Array.isArray(v.parts) ? v.parts.map(parseShape) : [];
  return { a: parseShape(v.a), b: parseShape(v.b), parts, semantics: parseSemantics(v.semantics, 'open'), at: parsePlacement(v.at), ...parseCamera(v.camera) };
}

/** Places on a no-fit polygon are named by its vertices: those of another one are others. */
export function placeBesideAnother(at: Placement): Placement {
  return at.kind === 'free' || at.kind === 'nearest' ? at : kFree;
}

/** With these as parts, of which those of the same names as before stay A and B. */
export function withParts({ unopened: _, ...state }: NestingState, shapes: readonly Shape[], at: Placement): NestingState {
  const again = (shape: Shape): Shape | undefined => shapes.find((part) => part.name === shape.name);
  return { ...state, a: again(state.a) ?? shapes[0]!, b: again(state.b) ?? shapes[1] ?? state.b, parts: shapes.length > 2 ? [...shapes] : [], at };
}
