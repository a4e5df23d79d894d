// The WebAssembly module as it stands in the page (see embed_module.ts), behind everything that is needed to paint.
import type { Start } from './protocol';

async function parsed(): Promise<void> {
  if (document.readyState !== 'loading') return;
  await new Promise((done) => addEventListener('DOMContentLoaded', done, { once: true }));
}

export async function embeddedModule(): Promise<Start> {
  await parsed();
  const element = document.getElementById('dymsum-wasm');
  return { wasm: element?.textContent ?? '', simd: element?.dataset.simd === 'true' };
}
