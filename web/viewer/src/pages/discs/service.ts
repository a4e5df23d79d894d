// What a growing disc makes and sees of a region.
import type { AlphaBridge, Decomposition, DiscSet, DiscShape, FeatureBar, GrowingDisc, Measured, ShapeFeatures } from 'dymsum';
import type { Host } from '../../engine/host';
import { keyOf, type Shape } from '../../engine/shape';
import { multiply, parseRational, rational, toText } from '../../numbers/rational';
import type { Operation } from './state';

export interface DiscArgs {
  shape: Shape;
  operation: Operation;
  alpha: string;
  event: number | null;
}
export interface DiscAnswer {
  set: DiscShape;
  area: Measured;
  perimeter: Measured;
}

function growing(host: Host, shape: Shape): GrowingDisc {
  return host.keep(`disc ${keyOf(shape)}`, () => host.dymsum.GrowingDisc.create(host.region(shape)));
}
function features(host: Host, shape: Shape): ShapeFeatures {
  return host.keep(`features ${keyOf(shape)}`, () => host.dymsum.ShapeFeatures.create(host.region(shape), { progress: host.progress }));
}
const sideOf = (operation: Operation) => (operation === 'sum' || operation === 'closed' ? 'outside' : 'inside');

function withSet<T>(host: Host, { shape, operation, alpha, event }: DiscArgs, visit: (set: DiscSet) => T): T {
  const disc = growing(host, shape), radius = event === null ? toText(multiply(parseRational(alpha)!, rational(1n, 2n))) : { event };
  const semantics = operation === 'sum' ? 'open' : 'closed';
  const set = disc[`${operation}At`](radius, semantics);
  try {
    return visit(set);
  } finally {
    set.dispose();
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
      if (format === 'json') return set.toJson();
      const [x0, y0, x1, y1] = set.bounds(), { region } = set.toRegion(Math.max(x1 - x0, y1 - y0) * 1e-4, 'nearest');
      const text = region.format('wkt');
      region.dispose();
      return text;
    }),
  bars: (host: Host, { shape }: { shape: Shape }): FeatureBar[] => features(host, shape).bars(),
  /** The diameters at which a bar begins and ends, as formulas. */
  barTexts: (host: Host, { shape, birth, death }: { shape: Shape; birth: number; death: number | null }): { birth: string; death: string } => {
    const all = features(host, shape);
    return { birth: all.eventText(birth), death: death === null ? 'never' : all.eventText(death) };
  },
  bridges: (host: Host, { shape, alpha }: { shape: Shape; alpha: string }): AlphaBridge[] => features(host, shape).bridges(alpha),
  cuts: (host: Host, { shape, persistence }: { shape: Shape; persistence: string }): Decomposition =>
    features(host, shape).decompose({ persistence, progress: host.progress }),
};
