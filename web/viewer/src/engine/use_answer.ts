// The answer to the newest question of a component. While one is computed only the newest of the others waits.
import { useLayoutEffect, useRef, useState } from 'preact/hooks';
import type { Engine } from './client';
import type { Answer, Args, ServiceName } from './services';

export interface Asked<K extends ServiceName> {
  /** The last answer that came, also while another one is awaited or after an error. */
  value: Answer<K> | undefined;
  /** What `value` is the answer to. */
  of: Args<K> | undefined;
  /** Why the newest question has no answer. */
  error: unknown;
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
    private show: (asked: (before: Asked<K>) => Asked<K>) => void,
  ) {}

  ask(args: Args<K> | undefined): void {
    if (sameEntries(this.newest, args)) return;
    this.newest = args;
    this.waiting = args !== undefined;
    if (!this.busy) void this.next();
  }

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
        if (!this.gone) this.show(() => ({ value, of, error: undefined }));
      } catch (error) {
        if (!this.gone && !this.waiting) this.show((before) => ({ ...before, error }));
      }
    }
    this.busy = false;
  }
}

/** Arguments are compared entry by entry, by identity; with `undefined` nothing is asked. */
export function useAnswer<K extends ServiceName>(engine: Engine, service: K, args: Args<K> | undefined): Asked<K> {
  const [asked, show] = useState<Asked<K>>({ value: undefined, of: undefined, error: undefined });
  const asker = useRef<Asker<K>>();
  useLayoutEffect(() => { // at once: other effects wait for the next frame
    asker.current = new Asker(engine, service, show);
    return () => asker.current?.leave();
  }, [engine, service]);
  useLayoutEffect(() => asker.current!.ask(args));
  return asked;
}
