// The answer to the newest question of a component. While one is computed only the newest of the others waits.
import { useCallback, useEffect, useLayoutEffect, useRef, useState } from 'preact/hooks';
import type { Engine } from './client';
import type { Answer, Args, ServiceName } from './services';

interface Known<K extends ServiceName> {
  value: Answer<K> | undefined;
  of: Args<K> | undefined;
  error: unknown;
  errorOf: Args<K> | undefined;
}

export interface Asked<K extends ServiceName> extends Standing {
  /** The last answer that came, also while another one is awaited; nothing after an error. */
  value: Answer<K> | undefined;
  /** What `value` is the answer to. */
  of: Args<K> | undefined;
}

/** How it stands with the newest question. */
export interface Standing {
  /** It has had no answer for a while, nor one to an older question came meanwhile: what is shown is no longer of now. */
  waiting: boolean;
  /** Why it has no answer. */
  error: unknown;
  /** Asks it once more. */
  again: () => void;
}

/** How it stands with several questions: the first error counts. */
export function together(...all: readonly Standing[]): Standing {
  return {
    waiting: all.some(({ waiting }) => waiting),
    error: all.find(({ error }) => error !== undefined)?.error,
    again: () => all.forEach(({ error, again }) => error !== undefined && again()),
  };
}

function sameEntries(a: object | undefined, b: object | undefined): boolean {
  if (!a || !b) return a === b;
  const left = Object.entries(a), right = b as Record<string, unknown>;
  return left.length === Object.keys(b).length && left.every(([key, value]) => Object.is(value, right[key]));
}

class Asker<K extends ServiceName> {
  private newest: Args<K> | undefined;
  private waiting = false;
  private busy = false;
  private gone = false;

  constructor(
    private engine: Engine,
    private service: K,
    private show: (known: Known<K>) => void,
  ) {}

  ask(args: Args<K> | undefined): void {
    if (sameEntries(this.newest, args)) return;
    this.newest = args;
    this.waiting = args !== undefined;
    if (!this.busy) void this.next();
  }

  readonly again = (): void => {
    this.waiting = this.newest !== undefined;
    this.show({ value: undefined, of: undefined, error: undefined, errorOf: undefined });
    if (!this.busy) void this.next();
  };

  leave(): void {
    this.gone = true;
  }

  private async next(): Promise<void> {
    this.busy = true;
    while (this.waiting && !this.gone) {
      const of = this.newest!;
      this.waiting = false;
      try {
        const value = await this.engine.ask(this.service, of);
        if (!this.gone) this.show({ value, of, error: undefined, errorOf: undefined });
      } catch (error) {
        if (!this.gone && !this.waiting) this.show({ value: undefined, of: undefined, error, errorOf: of });
      }
    }
    this.busy = false;
  }
}

const kLongMs = 350; // frames of a drag take less

/** Whether something has been true for a while, without a new `since`. */
function useLasting(isTrue: boolean, since: unknown): boolean {
  const [lasts, setLasts] = useState(false);
  useEffect(() => {
    setLasts(false);
    if (!isTrue) return undefined;
    const timer = setTimeout(() => setLasts(true), kLongMs);
    return () => clearTimeout(timer);
  }, [isTrue, since]);
  return lasts;
}

/** Arguments are compared entry by entry, by identity; with `undefined` nothing is asked. */
export function useAnswer<K extends ServiceName>(engine: Engine, service: K, args: Args<K> | undefined): Asked<K> {
  const [{ value, of, error, errorOf }, show] = useState<Known<K>>({ value: undefined, of: undefined, error: undefined, errorOf: undefined });
  const asker = useRef<Asker<K>>();
  useLayoutEffect(() => { // at once: other effects wait for the next frame
    asker.current = new Asker(engine, service, show);
    return () => asker.current?.leave();
  }, [engine, service]);
  useLayoutEffect(() => asker.current!.ask(args));
  const failed = error !== undefined && args !== undefined && sameEntries(errorOf, args);
  const again = useCallback(() => asker.current?.again(), []);
  const open = args !== undefined && !failed && !sameEntries(of, args), waiting = useLasting(open, of);
  return { value, of, error: failed ? error : undefined, waiting: open && waiting, again };
}
