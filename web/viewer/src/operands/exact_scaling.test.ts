import { expect, test } from 'vitest';
import { parseRational } from '../numbers/rational';
import { scalesExactly } from './exact_scaling';

const exact = (coordinates: number[], ...factors: string[]): boolean => scalesExactly(Float64Array.from(coordinates), factors.map((f) => parseRational(f)!));

test('products that are doubles', () => {
  expect(exact([1.25, -3, 0, 1e300], '3/4', '3/4')).toBe(true);
  expect(exact([0.1, 0.2], '1/2', '2')).toBe(true); // powers of two round nothing
});

test('products that are none', () => {
  expect(exact([0.1, 0.2], '3/4', '3/4')).toBe(false);
  expect(exact([1], '1/3')).toBe(false);
  expect(exact([2 ** 52 + 1], '3')).toBe(false);
});

test('each axis has its own factor', () => {
  expect(exact([0.1, 5], '1/2', '3')).toBe(true);
  expect(exact([5, 0.1], '1/2', '3')).toBe(false);
});
