// The page of sums as a command asks for it.
import type { Parameters } from '../../shell/embedded';
import { angleOption, numbersOf, parseSemantics, scalesOf, textOf } from '../options';
import { checkSumScale, withShown, type SumPageState, type SumState } from './state';

type Look = NonNullable<SumState['look']>;

/** `--box X,Y,X,Y` or `--disc X,Y,R` of local-sum. */
function lookOf(parameters: Parameters): { look?: Look } {
  const box = numbersOf(textOf(parameters, 'box'), 4), [x, y, r] = numbersOf(textOf(parameters, 'disc'), 3) ?? [];
  if (box) return { look: box as unknown as Look };
  return r === undefined ? {} : { look: [x! - r, y! - r, x! + r, y! + r] };
}

/** The frames of `rotate` go from 0 to an angle; more than half a turn is what the slider covers anyway. */
function turnOf(parameters: Parameters): { range?: readonly [number, number] } {
  const text = angleOption(parameters) ?? '360deg';
  const way = text.endsWith('deg') ? (parseFloat(text) * Math.PI) / 180 : parseFloat(text);
  return Math.abs(way) < Math.PI ? { range: [Math.min(0, way), Math.max(0, way)] } : {};
}

/** Scales that can be drawn. */
function drawnScales(parameters: Parameters): Partial<SumState> {
  const asked = scalesOf(parameters);
  return checkSumScale(asked.scale) === undefined && (asked.range ?? []).every(Number.isFinite) ? asked : { scale: '1' };
}

function ofVerb(parameters: Parameters, state: SumState): SumState {
  const moving = parameters.scaled === 'q' ? 'q' : 'p';
  switch (parameters.verb) {
    case 'scale':
      return withShown({ ...state, moving, motion: 'scale', ...drawnScales(parameters) }, parameters.robot ? 'hits' : 'sum');
    case 'rotate':
      return { ...state, moving: 'p', motion: 'turn', ...turnOf(parameters) };
    case 'erode':
      return withShown(state, 'fit');
    case 'depth':
      return { ...withShown(state, 'hits'), atQ: (numbersOf(textOf(parameters, 'move'), 2) as [number, number] | undefined) ?? [0, 0] };
    case 'local-sum':
      return { ...state, moving: 'p', motion: 'turn', tanHalf: angleOption(parameters) ?? '0', ...lookOf(parameters) };
    default:
      return state;
  }
}

/** The program's own defaults hold where an option was not given. */
export function asAsked(parameters: Parameters, state: SumPageState, inputs: number): SumPageState {
  if (inputs === 1) return { ...state, q: null };
  if (state.q === null) return state;
  return ofVerb(parameters, { ...state, semantics: parseSemantics(textOf(parameters, 'semantics'), 'closed') });
}
