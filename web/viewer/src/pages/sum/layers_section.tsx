// What is drawn, each with a sample of how.
import type { JSX } from 'preact';
import { Section, Toggle } from '../../shell/controls';
import type { Change } from '../../shell/page';
import type { Layer, Shown, SumState } from './state';

const kSetLabels: Record<Shown, string> = { sum: 'sum', hits: 'places that hit', fit: 'places inside' };

function sample(content: JSX.Element) {
  return (
    <svg class="swatch" viewBox="0 0 14 14" fill="none" stroke-width="2" aria-hidden="true">
      {content}
    </svg>
  );
}

const kSamples: readonly (readonly [Layer, string, string, JSX.Element])[] = [
  ['p', 'P', 'The shape P where it stands.', <rect x="1" y="1" width="12" height="12" rx="2" fill="var(--p-fill)" stroke="var(--p)" />],
  ['q', 'Q', 'The shape Q where it stands.', <rect x="1" y="1" width="12" height="12" rx="2" fill="var(--q-fill)" stroke="var(--q)" />],
  ['sum', 'sum', 'The set that is computed.', <rect x="1" y="1" width="12" height="12" rx="2" fill="var(--sum-fill)" stroke="var(--sum)" />],
  ['tight', 'tight points and segments', 'Where the set is only a point or a line: passages and fits without any room.', <path d="M7 1 13 7 7 13 1 7Z" fill="var(--tight)" />],
  ['convolution', 'convolution', 'The edges of P and Q added pairwise by direction: candidates for the boundary.', <path d="M1 12 6 2l7 5" stroke="var(--p)" />],
  ['cells', 'cells proved to be covered', 'Cells of a grid that are proved to lie inside: what is in them is not looked at.', <path d="M1 1h5v5H1zM8 8h5v5H8z" fill="var(--axis)" />],
  ['crossings', 'crossings', 'Where edges of the convolution cross.', <path d="m3 3 8 8m0-8-8 8" stroke="var(--quiet)" />],
  ['dropped', 'loops that were dropped', 'Loops of the convolution that turned out to be no boundary.', <circle cx="7" cy="7" r="5" stroke="var(--mark)" stroke-dasharray="2 2" />],
];

export function LayersSection({ state, change }: { state: SumState; change: Change<SumState> }) {
  const set = (layer: Layer, on: boolean): void =>
    change({ ...state, layers: on ? [...state.layers, layer] : state.layers.filter((l) => l !== layer) });
  return (
    <Section title="Show">
      {kSamples.map(([layer, text, hint, drawing]) => (
        <Toggle
          key={layer} label={layer === 'sum' ? kSetLabels[state.shown] : text} hint={hint} value={state.layers.includes(layer)} swatch={sample(drawing)} onChange={(on) => set(layer, on)}
        />
      ))}
    </Section>
  );
}
