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
  for (const [name, right, wrong] of [
    ['a.wkt', '\ufeff \n multipolygon z ((', 'abcdef'], ['a.json', '\n [[0, 0]', '"items"'], ['a.geojson', '{"type"', '<svg'], ['a.svg', '<?xml', '{'],
    ['a.poly', '# a comment', 'POLYGON'], ['a.poly', '2\n4 out', '-2'], ['a.off', '#\nOFF', 'solid'], ['a.off', 'STCNOFF 8 6 0', 'abcdefghOFF'], ['a.off', '8 6 12', '{'],
  ] as const) {
    expect(contentError(file(name, right))).toBeUndefined();
    expect(contentError(file(name, wrong))).toMatch(/does not begin as files of this kind do/);
    expect(contentError(file(name, wrong, 100))).toBeUndefined();
  }
  expect(contentError(file('a.dxf', 'AutoCAD Binary DXF\r\n\x1a\0'))).toBeUndefined();
  expect(contentError(file('a.ply', 'plx'))).toMatch(/no \.ply file/);
  expect(contentError(file('a.ply', 'ply\n'))).toBeUndefined();
  expect(contentError(file('a.stl', 'solid x'))).toBeUndefined();
  expect(contentError(file('a.stl', '\0\0'))).toMatch(/no \.stl file/);
  expect(contentError(file('a.stl', '\0\0', 84 + 50 * 40_000))).toBeUndefined();
});
