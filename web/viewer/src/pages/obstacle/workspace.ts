// The workspace: the obstacle, the robot where it stands, at its start and at its goal, its path and its nearest contact.
import type { Clearance, Configuration } from 'dymsum';
import type { Outline } from '../../operands/outline';
import { tanHalfOf, snapped } from '../../numbers/snap';
import { colour } from '../../shell/theme';
import { applied, inverted, placed, type Affine } from '../../view2d/affine';
import type { Box, Point } from '../../view2d/camera';
import { isInside } from '../../view2d/edge_grid';
import type { Grip } from '../../view2d/gestures';
import type { Painter } from '../../view2d/painter';
import { configuration } from './service';
import type { ObstacleState, Pose, Which } from './state';

export interface WorkspaceScene {
  robot: Outline | undefined;
  obstacle: Outline | undefined;
  /** where the robot is drawn: on its path while that is played */
  now: Configuration;
  state: ObstacleState;
  /** x, y after x, y */
  path: Float64Array | undefined;
  clearance: Clearance | undefined;
  overlaps: boolean;
  wrong: Point[];
}

export function placing({ x, y, theta }: Configuration): Affine {
  return placed(1, theta, x, y);
}

/** How far the turning handle is from the reference point. */
export function handleRadius(robot: Outline): number {
  const { vertices } = robot.shape;
  let furthest = 0;
  for (let k = 0; k < vertices.length; k += 2) furthest = Math.max(furthest, Math.hypot(vertices[k]!, vertices[k + 1]!));
  return 1.15 * furthest || 1;
}

function handleOf(robot: Outline, at: Configuration): Point {
  return applied(placing(at), { x: handleRadius(robot), y: 0 });
}

export function paintWorkspace(painter: Painter, scene: WorkspaceScene): void {
  const { robot, obstacle, state, now } = scene;
  obstacle?.paint(painter, colour('--p-fill'), { colour: colour('--p'), width: 1.5 });
  if (scene.path) paintPath(painter, scene.path);
  if (!robot) return;
  for (const which of ['start', 'goal'] as const) paintEnd(painter, robot, state[which], which);
  const near = scene.clearance;
  if (near) paintNearest(painter, robot, scene, near);
  const line = { colour: colour(scene.overlaps ? '--tight' : '--q'), width: 2 };
  robot.paint(painter, colour('--q-fill'), line, placing(now));
  paintHandle(painter, robot, now);
  for (const at of scene.wrong) painter.wrong(at, colour('--error'));
}

function paintPath(painter: Painter, points: Float64Array): void {
  painter.trace({ vertices: points, starts: Uint32Array.of(0, points.length / 2) }, undefined, false);
  painter.line({ colour: colour('--sum'), width: 2.5 });
}

function paintEnd(painter: Painter, robot: Outline, pose: Pose, name: string): void {
  const at = configuration(pose), style = { colour: colour('--quiet'), width: 1.5, dash: name === 'start' ? [2, 4] : [7, 4] };
  robot.paint(painter, 'transparent', style, placing(at));
  const { x, y } = painter.at(at), { canvas } = painter;
  painter.dot(at, 3.5, colour('--quiet'));
  painter.dot(handleOf(robot, at), 4, colour('--ground'), colour('--quiet'));
  canvas.font = '12.5px system-ui, sans-serif';
  canvas.fillStyle = colour('--quiet');
  canvas.fillText(name, x + 7, y - 7);
}

function paintHandle(painter: Painter, robot: Outline, at: Configuration): void {
  const handle = handleOf(robot, at);
  painter.segments([at.x, at.y, handle.x, handle.y], { colour: colour('--q'), width: 1, dash: [2, 3] });
  painter.dot(at, 4, colour('--q'), colour('--ground'));
  painter.dot(handle, 6, colour('--q'), colour('--ground'));
}

/** The robot at the nearest contact, and the edge and the vertex that touch there. */
function paintNearest(painter: Painter, robot: Outline, scene: WorkspaceScene, { nearest, contact }: Clearance): void {
  const mark = { colour: colour('--mark'), width: 1.25, dash: [4, 3] };
  const by = placing(nearest);
  robot.paint(painter, 'transparent', mark, by);
  if (!contact || !scene.obstacle) return;
  const strong = { colour: colour('--mark'), width: 4 };
  const edge = (outline: Outline, k: number, moved?: Affine): void => {
    const a = outline.vertex(k), b = outline.vertex(outline.next(k));
    painter.segments([a.x, a.y, b.x, b.y], strong, moved);
  };
  if (contact.kind === 'edge_of_p') {
    edge(scene.obstacle, contact.p);
    painter.dot(applied(by, robot.vertex(contact.q)), 4.5, colour('--mark'), colour('--ground'));
  } else {
    edge(robot, contact.q, by);
    painter.dot(scene.obstacle.vertex(contact.p), 4.5, colour('--mark'), colour('--ground'));
  }
}

type Move = (which: Which, pose: Pose, how: 'live' | 'done') => void;

/** What is dragged: a handle turns, the robot moves; the robot before its goal, that before its start. */
export function gripOf(robot: Outline, poses: Record<Which, Pose>, at: Point, reach: number, move: Move): Grip | undefined {
  const order: readonly Which[] = ['at', 'goal', 'start'];
  const isNear = (p: Point): boolean => Math.hypot(p.x - at.x, p.y - at.y) <= reach;
  const handle = order.find((which) => isNear(handleOf(robot, configuration(poses[which]))));
  if (handle) return turningGrip(handle, poses[handle], move);
  const isOn = (pose: Configuration): boolean => isNear(pose) || isInside(robot.rings, inverted(placing(pose), at));
  const body = order.find((which) => isOn(configuration(poses[which])));
  return body && movingGrip(body, poses[body], reach, move);
}

function turningGrip(which: Which, was: Pose, move: Move): Grip {
  const to = (p: Point, how: 'live' | 'done'): void => move(which, { ...was, tanHalf: tanHalfOf(Math.atan2(p.y - was.y, p.x - was.x)) }, how);
  return { drag: (_, p) => to(p, 'live'), drop: (_, p) => (p ? to(p, 'done') : move(which, was, 'done')) };
}

function movingGrip(which: Which, was: Pose, seen: number, move: Move): Grip {
  const fine = seen / 8; // what a pixel is
  const to = (from: Point, p: Point, how: 'live' | 'done'): void =>
    move(which, { ...was, x: snapped(was.x + p.x - from.x, fine), y: snapped(was.y + p.y - from.y, fine) }, how);
  return { drag: (from, p) => to(from, p, 'live'), drop: (from, p) => (p ? to(from, p, 'done') : move(which, was, 'done')) };
}

/** The robot left of the obstacle, and right of it. */
export function posesBeside(robot: Outline, { x0, y0, x1, y1 }: Box): { start: Pose; goal: Pose } {
  const away = 1.25 * handleRadius(robot), y = snapped((y0 + y1) / 2, away / 16);
  return { start: { x: snapped(x0 - away, away / 16), y, tanHalf: '0' }, goal: { x: snapped(x1 + away, away / 16), y, tanHalf: '0' } };
}

/** An exact pose near one on a path. */
export function poseOf({ x, y, theta }: Configuration): Pose {
  return { x, y, tanHalf: tanHalfOf(theta) };
}
