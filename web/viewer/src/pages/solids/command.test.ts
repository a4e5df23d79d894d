import { describe, expect, it } from 'vitest';
import type { Parameters } from '../../shell/embedded';
import { asAsked } from './command';
import { parseSolidsState, solidsState, withSet } from './state';

const kState = solidsState({ name: 'p.off', text: '' }, { name: 'q.off', text: '' }, { angle: 20, at: [1, 2, 3], slice: 4 });
const asked = (parameters: Parameters) => asAsked(parameters, kState, 2);

describe('the page of solids', () => {
  it('has solids where their files say', () => {
    expect(asked({ verb: 'sum', semantics: 'regular', thin: true })).toMatchObject({ angle: 0, at: [0, 0, 0], slice: null, semantics: 'regular', thin: true });
  });
  it('scales P, or Q, by a factor for each axis', () => {
    expect(asked({ verb: 'scale', at: '1:1:2,3:1/2:1' })).toMatchObject({ moving: 'p', scale: '1:1:2', range: [1, 3], sum: 'sum' });
    expect(asked({ verb: 'scale', sweep: '1/2:4:10%', scaled: 'q', robot: true })).toMatchObject({ moving: 'q', scale: '1/2', range: [0.5, 4], sum: 'hits' });
  });
  it('turns P about any axis, from the frame that was asked for', () => {
    expect(asked({ verb: 'rotate', steps: '120', axis: '1,2,-0.5' })).toMatchObject({ moving: 'p', axis: [1, 2, -0.5], angle: 0 });
    expect(asked({ verb: 'rotate', steps: '12', frame: '4' })).toMatchObject({ axis: [0, 0, 1], angle: 120 });
    expect(asked({ verb: 'rotate', steps: '4', degrees: '-90', frame: '2' })).toMatchObject({ angle: -45 });
    expect((asked({ verb: 'rotate', steps: '4', frame: '3' }) as { angle: number }).angle).toBeCloseTo(-90, 12);
    expect(asked({ verb: 'rotate', events: true, range: '30deg:45deg' })).toMatchObject({ angle: 30 });
  });
  it('shows how deep Q is where it is moved, P turned first', () => {
    expect(asked({ verb: 'depth', move: '0.5,0,0', axis: '0,0,1', degrees: '30' })).toMatchObject({ sum: 'hits', semantics: 'open', at: [0.5, 0, 0], moving: 'p', angle: 30 });
  });
  it('cuts, and looks at a part', () => {
    expect(asked({ verb: 'slice', z: '1.5', reflect: true })).toMatchObject({ slice: 1.5, sum: 'hits' });
    expect(asked({ verb: 'local-sum', ball: '2,0,1,0.5' })).toMatchObject({ look: [1.5, -0.5, 0.5, 2.5, 0.5, 1.5] });
    expect(asked({ verb: 'local-sum', box: '0,0,0,1,2,3' })).toMatchObject({ look: [0, 0, 0, 1, 2, 3] });
  });
  it('shows where Q hits, and where it fits', () => {
    expect(asked({ verb: 'nfp', semantics: 'open' })).toMatchObject({ sum: 'hits', semantics: 'open', angle: 0 });
    expect(asked({ verb: 'nfp' })).toMatchObject({ sum: 'hits', semantics: 'closed' });
    expect(asked({ verb: 'erode' })).toMatchObject({ sum: 'fit', semantics: 'closed', angle: 0, scale: '1' });
  });
  it('refuses what cannot be drawn', () => {
    expect(() => asked({ verb: 'scale', at: '1e400' })).toThrow('cannot compute with');
    expect(() => asked({ verb: 'depth', move: '1e308,0,0' })).toThrow('cannot compute with 1e+308');
    expect(asked({ verb: 'slice', z: 'x' })).toMatchObject({ slice: null });
  });
  it('shows one solid alone', () => expect(asAsked({ verb: 'hull' }, kState, 1)).toMatchObject({ p: kState.p, q: null }));
});

describe('states of solids', () => {
  const again = (value: unknown): unknown => JSON.parse(JSON.stringify(value));
  it('are read back', () => {
    const state = solidsState(kState.p, kState.q, { axis: [3, -1, 0.5], moving: 'p', scale: '2:1:1/2', range: [1, 8], look: [0, 0, 0, 1, 1, 1], thin: true, semantics: 'regular' });
    expect(parseSolidsState(again(state))).toEqual(state);
    expect(parseSolidsState(again({ ...state, q: null }))).toEqual({ ...state, q: null });
  });
  it('hold only what can be drawn', () => {
    const { p, q } = kState;
    for (const wild of [{ scale: '1:2:1e400' }, { at: [0, 1e308, 0] }, { at: [0, Infinity, 0] }, { axis: [1e200, 0, 0] }, { slice: 1e308 }, { range: [1, 1e300] }, { look: [0, 0, 0, 1, 1, 1e-300] }])
      expect(() => parseSolidsState({ p, q, ...wild })).toThrow('cannot compute with');
    expect(parseSolidsState({ p, q, scale: 'x', at: [0, null, 0], angle: 1e300, slice: NaN })).toEqual(solidsState(p, q));
    expect(parseSolidsState({ p, q, scale: '1e15', at: [0, -1e100, 1e-100] })).toMatchObject({ scale: '1e15', at: [0, -1e100, 1e-100] });
  });
  it('of inner fits do not turn', () => {
    const { p, q } = kState, fit = withSet(solidsState(p, q, { angle: 20, scale: '3/2', semantics: 'open' }), 'fit');
    expect(fit).toMatchObject({ sum: 'fit', angle: 0, scale: '3/2', semantics: 'closed' });
    expect(parseSolidsState(again(fit))).toEqual(fit);
    expect(parseSolidsState(again({ ...fit, angle: 30 }))).toEqual(fit);
  });
  it('of older pages name their axis, and hits are open', () => {
    const { p, q } = kState;
    expect(parseSolidsState({ p, q, axis: 'y', sum: 'hits' })).toMatchObject({ axis: [0, 1, 0], semantics: 'open', moving: 'q' });
    expect(parseSolidsState({ p, q, axis: 'skew' })).toMatchObject({ axis: [1, 2, 3], semantics: 'closed' });
    expect(parseSolidsState({ p, q, axis: [0, 0, 0] })).toMatchObject({ axis: [1, 2, 3] });
  });
});
