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

/** Runs the page's script where the body begins, before the module's megabytes are read: scripts of type module wait for them. */
export function runEarly(): Plugin {
  return {
    name: 'run-early',
    enforce: 'post',
    generateBundle(_, bundle) {
      const page = bundle['index.html'];
      if (page?.type !== 'asset') throw new Error('There is no page to put the script into.');
      const [whole, script] = /<script type="module"[^>]*>([^]*?)<\/script>/.exec(String(page.source)) ?? [];
      if (!whole || script === undefined) throw new Error('The page has no script in it.');
      const early = `<div id="app"></div><script>(async()=>{${script}})()</script>`;
      page.source = String(page.source).replace(whole, '').replace('<div id="app"></div>', () => early);
    },
  };
}
