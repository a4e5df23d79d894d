// The package's entry: finds and starts the WebAssembly module, and puts its two layers into one object. index.d.ts tells
// what each part does.
import { DymsumError, Failure } from './errors.js';
import { live } from './live.js';
import { hasSimd, startWith } from './module.js';
import { run } from './run.js';

export { DymsumError, hasSimd };
export const NONE = 0xffffffff;

export async function load(options = {}) {
  const { simd, start } = await startWith(options);
  const instance = await start({ Failure });
  return { simd, run: (args, how) => run(start, args, how), ...live(instance) };
}
