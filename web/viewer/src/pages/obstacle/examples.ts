// Robots and obstacles to start with.
import type { MadeShape } from '../../engine/shape';
import { obstacleState, type ObstacleState } from './state';

const kRod: MadeShape = { name: 'rod', make: 'rectangle', args: [-1.5, -0.25, 1.5, 0.25] };
const kComb: MadeShape = { name: 'comb', make: 'comb', args: [3, 2, 1, 6] };
const kGrate: MadeShape = { name: 'grate', make: 'grate', args: [3, 2, 1, 6] };

export const kExamples: readonly [{ name: string; state: ObstacleState }, ...{ name: string; state: ObstacleState }[]] = [
  {
    name: 'A rod has to turn before it fits between the teeth of a comb',
    state: obstacleState(kRod, kComb, { x: -3, y: 10, tanHalf: '0' }, { x: 1.5, y: 3, tanHalf: '1' }, { path: true }),
  },
  {
    name: 'No path leads into a grate',
    state: obstacleState(kRod, kGrate, { x: -3, y: 10, tanHalf: '0' }, { x: 1.5, y: 3, tanHalf: '1' }, { path: true }),
  },
  {
    name: 'An L turns in a U',
    state: obstacleState(
      { name: 'L', make: 'letterL', args: [1, 1.5, 0.375] }, { name: 'U', make: 'letterU', args: [5, 5, 1] },
      { x: 1.25, y: 6.5, tanHalf: '0' }, { x: 3.75, y: 3, tanHalf: 'inf' }, { path: true },
    ),
  },
  {
    name: 'A star among the pockets',
    state: obstacleState(
      { name: 'star', make: 'star', args: [5, 0.25, 0.75] }, { name: 'gear', make: 'gear', args: [9, 3, 4.5] },
      { x: -6, y: 0, tanHalf: '0' }, { x: 6, y: 0, tanHalf: '1/2' },
    ),
  },
];
