// The module's command line and the native program give the same text, exit code and files, byte by byte, but for how long
// things took (lines of progress, which come after two seconds, numbers in front of "ms" or "s", values of keys that end in "ms") and how much memory (of keys that end in
// "bytes": pointers have half the size). DYMSUM_NATIVE names the program.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, relative } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { load } from '../index.js';
import { allCommands } from './commands.js';

const native = process.env.DYMSUM_NATIVE ?? fileURLToPath(new URL('../../../build/release/dymsum', import.meta.url));

function filesBelow(folder) {
  return readdirSync(folder).flatMap((name) => {
    const path = join(folder, name);
    return statSync(path).isDirectory() ? filesBelow(path) : [path];
  });
}

function runNative(args, files) {
  const folder = mkdtempSync(join(tmpdir(), 'dymsum-'));
  try {
    for (const [path, text] of Object.entries(files)) {
      mkdirSync(dirname(join(folder, path)), { recursive: true });
      writeFileSync(join(folder, path), text);
    }
    const { status, stdout, stderr } = spawnSync(native, args, { cwd: folder, input: '', maxBuffer: 1 << 28, env: { ...process.env, DYMSUM_VIEWER: '' } });
    const written = {};
    for (const path of filesBelow(folder)) {
      const name = relative(folder, path);
      const bytes = readFileSync(path);
      if (!(name in files && bytes.toString('latin1') === Buffer.from(files[name]).toString('latin1'))) written[name] = bytes;
    }
    return { exit: status, stdout, stderr, files: written };
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** Without times and sizes of memory, in text and in JSON. */
function masked(bytes) {
  return Buffer.from(bytes)
    .toString('latin1')
    .replace(/("(?:[a-z_]*ms|time_ms)": )(-?[0-9.e+-]+|\{(?:[^{}]|\{[^}]*\})*\}|\[[^\]]*\])/g, '$1T')
    .replace(/("[a-z_]*bytes": )[0-9]+/g, '$1N')
    .replace(/dymsum: at work for [^\n]*\n/g, '')
    .replace(/[0-9.e+-]+ (ms|s|us)\b/g, 'T $1');
}

function verbsOf(help) {
  const lines = help.split('\n');
  const from = lines.indexOf('Subcommands:');
  return lines.slice(from + 1, lines.indexOf('', from)).map((line) => line.trim().split(' ')[0]);
}

const hasSimdBuild = existsSync(new URL('../dist/dymsum-simd.wasm', import.meta.url));
if (!hasSimdBuild) test('simd: all commands', { skip: 'dist/dymsum-simd.wasm is not built' }, () => {});

for (const simd of hasSimdBuild ? [false, true] : [false]) {
  const dymsum = await load({ simd });
  const commands = allCommands(verbsOf((await dymsum.run(['--help'])).stdout));
  assert.ok(commands.length >= 200, `${commands.length} commands`);
  for (const { name, args, files } of commands) {
    test(`${simd ? 'simd' : 'plain'}: ${name}`, async () => {
      const expected = runNative(args, files);
      const got = await dymsum.run(args, { files });
      assert.equal(got.exit, expected.exit);
      assert.equal(masked(got.stderr), masked(expected.stderr));
      assert.equal(masked(got.stdoutBytes), masked(expected.stdout));
      assert.deepEqual(Object.keys(got.files).sort(), Object.keys(expected.files).sort());
      for (const [path, bytes] of Object.entries(expected.files)) assert.equal(masked(got.files[path]), masked(bytes), path);
    });
  }
}
