// The scales at which the sum changes.
import { useState } from 'preact/hooks';
import type { Tick } from '../../shell/controls';
import type { Shell } from '../../shell/page';
import type { Event, SumArgs } from './service';
import { scaleRange } from './tools';
import type { SumState } from './state';

export interface Events {
  ticks: readonly Tick[] | undefined;
  find: () => void;
  /** the next visible event above the scale, or nothing */
  next: () => Promise<Event | null>;
}

function sameOperands(a: SumArgs, b: SumArgs): boolean {
  return a.p === b.p && a.q === b.q && a.moving === b.moving && a.shown === b.shown && a.semantics === b.semantics;
}

function tickOf({ s, approx, topology }: Event): Tick {
  return { at: approx, strong: topology, label: s };
}

export function useEvents(shell: Shell, state: SumState, args: SumArgs): Events {
  const [found, setFound] = useState<{ args: SumArgs; ticks: Tick[] } | undefined>();
  const [from, to] = scaleRange(state).map(String) as [string, string];
  const find = async (): Promise<void> => {
    const all = await shell.engine.ask('scaleEvents', { ...args, from, to });
    setFound({ args, ticks: all.filter((e) => e.visible).map(tickOf) });
  };
  return {
    ticks: found && sameOperands(found.args, args) ? found.ticks : undefined,
    find: () => void find().catch(shell.report),
    next: () => shell.engine.ask('nextScaleEvent', { ...args, after: args.scale, limit: to }),
  };
}
