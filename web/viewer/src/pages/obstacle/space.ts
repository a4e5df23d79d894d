// The obstacle in (x, y, theta) as it is drawn: its surface, and over it the slice, the robot's point and its path.
import type { Clearance, Configuration, SumShape } from 'dymsum';
import { colour } from '../../shell/theme';
import type { Overlay, OverlayLine } from '../../view3d/overlay';
import { boxOf, Placement } from '../../view3d/placement';
import type { SurfaceShape } from '../../view3d/surface';
import type { PathMotion } from './motion';
import type { ObstacleScene } from './service';

/** Of the kinds of patches: an edge of the obstacle, an edge of the robot. */
export const kPatchColours = ['--p-face', '--q-face'] as const;

export interface SpaceShape {
  placement: Placement;
  surface: SurfaceShape;
  /** low and high x and y of the plane of a slice */
  frame: readonly [number, number, number, number];
}

export function spaceShape(scene: ObstacleScene): SpaceShape {
  const box = boxOf(scene.vertices);
  const placement = Placement.withHeightOfItsOwn([box[0], box[1], -Math.PI, box[3], box[4], Math.PI]);
  const margin = 0.06 * Math.max(box[3] - box[0], box[4] - box[1]);
  return {
    placement, frame: [box[0] - margin, box[1] - margin, box[3] + margin, box[4] + margin],
    surface: { vertices: placement.all(scene.vertices), triangles: scene.triangles, kinds: scene.kinds },
  };
}

/** The plane of an angle as a loop. */
function frameAt({ placement, frame }: SpaceShape, theta: number): Float32Array {
  const [x0, y0, x1, y1] = frame;
  return placement.all(Float64Array.of(x0, y0, theta, x1, y0, theta, x1, y1, theta, x0, y1, theta));
}

/** Vertices of a slice from `begin` to `end`, at the height of its angle. */
function lifted(placement: Placement, vertices: Float64Array, indices: Iterable<number>, theta: number): Float32Array {
  const out: number[] = [];
  for (const k of indices) out.push(vertices[2 * k]!, vertices[2 * k + 1]!, theta);
  return placement.all(Float64Array.from(out));
}

function* range(begin: number, end: number): Iterable<number> {
  for (let k = begin; k < end; ++k) yield k;
}

function sliceLines({ placement }: SpaceShape, slice: SumShape, theta: number): OverlayLine[] {
  const { vertices, ringStarts, tightSegments } = slice, rings: Float32Array[] = [], tight: Float32Array[] = [];
  for (let r = 0; r + 1 < ringStarts.length; ++r) rings.push(lifted(placement, vertices, range(ringStarts[r]!, ringStarts[r + 1]!), theta));
  for (let s = 0; s < tightSegments.length; s += 2) tight.push(lifted(placement, vertices, tightSegments.subarray(s, s + 2), theta));
  return [
    { loops: rings, closed: true, colour: colour('--sum'), width: 2, fill: colour('--sum-fill') },
    { loops: tight, closed: false, colour: colour('--tight'), width: 3 },
  ];
}

export interface SpacePlace {
  now: Configuration;
  /** the slice at the angle of now, and which angle it is of */
  slice: { shape: SumShape; theta: number } | undefined;
  clearance: Clearance | undefined;
  motion: PathMotion | undefined;
  start: Configuration;
  goal: Configuration;
}

export function spaceOverlay(space: SpaceShape, place: SpacePlace): Overlay {
  const { placement } = space, { now, slice, clearance, motion } = place;
  const at = ({ x, y, theta }: Configuration): [number, number, number] => placement.at(x, y, theta);
  const lines: OverlayLine[] = [{ loops: [frameAt(space, now.theta)], closed: true, colour: colour('--axis'), width: 1.25, fill: colour('--hover').concat('80') }];
  if (slice) lines.push(...sliceLines(space, slice.shape, slice.theta));
  if (motion) lines.push({ loops: motion.pieces().map((p) => placement.all(p)), closed: false, colour: colour('--sum'), width: 2.5 });
  const tight = slice ? [...slice.shape.tightPoints].map((k) => ({ x: slice.shape.vertices[2 * k]!, y: slice.shape.vertices[2 * k + 1]!, theta: slice.theta })) : [];
  return {
    lines,
    arrows: clearance && clearance.distance !== 0 ? [{ from: at(now), to: at(clearance.nearest), colour: colour('--mark') }] : [],
    dots: [
      ...tight.map((place) => ({ at: at(place), colour: colour('--tight'), radius: 4 })),
      { at: at(place.start), colour: colour('--quiet'), radius: 4, text: 'start' },
      { at: at(place.goal), colour: colour('--quiet'), radius: 4, text: 'goal' },
      { at: at(now), colour: colour('--q'), radius: 6 },
    ],
  };
}
