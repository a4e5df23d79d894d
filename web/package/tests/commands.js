// Which commands are run: those of the corpus that need no shell, nor SQLite, which WebAssembly has not; the help of every
// verb, and commands.txt.
import { readdirSync, readFileSync } from 'node:fs';

const corpus = new URL('../../../tests/corpus/commands/', import.meta.url);
const list = new URL('./commands.txt', import.meta.url);

/** The arguments of a command line without shell operators, or null. */
export function argumentsOf(line) {
  const [program, ...words] = (line.match(/"[^"]*"|'[^']*'|[^\s"']+/g) ?? []).map((word) => word.replace(/^["']|["']$/g, ''));
  const quoted = /[^\s"']["']|["'][^\s"']/.test(line);
  return program === 'dymsum' && !/[|;&<>$`*\\]/.test(line) && !quoted ? words : null;
}

/** `file NAME` to `end`; each other line to `other`. */
function read(text, files, other) {
  const lines = text.split('\n');
  for (let k = 0; k < lines.length; ++k) {
    if (!lines[k].startsWith('file ')) {
      if (lines[k] !== '' && !lines[k].startsWith('#')) other(lines[k]);
      continue;
    }
    const end = lines.indexOf('end', k);
    files[lines[k].slice(5).trim()] = lines.slice(k + 1, end).map((line) => `${line}\n`).join('');
    k = end;
  }
}

function corpusCommands() {
  const commands = [];
  for (const name of readdirSync(corpus).sort()) {
    if (name.startsWith('geopackage_')) continue;
    const files = {};
    const runs = [];
    read(readFileSync(new URL(name, corpus), 'utf8'), files, (line) => line.startsWith('run ') && runs.push(line.slice(4)));
    const args = runs.length === 1 ? argumentsOf(runs[0]) : null;
    if (args) commands.push({ name: `${name.replace('.txt', '')}: ${runs[0]}`, args, files });
  }
  return commands;
}

function listedCommands() {
  const files = {};
  const commands = [];
  read(readFileSync(list, 'utf8'), files, (line) => commands.push({ name: line, args: argumentsOf(line), files }));
  return commands;
}

/** Doubles of all sizes: random bits, powers of two and of ten, and neighbours of both. */
function doubles() {
  const view = new DataView(new ArrayBuffer(8));
  const ofBits = (bits) => (view.setBigUint64(0, BigInt.asUintN(64, bits)), view.getFloat64(0));
  const bitsOf = (value) => (view.setFloat64(0, value), view.getBigUint64(0));
  const numbers = [];
  let random = 88172645463325252n;
  for (let k = 0; k < 4000; ++k) {
    for (const shift of [13n, -7n, 17n]) random = BigInt.asUintN(64, random ^ (shift > 0n ? random << shift : random >> -shift));
    numbers.push(ofBits(random), Number(BigInt.asIntN(64, random)) / 2 ** (k % 70));
  }
  for (let k = -1074; k < 1024; k += 3) numbers.push(2 ** k, ofBits(bitsOf(2 ** k) - 1n));
  for (let k = -307; k < 308; ++k) numbers.push(Number(`1e${k}`), ofBits(bitsOf(Number(`1e${k}`)) + 1n), Number(`123456789e${k - 8}`));
  return numbers.filter(Number.isFinite);
}

/** Numbers as text, read and written. */
function numberCommand() {
  const points = doubles().map((value) => `(${value} ${-value})`);
  return { name: 'dymsum convert numbers.wkt numbers.poly', args: ['convert', 'numbers.wkt', 'numbers.poly'], files: { 'numbers.wkt': `MULTIPOINT (${points.join(', ')})\n` } };
}

export function allCommands(verbs) {
  const helps = verbs.map((verb) => ({ name: `dymsum ${verb} --help`, args: [verb, '--help'], files: {} }));
  return [...listedCommands(), numberCommand(), ...helps, ...corpusCommands()];
}
