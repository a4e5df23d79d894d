// The page of sums as a command asks for it.
import { parseRational } from '../../numbers/rational';
import type { Parameters } from '../../shell/embedded';
import type { SumState } from './state';

/** The first scale of `--sweep A:B:STEP`, `--range A:B` or `--at s,s,...`. */
function firstScale({ sweep, range, at }: Parameters): string {
  const first = [sweep, range, at].flat().find((given) => typeof given === 'string');
  const scale = first?.split(/[:,]/)[0]?.trim() ?? '';
  return parseRational(scale) ? scale : '1';
}

/** `--move X,Y` of depth: where Q stands. */
function movedBy({ move }: Parameters): [number, number] {
  const numbers = typeof move === 'string' ? move.split(/[, ]+/).map(Number) : [];
  return numbers.length === 2 && numbers.every(Number.isFinite) ? [numbers[0]!, numbers[1]!] : [0, 0];
}

export function asAsked(parameters: Parameters, state: SumState): SumState {
  const moving = parameters.scaled === 'q' ? 'q' : 'p';
  switch (parameters.verb) {
    case 'scale':
      return { ...state, moving, motion: 'scale', scale: firstScale(parameters) };
    case 'rotate':
      return { ...state, moving: 'p', motion: 'turn' };
    case 'depth':
      return { ...state, atQ: movedBy(parameters) };
    default:
      return state;
  }
}
