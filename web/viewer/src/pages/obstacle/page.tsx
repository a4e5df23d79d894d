import { areAgain, planarShapes } from '../../operands/planar_files';
import type { Page } from '../../shell/page';
import { asAsked } from './command';
import { kExamples } from './examples';
import { kOrigin, parseObstacleState, type ObstacleState } from './state';
import { kSummary, View } from './view';

export const obstaclePage: Page<ObstacleState> = {
  id: 'obstacle',
  title: 'Robot',
  summary: kSummary,
  examples: kExamples,
  parse: parseObstacleState,
  /** One file is the obstacle, two are the robot and the obstacle. */
  take: (files, state) => {
    const shapes = planarShapes(files, 2);
    const [robot, obstacle] = shapes.length === 2 ? shapes : [state.robot, shapes[0]!];
    if (areAgain(shapes, [state.robot, state.obstacle])) return { ...state, robot, obstacle };
    return { ...state, robot, obstacle, at: kOrigin, path: false, unplaced: true };
  },
  command: asAsked,
  View,
};
