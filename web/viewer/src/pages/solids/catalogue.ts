// Solids to start with.
import type { MadeShape } from '../../engine/shape';
import { kAxes, kSets, solidsState, type SolidsState } from './state';

export const kSolids: readonly MadeShape[] = [
  { name: 'cube', make: 'box', args: [-1, -1, -1, 1, 1, 1] },
  { name: 'ball', make: 'geodesicSphere', args: [3, 1] },
  { name: 'ellipsoid', make: 'ellipsoid', args: [24, 12, 2, 1, 0.5] },
  { name: 'cone', make: 'cone', args: [24, 1, 2] },
  { name: 'cylinder', make: 'cylinder', args: [24, 0.75, 2] },
  { name: 'rod', make: 'rod', args: [18, 9, 0.5, 3] },
  { name: 'dipyramid', make: 'dipyramid', args: [8, 1, 2] },
  { name: 'Archimedean', make: 'truncatedIcosidodecahedron', args: [1.5] },
  { name: 'torus', make: 'torus', args: [2, 0.625, 16, 8] },
  { name: 'fine torus', make: 'torus', args: [2, 0.625, 32, 16] },
  { name: 'small ball', make: 'ellipsoid', args: [16, 8, 0.375, 0.375, 0.375] },
  { name: 'wheel', make: 'wheel', args: [8, 1.25, 1.75, 0.75] },
  { name: 'star', make: 'starPrism', args: [5, 0.5, 1.25, 0.5] },
  { name: 'channel', make: 'channel', args: [4, 4, 1, 5] },
  { name: 'angle', make: 'angle', args: [1.5, 2, 0.5, 1] },
  { name: 'bar', make: 'box', args: [-1, -0.5, -0.5, 1, 0.5, 0.5] },
];

function made(name: string): MadeShape {
  const shape = kSolids.find((s) => s.name === name);
  if (!shape) throw new Error(`There is no solid "${name}".`);
  return shape;
}

interface Example {
  name: string;
  state: SolidsState;
}
export const kExamples: readonly [Example, ...Example[]] = [
  { name: 'Ellipsoid and cube', state: solidsState(made('ellipsoid'), made('cube'), { angle: 20, at: [2.5, -1.5, 0] }) },
  { name: 'Torus and star', state: solidsState(made('torus'), made('star'), { angle: 30, scale: '1/2', at: [3, -1, 0] }) },
  { name: 'How deep a rod is in a torus', state: solidsState(made('torus'), made('rod'), { ...kSets.hits, at: [1.5, 0.5, 0.25], angle: 40, scale: '1/2' }) },
  { name: 'How deep a cube is in a ball', state: solidsState(made('ball'), made('cube'), { ...kSets.hits, at: [1.25, 0, 0.5], angle: 15, scale: '1/2' }) },
  { name: 'A bar that fits exactly into a channel', state: solidsState(made('channel'), made('bar'), { ...kSets.hits, through: true, at: [0, 3, 0] }) },
  { name: 'Fine torus and small ball', state: solidsState(made('fine torus'), made('small ball'), { at: [2.75, -1, 0.5] }) },
  { name: 'Wheel and angle, sliced', state: solidsState(made('wheel'), made('angle'), { scale: '1/2', slice: 0.25, angle: 25, axis: kAxes.x, at: [2, -1, 0] }) },
];
