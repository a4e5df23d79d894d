// What the two pictures show: P and Q where they stand, and their sum.
import { colour } from '../../shell/theme';
import type { Overlay, OverlayLine } from '../../view3d/overlay';
import type { Placement } from '../../view3d/placement';
import { sectionLoops } from '../../view3d/section';
import type { SurfaceShape } from '../../view3d/surface';
import { contactOf } from './faces';
import { featureVertices } from './placing';
import type { SolidDepthAnswer, SolidFrame, SolidOperand } from './service';
import type { Triple } from './state';

/** Of the kinds of triangles in the picture of the sum, see kKinds. */
export const kFaceColours = ['--p-face', '--q-face', '--sum-face', '--mark-face'] as const;
export const kOperandColours = ['--p-face', '--q-face'] as const;

/** P, and Q where it stands, as one surface of two kinds. */
export function operandsSurface(p: SolidOperand, q: SolidOperand, placedQ: Float64Array, placement: Placement): SurfaceShape {
  const first = p.vertices.length / 3, vertices = new Float64Array(p.vertices.length + placedQ.length);
  vertices.set(p.vertices);
  vertices.set(placedQ, p.vertices.length);
  const triangles = new Uint32Array(p.triangles.length + q.triangles.length);
  triangles.set(p.triangles);
  q.triangles.forEach((v, k) => (triangles[p.triangles.length + k] = v + first));
  const kinds = new Uint8Array(triangles.length / 3).fill(1, p.triangles.length / 3);
  const edges = Uint32Array.from([...faceEdges(p, 0), ...faceEdges(q, first)]);
  return { vertices: placement.all(vertices), triangles, kinds, edges };
}

/** The sides of faces, each from both of its faces once. */
function faceEdges({ faceStarts, faceVertices }: SolidOperand, first: number): number[] {
  const edges: number[] = [];
  for (let f = 0; f + 1 < faceStarts.length; ++f)
    for (let k = faceStarts[f]!; k < faceStarts[f + 1]!; ++k) {
      const a = faceVertices[k]!, b = faceVertices[k + 1 < faceStarts[f + 1]! ? k + 1 : faceStarts[f]!]!;
      if (a < b) edges.push(a + first, b + first);
    }
  return edges;
}

export function sumSurface(frame: SolidFrame, placement: Placement, changes: boolean): SurfaceShape {
  return { vertices: placement.all(frame.vertices), triangles: frame.triangles, kinds: changes ? frame.changedKinds : frame.kinds, edges: frame.edges };
}

function at(vertices: Float64Array, v: number): Triple {
  return [vertices[3 * v]!, vertices[3 * v + 1]!, vertices[3 * v + 2]!];
}

function loopOf(vertices: Float64Array, of: Iterable<number>, placement: Placement): Float32Array {
  return placement.all(Float64Array.from([...of].flatMap((v) => [...at(vertices, v)])));
}

function arrowsOf(depth: SolidDepthAnswer | undefined, from: Triple, placement: Placement): Overlay['arrows'] {
  if (!depth?.inside) return [];
  const to = from.map((x, k) => x + depth.depth * depth.direction[k]!) as unknown as Triple;
  return [{ from: placement.at(...from), to: placement.at(...to), colour: colour('--mark') }];
}

/** The features of P and Q that make a face of the sum, and the shortest way out for Q. */
export function operandsOverlay(p: SolidOperand, q: SolidOperand, placedQ: Float64Array, placement: Placement, marked: { frame: SolidFrame; face: number } | undefined, depth: SolidDepthAnswer | undefined, atQ: Triple): Overlay {
  const lines: OverlayLine[] = [], dots: NonNullable<Overlay['dots']>[number][] = [];
  const mark = (feature: ReturnType<typeof contactOf>['p'], operand: SolidOperand, vertices: Float64Array): void => {
    const of = featureVertices(feature, operand);
    if (of.length === 1) dots.push({ at: placement.at(...at(vertices, of[0]!)), colour: colour('--mark'), radius: 6 });
    else lines.push({ loops: [loopOf(vertices, of, placement)], closed: of.length > 2, colour: colour('--mark'), width: 4 });
  };
  if (marked) {
    const contact = contactOf(marked.frame.contacts, marked.face);
    mark(contact.p, p, p.vertices);
    mark(contact.q, q, placedQ);
  }
  for (const [operand, vertices] of [[p, p.vertices], [q, placedQ]] as const) {
    const { x, y, z } = operand.error?.evidence ?? {};
    if (x !== undefined && y !== undefined && z !== undefined) dots.push({ at: placement.at(x, y, z), colour: colour('--error'), radius: 8, text: 'here' });
    if (operand.error) lines.push({ loops: faceLoops(operand, vertices, placement), closed: true, colour: colour('--error'), width: 1 });
  }
  return { lines, dots, arrows: arrowsOf(depth, atQ, placement) ?? [] };
}

/** Of what is refused: drawn as it stands in the file. */
function faceLoops({ faceStarts, faceVertices }: SolidOperand, vertices: Float64Array, placement: Placement): Float32Array[] {
  return Array.from({ length: faceStarts.length - 1 }, (_, f) => loopOf(vertices, faceVertices.subarray(faceStarts[f], faceStarts[f + 1]), placement));
}

export interface SumMarks {
  slice: number | null;
  face: number | undefined;
  depth: SolidDepthAnswer | undefined;
  /** where Q stands, in the picture of hits */
  at: Triple | undefined;
}

export function sumOverlay(frame: SolidFrame, placement: Placement, { slice, face, depth, at: place }: SumMarks): Overlay {
  const { vertices } = frame, tight = colour('--tight'), lines: OverlayLine[] = [];
  const each = (indices: Uint32Array, size: number): Float32Array[] =>
    Array.from({ length: indices.length / size }, (_, k) => loopOf(vertices, indices.subarray(size * k, size * (k + 1)), placement));
  lines.push({ loops: each(frame.tightTriangles, 3), closed: true, colour: 'transparent', width: 1, fill: tight.concat('80') });
  lines.push({ loops: each(frame.tightSegments, 2), closed: false, colour: tight, width: 4 });
  if (slice !== null)
    lines.push({ loops: sectionLoops(vertices, frame.triangles, slice).map((loop) => placement.all(loop)), closed: true, colour: colour('--text'), width: 2 });
  if (face !== undefined) {
    const triangles = [...frame.faceOf.keys()].filter((t) => frame.faceOf[t] === face);
    lines.push({ loops: triangles.map((t) => loopOf(vertices, frame.triangles.subarray(3 * t, 3 * t + 3), placement)), closed: true, colour: colour('--text'), width: 1.5, fill: colour('--ground').concat('99') });
  }
  const dots = [...frame.tightPoints].map((v) => ({ at: placement.at(...at(vertices, v)), colour: tight, radius: 5 }));
  if (place) dots.push({ at: placement.at(...place), colour: colour('--q'), radius: 6 });
  return { lines, dots, arrows: (place && arrowsOf(depth, place, placement)) ?? [] };
}
