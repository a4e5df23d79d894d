import { made } from '../../operands/catalogue';
import { planarShapes } from '../../operands/planar_files';
import type { Page } from '../../shell/page';
import { asAsked } from './command';
import { parseSumState, sumState, type SumPageState } from './state';
import { kSummary, View } from './view';

export const sumPage: Page<SumPageState> = {
  id: 'sum',
  title: 'Sum',
  summary: kSummary,
  examples: [
    { name: 'Gear and star', state: sumState(made('gear'), made('star')) },
    { name: 'Grate and disc', state: sumState(made('grate'), { name: 'disc', make: 'disc', args: [32, 0.35] }, { moving: 'q' }) },
    { name: 'A bar that fits exactly: comb', state: sumState({ name: 'comb', make: 'comb', args: [6, 2, 1, 5] }, { name: 'square', make: 'rectangle', args: [-0.5, -0.5, 0.5, 0.5] }, { moving: 'q' }) },
    { name: 'Spiral and L', state: sumState(made('spiral'), { name: 'L', make: 'letterL', args: [1, 1.5, 0.25] }, { moving: 'q', motion: 'turn' }) },
    { name: 'U and U', state: sumState(made('U'), { name: 'U', make: 'letterU', args: [1.5, 2, 0.5] }, { moving: 'q' }) },
    { name: 'Random polygons', state: sumState(made('random'), { name: 'noisy star', make: 'noisyStar', args: [30, 0.6, 7] }, { moving: 'q' }) },
  ],
  parse: parseSumState,
  /** One file is P, two are P and Q. */
  take: (files, state) => {
    const [p, q] = planarShapes(files, 2);
    return { ...state, p: p!, ...(q ? { q } : {}) };
  },
  command: asAsked,
  View,
};
