// The scales at which the sum changes, and what lives how long: of the family that "Find all" makes.
import { useState } from 'preact/hooks';
import type { Tick } from '../../shell/controls';
import type { Shell } from '../../shell/page';
import { firstText, type Lives } from './families';
import type { Event, SumArgs } from './service';

export interface Events {
  found: { ticks: readonly Tick[]; lives: Lives } | undefined;
  find: () => void;
  /** the next visible event above the scale, or nothing */
  next: () => Promise<Event | null>;
}

type Found = NonNullable<Events['found']> & { args: SumArgs };

function sameFamily(a: SumArgs, b: SumArgs): boolean {
  return a.p === b.p && a.q === b.q && a.moving === b.moving && a.shown === b.shown && a.semantics === b.semantics && a.low === b.low && a.high === b.high;
}

function tickOf({ s, approx, topology }: Event): Tick {
  return { at: approx, strong: topology, label: s };
}

export function useEvents(shell: Shell, args: SumArgs): Events {
  const [found, setFound] = useState<Found | undefined>();
  const find = async (): Promise<void> => {
    const { events, lives } = await shell.engine.ask('sumFamily', args);
    setFound({ args, ticks: events.map(tickOf), lives });
  };
  return {
    found: found && sameFamily(found.args, args) ? found : undefined,
    find: () => void find().catch(shell.report),
    next: () => shell.engine.ask('nextScaleEvent', { ...args, after: firstText(args.scale) }),
  };
}
