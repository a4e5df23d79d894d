import { describe, expect, it } from 'vitest';
import { add, checkSize, fromDouble, isNearDouble, multiply, parseRational, rational, subtract, toNumber, toText } from './rational';

const text = (t: string): string => {
  const r = parseRational(t);
  return r ? toText(r) : 'none';
};

describe('rational', () => {
  it('reads fractions, decimals and exponents exactly', () => {
    expect(['3/2', '-4', '1.25', '1e-3', '6/4', '-0.1', '12e2', '.5', '5.', '-.5e1', '+1.e2'].map(text)).toEqual(['3/2', '-4', '5/4', '1/1000', '3/2', '-1/10', '1200', '1/2', '5', '-5', '100']);
  });
  it('refuses what is no number', () => {
    expect(['', 'x', '1/0', '1//2', '1.2.3', 'Infinity', '1/2/3', '.', '-.', '.e1', 'e1'].map(text)).toEqual(Array(11).fill('none'));
  });
  it('takes doubles at face value', () => {
    expect(toText(fromDouble(0.1))).toBe('3602879701896397/36028797018963968');
    expect(toText(fromDouble(-3))).toBe('-3');
    expect(fromDouble(5e-324)).toEqual(rational(1n, 1n << 1074n));
    expect(toNumber(fromDouble(1.7e308))).toBe(1.7e308);
  });
  it('adds, subtracts and multiplies', () => {
    const a = rational(1n, 6n), b = rational(-3n, -4n);
    expect([add(a, b), subtract(a, b), multiply(a, b)].map(toText)).toEqual(['11/12', '-7/12', '1/8']);
  });
  it('gives doubles of fractions that are longer than doubles', () => {
    const long = rational(3n ** 2000n, 2n * 3n ** 2000n + 1n);
    expect(toNumber(long)).toBeCloseTo(0.5, 12);
  });
  it('knows what has no double near it', () => {
    const near = (t: string): boolean => isNearDouble(parseRational(t)!);
    expect(['0', '1e308', '-1e-300', '5e-324'].map(near)).toEqual(Array(4).fill(true));
    expect(['1e309', '-1e400', '1e-400', '9e9999'].map(near)).toEqual(Array(4).fill(false));
    expect(['1', '1e400', '-1e400', '1e-400'].map((t) => checkSize(parseRational(t)!)?.replace(/:.*/, ''))).toEqual([undefined, 'The number is too large', 'The number is too large', 'The number is too near to 0']);
  });
});
