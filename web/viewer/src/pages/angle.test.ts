import { describe, expect, it } from 'vitest';
import { angleOf, isAngle, radiansOf } from './angle';

describe('angles', () => {
  it('are tangents of their halves, degrees or radians', () => {
    expect(['1/3', 'inf', '-0.5', '90deg', '1e-3rad', '0.8rad'].map(isAngle)).toEqual(Array(6).fill(true));
    expect(['', 'deg', 'infdeg', '1/0', 'half', '9 deg', '0x10rad'].map(isAngle)).toEqual(Array(7).fill(false));
  });
  it('reach the engine as they were written', () => {
    expect(['1/3', 'inf', '0.8rad'].map(angleOf)).toEqual([{ tanHalf: '1/3' }, { tanHalf: 'inf' }, 0.8]);
  });
  it('are quarter turns exactly, whatever whole turns are with them', () => {
    expect(['0deg', '90deg', '-90deg', '180deg', '-180deg', '360deg', '36000000090deg'].map(angleOf)).toEqual([0, Math.PI / 2, -Math.PI / 2, Math.PI, Math.PI, 0, Math.PI / 2]);
  });
  it('of degrees are the nearest doubles to them', () => {
    expect(angleOf('30deg')).toBe(0.5235987755982989); // Math.PI / 6 is its neighbour
    expect(angleOf('1deg')).toBe(0.017453292519943295);
    expect(angleOf('36000000001deg')).toBe(0.017453292519943295);
    expect(angleOf('-0.1deg')).toBe(-0.0017453292519943296);
  });
  it('are drawn where they are', () => {
    expect(radiansOf('1')).toBe(Math.PI / 2);
    expect(radiansOf('inf')).toBe(Math.PI);
    expect(radiansOf('45deg')).toBe(Math.PI / 4);
  });
});
