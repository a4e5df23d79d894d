// Which commands are run: those of the corpus that need no shell, the help of every verb, and commands.txt.
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

export function allCommands(verbs) {
  const helps = verbs.map((verb) => ({ name: `dymsum ${verb} --help`, args: [verb, '--help'], files: {} }));
  return [...listedCommands(), ...helps, ...corpusCommands()];
}
