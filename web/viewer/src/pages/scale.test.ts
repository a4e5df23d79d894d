import { expect, test } from 'vitest';
import { checkScale, factorsOf, firstFactor, isUniform, withFirstFactor } from './scale';
import { toText } from '../numbers/rational';

const factors = (text: string, axes: 2 | 3): string[] | undefined => factorsOf(text, axes)?.map(toText);

test('a factor for all axes or for each', () => {
  expect(factors('3/2', 2)).toEqual(['3/2', '3/2']);
  expect(factors('2:0.5', 2)).toEqual(['2', '1/2']);
  expect(factors('2:1:1/2', 3)).toEqual(['2', '1', '1/2']);
  expect([factors('2:1', 3), factors('0', 2), factors('-1', 2), factors('', 2), factors('2:x', 2)]).toEqual(Array(5).fill(undefined));
  expect(checkScale('2:1', 2)).toBeUndefined();
  expect(checkScale('2:1', 3)).toMatch(/one for each axis/);
});

test('what doubles cannot compute with is no scale', () => {
  expect([factors('1e400', 3), factors('1:2:1e400', 3), factors('1e-400', 2), factors('1e151', 2), factors('1/1' + '0'.repeat(400), 3)]).toEqual(Array(5).fill(undefined));
  expect([factors('1e15', 3)?.length, factors('1e-150', 2)?.length, factors('1e150', 2)?.length]).toEqual([3, 2, 2]);
  expect(checkScale('1:2:1e400', 3)).toMatch(/from 1e-150 to 1e\+150/);
  expect(withFirstFactor('1:1e150', '2')).toBe('1:1e150');
});

test('equal factors are one scale', () => {
  expect(['2', '2:2', '2:4/2:2.0', '2:1'].map(isUniform)).toEqual([true, true, true, false]);
});

test('a slider keeps what the axes are to each other', () => {
  expect(withFirstFactor('1', '1.5')).toBe('1.5');
  expect(withFirstFactor('2:1', '3')).toBe('3:3/2');
  expect(firstFactor('3/2:1')).toBe(1.5);
});
