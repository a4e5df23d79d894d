// Families in the worker: what lives how long, and that frames come of them.
import type { Contact, Lifetime, ScalingFamily } from 'dymsum';
import { describe, expect, it } from 'vitest';
import { Host } from '../../engine/host';
import type { PageModule } from '../../engine/module';
import { isAfter, kMostLives, livesOf } from './families';
import { sumServices, type Event, type SumArgs } from './service';

const contact = (p: number): Contact => ({ kind: 'edge_of_p', p, q: 0 });
const edge = (p: number, firstCell: number, lastCell: number): Lifetime => ({ feature: 'edge', in: contact(p), out: contact(p), cornerP: null, cornerQ: null, hole: null, firstCell, lastCell });
const hole = (id: number, firstCell: number, lastCell: number): Lifetime => ({ feature: 'hole', in: null, out: null, cornerP: null, cornerQ: null, hole: id, firstCell, lastCell });
const event = (s: string, approx: number, visible = true): Event => ({ s, approx, visible, topology: false });

describe('lives', () => {
  const events = [event('1/2', 0.5), event('1/1', 1, false), event('4/3', 4 / 3)];
  it('reach from event to event, or to the ends of the slider', () => {
    const { hole: holes, edge: edges, vertex } = livesOf([hole(7, 0, 3), edge(1, 0, 0), edge(2, 1, 2), edge(3, 3, 3)], events, 0.05, 4);
    expect(holes).toMatchObject({ count: 1, longest: [{ hole: 7, from: 0.05, to: 4, born: null, died: null }] });
    expect(edges.longest.map(({ out, from, to, born, died }) => [out!.p, from, to, born, died])).toEqual([
      [3, 4 / 3, 4, '4/3', null],
      [2, 0.5, 4 / 3, '1/2', '4/3'],
      [1, 0.05, 0.5, null, '1/2'],
    ]);
    expect(edges.shortest.map(({ out }) => out!.p)).toEqual([1, 2, 3]);
    expect(vertex).toEqual({ count: 0, longest: [], shortest: [] });
  });
  it('are counted where they are too many to be shown', () => {
    const many = Array.from({ length: 3 * kMostLives }, (_, k) => event(`${k + 1}/1`, k + 1));
    const { edge: edges } = livesOf(many.map((_, k) => edge(k, 0, k)), many, 0, 1000);
    expect([edges.count, edges.longest.length, edges.shortest.length]).toEqual([3 * kMostLives, kMostLives, kMostLives]);
    expect([edges.longest[0]!.out!.p, edges.longest.at(-1)!.out!.p]).toEqual([3 * kMostLives - 1, 2 * kMostLives]);
    expect(edges.shortest.map(({ out }) => out!.p)).toEqual(Array.from({ length: kMostLives }, (_, k) => k));
  });
  it('compares scales exactly', () => {
    expect([isAfter('1/3', '0.333333333333333333333'), isAfter('0.333333333333333333333', '1/3'), isAfter('2/2', '1')]).toEqual([true, false, false]);
  });
});

/** A module whose families record what they are asked. */
function recording(): { host: Host; asked: string[] } {
  const asked: string[] = [];
  const object = (name: string) => ({ shape: () => ({ name }), areaText: () => '1', areaExact: () => null, dispose: () => void asked.push(`dispose ${name}`) });
  const family: Partial<ScalingFamily> = {
    at: (s) => {
      asked.push(`family at ${String(s)}`);
      return object(`sum at ${String(s)}`) as never;
    },
    events: () => [event('1/2', 0.5), event('3/2', 1.5), event('2/1', 2, false)] as never,
    changes: (from, to) => (asked.push(`changes ${String(from)} ${String(to)}`), [event('3/2', 1.5), event('3/1', 3)] as never),
    lifetimes: () => [hole(7, 0, 1)],
    ringIds: () => Float64Array.of(4, 7),
    dispose: () => undefined,
  };
  const moving = (name: string) => ({ create: () => ({ ...object(name), set: (s: string) => void asked.push(`${name} at ${s}`), sum: () => object(`${name}'s sum`), nextEvent: () => null }) });
  const dymsum = {
    shapes: {}, Region: { read: (name: string) => object(name) }, minkowskiSum: () => object('still'),
    ScalingSum: moving('ScalingSum'), RotatingSum: moving('RotatingSum'),
    ScalingFamily: { create: (_p: unknown, _q: unknown, low: string, high: string) => (asked.push(`make ${low} ${high}`), family) },
  };
  return { host: new Host(dymsum as unknown as PageModule, () => true), asked };
}

const shape = (name: string) => ({ name, text: name });
const kArgs: SumArgs = { p: shape('a.wkt'), q: shape('b.wkt'), shown: 'sum', semantics: 'closed', moving: 'p', motion: 'scale', scale: '3/4', tanHalf: '0', low: '0.05', high: '4' };

describe('frames', () => {
  it('come of the family once it is made, and only of scales and operands that are its own', () => {
    const { host, asked } = recording(), at = (changes: Partial<SumArgs>): string[] => {
      asked.length = 0;
      sumServices.sumFrame(host, { ...kArgs, ...changes });
      return asked.filter((text) => !text.startsWith('dispose'));
    };
    expect(at({})).toEqual(['ScalingSum at 3/4']);
    const { events, lives } = sumServices.sumFamily(host, kArgs);
    expect([events.map(({ s }) => s), lives.hole.count]).toEqual([['1/2', '3/2'], 1]);
    expect(at({})).toEqual(['family at 3/4']);
    expect(asked).toContain('dispose sum at 3/4');
    expect(at({ scale: '5/4: 1.25' })).toEqual(['family at 5/4']);
    expect(at({ scale: '4' })).toEqual(['family at 4']);
    expect(at({ scale: '0.05' })).toEqual(['family at 0.05']);
    expect(at({ scale: '1' })).toEqual(['family at 1']);
    expect(at({ scale: '4.000000000000000000001' })).toEqual(['ScalingSum at 4000000000000000000001/1000000000000000000000']);
    expect(at({ scale: '3/4:1' })).toEqual(['ScalingSum at 3/4']);
    expect(at({ motion: 'turn', tanHalf: '1/2' })).not.toContain('family at 3/4');
    for (const other of [{ moving: 'q' }, { semantics: 'open' }, { low: '0.1' }, { high: '5' }, { q: shape('c.wkt') }] as const) expect(at(other)).toEqual(['ScalingSum at 3/4']);
    sumServices.sumFamily(host, kArgs);
    expect(asked).toEqual(['ScalingSum at 3/4']); // it was kept
  });
  it('answer for the ring of a hole and the next event, whether the family was made before or not', () => {
    const { host, asked } = recording();
    expect(sumServices.nextScaleEvent(host, { ...kArgs, after: '3/2' })).toBeNull(); // ScalingSum's answer here
    expect(sumServices.ringOfHole(host, { ...kArgs, hole: 7 })).toBe(1);
    expect(sumServices.ringOfHole(host, { ...kArgs, hole: 9 })).toBe(-1);
    expect(asked.filter((text) => text.startsWith('make'))).toEqual(['make 0.05 4']);
    expect(sumServices.nextScaleEvent(host, { ...kArgs, after: '1.5' })).toMatchObject({ s: '3/1' });
    expect(sumServices.nextScaleEvent(host, { ...kArgs, after: '7/5' })).toMatchObject({ s: '3/2' });
    expect(asked).toContain('changes 7/5 4');
  });
});
