// How P, Q and their sum stand in the two pictures. Both have the same scale, and it does not follow what moves.
import type { SolidFeature } from 'dymsum';
import { toNumber } from '../../numbers/rational';
import { boxOf, Placement, type Box } from '../../view3d/placement';
import { factorsOf } from '../scale';
import type { SolidOperand } from './service';
import type { SolidsState, Triple } from './state';

type Placed = Pick<SolidsState, 'moving' | 'axis' | 'angle' | 'scale' | 'at'>;

/** Scaled, turned about the axis and moved, as far as that is the operand's: for drawing only. */
export function placed(state: Placed, which: 'p' | 'q', vertices: Float64Array): Float64Array {
  const own = state.moving === which ? moved(state, vertices) : vertices;
  return which === 'q' ? own.map((x, k) => x + state.at[k % 3]!) : own;
}

function moved({ axis, angle, scale }: Placed, vertices: Float64Array): Float64Array {
  const [sx, sy, sz] = factorsOf(scale, 3)!.map(toNumber) as unknown as Triple, [ux, uy, uz] = unit(axis);
  const radians = (angle * Math.PI) / 180, c = Math.cos(radians), s = Math.sin(radians);
  const out = new Float64Array(vertices.length);
  for (let k = 0; k < vertices.length; k += 3) {
    const x = sx * vertices[k]!, y = sy * vertices[k + 1]!, z = sz * vertices[k + 2]!;
    const along = (1 - c) * (ux * x + uy * y + uz * z); // Rodrigues' formula
    out[k] = c * x + s * (uy * z - uz * y) + along * ux;
    out[k + 1] = c * y + s * (uz * x - ux * z) + along * uy;
    out[k + 2] = c * z + s * (ux * y - uy * x) + along * uz;
  }
  return out;
}

function unit([x, y, z]: Triple): Triple {
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

/** Room for P and for Q beside it on every side. */
export function placementOf(p: SolidOperand, q: SolidOperand): Placement {
  const box = boxOf(p.vertices), reach = furthest(q.vertices);
  return Placement.of(box.map((x, k) => (k < 3 ? x - reach : x + reach)) as unknown as Box);
}

const kRoom = 0.6; // of its size, on every side

/** A part that is looked at, with room around it. */
export function placementOfPart(box: Box): Placement {
  return Placement.of(box.map((x, k) => x + (k < 3 ? -kRoom : kRoom) * (box[(k % 3) + 3]! - box[k % 3]!)) as unknown as Box);
}

function furthest(vertices: Float64Array): number {
  let most = 0;
  for (let k = 0; k < vertices.length; k += 3) most = Math.max(most, Math.hypot(vertices[k]!, vertices[k + 1]!, vertices[k + 2]!));
  return most;
}

/** The vertices of a feature: one, two, or around a face. */
export function featureVertices({ kind, a, b }: SolidFeature, { faceStarts, faceVertices }: SolidOperand): number[] {
  if (kind === 'vertex') return [a];
  return kind === 'edge' ? [a, b] : [...faceVertices.subarray(faceStarts[a], faceStarts[a + 1])];
}
