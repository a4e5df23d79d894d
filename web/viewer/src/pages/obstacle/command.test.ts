import { describe, expect, it } from 'vitest';
import { asAsked } from './command';
import { obstacleState, parseObstacleState } from './state';

const kOrigin = { x: 0, y: 0, tanHalf: '0' };
const kState = obstacleState({ name: 'r.wkt', text: '' }, { name: 'o.wkt', text: '' }, kOrigin, kOrigin, { unplaced: true });

describe('the page of the turning robot', () => {
  it('is cut at the angle of slice', () => {
    expect(asAsked({ verb: 'slice', 'tan-half': '1/3' }, kState)).toMatchObject({ at: { tanHalf: '1/3' }, cut: true, unplaced: true });
    expect(asAsked({ verb: 'slice', angle: '0.8' }, kState)).toMatchObject({ at: { tanHalf: '0.8rad' } });
    expect(asAsked({ verb: 'slice', angle: '90deg' }, kState)).toMatchObject({ at: { tanHalf: '90deg' } });
    expect(asAsked({ verb: 'slice', degrees: '30' }, kState)).toMatchObject({ at: { tanHalf: '30deg' } });
  });
  it('looks for the path that was asked for', () => {
    const state = asAsked({ verb: 'path', from: '5,0,90deg', to: ['1,1,0', '2,2,0'], strict: true }, kState), start = { x: 5, y: 0, tanHalf: '90deg' };
    expect(state).toMatchObject({ start, at: start, goal: { x: 1, y: 1, tanHalf: '0' }, path: true, strict: true });
    expect(state).not.toHaveProperty('unplaced');
    expect(asAsked({ verb: 'path', from: '1,2,1.5', to: '1,-2,-1e-3' }, kState)).toMatchObject({ start: { tanHalf: '1.5rad' }, goal: { tanHalf: '-1e-3rad' }, strict: false });
  });
  it('is as it was for what it cannot read, and for other verbs', () => {
    expect(asAsked({ verb: 'path', from: '5,0', to: '1,1,0' }, kState)).toEqual(kState);
    expect(asAsked({ verb: 'cspace' }, kState)).toBe(kState);
  });
  it('keeps angles as they were written', () => {
    const asked = asAsked({ verb: 'path', from: '5,0,90deg', to: '1,1,0' }, kState);
    expect(parseObstacleState(JSON.parse(JSON.stringify(asked)))).toEqual(asked);
  });
});
