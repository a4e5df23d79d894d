// Sums of two regions, places at which one hits the other, and inner fits, while one of them is scaled or turned.
import type { PlanarDistance, PlanarSum, PlanarTrace, Region, RotatingSum, ScalingSum, SumOptions, SumShape } from 'dymsum';
import type { Host } from '../../engine/host';
import { Limit } from '../../engine/limit';
import { keyOf, type Shape } from '../../engine/shape';
import { toNumber, toText } from '../../numbers/rational';
import { using } from '../../operands/using';
import { scalesExactly } from '../../operands/exact_scaling';
import { angleOf, radiansOf } from '../angle';
import { factorsOf } from '../scale';
import { familyOf, familyServices, firstText, isAfter } from './families';
import type { SumState, Which } from './state';

export interface SumArgs extends Pick<SumState, 'p' | 'q' | 'shown' | 'semantics' | 'moving' | 'motion' | 'scale' | 'tanHalf'> {
  /** the scales that the slider covers, as texts */
  low: string;
  high: string;
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

const scaleTexts = (a: SumArgs): [string, string] => factorsOf(a.scale, 2)!.map(toText) as [string, string];

export function isStill(a: Pick<SumArgs, 'motion' | 'scale' | 'tanHalf'>): boolean {
  return a.motion === 'scale' ? factorsOf(a.scale, 2)!.every((f) => f.n === f.d) : radiansOf(a.tanHalf) === 0;
}

type Frame = PlanarSum | ScalingSum | RotatingSum;

function stillFrame({ dymsum }: Host, { shown }: SumArgs, p: Region, q: Region, options: SumOptions): PlanarSum {
  if (shown === 'fit') return dymsum.erode(p, q, options);
  return shown === 'hits' ? dymsum.nfp(p, q, options) : dymsum.minkowskiSum(p, q, options);
}

function frameOf(host: Host, a: SumArgs, p: Region, q: Region, mode: 'automatic' | 'rebuild'): Frame {
  const { dymsum } = host;
  if (a.shown === 'fit' || isStill(a)) return stillFrame(host, a, p, q, { semantics: a.semantics, progress: host.progress });
  const moving = { semantics: a.semantics, moving: a.moving, reflectQ: a.shown === 'hits', keptWindowBytes: kWindowBytes, mode, progress: host.progress };
  return a.motion === 'scale' ? dymsum.ScalingSum.create(p, q, moving) : dymsum.RotatingSum.create(p, q, moving);
}

function moved<F extends Frame>(frame: F, a: SumArgs): F {
  if ('orientation' in frame) frame.set(angleOf(a.tanHalf));
  else if ('set' in frame) frame.set(...scaleTexts(a));
  return frame;
}

function keyOfFrame(a: SumArgs): string {
  return `${a.shown} ${a.semantics} ${isStill(a) ? 'still' : `${a.motion} ${a.moving}`} ${keyOf(a.p)} + ${keyOf(a.q)}`;
}

/** What has the shape of the sum now: of a family where there is one. `visit` must not keep it. */
function withFrame<T>(host: Host, a: SumArgs, visit: (frame: Frame) => T): T {
  const family = familyOf(host, a);
  if (family) return using(family.at(firstText(a.scale)), visit);
  if (!a.pull && (a.shown !== 'fit' || isStill(a)))
    return visit(moved(host.keep(keyOfFrame(a), () => frameOf(host, a, host.region(a.p), host.region(a.q), 'automatic')), a));
  // Of regions that exist for one frame only nothing is kept.
  return withOperand(host, a, 'p', (p) => withOperand(host, a, 'q', (q) => using(frameOf(host, a, p, q, 'rebuild'), (frame) => visit(moved(frame, a)))));
}

/** An operand with the vertex that is pulled; for the inner fit, as it is scaled. */
function withOperand<T>(host: Host, a: SumArgs, which: Which, visit: (region: Region) => T): T {
  const scaled = (region: Region): T =>
    a.shown === 'fit' && !isStill(a) && a.moving === which ? using(exactlyScaled(region, a), visit) : visit(region);
  const { pull } = a, region = host.region(a[which]);
  return pull?.which === which ? using(region.withVertex(pull.vertex, pull.x, pull.y), scaled) : scaled(region);
}

/** Throws a Limit where a coordinate would have to be rounded. */
function exactlyScaled(region: Region, a: SumArgs): Region {
  const factors = factorsOf(a.scale, 2)!;
  if (!scalesExactly(region.shape().vertices, factors))
    throw new Limit(`Scaled by ${a.scale}, the coordinates of ${a.moving.toUpperCase()} are no doubles, and the inner fit would not be exact. Binary fractions such as 3/4 need the fewest digits.`);
  return region.scaled(...(factors.map(toNumber) as [number, number]));
}

/** The sum now as an object that can be asked for more. `visit` must not keep it. */
function withSum<T>(host: Host, a: SumArgs, visit: (sum: PlanarSum) => T): T {
  return withFrame(host, { ...a, pull: undefined }, (frame) => ('sum' in frame ? using(frame.sum(), visit) : visit(frame)));
}

/** An operand as it stands now, rounded: to be drawn with the sum. `visit` must not keep it. */
function withPlaced<T>(host: Host, a: SumArgs, which: Which, visit: (region: Region) => T): T {
  const region = host.region(a[which]);
  if (isStill(a) || a.moving !== which) return visit(region);
  const [sx, sy] = factorsOf(a.scale, 2)!.map(toNumber) as [number, number];
  return using(a.motion === 'scale' ? region.scaled(sx, sy) : turned(host, region, a.tanHalf), visit);
}

function turned({ dymsum }: Host, region: Region, tanHalf: string): Region {
  return using(dymsum.Region.fromData({ parts: [], points: [[0, 0]] }), (origin) => using(dymsum.rotatedSum(region, origin, angleOf(tanHalf)), (sum) => sum.rounded()));
}

function trace(host: Host, a: SumArgs): PlanarTrace | null {
  const options = { semantics: a.semantics, trace: true, progress: host.progress };
  return withPlaced(host, a, 'p', (p) => withPlaced(host, a, 'q', (q) => using(stillFrame(host, a, p, q, options), (sum) => sum.trace())));
}

export type SumFormat = 'svg' | 'json' | 'wkt' | 'geojson' | 'poly';

function file(host: Host, a: SumArgs, format: SumFormat): string {
  return withSum(host, a, (sum) => {
    if (format === 'json') return sum.toJson();
    if (format !== 'svg') return sum.format(format);
    const names = { sum: a.shown === 'sum' ? 'P ⊕ Q' : a.shown === 'hits' ? 'P ⊕ −Q' : 'P ⊖ Q' };
    return withPlaced(host, a, 'p', (p) => withPlaced(host, a, 'q', (q) => host.dymsum.drawSum(p, q, sum, names)));
  });
}

/** The next visible event after a scale, of the family where there is one. */
function nextEvent(host: Host, a: SumArgs, after: string): Event | null {
  const family = familyOf(host, { ...a, motion: 'scale', scale: after });
  if (family) return family.changes(after, a.high).find(({ s }) => isAfter(s, after)) ?? null;
  const moving: SumArgs = { ...a, motion: 'scale', pull: undefined, scale: '2' }; // not 1, which stands still
  const frame = host.keep(keyOfFrame(moving), () => frameOf(host, moving, host.region(a.p), host.region(a.q), 'automatic'));
  return (frame as ScalingSum).nextEvent(after, a.high, 'visible', host.progress);
}

export const sumServices = {
  sumFrame: (host: Host, a: SumArgs): SumFrame => {
    const start = performance.now();
    return withFrame(host, a, (frame) => ({ shape: frame.shape(), ms: performance.now() - start }));
  },
  sumArea: (host: Host, a: SumArgs): SumArea => withSum(host, a, (sum) => ({ decimal: sum.areaText(), exact: sum.areaExact(kAreaBits) })),
  sumExact: (host: Host, { vertices, ...a }: SumArgs & { vertices: number[] }) => withSum(host, a, (sum) => vertices.map((v) => sum.exact(v))),
  sumTrace: trace,
  sumFile: (host: Host, { format, ...a }: SumArgs & { format: SumFormat }) => file(host, a, format),
  /** How deep Q is in P, or how far from it, where both have their own size and angle. */
  sumDepth: (host: Host, { p, q, x, y }: Pick<SumArgs, 'p' | 'q'> & { x: number; y: number }): PlanarDistance =>
    host.keep(`depth ${keyOf(p)} ${keyOf(q)}`, () => host.dymsum.PlanarDepth.create(host.region(p), host.region(q))).at(x, y),
  /** The text of an operand with a vertex moved. */
  pulledText: (host: Host, { shape, vertex, x, y }: { shape: Shape; vertex: number; x: number; y: number }): string =>
    using(host.region(shape).withVertex(vertex, x, y), (pulled) => pulled.format('wkt')),
  nextScaleEvent: (host: Host, { after, ...a }: SumArgs & { after: string }): Event | null => nextEvent(host, a, after),
  ...familyServices,
};
