// Draws a region, what a disc makes of it, the bridges of the disc, and cuts.
import type { AlphaBridge, Decomposition, DiscPiece, DiscShape } from 'dymsum';
import type { Outline } from '../../operands/outline';
import { colour } from '../../shell/theme';
import type { Point } from '../../view2d/camera';
import type { Painter } from '../../view2d/painter';

export interface DiscScene {
  outline: Outline | undefined;
  set: DiscShape | undefined;
  bridges: readonly AlphaBridge[];
  cuts: Decomposition | undefined;
  /** vertices of the region that the chosen bar is about */
  marked: readonly number[];
  wrong: readonly Point[];
}

/** Adds a ring of segments and arcs to the path. Angles run the other way on the screen. */
function addRing(painter: Painter, pieces: readonly DiscPiece[], radius: number): void {
  const ctx = painter.canvas, first = pieces[0];
  if (!first) return;
  const start = painter.at(first);
  ctx.moveTo(start.x, start.y);
  pieces.forEach((piece, k) => {
    const next = pieces[(k + 1) % pieces.length]!;
    if (piece.arc) {
      const { cx, cy, fromAngle, sweep } = piece.arc, centre = painter.at({ x: cx, y: cy });
      ctx.arc(centre.x, centre.y, radius * painter.camera.zoom, -fromAngle, -(fromAngle + sweep), sweep > 0);
    } else {
      const to = painter.at(next);
      ctx.lineTo(to.x, to.y);
    }
  });
  ctx.closePath();
}

function paintSet(painter: Painter, set: DiscShape): void {
  const ctx = painter.canvas, tight = colour('--tight'), ground = colour('--ground');
  ctx.beginPath();
  for (const part of set.parts) for (const ring of [part.outer, ...part.holes]) addRing(painter, ring, set.radius);
  ctx.fillStyle = colour('--sum-fill');
  ctx.fill('evenodd');
  painter.line({ colour: colour('--sum'), width: 2 });
  painter.segments(set.segments, { colour: colour('--sum'), width: 2 });
  painter.segments(set.tightSegments, { colour: tight, width: 6 });
  painter.segments(set.tightSegments, { colour: ground, width: 2.5, dash: [1, 5] });
  for (let k = 0; k < set.points.length; k += 2) painter.dot({ x: set.points[k]!, y: set.points[k + 1]! }, 3.5, colour('--sum'));
  for (let k = 0; k < set.tightPoints.length; k += 2) painter.diamond({ x: set.tightPoints[k]!, y: set.tightPoints[k + 1]! }, 6.5, tight, ground);
}

const kPieceTints = ['#e69f0055', '#56b4e955', '#009e7355', '#f0e44255', '#cc79a755', '#0072b255'];

function paintCuts(painter: Painter, { pieces, colours, cuts }: Decomposition): void {
  for (let i = 0; i + 1 < pieces.partStarts.length; ++i) {
    const starts = pieces.ringStarts.subarray(pieces.partStarts[i], pieces.partStarts[i + 1]! + 1);
    painter.fill({ vertices: pieces.vertices, starts }, kPieceTints[colours[i]!]!);
  }
  for (const { runs } of cuts) painter.segments(runs, { colour: colour('--cut'), width: 2.5, dash: [7, 4] });
}

function paintBridges(painter: Painter, bridges: readonly AlphaBridge[], radius: number): void {
  const ctx = painter.canvas, zoom = painter.camera.zoom;
  for (const { from, to, centre, gap } of bridges) {
    const { x, y } = painter.at(centre);
    ctx.beginPath();
    ctx.arc(x, y, radius * zoom, 0, 2 * Math.PI);
    painter.line({ colour: colour('--faint'), width: 1 });
    painter.segments([from.x, from.y, to.x, to.y], { colour: colour('--mark'), width: 2, ...(gap ? { dash: [4, 4] } : {}) });
    painter.dot(from, 2.5, colour('--mark'));
    painter.dot(to, 2.5, colour('--mark'));
  }
}

export function paintDiscs(painter: Painter, scene: DiscScene, radius: number): void {
  if (scene.set) paintSet(painter, scene.set);
  scene.outline?.paint(painter, scene.cuts ? 'transparent' : colour('--p-fill'), { colour: colour('--p'), width: 1.5 });
  if (scene.cuts) paintCuts(painter, scene.cuts);
  paintBridges(painter, scene.bridges, radius);
  if (scene.outline) for (const k of scene.marked) painter.dot(scene.outline.vertex(k), 5.5, colour('--mark'), colour('--ground'));
  for (const place of scene.wrong) painter.wrong(place, colour('--error'));
}
