// The page's end of the worker. One request is computed at a time; `cancel` ends the worker and starts another.
import type { ErrorData, Reply, Request, Start } from './protocol';
import type { Answer, Args, ServiceName } from './services';
import { shapesIn } from './shape';

/** What the engine, or the shell on its behalf, says went wrong. */
export class EngineError extends Error {
  readonly code;
  readonly reason;
  readonly evidence;
  constructor(data: ErrorData) {
    super(data.message);
    this.code = data.code;
    this.reason = data.reason;
    this.evidence = data.evidence;
  }
}

export interface EngineStatus {
  state: 'starting' | 'idle' | 'busy' | 'broken';
  /** when the oldest open request was asked, of performance.now() */
  since: number;
  stage: string;
  fraction: number | undefined;
  version: string;
  simd: boolean;
}

interface Open {
  request: Request;
  resolve: (value: never) => void;
  reject: (error: EngineError) => void;
  since: number;
}

const kCancelled: ErrorData = { code: 'cancelled', reason: 'Cancelled.', message: 'Cancelled.', evidence: {} };

export class Engine {
  private worker: Worker | undefined;
  /** the worker has been given its module */
  private given: Promise<void> = Promise.resolve();
  private open = new Map<number, Open>();
  private lastId = 0;
  private listeners = new Set<() => void>();
  private now: EngineStatus = { state: 'starting', since: 0, stage: '', fraction: undefined, version: '', simd: false };

  /** `makeWorker` and `module` are asked for whenever a worker starts. */
  constructor(
    private makeWorker: () => Worker,
    private module: () => Promise<Start>,
  ) {}

  /** Starts the worker; the first request does, too. */
  start(): void {
    if (this.worker) return;
    const worker = this.makeWorker();
    this.worker = worker;
    worker.onmessage = (event: MessageEvent<Reply>) => this.take(event.data);
    worker.onerror = (event) => this.take({ kind: 'broken', code: 'defect', message: event.message || 'its worker could not start' });
    this.given = this.module().then((module) => worker.postMessage(module));
  }

  get status(): EngineStatus {
    return this.now;
  }
  subscribe(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  /** Rejects with an EngineError: the library's error, or `cancelled`. */
  ask<K extends ServiceName>(service: K, args: Args<K>): Promise<Answer<K>> {
    this.start();
    const request: Request = { id: ++this.lastId, service, args };
    return new Promise<Answer<K>>((resolve, reject) => {
      this.open.set(request.id, { request, resolve, reject, since: performance.now() });
      this.send(request);
      this.update({});
    });
  }

  /**
   * Ends the request that is computed, and those about the same shapes, which would begin the same work again. Others are asked
   * of the next worker: nobody would ask them again.
   */
  cancel(): void {
    this.worker?.terminate();
    this.worker = undefined;
    const oldest = this.open.values().next().value, shapes = [...shapesIn(oldest?.request.args)];
    const ended = [...this.open.values()].filter(({ request }) => {
      const about = shapesIn(request.args);
      return request === oldest?.request || (shapes.length > 0 && shapes.every((shape) => about.has(shape)));
    });
    for (const { request } of ended) this.open.delete(request.id);
    this.update({ state: 'starting', stage: '', fraction: undefined });
    this.start();
    for (const { request } of this.open.values()) this.send(request);
    for (const { reject } of ended) reject(new EngineError(kCancelled));
  }

  private send(request: Request): void {
    const worker = this.worker!;
    void this.given.then(() => worker.postMessage(request));
  }

  private take(reply: Reply): void {
    if (reply.kind === 'ready') return this.update({ state: 'idle', version: reply.version, simd: reply.simd });
    if (reply.kind === 'broken') {
      this.rejectAll({ code: reply.code, reason: reply.message, message: `The engine stopped: ${reply.message}`, evidence: {} });
      return this.update({ state: 'broken', stage: reply.message });
    }
    if (reply.kind === 'progress') return this.update({ stage: reply.stage, fraction: reply.fraction });
    const request = this.open.get(reply.id);
    this.open.delete(reply.id);
    this.update({ stage: '', fraction: undefined });
    if (reply.kind === 'answer') request?.resolve(reply.value as never);
    else request?.reject(new EngineError(reply.error));
  }

  private rejectAll(data: ErrorData): void {
    const open = [...this.open.values()];
    this.open.clear();
    for (const request of open) request.reject(new EngineError(data));
  }

  private update(change: Partial<EngineStatus>): void {
    const state = change.state ?? this.now.state;
    const first = this.open.values().next().value;
    const settled = state === 'idle' || state === 'busy' ? (first ? 'busy' : 'idle') : state;
    this.now = { ...this.now, ...change, state: settled, since: first?.since ?? 0 };
    for (const listener of this.listeners) listener();
  }
}
