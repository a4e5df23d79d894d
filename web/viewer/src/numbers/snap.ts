// Numbers that a drag gives: short and exact, no finer than what can be seen.

/** The nearest multiple of the largest power of two that is at most half of `seen`: a double without rounding. */
export function snapped(x: number, seen: number): number {
  const step = 2 ** Math.floor(Math.log2(seen / 2));
  return Math.round(x / step) * step;
}

/** The exact turn near an angle: a tangent of its half with denominator 1024, or "inf" for half a turn. */
export function tanHalfOf(radians: number): string {
  const turn = Math.atan2(Math.sin(radians), Math.cos(radians));
  if (Math.PI - Math.abs(turn) < 0.001) return 'inf';
  const n = Math.round(Math.tan(turn / 2) * 1024);
  return n === 0 ? '0' : `${n}/1024`;
}
