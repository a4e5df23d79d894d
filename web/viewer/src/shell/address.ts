// Keeps the address a permalink of the document, and opens what the reader goes to: a page or a shape that is left is one step back
// of the browser.
import { shapesIn } from '../engine/shape';
import type { Document, History } from './history';
import { fitsAddress, fromHash, mayFitAddress, toHash } from './permalink';

export const kSettleMs = 250;

/** What stands in an entry of the browser's history: the document, for it may be too large for the address. */
interface Entry {
  document: Document;
}

export function entryOf(state: unknown): Document | undefined {
  return (state as Partial<Entry> | null)?.document;
}

/** Changes with the page and with the names of its shapes. */
export function stepOf({ page, state }: Document): string {
  return [page, ...[...shapesIn(state)].map(({ name }) => name)].join('\n');
}

async function addressOf(document: Document): Promise<string> {
  const hash = mayFitAddress(document) ? await toHash(document) : undefined;
  return hash !== undefined && fitsAddress(hash) ? hash : `#/${document.page}`;
}

function put(how: 'pushState' | 'replaceState', document: Document, address: string): void {
  try {
    window.history[how](mayFitAddress(document) ? ({ document } satisfies Entry) : null, '', address);
  } catch {
    window.history[how](null, '', address); // still larger than what the browser keeps in an entry
  }
}

/** `open` shows a document of an entry that the reader goes to. */
export function followHistory(history: History, open: (document: Document) => void, report: (error: unknown) => void): void {
  let step = stepOf(history.document), timer = 0;
  /** what is shown and has no entry yet */
  let waiting: Document | undefined;
  const enter = (document: Document, address: string): void => {
    const isNew = stepOf(document) !== step;
    step = stepOf(document);
    waiting = undefined;
    put(isNew ? 'pushState' : 'replaceState', document, address);
  };
  const write = async (): Promise<void> => {
    const document = history.document, address = await addressOf(document);
    if (document === history.document) enter(document, address);
  };
  const go = (document: Document): void => {
    step = stepOf(document);
    waiting = undefined;
    open(document);
  };
  put('replaceState', history.document, location.href);
  history.subscribe(() => {
    clearTimeout(timer);
    // A page that is left soon after a change: there is no time to pack an address, and the entry holds the document.
    if (waiting && waiting.page !== history.document.page && mayFitAddress(waiting)) enter(waiting, `#/${waiting.page}`);
    waiting = history.document;
    timer = window.setTimeout(() => {
      if (!history.dragging) void write();
    }, kSettleMs);
  });
  addEventListener('popstate', (event) => {
    const document = entryOf(event.state);
    if (document) return go(document);
    fromHash(location.hash).then((linked) => linked && go(linked), report);
  });
}
