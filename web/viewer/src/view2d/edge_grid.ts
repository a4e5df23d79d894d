// Which edge or vertex of many lies nearest to a place.
import { boxOf, type Box, type Point } from './camera';
import type { Rings } from './painter';

export interface Nearest {
  /** a vertex, or the edge that starts there */
  kind: 'vertex' | 'edge';
  index: number;
  /** the edge's other end */
  next: number;
  ring: number;
  /** how far along the edge, from 0 to 1 */
  along: number;
  distance: number;
}

/** Edges by the square cells that their boxes meet. */
export class EdgeGrid {
  private cells = new Map<number, number[]>();
  private next: Uint32Array;
  private ring: Uint32Array;
  private box: Box;
  private step: number;
  private columns: number;

  constructor(private rings: Rings) {
    const { vertices, starts } = rings;
    const count = starts.at(-1) ?? 0;
    this.next = new Uint32Array(count);
    this.ring = new Uint32Array(count);
    this.box = boxOf(vertices) ?? { x0: 0, y0: 0, x1: 1, y1: 1 };
    this.columns = Math.max(1, Math.ceil(Math.sqrt(count)));
    this.step = Math.max(this.box.x1 - this.box.x0, this.box.y1 - this.box.y0) / this.columns || 1;
    for (let r = 0; r + 1 < starts.length; ++r)
      for (let k = starts[r]!; k < starts[r + 1]!; ++k) {
        this.next[k] = k + 1 < starts[r + 1]! ? k + 1 : starts[r]!;
        this.ring[k] = r;
      }
    for (let k = 0; k < count; ++k) this.enter(k);
  }

  private column(x: number): number {
    return Math.min(this.columns, Math.max(0, Math.floor((x - this.box.x0) / this.step)));
  }
  private row(y: number): number {
    return Math.min(this.columns, Math.max(0, Math.floor((y - this.box.y0) / this.step)));
  }

  private enter(k: number): void {
    const v = this.rings.vertices, n = this.next[k]!;
    const x0 = this.column(Math.min(v[2 * k]!, v[2 * n]!)), x1 = this.column(Math.max(v[2 * k]!, v[2 * n]!));
    const y0 = this.row(Math.min(v[2 * k + 1]!, v[2 * n + 1]!)), y1 = this.row(Math.max(v[2 * k + 1]!, v[2 * n + 1]!));
    for (let x = x0; x <= x1; ++x)
      for (let y = y0; y <= y1; ++y) {
        const cell = y * (this.columns + 1) + x, list = this.cells.get(cell);
        if (list) list.push(k);
        else this.cells.set(cell, [k]);
      }
  }

  /** A vertex where one is within reach, else the nearest edge within reach. */
  nearest(at: Point, reach: number): Nearest | undefined {
    let vertex: Nearest | undefined, edge: Nearest | undefined;
    const x1 = this.column(at.x + reach), y1 = this.row(at.y + reach);
    for (let x = this.column(at.x - reach); x <= x1; ++x)
      for (let y = this.row(at.y - reach); y <= y1; ++y)
        for (const k of this.cells.get(y * (this.columns + 1) + x) ?? []) {
          const { along, distance } = this.toEdge(at, k), n = this.next[k]!, ring = this.ring[k]!;
          if (distance <= (edge?.distance ?? reach)) edge = { kind: 'edge', index: k, next: n, ring, along, distance };
          for (const index of [k, n]) {
            const far = Math.hypot(at.x - this.rings.vertices[2 * index]!, at.y - this.rings.vertices[2 * index + 1]!);
            if (far <= (vertex?.distance ?? reach)) vertex = { kind: 'vertex', index, next: this.next[index]!, ring, along: 0, distance: far };
          }
        }
    return vertex ?? edge;
  }

  private toEdge({ x, y }: Point, k: number): { along: number; distance: number } {
    const v = this.rings.vertices, n = this.next[k]!;
    const ax = v[2 * k]!, ay = v[2 * k + 1]!, dx = v[2 * n]! - ax, dy = v[2 * n + 1]! - ay;
    const along = Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)));
    return { along, distance: Math.hypot(x - ax - along * dx, y - ay - along * dy) };
  }
}

/** Whether the place lies in the region, by its drawing. */
export function isInside({ vertices, starts }: Rings, { x, y }: Point): boolean {
  let inside = false;
  for (let r = 0; r + 1 < starts.length; ++r)
    for (let k = starts[r]!, before = starts[r + 1]! - 1; k < starts[r + 1]!; before = k++) {
      const y0 = vertices[2 * before + 1]!, y1 = vertices[2 * k + 1]!;
      if (y0 > y === y1 > y) continue;
      const x0 = vertices[2 * before]!;
      if (x < x0 + ((y - y0) / (y1 - y0)) * (vertices[2 * k]! - x0)) inside = !inside;
    }
  return inside;
}
