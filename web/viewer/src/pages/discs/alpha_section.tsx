// The diameter of the disc, and its events.
import { short } from '../../numbers/display';
import { fromDouble, multiply, parseRational, rational, toNumber, toText } from '../../numbers/rational';
import { Choice, NumberField, Section, Slider, type Tick } from '../../shell/controls';
import type { Change } from '../../shell/page';
import { kSemantics } from '../options';
import { checkLength, kOperations, naturalSemantics, type DiscState } from './state';

interface AlphaProps {
  state: DiscState;
  change: Change<DiscState>;
  events: Float64Array | undefined;
  reach: number;
}

const kMostTicks = 150;

export function alphaOf(state: Pick<DiscState, 'alpha'>): number {
  return toNumber(parseRational(state.alpha) ?? rational(0n));
}

/** The diameter of a radius. */
export function alphaText(radius: number): string {
  return toText(multiply(fromDouble(radius), rational(2n)));
}

function ticksOf(events: Float64Array | undefined): Tick[] {
  const step = Math.ceil((events?.length ?? 0) / kMostTicks), ticks: Tick[] = [];
  events?.forEach((radius, k) => {
    if (k % step === 0) ticks.push({ at: 2 * radius, strong: false, label: `event ${k}` });
  });
  return ticks;
}

function EventButtons({ state, change, events }: AlphaProps) {
  const radius = alphaOf(state) / 2, count = events?.length ?? 0;
  const after = state.event === null ? (events ?? []).findIndex((r) => r > radius) : state.event + 1;
  const next = after < 0 ? count : after, before = state.event === null ? next - 1 : state.event - 1;
  const go = (event: number): void => change({ ...state, event, alpha: alphaText(events![event]!) });
  return (
    <div class="row">
      <button disabled={!events || before < 0} onClick={() => go(before)}>‹ Event</button>
      <button disabled={!events || next >= count} onClick={() => go(next)}>Next event ›</button>
      <span style={{ color: 'var(--quiet)' }}>{events ? (state.event === null ? `${count} ${count === 1 ? 'event' : 'events'}` : `${state.event + 1} of ${count}, exactly`) : '…'}</span>
    </div>
  );
}

export function AlphaSection(props: AlphaProps) {
  const { state, change, events, reach } = props, alpha = alphaOf(state);
  const step = 10 ** Math.floor(Math.log10(reach / 500));
  const to = (value: number, how: 'live' | 'done'): void => change({ ...state, event: null, alpha: short(Math.round(value / step) * step) }, how);
  return (
    <Section title="Disc">
      <Choice label="What the disc makes" options={kOperations} value={state.operation} onChange={(operation) => change({ ...state, operation, semantics: naturalSemantics(operation), event: null })} />
      <Choice label="What touching counts" options={kSemantics} value={state.semantics} onChange={(semantics) => change({ ...state, semantics })} />
      <Slider label="Diameter α" value={alpha} min={0} max={reach} step={step} text={short(alpha)} ticks={ticksOf(events)} onInput={(v) => to(v, 'live')} onDone={(v) => to(v, 'done')} plays />
      <EventButtons {...props} />
      <NumberField label="Exactly" value={state.event === null ? state.alpha : `event ${state.event + 1}`} check={checkLength} onCommit={(text) => change({ ...state, event: null, alpha: text })} />
    </Section>
  );
}
