// Sums of solids of which one turns and is scaled.
import { DymsumError, type ConvexSum, type Mesh, type MeshFormat, type MovingSolidSum, type SpatialSum } from 'dymsum';
import type { Host } from '../../engine/host';
import type { ErrorData } from '../../engine/protocol';
import { bytesOf, isMade, type Shape } from '../../engine/shape';
import { using } from '../../operands/using';
import { depthOf, type Place, type SolidDepthAnswer, type Unknown } from './depth';
import { boundaryEdges, kindsOfFaces } from './faces';
import { convexOf, first, fitOf, hasConvexSum, isConvex, keyOfSum, meshOf, posesOf, posesOnTheWay, second, withScaled, type SumArgs } from './standing';

export interface SolidOperand {
  vertices: Float64Array;
  triangles: Uint32Array;
  faceStarts: Uint32Array;
  faceVertices: Uint32Array;
  /** why no sum can be made of it */
  error: ErrorData | undefined;
}
export interface SolidFrame {
  vertices: Float64Array;
  triangles: Uint32Array;
  faceOf: Uint32Array;
  /** of each face from 6 k on: the features of P and of Q that touch there */
  contacts: Uint32Array;
  /** of each triangle, see kFaceColours; with `changed` in place of what is new or another since the last frame */
  kinds: Uint8Array;
  changedKinds: Uint8Array;
  edges: Uint32Array;
  tightTriangles: Uint32Array;
  tightSegments: Uint32Array;
  tightPoints: Uint32Array;
  convex: boolean;
  vertexCount: number;
  faceCount: number;
  changed: number;
  ms: number;
}
export interface SolidNumbers {
  volume: number;
  /** null where it is long */
  volumeExact: string | null;
  shells: number;
}
export interface SolidSection {
  area: number;
  /** null where it is long */
  exact: string | null;
}
export interface AloneNumbers {
  vertices: number;
  faces: number;
  shells: number;
  volume: number;
  area: number;
}

const kExactBits = 4096;

function movingOf(host: Host, args: SumArgs): MovingSolidSum {
  const options = { semantics: args.semantics, tight: true, progress: host.progress };
  const moving = host.keep(`moving ${keyOfSum(args)}`, () => host.dymsum.MovingSolidSum.create(first(host, args), second(host, args), options));
  moving.set(...posesOf(args));
  return moving;
}

/** Whether there was a frame of this sum before: of the first one, nothing has changed. */
function hadFrame(host: Host, args: SumArgs): boolean {
  const mark = host.keep(`frames of ${keyOfSum(args)}`, () => ({ had: false, dispose: () => undefined })), { had } = mark;
  mark.had = true;
  return had;
}

function convexFrame(host: Host, args: SumArgs, start: number): SolidFrame {
  const buffers = convexOf(host, args, 'frame').buffers(), { triangleFacets, facetContacts } = buffers;
  const facetChanges = hadFrame(host, args) ? buffers.facetChanges : buffers.facetChanges.fill(0);
  const used = (t: number): boolean => buffers.triangles[3 * t] !== buffers.triangles[3 * t + 1];
  const kept = Uint32Array.from([...triangleFacets.keys()].filter(used));
  const triangles = new Uint32Array(3 * kept.length), faceOf = new Uint32Array(kept.length);
  kept.forEach((t, k) => {
    triangles.set(buffers.triangles.subarray(3 * t, 3 * t + 3), 3 * k);
    faceOf[k] = triangleFacets[t]!;
  });
  const none = { tightTriangles: new Uint32Array(), tightSegments: new Uint32Array(), tightPoints: new Uint32Array() };
  return {
    vertices: Float64Array.from(buffers.positions), triangles, faceOf, contacts: facetContacts, ...kindsOfFaces(faceOf, facetContacts, facetChanges),
    edges: boundaryEdges(triangles, faceOf), ...none, convex: true, vertexCount: buffers.vertexCount, faceCount: buffers.facetCount,
    changed: countChanged(new Set(faceOf), facetChanges), ms: performance.now() - start,
  };
}

function anyFrame(host: Host, args: SumArgs, start: number): SolidFrame {
  const moving = movingOf(host, args), shape = moving.shape(), marks = moving.faceChanges(), changes = hadFrame(host, args) ? marks : marks.fill(0);
  return {
    vertices: shape.vertices, triangles: shape.triangles, faceOf: shape.triangleFaces, contacts: shape.faceContacts,
    ...kindsOfFaces(shape.triangleFaces, shape.faceContacts, changes), edges: shape.edges, tightTriangles: shape.tightTriangles,
    tightSegments: shape.tightSegments, tightPoints: shape.tightPoints, convex: false, vertexCount: shape.vertices.length / 3,
    faceCount: changes.length, changed: countChanged(changes.keys(), changes), ms: performance.now() - start,
  };
}

function fitFrame(host: Host, args: SumArgs, start: number): SolidFrame {
  const shape = fitOf(host, args).shape(), { triangleFaces: faceOf, faceContacts: contacts } = shape, changes = new Uint8Array(contacts.length / 6);
  return {
    vertices: shape.vertices, triangles: shape.triangles, faceOf, contacts, ...kindsOfFaces(faceOf, contacts, changes), edges: shape.edges,
    tightTriangles: shape.tightTriangles, tightSegments: shape.tightSegments, tightPoints: shape.tightPoints, convex: false,
    vertexCount: shape.vertices.length / 3, faceCount: changes.length, changed: 0, ms: performance.now() - start,
  };
}

function countChanged(faces: Iterable<number>, changes: Uint8Array): number {
  let count = 0;
  for (const face of faces) if (changes[face] !== 0) ++count;
  return count;
}

function numbersOf(host: Host, args: SumArgs): SolidNumbers {
  if (!hasConvexSum(host, args)) return withSum(host, args, (sum) => ({ volume: sum.volume(), volumeExact: sum.volumeExact(kExactBits), shells: sum.shellCount }));
  const sum = convexOf(host, args, 'numbers');
  return { volume: sum.volume(), volumeExact: sum.volumeExact(), shells: 1 };
}

function withSum<T>(host: Host, args: SumArgs, ask: (sum: ReturnType<MovingSolidSum['sum']>) => T): T {
  return args.sum === 'fit' ? ask(fitOf(host, args)) : using(movingOf(host, args).sum(), ask);
}

/** Exact positions of vertices of the frame. */
function exactOf(host: Host, args: SumArgs, vertices: readonly number[]): string[] {
  const text = ({ x, y, z }: { x: string; y: string; z: string }): string => `${x}, ${y}, ${z}`;
  if (!hasConvexSum(host, args)) return withSum(host, args, (sum) => vertices.map((v) => text(sum.exact(v))));
  const sum = convexOf(host, args, 'frame'); // the one whose vertices have the frame's indices
  return vertices.map((v) => text(sum.exact(v)));
}

/** The exact area of the section, while nothing turns and all coordinates are doubles. */
function sectionOf(host: Host, args: SumArgs, z: number): SolidSection | null {
  if (args.sum === 'fit') return null;
  const p = first(host, args), q = second(host, args);
  const cut = (p: Mesh, q: Mesh): SolidSection =>
    using(host.dymsum.sliceOfSum(p, q, z, { semantics: args.semantics, progress: host.progress }), (slice) =>
      using(slice.section, (section) => ({ area: section.area(), exact: section.areaExact(kExactBits) })),
    );
  const found = args.moving === 'p' ? withScaled(p, args.scale, (scaled) => cut(scaled, q)) : withScaled(q, args.scale, (scaled) => cut(p, scaled));
  return found ?? null;
}

/** A solid by itself. */
function aloneOf(host: Host, { shape, thin }: { shape: Shape; thin: boolean }): AloneNumbers {
  const mesh = meshOf(host, shape, thin);
  return { vertices: mesh.vertexCount, faces: mesh.faceCount, shells: mesh.shellCount, volume: mesh.volume(), area: mesh.surfaceArea() };
}

function operandOf(host: Host, shape: Shape, thin: boolean): SolidOperand {
  try {
    return { ...meshOf(host, shape, thin).shape(), error: undefined };
  } catch (error) {
    if (!(error instanceof DymsumError) || isMade(shape)) throw error;
    const refused = { vertices: new Float64Array(), faceStarts: new Uint32Array([0]), faceVertices: new Uint32Array(), ...(error.evidence.line === undefined ? unchecked(host, shape) : {}) };
    return { ...refused, triangles: new Uint32Array(), error: error.toData() };
  }
}
function unchecked(host: Host, shape: Parameters<typeof bytesOf>[0]): object {
  try {
    return host.dymsum.Mesh.readData(shape.name, bytesOf(shape));
  } catch {
    return {}; // a file that is no such file has nothing to draw; the first error says why
  }
}

/** The file that `dymsum sum`, `nfp` or `erode` writes, or of what is turned or scaled `rotate` or `scale`: by the same writer, of a sum that is come to in the same way. */
function fileOf(host: Host, args: SumArgs, format: MeshFormat | 'json'): Uint8Array | string {
  const { dymsum } = host, file = (sum: SpatialSum | ConvexSum): Uint8Array | string => (format === 'json' ? sum.toJson() : sum.format(format));
  if (args.sum === 'fit') return file(fitOf(host, args));
  const p = first(host, args), q = second(host, args), poses = posesOnTheWay(args), options = { semantics: args.semantics, tight: true, progress: host.progress };
  const moved = <T extends ConvexSum | MovingSolidSum>(sum: T): T => {
    for (const pose of poses) sum.set(...pose);
    return sum;
  };
  if (isConvex(host, args)) return using(dymsum.ConvexSum.create(p, q), (sum) => file(moved(sum)));
  if (poses.length === 0) return using(dymsum.minkowskiSum(p, q, options), file);
  return using(dymsum.MovingSolidSum.create(p, q, options), (moving) => using(moved(moving).sum(), file));
}

function frameOf(host: Host, args: SumArgs): SolidFrame {
  const start = performance.now();
  if (args.sum === 'fit') return fitFrame(host, args, start);
  return hasConvexSum(host, args) ? convexFrame(host, args, start) : anyFrame(host, args, start);
}

export const solidServices = {
  solidOperand: (host: Host, { shape, thin }: { shape: Shape; thin: boolean }): SolidOperand => operandOf(host, shape, thin),
  solidAlone: aloneOf,
  solidAloneFile: (host: Host, { shape, thin, format }: { shape: Shape; thin: boolean; format: MeshFormat }): Uint8Array => meshOf(host, shape, thin).format(format),
  solidFrame: (host: Host, args: SumArgs): SolidFrame => frameOf(host, args),
  solidNumbers: (host: Host, { args }: { args: SumArgs }): SolidNumbers => numbersOf(host, args),
  solidDepth: (host: Host, { at, ...args }: SumArgs & { at: Place }): SolidDepthAnswer | Unknown => depthOf(host, args, at),
  solidSection: (host: Host, { args, z }: { args: SumArgs; z: number }): SolidSection | null => sectionOf(host, args, z),
  solidExact: (host: Host, { args, vertices }: { args: SumArgs; vertices: number[] }): string[] => exactOf(host, args, vertices),
  solidFile: (host: Host, { args, format }: { args: SumArgs; format: MeshFormat | 'json' }): Uint8Array | string => fileOf(host, args, format),
};
