// Puts the WebAssembly module into the page as text: pages from disk may not fetch.
import { existsSync, readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import type { Plugin } from 'vite';

/** As <script type="text/plain" id="dymsum-wasm">, gzip in base64, behind everything that is needed to paint. */
export function embedModule(file: string, simd: boolean): Plugin {
  return {
    name: 'embed-module',
    /** The package's own addresses of the module would be taken for assets, and put into the page once more. */
    transform(code, id) {
      if (!id.endsWith('/package/module.js')) return undefined;
      return { code: code.replaceAll(/new URL\('[^']*\.wasm', import\.meta\.url\)/g, 'undefined'), map: null };
    },
    transformIndexHtml() {
      if (!existsSync(file)) throw new Error(`${file} is not there: ./run web builds it.`);
      const children = gzipSync(readFileSync(file), { level: 9 }).toString('base64');
      return [{ tag: 'script', attrs: { type: 'text/plain', id: 'dymsum-wasm', 'data-simd': String(simd) }, children, injectTo: 'body' }];
    },
  };
}
