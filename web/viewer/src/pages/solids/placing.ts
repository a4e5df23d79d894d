// How P, Q and their sum stand in the two pictures. Both have the same scale, and it does not follow what moves.
import type { SolidFeature } from 'dymsum';
import { parseRational, toNumber } from '../../numbers/rational';
import { boxOf, Placement, type Box } from '../../view3d/placement';
import type { SolidOperand } from './service';
import { kAxes, type SolidsState, type Triple } from './state';

/** Turned about the axis, scaled and moved: for drawing only. */
export function placedQ({ axis, angle, scale, at }: SolidsState, vertices: Float64Array): Float64Array {
  const factor = toNumber(parseRational(scale)!), [ux, uy, uz] = unit(kAxes[axis]);
  const radians = (angle * Math.PI) / 180, c = Math.cos(radians), s = Math.sin(radians);
  const out = new Float64Array(vertices.length);
  for (let k = 0; k < vertices.length; k += 3) {
    const x = factor * vertices[k]!, y = factor * vertices[k + 1]!, z = factor * vertices[k + 2]!;
    const along = (1 - c) * (ux * x + uy * y + uz * z); // Rodrigues' formula
    out[k] = c * x + s * (uy * z - uz * y) + along * ux + at[0];
    out[k + 1] = c * y + s * (uz * x - ux * z) + along * uy + at[1];
    out[k + 2] = c * z + s * (ux * y - uy * x) + along * uz + at[2];
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
