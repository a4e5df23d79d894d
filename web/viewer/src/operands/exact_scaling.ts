// Whether scaled coordinates are doubles again.
import { fromDouble, toNumber, type Rational } from '../numbers/rational';

/** The odd integer m of x = m 2^k; 0 for 0. */
function digits(x: number): number {
  let m = Math.abs(x);
  while (!Number.isInteger(m)) m *= 2;
  while (m !== 0 && m % 2 === 0) m /= 2;
  return m;
}

/**
 * Coordinates come axis by axis, x, y, x, y, ..., and are scaled by the factor of their axis. A product of odd integers has the
 * digits of a double where it is below 2^53; coordinates near the ends of the range of doubles are not looked for.
 */
export function scalesExactly(coordinates: Float64Array, factors: readonly Rational[]): boolean {
  const isDouble = (f: Rational): boolean => {
    const { n, d } = fromDouble(toNumber(f));
    return n === f.n && d === f.d;
  };
  if (!factors.every(isDouble)) return false;
  const odd = factors.map((f) => digits(toNumber(f)));
  return coordinates.every((x, k) => digits(x) * odd[k % odd.length]! < 2 ** 53);
}
