// The page of solids as a command asks for it.
import type { Parameters } from '../../shell/embedded';
import { radiansOf } from '../angle';
import { angleOption, angleText, numbersOf, parseSemantics, scalesOf, textOf } from '../options';
import { axisOf, kAxes, kSets, parseSolidsState, type SolidsPageState, type SolidsState, type Triple } from './state';

type Look = NonNullable<SolidsState['look']>;

function degreesOf(angle: string | undefined): number {
  const reduced = angle === undefined ? 0 : (radiansOf(angle) * 180) / Math.PI, written = parseFloat(angle ?? '0');
  return angle?.endsWith('deg') && Math.abs(written) <= 180 ? written : reduced; // written degrees stay what they are
}

/** P turns about `--axis`, by an angle where there is one. */
function turned(parameters: Parameters, angle = angleOption(parameters)): Partial<SolidsState> {
  return { moving: 'p', axis: axisOf(numbersOf(textOf(parameters, 'axis'), 3)) ?? kAxes.z, angle: degreesOf(angle) };
}

/** The angle of `--frame N` of `--steps`, from 0 unless told; of events where `--range FROM:TO` begins. */
function frameAngle(parameters: Parameters): string | undefined {
  const steps = Number(textOf(parameters, 'steps')), frame = Number(textOf(parameters, 'frame') ?? 0), whole = angleOption(parameters) ?? '360deg';
  if (!(steps > 0)) return angleText(textOf(parameters, 'range')?.split(':')[0]);
  return `${(parseFloat(whole) * frame) / steps}${whole.endsWith('deg') ? 'deg' : 'rad'}`;
}

/** `--box X,Y,Z,X,Y,Z` or `--ball X,Y,Z,R` of local-sum. */
function lookOf(parameters: Parameters): { look?: Look } {
  const box = numbersOf(textOf(parameters, 'box'), 6), [x, y, z, r] = numbersOf(textOf(parameters, 'ball'), 4) ?? [];
  if (box) return { look: box as unknown as Look };
  return r === undefined ? {} : { look: [x! - r, y! - r, z! - r, x! + r, y! + r, z! + r] };
}

function ofVerb(parameters: Parameters): Partial<SolidsState> {
  switch (parameters.verb) {
    case 'scale':
      return { moving: parameters.scaled === 'q' ? 'q' : 'p', ...scalesOf(parameters), sum: parameters.robot ? 'hits' : 'sum' };
    case 'rotate':
      return turned(parameters, frameAngle(parameters));
    case 'depth':
      return { ...turned(parameters), ...kSets.hits, at: (numbersOf(textOf(parameters, 'move'), 3) as Triple | undefined) ?? [0, 0, 0], through: true };
    case 'slice':
      return { slice: Number(textOf(parameters, 'z') ?? 0), sum: parameters.reflect ? 'hits' : 'sum' };
    case 'nfp':
      return { sum: 'hits' };
    case 'erode':
      return { sum: 'fit' };
    case 'local-sum':
      return { ...turned(parameters), ...lookOf(parameters) };
    default:
      return {};
  }
}

/** Throws an Error for numbers that the page cannot show. Solids stand as their files say, and the program's own defaults hold where an option was not given. */
export function asAsked(parameters: Parameters, state: SolidsPageState, inputs: number): SolidsPageState {
  const rest = { ...state };
  delete rest.range;
  delete rest.look;
  const start = { ...rest, ...kSets.sum, thin: parameters.thin === true, moving: 'q', axis: kAxes.z, angle: 0, scale: '1', at: [0, 0, 0], slice: null } as const;
  if (inputs === 1 || start.q === null) return { ...start, q: null };
  return parseSolidsState({ ...start, semantics: parseSemantics(textOf(parameters, 'semantics'), 'closed'), ...ofVerb(parameters), q: start.q });
}
