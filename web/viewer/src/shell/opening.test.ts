import { describe, expect, it } from 'vitest';
import { withNewFiles } from './opening';
import type { InputFile } from './page';

const file = (name: string, text: string): InputFile => ({ name, bytes: new TextEncoder().encode(text) });

describe('files that were saved anew', () => {
  const p = { name: 'p.wkt', text: 'old' }, gear = { name: 'gear', make: 'gear', args: [1, 2] };
  const document = { page: 'nesting', state: { a: p, b: gear, parts: [gear, p, { name: 'r.wkt', text: 'r' }], at: { kind: 'free', x: 1, y: 2 }, q: null } };
  it('take the place of those of their names, wherever they are', () => {
    const renewed = withNewFiles([file('p.wkt', 'new'), file('other.wkt', 'x')])(document), now = { name: 'p.wkt', text: 'new' };
    expect(renewed).toEqual({ page: 'nesting', state: { ...document.state, a: now, parts: [gear, now, { name: 'r.wkt', text: 'r' }] } });
    expect((renewed.state as typeof document.state).at).toBe(document.state.at);
  });
  it('leave documents without them as they are', () => {
    expect(withNewFiles([file('other.wkt', 'x'), file('p.wkt', 'old')])(document)).toBe(document);
  });
});
