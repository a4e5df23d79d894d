// What the pointer is at, and what was picked with it.
import { useEffect, useRef, useState } from 'preact/hooks';
import { add, fromDouble, parseRational, toText } from '../../numbers/rational';
import type { Shell } from '../../shell/page';
import { copy } from '../../shell/save';
import type { Nearest } from '../../view2d/edge_grid';
import type { SumPicture } from '../../view2d/sum_shape';
import { sumMoves } from './placing';
import { originText } from './provenance';
import { positionText, wordingOf, type Picked } from './result_section';
import type { SumArgs } from './service';
import type { SumState } from './state';

/** A place of a sum; of another sum it says nothing. */
interface Pointed {
  place: Nearest;
  sum: SumPicture;
}

export interface Pointing {
  hovered: Nearest | undefined;
  hover: (place: Nearest | undefined) => void;
  /** the place that was clicked, and what is known of it */
  chosen: Nearest | undefined;
  picked: Picked | undefined;
  pick: (place: Nearest | undefined) => void;
}

/** Exact positions of a place, with the moves of P and Q. */
async function exactPlace({ engine }: Shell, args: SumArgs, state: SumState, { place, sum }: Pointed): Promise<Picked> {
  const vertices = place.kind === 'vertex' ? [place.index] : [place.index, place.next];
  const exact = await engine.ask('sumExact', { ...args, vertices });
  const moved = (text: string, k: 0 | 1): string => toText(sumMoves(state).reduce((at, by) => add(at, fromDouble(by[k])), parseRational(text)!));
  return { origin: originText(sum.shape, place, wordingOf(state)), positions: exact.map(({ x, y }) => ({ x: moved(x, 0), y: moved(y, 1) })) };
}

function usePlace(sum: SumPicture | undefined): [Nearest | undefined, (place: Nearest | undefined) => void] {
  const [pointed, setPointed] = useState<Pointed | undefined>();
  const now = pointed?.sum === sum ? pointed?.place : undefined;
  const set = (place: Nearest | undefined): void => {
    if (place?.index !== now?.index || place?.kind !== now?.kind) setPointed(place && sum && { place, sum });
  };
  return [now, set];
}

export function usePointing(shell: Shell, state: SumState, args: SumArgs, sum: SumPicture | undefined): Pointing {
  const [hovered, hover] = usePlace(sum);
  const [chosen, choose] = usePlace(sum);
  const [picked, setPicked] = useState<Picked | undefined>();
  const newest = useRef(0);
  const forget = (): void => {
    ++newest.current;
    setPicked(undefined);
  };
  useEffect(() => {
    forget();
    choose(undefined);
  }, [sum, state.atP, state.atQ]); // eslint-disable-line react-hooks/exhaustive-deps -- only where the sum is another, or elsewhere
  const pickNow = async (place: Nearest | undefined): Promise<void> => {
    choose(place);
    forget();
    if (!place || !sum) return;
    const pick = newest.current, exact = await exactPlace(shell, args, state, { place, sum });
    if (pick !== newest.current) return; // moved meanwhile
    setPicked(exact);
    await copy(exact.positions.map(positionText).join(' '));
    shell.announce('The exact position is copied.');
  };
  return { hovered, hover, chosen, picked, pick: (place) => void pickNow(place).catch(shell.report) };
}
