// The page of growing discs as a command asks for it.
import { multiply, parseRational, rational, toNumber, toText } from '../../numbers/rational';
import type { Parameters } from '../../shell/embedded';
import { parseSemantics, textOf } from '../options';
import { discState, isLength, type Concavity, type DiscState, type Operation } from './state';

const kSets: Record<string, Operation> = { sum: 'sum', erosion: 'eroded', opening: 'opened', closing: 'closed' };
const kConcavities: Record<string, Concavity> = { straight: 'straight_line', shortest: 'shortest_path', hybrid1: 'hybrid1', hybrid2: 'hybrid2' };

function lengthOf(parameters: Parameters, name: string, otherwise: string): string {
  const text = textOf(parameters, name);
  return text !== undefined && isLength(text) ? text : otherwise;
}

/** What `features` and `decompose` have in common. `--tau` is also called persistence. */
function featuresOf(parameters: Parameters): Partial<DiscState> {
  const tau = lengthOf(parameters, 'persistence', lengthOf(parameters, 'tau', '0')), alpha = lengthOf(parameters, 'alpha', '0');
  const concavity = kConcavities[textOf(parameters, 'concavity') ?? 'straight'] ?? 'straight_line', hybridTolerance = toNumber(parseRational(lengthOf(parameters, 'hybrid-tolerance', '0'))!);
  return { persistence: tau, alpha, alphaFrom: lengthOf(parameters, 'alpha-from', '0'), alphaTo: lengthOf(parameters, 'alpha-to', ''), concavity, hybridTolerance };
}

/** `--radius R`, or `event:K`: the page then finds the diameter. */
function radiusOf(text = ''): Pick<DiscState, 'alpha' | 'event'> {
  const event = /^event:(\d+)$/.exec(text)?.[1];
  if (event !== undefined) return { event: Number(event), alpha: '0' };
  return { event: null, alpha: isLength(text) ? toText(multiply(parseRational(text)!, rational(2n))) : '0' };
}

export function asAsked(parameters: Parameters, state: DiscState): DiscState {
  const { shape } = state;
  switch (parameters.verb) {
    case 'features':
      return discState(shape, featuresOf(parameters));
    case 'decompose':
      return discState(shape, { ...featuresOf(parameters), cuts: true, bridges: false });
    case 'disc': {
      const operation = kSets[textOf(parameters, 'set') ?? 'sum'] ?? 'sum';
      return discState(shape, { operation, ...radiusOf(textOf(parameters, 'radius')), semantics: parseSemantics(textOf(parameters, 'semantics'), 'closed'), bridges: false });
    }
    default:
      return state;
  }
}
