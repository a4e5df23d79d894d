// P and Q in the engine: as files say, reflected, turned and scaled.
import type { ConvexSum, Mesh, Rotation, SolidPose, SpatialSum } from 'dymsum';
import type { Host } from '../../engine/host';
import { Limit } from '../../engine/limit';
import { bytesOf, isMade, keyOf, type Shape } from '../../engine/shape';
import { toNumber, toText } from '../../numbers/rational';
import { scalesExactly } from '../../operands/exact_scaling';
import { using } from '../../operands/using';
import { radiansOf } from '../angle';
import { factorsOf } from '../scale';
import type { SolidsState } from './state';

export type SumArgs = Pick<SolidsState, 'p' | 'q' | 'thin' | 'sum' | 'semantics' | 'moving' | 'axis' | 'angle' | 'scale'>;

/** The poses of P and of Q. */
export function posesOf({ moving, axis, angle, scale }: SumArgs): [SolidPose, SolidPose] {
  const pose: SolidPose = { rotation: rotationOf(axis, angle), scale: factorsOf(scale, 3)!.map(toText) as [string, string, string] };
  return moving === 'p' ? [pose, {}] : [{}, pose];
}
/** The poses that a command goes through: none where nothing is moved, with a turn alone that of its beginning first, and the one that is shown. */
export function posesOnTheWay(args: SumArgs): [SolidPose, SolidPose][] {
  const isScaled = factorsOf(args.scale, 3)!.some((f) => f.n !== f.d), isTurned = args.angle !== 0;
  if (!isScaled && !isTurned) return [];
  return isScaled ? [posesOf(args)] : [posesOf({ ...args, angle: 0 }), posesOf(args)];
}
export function rotationOf(axis: SumArgs['axis'], degrees: number): Rotation {
  return { axis, angle: radiansOf(`${degrees}deg`) };
}

/** With parts without volume, where they are asked for. */
export function meshOf(host: Host, shape: Shape, thin: boolean): Mesh {
  if (!thin || isMade(shape)) return host.mesh(shape);
  return host.keep(`thin mesh ${keyOf(shape)}`, () => host.dymsum.Mesh.read(shape.name, bytesOf(shape), { thinParts: true }));
}
export function first(host: Host, { p, thin }: SumArgs): Mesh {
  return meshOf(host, p, thin);
}
/** Q, or −Q. */
export function second(host: Host, { q, sum, thin }: SumArgs): Mesh {
  return sum === 'sum' ? meshOf(host, q, thin) : host.keep(`negated ${thin} ${keyOf(q)}`, () => meshOf(host, q, thin).negated());
}
/** Whether there is a sum of two convex solids to be shown. */
export function hasConvexSum(host: Host, args: SumArgs): boolean {
  return args.sum !== 'fit' && isConvex(host, args);
}
export function isConvex(host: Host, { p, q, thin }: SumArgs): boolean {
  const known = (shape: Shape): { convex: boolean; dispose: () => void } =>
    host.keep(`convexity ${thin} ${keyOf(shape)}`, () => ({ convex: meshOf(host, shape, thin).convexityError() === null, dispose: () => undefined }));
  return known(p).convex && known(q).convex;
}
export function keyOfSum({ p, q, sum, thin, semantics }: SumArgs): string {
  return `${sum} ${semantics} ${thin} ${keyOf(p)} ${keyOf(q)}`;
}
/** As P and Q stand. */
export function convexOf(host: Host, args: SumArgs, purpose: string): ConvexSum {
  const sum = host.keep(`convex ${purpose} ${keyOfSum(args)}`, () => host.dymsum.ConvexSum.create(first(host, args), second(host, args)));
  sum.set(...posesOf(args));
  return sum;
}
/** A solid scaled without rounding; nothing where its coordinates would not be doubles. `visit` must not keep it. */
export function withScaled<T>(solid: Mesh, scale: string, visit: (scaled: Mesh) => T): T | undefined {
  const factors = factorsOf(scale, 3)!;
  if (factors.every((f) => f.n === f.d)) return visit(solid);
  if (!scalesExactly(solid.shape().vertices, factors)) return undefined;
  return using(solid.scaled(...(factors.map(toNumber) as [number, number, number])), visit);
}

/** The places at which Q fits into P. Throws an Error where a coordinate would have to be rounded. */
export function fitOf(host: Host, args: SumArgs): SpatialSum {
  const { p, q, thin, semantics, moving, angle, scale } = args, isP = moving === 'p', what = moving.toUpperCase();
  if (angle % 360 !== 0) throw new Limit(`The coordinates of ${what} are no doubles while it is turned, and the inner fit would not be exact.`);
  const still = meshOf(host, isP ? q : p, thin);
  const erode = (scaled: Mesh): SpatialSum =>
    host.keep(`fit ${moving} ${scale} ${keyOfSum(args)}`, () => host.dymsum.erode(isP ? scaled : still, isP ? still : scaled, { semantics, tight: true, progress: host.progress }));
  const fit = withScaled(meshOf(host, isP ? p : q, thin), scale, erode);
  if (!fit) throw new Limit(`Scaled by ${scale}, the coordinates of ${what} are no doubles, and the inner fit would not be exact. Binary fractions such as 3/4 need the fewest digits.`);
  return fit;
}
