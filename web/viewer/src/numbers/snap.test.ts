import { describe, expect, it } from 'vitest';
import { parseRational, toNumber } from './rational';
import { snapped, tanHalfOf } from './snap';

describe('snapped', () => {
  it('gives doubles with few digits within half of what is seen', () => {
    for (const x of [0.1234567, -98765.4321, 1e-7]) {
      const s = snapped(x, 0.01);
      expect(Math.abs(s - x)).toBeLessThan(0.005);
      expect(Number.isInteger(s * 256)).toBe(true);
    }
  });
});

describe('tanHalfOf', () => {
  it('is within a thousandth of a radian', () => {
    for (let angle = -7; angle < 7; angle += 0.0137) {
      const text = tanHalfOf(angle), back = text === 'inf' ? Math.PI : 2 * Math.atan(toNumber(parseRational(text)!));
      expect(Math.abs(Math.sin((back - angle) / 2))).toBeLessThan(0.001);
    }
  });
  it('names no turn and half a turn exactly', () => {
    expect([0, Math.PI, -Math.PI, 2 * Math.PI].map(tanHalfOf)).toEqual(['0', 'inf', 'inf', '0']);
  });
});
