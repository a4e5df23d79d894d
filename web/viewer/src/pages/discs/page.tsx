import { made } from '../../operands/catalogue';
import type { FileShape } from '../../engine/shape';
import { areAgain, planarShapes } from '../../operands/planar_files';
import type { Page } from '../../shell/page';
import { asAsked } from './command';
import { discState, parseDiscState, type DiscState } from './state';
import { kSummary, View } from './view';

export const discsPage: Page<DiscState> = {
  id: 'discs',
  title: 'Growing discs',
  summary: kSummary,
  examples: [
    { name: 'Comb', state: discState(made('comb'), { alpha: '0.5' }) },
    { name: 'Gear, cut', state: discState(made('gear'), { alpha: '0.4', cuts: true, persistence: '0.5' }) },
    { name: 'Plate with pockets, shrunk', state: discState(made('pockets'), { operation: 'eroded', alpha: '0.25' }) },
    { name: 'Noisy star', state: discState(made('noisy star'), { alpha: '0.1', cuts: true, persistence: '0.2' }) },
    { name: 'Random polygon, cut', state: discState(made('random'), { alpha: '0.2', cuts: true, persistence: '0.15' }) },
    { name: 'Spiral', state: discState(made('spiral'), { alpha: '1' }) },
  ],
  parse: parseDiscState,
  take: (files, state) => {
    const [shape] = planarShapes(files, 1) as [FileShape], { operation } = state;
    return areAgain([shape], [state.shape]) ? { ...state, shape } : discState(shape, { operation });
  },
  command: asAsked,
  View,
};
