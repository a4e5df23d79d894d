import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';

const installed = (name: string): [string, string] => [name, fileURLToPath(new URL(`node_modules/${name}`, import.meta.url))];

// Drives dist/index.html, which has to be built. One browser at a time: frames are timed.
export default defineConfig({
  root: fileURLToPath(new URL('..', import.meta.url)),
  resolve: { alias: Object.fromEntries(['vitest', 'playwright-core', 'pixelmatch', 'pngjs'].map(installed)) },
  cacheDir: fileURLToPath(new URL('node_modules/.vite', import.meta.url)),
  test: { include: ['tests/viewer/**/*.test.ts'], fileParallelism: false, testTimeout: 120_000, hookTimeout: 60_000, reporters: ['verbose'], expect: { poll: { timeout: 20_000 } } },
});
