// Keeps the address a permalink of the document, and opens the permalinks that the reader goes to.
import type { Document, History } from './history';
import { fromHash, toHash } from './permalink';

const kSettleMs = 250;

export function followDocument(history: History): void {
  let timer = 0;
  const write = async (): Promise<void> => {
    const document = history.document;
    const hash = await toHash(document);
    if (document === history.document) window.history.replaceState(null, '', hash);
  };
  history.subscribe(() => {
    clearTimeout(timer);
    timer = window.setTimeout(() => {
      if (!history.dragging) void write();
    }, kSettleMs);
  });
}

/** Addresses written by `followDocument` fire no such event. */
export function followAddress(open: (document: Document) => void, report: (error: unknown) => void): void {
  addEventListener('hashchange', () => {
    fromHash(location.hash).then((document) => {
      if (document) open(document);
    }, report);
  });
}
