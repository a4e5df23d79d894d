import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';
import { viteSingleFile } from 'vite-plugin-singlefile';
import { embedModule, packScript, tellNotices } from './embed_module';
import { threeParts } from './three_parts';

const inPackage = (file: string): string => fileURLToPath(new URL(`../package/${file}`, import.meta.url));
const inModule = (file: string): string => fileURLToPath(new URL(`module/${file}`, import.meta.url));
const embedded = embedModule(inModule('dymsum-page-simd.wasm'), true);

// One HTML file that works from disk: scripts, styles, the worker and the module are in it, and nothing is fetched.
export default defineConfig({
  base: './',
  // The package, on the module that has what pages call.
  resolve: { alias: { dymsum: inPackage('live.js'), './dist/dymsum.js': inModule('dymsum-page-simd.js') } },
  plugins: [threeParts(), embedded, viteSingleFile({ removeViteModuleLoader: true }), packScript(), tellNotices(inPackage('NOTICES'))],
  worker: { format: 'iife', plugins: () => [embedded] },
  build: { target: 'es2022', chunkSizeWarningLimit: 4096, reportCompressedSize: false },
  test: { include: ['src/**/*.test.ts'] },
});
