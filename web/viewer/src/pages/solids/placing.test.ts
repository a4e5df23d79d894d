import { expect, test } from 'vitest';
import { placedQ, placementOf } from './placing';
import type { SolidOperand } from './service';
import { solidsState } from './state';

const cube = { name: 'cube', make: 'box', args: [-1, -1, -1, 1, 1, 1] } as const;
const state = solidsState({ ...cube, args: [...cube.args] }, { ...cube, args: [...cube.args] });

test('Q is scaled, turned about its origin, then moved', () => {
  const placed = placedQ({ ...state, axis: 'z', angle: 90, scale: '3/2', at: [10, 0, 0] }, Float64Array.of(2, 0, 1));
  [10, 3, 1.5].forEach((x, k) => expect(placed[k]).toBeCloseTo(x, 12));
});

test('a whole turn about a skew axis changes nothing', () => {
  const placed = placedQ({ ...state, axis: 'skew', angle: 360 }, Float64Array.of(1, -2, 3));
  [1, -2, 3].forEach((x, k) => expect(placed[k]).toBeCloseTo(x, 12));
});

test('the pictures have room for Q beside P on every side', () => {
  const none = { triangles: new Uint32Array(), faceStarts: new Uint32Array(), faceVertices: new Uint32Array(), error: undefined };
  const p: SolidOperand = { ...none, vertices: Float64Array.of(-1, -1, -1, 1, 1, 1) }, q: SolidOperand = { ...none, vertices: Float64Array.of(3, 4, 0) };
  expect(placementOf(p, q).at(6, 0, -6)).toEqual([1, 0, -1]);
});
