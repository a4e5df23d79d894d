// Every page reads its own states back, and refuses what is none.
import { describe, expect, it } from 'vitest';
import { checkLength, parseDiscState } from './discs/state';
import { parseNestingState } from './nesting/state';
import { checkCoordinate, parseObstacleState } from './obstacle/state';
import { checkSumScale, parseSumState, sumState } from './sum/state';

const p = { name: 'a.wkt', text: 'POINT (1 2)' }, q = { name: 'gear', make: 'gear' as const, args: [5, 1, 2] };
const again = (value: unknown): unknown => JSON.parse(JSON.stringify(value));

describe('states out of documents', () => {
  it('of sums', () => {
    const state = sumState(p, q, { moving: 'q', motion: 'turn', tanHalf: 'inf', scale: '3/2:1', shown: 'hits', semantics: 'open', range: [1, 8], look: [0, 1, 2, 3], atP: [1, -2], layers: ['sum', 'crossings'], camera: { x: 1, y: 2, zoom: 3 } });
    expect(parseSumState(again(state))).toEqual(state);
    expect(parseSumState({ p, q, scale: 'x', layers: ['nonsense'], atP: [1, null] })).toEqual(sumState(p, q, { layers: [] }));
    expect(parseSumState(again({ ...state, q: null }))).toEqual({ ...state, q: null });
    expect(parseSumState({ p, q, shown: 'fit', motion: 'turn', tanHalf: '1' })).toMatchObject({ motion: 'scale', tanHalf: '0' });
    expect(() => parseSumState({ p })).toThrow('no shape');
    expect(() => parseSumState(null)).toThrow('no shape');
  });
  it('of discs', () => {
    expect(parseDiscState({ shape: q, alpha: '-1', operation: 'opened', event: 3 })).toMatchObject({ shape: q, alpha: '1/2', operation: 'opened', event: 3 });
  });
  it('of nesting', () => {
    const state = { a: p, b: q, parts: [p], semantics: 'closed', at: { kind: 'edge', index: 3, next: 4, along: '1/2' } };
    expect(parseNestingState(again(state))).toEqual(state);
    expect(() => parseNestingState({ a: p, b: q, at: { kind: 'edge', index: -1 } })).toThrow('no place');
  });
});

describe('numbers that no finite double comes near', () => {
  it('are left out of sums', () => {
    for (const scale of ['1e400', '1e-400', '2:1e309', '1'.padEnd(400, '0')]) expect(parseSumState({ p, q, scale })).toEqual(sumState(p, q));
    for (const scale of ['1e400', '1:1e-400', '1e300']) expect(checkSumScale(scale)).toMatch(/from 1e-150 to 1e\+150/);
    expect([checkSumScale('1e149'), checkSumScale('.5'), checkSumScale('5.:1/3')]).toEqual([undefined, undefined, undefined]);
  });
  it('are left out of discs', () => {
    expect(parseDiscState({ shape: q, alpha: '1e400', persistence: '1e309', alphaFrom: '1e-400', alphaTo: '1e999' })).toEqual(parseDiscState({ shape: q }));
    expect([checkLength('1e400'), checkLength('-1'), checkLength('.5')]).toEqual([expect.stringMatching(/too large/), expect.stringMatching(/not negative/), undefined]);
  });
  it('are no coordinates of a robot, nor shares of an edge', () => {
    const text = JSON.stringify({ robot: p, obstacle: q, at: { x: 'X', y: 1, tanHalf: '0' } }).replace('"X"', '1e400');
    expect(parseObstacleState(JSON.parse(text)).at).toEqual({ x: 0, y: 0, tanHalf: '0' });
    expect([checkCoordinate('1/3'), checkCoordinate('1e400'), checkCoordinate('0x10'), checkCoordinate(''), checkCoordinate('-.5')])
      .toEqual([expect.stringMatching(/no fraction/), expect.stringMatching(/too large/), expect.stringMatching(/decimal/), expect.stringMatching(/decimal/), undefined]);
    for (const along of ['1e400', '-1/2', '3/2']) expect(() => parseNestingState({ a: p, b: q, at: { kind: 'edge', index: 0, next: 1, along } })).toThrow('no place');
  });
});
