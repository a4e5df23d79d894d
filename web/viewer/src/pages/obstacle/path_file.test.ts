import { expect, it } from 'vitest';
import { pathText } from './path_file';

it('writes waypoints as the command line reads them', () => {
  const text = pathText([{ x: 1, y: 0.5, theta: 0, move: 'start', exact: { x: '1/1', y: '1/2', tanHalf: '0/1' } }]);
  expect(JSON.parse(text)).toEqual({ waypoints: [{ x: 1, y: 0.5, theta: 0, tan_half: '0/1', exact: ['1/1', '1/2'], move: 'start' }] });
});
