// What the worker keeps between requests: the module, and the objects that were made for the last few operands.
import type { Disposable, Mesh, Progress, Region } from 'dymsum';
import type { PageModule } from './module';
import { planeShapes } from './plane_shapes';
import { bytesOf, isMade, keyOf, type Shape } from './shape';
import { moreSolids } from './solid_shapes';

const kMostKept = 12;

export class Host {
  private kept = new Map<string, Disposable>();
  private inUse = new Set<string>();

  constructor(
    readonly dymsum: PageModule,
    /** For options: passes progress of the request at hand on. */
    readonly progress: Progress,
  ) {}

  /** The object of this key, made if it is not there. It lives at least until the request is answered. */
  keep<T extends Disposable>(key: string, make: () => T): T {
    const value = (this.kept.get(key) as T | undefined) ?? make();
    this.kept.delete(key); // the last in the map is the last that was used
    this.kept.set(key, value);
    this.inUse.add(key);
    return value;
  }

  /** The object of this key if it is there; it lives as long. */
  ifKept<T extends Disposable>(key: string): T | undefined {
    const value = this.kept.get(key) as T | undefined;
    return value && this.keep(key, () => value);
  }

  /** Disposes of what has not been used for longest. */
  requestDone(): void {
    for (const [key, value] of this.kept) {
      if (this.kept.size <= kMostKept) break;
      if (this.inUse.has(key)) continue;
      this.kept.delete(key);
      value.dispose();
    }
    this.inUse.clear();
  }

  region(shape: Shape): Region {
    return this.keep(`region ${keyOf(shape)}`, () =>
      isMade(shape) ? this.make<Region>(planeShapes(this.dymsum), shape) : this.dymsum.Region.read(shape.name, bytesOf(shape)),
    );
  }

  mesh(shape: Shape): Mesh {
    return this.keep(`mesh ${keyOf(shape)}`, () =>
      isMade(shape) ? this.make<Mesh>({ ...this.dymsum.solids, ...moreSolids(this.dymsum) }, shape) : this.dymsum.Mesh.read(shape.name, bytesOf(shape)),
    );
  }

  private make<T>(generators: object, shape: { make: string; args: number[] }): T {
    const generator = Object.entries(generators).find(([name]) => name === shape.make)?.[1] as ((...args: number[]) => T) | undefined;
    if (!generator) throw new Error(`There is no generator "${shape.make}".`);
    return generator(...shape.args);
  }
}
