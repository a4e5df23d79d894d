// Where a feature of a family is in a sum of it.
import type { Contact, SumShape } from 'dymsum';
import { short } from '../../numbers/display';
import type { Life } from './families';
import { arriving, corner, leaving, pairText, type Pair, type Wording } from './provenance';

/** Vertices, edges by their ends, and rings of a sum. */
export interface Alive {
  vertices: readonly number[];
  edges: readonly (readonly [number, number])[];
  ring: number | undefined;
}

export const kNotAlive: Alive = { vertices: [], edges: [], ring: undefined };

const pairOf = ({ kind, p, q }: Contact): Pair => ({ edgeOfP: kind === 'edge_of_p', p, q });
const samePair = (a: Pair, b: Pair): boolean => a.edgeOfP === b.edgeOfP && a.p === b.p && a.q === b.q;

/** The vertices and edges that are the feature: none while it is not there. Holes have no names in a sum. */
export function aliveIn(shape: SumShape, life: Life): Pick<Alive, 'vertices' | 'edges'> {
  const vertices: number[] = [], edges: [number, number][] = [], { ringStarts } = shape;
  if (!life.in || !life.out) return { vertices, edges };
  const into = pairOf(life.in), out = pairOf(life.out);
  for (let r = 0; r + 1 < ringStarts.length; ++r)
    for (let k = ringStarts[r]!; k < ringStarts[r + 1]!; ++k) {
      if (!samePair(leaving(shape, k), out)) continue;
      if (life.feature === 'edge') edges.push([k, k + 1 < ringStarts[r + 1]! ? k + 1 : ringStarts[r]!]);
      else if (samePair(arriving(shape, k), into) && corner(shape, k)?.p === (life.cornerP ?? undefined) && corner(shape, k)?.q === (life.cornerQ ?? undefined)) vertices.push(k);
    }
  return { vertices, edges };
}

function nameOf({ feature, in: into, out, cornerP, cornerQ }: Life, wording: Wording): string {
  const [p, q] = wording.names;
  if (!into || !out) return 'hole';
  if (feature === 'edge') return `edge: ${pairText(pairOf(out), wording)}`;
  if (cornerP !== null) return `vertex: vertex ${cornerP} of ${p} ${wording.between} vertex ${cornerQ} of ${q}`;
  return `vertex: crossing of ${pairText(pairOf(into), wording)} and ${pairText(pairOf(out), wording)}`;
}

const kMostDigits = 12; // of a fraction that is shown as it is

function endText(exact: string | null, near: number): string {
  return exact !== null && exact.length <= kMostDigits ? exact.replace(/\/1$/, '') : short(near);
}

/** "hole, from 1/2 to 2": what it is, and when it is there. */
export function lifeText(life: Life, wording: Wording): string {
  const { born, died } = life, from = endText(born, life.from), to = endText(died, life.to), name = nameOf(life, wording);
  if (born === null) return `${name}, ${died === null ? 'at all scales of the slider' : `up to ${to}`}`;
  return `${name}, from ${from} ${died === null ? 'on' : `to ${to}`}`;
}
