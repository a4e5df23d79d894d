// Maps of the plane, for drawing: x' = a x + c y + e, y' = b x + d y + f.
import type { Box, Point } from './camera';

export interface Affine {
  a: number;
  b: number;
  c: number;
  d: number;
  e: number;
  f: number;
}

export const kStill: Affine = { a: 1, b: 0, c: 0, d: 1, e: 0, f: 0 };

/** Scaled and turned about the origin, then moved. */
export function placed(scale: number, radians: number, e: number, f: number): Affine {
  const a = scale * Math.cos(radians), b = scale * Math.sin(radians);
  return { a, b, c: -b, d: a, e, f };
}

export function applied(m: Affine, { x, y }: Point): Point {
  return { x: m.a * x + m.c * y + m.e, y: m.b * x + m.d * y + m.f };
}

/** Requires: a map that has an inverse. */
export function inverted(m: Affine, p: Point): Point {
  const det = m.a * m.d - m.b * m.c, x = p.x - m.e, y = p.y - m.f;
  return { x: (m.d * x - m.c * y) / det, y: (m.a * y - m.b * x) / det };
}

/** The box of a box's corners. */
export function appliedToBox(m: Affine, box: Box | undefined): Box | undefined {
  if (!box) return undefined;
  const corners = [box.x0, box.x1].flatMap((x) => [box.y0, box.y1].map((y) => applied(m, { x, y })));
  return {
    x0: Math.min(...corners.map((p) => p.x)), y0: Math.min(...corners.map((p) => p.y)),
    x1: Math.max(...corners.map((p) => p.x)), y1: Math.max(...corners.map((p) => p.y)),
  };
}
