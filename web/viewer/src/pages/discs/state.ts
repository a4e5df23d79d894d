// What the page of growing discs shows.
import type { FeatureOptions, Semantics } from 'dymsum';
import { parseShape, type Shape } from '../../engine/shape';
import type { Option } from '../../shell/controls';
import { checkSize, parseRational } from '../../numbers/rational';
import type { Camera } from '../../view2d/camera';
import { parseSemantics } from '../options';
import { parseCamera } from '../sum/state';

export const kOperations = [
  ['sum', 'Grown', 'The sum with the disc: all that the disc covers while its centre stays in the shape.'],
  ['closed', 'Gaps filled', 'Grown, then shrunk (a closing): what discs outside of the shape do not reach.'],
  ['eroded', 'Shrunk', 'Where the centre of a disc can stand that stays in the shape (an erosion).'],
  ['opened', 'Tips cut', 'Shrunk, then grown (an opening): what discs inside of the shape cover.'],
] as const;
export type Operation = (typeof kOperations)[number][0];

/** How deep the deepest vertex of a pocket lies. */
export const kConcavities = [
  ['straight_line', 'Line', 'A pocket is as deep as its deepest vertex is far from the straight line over its mouth.'],
  ['shortest_path', 'Path', 'A pocket is as deep as the way from its deepest vertex out to its mouth is long.'],
  ['hybrid1', 'Hybrid 1', 'By the path where an edge of the pocket runs backwards along its mouth, else by the line.'],
  ['hybrid2', 'Hybrid 2', 'By the line where that is more than a limit, else by the path.'],
] as const satisfies readonly Option<NonNullable<FeatureOptions['concavity']>>[];
export type Concavity = (typeof kConcavities)[number][0];

export interface DiscState {
  shape: Shape;
  operation: Operation;
  semantics: Semantics;
  /** the diameter, an exact number as text */
  alpha: string;
  /** with this the diameter is exactly the one of an event, and `alpha` near it */
  event: number | null;
  /** the bar that is looked at */
  bar: number | null;
  bridges: boolean;
  cuts: boolean;
  /** bars that last at least so long, and whose pockets are as deep, are cut at */
  persistence: string;
  /** only what bars live from this diameter on counts, up to the other; no end where that is empty */
  alphaFrom: string;
  alphaTo: string;
  concavity: Concavity;
  /** of hybrid2: pockets no deeper are measured by shortest paths */
  hybridTolerance: number;
  camera?: Camera;
}

/** Exact fits: of what grows they are told, of the others they are a part. */
export function naturalSemantics(operation: Operation): Semantics {
  return operation === 'sum' ? 'open' : 'closed';
}

export function discState(shape: Shape, changes: Partial<DiscState> = {}): DiscState {
  const semantics = naturalSemantics(changes.operation ?? 'sum'), features = { persistence: '1', alphaFrom: '0', alphaTo: '', concavity: 'straight_line', hybridTolerance: 0 } as const;
  return { shape, operation: 'sum', semantics, alpha: '1/2', event: null, bar: null, bridges: true, cuts: false, ...features, ...changes };
}

/** Why a text is no exact length that can be drawn; nothing where it is one. */
export function checkLength(text: string): string | undefined {
  const r = parseRational(text);
  return r && r.n >= 0n ? checkSize(r) : 'A diameter is a number that is not negative, such as 0.5 or 1/3.';
}

export function isLength(text: string): boolean {
  return checkLength(text) === undefined;
}

/** Throws an Error for what is no state of this page. What is left out is as in a new one. */
export function parseDiscState(value: unknown): DiscState {
  const v = (value ?? {}) as Partial<Record<keyof DiscState, unknown>>;
  const start = discState(parseShape(v.shape), { operation: kOperations.find(([name]) => name === v.operation)?.[0] ?? 'sum' });
  const length = (text: unknown, otherwise: string): string => (typeof text === 'string' && isLength(text) ? text : otherwise);
  const index = (n: unknown): number | null => (Number.isInteger(n) ? (n as number) : null);
  return {
    ...start,
    semantics: parseSemantics(v.semantics, start.semantics),
    alpha: length(v.alpha, start.alpha),
    event: index(v.event),
    bar: index(v.bar),
    bridges: v.bridges !== false,
    cuts: v.cuts === true,
    persistence: length(v.persistence, start.persistence),
    alphaFrom: length(v.alphaFrom, '0'),
    alphaTo: length(v.alphaTo, ''),
    concavity: kConcavities.find(([name]) => name === v.concavity)?.[0] ?? 'straight_line',
    hybridTolerance: Number.isFinite(v.hybridTolerance) ? Math.max(0, v.hybridTolerance as number) : 0,
    ...parseCamera(v.camera),
  };
}
