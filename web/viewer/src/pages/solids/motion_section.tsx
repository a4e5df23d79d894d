// How Q turns, is scaled and moved.
import { useEffect, useMemo, useState } from 'preact/hooks';
import { parseRational, toNumber } from '../../numbers/rational';
import { Choice, NumberField, Section, Slider } from '../../shell/controls';
import type { Change } from '../../shell/page';
import { motionIsReduced } from '../../shell/theme';
import { Player } from '../../view3d/player';
import { isScale, type SolidsState, type Triple } from './state';

interface MotionProps {
  state: SolidsState;
  change: Change<SolidsState>;
}

const kSecondsPerTurn = 12;
const kStillsPerTurn = 24;
const kSumNames = [['sum', 'P ⊕ Q'], ['hits', 'P ⊕ −Q: where Q hits P']] as const;
const kAxisNames = [['x', 'x'], ['y', 'y'], ['z', 'z'], ['skew', '1, 2, 3']] as const;

/** Turns Q once about its axis, from where it is. */
function useTurn({ state, change }: MotionProps): { playing: boolean; toggle: () => void } {
  const [playing, setPlaying] = useState(false);
  const newest = useMemo(() => ({ state, change, from: 0 }), []); // eslint-disable-line react-hooks/exhaustive-deps -- brought up to date below
  newest.state = state;
  newest.change = change;
  const player = useMemo(() => {
    const show = (share: number, goesOn: boolean): void => {
      const angle = ((((newest.from + 360 * share + 180) % 360) + 360) % 360) - 180;
      newest.change({ ...newest.state, angle: Math.round(100 * angle) / 100 }, goesOn ? 'live' : 'done');
      setPlaying(goesOn);
    };
    return new Player(show, { seconds: kSecondsPerTurn, ...(motionIsReduced() ? { stills: kStillsPerTurn } : {}) });
  }, [newest]);
  useEffect(() => () => player.stop(), [player]);
  const toggle = (): void => {
    if (playing) return player.pause();
    newest.from = state.angle;
    setPlaying(true);
    player.play(0);
  };
  return { playing, toggle };
}

function checkScale(text: string): string | undefined {
  return isScale(text) ? undefined : 'A scale is a positive number such as 1.25 or 5/4.';
}
function checkNumber(text: string): string | undefined {
  return text !== '' && Number.isFinite(Number(text)) ? undefined : 'A number such as 1.25.';
}

function Place({ state, change }: MotionProps) {
  const to = (axis: number, text: string): void => change({ ...state, at: state.at.map((x, k) => (k === axis ? Number(text) : x)) as unknown as Triple });
  return (
    <div class="fields">
      {['x', 'y', 'z'].map((name, k) => (
        <NumberField key={name} label={`${name} of Q`} value={String(state.at[k])} check={checkNumber} onCommit={(text) => to(k, text)} />
      ))}
    </div>
  );
}

export function MotionSection(props: MotionProps) {
  const { state, change } = props, { playing, toggle } = useTurn(props);
  const scale = toNumber(parseRational(state.scale)!);
  const scaleTo = (value: number, how: 'live' | 'done'): void => change({ ...state, scale: String(value) }, how);
  return (
    <Section title="Motion of Q">
      <Choice label="What is computed" options={kSumNames} value={state.sum} onChange={(sum) => change({ ...state, sum })} />
      <Slider
        label="Turn" value={state.angle} min={-180} max={180} step={0.5} text={`${state.angle}°`}
        onInput={(angle) => change({ ...state, angle }, 'live')} onDone={(angle) => change({ ...state, angle })}
      />
      <div class="row">
        <button onClick={toggle}>{playing ? 'Pause' : 'Turn round'}</button>
        <span>about</span>
        <Choice label="Axis" options={kAxisNames} value={state.axis} onChange={(axis) => change({ ...state, axis })} />
      </div>
      <Slider
        label="Scale" value={scale} min={0.125} max={2} step={1 / 64} text={state.scale}
        onInput={(v) => scaleTo(v, 'live')} onDone={(v) => scaleTo(v, 'done')}
      />
      <NumberField label="Scale, exactly" value={state.scale} check={checkScale} onCommit={(text) => change({ ...state, scale: text })} />
      <Place {...props} />
    </Section>
  );
}
