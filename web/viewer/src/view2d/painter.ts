// Draws shapes of the plane on a canvas. Lines and marks have widths in pixels, whatever the zoom.
import { toScreen, type Camera, type Point, type Size } from './camera';
import type { Affine } from './affine';

/** Rings as flat arrays: ring r has the vertices from starts[r] to starts[r + 1]. */
export interface Rings {
  vertices: Float64Array;
  starts: Uint32Array;
}
export interface LineStyle {
  colour: string;
  width?: number;
  dash?: number[];
}

export class Painter {
  constructor(
    readonly canvas: CanvasRenderingContext2D,
    readonly camera: Camera,
    readonly size: Size,
  ) {}

  at(p: Point): Point {
    return toScreen(this.camera, this.size, p);
  }

  /** What maps the plane, moved by `by`, to the screen. */
  private onto(by: Affine | undefined): [number, number, number, number, number, number] {
    const { x, y, zoom } = this.camera, { a, b, c, d, e, f } = by ?? { a: 1, b: 0, c: 0, d: 1, e: 0, f: 0 };
    return [a * zoom, c * zoom, (e - x) * zoom + this.size.width / 2, -b * zoom, -d * zoom, this.size.height / 2 - (f - y) * zoom];
  }

  /** The rings as one path. Vertices that cannot be told from the last one are left out. */
  trace({ vertices, starts }: Rings, by?: Affine, closed = true): void {
    const [xx, xy, x0, yx, yy, y0] = this.onto(by), ctx = this.canvas;
    ctx.beginPath();
    for (let r = 0; r + 1 < starts.length; ++r) {
      let lastX = NaN, lastY = NaN;
      for (let k = starts[r]!; k < starts[r + 1]!; ++k) {
        const px = vertices[2 * k]!, py = vertices[2 * k + 1]!;
        const x = xx * px + xy * py + x0, y = yx * px + yy * py + y0;
        if (Math.abs(x - lastX) < 0.2 && Math.abs(y - lastY) < 0.2) continue;
        if (k === starts[r]) ctx.moveTo(x, y);
        else ctx.lineTo(x, y);
        lastX = x;
        lastY = y;
      }
      if (closed) ctx.closePath();
    }
  }

  fill(rings: Rings, colour: string, by?: Affine): void {
    this.trace(rings, by);
    this.canvas.fillStyle = colour;
    this.canvas.fill('evenodd');
  }

  line({ colour, width = 1.5, dash = [] }: LineStyle): void {
    const ctx = this.canvas;
    ctx.strokeStyle = colour;
    ctx.lineWidth = width;
    ctx.lineJoin = ctx.lineCap = 'round';
    ctx.setLineDash(dash);
    ctx.stroke();
    ctx.setLineDash([]);
  }

  region(rings: Rings, fill: string, style: LineStyle, by?: Affine): void {
    this.trace(rings, by);
    this.canvas.fillStyle = fill;
    this.canvas.fill('evenodd');
    this.line(style);
  }

  /** x, y, x, y of each. */
  segments(ends: ArrayLike<number>, style: LineStyle, by?: Affine): void {
    const [xx, xy, x0, yx, yy, y0] = this.onto(by), ctx = this.canvas;
    ctx.beginPath();
    for (let k = 0; k < ends.length; k += 4) {
      ctx.moveTo(xx * ends[k]! + xy * ends[k + 1]! + x0, yx * ends[k]! + yy * ends[k + 1]! + y0);
      ctx.lineTo(xx * ends[k + 2]! + xy * ends[k + 3]! + x0, yx * ends[k + 2]! + yy * ends[k + 3]! + y0);
    }
    this.line(style);
  }

  dot(at: Point, radius: number, fill: string, edge?: string): void {
    const { x, y } = this.at(at), ctx = this.canvas;
    ctx.beginPath();
    ctx.arc(x, y, radius, 0, 2 * Math.PI);
    ctx.fillStyle = fill;
    ctx.fill();
    if (edge) this.line({ colour: edge, width: 2 });
  }

  /** A square on its corner with a light edge: tight places, told by their form as well as by their colour. */
  diamond(at: Point, radius: number, fill: string, edge: string): void {
    const { x, y } = this.at(at), ctx = this.canvas;
    ctx.beginPath();
    ctx.moveTo(x, y - radius);
    ctx.lineTo(x + radius, y);
    ctx.lineTo(x, y + radius);
    ctx.lineTo(x - radius, y);
    ctx.closePath();
    ctx.fillStyle = fill;
    ctx.fill();
    this.line({ colour: edge, width: 1.5 });
  }

  cross(at: Point, radius: number, style: LineStyle): void {
    const { x, y } = this.at(at), ctx = this.canvas;
    ctx.beginPath();
    ctx.moveTo(x - radius, y - radius);
    ctx.lineTo(x + radius, y + radius);
    ctx.moveTo(x - radius, y + radius);
    ctx.lineTo(x + radius, y - radius);
    this.line(style);
  }

  /** The place that an error names: a ring about it and a cross. */
  wrong(at: Point, colour: string): void {
    this.cross(at, 5, { colour, width: 2.5 });
    const { x, y } = this.at(at), ctx = this.canvas;
    ctx.beginPath();
    ctx.arc(x, y, 14, 0, 2 * Math.PI);
    this.line({ colour, width: 2.5 });
  }
}
