// The command line, with files in memory. Its module is loaded when it is first called. Every call has an instance to
// itself: nothing is left of the one before, and what it held is given back.
import { checkOptions } from './arguments.js';
import { refusal } from './errors.js';
import { at, startWith } from './module.js';

const folder = '/files';

function bytesOf(content) {
  if (typeof content === 'string') return new TextEncoder().encode(content);
  return ArrayBuffer.isView(content) ? content : new Uint8Array(content); // a buffer, of this realm or another one
}

/** Bytes that come one by one. */
class Collected {
  bytes = new Uint8Array(1 << 12);
  length = 0;

  add(byte) {
    if (this.length === this.bytes.length) {
      const longer = new Uint8Array(2 * this.length);
      longer.set(this.bytes);
      this.bytes = longer;
    }
    this.bytes[this.length++] = byte;
  }

  all() {
    return this.bytes.slice(0, this.length);
  }
}

/** As the file system names it: without "." and "..", below the folder that commands run in where it is relative. */
function absolute(path) {
  const parts = [];
  for (const part of `${path.startsWith('/') ? '' : folder}/${path}`.split('/')) {
    if (part === '..') parts.pop();
    else if (part !== '' && part !== '.') parts.push(part);
  }
  return `/${parts.join('/')}`;
}

function writeFiles(FS, files) {
  FS.mkdirTree(folder);
  FS.chdir(folder);
  for (const [path, content] of Object.entries(files)) {
    const at = absolute(path);
    try {
      FS.mkdirTree(at.slice(0, at.lastIndexOf('/')) || '/');
      FS.writeFile(at, bytesOf(content));
    } catch {
      throw refusal(`no file can have the name "${path}"`);
    }
  }
}

const systems = new Set(['/dev', '/proc']);

/** Paths of all files below a folder, by what their caller calls them. */
function* filesBelow(FS, at) {
  for (const name of FS.readdir(at)) {
    if (name === '.' || name === '..') continue;
    const path = at === '/' ? `/${name}` : `${at}/${name}`;
    if (systems.has(path)) continue;
    if (FS.isDir(FS.lstat(path).mode)) yield* filesBelow(FS, path);
    else if (FS.isFile(FS.lstat(path).mode)) yield path;
  }
}

const same = (a, b) => a.length === b.length && a.every((byte, k) => byte === b[k]);

function changedFiles(FS, files) {
  const before = new Map(Object.entries(files).map(([path, content]) => [absolute(path), bytesOf(content)]));
  const changed = {};
  for (const path of filesBelow(FS, '/')) {
    const bytes = FS.readFile(path);
    const old = before.get(path);
    if (old && same(old, bytes)) continue;
    changed[path.startsWith(`${folder}/`) ? path.slice(folder.length + 1) : path] = bytes;
  }
  return changed;
}

/** Standard error as text, which its reader gets line by line or at a carriage return. */
function lineTeller(tell) {
  let line = [];
  return (byte) => {
    line.push(byte);
    if (byte !== 10 && byte !== 13) return;
    tell(new TextDecoder().decode(new Uint8Array(line)));
    line = [];
  };
}

const isContent = (content) => typeof content === 'string' || ArrayBuffer.isView(content) || content?.byteLength !== undefined;

function check(args, how) {
  if (!Array.isArray(args) || args.some((arg) => typeof arg !== 'string')) throw refusal('run takes the words of a command as a list of texts');
  if (args.some((arg) => arg.includes('\0'))) throw refusal('an argument of a command has no character of code 0');
  checkOptions('run', how, ['files', 'stdin', 'onStderr']);
  const { files = {}, stdin = '' } = how;
  if (typeof files !== 'object' || files === null) throw refusal('run: files is an object of contents by path');
  for (const [path, content] of [...Object.entries(files), ['standard input', stdin]])
    if (!isContent(content)) throw refusal(`run: ${path} is neither a text nor bytes`);
}

async function run(start, args, { files = {}, stdin = '', onStderr }) {
  const input = bytesOf(stdin);
  const stdout = new Collected();
  const stderr = new Collected();
  const tell = onStderr ? lineTeller(onStderr) : () => {};
  let read = 0;
  const instance = await start({
    thisProgram: 'dymsum',
    stdin: () => (read < input.length ? input[read++] : null),
    stdout: (byte) => stdout.add(byte & 255),
    stderr: (byte) => {
      stderr.add(byte & 255);
      tell(byte & 255);
    },
  });
  writeFiles(instance.FS, files);
  const exit = instance.callMain([...args]);
  const stdoutBytes = stdout.all();
  const text = (bytes) => new TextDecoder().decode(bytes);
  return { exit, stdout: text(stdoutBytes), stderr: text(stderr.all()), stdoutBytes, files: changedFiles(instance.FS, files) };
}

/** Loads the module and its JavaScript, once; after a failure the next call tries again. */
function loader(options) {
  let loaded;
  const load = async () => {
    const { default: create } = await import('./dist/dymsum-command.js');
    const urls = {
      plain: at(options, 'dymsum-command.wasm', new URL('./dist/dymsum-command.wasm', import.meta.url)),
      simd: at(options, 'dymsum-command-simd.wasm', new URL('./dist/dymsum-command-simd.wasm', import.meta.url)),
    };
    return (await startWith(create, { urls, given: options.commandBinary, simd: options.simd })).start;
  };
  return () => {
    loaded ??= load().catch((error) => {
      loaded = undefined;
      throw error;
    });
    return loaded;
  };
}

export function commandLine(options) {
  const start = loader(options);
  return async (args, how) => {
    check(args, how ?? {});
    return run(await start(), args, how ?? {});
  };
}
