import { made } from '../../operands/catalogue';
import { areAgain, planarShapes } from '../../operands/planar_files';
import type { Shape } from '../../engine/shape';
import type { Page } from '../../shell/page';
import { parseSemantics, textOf } from '../options';
import { kFree, parseNestingState, placeBesideAnother, withParts, type NestingState } from './state';
import { kSummary, View } from './view';

const start = (a: Shape, b: Shape, x: number, y: number): NestingState => ({ a, b, parts: [], semantics: 'open', at: { kind: 'free', x, y } });
const kMostParts = 1000;
const tooth: Shape = { name: 'tooth', make: 'rectangle', args: [0, 0, 1, 3] };

export const nestingPage: Page<NestingState> = {
  id: 'nesting',
  title: 'Nesting',
  summary: kSummary,
  examples: [
    { name: 'A tooth between the teeth of a comb', state: start(made('comb'), tooth, 13.5, 3) },
    { name: 'U and L', state: start(made('U'), { name: 'L', make: 'letterL', args: [2, 3, 0.75] }, 5, 1) },
    { name: 'Gear and gear', state: start(made('gear'), made('gear'), 8.5, 0) },
    { name: 'A slot that fits exactly', state: start(made('U'), { name: 'peg', make: 'rectangle', args: [0, 0, 2, 2] }, 5, 3) },
    { name: 'Star and noisy star', state: start(made('star'), made('noisy star'), 2.5, 0) },
  ],
  parse: parseNestingState,
  /** One file is A, or holds all parts; two are A and B; of more each may be either. */
  take: (files, state) => {
    const shapes = planarShapes(files, kMostParts);
    if (shapes.length === 1) return { ...state, unopened: shapes[0]! };
    const stays = areAgain(shapes, state.parts.length > 0 ? state.parts : [state.a, state.b]);
    return withParts(state, shapes, stays ? placeBesideAnother(state.at) : kFree);
  },
  command: (parameters, state) => (parameters.verb === 'nfp' ? { ...state, semantics: parseSemantics(textOf(parameters, 'semantics'), 'closed') } : state),
  View,
};
