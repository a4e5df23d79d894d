// What the page knows of the state it shows: answers of the engine, for drawing.
import type { Configuration, Plan } from 'dymsum';
import { useMemo, useRef } from 'preact/hooks';
import { together, useAnswer, type Standing } from '../../engine/use_answer';
import { useOperand, type Operand } from '../../operands/use_operand';
import { useSettled } from '../../shell/use_settled';
import { useReport } from '../../shell/use_report';
import type { Shell } from '../../shell/page';
import { radiansOf } from '../angle';
import { PathMotion } from './motion';
import type { ObstacleScene, PlaceAnswer } from './service';
import { spaceShape, type SpacePlace, type SpaceShape } from './space';
import type { ObstacleState, Pose } from './state';

export interface ObstacleData {
  robot: Operand;
  obstacle: Operand;
  scene: ObstacleScene | undefined;
  space: SpaceShape | undefined;
  slice: SpacePlace['slice'];
  place: PlaceAnswer | undefined;
  /** the answer for the start and the goal of now */
  plan: Plan | undefined;
  motion: PathMotion | undefined;
  /** a plan is being made */
  planning: boolean;
  /** of the obstacle and what it is to the robot where it stands */
  standing: Standing;
  /** of the path */
  planStanding: Standing;
}

/** The same object as long as it says the same: what is compared by identity then stays. */
function useSame<T>(value: T): T {
  const kept = useRef(value);
  if (JSON.stringify(kept.current) !== JSON.stringify(value)) kept.current = value;
  return kept.current;
}

export function useObstacle(shell: Shell, state: ObstacleState, now: Pose): ObstacleData {
  const { robot, obstacle, strict } = state, { engine } = shell;
  const robotOperand = useOperand(shell, robot), obstacleOperand = useOperand(shell, obstacle);
  const ready = robotOperand.ready && obstacleOperand.ready;
  const scene = useAnswer(engine, 'obstacleScene', ready ? { robot, obstacle } : undefined);
  const known = ready && scene.of?.robot === robot && scene.of.obstacle === obstacle;
  const { tanHalf } = now, pose = useSame(now);
  const slice = useAnswer(engine, 'obstacleSlice', known ? { robot, obstacle, tanHalf, strict } : undefined);
  const place = useAnswer(engine, 'obstaclePlace', known ? { robot, obstacle, pose, strict } : undefined);
  const start = useSame(state.start), goal = useSame(state.goal);
  const ends = useMemo(() => ({ robot, obstacle, start, goal, touching: strict ? 'forbidden' as const : 'allowed' as const }), [robot, obstacle, start, goal, strict]);
  const settled = useSettled(ends);
  const plan = useAnswer(engine, 'obstaclePlan', known && state.path ? settled : undefined);
  const isPlan = state.path && plan.of === ends;
  useReport(shell, scene.error ?? slice.error ?? place.error ?? plan.error);
  const sceneNow = known ? scene.value : undefined;
  const space = useMemo(() => sceneNow && spaceShape(sceneNow), [sceneNow]);
  const path = isPlan ? plan.value : undefined;
  return {
    robot: robotOperand, obstacle: obstacleOperand, scene: sceneNow, space,
    slice: useMemo(() => (known && slice.value && slice.of ? { shape: slice.value, theta: radiansOf(slice.of.tanHalf) } : undefined), [known, slice.value, slice.of]),
    place: known && place.of?.robot === robot ? place.value : undefined,
    standing: together(scene, slice, place), planStanding: plan,
    plan: path, planning: state.path && known && !isPlan && plan.error === undefined,
    motion: useMemo(() => (path && path.path.length > 0 ? new PathMotion(path.path, turnWeight(robotOperand)) : undefined), [path]), // eslint-disable-line react-hooks/exhaustive-deps -- of the robot that the path is for
  };
}

/** How much way a radian is: what the furthest vertex makes. */
function turnWeight({ outline }: Operand): number {
  let furthest = 0;
  const vertices = outline?.shape.vertices ?? [];
  for (let k = 0; k < vertices.length; k += 2) furthest = Math.max(furthest, Math.hypot(vertices[k]!, vertices[k + 1]!));
  return furthest || 1;
}

/** x, y after x, y. */
export function planePath(motion: PathMotion | undefined): Float64Array | undefined {
  return motion && Float64Array.from(motion.waypoints.flatMap(({ x, y }: Configuration) => [x, y]));
}
