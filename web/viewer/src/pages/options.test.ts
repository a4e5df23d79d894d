import { describe, expect, it } from 'vitest';
import { angleOption, numbersOf, scalesOf, textOf } from './options';

describe('options of commands', () => {
  it('are texts, of repeated ones the first', () => {
    expect([textOf({ at: ['1,2', '3'] }, 'at'), textOf({ robot: true }, 'robot'), textOf({}, 'x')]).toEqual(['1,2', undefined, undefined]);
  });
  it('hold numbers', () => {
    expect([numbersOf('1,2,-3e2', 3), numbersOf('1 2', 2)]).toEqual([[1, 2, -300], [1, 2]]);
    expect([numbersOf('1,2', 3), numbersOf('1,x', 2), numbersOf('', 1), numbersOf(undefined, 1)]).toEqual(Array(4).fill(undefined));
  });
  it('name angles in radians, degrees and tangents', () => {
    expect([{ angle: '0.8' }, { angle: '90deg' }, { degrees: '45' }, { 'tan-half': '1/3' }, { 'tan-half': 'inf' }, { angle: 'x' }, {}].map(angleOption))
      .toEqual(['0.8rad', '90deg', '45deg', '1/3', 'inf', undefined, undefined]);
  });
  it('name scales', () => {
    expect(scalesOf({ sweep: '1/2:2:1%' })).toEqual({ scale: '1/2', range: [0.5, 2] });
    expect(scalesOf({ at: ['3/2,2', '5'] })).toEqual({ scale: '3/2', range: [1.5, 5] });
    expect(scalesOf({ range: '1:0.25' })).toEqual({ scale: '1', range: [0.25, 1] });
    expect(scalesOf({ sweep: '2:4:1', ratio: '2/3' })).toEqual({ scale: '2:4/3', range: [2, 4] });
    expect(scalesOf({ at: '2:1:1/2,3:1:1' })).toEqual({ scale: '2:1:1/2', range: [2, 3] });
    expect([scalesOf({ sweep: 'x' }), scalesOf({})]).toEqual([{ scale: '1' }, { scale: '1' }]);
  });
});
