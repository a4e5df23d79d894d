// Families: all sums of the scales that the slider covers, and what lives how long in them. In the worker.
import type { Contact, Lifetime } from 'dymsum';
import type { Host } from '../../engine/host';
import type { PageFamily } from '../../engine/module';
import { keyOf } from '../../engine/shape';
import { parseRational, subtract } from '../../numbers/rational';
import { isUniform } from '../scale';
import type { Event, SumArgs } from './service';

export type Feature = Lifetime['feature'];
export const kFeatures = ['hole', 'edge', 'vertex'] as const satisfies readonly Feature[];

/** A feature of the sum, from one scale to another. */
export interface Life {
  feature: Feature;
  /** a vertex by its contacts, and the vertices that it is the sum of; an edge by its contact, which is both */
  in: Contact | null;
  out: Contact | null;
  cornerP: number | null;
  cornerQ: number | null;
  hole: number | null;
  from: number;
  to: number;
  /** of an end that is an event, exactly; nothing where the slider ends */
  born: string | null;
  died: string | null;
}

/** The lives of all features of a kind, of which some are listed: all, or the longest and the shortest. */
export interface LivesOfKind {
  count: number;
  longest: Life[];
  shortest: Life[];
}
export type Lives = Record<Feature, LivesOfKind>;

export const kMostLives = 20;

/** Whether a scale is larger than another one, exactly. */
export function isAfter(s: string, than: string): boolean {
  return subtract(parseRational(s)!, parseRational(than)!).n > 0n;
}

/** The one factor of a scale that both axes have. */
export const firstText = (scale: string): string => scale.split(':')[0]!.trim();

function keyOfFamily(a: SumArgs): string {
  return `family ${a.low} ${a.high} ${a.shown} ${a.semantics} ${a.moving} ${keyOf(a.p)} + ${keyOf(a.q)}`;
}

export function madeFamily(host: Host, a: SumArgs): PageFamily {
  const options = { moving: a.moving, reflectQ: a.shown === 'hits', semantics: a.semantics, progress: host.progress };
  return host.keep(keyOfFamily(a), () => host.dymsum.ScalingFamily.create(host.region(a.p), host.region(a.q), a.low, a.high, options));
}

/** The family that was made for these sums, where their scale is one of its own. */
export function familyOf(host: Host, a: SumArgs): PageFamily | undefined {
  if (a.motion !== 'scale' || a.shown === 'fit' || a.pull || !isUniform(a.scale)) return undefined;
  const s = firstText(a.scale), isOutside = isAfter(a.low, s) || isAfter(s, a.high);
  return isOutside ? undefined : host.ifKept<PageFamily>(keyOfFamily(a));
}

/** Lives by kind. Cell k lies between events k - 1 and k. */
export function livesOf(lifetimes: readonly Lifetime[], events: readonly Event[], low: number, high: number): Lives {
  const lives = lifetimes.map(({ firstCell, lastCell, ...name }): Life => {
    const begin = firstCell > 0 ? events[firstCell - 1] : undefined, end = events[lastCell];
    return { ...name, from: begin?.approx ?? low, to: end?.approx ?? high, born: begin?.s ?? null, died: end?.s ?? null };
  });
  const ofKind = (feature: Feature): LivesOfKind => {
    const all = lives.filter((life) => life.feature === feature).sort((a, b) => b.to - b.from - (a.to - a.from));
    return { count: all.length, longest: all.slice(0, kMostLives), shortest: all.slice(-kMostLives).reverse() };
  };
  return { hole: ofKind('hole'), edge: ofKind('edge'), vertex: ofKind('vertex') };
}

export interface FamilyAnswer {
  /** the visible ones */
  events: Event[];
  lives: Lives;
}

export const familyServices = {
  /** Makes the family of all scales of the slider. */
  sumFamily: (host: Host, a: SumArgs): FamilyAnswer => {
    const family = madeFamily(host, a), events = family.events();
    return { events: events.filter(({ visible }) => visible), lives: livesOf(family.lifetimes(), events, Number(a.low), Number(a.high)) };
  },
  /** The ring of the sum now that is a hole of the family, or -1. */
  ringOfHole: (host: Host, { hole, ...a }: SumArgs & { hole: number }): number => madeFamily(host, a).ringIds(firstText(a.scale)).indexOf(hole),
};
