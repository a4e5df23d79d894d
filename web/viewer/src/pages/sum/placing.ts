// How operands and sum stand in the picture.
import { parseRational, toNumber } from '../../numbers/rational';
import { placed, type Affine } from '../../view2d/affine';
import type { SumState, Which } from './state';

export function scaleOf(state: SumState): number {
  const exact = parseRational(state.scale);
  return exact ? toNumber(exact) : 1;
}

export function radiansOf(tanHalf: string): number {
  const exact = parseRational(tanHalf);
  return tanHalf === 'inf' ? Math.PI : 2 * Math.atan(exact ? toNumber(exact) : 0);
}

export function placing(state: SumState, which: Which): Affine {
  const [x, y] = which === 'p' ? state.atP : state.atQ;
  if (state.moving !== which) return placed(1, 0, x, y);
  return state.motion === 'scale' ? placed(scaleOf(state), 0, x, y) : placed(1, radiansOf(state.tanHalf), x, y);
}

export function sumPlacing({ atP, atQ }: SumState): Affine {
  return placed(1, 0, atP[0] + atQ[0], atP[1] + atQ[1]);
}
