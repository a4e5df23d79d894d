// Where the module's bytes come from, and instances of it.
import createDymsum from './dist/dymsum.js';

// (module (func (result v128) i32.const 0 i8x16.splat i8x16.popcnt))
const simdProbe = [
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
];

export function hasSimd() {
  return WebAssembly.validate(new Uint8Array(simdProbe));
}

const inNode = typeof process === 'object' && Boolean(process.versions?.node) && process.type !== 'renderer';

async function bytesAt(url) {
  if (inNode && url.protocol === 'file:') {
    const { readFile } = await import(/* @vite-ignore */ 'node:fs/promises');
    return readFile(url);
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  return response.arrayBuffer();
}

function urlOf(simd, locateFile) {
  if (locateFile) return new URL(locateFile(simd ? 'dymsum-simd.wasm' : 'dymsum.wasm'), import.meta.url);
  // Bundlers look for these words.
  return simd ? new URL('./dist/dymsum-simd.wasm', import.meta.url) : new URL('./dist/dymsum.wasm', import.meta.url);
}

/** The bytes of a build, and which it is: without a wish the one for this engine, or the plain one in a package that has no other. */
async function buildFor({ wasmBinary, simd = hasSimd(), locateFile }, wished) {
  if (wasmBinary) return { bytes: wasmBinary, simd };
  try {
    return { bytes: await bytesAt(urlOf(simd, locateFile)), simd };
  } catch (error) {
    if (wished || !simd) throw error;
    return { bytes: await bytesAt(urlOf(false, locateFile)), simd: false };
  }
}

/** Which build was taken, and what starts instances of it, each with a memory of its own. */
export async function startWith(options) {
  const { bytes, simd } = await buildFor(options, options.simd !== undefined);
  const module = await WebAssembly.compile(bytes);
  const start = (settings) =>
    new Promise((done, failed) => {
      const instantiateWasm = (imports, receive) => {
        WebAssembly.instantiate(module, imports).then((instance) => receive(instance, module), failed);
        return {};
      };
      createDymsum({ ...settings, instantiateWasm }).then(done, failed);
    });
  return { simd, start };
}
