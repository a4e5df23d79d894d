import { expect, test } from 'vitest';
import { placed, placementOf } from './placing';
import type { SolidOperand } from './service';
import { solidsState } from './state';

const cube = { name: 'cube', make: 'box', args: [-1, -1, -1, 1, 1, 1] } as const;
const state = solidsState({ ...cube, args: [...cube.args] }, { ...cube, args: [...cube.args] });

test('what moves is scaled and turned about its origin, and Q is where it stands', () => {
  const motion = { ...state, axis: [0, 0, 1], angle: 90, scale: '3/2', at: [10, 0, 0] } as const, vertex = Float64Array.of(2, 0, 1);
  const q = placed(motion, 'q', vertex), p = placed({ ...motion, moving: 'p' }, 'p', vertex);
  [10, 3, 1.5].forEach((x, k) => expect(q[k]).toBeCloseTo(x, 12));
  [0, 3, 1.5].forEach((x, k) => expect(p[k]).toBeCloseTo(x, 12));
  expect([...placed(motion, 'p', vertex)]).toEqual([2, 0, 1]);
  expect([...placed({ ...motion, moving: 'p' }, 'q', vertex)]).toEqual([12, 0, 1]);
});

test('each axis has its factor', () => expect([...placed({ ...state, scale: '2:3:1/2' }, 'q', Float64Array.of(1, 1, 1))]).toEqual([2, 3, 0.5]));

test('a whole turn about a skew axis changes nothing', () => {
  const q = placed({ ...state, axis: [1, 2, 3], angle: 360 }, 'q', Float64Array.of(1, -2, 3));
  [1, -2, 3].forEach((x, k) => expect(q[k]).toBeCloseTo(x, 12));
});

test('the pictures have room for Q beside P on every side', () => {
  const none = { triangles: new Uint32Array(), faceStarts: new Uint32Array(), faceVertices: new Uint32Array(), error: undefined };
  const p: SolidOperand = { ...none, vertices: Float64Array.of(-1, -1, -1, 1, 1, 1) }, q: SolidOperand = { ...none, vertices: Float64Array.of(3, 4, 0) };
  expect(placementOf(p, q).at(6, 0, -6)).toEqual([1, 0, -1]);
});
