import { expect, test } from 'vitest';
import { short, shortText } from './display';

test('six digits at most', () => {
  expect([1 / 3, -2, 1e21, Infinity].map(short)).toEqual(['0.333333', '-2', '1e+21', '∞']);
});

test('texts are read exactly, where no double is near them, too', () => {
  expect(['2e500', `2${'0'.repeat(500)}/1`, '3.9999999999999994e+500', '-1/3', '1e-500', `1/3${'0'.repeat(400)}`, '0', '0/1', '9/16'].map(shortText))
    .toEqual(['2e+500', '2e+500', '4e+500', '-0.333333', '1e-500', '3.33333e-401', '0', '0', '0.5625']);
  expect(['999999.6', '999999.4', '1234567', '4.0000000000000001e+200', '12345678e-400', '-9999996e400'].map(shortText))
    .toEqual(['1000000', '999999', '1234570', '4e+200', '1.23457e-393', '-1e+407']);
  expect(shortText('none')).toBe('none');
});
