// The controls of the operand that is scaled or turned.
import { degrees } from '../../numbers/display';
import { tanHalfOf } from '../../numbers/snap';
import { Choice, NumberField, Section, Slider, type Option } from '../../shell/controls';
import type { Change, Shell } from '../../shell/page';
import { checkAngle, radiansOf } from '../angle';
import { firstFactor, isUniform } from '../scale';
import { Lifetimes } from './lifetimes';
import { wordingOf } from './result_section';
import { isStill } from './service';
import { checkSumScale, type SumState } from './state';
import { scaleRange, scaleStep, withScale } from './tools';
import type { Events } from './use_events';
import type { Living } from './use_living';

const kMovers = [['p', 'P', 'P is scaled or turned, about the origin of its coordinates.'], ['q', 'Q', 'Q is scaled or turned, about the origin of its coordinates.']] as const;
const kMotions: readonly Option<SumState['motion']>[] = [['scale', 'Scale', 'It is scaled by an exact number.'], ['turn', 'Turn', 'It is turned by an exact angle.']];

interface MotionProps {
  state: SumState;
  change: Change<SumState>;
  shell: Shell;
  events: Events;
  living: Living;
}

function EventButtons({ state, change, shell, events }: MotionProps) {
  const at = firstFactor(state.scale), ticks = events.found?.ticks, before = ticks?.filter((t) => t.at < at && t.label !== state.scale).at(-1);
  const next = async (): Promise<void> => {
    const event = await events.next();
    if (event) change({ ...state, scale: event.s });
    else shell.announce(`Nothing changes up to scale ${scaleRange(state)[1]}.`);
  };
  return (
    <div class="row">
      <button disabled={!before} onClick={() => before && change({ ...state, scale: before.label })}>
        ‹ Event
      </button>
      <button onClick={() => void next().catch(shell.report)}>Next event ›</button>
      <button onClick={events.find} disabled={ticks !== undefined} title="Finds all scales of the slider at which the sum changes, and from where to where its holes, edges and vertices are there.">
        {ticks ? `${ticks.length} ${ticks.length === 1 ? 'event' : 'events'}` : 'Find all'}
      </button>
    </div>
  );
}

function ScaleControls(props: MotionProps) {
  const { state, change } = props, name = state.moving.toUpperCase(), at = firstFactor(state.scale), [min, max] = scaleRange(state);
  const { events, living } = props, { found } = events, hasEvents = state.shown !== 'fit' && isUniform(state.scale);
  const to = (value: number, how: 'live' | 'done'): void => change(withScale(state, value), how);
  return (
    <>
      <Slider
        label={`Scale of ${name}`} value={at} min={min} max={max} step={scaleStep(state)} text={at.toFixed(3)}
        ticks={hasEvents ? (found?.ticks ?? []) : []} onInput={(v) => to(v, 'live')} onDone={(v) => to(v, 'done')} plays
      />
      {hasEvents && found && <Lifetimes lives={found.lives} living={living} wording={wordingOf(state)} scale={at} min={min} max={max} />}
      {hasEvents && <EventButtons {...props} />}
      <NumberField label="Exactly" value={state.scale} check={checkSumScale} onCommit={(scale) => change({ ...state, scale })} />
    </>
  );
}

function TurnControls({ state, change }: MotionProps) {
  const angle = radiansOf(state.tanHalf), name = state.moving.toUpperCase(), [min, max] = state.range ?? [-Math.PI, Math.PI];
  const to = (radians: number, how: 'live' | 'done'): void => change({ ...state, tanHalf: tanHalfOf(radians) }, how);
  return (
    <>
      <Slider
        label={`Turn of ${name}`} value={angle} min={min} max={max} step={0.002} text={degrees(angle)}
        onInput={(v) => to(v, 'live')} onDone={(v) => to(v, 'done')} plays
      />
      <NumberField label="Tangent of half the angle, exactly" value={state.tanHalf} check={checkAngle} onCommit={(tanHalf) => change({ ...state, tanHalf })} />
    </>
  );
}

/** With another motion the slider covers what it covers by itself. */
function withMotion({ range: _, ...state }: SumState, motion: SumState['motion']): SumState {
  return { ...state, motion };
}

export function MotionSection(props: MotionProps) {
  const { state, change } = props;
  const reset: SumState = { ...state, scale: '1', tanHalf: '0', atP: [0, 0], atQ: [0, 0] };
  const moved = !isStill({ ...state, motion: 'scale' }) || !isStill({ ...state, motion: 'turn' }) || [...state.atP, ...state.atQ].some((x) => x !== 0);
  const motions = state.shown === 'fit' ? kMotions.slice(0, 1) : kMotions;
  return (
    <Section title="Motion">
      <div class="row">
        <Choice label="Which moves" options={kMovers} value={state.moving} onChange={(moving) => change({ ...state, moving })} />
        <div style={{ flex: 1 }}>
          <Choice label="How it moves" options={motions} value={state.motion} onChange={(motion) => change(withMotion(state, motion))} />
        </div>
        <button disabled={!moved} onClick={() => change(reset)}>
          Reset
        </button>
      </div>
      {state.motion === 'scale' ? <ScaleControls {...props} /> : <TurnControls {...props} />}
    </Section>
  );
}
