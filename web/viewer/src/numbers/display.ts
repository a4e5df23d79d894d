// Numbers for reading.
import { parseRational, type Rational } from './rational';

/** Six digits at most. */
export function short(x: number): string {
  return Number.isFinite(x) ? String(Number(x.toPrecision(6))) : String(x).replace('Infinity', '∞');
}

const kDigits = 6;

/** The first digits, rounded, and the power of ten of the first one. Requires: n > 0. */
function leading({ n, d }: Rational): [digits: bigint, power: number] {
  const rounded = (power: number): bigint => {
    const shift = BigInt(kDigits - 1 - power), [top, bottom] = shift >= 0n ? [n * 10n ** shift, d] : [n, d * 10n ** -shift];
    return (2n * top + bottom) / (2n * bottom);
  };
  let power = String(n).length - String(d).length - 1, digits = rounded(power); // the right one, or one too low
  while (digits >= 10n ** BigInt(kDigits)) digits = rounded(++power);
  return [digits, power];
}

/** The same of an exact text, a fraction or a decimal, also where no double is near it: "2e+500". */
export function shortText(text: string): string {
  const exact = parseRational(text), near = Number(text);
  if (!exact) return Number.isNaN(near) ? text : short(near);
  if (exact.n === 0n) return '0';
  const [digits, power] = leading({ ...exact, n: exact.n < 0n ? -exact.n : exact.n }), sign = exact.n < 0n ? '-' : '';
  if (power > -300 && power < 300) return short(Number(`${sign}${digits}e${power - kDigits + 1}`));
  const [first, ...rest] = String(digits).replace(/0+$/, '');
  return `${sign}${first}${rest.length > 0 ? '.' : ''}${rest.join('')}e${power < 0 ? '' : '+'}${power}`;
}

export function degrees(radians: number): string {
  return `${Number(((radians * 180) / Math.PI).toFixed(2))}°`;
}

/** A long fraction, its middle left out. */
export function clipped(text: string, most = 160): string {
  return text.length <= most ? text : `${text.slice(0, most / 2)} … ${text.slice(-most / 4)} (${text.length} characters)`;
}
