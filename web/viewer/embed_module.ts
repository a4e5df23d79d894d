// Puts the WebAssembly module and the page's script into the page, packed as text: pages from disk may not fetch.
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import type { Plugin } from 'vite';

/** xz, with the settings that pack this code best: a quarter less than gzip makes of it. */
function packedByXz(file: string): string {
  const settings = ['--format=xz', '--check=crc32', '--lzma2=preset=9e,lc=4,lp=0,pb=0', '--stdout', file];
  return execFileSync('xz', settings, { maxBuffer: 1 << 28 }).toString('base64');
}

/** As <script type="text/plain" id="dymsum-wasm">, xz in base64, behind everything that is needed to paint. */
export function embedModule(file: string, simd: boolean): Plugin {
  return {
    name: 'embed-module',
    /** The package's own addresses of the module would be taken for assets, and put into the page once more. */
    transform(code, id) {
      if (!id.endsWith('/package/live.js')) return undefined;
      return { code: code.replaceAll(/new URL\('[^']*\.wasm', import\.meta\.url\)/g, 'undefined'), map: null };
    },
    transformIndexHtml() {
      if (!existsSync(file)) throw new Error(`${file} is not there: ./run web builds it.`);
      return [{ tag: 'script', attrs: { type: 'text/plain', id: 'dymsum-wasm', 'data-simd': String(simd) }, children: packedByXz(file), injectTo: 'body' }];
    },
  };
}

/** Whose work is in the page, and under which licences, as a comment behind all that is shown. */
export function tellNotices(file: string): Plugin {
  return {
    name: 'tell-notices',
    transformIndexHtml: (page) => page.replace('</html>', () => `<!--\n${readFileSync(file, 'utf8')}-->\n</html>`),
  };
}

/** Unpacks the page's script and runs it; where the browser cannot, the page says so. Older ones read this too: no new syntax. */
const kStart = `
(function () {
  var packed = document.getElementById('dymsum-script').textContent;
  if (typeof DecompressionStream === 'undefined' || typeof WebAssembly === 'undefined') {
    document.getElementById('app').textContent = 'This browser is too old for the viewer: it needs one of 2023 or later.';
    return;
  }
  var bytes = Uint8Array.from(atob(packed), function (c) { return c.charCodeAt(0); });
  new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).text().then(function (code) {
    var script = document.createElement('script');
    script.textContent = code;
    document.head.append(script);
  });
})();
`;

/**
 * Packs the page's script, and runs it where the body begins, before the module's megabytes are read: scripts of type module
 * wait for them.
 */
export function packScript(): Plugin {
  return {
    name: 'pack-script',
    enforce: 'post',
    generateBundle(_, bundle) {
      const page = bundle['index.html'];
      if (page?.type !== 'asset') throw new Error('There is no page to put the script into.');
      const [whole, script] = /<script type="module"[^>]*>([^]*?)<\/script>/.exec(String(page.source)) ?? [];
      if (!whole || script === undefined) throw new Error('The page has no script in it.');
      const packed = gzipSync(`(async()=>{${script}})()`, { level: 9 }).toString('base64');
      const early = `<div id="app"></div><script type="text/plain" id="dymsum-script">${packed}</script><script>${kStart.trim()}</script>`;
      page.source = String(page.source).replace(whole, '').replace('<div id="app"></div>', () => early);
    },
  };
}
