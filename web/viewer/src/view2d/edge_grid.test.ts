import { describe, expect, it } from 'vitest';
import { EdgeGrid, isInside } from './edge_grid';

const square = { vertices: Float64Array.from([0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 1, 3, 3, 3, 3, 1]), starts: Uint32Array.from([0, 4, 8]) };

/** All edges one after the other. */
function slowDistance(x: number, y: number): number {
  const { vertices: v, starts } = square;
  let best = Infinity;
  for (let r = 0; r + 1 < starts.length; ++r)
    for (let k = starts[r]!; k < starts[r + 1]!; ++k) {
      const n = k + 1 < starts[r + 1]! ? k + 1 : starts[r]!;
      for (let i = 0; i <= 400; ++i) {
        const px = v[2 * k]! + (i / 400) * (v[2 * n]! - v[2 * k]!), py = v[2 * k + 1]! + (i / 400) * (v[2 * n + 1]! - v[2 * k + 1]!);
        best = Math.min(best, Math.hypot(px - x, py - y));
      }
    }
  return best;
}

describe('EdgeGrid', () => {
  const grid = new EdgeGrid(square);
  it('finds the vertex before the edge', () => {
    expect(grid.nearest({ x: 0.1, y: 0.2 }, 0.5)).toMatchObject({ kind: 'vertex', index: 0 });
    expect(grid.nearest({ x: 1.2, y: 3.1 }, 0.5)).toMatchObject({ kind: 'vertex', index: 5, ring: 1 });
  });
  it('finds edges, the last of a ring among them', () => {
    expect(grid.nearest({ x: 0.1, y: 2 }, 0.5)).toMatchObject({ kind: 'edge', index: 3, next: 0, along: 0.5 });
  });
  it('finds nothing out of reach', () => {
    expect(grid.nearest({ x: 2, y: 2 }, 0.9)).toBeUndefined();
    expect(new EdgeGrid({ vertices: new Float64Array(), starts: Uint32Array.from([0]) }).nearest({ x: 0, y: 0 }, 9)).toBeUndefined();
  });
  it('agrees with a search through all edges', () => {
    for (let x = -1; x <= 5; x += 0.31)
      for (let y = -1; y <= 5; y += 0.29) {
        const near = grid.nearest({ x, y }, 0.7), slow = slowDistance(x, y);
        if (near?.kind === 'edge') expect(near.distance).toBeCloseTo(slow, 2);
        else expect(near !== undefined).toBe(slow <= 0.7);
      }
  });
  it('tells inside from outside and from holes', () => {
    expect([{ x: 0.5, y: 2 }, { x: 2, y: 2 }, { x: 5, y: 2 }, { x: 3.5, y: 3.5 }].map((p) => isInside(square, p))).toEqual([true, false, false, true]);
  });
});
