// The worker: one module, one request at a time.
import { DymsumError, hasSimd, load } from 'dymsum';
import { XzReadableStream } from 'xz-decompress';
import { Host } from './host';
import { Limit } from './limit';
import type { ErrorData, Reply, Request, Start } from './protocol';
import { services, type Service } from './services';

const kProgressEveryMs = 100;

let host: Host | undefined;
let current = 0;
let lastProgress = 0;

function reply(message: Reply, move: Transferable[] = []): void {
  postMessage(message, { transfer: move });
}

function progress(stage: string, fraction: number): void {
  const now = performance.now();
  if (now - lastProgress < kProgressEveryMs) return;
  lastProgress = now;
  reply({ kind: 'progress', id: current, stage, fraction });
}

/** The buffers of all typed arrays in a value of plain data. */
function buffersIn(value: unknown, found = new Set<ArrayBuffer>()): Set<ArrayBuffer> {
  if (ArrayBuffer.isView(value)) found.add(value.buffer as ArrayBuffer);
  else if (Array.isArray(value) && typeof value[0] !== 'object') return found;
  else if (typeof value === 'object' && value !== null) for (const part of Object.values(value)) buffersIn(part, found);
  return found;
}

function errorData(error: unknown): ErrorData {
  if (error instanceof DymsumError) return error.toData();
  const message = error instanceof Error ? error.message : String(error);
  return { code: error instanceof Limit ? 'limit' : 'defect', reason: message, message, evidence: {} };
}

async function unpacked(xzInBase64: string): Promise<ArrayBuffer> {
  const text = atob(xzInBase64), packed = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) packed[k] = text.charCodeAt(k); // megabytes: no call for each
  return await new Response(new XzReadableStream(new Blob([packed]).stream())).arrayBuffer();
}

async function start({ wasm, simd }: Start): Promise<void> {
  try {
    if (simd && !hasSimd()) throw new Limit('this browser has no vector instructions of WebAssembly, as all have since 2023.');
    const dymsum = await load({ wasmBinary: await unpacked(wasm), simd });
    host = new Host(dymsum, progress);
    reply({ kind: 'ready', version: dymsum.version, simd: dymsum.simd });
  } catch (error) {
    const { code, message } = errorData(error);
    reply({ kind: 'broken', code, message });
  }
}

function serve({ id, service, args }: Request): void {
  current = id;
  lastProgress = performance.now();
  try {
    if (!host) throw new Error('The engine has not started.');
    const run = (services as Record<string, Service>)[service]!;
    const value = run(host, args as never);
    reply({ kind: 'answer', id, value }, [...buffersIn(value)]);
  } catch (error) {
    reply({ kind: 'error', id, error: errorData(error) });
  } finally {
    host?.requestDone();
  }
}

let started: Promise<void> = Promise.resolve();

onmessage = (event: MessageEvent<Start | Request>): void => {
  const message = event.data;
  if ('wasm' in message) started = start(message);
  else if (host) serve(message);
  else void started.then(() => serve(message));
};
