// An operand for drawing and touching: its rings, and which vertex follows which.
import type { RegionShape } from 'dymsum';
import { boxOf, type Box, type Point } from '../view2d/camera';
import { EdgeGrid } from '../view2d/edge_grid';
import { applied, type Affine } from '../view2d/affine';
import type { LineStyle, Painter, Rings } from '../view2d/painter';

export class Outline {
  readonly rings: Rings;
  readonly polylines: Rings;
  readonly box: Box | undefined;
  private index: EdgeGrid | undefined;

  constructor(readonly shape: RegionShape) {
    this.rings = { vertices: shape.vertices, starts: shape.ringStarts };
    this.polylines = { vertices: shape.vertices, starts: shape.polylineStarts };
    this.box = boxOf(shape.vertices);
  }

  /** Made when it is first asked for: drags do not need it. */
  get grid(): EdgeGrid {
    return (this.index ??= new EdgeGrid(this.rings));
  }

  vertex(k: number): Point {
    return { x: this.shape.vertices[2 * k]!, y: this.shape.vertices[2 * k + 1]! };
  }

  /** Where the edge that starts at a vertex ends. */
  next(k: number): number {
    for (const { starts } of [this.rings, this.polylines])
      for (let r = 0; r + 1 < starts.length; ++r) {
        const begin = starts[r]!, end = starts[r + 1]!;
        if (k >= begin && k < end) return k + 1 < end ? k + 1 : begin;
      }
    return k;
  }

  /** With one vertex somewhere else, to be drawn. */
  withVertex(k: number, { x, y }: Point): Outline {
    const vertices = this.shape.vertices.slice();
    vertices.set([x, y], 2 * k);
    return new Outline({ ...this.shape, vertices });
  }

  paint(painter: Painter, fill: string, style: LineStyle, by?: Affine): void {
    painter.region(this.rings, fill, style, by);
    painter.trace(this.polylines, by, false);
    painter.line(style);
    for (let k = this.shape.firstPoint; 2 * k < this.shape.vertices.length; ++k) painter.dot(by ? applied(by, this.vertex(k)) : this.vertex(k), 3, style.colour);
  }
}
