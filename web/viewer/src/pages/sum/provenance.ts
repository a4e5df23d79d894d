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

/** What the operands are called, and what stands between the features: they are added, subtracted, or touch. */
export interface Wording {
  names: readonly [string, string];
  between: '+' | '−' | 'and';
}
const kSum: Wording = { names: ['P', 'Q'], between: '+' };

export function pairText({ edgeOfP, p, q }: Pair, { names, between }: Wording = kSum): string {
  const [first, second] = edgeOfP ? ['edge', 'vertex'] : ['vertex', 'edge'];
  return `${first} ${p} of ${names[0]} ${between} ${second} ${q} of ${names[1]}`;
}

export function originText(shape: SumShape, { kind, index }: Pick<Nearest, 'kind' | 'index'>, wording: Wording = kSum): string {
  if (kind === 'edge') return pairText(leaving(shape, index), wording);
  const pair = corner(shape, index);
  if (pair) return `vertex ${pair.p} of ${wording.names[0]} ${wording.between} vertex ${pair.q} of ${wording.names[1]}`;
  return `crossing of ${pairText(arriving(shape, index), wording)} and ${pairText(leaving(shape, index), wording)}`;
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
