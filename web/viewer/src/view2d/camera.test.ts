import { describe, expect, it } from 'vitest';
import { applied, inverted, placed } from './affine';
import { fitted, toPlane, toScreen, zoomed } from './camera';

const size = { width: 800, height: 600 };

describe('the camera', () => {
  it('fits a box, also one without height', () => {
    const camera = fitted({ x0: -1, y0: 2, x1: 3, y1: 2 }, size);
    expect(toScreen(camera, size, { x: -1, y: 2 }).x).toBeGreaterThan(0);
    expect(toScreen(camera, size, { x: 3, y: 2 }).x).toBeLessThan(800);
  });
  it('keeps the place under the pointer while zooming', () => {
    const camera = { x: 5, y: -3, zoom: 20 }, at = { x: 123, y: 456 };
    const before = toPlane(camera, size, at), after = toPlane(zoomed(camera, size, at, 3.7), size, at);
    expect(after.x).toBeCloseTo(before.x, 9);
    expect(after.y).toBeCloseTo(before.y, 9);
  });
  it('inverts placings', () => {
    const by = placed(1.5, 0.7, 3, -2), p = { x: 2, y: 9 }, back = inverted(by, applied(by, p));
    expect(back.x).toBeCloseTo(2, 12);
    expect(back.y).toBeCloseTo(9, 12);
  });
});
