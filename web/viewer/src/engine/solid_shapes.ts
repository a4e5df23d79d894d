// Solids to start with beside the library's own: made of its prisms, and of plain lists of triangles.
import type { Mesh, MeshData, Region } from 'dymsum';
import type { PageModule } from './module';

const kGrid = 2 ** 20; // coordinates are multiples of 1 / kGrid

/** 2 nu nv triangles about the z axis. */
function torus(large: number, small: number, nu: number, nv: number): MeshData {
  const vertices: number[] = [], faces: number[][] = [];
  for (let i = 0; i < nu; ++i)
    for (let j = 0; j < nv; ++j) {
      const u = (2 * Math.PI * i) / nu, v = (2 * Math.PI * j) / nv, r = large + small * Math.cos(v);
      for (const x of [r * Math.cos(u), r * Math.sin(u), small * Math.sin(v)]) vertices.push(Math.round(x * kGrid) / kGrid);
      const at = (a: number, b: number): number => (a % nu) * nv + (b % nv);
      faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
  return { vertices, faces };
}

type Generators = Record<string, (...args: number[]) => Mesh>;

/** The library's generators, snapped to the grid of all solids here. */
const snapped = (solids: PageModule['solids']): Generators =>
  Object.fromEntries(Object.entries(solids as unknown as Generators).map(([name, make]) => [name, (...args: number[]) => make(...args, 1 / kGrid)]));

export function moreSolids({ Mesh: meshes, shapes, solids }: PageModule): Generators {
  /** A prism over a region without holes, moved so that the middle of its box is the origin. */
  const over = (region: Region, height: number): Mesh => {
    const standing = solids.prism(region.shape().vertices, height, 1 / kGrid), [x0, y0, , x1, y1] = standing.bounds();
    const mesh = standing.translated(-(x0 + x1) / 2, -(y0 + y1) / 2, -height / 2);
    region.dispose();
    standing.dispose();
    return mesh;
  };
  return {
    ...snapped(solids),
    torus: (large, small, nu, nv) => meshes.fromData(torus(large, small, nu, nv)),
    wheel: (teeth, inner, outer, height) => over(shapes.gear(teeth, inner, outer), height),
    starPrism: (points, inner, outer, height) => over(shapes.star(points, inner, outer), height),
    channel: (width, height, thickness, length) => over(shapes.letterU(width, height, thickness), length),
    angle: (width, height, thickness, length) => over(shapes.letterL(width, height, thickness), length),
  };
}
