// The package without the command line: what pages load that only compute, as "dymsum/live". live.d.ts tells what it has.
import createDymsum from './dist/dymsum.js';
import { checkOptions } from './arguments.js';
import { DymsumError, Failure } from './errors.js';
import { at, hasSimd, startWith } from './module.js';
import { objectsOf } from './objects.js';

export { DymsumError, hasSimd };
export const NONE = 0xffffffff;

export async function load(options = {}) {
  checkOptions('load', options, ['wasmBinary', 'commandBinary', 'simd', 'locateFile']);
  // Bundlers look for these words.
  const urls = {
    plain: at(options, 'dymsum.wasm', new URL('./dist/dymsum.wasm', import.meta.url)),
    simd: at(options, 'dymsum-simd.wasm', new URL('./dist/dymsum-simd.wasm', import.meta.url)),
  };
  const { simd, start } = await startWith(createDymsum, { urls, given: options.wasmBinary, simd: options.simd });
  return { simd, ...objectsOf(await start({ Failure })) };
}
