// Asking for a path, and playing it.
import type { Plan } from 'dymsum';
import { useEffect, useMemo } from 'preact/hooks';
import { degrees, short } from '../../numbers/display';
import { Section, Slider, Toggle } from '../../shell/controls';
import type { Change } from '../../shell/page';
import { Results } from '../../shell/results';
import { motionIsReduced } from '../../shell/theme';
import { Player } from '../../view3d/player';
import type { PathMotion } from './motion';
import { noPathTexts } from './names';
import type { ObstacleState } from './state';
import type { ObstacleData } from './use_obstacle';

const kSeconds = 6;
const kStills = 12;

interface PathProps {
  state: ObstacleState;
  change: Change<ObstacleState>;
  data: ObstacleData;
  /** how far along the path the robot is drawn; nothing where it is not on it */
  share: number | undefined;
  setShare: (share: number | undefined) => void;
  playing: boolean;
  setPlaying: (playing: boolean) => void;
}

function usePlayer({ data: { motion }, setShare, setPlaying }: PathProps): Player | undefined {
  const player = useMemo(() => {
    const show = (share: number, playing: boolean): void => {
      setShare(share);
      setPlaying(playing);
    };
    return motion && new Player(show, { seconds: kSeconds, ...(motionIsReduced() ? { stills: kStills } : {}) });
  }, [motion, setShare, setPlaying]);
  useEffect(() => {
    if (!player) return undefined;
    return () => {
      player.stop();
      setPlaying(false);
    };
  }, [player, setPlaying]);
  return player;
}

function moveText(motion: PathMotion, share: number): string {
  const k = motion.moveAt(share), to = motion.waypoints[k + 1];
  if (!to) return 'already there';
  const what = { start: 'start', translation: 'moves', counter_clockwise: 'turns left', clockwise: 'turns right' }[to.move];
  return `${k + 1} of ${motion.waypoints.length - 1}: ${what} to ${short(to.x)}, ${short(to.y)}, ${degrees(to.theta)}`;
}

function Playing(props: PathProps & { motion: PathMotion }) {
  const { motion, share, setShare, playing } = props, player = usePlayer(props);
  const toggle = (): void => {
    if (playing) return player?.pause();
    props.setPlaying(true);
    player?.play(share ?? 0);
  };
  const scrub = (to: number): void => {
    player?.pause();
    setShare(to);
  };
  return (
    <>
      <div class="row">
        <button class="primary" onClick={toggle}>{playing ? 'Pause' : 'Play'}</button>
        <span class="quiet">{motion.waypoints.length - 1} moves, every one checked exactly</span>
      </div>
      <Slider label="Along the path" value={share ?? 0} min={0} max={1} step={0.001} text={`${Math.round(100 * (share ?? 0))} %`} onInput={scrub} onDone={scrub} />
      <p class="quiet">{moveText(motion, share ?? 0)}</p>
    </>
  );
}

function Reason({ plan }: { plan: Plan }) {
  if (!plan.reason) return null;
  const { title, text } = noPathTexts(plan.reason);
  return (
    <div class="reason" role="status">
      <strong>{title}</strong>
      <p>{text}</p>
    </div>
  );
}

export function PathSection(props: PathProps) {
  const { state, change, data } = props, { plan, motion } = data;
  return (
    <Section title="Path">
      <div class="row">
        <button onClick={() => change({ ...state, start: state.at })}>Start here</button>
        <button onClick={() => change({ ...state, goal: state.at })}>Goal here</button>
        <button class={state.path ? '' : 'primary'} onClick={() => change({ ...state, path: !state.path })}>
          {state.path ? 'Clear the path' : 'Find a path'}
        </button>
      </div>
      <Toggle label="Touching is forbidden" hint="Where the robot touches the obstacle counts as inside of it; paths keep clear." value={state.strict} onChange={(strict) => change({ ...state, strict })} />
      {state.path && <Results {...data.planStanding}>{plan && <Reason plan={plan} />}</Results>}
      {data.planning && <p class="quiet">Looking for a path …</p>}
      {motion && <Playing {...props} motion={motion} />}
    </Section>
  );
}
