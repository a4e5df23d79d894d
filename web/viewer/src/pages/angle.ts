// Angles as documents and fields hold them: the tangent of half of one, exactly, as "1/3", or "inf" for half a turn; or the
// angle as commands take it, "90deg" or "0.8rad", which the engine meets within 2^-50, and quarter turns exactly.
import type { Angle } from 'dymsum';
import { parseRational, toNumber, type Rational } from '../numbers/rational';

const kQuarters = [0, Math.PI / 2, Math.PI, -Math.PI / 2] as const;
const kPi = 314159265358979323846264338327950288419716939937510582097494n; // 59 digits behind the point

/** Less whole turns, and rounded once, as the program's `reduced_degrees`: angles in degrees are the same in both. */
function radiansOfDegrees({ n, d }: Rational): number {
  const whole = 360n * d;
  let rest = n % whole;
  if (2n * rest > whole) rest -= whole;
  if (2n * rest <= -whole) rest += whole;
  if ((4n * rest) % whole === 0n) return kQuarters[Number((4n + (4n * rest) / whole) % 4n)]!;
  return Number(`${(rest * kPi) / (180n * d)}e-59`);
}

function writtenRadians(text: string): number | undefined {
  const [, number = '', unit] = /^(.*?)(deg|rad)$/.exec(text) ?? [];
  const exact = parseRational(number);
  if (!exact) return undefined;
  return unit === 'deg' ? radiansOfDegrees(exact) : Number(number);
}

export function isAngle(text: string): boolean {
  return text === 'inf' || parseRational(text) !== undefined || Number.isFinite(writtenRadians(text));
}

/** Why a text is no angle; nothing where it is one. */
export function checkAngle(text: string): string | undefined {
  return isAngle(text) ? undefined : 'The tangent of half the angle is a number such as 1/3, or inf; or an angle such as 30deg or 0.8rad.';
}

/** For drawing. 0 for a text that is no angle. */
export function radiansOf(text: string): number {
  const exact = parseRational(text);
  return text === 'inf' ? Math.PI : exact ? 2 * Math.atan(toNumber(exact)) : (writtenRadians(text) ?? 0);
}

/** What the engine takes. */
export function angleOf(text: string): Angle {
  return writtenRadians(text) ?? { tanHalf: text };
}
