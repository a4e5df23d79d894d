// Where the robot stands, and at which angle the obstacle is cut.
import { useMemo } from 'preact/hooks';
import { degrees } from '../../numbers/display';
import { tanHalfOf } from '../../numbers/snap';
import { NumberField, Section, Slider, Toggle, type Tick } from '../../shell/controls';
import type { Change } from '../../shell/page';
import { checkAngle, radiansOf } from '../angle';
import { checkCoordinate, type ObstacleState, type Pose } from './state';
import type { ObstacleScene } from './service';

interface PoseProps {
  state: ObstacleState;
  change: Change<ObstacleState>;
  scene: ObstacleScene | undefined;
  /** where the robot is drawn */
  pose: Pose;
  move: (pose: Pose, how?: 'live' | 'done') => void;
}

const kMostTicks = 240;

/** No more than can be told apart. */
export function ticksOf(scene: ObstacleScene): Tick[] {
  const ticks = new Map<number, Tick>();
  for (const { theta, tanHalf } of scene.angles) {
    const place = Math.round((theta / (2 * Math.PI)) * kMostTicks);
    if (!ticks.has(place)) ticks.set(place, { at: theta, strong: tanHalf !== null, label: `${degrees(theta)}${tanHalf === null ? '' : `, tangent of the half ${tanHalf}`}` });
  }
  return [...ticks.values()];
}

/** Finer than `tanHalfOf`, for event angles that no fraction is. */
function nearTanHalf(theta: number): string {
  const fine = 2 ** 40, n = Math.round(Math.tan(theta / 2) * fine);
  return Number.isSafeInteger(n) ? `${n}/${fine}` : tanHalfOf(theta);
}

function EventButtons({ pose, scene, move }: PoseProps) {
  const now = radiansOf(pose.tanHalf), angles = scene?.angles ?? [], apart = 1e-9;
  const before = angles.filter((a) => a.theta < now - apart).at(-1), after = angles.find((a) => a.theta > now + apart);
  const go = (angle: typeof before): void => {
    if (angle) move({ ...pose, tanHalf: angle.tanHalf ?? nearTanHalf(angle.theta) });
  };
  return (
    <div class="row">
      <button disabled={!before} onClick={() => go(before)}>‹ Event</button>
      <button disabled={!after} onClick={() => go(after)}>Event ›</button>
      <span class="quiet">{angles.length} event angles</span>
    </div>
  );
}

export function PoseSection(props: PoseProps) {
  const { state, change, scene, pose, move } = props, theta = radiansOf(pose.tanHalf);
  const ticks = useMemo(() => (scene ? ticksOf(scene) : []), [scene]);
  const turn = (to: number, how: 'live' | 'done'): void => move({ ...pose, tanHalf: tanHalfOf(to) }, how);
  return (
    <Section title="Robot and slice">
      <Slider
        label="θ" value={theta} min={-Math.PI} max={Math.PI} step={0.002} text={degrees(theta)} ticks={ticks}
        onInput={(v) => turn(v, 'live')} onDone={(v) => turn(v, 'done')}
      />
      <EventButtons {...props} />
      <div class="fields">
        <NumberField label="x" value={String(pose.x)} check={checkCoordinate} onCommit={(x) => move({ ...pose, x: Number(x) })} />
        <NumberField label="y" value={String(pose.y)} check={checkCoordinate} onCommit={(y) => move({ ...pose, y: Number(y) })} />
        <NumberField label="tan θ/2" value={pose.tanHalf} check={checkAngle} onCommit={(tanHalf) => move({ ...pose, tanHalf })} />
      </div>
      <Toggle label="Cut the obstacle at θ" hint="Leaves out what lies above the angle of the robot, so that the slice is seen." value={state.cut} onChange={(cut) => change({ ...state, cut })} />
      <Toggle label="See through it" hint="Draws the obstacle half transparent." value={state.through} onChange={(through) => change({ ...state, through })} />
    </Section>
  );
}
