import { PerspectiveCamera, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { turnByKey } from './keys';

function after(...keys: string[]): { camera: PerspectiveCamera; fitted: number } {
  const camera = new PerspectiveCamera();
  camera.position.set(3, -4, 2);
  let fitted = 0;
  for (const key of keys) turnByKey(key, camera, new Vector3(), () => ++fitted);
  return { camera, fitted };
}

test('arrows keep the distance, and opposite ones cancel', () => {
  expect(after('ArrowLeft', 'ArrowUp').camera.position.length()).toBeCloseTo(Math.hypot(3, 4, 2), 12);
  expect(after('ArrowLeft', 'ArrowUp', 'ArrowDown', 'ArrowRight').camera.position.distanceTo(new Vector3(3, -4, 2))).toBeLessThan(1e-12);
});

test('up looks from higher above, right turns about the height', () => {
  expect(after('ArrowUp').camera.position.z).toBeGreaterThan(2);
  expect(after('ArrowRight').camera.position.z).toBeCloseTo(2, 12);
});

test('plus comes nearer, zero shows all, other keys are not taken', () => {
  expect(after('+').camera.position.length()).toBeLessThan(Math.hypot(3, 4, 2));
  expect(after('0').fitted).toBe(1);
  expect(turnByKey('x', new PerspectiveCamera(), new Vector3(), () => undefined)).toBe(false);
});

test('the poles are not passed', () => {
  const { camera } = after(...Array.from({ length: 100 }, () => 'ArrowUp'));
  expect(camera.position.z).toBeGreaterThan(5);
  expect(Math.hypot(camera.position.x, camera.position.y)).toBeGreaterThan(0);
});
