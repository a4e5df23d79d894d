// What a growing disc makes and sees of a region.
import { DymsumError, type AlphaBridge, type Decomposition, type DiscSet, type DiscShape, type FeatureBar, type GrowingDisc, type Measured, type Region, type Semantics, type ShapeFeatures } from 'dymsum';
import type { Host } from '../../engine/host';
import { keyOf, type Shape } from '../../engine/shape';
import { multiply, parseRational, rational, toText } from '../../numbers/rational';
import { using } from '../../operands/using';
import type { Concavity, Operation } from './state';

export interface DiscArgs {
  shape: Shape;
  operation: Operation;
  semantics: Semantics;
  alpha: string;
  event: number | null;
}
/** What bars are found, and how deep their pockets are. */
export interface FeatureArgs {
  shape: Shape;
  concavity: Concavity;
  hybridTolerance: number;
}
export interface DiscAnswer {
  set: DiscShape;
  area: Measured;
  perimeter: Measured;
}

function growing(host: Host, shape: Shape): GrowingDisc {
  return host.keep(`disc ${keyOf(shape)}`, () => host.dymsum.GrowingDisc.create(host.region(shape)));
}
function features(host: Host, { shape, ...options }: FeatureArgs): ShapeFeatures {
  return host.keep(`features ${options.concavity} ${options.hybridTolerance} ${keyOf(shape)}`, () => host.dymsum.ShapeFeatures.create(host.region(shape), { ...options, progress: host.progress }));
}
const sideOf = (operation: Operation) => (operation === 'sum' || operation === 'closed' ? 'outside' : 'inside');

function withSet<T>(host: Host, { shape, operation, semantics, alpha, event }: DiscArgs, visit: (set: DiscSet) => T): T {
  const disc = growing(host, shape), radius = event === null ? toText(multiply(parseRational(alpha)!, rational(1n, 2n))) : { event };
  return using(disc[`${operation}At`](radius, semantics), visit);
}

const isCrossed = (error: unknown): boolean => error instanceof DymsumError && error.code === 'rounding_changed_topology';

/** The polygons of `dymsum disc -o`: within a 1000th of the radius and inside the set; where those cross each other, nearest to it, within less where need be. */
function polygonsOf(set: DiscSet): Region {
  const { radius, atError } = set.shape(), error = radius > 0 ? Math.max(radius / 1000, 8 * atError) : 1;
  try {
    return set.toRegion(error, 'inside').region;
  } catch (refusal) {
    if (!isCrossed(refusal)) throw refusal;
    for (let within = error; ; within /= 16)
      try {
        return set.toRegion(within, 'nearest').region;
      } catch (other) {
        if (!isCrossed(other)) throw refusal;
      }
  }
}

export const discServices = {
  discSet: (host: Host, args: DiscArgs): DiscAnswer => withSet(host, args, (set) => ({ set: set.shape(), area: set.area(), perimeter: set.perimeter() })),
  /** Radii of all events, in order. */
  discEvents: (host: Host, { shape, operation }: Pick<DiscArgs, 'shape' | 'operation'>): Float64Array =>
    Float64Array.from(growing(host, shape).events(sideOf(operation), host.progress), (e) => e.radius),
  discFile: (host: Host, { format, ...args }: DiscArgs & { format: 'svg' | 'json' | 'wkt' }): string =>
    withSet(host, args, (set) => {
      if (format === 'svg') return set.svg(host.region(args.shape));
      return format === 'json' ? set.toJson() : using(polygonsOf(set), (region) => region.format('wkt'));
    }),
  bars: (host: Host, of: FeatureArgs): FeatureBar[] => features(host, of).bars(),
  /** The diameters at which a bar begins and ends, as formulas. */
  barTexts: (host: Host, { birth, death, ...of }: FeatureArgs & { birth: number; death: number | null }): { birth: string; death: string } => {
    const all = features(host, of);
    return { birth: all.eventText(birth), death: death === null ? 'never' : all.eventText(death) };
  },
  bridges: (host: Host, { alpha, ...of }: FeatureArgs & { alpha: string }): AlphaBridge[] => features(host, of).bridges(alpha),
  cuts: (host: Host, { persistence, alphaFrom, alphaTo, ...of }: FeatureArgs & { persistence: string; alphaFrom: string; alphaTo: string }): Decomposition =>
    features(host, of).decompose({ persistence, alphaFrom, ...(alphaTo === '' ? {} : { alphaTo }), progress: host.progress }),
};
