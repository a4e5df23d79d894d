import { describe, expect, it } from 'vitest';
import type { Parameters } from '../../shell/embedded';
import { asAsked } from './command';
import { sumState } from './state';

const kState = sumState({ name: 'p.wkt', text: '' }, { name: 'q.wkt', text: '' });
const asked = (parameters: Parameters) => asAsked(parameters, kState, 2);

describe('the page of sums', () => {
  it('begins at the first scale that was asked for, with a slider for all', () => {
    expect(asked({ verb: 'scale', sweep: '1/2:8:1%', scaled: 'q' })).toMatchObject({ motion: 'scale', moving: 'q', scale: '1/2', range: [0.5, 8], shown: 'sum' });
    expect(asked({ verb: 'scale', at: ['3/2,2', '5'], robot: true })).toMatchObject({ moving: 'p', scale: '3/2', range: [1.5, 5], shown: 'hits' });
    expect(asked({ verb: 'scale', sweep: '1:2:1%', ratio: '2/3' })).toMatchObject({ scale: '1:2/3' });
  });
  it('turns from no turn on', () => {
    expect(asked({ verb: 'rotate', steps: '4' })).toMatchObject({ motion: 'turn', moving: 'p', tanHalf: '0' });
    expect(asked({ verb: 'rotate', steps: '6', angle: '-90deg' })).toMatchObject({ tanHalf: '0', range: [-Math.PI / 2, 0] });
    expect(asked({ verb: 'rotate', steps: '6', degrees: '270' })).not.toHaveProperty('range');
  });
  it('shows the inner fit of erode', () => expect(asked({ verb: 'erode', semantics: 'open' })).toMatchObject({ shown: 'fit', semantics: 'open', motion: 'scale' }));
  it('has Q where depth moves it, and where it hits', () => {
    expect(asked({ verb: 'depth', move: '0.5,-1' })).toMatchObject({ shown: 'hits', atQ: [0.5, -1] });
    expect(asked({ verb: 'depth' })).toMatchObject({ atQ: [0, 0] });
  });
  it('looks where local-sum looks', () => {
    expect(asked({ verb: 'local-sum', box: '0,1,2,3' })).toMatchObject({ look: [0, 1, 2, 3] });
    expect(asked({ verb: 'local-sum', disc: '0,3,1', degrees: '30' })).toMatchObject({ look: [-1, 2, 1, 4], motion: 'turn', tanHalf: '30deg' });
  });
  it('adds as it was told', () => {
    expect(asked({ verb: 'sum', semantics: 'regular' })).toEqual({ ...kState, semantics: 'regular' });
    expect(asked({ verb: 'view' })).toEqual(kState);
  });
  it('shows one shape alone', () => expect(asAsked({ verb: 'info' }, kState, 1)).toEqual({ ...kState, q: null }));
});
