// A mesh in the picture: flat-shaded triangles, one material for each kind, and the outlines of its faces.
import {
  BackSide, BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, FrontSide, Group, LineBasicMaterial, LineSegments, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, Plane, Vector3, type Intersection, type Raycaster,
} from 'three';
import { sortByKind } from './by_kind';

export interface SurfaceShape {
  /** x, y, z of each, where they are in the picture */
  vertices: Float32Array;
  triangles: Uint32Array;
  /** of each triangle, below the number of colours */
  kinds: Uint8Array;
  /** two vertices each */
  edges?: Uint32Array;
}
export interface SurfaceLook {
  /** of each kind */
  colours: readonly string[];
  edge: string;
  /** of the inside, which is seen where the surface is cut */
  inside: string;
  /** 1: nothing shines through */
  opacity: number;
}

export class Surface {
  readonly group = new Group();
  private geometry = new BufferGeometry();
  private edgeGeometry = new BufferGeometry();
  private readonly materials: MeshLambertMaterial[];
  private readonly edgeMaterial = new LineBasicMaterial();
  private readonly insideMaterial = new MeshBasicMaterial({ side: BackSide, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -8 }); // hides outlines inside
  private readonly outside;
  private readonly inside;
  private readonly edges;
  private cut: Plane | undefined;
  private from: Uint32Array = new Uint32Array();

  constructor(kindCount: number) {
    // Faces are drawn a little behind their outlines.
    const behind = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
    this.materials = Array.from({ length: kindCount }, () => new MeshLambertMaterial({ flatShading: true, ...behind }));
    this.outside = new Mesh(this.geometry, this.materials);
    this.inside = new Mesh(this.geometry, this.insideMaterial);
    this.edges = new LineSegments(this.edgeGeometry, this.edgeMaterial);
    for (const drawn of [this.outside, this.inside, this.edges]) drawn.frustumCulled = false;
    this.inside.visible = false;
    this.group.add(this.outside, this.inside, this.edges);
  }

  /** Nothing is drawn of none. */
  setShape(shape: SurfaceShape | undefined): void {
    this.group.visible = shape !== undefined;
    if (!shape) return;
    const sorted = sortByKind(shape.triangles, shape.kinds, this.materials.length);
    const edges = shape.edges ?? new Uint32Array();
    const position = this.geometry.getAttribute('position') as BufferAttribute | undefined;
    const fits = hasRoom(position, shape.vertices) && hasRoom(this.geometry.getIndex(), sorted.index) && hasRoom(this.edgeGeometry.getIndex(), edges);
    if (!fits) this.makeRoom(shape.vertices.length, sorted.index.length, edges.length);
    write(this.geometry.getAttribute('position') as BufferAttribute, shape.vertices);
    write(this.geometry.getIndex()!, sorted.index);
    write(this.edgeGeometry.getIndex()!, edges);
    this.geometry.clearGroups();
    for (const group of sorted.groups) if (group.count > 0) this.geometry.addGroup(group.start, group.count, group.kind);
    this.geometry.setDrawRange(0, sorted.index.length);
    this.edgeGeometry.setDrawRange(0, edges.length);
    this.geometry.boundingSphere = null;
    this.from = sorted.from;
  }

  setLook(look: SurfaceLook): void {
    this.materials.forEach((material, kind) => {
      material.color.set(look.colours[kind]!);
      const transparent = look.opacity < 1;
      Object.assign(material, { opacity: look.opacity, transparent, depthWrite: !transparent, side: transparent ? DoubleSide : FrontSide });
      material.needsUpdate = true;
    });
    this.edgeMaterial.color.set(look.edge);
    Object.assign(this.edgeMaterial, { transparent: true, opacity: 0.4 });
    this.insideMaterial.color.set(look.inside);
    this.showInside();
  }

  /** Leaves out what is above this height of the picture. */
  cutAbove(height: number | undefined): void {
    if (height === undefined) this.cut = undefined;
    else if (this.cut) this.cut.constant = height;
    else this.cut = new Plane(new Vector3(0, 0, -1), height);
    const clippingPlanes = this.cut ? [this.cut] : null;
    for (const material of [...this.materials, this.edgeMaterial, this.insideMaterial]) {
      if (Boolean(material.clippingPlanes?.length) !== Boolean(clippingPlanes)) material.needsUpdate = true;
      material.clippingPlanes = clippingPlanes;
    }
    this.showInside();
  }

  /** The triangle that a ray meets first, of those that are not cut away, as it was numbered in `setShape`. */
  pick(ray: Raycaster): { triangle: number; distance: number } | undefined {
    if (!this.group.visible) return undefined;
    const hits: Intersection[] = [];
    this.outside.raycast(ray, hits);
    hits.sort((a, b) => a.distance - b.distance);
    const seen = hits.find((hit) => !this.cut || this.cut.distanceToPoint(hit.point) >= 0);
    return seen && { triangle: this.from[seen.faceIndex!]!, distance: seen.distance };
  }

  dispose(): void {
    this.geometry.dispose();
    this.edgeGeometry.dispose();
    for (const material of [...this.materials, this.edgeMaterial, this.insideMaterial]) material.dispose();
  }

  /** The inside of a solid has one colour without shades: it looks like the plane of the cut. */
  private showInside(): void {
    this.inside.visible = this.cut !== undefined && this.materials[0]!.opacity === 1;
  }

  /** New buffers, half as large again as what they are to hold, so that a shape that changes a little needs no others. */
  private makeRoom(vertices: number, index: number, edges: number): void {
    this.geometry.dispose();
    this.edgeGeometry.dispose();
    this.outside.geometry = this.inside.geometry = this.geometry = new BufferGeometry();
    this.edges.geometry = this.edgeGeometry = new BufferGeometry();
    const position = new BufferAttribute(new Float32Array(withRoom(vertices)), 3).setUsage(DynamicDrawUsage);
    this.geometry.setAttribute('position', position);
    this.edgeGeometry.setAttribute('position', position);
    this.geometry.setIndex(new BufferAttribute(new Uint32Array(withRoom(index)), 1).setUsage(DynamicDrawUsage));
    this.edgeGeometry.setIndex(new BufferAttribute(new Uint32Array(withRoom(edges)), 1).setUsage(DynamicDrawUsage));
  }
}

function hasRoom(attribute: BufferAttribute | null | undefined, values: ArrayLike<number>): boolean {
  return attribute !== null && attribute !== undefined && attribute.array.length >= values.length;
}

/** A multiple of 6: whole vertices, triangles and edges. */
function withRoom(length: number): number {
  return 6 * Math.ceil((1.5 * length) / 6) + 6;
}

function write(attribute: BufferAttribute, values: Float32Array | Uint32Array): void {
  (attribute.array as Float32Array | Uint32Array).set(values);
  attribute.clearUpdateRanges();
  attribute.addUpdateRange(0, values.length);
  attribute.needsUpdate = true;
}
