// Which solid moves, and how it turns, is scaled and stands.
import { useEffect, useMemo, useState } from 'preact/hooks';
import { Choice, NumberField, Section, Slider } from '../../shell/controls';
import type { Change } from '../../shell/page';
import { motionIsReduced } from '../../shell/theme';
import { Player } from '../../view3d/player';
import { kSemantics, numbersOf } from '../options';
import { checkScale, firstFactor, kSizes, withFirstFactor } from '../scale';
import { axisOf, isPlace, kAxes, withSet, type SolidsState, type Triple } from './state';

interface MotionProps {
  state: SolidsState;
  change: Change<SolidsState>;
}

const kSecondsPerTurn = 12;
const kStillsPerTurn = 24;
const kScaleRange = [0.125, 2] as const;
const kSumNames = [
  ['sum', 'P ⊕ Q', 'The sum: every point of P added to every point of Q.'],
  ['hits', 'P ⊕ −Q', 'The places of Q at which it hits P.'],
  ['fit', 'Fit in P', 'The places of Q at which all of it lies inside P: the inner fit.'],
] as const;
const kAxisNames = [['x', 'x', 'It turns about the x axis.'], ['y', 'y', 'It turns about the y axis.'], ['z', 'z', 'It turns about the z axis.'], ['skew', '1, 2, 3', 'It turns about the direction (1, 2, 3).']] as const;

/** Turns what moves once about its axis, from where it is. */
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

function checkNumber(text: string): string | undefined {
  return text !== '' && isPlace(Number(text)) ? undefined : `A number such as 1.25: 0, or in size from ${kSizes}.`;
}
function axisIn(text: string): Triple | undefined {
  return axisOf(numbersOf(text, 3));
}

function AxisRow({ state, change }: MotionProps) {
  const known = kAxisNames.find(([name]) => kAxes[name].join() === state.axis.join())?.[0];
  return (
    <>
      <Choice label="Axis" options={kAxisNames} value={known ?? ('' as keyof typeof kAxes)} onChange={(name) => change({ ...state, axis: kAxes[name] })} />
      <NumberField
        label="Axis of the turn" value={state.axis.join(', ')} check={(text) => (axisIn(text) ? undefined : 'An axis is three numbers such as 1, 2, 3, not all of them 0, and none very large or small.')}
        onCommit={(text) => change({ ...state, axis: axisIn(text)! })}
      />
    </>
  );
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

function ScaleControls({ state, change }: MotionProps) {
  const [low, high] = state.range ?? kScaleRange, to = (value: number, how: 'live' | 'done'): void => change({ ...state, scale: withFirstFactor(state.scale, String(value)) }, how);
  return (
    <>
      <Slider
        label="Scale" value={firstFactor(state.scale)} min={Math.min(low, kScaleRange[0])} max={Math.max(high, kScaleRange[1])} step={1 / 64} text={state.scale}
        onInput={(v) => to(v, 'live')} onDone={(v) => to(v, 'done')}
      />
      <NumberField label="Scale, exactly" value={state.scale} check={(text) => checkScale(text, 3)} onCommit={(text) => change({ ...state, scale: text })} />
    </>
  );
}

export function SetSection({ state, change }: MotionProps) {
  const showAll = (): void => {
    const everywhere = { ...state };
    delete everywhere.look;
    change(everywhere);
  };
  return (
    <Section title="What is computed">
      <Choice label="What is computed" options={kSumNames} value={state.sum} onChange={(sum) => change(withSet(state, sum))} />
      <Choice label="What touching counts" options={kSemantics} value={state.semantics} onChange={(semantics) => change({ ...state, semantics })} />
      {state.look && (
        <div class="row">
          <button onClick={showAll}>Show all, not only the part</button>
        </div>
      )}
    </Section>
  );
}

function TurnControls(props: MotionProps) {
  const { state, change } = props, { playing, toggle } = useTurn(props);
  return (
    <>
      <Slider
        label="Turn" value={state.angle} min={-180} max={180} step={0.5} text={`${state.angle}°`}
        onInput={(angle) => change({ ...state, angle }, 'live')} onDone={(angle) => change({ ...state, angle })}
      />
      <div class="row">
        <button onClick={toggle}>{playing ? 'Pause' : 'Turn round'}</button>
      </div>
      <AxisRow {...props} />
    </>
  );
}

export function MotionSection(props: MotionProps) {
  const { state, change } = props, isFit = state.sum === 'fit', does = isFit ? 'is scaled' : 'turns and is scaled';
  return (
    <Section title="Motion">
      <Choice label="Which moves" options={[['p', `P ${does}`, `P ${does}, and Q stays as it is.`], ['q', 'Q does', `Q ${does}, and P stays as it is.`]]} value={state.moving} onChange={(moving) => change({ ...state, moving })} />
      {isFit ? <p class="quiet">The inner fit is exact only of solids that are not turned: they stand as their files say.</p> : <TurnControls {...props} />}
      <ScaleControls {...props} />
      <Place {...props} />
    </Section>
  );
}
