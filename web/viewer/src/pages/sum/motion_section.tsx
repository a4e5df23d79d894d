// The controls of the operand that is scaled or turned.
import { degrees } from '../../numbers/display';
import { parseRational, toNumber } from '../../numbers/rational';
import { tanHalfOf } from '../../numbers/snap';
import { Choice, NumberField, Section, Slider } from '../../shell/controls';
import type { Change, Shell } from '../../shell/page';
import { radiansOf, scaleOf } from './placing';
import type { SumArgs } from './service';
import type { SumState } from './state';
import { kScaleRange } from './tools';
import { useEvents, type Events } from './use_events';

interface MotionProps {
  state: SumState;
  change: Change<SumState>;
  shell: Shell;
  args: SumArgs;
}

function checkScale(text: string): string | undefined {
  const s = parseRational(text);
  return s && s.n > 0n ? undefined : 'A scale is a positive number such as 1.25 or 5/4.';
}
function checkTanHalf(text: string): string | undefined {
  return text === 'inf' || parseRational(text) ? undefined : 'The tangent of half the angle is a number such as 1/3, or inf.';
}

function EventButtons({ state, change, shell, events }: MotionProps & { events: Events }) {
  const at = scaleOf(state), before = events.ticks?.filter((t) => t.at < at && t.label !== state.scale).at(-1);
  const next = async (): Promise<void> => {
    const event = await events.next();
    if (event) change({ ...state, scale: event.s });
    else shell.announce(`Nothing changes up to scale ${kScaleRange[1]}.`);
  };
  return (
    <div class="row">
      <button disabled={!before} onClick={() => before && change({ ...state, scale: before.label })}>
        ‹ Event
      </button>
      <button onClick={() => void next().catch(shell.report)}>Next event ›</button>
      <button onClick={events.find} disabled={events.ticks !== undefined}>
        {events.ticks ? `${events.ticks.length} ${events.ticks.length === 1 ? 'event' : 'events'}` : 'Find all'}
      </button>
    </div>
  );
}

function ScaleControls(props: MotionProps) {
  const { state, change } = props, name = state.moving.toUpperCase();
  const events = useEvents(props.shell, props.args);
  const to = (value: number, how: 'live' | 'done'): void => change({ ...state, scale: String(Math.round(value * 1000) / 1000) }, how);
  return (
    <>
      <Slider
        label={`Scale of ${name}`} value={scaleOf(state)} min={kScaleRange[0]} max={kScaleRange[1]} step={0.001} text={scaleOf(state).toFixed(3)}
        ticks={events.ticks ?? []} onInput={(v) => to(v, 'live')} onDone={(v) => to(v, 'done')} plays
      />
      <EventButtons {...props} events={events} />
      <NumberField label="Exactly" value={state.scale} check={checkScale} onCommit={(scale) => change({ ...state, scale })} />
    </>
  );
}

function TurnControls({ state, change }: MotionProps) {
  const angle = radiansOf(state.tanHalf), name = state.moving.toUpperCase();
  const to = (radians: number, how: 'live' | 'done'): void => change({ ...state, tanHalf: tanHalfOf(radians) }, how);
  return (
    <>
      <Slider
        label={`Turn of ${name}`} value={angle} min={-Math.PI} max={Math.PI} step={0.002} text={degrees(angle)}
        onInput={(v) => to(v, 'live')} onDone={(v) => to(v, 'done')} plays
      />
      <NumberField label="Tangent of half the angle, exactly" value={state.tanHalf} check={checkTanHalf} onCommit={(tanHalf) => change({ ...state, tanHalf })} />
    </>
  );
}

export function MotionSection(props: MotionProps) {
  const { state, change } = props;
  const reset: SumState = { ...state, scale: '1', tanHalf: '0', atP: [0, 0], atQ: [0, 0] };
  const moved = toNumber(parseRational(state.scale) ?? { n: 1n, d: 1n }) !== 1 || state.tanHalf !== '0' || [...state.atP, ...state.atQ].some((x) => x !== 0);
  return (
    <Section title="Motion">
      <div class="row">
        <Choice label="Which moves" options={[['p', 'P'], ['q', 'Q']]} value={state.moving} onChange={(moving) => change({ ...state, moving })} />
        <div style={{ flex: 1 }}>
          <Choice label="How it moves" options={[['scale', 'Scale'], ['turn', 'Turn']]} value={state.motion} onChange={(motion) => change({ ...state, motion })} />
        </div>
        <button disabled={!moved} onClick={() => change(reset)}>
          Reset
        </button>
      </div>
      {state.motion === 'scale' ? <ScaleControls {...props} /> : <TurnControls {...props} />}
    </Section>
  );
}
