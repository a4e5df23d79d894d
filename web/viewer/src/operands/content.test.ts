import { expect, it } from 'vitest';
import { contentError } from './content';

const file = (name: string, start: string, size = 1 << 21) => {
  const bytes = new Uint8Array(size).fill(65);
  bytes.set(new TextEncoder().encode(start));
  return { name, bytes };
};

it('tells large files that are none of their kind by their first bytes, and leaves small ones to the library', () => {
  expect(contentError(file('a.wkt', 'x\0y'))).toMatch(/"a\.wkt" is no text/);
  expect(contentError(file('a.wkt', 'x\0y', 100))).toBeUndefined();
  expect(contentError(file('a.wkt', 'POLYGON'))).toBeUndefined();
  expect(contentError(file('a.dxf', 'AutoCAD Binary DXF\r\n\x1a\0'))).toBeUndefined();
  expect(contentError(file('a.ply', 'plx'))).toMatch(/no \.ply file/);
  expect(contentError(file('a.ply', 'ply\n'))).toBeUndefined();
  expect(contentError(file('a.stl', 'solid x'))).toBeUndefined();
  expect(contentError(file('a.stl', '\0\0'))).toMatch(/no \.stl file/);
  expect(contentError(file('a.stl', '\0\0', 84 + 50 * 40_000))).toBeUndefined();
});
