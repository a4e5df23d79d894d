import { describe, expect, it } from 'vitest';
import { asAsked } from './command';
import { discState, parseDiscState } from './state';

const kState = discState({ name: 'p.wkt', text: '' });

describe('the page of growing discs', () => {
  it('shows bars and the bridges of one disc', () => {
    expect(asAsked({ verb: 'features', tau: '1/10', alpha: '1/5', concavity: 'hybrid2', 'hybrid-tolerance': '0.25' }, kState))
      .toMatchObject({ persistence: '1/10', alpha: '1/5', cuts: false, bridges: true, concavity: 'hybrid2', hybridTolerance: 0.25 });
    expect(asAsked({ verb: 'features' }, kState)).toMatchObject({ persistence: '0', alpha: '0', concavity: 'straight_line' });
  });
  it('cuts', () => {
    expect(asAsked({ verb: 'decompose', tau: '0.5', 'alpha-from': '1/4', 'alpha-to': '2', concavity: 'shortest' }, kState))
      .toMatchObject({ persistence: '0.5', cuts: true, alphaFrom: '1/4', alphaTo: '2', concavity: 'shortest_path' });
  });
  it('grows, shrinks, opens and closes by a radius: half the diameter', () => {
    expect(asAsked({ verb: 'disc', radius: '3/2' }, kState)).toMatchObject({ operation: 'sum', alpha: '3', semantics: 'closed', event: null });
    expect(asAsked({ verb: 'disc', radius: '0.4', set: 'erosion', semantics: 'open' }, kState)).toMatchObject({ operation: 'eroded', alpha: '4/5', semantics: 'open' });
    expect(['opening', 'closing'].map((set) => asAsked({ verb: 'disc', radius: '1', set }, kState).operation)).toEqual(['opened', 'closed']);
    expect(asAsked({ verb: 'disc', radius: 'event:3' }, kState)).toMatchObject({ event: 3 });
  });
  it('is as it was for other verbs', () => expect(asAsked({ verb: 'view' }, kState)).toBe(kState));
  it('reads its states back', () => {
    const state = asAsked({ verb: 'decompose', tau: '0.5', 'alpha-from': '1/4', 'alpha-to': '2', concavity: 'hybrid1' }, kState);
    expect(parseDiscState(JSON.parse(JSON.stringify(state)))).toEqual(state);
    expect(parseDiscState({ shape: kState.shape, operation: 'eroded' })).toMatchObject({ semantics: 'closed', alphaTo: '' });
  });
});
