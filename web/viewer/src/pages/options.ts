// What pages read of a command's options, which are texts as they were written.
import type { Semantics } from 'dymsum';
import { parseRational, toText, multiply, toNumber } from '../numbers/rational';
import type { Parameters } from '../shell/embedded';
import type { Option } from '../shell/controls';
import { isAngle } from './angle';

/** The option's text, of a repeated one the first. */
export function textOf(parameters: Parameters, name: string): string | undefined {
  const given = [parameters[name]].flat()[0];
  return typeof given === 'string' ? given : undefined;
}

/** "x,y,z": exactly so many numbers, or nothing. */
export function numbersOf(text: string | undefined, count: number): number[] | undefined {
  const words = text?.trim().split(/[\s,]+/) ?? [], numbers = words.map(Number);
  return numbers.length === count && words[0] !== '' && numbers.every(Number.isFinite) ? numbers : undefined;
}

export const kSemantics = [
  ['closed', 'Closed', 'Closed sets: where shapes only touch counts as well.'],
  ['open', 'Open', 'Open sets: where shapes only touch does not count, and is shown as tight points and segments.'],
  ['regular', 'Regular', 'Only what has an inside: tight points, segments and faces are left out.'],
] as const satisfies readonly Option<Semantics>[];

export function parseSemantics(value: unknown, otherwise: Semantics): Semantics {
  return kSemantics.find(([name]) => name === value)?.[0] ?? otherwise;
}

/** An angle in radians, or as "90deg"; see angle.ts. */
export function angleText(text: string | undefined): string | undefined {
  const written = text !== undefined && !text.endsWith('deg') ? `${text}rad` : text;
  return written !== undefined && isAngle(written) ? written : undefined;
}

/** `--tan-half`, `--angle` or `--degrees`. */
export function angleOption(parameters: Parameters): string | undefined {
  const tangent = textOf(parameters, 'tan-half'), degrees = textOf(parameters, 'degrees');
  if (tangent !== undefined && isAngle(tangent)) return tangent;
  return angleText(degrees === undefined ? textOf(parameters, 'angle') : `${degrees}deg`);
}

export interface AskedScales {
  /** the first one */
  scale: string;
  /** the least and the largest */
  range?: readonly [number, number];
}

/** `--sweep A:B:STEP`, `--range A:B` or `--at s,s,…`; with `--ratio` y scales by so much more than x. */
export function scalesOf(parameters: Parameters): AskedScales {
  const ends = (textOf(parameters, 'sweep') ?? textOf(parameters, 'range'))?.split(':').slice(0, 2);
  const all = (ends ?? [parameters.at].flat().flatMap((t) => (typeof t === 'string' ? t.split(',') : []))).map((t) => t.trim());
  const numbers = all.map((t) => parseRational(t.split(':')[0]!)).filter((r) => r !== undefined).map(toNumber);
  if (all.length === 0 || numbers.length < all.length) return { scale: '1' };
  return { scale: withRatio(all[0]!, textOf(parameters, 'ratio')), range: [Math.min(...numbers), Math.max(...numbers)] };
}

function withRatio(scale: string, ratio: string | undefined): string {
  const s = parseRational(scale), r = parseRational(ratio ?? '');
  return s && r ? `${scale}:${toText(multiply(s, r))}` : scale;
}
