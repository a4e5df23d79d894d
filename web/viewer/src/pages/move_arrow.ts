// The shortest move that makes two shapes touch, as an arrow.
import { colour } from '../shell/theme';
import type { Point } from '../view2d/camera';
import type { Painter } from '../view2d/painter';

/** Nothing for a move that is too short to be seen. */
export function paintMove(painter: Painter, from: Point, move: Point): void {
  const tip = painter.at({ x: from.x + move.x, y: from.y + move.y }), start = painter.at(from), ctx = painter.canvas;
  const length = Math.hypot(tip.x - start.x, tip.y - start.y);
  if (length < 3) return;
  const style = { colour: colour('--mark'), width: 2 };
  painter.segments([from.x, from.y, from.x + move.x, from.y + move.y], style);
  const ux = (tip.x - start.x) / length, uy = (tip.y - start.y) / length;
  ctx.beginPath();
  ctx.moveTo(tip.x - 8 * ux + 4 * uy, tip.y - 8 * uy - 4 * ux);
  ctx.lineTo(tip.x, tip.y);
  ctx.lineTo(tip.x - 8 * ux - 4 * uy, tip.y - 8 * uy + 4 * ux);
  painter.line(style);
}
