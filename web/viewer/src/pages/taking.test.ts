// What pages take of files, and what they keep.
import { describe, expect, it, vi } from 'vitest';
import type { InputFile } from '../shell/page';

vi.stubGlobal('matchMedia', () => ({ matches: false, addEventListener: () => undefined })); // what pages ask a browser when they are loaded
vi.stubGlobal('document', { documentElement: { dataset: {} } });
const { discsPage } = await import('./discs/page');
const { nestingPage } = await import('./nesting/page');
const { obstaclePage } = await import('./obstacle/page');
const { solidsPage } = await import('./solids/page');
const { sumPage } = await import('./sum/page');

const file = (name: string, text = 'POINT (1 2)'): InputFile => ({ name, bytes: new TextEncoder().encode(text) });

describe('files of the same names, saved anew', () => {
  it('leave the poses of a robot and its path', () => {
    const state = { ...obstaclePage.take([file('r.wkt'), file('o.wkt')], obstaclePage.examples[0].state), path: true, strict: true };
    delete state.unplaced;
    const again = obstaclePage.take([file('r.wkt', 'new'), file('o.wkt')], state);
    expect(again).toEqual({ ...state, robot: { name: 'r.wkt', text: 'new' } });
    expect(obstaclePage.take([file('other.wkt')], again)).toMatchObject({ obstacle: { name: 'other.wkt' }, robot: again.robot, unplaced: true, path: false });
  });
  it('leave a disc and its cuts', () => {
    const state = { ...discsPage.take([file('p.wkt')], discsPage.examples[0].state), alpha: '3', cuts: true };
    expect(discsPage.take([file('p.wkt', 'new')], state)).toEqual({ ...state, shape: { name: 'p.wkt', text: 'new' } });
    expect(discsPage.take([file('q.wkt')], state)).toMatchObject({ alpha: '1/2', cuts: false });
  });
  it('leave what was chosen of many parts, and where B stands', () => {
    const files = ['a.wkt', 'b.wkt', 'c.wkt'].map((name) => file(name)), taken = nestingPage.take(files, nestingPage.examples[0].state);
    expect(taken.parts.map((p) => p.name)).toEqual(['a.wkt', 'b.wkt', 'c.wkt']);
    const state = { ...taken, b: taken.parts[2]!, at: { kind: 'free', x: 3, y: 4 } as const };
    expect(nestingPage.take(files, state)).toEqual(state);
    expect(nestingPage.take([file('d.wkt')], state)).toEqual({ ...state, unopened: { name: 'd.wkt', text: 'POINT (1 2)' } });
    expect(nestingPage.take([file('d.wkt'), file('e.wkt')], state)).toMatchObject({ a: { name: 'd.wkt' }, b: { name: 'e.wkt' }, parts: [], at: { x: 0, y: 0 } });
  });
  it('leave the motion of sums, and one shape alone', () => {
    const sum = { ...sumPage.examples[0].state, scale: '2' }, solids = { ...solidsPage.examples[0].state, q: null };
    expect(sumPage.take([file('a.wkt'), file('b.wkt')], sum)).toMatchObject({ scale: '2', p: { name: 'a.wkt' }, q: { name: 'b.wkt' } });
    expect(solidsPage.take([file('a.off')], solids as never)).toMatchObject({ p: { name: 'a.off' }, q: null });
  });
});

describe('other files', () => {
  it('are refused, by their names', () => {
    expect(() => sumPage.take([file('a.off')], sumPage.examples[0].state)).toThrow('"a.off" holds no region');
    expect(() => solidsPage.take([file('a.wkt')], solidsPage.examples[0].state)).toThrow('"a.wkt" holds no solid');
    expect(() => discsPage.take([file('a.wkt'), file('b.wkt')], discsPage.examples[0].state)).toThrow('too many');
  });
  it('of several pages are told apart', async () => {
    const { pages } = await import('./index'), { firstDocument, withFiles } = await import('../shell/opening');
    const sum = firstDocument(pages[0]);
    expect(() => withFiles(pages, sum, [file('a.wkt'), file('b.off')])).toThrow('No page takes these files together: "a.wkt" is for Sum, Robot, Growing discs, Nesting; "b.off" is for Solids. Open them one after the other.');
    expect(() => withFiles(pages, sum, [file('a.wkt'), file('b.png')])).toThrow('"b.png" holds no region');
    expect(() => withFiles(pages, sum, ['a.off', 'b.off', 'c.off'].map((name) => file(name)))).toThrow('"a.off" holds no region');
    expect(withFiles(pages, sum, [file('b.off')]).page).toBe('solids');
  });
});
