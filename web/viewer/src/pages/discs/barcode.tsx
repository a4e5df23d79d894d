// Bars from birth to death, the longest first. One is chosen with the pointer or the arrow keys.
import type { FeatureBar } from 'dymsum';
import { short } from '../../numbers/display';

interface BarcodeProps {
  /** with their indices, the longest first */
  bars: readonly (readonly [number, FeatureBar])[];
  alpha: number;
  /** bars of at least this significance are cut at */
  persistence: number | undefined;
  chosen: number | null;
  onChoose: (bar: number) => void;
}

const kWidth = 306, kRow = 7, kHead = 4;

export function lifeOf(bar: FeatureBar): number {
  return bar.deathAlpha - bar.birthAlpha;
}

/** What cuts go by: the lesser of how long a pocket lasts and how deep it is; of gaps their life. */
export function significanceOf(bar: FeatureBar): number {
  return bar.minimum === null ? lifeOf(bar) : Math.min(lifeOf(bar), bar.concavity);
}

/** The diameters that a barcode of these bars shows. */
export function reachOf(bars: readonly (readonly [number, FeatureBar])[]): number {
  const ends = bars.flatMap(([, b]) => [b.birthAlpha, b.deathAlpha]).filter(Number.isFinite);
  return Math.max(0, ...ends) * 1.08 || 1;
}

export function Barcode({ bars, alpha, persistence, chosen, onChoose }: BarcodeProps) {
  const reach = reachOf(bars), x = (a: number): number => (Math.min(a, reach) / reach) * kWidth, height = kHead + bars.length * kRow + 4;
  const onKey = (e: KeyboardEvent): void => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[e.key];
    if (!step) return;
    const next = bars[Math.min(Math.max(bars.findIndex(([k]) => k === chosen) + step, 0), bars.length - 1)];
    if (next) onChoose(next[0]);
    e.preventDefault();
  };
  return (
    <svg class="barcode" viewBox={`0 0 ${kWidth} ${height}`} tabIndex={0} role="listbox" aria-label="Bars, the longest first" onKeyDown={onKey}>
      <line x1={x(alpha)} x2={x(alpha)} y1="0" y2={height} stroke="var(--sum)" stroke-width="1.5" />
      {bars.map(([index, bar], row) => {
        const y = kHead + row * kRow + kRow / 2, kept = persistence !== undefined && significanceOf(bar) >= persistence;
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
