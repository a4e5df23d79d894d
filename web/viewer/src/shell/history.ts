// The document that is shown, and the ones before and after it.

/** A page and its state. */
export interface Document {
  page: string;
  state: unknown;
}

const kMostSteps = 100;

export class History {
  private past: Document[] = [];
  private future: Document[] = [];
  /** how each page was left */
  private left = new Map<string, Document>();
  private inDrag = false;
  private listeners = new Set<() => void>();

  constructor(private present: Document) {}

  get document(): Document {
    return this.present;
  }
  /** What a page showed last; nothing where it was not shown yet. */
  lastOf(page: string): Document | undefined {
    return this.left.get(page);
  }
  get canUndo(): boolean {
    return this.past.length > 0;
  }
  get canRedo(): boolean {
    return this.future.length > 0;
  }
  /** Whether a drag goes on: permalinks wait for its end. */
  get dragging(): boolean {
    return this.inDrag;
  }

  subscribe(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  /** How often a document was opened from outside: pages begin anew then. */
  opened = 0;

  open(next: Document): void {
    ++this.opened;
    this.change(next);
  }

  /** Something that undo does not take back: where the reader looks. */
  amend(next: Document): void {
    this.show(next);
  }

  /** What changed outside of the document, such as a file that was saved: in what is shown, and in all that the reader can go back to. */
  renew(present: Document, other: (before: Document) => Document): void {
    this.past = this.past.map(other);
    this.future = this.future.map(other);
    for (const [page, document] of this.left) this.left.set(page, other(document));
    this.show(present);
  }

  /** All changes from the first live one to the next that is done are one step. */
  change(next: Document, how: 'live' | 'done' = 'done'): void {
    if (!this.inDrag) {
      this.past.push(this.present);
      if (this.past.length > kMostSteps) this.past.shift();
      this.future = [];
    }
    this.inDrag = how === 'live';
    this.show(next);
  }

  undo(): void {
    this.step(this.past, this.future);
  }
  redo(): void {
    this.step(this.future, this.past);
  }

  private step(from: Document[], to: Document[]): void {
    const next = from.pop();
    if (!next) return;
    to.push(this.present);
    this.inDrag = false;
    this.show(next);
  }

  private show(next: Document): void {
    this.left.set(this.present.page, this.present);
    this.present = next;
    this.left.set(next.page, next);
    for (const listener of this.listeners) listener();
  }
}
