// Fractions of integers: to read and to add exact positions. Everything else that is exact is done by the engine.

export interface Rational {
  n: bigint;
  /** positive, without a common divisor with n */
  d: bigint;
}

function gcd(a: bigint, b: bigint): bigint {
  while (b !== 0n) [a, b] = [b, a % b];
  return a < 0n ? -a : a;
}

export function rational(n: bigint, d = 1n): Rational {
  const g = gcd(n, d) * (d < 0n ? -1n : 1n);
  return { n: n / g, d: d / g };
}

/** "3/2", "-4", "1.25", ".5", "1e-3"; nothing for what is no number. */
export function parseRational(text: string): Rational | undefined {
  const [, sign, whole, fraction = '', exponent = '0'] = /^([+-]?)(?=\.?\d)(\d*)(?:\.(\d*))?(?:e([+-]?\d{1,4}))?$/i.exec(text) ?? [];
  if (whole !== undefined) {
    const digits = BigInt(whole + fraction) * (sign === '-' ? -1n : 1n);
    const shift = Number(exponent) - fraction.length;
    return shift >= 0 ? rational(digits * 10n ** BigInt(shift)) : rational(digits, 10n ** BigInt(-shift));
  }
  const parts = /^([+-]?\d+)\/(\d+)$/.exec(text);
  if (!parts || BigInt(parts[2]!) === 0n) return undefined;
  return rational(BigInt(parts[1]!), BigInt(parts[2]!));
}

/** The double at face value. Requires: finite. */
export function fromDouble(x: number): Rational {
  let steps = 0;
  while (!Number.isInteger(x)) {
    x *= 2;
    ++steps;
  }
  return rational(BigInt(x), 1n << BigInt(steps));
}

export function add(a: Rational, b: Rational): Rational {
  return rational(a.n * b.d + b.n * a.d, a.d * b.d);
}
export function subtract(a: Rational, b: Rational): Rational {
  return rational(a.n * b.d - b.n * a.d, a.d * b.d);
}
export function multiply(a: Rational, b: Rational): Rational {
  return rational(a.n * b.n, a.d * b.d);
}

/** "3/2"; integers without a denominator. */
export function toText({ n, d }: Rational): string {
  return d === 1n ? String(n) : `${n}/${d}`;
}

/** A double near it, for drawing; an infinity where there is none. */
export function toNumber({ n, d }: Rational): number {
  const size = (x: bigint): number => x.toString(2).length;
  const shift = size(d) - size(n) + 64, half = Math.trunc(shift / 2); // the quotient has some 64 bits
  const quotient = shift >= 0 ? (n << BigInt(shift)) / d : n / (d << BigInt(-shift));
  return Number(quotient) * 2 ** -half * 2 ** (half - shift); // in two steps: each power is a double
}

/** Whether it can be drawn: it has a finite double near it, and is not so small that only 0 is. */
export function isNearDouble(r: Rational): boolean {
  const x = toNumber(r);
  return Number.isFinite(x) && (x !== 0 || r.n === 0n);
}

/** Why a number cannot be drawn; nothing where it can. */
export function checkSize(r: Rational): string | undefined {
  return isNearDouble(r) ? undefined : `The number is too ${r.d > 1n && toNumber(r) === 0 ? 'near to 0' : 'large'}: it has to lie within the range of doubles.`;
}
