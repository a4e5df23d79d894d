// The package's entry: its two layers in one object. index.d.ts tells what each part does.
import { load as loadLive } from './live.js';
import { commandLine } from './run.js';

export { DymsumError, hasSimd, NONE } from './live.js';

export async function load(options = {}) {
  const live = await loadLive(options);
  return { ...live, run: commandLine({ ...options, simd: live.simd }) };
}
