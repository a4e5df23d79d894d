// Large files that are none of their kind, told by their first bytes: nothing is made of them.
import type { InputFile } from '../shell/page';

const kLarge = 1 << 20; // what is smaller the library looks into, and says more
const kLookedAt = 4096;
const kQuoted = 24;
const kText = /\.(poly|wkt|geojson|svg|json|dxf|off|obj)$/i;

/** What files of a kind begin with, blanks left out: as the library's readers take it. Others may begin with anything. */
const kBegins: readonly (readonly [kind: RegExp, begins: RegExp, text: string])[] = [
  [/\.wkt$/i, /^(MULTI)?(POINT|LINESTRING|POLYGON)|^GEOMETRYCOLLECTION/i, 'the name of a geometry such as POLYGON'],
  [/\.(geo)?json$/i, /^[[{]/, '"{" or "["'],
  [/\.svg$/i, /^</, '"<"'],
  [/\.poly$/i, /^[#\d]/, 'a number or a comment'],
  [/\.off$/i, /^(#|\d|[A-Z\d]{0,5}OFF)/i, '"OFF"'],
];

/** Why a large file cannot be of the kind that its name says; nothing where it may be. */
export function contentError({ name, bytes }: InputFile): string | undefined {
  if (bytes.length < kLarge) return undefined;
  const first = bytes.subarray(0, kLookedAt), begins = (word: string): boolean => new TextDecoder().decode(first.subarray(0, word.length)) === word;
  if (kText.test(name) && first.includes(0) && !begins('AutoCAD Binary DXF')) return `"${name}" is no text, as files of this kind are: it has a byte of code 0.`;
  const text = new TextDecoder().decode(first).trimStart(), wrong = kBegins.find(([kind, right]) => kind.test(name) && text !== '' && !right.test(text));
  if (wrong) return `"${name}" does not begin as files of this kind do, with ${wrong[2]}: "${text.slice(0, kQuoted)}…"`;
  if (/\.ply$/i.test(name) && !begins('ply')) return `"${name}" is no .ply file: it does not begin with "ply".`;
  const isSolid = begins('solid') || (bytes.length - 84) % 50 === 0;
  return /\.stl$/i.test(name) && !isSolid ? `"${name}" is no .stl file: binary ones have 84 bytes and 50 for each triangle, others begin with "solid".` : undefined;
}

/** Throws an Error for the first such file. */
export function checkContents(files: readonly InputFile[]): void {
  for (const file of files) {
    const wrong = contentError(file);
    if (wrong !== undefined) throw new Error(wrong);
  }
}
