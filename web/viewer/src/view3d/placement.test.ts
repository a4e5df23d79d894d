import { expect, test } from 'vitest';
import { boxOf, Placement } from './placement';

test('the longest side becomes 2, about the origin, and back again', () => {
  const placement = Placement.of([10, 20, 30, 14, 28, 31]);
  expect(placement.at(12, 24, 30.5)).toEqual([0, 0, 0]);
  expect(placement.at(14, 28, 31)).toEqual([0.5, 1, 0.125]);
  expect(placement.back(0.5, 1, 0.125)).toEqual([14, 28, 31]);
  expect([...placement.all(new Float64Array([10, 20, 30]))]).toEqual([-0.5, -1, -0.125]);
});

test('a height of its own is 2 high', () => {
  const placement = Placement.withHeightOfItsOwn([0, 0, -Math.PI, 100, 50, Math.PI]);
  expect(placement.at(100, 50, Math.PI)).toEqual([1, 0.5, 1]);
  expect(placement.height(-Math.PI)).toBe(-1);
});

test('boxes of several lists, and of nothing', () => {
  expect(boxOf(new Float64Array([1, 2, 3]), new Float64Array([-1, 5, 0]))).toEqual([-1, 2, 0, 1, 5, 3]);
  expect(boxOf(new Float64Array())).toEqual([-1, -1, -1, 1, 1, 1]);
});

test('far from the origin single precision keeps what doubles tell apart', () => {
  const far = 2 ** 40;
  const vertices = new Float64Array([far, far, far, far + 1, far, far, far + 0.5, far + 0.001, far]);
  const placed = Placement.of(boxOf(vertices)).all(vertices);
  expect(placed[7]).toBeGreaterThan(placed[4]!);
});

test('a ball in sight has the whole box', () => {
  const placement = Placement.inSight([-1, -2, -3, 1, 2, 3]);
  expect(Math.hypot(...placement.at(1, 2, 3))).toBeCloseTo(1.2, 12);
});

test('graphics cards get numbers, whatever the data are', () => {
  const vertices = new Float64Array([1e308, -1e308, NaN, Infinity, -Infinity, 1e-320, 0, 1, 2]);
  for (const box of [[-1e308, -1e308, -1e308, 1e308, 1e308, 1e308], [0, 0, 0, 1e-320, 1e-320, 1e-320], [-Infinity, 0, 0, Infinity, 1, 1], [0, 0, 0, 1, 1, 1]] as const)
    for (const placement of [Placement.of(box), Placement.inSight(box), Placement.withHeightOfItsOwn(box)]) {
      expect([...placement.all(vertices), ...placement.at(Infinity, NaN, 1e308), placement.height(1e308)].every(Number.isFinite)).toBe(true);
    }
});
