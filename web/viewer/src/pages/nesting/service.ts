// The no-fit polygon of B around A, and what A and B are to each other at a place.
import type { PlanarSum, Semantics, SumShape } from 'dymsum';
import type { Host } from '../../engine/host';
import { Limit } from '../../engine/limit';
import { keyOf, type Shape } from '../../engine/shape';
import { add, fromDouble, multiply, parseRational, subtract, toNumber, toText, type Rational } from '../../numbers/rational';
import type { Placement } from './state';

export interface Pair {
  a: Shape;
  b: Shape;
  semantics: Semantics;
}
export interface Placed {
  x: string;
  y: string;
  approx: { x: number; y: number };
  meeting: 'overlapping' | 'touching' | 'apart';
  /** of touching: 0; of overlapping: how far B has to move to be free; exact squares */
  distance: number;
  squared: string;
  /** the shortest such move */
  move: { x: number; y: number } | undefined;
}

function nfp(host: Host, { a, b, semantics }: Pair): PlanarSum {
  return host.keep(`nfp ${semantics} ${keyOf(a)} - ${keyOf(b)}`, () =>
    host.dymsum.nfp(host.region(a), host.region(b), { semantics, progress: host.progress }),
  );
}

type ExactPlace = [Rational, Rational];
const exact = ({ x, y }: { x: string; y: string }): ExactPlace => [parseRational(x)!, parseRational(y)!];

function checked(sum: PlanarSum, vertex: number): ExactPlace {
  if (vertex >= sum.shape().vertices.length / 2) throw new Limit('The place of B is one of another no-fit polygon.');
  return exact(sum.exact(vertex));
}

/** Touching, because it is on the boundary of the no-fit polygon. */
function fit([x, y]: ExactPlace): Placed {
  return { x: toText(x), y: toText(y), approx: { x: toNumber(x), y: toNumber(y) }, meeting: 'touching', distance: 0, squared: '0', move: undefined };
}

function atDouble(host: Host, pair: Pair, x: number, y: number, nearest: boolean): Placed {
  const depth = host.keep(`depth ${keyOf(pair.a)} ${keyOf(pair.b)}`, () => host.dymsum.PlanarDepth.create(host.region(pair.a), host.region(pair.b)));
  const { meeting, distance, squared, ways } = depth.at(x, y), way = ways[0], at: ExactPlace = [fromDouble(x), fromDouble(y)];
  if (nearest && way) {
    const [dx, dy] = exact(way.move);
    return fit([add(at[0], dx), add(at[1], dy)]);
  }
  return { x: toText(at[0]), y: toText(at[1]), approx: { x, y }, meeting, distance, squared, move: way?.approx };
}

export const nestingServices = {
  nfp: (host: Host, pair: Pair): { shape: SumShape } => ({ shape: nfp(host, pair).shape() }),
  placed: (host: Host, { at, ...pair }: Pair & { at: Placement }): Placed => {
    if (at.kind === 'free' || at.kind === 'nearest') return atDouble(host, pair, at.x, at.y, at.kind === 'nearest');
    const sum = nfp(host, pair), from = checked(sum, at.index);
    if (at.kind === 'vertex') return fit(from);
    const to = checked(sum, at.next), along = parseRational(at.along)!;
    const between = (k: 0 | 1): Rational => add(from[k], multiply(along, subtract(to[k], from[k])));
    return fit([between(0), between(1)]);
  },
  nfpFile: (host: Host, { format, ...pair }: Pair & { format: 'svg' | 'json' | 'wkt' }): string => {
    const sum = nfp(host, pair);
    if (format === 'svg') return host.dymsum.drawSum(host.region(pair.a), host.region(pair.b), sum, { p: 'A', q: 'B', sum: 'A ⊕ −B' });
    return format === 'json' ? sum.toJson() : sum.format(format);
  },
};
