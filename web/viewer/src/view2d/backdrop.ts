// The plane behind the shapes: a grid at round numbers, the axes, and a scale bar.
import { short } from '../numbers/display';
import { colour } from '../shell/theme';
import { toPlane, type Point } from './camera';
import type { Painter } from './painter';

const kGridPixels = 90;

/** 1, 2 or 5 times a power of ten, at least `least`. */
function roundStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5].find((f) => f * power >= least) ?? 10);
}

export function paintBackdrop(painter: Painter): void {
  const { camera, size, canvas } = painter;
  const step = roundStep(kGridPixels / camera.zoom);
  const low = toPlane(camera, size, { x: 0, y: size.height }), high = toPlane(camera, size, { x: size.width, y: 0 });
  const paintLines = (from: number, to: number, line: (at: number) => [Point, Point]): void => {
    for (const axis of [false, true]) {
      const ends: number[] = [];
      for (let i = Math.ceil(from / step); i * step <= to; ++i)
        if ((i === 0) === axis) ends.push(...line(i * step).flatMap((p) => [p.x, p.y]));
      painter.segments(ends, { colour: colour(axis ? '--axis' : '--grid'), width: 1 });
    }
  };
  paintLines(low.x, high.x, (x) => [{ x, y: low.y }, { x, y: high.y }]);
  paintLines(low.y, high.y, (y) => [{ x: low.x, y }, { x: high.x, y }]);
  paintScaleBar(painter, step);
  canvas.textAlign = 'left';
}

function paintScaleBar({ canvas, camera, size }: Painter, step: number): void {
  const length = step * camera.zoom, x = 16, y = size.height - 16;
  canvas.strokeStyle = canvas.fillStyle = colour('--quiet');
  canvas.lineWidth = 1.5;
  canvas.beginPath();
  canvas.moveTo(x, y - 5);
  canvas.lineTo(x, y);
  canvas.lineTo(x + length, y);
  canvas.lineTo(x + length, y - 5);
  canvas.stroke();
  canvas.font = '12px system-ui, sans-serif';
  canvas.textAlign = 'center';
  canvas.fillText(short(step), x + length / 2, y - 6);
}
