import { shapeOfFile } from '../../engine/shape';
import { checkContents } from '../../operands/content';
import type { Page } from '../../shell/page';
import { kExamples } from './catalogue';
import { asAsked } from './command';
import { parseSolidsState, type SolidsPageState } from './state';
import { kSummary, View } from './view';

const kSolidFile = /\.(off|obj|stl|ply)$/i;

export const solidsPage: Page<SolidsPageState> = {
  id: 'solids',
  title: 'Solids',
  summary: kSummary,
  examples: kExamples,
  parse: parseSolidsState,
  /** One file is P, two are P and Q. */
  take: (files, state) => {
    const other = files.find((f) => !kSolidFile.test(f.name));
    if (other) throw new Error(`"${other.name}" holds no solid: this page takes .off, .obj, .stl and .ply.`);
    if (files.length > 2) throw new Error(`${files.length} files are too many: this page takes up to 2.`);
    checkContents(files);
    const [p, q] = files.map(shapeOfFile);
    return { ...state, p: p!, ...(q ? { q } : {}) };
  },
  command: asAsked,
  View,
};
