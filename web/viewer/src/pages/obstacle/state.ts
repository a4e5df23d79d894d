// What the page of the turning robot shows.
import { parseShape, type Shape } from '../../engine/shape';
import { checkSize, parseRational } from '../../numbers/rational';
import { isAngle } from '../angle';

/** Where the robot's reference point stands, and its angle, see angle.ts. */
export interface Pose {
  x: number;
  y: number;
  tanHalf: string;
}
export const kWhich = ['at', 'start', 'goal'] as const;
export type Which = (typeof kWhich)[number];

export interface ObstacleState {
  robot: Shape;
  obstacle: Shape;
  at: Pose;
  start: Pose;
  goal: Pose;
  /** contacts are forbidden to paths and count as inside */
  strict: boolean;
  /** a path from start to goal is asked for */
  path: boolean;
  /** the obstacle is cut at the angle of now */
  cut: boolean;
  /** the obstacle is half transparent */
  through: boolean;
  /** the poses are for other shapes: the robot is to be put beside the obstacle */
  unplaced?: true;
}

export function obstacleState(robot: Shape, obstacle: Shape, start: Pose, goal: Pose, changes: Partial<ObstacleState> = {}): ObstacleState {
  return { robot, obstacle, start, goal, at: start, strict: false, path: false, cut: false, through: true, ...changes };
}

/** Why a text is no coordinate of a pose, which is a double; nothing where it is one. */
export function checkCoordinate(text: string): string | undefined {
  const exact = text.includes('/') ? undefined : parseRational(text);
  return exact ? checkSize(exact) : 'A coordinate is a decimal number such as 1.25, no fraction.';
}

function parsePose(value: unknown, otherwise: Pose): Pose {
  const { x, y, tanHalf } = (value ?? {}) as Partial<Record<keyof Pose, unknown>>;
  const isPose = Number.isFinite(x) && Number.isFinite(y) && typeof tanHalf === 'string' && isAngle(tanHalf);
  return isPose ? { x: x as number, y: y as number, tanHalf } : otherwise;
}

export const kOrigin: Pose = { x: 0, y: 0, tanHalf: '0' };

/** Throws an Error for what is no state of this page. What is left out is as in a new one. */
export function parseObstacleState(value: unknown): ObstacleState {
  const v = (value ?? {}) as Partial<Record<keyof ObstacleState, unknown>>;
  const start = parsePose(v.start, kOrigin);
  return obstacleState(parseShape(v.robot), parseShape(v.obstacle), start, parsePose(v.goal, kOrigin), {
    at: parsePose(v.at, start), strict: v.strict === true, path: v.path === true, cut: v.cut === true, through: v.through !== false,
  });
}
