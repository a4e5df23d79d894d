// What a bar of the lifetimes stands for in a sum.
import type { SumShape } from 'dymsum';
import { describe, expect, it } from 'vitest';
import type { Life } from './families';
import { aliveIn, lifeText } from './living';

const kNone = 0xffffffff;
/** A triangle and a hole of three: contact k is edge k of P at vertex 9 of Q, from vertex k on; the last vertex is a crossing. */
const kShape = {
  ringStarts: Uint32Array.of(0, 3, 6),
  contacts: Uint32Array.from([0, 1, 2, 3, 4, 5].flatMap((k) => [0, k < 3 ? (k + 2) % 3 : 3 + ((k + 2) % 3), 9, 0, k, 9])),
  corners: Uint32Array.of(0, 9, 1, 9, 2, 9, 3, 9, 4, 9, kNone, kNone),
} as unknown as SumShape;
const contact = (p: number, kind: 'edge_of_p' | 'edge_of_q' = 'edge_of_p') => ({ kind, p, q: 9 });
const life = (changes: Partial<Life>): Life => ({ feature: 'vertex', in: null, out: null, cornerP: null, cornerQ: null, hole: null, from: 0.05, to: 4, born: null, died: null, ...changes });

describe('a life', () => {
  it('is found in a sum by its contacts', () => {
    expect(aliveIn(kShape, life({ feature: 'edge', in: contact(2), out: contact(2) }))).toEqual({ vertices: [], edges: [[2, 0]] });
    expect(aliveIn(kShape, life({ feature: 'edge', in: contact(4), out: contact(4) }))).toEqual({ vertices: [], edges: [[4, 5]] });
    expect(aliveIn(kShape, life({ in: contact(0), out: contact(1), cornerP: 1, cornerQ: 9 }))).toEqual({ vertices: [1], edges: [] });
    expect(aliveIn(kShape, life({ in: contact(4), out: contact(5) }))).toEqual({ vertices: [5], edges: [] });
  });
  it('is not found where it is another one, or is not there', () => {
    const nothing = { vertices: [], edges: [] };
    expect(aliveIn(kShape, life({ in: contact(0), out: contact(1) }))).toEqual(nothing); // a crossing, no sum of vertices
    expect(aliveIn(kShape, life({ in: contact(0), out: contact(1), cornerP: 2, cornerQ: 9 }))).toEqual(nothing);
    expect(aliveIn(kShape, life({ in: contact(2), out: contact(1), cornerP: 1, cornerQ: 9 }))).toEqual(nothing);
    expect(aliveIn(kShape, life({ feature: 'edge', in: contact(2, 'edge_of_q'), out: contact(2, 'edge_of_q') }))).toEqual(nothing);
    expect(aliveIn(kShape, life({ feature: 'hole', hole: 3 }))).toEqual(nothing);
  });
  it('says what it is and when it is there', () => {
    const sum = { names: ['P', 'Q'], between: '+' } as const;
    expect(lifeText(life({ feature: 'hole', hole: 3, born: '1/2', from: 0.5, died: '2/1', to: 2 }), sum)).toBe('hole, from 1/2 to 2');
    expect(lifeText(life({ feature: 'edge', in: contact(2), out: contact(2) }), sum)).toBe('edge: edge 2 of P + vertex 9 of Q, at all scales of the slider');
    expect(lifeText(life({ feature: 'hole', hole: 3, born: '1/3', from: 1 / 3 }), sum)).toBe('hole, from 1/3 on');
    const long = '12345678901234567890/10000000000000000001';
    expect(lifeText(life({ in: contact(0), out: contact(1), cornerP: 1, cornerQ: 9, died: long, to: 1.2345678 }), { ...sum, between: '−' })).toBe('vertex: vertex 1 of P − vertex 9 of Q, up to 1.23457');
    expect(lifeText(life({ in: contact(4), out: contact(5) }), sum)).toMatch(/^vertex: crossing of edge 4 of P \+ vertex 9 of Q and edge 5 of P \+ vertex 9 of Q,/);
  });
});
