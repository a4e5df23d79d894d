// Which pair of features of P and Q a place of the sum comes from.
import type { SumShape } from 'dymsum';
import type { Nearest } from '../../view2d/edge_grid';

/** An edge of one operand and a vertex of the other. */
export interface Pair {
  /** the edge is P's */
  edgeOfP: boolean;
  p: number;
  q: number;
}

const kNone = 0xffffffff;

function pairAt(shape: SumShape, at: number): Pair {
  const c = shape.contacts;
  return { edgeOfP: c[at] === 0, p: c[at + 1]!, q: c[at + 2]! };
}
export const arriving = (shape: SumShape, vertex: number): Pair => pairAt(shape, 6 * vertex);
export const leaving = (shape: SumShape, vertex: number): Pair => pairAt(shape, 6 * vertex + 3);

/** The vertices of P and Q whose sum it is, if it is no crossing. */
export function corner(shape: SumShape, vertex: number): { p: number; q: number } | undefined {
  const p = shape.corners[2 * vertex]!, q = shape.corners[2 * vertex + 1]!;
  return p === kNone ? undefined : { p, q };
}

export function pairText({ edgeOfP, p, q }: Pair, names: readonly [string, string] = ['P', 'Q']): string {
  return edgeOfP ? `edge ${p} of ${names[0]} + vertex ${q} of ${names[1]}` : `vertex ${p} of ${names[0]} + edge ${q} of ${names[1]}`;
}

export function originText(shape: SumShape, { kind, index }: Pick<Nearest, 'kind' | 'index'>, names: readonly [string, string] = ['P', 'Q']): string {
  if (kind === 'edge') return pairText(leaving(shape, index), names);
  const pair = corner(shape, index);
  if (pair) return `vertex ${pair.p} of ${names[0]} + vertex ${pair.q} of ${names[1]}`;
  return `crossing of ${pairText(arriving(shape, index), names)} and ${pairText(leaving(shape, index), names)}`;
}

/** The features of the operands that a place comes from: edges by their first vertices. */
export function features(shape: SumShape, { kind, index }: Pick<Nearest, 'kind' | 'index'>): { edgesP: number[]; verticesP: number[]; edgesQ: number[]; verticesQ: number[] } {
  const pair = kind === 'vertex' ? corner(shape, index) : undefined;
  if (pair) return { edgesP: [], verticesP: [pair.p], edgesQ: [], verticesQ: [pair.q] };
  const pairs = kind === 'edge' ? [leaving(shape, index)] : [arriving(shape, index), leaving(shape, index)];
  return {
    edgesP: pairs.filter((c) => c.edgeOfP).map((c) => c.p),
    verticesP: pairs.filter((c) => !c.edgeOfP).map((c) => c.p),
    edgesQ: pairs.filter((c) => !c.edgeOfP).map((c) => c.q),
    verticesQ: pairs.filter((c) => c.edgeOfP).map((c) => c.q),
  };
}
