// Draws A, B where it stands, and the no-fit polygon.
import type { Outline } from '../../operands/outline';
import { colour } from '../../shell/theme';
import { applied, kStill, placed, type Affine } from '../../view2d/affine';
import type { Point } from '../../view2d/camera';
import type { Painter } from '../../view2d/painter';
import type { SumPicture } from '../../view2d/sum_shape';
import { paintMove } from '../move_arrow';
import { features } from '../sum/provenance';
import type { Placed } from './service';
import type { Placement } from './state';

export interface NestingScene {
  a: Outline | undefined;
  b: Outline | undefined;
  nfp: SumPicture | undefined;
  at: Placement;
  placed: Placed | undefined;
  wrong: readonly Point[];
}

function paintContacts(painter: Painter, { a, b, nfp, at }: NestingScene, byB: Affine): void {
  if (!a || !b || !nfp || (at.kind !== 'vertex' && at.kind !== 'edge')) return;
  const mark = colour('--mark'), ground = colour('--ground');
  const from = features(nfp.shape, { kind: at.kind, index: at.index });
  const edge = (outline: Outline, k: number, by: Affine): void => {
    const p = outline.vertex(k), q = outline.vertex(outline.next(k));
    painter.segments([p.x, p.y, q.x, q.y], { colour: mark, width: 3.5 }, by);
  };
  for (const k of from.edgesP) edge(a, k, kStill);
  for (const k of from.edgesQ) edge(b, k, byB);
  for (const k of from.verticesP) painter.dot(a.vertex(k), 4.5, mark, ground);
  for (const k of from.verticesQ) painter.dot(applied(byB, b.vertex(k)), 4.5, mark, ground);
}

export function paintNesting(painter: Painter, scene: NestingScene): void {
  const { a, b, nfp, placed: now } = scene;
  nfp?.paint(painter);
  a?.paint(painter, colour('--p-fill'), { colour: colour('--p'), width: 1.5 });
  nfp?.paintTight(painter);
  if (now) {
    const byB = placed(1, 0, now.approx.x, now.approx.y), overlap = now.meeting === 'overlapping';
    b?.paint(painter, colour('--q-fill'), { colour: colour(overlap ? '--error' : '--q'), width: 1.5, ...(overlap ? { dash: [6, 4] } : {}) }, byB);
    paintContacts(painter, scene, byB);
    if (now.move) paintMove(painter, now.approx, now.move);
    painter.dot(now.approx, 4, colour(now.meeting === 'touching' ? '--mark' : '--q'), colour('--ground'));
  }
  for (const place of scene.wrong) painter.wrong(place, colour('--error'));
}
