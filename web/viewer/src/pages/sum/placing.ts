// How operands and sum stand in the picture.
import { placed, type Affine } from '../../view2d/affine';
import { toNumber } from '../../numbers/rational';
import { radiansOf } from '../angle';
import { factorsOf } from '../scale';
import type { SumState, Which } from './state';

export function placing(state: SumState, which: Which): Affine {
  const [x, y] = which === 'p' ? state.atP : state.atQ;
  if (state.moving !== which) return placed(1, 0, x, y);
  if (state.motion === 'turn') return placed(1, radiansOf(state.tanHalf), x, y);
  const [sx, sy] = factorsOf(state.scale, 2)!.map(toNumber) as [number, number];
  return { a: sx, b: 0, c: 0, d: sy, e: x, f: y };
}

/** What moves the sum: both operands; places of Q only with P. */
export function sumMoves({ shown, atP, atQ }: Pick<SumState, 'shown' | 'atP' | 'atQ'>): (readonly [number, number])[] {
  return shown === 'sum' ? [atP, atQ] : [atP];
}

export function sumPlacing(state: SumState): Affine {
  const moves = sumMoves(state);
  return placed(1, 0, moves.reduce((s, [x]) => s + x, 0), moves.reduce((s, [, y]) => s + y, 0));
}
