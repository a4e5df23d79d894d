// The WebAssembly module as it stands in the page (see vite.config.ts).
import type { Start } from './protocol';

export function embeddedModule(): Start {
  const element = document.getElementById('dymsum-wasm');
  return { wasm: element?.textContent ?? '', simd: element?.dataset.simd === 'true' };
}
