// What lives how long, as bars above the slider's scales. One is chosen with the pointer or the arrow keys.
import { useState } from 'preact/hooks';
import { Choice, type Option } from '../../shell/controls';
import { kFeatures, kMostLives, type Life, type Lives } from './families';
import { lifeText } from './living';
import type { Wording } from './provenance';
import type { Living } from './use_living';

type Order = 'longest' | 'shortest';
const kOrders: readonly Option<Order>[] = [
  ['longest', 'Longest lives', 'Of holes, edges and vertices those are shown that are there for most of the scales.'],
  ['shortest', 'Shortest', 'Of holes, edges and vertices those are shown that are there for the fewest of the scales.'],
];

/** "the longest 20 of 212 edges". */
function countText(lives: Lives, order: Order): string {
  const names = { hole: ['hole', 'holes'], edge: ['edge', 'edges'], vertex: ['vertex', 'vertices'] } as const;
  return kFeatures
    .map((feature) => {
      const { count } = lives[feature], name = names[feature][count === 1 ? 0 : 1];
      return count > kMostLives ? `the ${order} ${kMostLives} of ${count} ${name}` : `${count || 'no'} ${name}`;
    })
    .join(', ');
}

interface LifetimesProps {
  lives: Lives;
  living: Living;
  wording: Wording;
  scale: number;
  min: number;
  max: number;
}

const kRow = 5, kWidth = 1000;

function Bar({ life, row, props, isChosen }: { life: Life; row: number; props: LifetimesProps; isChosen: boolean }) {
  const { living, wording, min, max } = props, name = lifeText(life, wording);
  const x = (s: number): number => (kWidth * (Math.min(Math.max(s, min), max) - min)) / (max - min);
  const tint = isChosen || life === living.hovered ? 'mark' : { hole: 'tight', edge: 'sum', vertex: 'faint' }[life.feature];
  return (
    <g role="option" aria-selected={isChosen} aria-label={name} onClick={() => living.choose(isChosen ? undefined : life)} onPointerEnter={() => living.hover(life)}>
      <title>{name}</title>
      <rect x="0" y={row * kRow} width={kWidth} height={kRow} fill={isChosen ? 'var(--hover)' : 'transparent'} />
      <rect x={x(life.from)} y={row * kRow + 1} width={Math.max(x(life.to) - x(life.from), 3)} height={kRow - 2} fill={`var(--${tint})`} />
    </g>
  );
}

/** Holes first, then edges, then vertices. */
export function Lifetimes(props: LifetimesProps) {
  const { lives, living, scale, min, max } = props, [order, setOrder] = useState<Order>('longest');
  const bars = kFeatures.flatMap((feature) => lives[feature][order]), height = bars.length * kRow;
  const onKey = (e: KeyboardEvent): void => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[e.key];
    if (!step) return;
    const at = living.chosen ? bars.indexOf(living.chosen) : -1;
    living.choose(bars[Math.min(Math.max(at + step, 0), bars.length - 1)]);
    e.preventDefault();
  };
  const at = (kWidth * (Math.min(Math.max(scale, min), max) - min)) / (max - min);
  return (
    <div class="lifetimes">
      <svg
        viewBox={`0 0 ${kWidth} ${height}`} preserveAspectRatio="none" style={{ height: `${height}px` }} tabindex={0} role="listbox"
        aria-label={`Lifetimes, the ${order} first of each kind`} onKeyDown={onKey} onPointerLeave={() => living.hover(undefined)}
      >
        {bars.map((life, row) => (
          <Bar key={row} life={life} row={row} props={props} isChosen={life === living.chosen} />
        ))}
        <line class="now" x1={at} x2={at} y1="0" y2={height} />
      </svg>
      <p>{`From where to where what is there: ${countText(lives, order)}.`}</p>
      <Choice label="Which lives are shown" options={kOrders} value={order} onChange={setOrder} />
      {living.chosen && <p>{lifeText(living.chosen, props.wording)}</p>}
    </div>
  );
}
