// Numbers for reading.

/** Six digits at most. */
export function short(x: number): string {
  return Number.isFinite(x) ? String(Number(x.toPrecision(6))) : String(x).replace('Infinity', '∞');
}

export function degrees(radians: number): string {
  return `${Number(((radians * 180) / Math.PI).toFixed(2))}°`;
}

/** A long fraction, its middle left out. */
export function clipped(text: string, most = 160): string {
  return text.length <= most ? text : `${text.slice(0, most / 2)} … ${text.slice(-most / 4)} (${text.length} characters)`;
}
