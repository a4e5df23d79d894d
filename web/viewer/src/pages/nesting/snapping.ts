// Where B goes when it is dragged: onto the boundary of the no-fit polygon where that is near.
import { snapped } from '../../numbers/snap';
import type { Point } from '../../view2d/camera';
import type { SumPicture } from '../../view2d/sum_shape';
import type { Placement } from './state';

const kShares = 1024; // of an edge: exact, and finer than what is seen

/** Segments along which B fits exactly, without room to move sideways. */
function onTightSegment({ shape }: SumPicture, at: Point, reach: number): Placement | undefined {
  for (let k = 0; k < shape.tightSegments.length; k += 2) {
    const index = shape.tightSegments[k]!, next = shape.tightSegments[k + 1]!, v = shape.vertices;
    const ax = v[2 * index]!, ay = v[2 * index + 1]!, dx = v[2 * next]! - ax, dy = v[2 * next + 1]! - ay;
    const along = ((at.x - ax) * dx + (at.y - ay) * dy) / (dx * dx + dy * dy);
    if (along < 0 || along > 1 || Math.hypot(ax + along * dx - at.x, ay + along * dy - at.y) > reach) continue;
    return { kind: 'edge', index, next, along: `${Math.round(along * kShares)}/${kShares}` };
  }
  return undefined;
}

export function placementNear(nfp: SumPicture | undefined, at: Point, reach: number): Placement {
  const near = nfp?.nearest(at, reach);
  if (nfp && near?.kind !== 'vertex') {
    const tight = onTightSegment(nfp, at, reach);
    if (tight) return tight;
  }
  if (!near) return { kind: 'free', x: snapped(at.x, reach / 4), y: snapped(at.y, reach / 4) };
  if (near.kind === 'vertex') return { kind: 'vertex', index: near.index };
  return { kind: 'edge', index: near.index, next: near.next, along: `${Math.round(near.along * kShares)}/${kShares}` };
}
