import { describe, expect, it, vi } from 'vitest';
import { followHistory, kSettleMs, stepOf } from './address';
import { History, type Document } from './history';
import { fitsAddress, fromHash, toHash } from './permalink';

const shape = (name: string, text = '') => ({ name, text });
const sum = (p: string, scale = '1', text = ''): Document => ({ page: 'sum', state: { p: shape(p, text), q: shape('q'), scale } });

/** The browser's history, as far as it is used. */
class Browser {
  entries: { state: unknown; address: string }[] = [{ state: null, address: '' }];
  at = 0;
  listeners: ((event: { state: unknown }) => void)[] = [];
  replaceState(state: unknown, _: string, address: string): void {
    this.entries[this.at] = { state, address };
  }
  pushState(state: unknown, _: string, address: string): void {
    this.entries.length = ++this.at;
    this.entries.push({ state, address });
  }
  back(): void {
    const { state } = this.entries[--this.at]!;
    for (const listener of this.listeners) listener({ state });
  }
}

function followed(first: Document): { history: History; browser: Browser; settle: () => Promise<void> } {
  const browser = new Browser();
  vi.stubGlobal('window', { history: browser, setTimeout });
  vi.stubGlobal('location', { href: 'page.html', hash: '' });
  vi.stubGlobal('addEventListener', (type: string, listener: (event: { state: unknown }) => void) => type === 'popstate' && browser.listeners.push(listener));
  const history = new History(first);
  followHistory(history, (document) => history.open(document), (error) => expect.unreachable(String(error)));
  /** Until the entry holds what is shown, and nothing is to be written any more. */
  const settle = async (): Promise<void> => {
    await new Promise((done) => setTimeout(done, 2 * kSettleMs));
    await vi.waitFor(() => expect((browser.entries[browser.at]!.state as { document: Document }).document).toBe(history.document), 30_000);
  };
  return { history, browser, settle };
}

describe('the address', () => {
  it('is another step with another page or shape, and the same one with all else', () => {
    expect(stepOf(sum('p', '2'))).toBe(stepOf(sum('p', '1')));
    expect(stepOf(sum('p', '1', 'pulled'))).toBe(stepOf(sum('p')));
    expect(stepOf(sum('r'))).not.toBe(stepOf(sum('p')));
    expect(stepOf({ ...sum('p'), page: 'nesting' })).not.toBe(stepOf(sum('p')));
  });
  it('goes back to the shape before, as it was left', async () => {
    const { history, browser, settle } = followed(sum('p'));
    history.change(sum('p', '3/2'));
    await settle();
    expect(browser.entries.length).toBe(1);
    history.change(sum('r', '3/2'));
    await settle();
    expect(browser.entries.length).toBe(2);
    expect(await fromHash(browser.entries[1]!.address)).toEqual(sum('r', '3/2'));
    browser.back();
    expect(history.document).toEqual(sum('p', '3/2'));
    await settle();
    expect([browser.at, browser.entries.length]).toEqual([0, 2]);
  });
  it('goes back to a page as it was left, however soon', async () => {
    const { history, browser, settle } = followed(sum('p'));
    history.change(sum('r'));
    history.change({ page: 'nesting', state: { a: shape('a') } });
    await settle();
    expect(browser.entries.length).toBe(3);
    browser.back();
    expect(history.document).toEqual(sum('r'));
    await settle();
    expect(await fromHash(browser.entries[1]!.address)).toEqual(sum('r'));
    browser.back();
    expect(history.document).toEqual(sum('p'));
    await settle();
    expect([browser.at, browser.entries.length]).toEqual([0, 3]);
  });
  it('names the page alone where the document is too large for browsers', async () => {
    const large = sum('p', '1', Array.from({ length: 100_000 }, (_, k) => Math.sin(k)).join(' '));
    expect(fitsAddress(await toHash(large))).toBe(false);
    expect(fitsAddress(await toHash(sum('p')))).toBe(true);
    const { history, browser, settle } = followed(sum('p'));
    history.change(large);
    await settle();
    expect(browser.entries[0]).toEqual({ state: { document: large }, address: '#/sum' });
  }, 60_000);
});
