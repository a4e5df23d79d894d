import { expect, test } from 'vitest';
import { sortByKind } from './by_kind';

test('kinds follow each other, and every triangle knows where it came from', () => {
  const sorted = sortByKind(new Uint32Array([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]), new Uint8Array([2, 0, 2, 0]), 3);
  expect([...sorted.index]).toEqual([3, 4, 5, 9, 10, 11, 0, 1, 2, 6, 7, 8]);
  expect([...sorted.from]).toEqual([1, 3, 0, 2]);
  expect(sorted.groups).toEqual([
    { kind: 0, start: 0, count: 6 },
    { kind: 1, start: 6, count: 0 },
    { kind: 2, start: 6, count: 6 },
  ]);
});

test('nothing has groups of nothing', () => {
  expect(sortByKind(new Uint32Array(), new Uint8Array(), 2).groups.map((g) => g.count)).toEqual([0, 0]);
});
