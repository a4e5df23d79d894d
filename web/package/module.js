// Where the bytes of the two modules come from, and instances of them.

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
    const files = 'node:fs/promises'; // bundlers for browsers, which have no such module, look for literals
    const { readFile } = await import(/* @vite-ignore */ files);
    return readFile(url);
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  const bytes = await response.arrayBuffer();
  if (new Uint8Array(bytes)[0] !== 0)
    throw new Error(`${url} holds no WebAssembly. Vite's development server needs optimizeDeps: { exclude: ['dymsum'] } to find it.`);
  return bytes;
}

/** The address of a file of the package. */
export const at = ({ locateFile }, file, inPackage) => (locateFile ? new URL(locateFile(file), import.meta.url) : inPackage);

/** The bytes of a build, and which it is: without a wish the one for this engine, or the plain one in a package that has no other. */
async function buildAt(urls, wish) {
  const simd = wish ?? hasSimd();
  try {
    return { bytes: await bytesAt(simd ? urls.simd : urls.plain), simd };
  } catch (error) {
    if (wish !== undefined || !simd) throw error;
    return { bytes: await bytesAt(urls.plain), simd: false };
  }
}

/**
 * Which build of a module was taken, and what starts instances of it, each with a memory of its own. `create` is the module's
 * JavaScript; `given` its bytes, for a caller that has them, else they are at `urls`.
 */
export async function startWith(create, { urls, given, simd }) {
  const build = given ? { bytes: given, simd: simd ?? false } : await buildAt(urls, simd);
  const module = await WebAssembly.compile(build.bytes);
  const start = (settings) =>
    new Promise((done, failed) => {
      const instantiateWasm = (imports, receive) => {
        WebAssembly.instantiate(module, imports).then((instance) => receive(instance, module)).catch(failed);
        return {};
      };
      create({ ...settings, instantiateWasm }).then(done, failed);
    });
  return { simd: Boolean(build.simd), start };
}
