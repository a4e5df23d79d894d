// The page of the turning robot as a command asks for it.
import type { Parameters } from '../../shell/embedded';
import { angleOption, angleText, numbersOf, textOf } from '../options';
import type { ObstacleState, Pose } from './state';

/** "x,y,theta", theta in radians or as "90deg". */
function poseIn(text: string | undefined): Pose | undefined {
  const [x, y, theta] = text?.split(',') ?? [], place = numbersOf(`${x},${y}`, 2), angle = angleText(theta?.trim());
  return place && angle !== undefined ? { x: place[0]!, y: place[1]!, tanHalf: Number(theta) === 0 ? '0' : angle } : undefined;
}

/** Of several goals the first. Without poses the robot stands beside the obstacle. */
function withPath(parameters: Parameters, state: ObstacleState): ObstacleState {
  const start = poseIn(textOf(parameters, 'from')), goal = poseIn(textOf(parameters, 'to'));
  const asked = { ...state, strict: parameters.strict === true };
  if (!start || !goal) return asked;
  delete asked.unplaced;
  return { ...asked, start, goal, at: start, path: true };
}

export function asAsked(parameters: Parameters, state: ObstacleState): ObstacleState {
  switch (parameters.verb) {
    case 'slice':
      return { ...state, at: { ...state.at, tanHalf: angleOption(parameters) ?? '0' }, cut: true };
    case 'path':
      return withPath(parameters, state);
    default:
      return state;
  }
}
