import { describe, expect, it } from 'vitest';
import { asAsked } from './command';
import { sumState } from './state';

const kState = sumState({ name: 'p.wkt', text: '' }, { name: 'q.wkt', text: '' });

describe('the page of sums', () => {
  it('begins at the first scale that was asked for', () => {
    expect(asAsked({ verb: 'scale', sweep: '1/2:2:1%', scaled: 'q' }, kState)).toMatchObject({ motion: 'scale', moving: 'q', scale: '1/2' });
    expect(asAsked({ verb: 'scale', at: ['3/2,2', '5'] }, kState)).toMatchObject({ moving: 'p', scale: '3/2' });
    expect(asAsked({ verb: 'scale', range: '0.25:1' }, kState)).toMatchObject({ scale: '0.25' });
  });
  it('turns where a turn was asked for', () => expect(asAsked({ verb: 'rotate', steps: '4' }, kState)).toMatchObject({ motion: 'turn', moving: 'p' }));
  it('has Q where depth moves it', () => {
    expect(asAsked({ verb: 'depth', move: '0.5,-1' }, kState).atQ).toEqual([0.5, -1]);
    expect(asAsked({ verb: 'depth' }, kState).atQ).toEqual([0, 0]);
  });
  it('is as it was for other verbs', () => expect(asAsked({ verb: 'sum', semantics: 'open' }, kState)).toBe(kState));
});
