// Scales as documents, fields and commands have them: "3/2"; or a factor for each axis, "2:1", of solids "2:1:1/2".
import { multiply, parseRational, rational, toNumber, toText, type Rational } from '../numbers/rational';

/** Sizes with which pages compute: products of two of them, and their inverses, are still doubles. */
const kSmallest = 1e-150, kLargest = 1e150;
export const kSizes = `${kSmallest} to ${kLargest}`;

export function isSize(x: number): boolean {
  return Math.abs(x) >= kSmallest && Math.abs(x) <= kLargest;
}

/** A positive number, or one for each axis, of which one is too large or too small. */
export function isOversized(text: string): boolean {
  const factors = text.split(':').map((t) => parseRational(t.trim()));
  return factors.every((f) => f !== undefined && f.n > 0n) && !factors.every((f) => f && isSize(toNumber(f)));
}

/** One factor for each axis; nothing for what is no scale, or too large or small for one. */
export function factorsOf(text: string, axes: 2 | 3): Rational[] | undefined {
  const factors = text.split(':').map((t) => parseRational(t.trim()));
  if (!factors.every((f) => f !== undefined && f.n > 0n && isSize(toNumber(f)))) return undefined;
  if (factors.length === 1) return Array<Rational>(axes).fill(factors[0]!);
  return factors.length === axes ? (factors as Rational[]) : undefined;
}

export function checkScale(text: string, axes: 2 | 3): string | undefined {
  const each = axes === 2 ? '2:1' : '2:1:1/2';
  return factorsOf(text, axes) ? undefined : `A scale is a positive number such as 1.25 or 5/4, or one for each axis: ${each}. It is from ${kSizes}.`;
}

export function isUniform(text: string): boolean {
  const [first, ...others] = text.split(':').map((t) => parseRational(t.trim()));
  return others.every((f) => f?.n === first?.n && f?.d === first?.d);
}

/** The factor of x, for sliders and drawing. */
export function firstFactor(text: string): number {
  const [first] = factorsOf(text, text.split(':').length === 3 ? 3 : 2) ?? [];
  return first ? toNumber(first) : 1;
}

/** x is scaled by `first` now, and the other axes keep their shares of it, unless that would be no scale. */
export function withFirstFactor(text: string, first: string): string {
  const to = parseRational(first), [was, ...others] = text.split(':').map((t) => parseRational(t.trim()));
  if (!to || !was || others.length === 0) return first;
  const scaled = others.map((f) => multiply(to, multiply(f!, rational(was.d, was.n))));
  return scaled.every((f) => isSize(toNumber(f))) ? [first, ...scaled.map(toText)].join(':') : text;
}
