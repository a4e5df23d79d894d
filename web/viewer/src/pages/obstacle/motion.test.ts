import type { Waypoint } from 'dymsum';
import { expect, test } from 'vitest';
import { PathMotion } from './motion';

function point(move: Waypoint['move'], x: number, y: number, theta: number): Waypoint {
  return { move, x, y, theta, exact: { x: '0/1', y: '0/1', tanHalf: '0/1' } };
}

test('translations and turns share the way by length and weight', () => {
  const motion = new PathMotion([point('start', 0, 0, 0), point('translation', 3, 4, 0), point('counter_clockwise', 3, 4, 1)], 5);
  expect(motion.length).toBeCloseTo(10, 12);
  expect(motion.at(0)).toEqual({ x: 0, y: 0, theta: 0 });
  expect(motion.at(0.25).x).toBeCloseTo(1.5, 12);
  expect(motion.moveAt(0.25)).toBe(0);
  expect(motion.at(0.75).theta).toBeCloseTo(0.5, 12);
  expect(motion.moveAt(0.75)).toBe(1);
  expect(motion.at(1)).toEqual({ x: 3, y: 4, theta: 1 });
});

test('a clockwise turn past half a turn comes in on the other side', () => {
  const motion = new PathMotion([point('start', 0, 0, -3), point('clockwise', 0, 0, 3)], 1);
  expect(motion.length).toBeCloseTo(2 * Math.PI - 6, 12);
  const pieces = motion.pieces();
  expect(pieces.map((p) => [...p])).toEqual([[0, 0, -3, 0, 0, -Math.PI], [0, 0, Math.PI, 0, 0, 3]]);
  expect(Math.abs(motion.at(0.5).theta)).toBeCloseTo(Math.PI, 12);
});

test('a path of one waypoint stays there', () => {
  expect(new PathMotion([point('start', 1, 2, 3)], 1).at(0.5)).toEqual({ x: 1, y: 2, theta: 3 });
});
