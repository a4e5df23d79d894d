// Draws P, Q, their sum, the stages that lead to it, and what is pointed at.
import type { PlanarTrace } from 'dymsum';
import type { Outline } from '../../operands/outline';
import { colour } from '../../shell/theme';
import { applied, type Affine } from '../../view2d/affine';
import type { Point } from '../../view2d/camera';
import type { Nearest } from '../../view2d/edge_grid';
import type { Painter } from '../../view2d/painter';
import type { SumPicture } from '../../view2d/sum_shape';
import { paintMove } from '../move_arrow';
import type { Alive } from './living';
import { features } from './provenance';
import type { Layer, SumState } from './state';

export interface SumScene {
  layers: readonly Layer[];
  p: Outline | undefined;
  q: Outline | undefined;
  byP: Affine;
  byQ: Affine;
  sum: SumPicture | undefined;
  bySum: Affine;
  trace: PlanarTrace | undefined;
  /** of the sum, pointed at or picked */
  marked: readonly Nearest[];
  /** what a bar of the lifetimes stands for */
  alive: Alive;
  /** the shortest move of Q that makes it touch P */
  way: { from: Point; by: Point } | undefined;
  /** the part that is looked at */
  look: SumState['look'];
  /** an operand's vertex that is pulled, where it is now */
  pulled: Point | undefined;
  /** places that errors name */
  wrong: readonly Point[];
}

function paintCells(painter: Painter, cells: Float64Array, by: Affine): void {
  painter.canvas.fillStyle = colour('--hover');
  for (let k = 0; k < cells.length; k += 4) {
    const low = painter.at({ x: cells[k]! + by.e, y: cells[k + 1]! + by.f }), high = painter.at({ x: cells[k + 2]! + by.e, y: cells[k + 3]! + by.f });
    painter.canvas.fillRect(low.x, high.y, high.x - low.x - 1, low.y - high.y - 1);
  }
}

function convolutionOf(trace: PlanarTrace, ofP: boolean): Float64Array {
  const chosen: number[] = [];
  trace.convolutionEdgeOfP.forEach((flag, k) => {
    if ((flag === 1) === ofP) chosen.push(...trace.convolution.subarray(4 * k, 4 * k + 4));
  });
  return Float64Array.from(chosen);
}

function paintStages(painter: Painter, { trace, layers, bySum }: SumScene): void {
  if (!trace) return;
  if (layers.includes('cells')) paintCells(painter, trace.maskedCells, bySum);
  if (layers.includes('convolution')) {
    painter.segments(convolutionOf(trace, true), { colour: colour('--p'), width: 1 }, bySum);
    painter.segments(convolutionOf(trace, false), { colour: colour('--q'), width: 1, dash: [5, 3] }, bySum);
  }
  if (layers.includes('dropped')) {
    painter.trace(trace.droppedLoops, bySum);
    painter.line({ colour: colour('--mark'), width: 1.5, dash: [2, 4] });
  }
  if (layers.includes('crossings'))
    for (let k = 0; k < trace.crossings.length; k += 2)
      painter.cross(applied(bySum, { x: trace.crossings[k]!, y: trace.crossings[k + 1]! }), 2.5, { colour: colour('--quiet'), width: 1 });
}

function paintOperand(painter: Painter, outline: Outline | undefined, tint: string, by: Affine): void {
  outline?.paint(painter, colour(`--${tint}-fill`), { colour: colour(`--${tint}`), width: 1.5 }, by);
  const origin = { x: by.e, y: by.f };
  painter.cross(origin, 4, { colour: colour(`--${tint}`), width: 1.5 });
}

function paintFeatures(painter: Painter, outline: Outline | undefined, by: Affine, edges: number[], vertices: number[]): void {
  if (!outline) return;
  const mark = colour('--mark');
  for (const k of edges) {
    const a = outline.vertex(k), b = outline.vertex(outline.next(k));
    painter.segments([a.x, a.y, b.x, b.y], { colour: mark, width: 4 }, by);
  }
  for (const k of vertices) painter.dot(applied(by, outline.vertex(k)), 4.5, mark, colour('--ground'));
}

function paintMarked(painter: Painter, scene: SumScene, place: Nearest): void {
  const { sum, p, q } = scene;
  if (!sum) return;
  const mark = colour('--mark'), at = sum.vertex(place.index), next = sum.vertex(place.next);
  if (place.kind === 'edge') painter.segments([at.x, at.y, next.x, next.y], { colour: mark, width: 4 }, scene.bySum);
  else painter.dot(applied(scene.bySum, at), 5, mark, colour('--ground'));
  const from = features(sum.shape, place);
  if (scene.layers.includes('p')) paintFeatures(painter, p, scene.byP, from.edgesP, from.verticesP);
  if (scene.layers.includes('q')) paintFeatures(painter, q, scene.byQ, from.edgesQ, from.verticesQ);
}

function paintAlive(painter: Painter, { sum, alive: { vertices, edges, ring }, bySum }: SumScene): void {
  if (!sum) return;
  const mark = colour('--mark'), ends = edges.flatMap(([from, to]) => [sum.vertex(from), sum.vertex(to)].flatMap(({ x, y }) => [x, y]));
  painter.segments(ends, { colour: mark, width: 4 }, bySum);
  for (const k of vertices) painter.dot(applied(bySum, sum.vertex(k)), 5, mark, colour('--ground'));
  if (ring === undefined) return;
  painter.trace({ vertices: sum.rings.vertices, starts: sum.rings.starts.subarray(ring, ring + 2) }, bySum);
  painter.line({ colour: mark, width: 4 });
}

function paintLook(painter: Painter, [x0, y0, x1, y1]: NonNullable<SumState['look']>): void {
  painter.trace({ vertices: Float64Array.of(x0, y0, x1, y0, x1, y1, x0, y1), starts: Uint32Array.of(0, 4) });
  painter.line({ colour: colour('--mark'), width: 1.5, dash: [6, 4] });
}

export function paintSum(painter: Painter, scene: SumScene): void {
  const { layers, sum, bySum } = scene;
  if (sum && layers.includes('sum')) sum.paint(painter, bySum);
  paintStages(painter, scene);
  if (layers.includes('p')) paintOperand(painter, scene.p, 'p', scene.byP);
  if (layers.includes('q')) paintOperand(painter, scene.q, 'q', scene.byQ);
  if (sum && layers.includes('tight')) sum.paintTight(painter, bySum);
  if (scene.look) paintLook(painter, scene.look);
  if (scene.way) paintMove(painter, scene.way.from, scene.way.by);
  paintAlive(painter, scene);
  for (const place of scene.marked) paintMarked(painter, scene, place);
  if (scene.pulled) painter.dot(scene.pulled, 5.5, colour('--mark'), colour('--ground'));
  for (const place of scene.wrong) painter.wrong(place, colour('--error'));
}
