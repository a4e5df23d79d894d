// How deep Q is in P where it stands.
import { DymsumError, type Mesh, type SolidContact } from 'dymsum';
import type { Host } from '../../engine/host';
import { keyOf } from '../../engine/shape';
import { convexOf, isConvex, meshOf, rotationOf, withScaled, type SumArgs } from './standing';

export interface SolidDepthAnswer {
  inside: boolean;
  depth: number;
  squared: string;
  /** of a shortest way out; how many there are, where that is known */
  direction: readonly [number, number, number];
  ways: number | undefined;
  /** what touches then; nothing where that is not known */
  contacts: SolidContact[] | undefined;
  /** an overlap that is less deep than this is not seen */
  within: number;
}
/** Why there is no answer. */
export interface Unknown {
  unknown: string;
}

export type Place = readonly [number, number, number];

export function depthOf(host: Host, args: SumArgs, at: Place): SolidDepthAnswer | Unknown {
  try {
    if (isConvex(host, args)) return convexDepth(host, args, at);
    return (args.angle % 360 === 0 ? stillDepth(host, args, at) : turnedDepth(host, args, at)) ?? { unknown: kNoDoubles };
  } catch (error) {
    if (!(error instanceof DymsumError) || error.code === 'cancelled') throw error;
    return { unknown: `${error.message}.` };
  }
}
const kNoDoubles = 'Scaled so, the coordinates are no doubles. Binary fractions such as 3/4 need the fewest digits.';

/** A face of a convex sum comes from two features alone, and these touch there. */
function convexDepth(host: Host, args: SumArgs, [x, y, z]: Place): SolidDepthAnswer {
  const { inside, depth, depthSquared, direction, p, q } = convexOf(host, args, 'depth').depth({ x, y, z });
  return { inside, depth, squared: depthSquared, direction: [direction.x, direction.y, direction.z], ways: undefined, contacts: [{ p, q }], within: 0 };
}

/** Of solids that do not turn: exact at any size, with all that touches. */
function stillDepth(host: Host, { p, q, thin, moving, scale }: SumArgs, at: Place): SolidDepthAnswer | undefined {
  const first = meshOf(host, p, thin), second = meshOf(host, q, thin), key = `still depth ${moving} ${scale} ${thin} ${keyOf(p)} ${keyOf(q)}`;
  const make = (scaled: Mesh) => host.keep(key, () => host.dymsum.SolidDepth.create(moving === 'p' ? scaled : first, moving === 'p' ? second : scaled));
  const found = withScaled(moving === 'p' ? first : second, scale, make)?.at(...at), way = found?.ways[0];
  if (!found) return undefined;
  const { x, y, z } = way?.direction ?? { x: 0, y: 0, z: 0 };
  return { inside: found.meeting === 'overlapping', depth: found.distance, squared: found.squared, direction: [x, y, z], ways: found.ways.length, contacts: way?.contacts, within: 0 };
}

/**
 * The engine turns the second solid. Where P turns it is the second one, Q stays, and P leaves the other way. It looks for the
 * nearest place in doubles, and what it names there is one of many features of a face of the sum, or none of a tight one:
 * nothing that touches for certain.
 */
function turnedDepth(host: Host, { p, q, thin, moving, axis, angle, scale }: SumArgs, at: Place): SolidDepthAnswer | Unknown | undefined {
  const [stays, turns] = (moving === 'q' ? [p, q] : [q, p]).map((shape) => meshOf(host, shape, thin)) as [Mesh, Mesh];
  const key = `depth ${moving} ${scale} ${thin} ${keyOf(p)} ${keyOf(q)}`, sign = moving === 'q' ? 1 : -1, [x, y, z] = at.map((c) => sign * c) as unknown as Place;
  const made = withScaled(turns, scale, (scaled) => ({ engine: host.keep(key, () => host.dymsum.TurnedDepth.create(stays, scaled)), reach: reachOf(scaled) }));
  if (!made) return undefined;
  const { inside, depth, depthSquared, direction } = made.engine.at({ x, y, z }, rotationOf(axis, angle));
  if (!inside && !/^0(\/|$)/.test(depthSquared)) return { unknown: 'They are so large that this overlap is as small as what is rounded while one of them is turned. Without a turn it is exact.' };
  const back = [direction.x, direction.y, direction.z].map((c) => sign * c) as unknown as Place, within = kTurnedError * (reachOf(stays) + made.reach + Math.hypot(...at));
  return { inside, depth, squared: depthSquared, direction: back, ways: undefined, contacts: undefined, within };
}
const kTurnedError = 2 ** -43; // of the size of what is looked at; the engine's own bound is 2^-46 of the sum's box

/** No point of it is further from the origin. */
function reachOf(mesh: Mesh): number {
  const [x0, y0, z0, x1, y1, z1] = mesh.bounds();
  return Math.hypot(Math.max(-x0, x1), Math.max(-y0, y1), Math.max(-z0, z1));
}
