import { expect, test } from 'vitest';
import { sectionLoops } from './section';

/** A box from (0, 0, low) to (1, 1, high), its triangles seen from outside. */
function box(low: number, high: number): { vertices: Float64Array; triangles: Uint32Array } {
  const corners = [low, high].flatMap((z) => [0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z]);
  const quads = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
  return { vertices: Float64Array.from(corners), triangles: Uint32Array.from(quads.flatMap(([a, b, c, d]) => [a!, b!, c!, a!, c!, d!])) };
}

/** Twice the area, positive for counter-clockwise loops. */
function twiceArea(loop: Float64Array): number {
  let sum = 0;
  for (let k = 0; k < loop.length; k += 3) {
    const n = (k + 3) % loop.length;
    sum += loop[k]! * loop[n + 1]! - loop[n]! * loop[k + 1]!;
  }
  return sum;
}

test('a box is cut in one loop around its square', () => {
  const { vertices, triangles } = box(0, 2);
  const loops = sectionLoops(vertices, triangles, 0.5);
  expect(loops.length).toBe(1);
  expect(Math.abs(twiceArea(loops[0]!))).toBeCloseTo(2, 12);
  for (let k = 2; k < loops[0]!.length; k += 3) expect(loops[0]![k]).toBe(0.5);
});

test('vertices in the plane count as above it', () => {
  const { vertices, triangles } = box(0, 2);
  expect(sectionLoops(vertices, triangles, 2).length).toBe(1); // the top face is above its own plane
  expect(sectionLoops(vertices, triangles, 0)).toEqual([]);
  expect(sectionLoops(vertices, triangles, 3)).toEqual([]);
});

test('two boxes give two loops', () => {
  const a = box(0, 2), b = box(0, 2);
  for (let k = 0; k < b.vertices.length; k += 3) b.vertices[k]! += 5;
  const vertices = Float64Array.from([...a.vertices, ...b.vertices]);
  const triangles = Uint32Array.from([...a.triangles, ...b.triangles.map((v) => v + 8)]);
  expect(sectionLoops(vertices, triangles, 1).length).toBe(2);
});
