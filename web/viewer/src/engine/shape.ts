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
  return shape.base64 ? Uint8Array.from(atob(shape.text), (c) => c.charCodeAt(0)) : shape.text;
}

/** A shape of a file that was dropped: text where it is valid UTF-8, else base64. */
export function shapeOfFile(file: { name: string; bytes: Uint8Array }): FileShape {
  try {
    return { name: file.name, text: new TextDecoder('utf-8', { fatal: true }).decode(file.bytes) };
  } catch {
    let text = '';
    for (const byte of file.bytes) text += String.fromCharCode(byte);
    return { name: file.name, text: btoa(text), base64: true };
  }
}
