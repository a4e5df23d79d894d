// Sums of solids of which Q turns and is scaled.
import { DymsumError, type ConvexSum, type Mesh, type MeshFormat, type MovingSolidSum, type Rotation, type SolidFeature, type SolidPose } from 'dymsum';
import type { Host } from '../../engine/host';
import type { ErrorData } from '../../engine/protocol';
import { bytesOf, isMade, keyOf, type Shape } from '../../engine/shape';
import { parseRational, toNumber } from '../../numbers/rational';
import { boundaryEdges, kindsOfFaces } from './faces';
import { kAxes, type SolidsState } from './state';

export interface SolidOperand {
  vertices: Float64Array;
  triangles: Uint32Array;
  faceStarts: Uint32Array;
  faceVertices: Uint32Array;
  /** why no sum can be made of it */
  error: ErrorData | undefined;
}
export type SumArgs = Pick<SolidsState, 'p' | 'q' | 'sum' | 'axis' | 'angle' | 'scale'>;
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
export interface SolidDepthAnswer {
  inside: boolean;
  depth: number;
  squared: string;
  direction: readonly [number, number, number];
  p: SolidFeature;
  q: SolidFeature;
}

const kExactBits = 4096;

function poseOf({ axis, angle, scale }: SumArgs): SolidPose {
  return { rotation: rotationOf(axis, angle), scale };
}
function rotationOf(axis: SumArgs['axis'], degrees: number): Rotation {
  return { axis: kAxes[axis], angle: (degrees * Math.PI) / 180 };
}

/** Q, or −Q. */
function second(host: Host, { q, sum }: Pick<SumArgs, 'q' | 'sum'>): Mesh {
  return sum === 'sum' ? host.mesh(q) : host.keep(`negated ${keyOf(q)}`, () => host.mesh(q).negated());
}
function isConvex(host: Host, ...solids: Shape[]): boolean {
  const known = (shape: Shape): { convex: boolean; dispose: () => void } =>
    host.keep(`convexity ${keyOf(shape)}`, () => ({ convex: host.mesh(shape).convexityError() === null, dispose: () => undefined }));
  return solids.every((shape) => known(shape).convex);
}
function keyOfSum({ p, q, sum }: SumArgs): string {
  return `${sum} ${keyOf(p)} ${keyOf(q)}`;
}
function convexOf(host: Host, args: SumArgs, purpose: string): ConvexSum {
  return host.keep(`convex ${purpose} ${keyOfSum(args)}`, () => host.dymsum.ConvexSum.create(host.mesh(args.p), second(host, args)));
}
function movingOf(host: Host, args: SumArgs): MovingSolidSum {
  const semantics = args.sum === 'sum' ? 'closed' : 'open';
  return host.keep(`moving ${keyOfSum(args)}`, () =>
    host.dymsum.MovingSolidSum.create(host.mesh(args.p), second(host, args), { semantics, tight: true, progress: host.progress }),
  );
}

/** Whether there was a frame of this sum before: of the first one, nothing has changed. */
function hadFrame(host: Host, args: SumArgs): boolean {
  const mark = host.keep(`frames of ${keyOfSum(args)}`, () => ({ had: false, dispose: () => undefined })), { had } = mark;
  mark.had = true;
  return had;
}

function convexFrame(host: Host, args: SumArgs, start: number): SolidFrame {
  const sum = convexOf(host, args, 'frame');
  sum.set({}, poseOf(args));
  const buffers = sum.buffers(), { triangleFacets, facetContacts } = buffers;
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
  const moving = movingOf(host, args);
  moving.set({}, poseOf(args));
  const shape = moving.shape(), marks = moving.faceChanges(), changes = hadFrame(host, args) ? marks : marks.fill(0);
  return {
    vertices: shape.vertices, triangles: shape.triangles, faceOf: shape.triangleFaces, contacts: shape.faceContacts,
    ...kindsOfFaces(shape.triangleFaces, shape.faceContacts, changes), edges: shape.edges, tightTriangles: shape.tightTriangles,
    tightSegments: shape.tightSegments, tightPoints: shape.tightPoints, convex: false, vertexCount: shape.vertices.length / 3,
    faceCount: changes.length, changed: countChanged(changes.keys(), changes), ms: performance.now() - start,
  };
}

function countChanged(faces: Iterable<number>, changes: Uint8Array): number {
  let count = 0;
  for (const face of faces) if (changes[face] !== 0) ++count;
  return count;
}

function numbersOf(host: Host, args: SumArgs): SolidNumbers {
  if (isConvex(host, args.p, args.q)) {
    const sum = convexOf(host, args, 'numbers');
    sum.set({}, poseOf(args));
    return { volume: sum.volume(), volumeExact: sum.volumeExact(), shells: 1 };
  }
  return withSum(host, args, (sum) => ({ volume: sum.volume(), volumeExact: sum.volumeExact(kExactBits), shells: sum.shellCount }));
}

function withSum<T>(host: Host, args: SumArgs, ask: (sum: ReturnType<MovingSolidSum['sum']>) => T): T {
  const moving = movingOf(host, args);
  moving.set({}, poseOf(args));
  const sum = moving.sum();
  try {
    return ask(sum);
  } finally {
    sum.dispose();
  }
}

/** Exact positions of vertices of the frame. */
function exactOf(host: Host, args: SumArgs, vertices: readonly number[]): string[] {
  const text = ({ x, y, z }: { x: string; y: string; z: string }): string => `${x}, ${y}, ${z}`;
  if (!isConvex(host, args.p, args.q)) return withSum(host, args, (sum) => vertices.map((v) => text(sum.exact(v))));
  const sum = convexOf(host, args, 'frame'); // the one whose vertices have the frame's indices
  sum.set({}, poseOf(args));
  return vertices.map((v) => text(sum.exact(v)));
}

function depthOf(host: Host, args: SumArgs, [x, y, z]: readonly [number, number, number]): SolidDepthAnswer {
  const at = { x, y, z }, hits = { ...args, sum: 'hits' as const };
  const answer = isConvex(host, args.p, args.q) ? convexDepth(host, hits, at) : anyDepth(host, hits, at);
  const { inside, depth, depthSquared, direction, p, q } = answer;
  return { inside, depth, squared: depthSquared, direction: [direction.x, direction.y, direction.z], p, q };
}
function convexDepth(host: Host, args: SumArgs, at: { x: number; y: number; z: number }) {
  const sum = convexOf(host, args, 'depth');
  sum.set({}, poseOf(args));
  return sum.depth(at);
}
function anyDepth(host: Host, args: SumArgs, at: { x: number; y: number; z: number }) {
  const factor = toNumber(parseRational(args.scale)!);
  const depth = host.keep(`depth ${args.scale} ${keyOfSum(args)}`, () => {
    const scaled = host.mesh(args.q).scaled(factor, factor, factor);
    const made = host.dymsum.TurnedDepth.create(host.mesh(args.p), scaled);
    scaled.dispose();
    return made;
  });
  return depth.at(at, rotationOf(args.axis, args.angle));
}

/** The exact area of the section, while Q is not turned: then all coordinates are doubles. */
function sectionOf(host: Host, args: SumArgs, z: number): { area: number; exact: string | null } {
  const factor = toNumber(parseRational(args.scale)!), scaled = second(host, args).scaled(factor, factor, factor);
  const slice = host.dymsum.sliceOfSum(host.mesh(args.p), scaled, z, { progress: host.progress });
  const answer = { area: slice.section.area(), exact: slice.section.areaExact(kExactBits) };
  slice.section.dispose();
  slice.dispose();
  scaled.dispose();
  return answer;
}

function operandOf(host: Host, shape: Shape): SolidOperand {
  try {
    return { ...host.mesh(shape).shape(), error: undefined };
  } catch (error) {
    if (!(error instanceof DymsumError) || isMade(shape)) throw error;
    const refused = { vertices: new Float64Array(), faceStarts: new Uint32Array([0]), faceVertices: new Uint32Array(), ...unchecked(host, shape) };
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

function fileOf(host: Host, args: SumArgs, format: MeshFormat | 'json'): Uint8Array | string {
  if (format === 'json') return jsonOf(host, args);
  if (!isConvex(host, args.p, args.q)) return withSum(host, args, (sum) => sum.format(format));
  const sum = convexOf(host, args, 'numbers');
  sum.set({}, poseOf(args));
  const mesh = sum.mesh(), bytes = mesh.format(format);
  mesh.dispose();
  return bytes;
}

/** Exact vertices, faces as triangles with what touches there. */
function jsonOf(host: Host, args: SumArgs): string {
  const frame = frameOf(host, args), used = [...new Set(frame.triangles)].sort((a, b) => a - b);
  const place = new Map(used.map((v, k) => [v, k]));
  const exact = exactOf(host, args, used);
  const triangles = Array.from(frame.faceOf, (face, t) => ({
    vertices: [...frame.triangles.subarray(3 * t, 3 * t + 3)].map((v) => place.get(v)), face, contact: [...frame.contacts.subarray(6 * face, 6 * face + 6)],
  }));
  return JSON.stringify({ vertices: exact, triangles }, null, 1);
}

function frameOf(host: Host, args: SumArgs): SolidFrame {
  const start = performance.now();
  return isConvex(host, args.p, args.q) ? convexFrame(host, args, start) : anyFrame(host, args, start);
}

export const solidServices = {
  solidOperand: (host: Host, { shape }: { shape: Shape }): SolidOperand => operandOf(host, shape),
  solidFrame: (host: Host, args: SumArgs): SolidFrame => frameOf(host, args),
  solidNumbers: (host: Host, { args }: { args: SumArgs }): SolidNumbers => numbersOf(host, args),
  solidDepth: (host: Host, { at, ...args }: SumArgs & { at: readonly [number, number, number] }): SolidDepthAnswer => depthOf(host, args, at),
  solidSection: (host: Host, { args, z }: { args: SumArgs; z: number }) => sectionOf(host, args, z),
  solidExact: (host: Host, { args, vertices }: { args: SumArgs; vertices: number[] }): string[] => exactOf(host, args, vertices),
  solidFile: (host: Host, { args, format }: { args: SumArgs; format: MeshFormat | 'json' }): Uint8Array | string => fileOf(host, args, format),
};
