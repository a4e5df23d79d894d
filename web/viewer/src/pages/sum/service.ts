// Sums of two regions of which one is scaled or turned.
import type { PlanarSum, PlanarTrace, Region, ScalingSum, SumShape } from 'dymsum';
import type { Host } from '../../engine/host';
import { keyOf, type Shape } from '../../engine/shape';
import type { SumState, Which } from './state';

export interface SumArgs extends Pick<SumState, 'p' | 'q' | 'moving' | 'motion' | 'scale' | 'tanHalf'> {
  /** a vertex that is somewhere else for now */
  pull?: { which: Which; vertex: number; x: number; y: number } | undefined;
}
export interface SumFrame {
  shape: SumShape;
  /** of the computation, in milliseconds */
  ms: number;
}
export interface SumArea {
  decimal: string;
  /** nothing where the fraction is very long */
  exact: string | null;
}
export interface Event {
  s: string;
  approx: number;
  visible: boolean;
  topology: boolean;
}

const kAreaBits = 1 << 15;
const kWindowBytes = 16 << 20; // of each of the sums that are kept

const isStill = (a: SumArgs): boolean => (a.motion === 'scale' ? Number(a.scale) === 1 : Number(a.tanHalf) === 0);
const operandsKey = (a: SumArgs): string => `${a.moving} ${keyOf(a.p)} + ${keyOf(a.q)}`;

function scaling(host: Host, a: SumArgs): ScalingSum {
  return host.keep(`scaling ${operandsKey(a)}`, () =>
    host.dymsum.ScalingSum.create(host.region(a.p), host.region(a.q), { moving: a.moving, keptWindowBytes: kWindowBytes, progress: host.progress }),
  );
}

/** What has the shape of the sum now. `visit` must not keep it. */
function withFrame<T>(host: Host, a: SumArgs, visit: (frame: { shape(): SumShape; sum?: () => PlanarSum }) => T): T {
  if (a.pull) return withPulled(host, a, a.pull, visit);
  if (isStill(a))
    return visit(host.keep(`sum ${keyOf(a.p)} + ${keyOf(a.q)}`, () => host.dymsum.minkowskiSum(host.region(a.p), host.region(a.q), { progress: host.progress })));
  if (a.motion === 'scale') {
    const sum = scaling(host, a);
    sum.set(a.scale);
    return visit(sum);
  }
  const sum = host.keep(`turning ${operandsKey(a)}`, () =>
    host.dymsum.RotatingSum.create(host.region(a.p), host.region(a.q), { moving: a.moving, keptWindowBytes: kWindowBytes, progress: host.progress }),
  );
  sum.set({ tanHalf: a.tanHalf });
  return visit(sum);
}

/** Sums of a region that exists for one frame only: nothing of it is kept. */
function withPulled<T>(host: Host, a: SumArgs, pull: NonNullable<SumArgs['pull']>, visit: (frame: { shape(): SumShape }) => T): T {
  const { dymsum } = host, pulled = host.region(a[pull.which]).withVertex(pull.vertex, pull.x, pull.y);
  const p = pull.which === 'p' ? pulled : host.region(a.p), q = pull.which === 'q' ? pulled : host.region(a.q);
  try {
    const sum = isStill(a)
      ? dymsum.minkowskiSum(p, q)
      : a.motion === 'scale'
        ? dymsum.ScalingSum.create(p, q, { moving: a.moving, mode: 'rebuild' })
        : dymsum.RotatingSum.create(p, q, { moving: a.moving, mode: 'rebuild' });
    try {
      if ('set' in sum) (sum.set as (to: unknown) => unknown)(a.motion === 'scale' ? a.scale : { tanHalf: a.tanHalf });
      return visit(sum);
    } finally {
      sum.dispose();
    }
  } finally {
    pulled.dispose();
  }
}

/** The sum now as an object that can be asked for more. `visit` must not keep it. */
function withSum<T>(host: Host, a: SumArgs, visit: (sum: PlanarSum) => T): T {
  return withFrame(host, { ...a, pull: undefined }, (frame) => {
    if (!frame.sum) return visit(frame as PlanarSum);
    const sum = frame.sum();
    try {
      return visit(sum);
    } finally {
      sum.dispose();
    }
  });
}

/** An operand as it stands now, rounded: to be drawn with the sum. `visit` must not keep it. */
function withPlaced<T>(host: Host, a: SumArgs, which: Which, visit: (region: Region) => T): T {
  const region = host.region(a[which]);
  if (isStill(a) || a.moving !== which) return visit(region);
  const made = a.motion === 'scale' ? region.scaled(evaluated(a.scale), evaluated(a.scale)) : turned(host, region, a.tanHalf);
  try {
    return visit(made);
  } finally {
    made.dispose();
  }
}

function evaluated(text: string): number {
  const [n, d = '1'] = text.split('/');
  return Number(n) / Number(d);
}

function turned(host: Host, region: Region, tanHalf: string): Region {
  const origin = host.dymsum.Region.fromData({ parts: [], points: [[0, 0]] });
  const sum = host.dymsum.rotatedSum(region, origin, { tanHalf });
  try {
    return sum.rounded();
  } finally {
    sum.dispose();
    origin.dispose();
  }
}

function trace(host: Host, a: SumArgs): PlanarTrace | null {
  return withPlaced(host, a, 'p', (p) =>
    withPlaced(host, a, 'q', (q) => {
      const sum = host.dymsum.minkowskiSum(p, q, { trace: true, progress: host.progress });
      try {
        return sum.trace();
      } finally {
        sum.dispose();
      }
    }),
  );
}

function file(host: Host, a: SumArgs, format: 'svg' | 'json' | 'wkt' | 'geojson' | 'poly'): string {
  return withSum(host, a, (sum) => {
    if (format === 'json') return sum.toJson();
    if (format !== 'svg') return sum.format(format);
    return withPlaced(host, a, 'p', (p) => withPlaced(host, a, 'q', (q) => host.dymsum.drawSum(p, q, sum)));
  });
}

export const sumServices = {
  sumFrame: (host: Host, a: SumArgs): SumFrame => {
    const start = performance.now();
    return withFrame(host, a, (frame) => ({ shape: frame.shape(), ms: performance.now() - start }));
  },
  sumArea: (host: Host, a: SumArgs): SumArea => withSum(host, a, (sum) => ({ decimal: sum.areaText(), exact: sum.areaExact(kAreaBits) })),
  sumExact: (host: Host, { vertices, ...a }: SumArgs & { vertices: number[] }) => withSum(host, a, (sum) => vertices.map((v) => sum.exact(v))),
  sumTrace: trace,
  sumFile: (host: Host, { format, ...a }: SumArgs & { format: 'svg' | 'json' | 'wkt' | 'geojson' | 'poly' }) => file(host, a, format),
  /** The text of an operand with a vertex moved. */
  pulledText: (host: Host, { shape, vertex, x, y }: { shape: Shape; vertex: number; x: number; y: number }): string => {
    const pulled = host.region(shape).withVertex(vertex, x, y);
    try {
      return pulled.format('wkt');
    } finally {
      pulled.dispose();
    }
  },
  scaleEvents: (host: Host, { from, to, ...a }: SumArgs & { from: string; to: string }): Event[] => scaling(host, a).events(from, to, host.progress),
  nextScaleEvent: (host: Host, { after, limit, ...a }: SumArgs & { after: string; limit: string }): Event | null =>
    scaling(host, a).nextEvent(after, limit, 'visible', host.progress),
};
