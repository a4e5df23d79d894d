// Shapes to start with, of the library's own generators.
import type { MadeShape, Shape } from '../engine/shape';

export const kCatalogue: readonly MadeShape[] = [
  { name: 'gear', make: 'gear', args: [14, 3, 4] },
  { name: 'star', make: 'star', args: [5, 0.5, 1.25] },
  { name: 'disc', make: 'disc', args: [32, 1] },
  { name: 'square', make: 'rectangle', args: [-0.5, -0.5, 0.5, 0.5] },
  { name: 'grate', make: 'grate', args: [6, 2, 0.75, 9] },
  { name: 'comb', make: 'comb', args: [6, 2, 1, 5] },
  { name: 'L', make: 'letterL', args: [3, 4, 1] },
  { name: 'U', make: 'letterU', args: [4, 4, 1] },
  { name: 'spiral', make: 'spiral', args: [3, 24, 2, 0.75] },
  { name: 'pockets', make: 'pockets', args: [5, 1] },
  { name: 'noisy star', make: 'noisyStar', args: [60, 0.6, 7] },
  { name: 'random', make: 'randomPolygon', args: [60, 4, 3] },
];

/** Requires: a name of the catalogue. */
export function made(name: string): Shape {
  const shape = kCatalogue.find((s) => s.name === name);
  if (!shape) throw new Error(`There is no shape "${name}".`);
  return shape;
}
