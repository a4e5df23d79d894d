// Every page reads its own states back, and refuses what is none.
import { describe, expect, it } from 'vitest';
import { parseDiscState } from './discs/state';
import { parseNestingState } from './nesting/state';
import { parseSumState, sumState } from './sum/state';

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
