// Regions to start with: the library's own.
import type { Region } from 'dymsum';
import type { PageModule } from './module';

const kGrid = 2 ** 20; // points of circles and cells are multiples of 1 / kGrid: scaled by short fractions they are doubles again

type Generators = Record<string, (...args: number[]) => Region>;

export function planeShapes({ shapes }: PageModule): Generators {
  return {
    ...(shapes as unknown as Generators),
    disc: (vertices, radius) => shapes.disc(vertices, radius, 1 / kGrid),
    gear: (teeth, inner, outer) => shapes.gear(teeth, inner, outer, 1 / kGrid),
    star: (points, inner, outer) => shapes.star(points, inner, outer, 1 / kGrid),
    spiral: (turns, verticesPerTurn, pitch, width) => shapes.spiral(turns, verticesPerTurn, pitch, width, 1 / kGrid),
    pockets: (holes, size) => shapes.pockets(holes, size, 1 / kGrid),
  };
}
