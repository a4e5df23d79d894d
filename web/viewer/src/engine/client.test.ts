import { describe, expect, it } from 'vitest';
import { Engine, EngineError } from './client';
import type { Reply, Request, Start } from './protocol';

/** A worker that answers when it is told to. */
class Slow {
  onmessage: ((event: { data: Reply }) => void) | null = null;
  onerror = null;
  asked: Request[] = [];
  ended = false;
  postMessage(message: Request | Start): void {
    if ('id' in message) this.asked.push(message);
  }
  terminate(): void {
    this.ended = true;
  }
  answer(id: number, value: unknown): void {
    this.onmessage?.({ data: { kind: 'answer', id, value } });
  }
}

const shape = (name: string) => ({ name, text: '' });
const later = (): Promise<void> => new Promise((done) => setTimeout(done));

function engine(): { engine: Engine; workers: Slow[] } {
  const workers: Slow[] = [];
  const made = new Engine(() => {
    workers.push(new Slow());
    return workers.at(-1) as unknown as Worker;
  }, () => Promise.resolve({ wasm: '', simd: true }));
  return { engine: made, workers };
}

/** Any service will do. */
const ask = (of: Engine, args: object): Promise<unknown> => of.ask('sumFrame', args as never);
const ending = (promise: Promise<unknown>): Promise<unknown> => promise.then((value) => value, (error: unknown) => (error instanceof EngineError ? error.code : error));

describe('cancelling', () => {
  it('ends what is computed and what is about the same shapes, and asks the rest again', async () => {
    const { engine: it, workers } = engine(), p = shape('p'), q = shape('q'), r = shape('r');
    const long = ending(ask(it, { p, q })), same = ending(ask(it, { args: { p, q }, z: 1 })), other = ending(ask(it, { p, q: r })), one = ending(ask(it, { shape: p }));
    await later();
    expect(workers[0]!.asked.length).toBe(4);
    it.cancel();
    expect(await Promise.all([long, same])).toEqual(['cancelled', 'cancelled']);
    await later();
    expect(workers[0]!.ended).toBe(true);
    expect(workers[1]!.asked.map(({ id }) => id)).toEqual([3, 4]);
    workers[1]!.answer(3, 'third');
    workers[1]!.answer(4, 'fourth');
    expect(await Promise.all([other, one])).toEqual(['third', 'fourth']);
  });
  it('of nothing leaves an engine that answers', async () => {
    const { engine: it, workers } = engine();
    it.start();
    it.cancel();
    const asked = ask(it, {});
    await later();
    workers[1]!.answer(1, 7);
    expect(await asked).toBe(7);
  });
});
