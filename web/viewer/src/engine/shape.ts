// A shape as documents hold it: a file's text, or a call of one of the library's generators.

export type Generator =
  | 'rectangle' | 'disc' | 'gear' | 'grate' | 'comb' | 'star' | 'noisyStar' | 'spiral' | 'letterU' | 'letterL' | 'pockets' | 'randomPolygon';
export type SolidGenerator =
  | 'box' | 'tessellatedCube' | 'cone' | 'cylinder' | 'dipyramid' | 'pyramid' | 'geodesicSphere' | 'ellipsoid' | 'triakisIcosahedron'
  | 'truncatedIcosidodecahedron' | 'rod'
  | 'torus' | 'wheel' | 'starPrism' | 'channel' | 'angle';

/** The text of a file, its name with the extension that tells the format; binary files in base64. */
export interface FileShape {
  name: string;
  text: string;
  base64?: true;
}
export interface MadeShape {
  name: string;
  make: Generator | SolidGenerator;
  args: number[];
}
export type Shape = FileShape | MadeShape;

export function isMade(shape: Shape): shape is MadeShape {
  return 'make' in shape;
}

/** What names a shape's content: equal keys, equal shapes. */
export function keyOf(shape: Shape): string {
  return isMade(shape) ? `${shape.make}(${shape.args.join()})` : `${shape.name}\n${shape.text}`;
}

/** The shapes in a state, or in what is asked about. */
export function shapesIn(value: unknown, found = new Set<Shape>()): Set<Shape> {
  if (typeof value !== 'object' || value === null || ArrayBuffer.isView(value)) return found;
  if ('name' in value && ('text' in value || 'make' in value)) return found.add(value as Shape);
  for (const part of Object.values(value)) shapesIn(part, found);
  return found;
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null;
}

/** A shape out of a document. Throws an Error where it is none. */
export function parseShape(value: unknown): Shape {
  if (isRecord(value) && typeof value.name === 'string') {
    const { name, text, make, args, base64 } = value;
    if (typeof text === 'string') return base64 === true ? { name, text, base64 } : { name, text };
    if (typeof make === 'string' && Array.isArray(args) && args.every((a) => typeof a === 'number'))
      return { name, make: make as MadeShape['make'], args: args };
  }
  throw new Error('The document holds something that is no shape.');
}

/** The bytes of a file shape. */
export function bytesOf(shape: FileShape): string | Uint8Array {
  if (!shape.base64) return shape.text;
  const text = atob(shape.text), bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k); // megabytes: no call for each
  return bytes;
}

/** A shape of a file that was dropped: text where it is valid UTF-8, else base64. */
export function shapeOfFile(file: { name: string; bytes: Uint8Array }): FileShape {
  try {
    return { name: file.name, text: new TextDecoder('utf-8', { fatal: true }).decode(file.bytes) };
  } catch {
    let text = '';
    for (let k = 0; k < file.bytes.length; k += 8192) text += String.fromCharCode(...file.bytes.subarray(k, k + 8192));
    return { name: file.name, text: btoa(text), base64: true };
  }
}
