// The programs of the guide and of the README run, and print what stands below them.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const guide = ['../../../docs/guide/web.md', '../README.md'].map((page) => readFileSync(new URL(page, import.meta.url), 'utf8')).join('\n');
const cwd = fileURLToPath(new URL('..', import.meta.url));

for (const [, program, , output] of guide.matchAll(/```js\n([^]*?)```\n(\n```text\n([^]*?)```)?/g)) {
  test(program.split('\n')[3], () => {
    const { status, stdout, stderr } = spawnSync(process.execPath, ['--input-type=module', '-e', program], { cwd, encoding: 'utf8' });
    assert.equal(status, 0, stderr);
    if (output !== undefined) assert.equal(stdout, output);
  });
}
