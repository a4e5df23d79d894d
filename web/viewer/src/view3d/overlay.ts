// Lines, points, arrows and texts over the picture of space: a plane drawing of what is projected, as sharp as the screen.
import { Vector4, type PerspectiveCamera } from 'three';

export interface OverlayLine {
  /** x, y, z after x, y, z, where they are in the picture; several closed ones are filled together, even-odd */
  loops: readonly Float32Array[];
  closed: boolean;
  colour: string;
  width: number;
  fill?: string;
  dash?: readonly number[];
}
export interface OverlayDot {
  at: readonly [number, number, number];
  colour: string;
  radius: number;
  /** beside it */
  text?: string;
}
export interface OverlayArrow {
  from: readonly [number, number, number];
  to: readonly [number, number, number];
  colour: string;
  text?: string;
}
export interface Overlay {
  lines?: readonly OverlayLine[];
  dots?: readonly OverlayDot[];
  arrows?: readonly OverlayArrow[];
}

type Screen = readonly [number, number];

class Projection {
  private readonly v = new Vector4();

  constructor(
    private readonly camera: PerspectiveCamera,
    private readonly width: number,
    private readonly height: number,
  ) {}

  /** Before the division: negative w is behind the camera. */
  clip(x: number, y: number, z: number): Vector4 {
    return this.v.set(x, y, z, 1).applyMatrix4(this.camera.matrixWorldInverse).applyMatrix4(this.camera.projectionMatrix);
  }
  screen(at: Vector4): Screen {
    return [(0.5 + at.x / at.w / 2) * this.width, (0.5 - at.y / at.w / 2) * this.height];
  }
  point(at: readonly [number, number, number]): Screen | undefined {
    const clip = this.clip(...at);
    return clip.w > 1e-6 ? this.screen(clip) : undefined;
  }
}

/** Draws onto a canvas whose transformation is that of its pixels per unit. */
export function drawOverlay(draw: CanvasRenderingContext2D, overlay: Overlay, camera: PerspectiveCamera, width: number, height: number, halo: string): void {
  const projection = new Projection(camera, width, height);
  draw.clearRect(0, 0, width, height);
  draw.lineJoin = draw.lineCap = 'round';
  draw.font = '12.5px system-ui, sans-serif';
  for (const line of overlay.lines ?? []) drawLine(draw, line, projection);
  for (const arrow of overlay.arrows ?? []) drawArrow(draw, arrow, projection, halo);
  for (const dot of overlay.dots ?? []) drawDot(draw, dot, projection, halo);
}

function drawLine(draw: CanvasRenderingContext2D, line: OverlayLine, projection: Projection): void {
  draw.beginPath();
  for (const points of line.loops) {
    let before = false;
    for (let k = 0; k < points.length; k += 3) {
      const at = projection.point([points[k]!, points[k + 1]!, points[k + 2]!]);
      if (!at) before = false; // behind the camera
      else {
        if (before) draw.lineTo(...at);
        else draw.moveTo(...at);
        before = true;
      }
    }
    if (line.closed) draw.closePath();
  }
  if (line.fill) {
    draw.fillStyle = line.fill;
    draw.fill('evenodd');
  }
  draw.setLineDash([...(line.dash ?? [])]);
  draw.strokeStyle = line.colour;
  draw.lineWidth = line.width;
  draw.stroke();
  draw.setLineDash([]);
}

const kHead = 11;

function drawArrow(draw: CanvasRenderingContext2D, arrow: OverlayArrow, projection: Projection, halo: string): void {
  const from = projection.point(arrow.from), to = projection.point(arrow.to);
  if (!from || !to) return;
  const dx = to[0] - from[0], dy = to[1] - from[1], length = Math.hypot(dx, dy);
  if (length > 0.5) {
    const u: Screen = [dx / length, dy / length], head = Math.min(kHead, length);
    const neck: Screen = [to[0] - head * u[0], to[1] - head * u[1]];
    for (const [colour, width] of [[halo, 6], [arrow.colour, 3]] as const) {
      draw.strokeStyle = colour;
      draw.lineWidth = width;
      draw.beginPath();
      draw.moveTo(...from);
      draw.lineTo(...neck);
      draw.stroke();
      draw.fillStyle = colour;
      draw.lineWidth = width - 2.9; // a halo round the head
      draw.beginPath();
      draw.moveTo(...to);
      draw.lineTo(neck[0] - 0.42 * head * u[1], neck[1] + 0.42 * head * u[0]);
      draw.lineTo(neck[0] + 0.42 * head * u[1], neck[1] - 0.42 * head * u[0]);
      draw.closePath();
      draw.stroke();
      draw.fill();
    }
  }
  if (arrow.text) drawText(draw, arrow.text, [to[0] + 10, to[1] - 10], arrow.colour, halo);
}

function drawDot(draw: CanvasRenderingContext2D, dot: OverlayDot, projection: Projection, halo: string): void {
  const at = projection.point(dot.at);
  if (!at) return;
  draw.beginPath();
  draw.arc(at[0], at[1], dot.radius, 0, 2 * Math.PI);
  draw.fillStyle = dot.colour;
  draw.strokeStyle = halo;
  draw.lineWidth = 2;
  draw.fill();
  draw.stroke();
  if (dot.text) drawText(draw, dot.text, [at[0] + dot.radius + 5, at[1] + 4], dot.colour, halo);
}

function drawText(draw: CanvasRenderingContext2D, text: string, at: Screen, colour: string, halo: string): void {
  draw.strokeStyle = halo;
  draw.lineWidth = 4;
  draw.strokeText(text, ...at);
  draw.fillStyle = colour;
  draw.fillText(text, ...at);
}
