// What the two pictures show: P and Q where they stand, and their sum.
import { colour } from '../../shell/theme';
import type { Overlay, OverlayLine } from '../../view3d/overlay';
import type { Placement } from '../../view3d/placement';
import { sectionLoops } from '../../view3d/section';
import type { SurfaceShape } from '../../view3d/surface';
import type { SolidDepthAnswer, Unknown } from './depth';
import { contactOf } from './faces';
import { featureVertices } from './placing';
import type { SolidFrame, SolidOperand } from './service';
import type { SolidsState, Triple } from './state';

/** Of the kinds of triangles in the picture of the sum, see kKinds. */
export const kFaceColours = ['--p-face', '--q-face', '--sum-face', '--mark-face'] as const;
export const kOperandColours = ['--p-face', '--q-face'] as const;

/** One solid as it stands. */
export interface StandingSolid {
  solid: SolidOperand;
  vertices: Float64Array;
}

/** P and Q as one surface of two kinds. */
export function operandsSurface({ solid: p, vertices: placedP }: StandingSolid, { solid: q, vertices: placedQ }: StandingSolid, placement: Placement): SurfaceShape {
  const first = placedP.length / 3, vertices = new Float64Array(placedP.length + placedQ.length);
  vertices.set(placedP);
  vertices.set(placedQ, placedP.length);
  const triangles = new Uint32Array(p.triangles.length + q.triangles.length);
  triangles.set(p.triangles);
  q.triangles.forEach((v, k) => (triangles[p.triangles.length + k] = v + first));
  const kinds = new Uint8Array(triangles.length / 3).fill(1, p.triangles.length / 3);
  const edges = Uint32Array.from([...faceEdges(p, 0), ...faceEdges(q, first)]);
  return { vertices: placement.all(vertices), triangles, kinds, edges };
}

export function aloneSurface(solid: SolidOperand, placement: Placement): SurfaceShape {
  return { vertices: placement.all(solid.vertices), triangles: solid.triangles, kinds: new Uint8Array(solid.triangles.length / 3), edges: Uint32Array.from(faceEdges(solid, 0)) };
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

function arrowsOf(depth: SolidDepthAnswer | Unknown | undefined, from: Triple, placement: Placement): Overlay['arrows'] {
  if (!depth || 'unknown' in depth || !depth.inside) return [];
  const to = from.map((x, k) => x + depth.depth * depth.direction[k]!) as unknown as Triple;
  return [{ from: placement.at(...from), to: placement.at(...to), colour: colour('--mark') }];
}

/** The features of P and Q that make a face of the sum, and the shortest way out for Q. */
export function operandsOverlay(p: StandingSolid, q: StandingSolid, placement: Placement, marked: { frame: SolidFrame; face: number } | undefined, depth: SolidDepthAnswer | Unknown | undefined, atQ: Triple): Overlay {
  const lines: OverlayLine[] = [], dots: NonNullable<Overlay['dots']>[number][] = [];
  const mark = (feature: ReturnType<typeof contactOf>['p'], { solid, vertices }: StandingSolid): void => {
    const of = featureVertices(feature, solid);
    if (of.length === 1) dots.push({ at: placement.at(...at(vertices, of[0]!)), colour: colour('--mark'), radius: 6 });
    else lines.push({ loops: [loopOf(vertices, of, placement)], closed: of.length > 2, colour: colour('--mark'), width: 4 });
  };
  if (marked) {
    const contact = contactOf(marked.frame.contacts, marked.face);
    mark(contact.p, p);
    mark(contact.q, q);
  }
  for (const standing of [p, q]) {
    lines.push(...refusedLines(standing, placement));
    dots.push(...refusedDots(standing.solid, placement));
  }
  return { lines, dots, arrows: arrowsOf(depth, atQ, placement) ?? [] };
}

/** The place that an error names. */
function refusedDots({ error }: SolidOperand, placement: Placement): NonNullable<Overlay['dots']> {
  const { x, y, z } = error?.evidence ?? {};
  return x !== undefined && y !== undefined && z !== undefined ? [{ at: placement.at(x, y, z), colour: colour('--error'), radius: 8, text: 'here' }] : [];
}

function refusedLines({ solid, vertices }: StandingSolid, placement: Placement): OverlayLine[] {
  return solid.error ? [{ loops: faceLoops(solid, vertices, placement), closed: true, colour: colour('--error'), width: 1 }] : [];
}

export function aloneOverlay(solid: SolidOperand, placement: Placement): Overlay {
  return { lines: refusedLines({ solid, vertices: solid.vertices }, placement), dots: refusedDots(solid, placement) };
}

/** Of what is refused: drawn as it stands in the file. */
function faceLoops({ faceStarts, faceVertices }: SolidOperand, vertices: Float64Array, placement: Placement): Float32Array[] {
  return Array.from({ length: faceStarts.length - 1 }, (_, f) => loopOf(vertices, faceVertices.subarray(faceStarts[f], faceStarts[f + 1]), placement));
}

export interface SumMarks {
  slice: number | null;
  face: number | undefined;
  depth: SolidDepthAnswer | Unknown | undefined;
  /** the part that is looked at */
  look: SolidsState['look'];
  /** where Q stands, in the picture of hits */
  at: Triple | undefined;
}

export function sumOverlay(frame: SolidFrame, placement: Placement, { slice, face, depth, look, at: place }: SumMarks): Overlay {
  const { vertices } = frame, tight = colour('--tight'), lines: OverlayLine[] = [];
  const each = (indices: Uint32Array, size: number): Float32Array[] =>
    Array.from({ length: indices.length / size }, (_, k) => loopOf(vertices, indices.subarray(size * k, size * (k + 1)), placement));
  lines.push({ loops: each(frame.tightTriangles, 3), closed: true, colour: 'transparent', width: 1, fill: tight.concat('80') });
  lines.push({ loops: each(frame.tightSegments, 2), closed: false, colour: tight, width: 4 });
  if (slice !== null)
    lines.push({ loops: sectionLoops(vertices, frame.triangles, slice).map((loop) => placement.all(loop)), closed: true, colour: colour('--text'), width: 2 });
  if (look) for (const [loops, closed] of boxSides(look, placement)) lines.push({ loops, closed, colour: colour('--mark'), width: 1.5, dash: [6, 4] });
  if (face !== undefined) {
    const triangles = [...frame.faceOf.keys()].filter((t) => frame.faceOf[t] === face);
    lines.push({ loops: triangles.map((t) => loopOf(vertices, frame.triangles.subarray(3 * t, 3 * t + 3), placement)), closed: true, colour: colour('--text'), width: 1.5, fill: colour('--ground').concat('99') });
  }
  const dots = [...frame.tightPoints].map((v) => ({ at: placement.at(...at(vertices, v)), colour: tight, radius: 5 }));
  if (place) dots.push({ at: placement.at(...place), colour: colour('--q'), radius: 6 });
  return { lines, dots, arrows: (place && arrowsOf(depth, place, placement)) ?? [] };
}

/** The sides of a box: its bottom and its top, and what stands between them. */
function boxSides([x0, y0, z0, x1, y1, z1]: NonNullable<SolidsState['look']>, placement: Placement): [Float32Array[], boolean][] {
  const loop = (...vertices: number[]): Float32Array => placement.all(Float64Array.from(vertices));
  const level = (z: number): Float32Array => loop(x0, y0, z, x1, y0, z, x1, y1, z, x0, y1, z);
  const upright = (x: number, y: number): Float32Array => loop(x, y, z0, x, y, z1);
  return [[[level(z0), level(z1)], true], [[upright(x0, y0), upright(x1, y0), upright(x1, y1), upright(x0, y1)], false]];
}
