// Bars from birth to death, the longest first. One is chosen with the pointer or the arrow keys.
import type { FeatureBar } from 'dymsum';
import { short } from '../../numbers/display';
import { parseRational, toNumber } from '../../numbers/rational';

interface BarcodeProps {
  /** with their indices, the longest first */
  bars: readonly (readonly [number, FeatureBar])[];
  alpha: number;
  /** whether a bar stands out */
  isKept: (bar: FeatureBar) => boolean;
  chosen: number | null;
  onChoose: (bar: number) => void;
}

const kWidth = 306, kRow = 7, kHead = 4;

/** The diameters between which life counts, as texts; no end where `to` is empty. */
export interface Within {
  from: string;
  to: string;
}

export function lifeOf(bar: FeatureBar, { from, to }: Within): number {
  const number = (text: string, otherwise: number): number => (text === '' ? otherwise : toNumber(parseRational(text)!));
  return Math.max(0, Math.min(bar.deathAlpha, number(to, Infinity)) - Math.max(bar.birthAlpha, number(from, 0)));
}

/** What cuts go by: the lesser of how deep a pocket is and how long it lasts, counted from where it was deep; of gaps their life. */
export function significanceOf(bar: FeatureBar, within: Within): number {
  return Math.min(bar.significance, lifeOf({ ...bar, birthAlpha: bar.countsFrom }, within));
}

/** The diameters that a barcode of these bars shows. */
export function reachOf(bars: readonly (readonly [number, FeatureBar])[]): number {
  const ends = bars.flatMap(([, b]) => [b.birthAlpha, b.deathAlpha]).filter(Number.isFinite);
  return Math.max(0, ...ends) * 1.08 || 1;
}

export function Barcode({ bars, alpha, isKept, chosen, onChoose }: BarcodeProps) {
  const reach = reachOf(bars), x = (a: number): number => (Math.min(a, reach) / reach) * kWidth, height = kHead + bars.length * kRow + 4;
  const onKey = (e: KeyboardEvent): void => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[e.key];
    if (!step) return;
    const next = bars[Math.min(Math.max(bars.findIndex(([k]) => k === chosen) + step, 0), bars.length - 1)];
    if (next) onChoose(next[0]);
    e.preventDefault();
  };
  return (
    <svg class="barcode" viewBox={`0 0 ${kWidth} ${height}`} tabindex={0} role="listbox" aria-label="Bars, the longest first" onKeyDown={onKey}>
      <line x1={x(alpha)} x2={x(alpha)} y1="0" y2={height} stroke="var(--sum)" stroke-width="1.5" />
      {bars.map(([index, bar], row) => {
        const y = kHead + row * kRow + kRow / 2, kept = isKept(bar);
        const name = `${bar.born} at ${short(bar.birthAlpha)}, ${bar.died} at ${short(bar.deathAlpha)}`;
        return (
          <g key={index} role="option" aria-selected={index === chosen} aria-label={name} onClick={() => onChoose(index)}>
            <title>{name}</title>
            <rect x="0" y={y - kRow / 2} width={kWidth} height={kRow} fill={index === chosen ? 'var(--hover)' : 'transparent'} />
            <line x1={x(bar.birthAlpha)} x2={Math.max(x(bar.deathAlpha), x(bar.birthAlpha) + 1)} y1={y} y2={y} stroke={`var(--${index === chosen ? 'mark' : kept ? 'cut' : 'faint'})`} stroke-width={kept || index === chosen ? 4 : 2.5} />
            {bar.deathAlpha === Infinity && <path d={`M${kWidth - 5} ${y - 3}l5 3-5 3`} fill="none" stroke="var(--faint)" />}
          </g>
        );
      })}
    </svg>
  );
}
