// A sum for drawing and touching.
import type { SumShape } from 'dymsum';
import { colour } from '../shell/theme';
import { kStill, type Affine } from './affine';
import { boxOf, type Box, type Point } from './camera';
import { EdgeGrid, type Nearest } from './edge_grid';
import type { Painter, Rings } from './painter';

/** x, y of the named vertices, one after the other. */
export function picked(vertices: Float64Array, indices: Uint32Array): Float64Array {
  const out = new Float64Array(2 * indices.length);
  indices.forEach((k, i) => out.set([vertices[2 * k]!, vertices[2 * k + 1]!], 2 * i));
  return out;
}

export class SumPicture {
  readonly rings: Rings;
  readonly box: Box | undefined;
  private index: EdgeGrid | undefined;

  constructor(readonly shape: SumShape) {
    this.rings = { vertices: shape.vertices, starts: shape.ringStarts };
    this.box = boxOf(shape.vertices);
  }

  get counts(): { parts: number; holes: number; vertices: number; tightPoints: number; tightSegments: number } {
    const { partStarts, ringStarts, tightPoints, tightSegments } = this.shape;
    const parts = Math.max(0, partStarts.length - 1), rings = Math.max(0, ringStarts.length - 1);
    return { parts, holes: rings - parts, vertices: ringStarts.at(-1) ?? 0, tightPoints: tightPoints.length, tightSegments: tightSegments.length / 2 };
  }

  vertex(k: number): Point {
    return { x: this.shape.vertices[2 * k]!, y: this.shape.vertices[2 * k + 1]! };
  }

  /** Tight points go before what lies about them. */
  nearest(at: Point, reach: number): Nearest | undefined {
    let best: Nearest | undefined;
    for (const index of [...this.shape.tightPoints, ...this.shape.points, ...this.shape.tightSegments]) {
      const { x, y } = this.vertex(index), distance = Math.hypot(at.x - x, at.y - y);
      if (distance <= (best?.distance ?? reach)) best = { kind: 'vertex', index, next: index, ring: -1, along: 0, distance };
    }
    return best ?? (this.index ??= new EdgeGrid(this.rings)).nearest(at, reach);
  }

  paint(painter: Painter, by: Affine = kStill): void {
    painter.region(this.rings, colour('--sum-fill'), { colour: colour('--sum'), width: 2 }, by);
    painter.segments(picked(this.shape.vertices, this.shape.segments), { colour: colour('--sum'), width: 2 }, by);
    for (const k of this.shape.points) painter.dot({ x: this.vertex(k).x + by.e, y: this.vertex(k).y + by.f }, 3.5, colour('--sum'));
  }

  /** Tight segments are hollow lines with a core, tight points diamonds: not told by colour alone. */
  paintTight(painter: Painter, by: Affine = kStill): void {
    const tight = colour('--tight'), ground = colour('--ground'), ends = picked(this.shape.vertices, this.shape.tightSegments);
    painter.segments(ends, { colour: tight, width: 6 }, by);
    painter.segments(ends, { colour: ground, width: 2.5, dash: [1, 5] }, by);
    for (const k of this.shape.tightPoints) painter.diamond({ x: this.vertex(k).x + by.e, y: this.vertex(k).y + by.f }, 6.5, tight, ground);
  }
}
