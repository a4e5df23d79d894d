import { describe, expect, it } from 'vitest';
import { History } from './history';

const at = (n: number) => ({ page: 'sum', state: n });

describe('History', () => {
  it('takes a drag back as one step', () => {
    const history = new History(at(0));
    history.change(at(1));
    for (const n of [2, 3, 4]) history.change(at(n), 'live');
    history.change(at(5), 'done');
    expect(history.document).toEqual(at(5));
    history.undo();
    expect(history.document).toEqual(at(1));
    history.undo();
    expect(history.document).toEqual(at(0));
    expect(history.canUndo).toBe(false);
    history.redo();
    history.redo();
    expect(history.document).toEqual(at(5));
    expect(history.canRedo).toBe(false);
  });
  it('forgets what was undone when something else is done', () => {
    const history = new History(at(0));
    history.change(at(1));
    history.undo();
    history.change(at(2));
    expect(history.canRedo).toBe(false);
  });
  it('does not take back where the reader looks', () => {
    const history = new History(at(0));
    history.change(at(1));
    history.amend(at(2));
    history.undo();
    expect(history.document).toEqual(at(0));
  });
  it('keeps a hundred steps', () => {
    const history = new History(at(0));
    for (let n = 1; n <= 250; ++n) history.change(at(n));
    let steps = 0;
    for (; history.canUndo; ++steps) history.undo();
    expect(steps).toBe(100);
  });
  it('tells its listeners until they leave', () => {
    const history = new History(at(0));
    let told = 0;
    const leave = history.subscribe(() => ++told);
    history.change(at(1));
    leave();
    history.change(at(2));
    expect(told).toBe(1);
  });
  it('keeps how each page was left', () => {
    const history = new History({ page: 'sum', state: 0 });
    history.change({ page: 'discs', state: 1 });
    history.change({ page: 'discs', state: 2 });
    history.amend({ page: 'discs', state: 3 });
    expect(['sum', 'discs', 'solids'].map((page) => history.lastOf(page)?.state)).toEqual([0, 3, undefined]);
    history.undo();
    history.undo();
    expect(history.lastOf('discs')).toEqual({ page: 'discs', state: 1 });
  });
  it('renews what was and what will be, too', () => {
    const history = new History(at(0)), seen = (): unknown => history.document.state;
    for (const n of [1, 2]) history.change(at(n));
    history.change({ page: 'discs', state: 3 });
    history.undo();
    history.undo();
    history.renew(at(10), ({ page, state }) => ({ page, state: (state as number) + 100 }));
    expect([seen(), history.lastOf('discs')?.state]).toEqual([10, 103]);
    history.undo();
    expect(seen()).toBe(100);
    history.redo();
    history.redo();
    expect(seen()).toBe(102);
    history.redo();
    expect([seen(), history.canRedo]).toEqual([103, false]);
  });
});
