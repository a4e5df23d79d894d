// Where the picture looks: y goes up in the plane and down on the screen.

export interface Point {
  x: number;
  y: number;
}
export interface Box {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}
export interface Size {
  width: number;
  height: number;
}

export interface Camera {
  /** what is in the middle of the picture */
  x: number;
  y: number;
  /** pixels per unit */
  zoom: number;
}

export function toScreen(c: Camera, size: Size, p: Point): Point {
  return { x: (p.x - c.x) * c.zoom + size.width / 2, y: size.height / 2 - (p.y - c.y) * c.zoom };
}
export function toPlane(c: Camera, size: Size, s: Point): Point {
  return { x: (s.x - size.width / 2) / c.zoom + c.x, y: (size.height / 2 - s.y) / c.zoom + c.y };
}

/** Shows the whole box with a margin. */
export function fitted(box: Box, size: Size): Camera {
  const width = box.x1 - box.x0, height = box.y1 - box.y0;
  const margin = Math.min(size.width, size.height) > 420 ? 56 : 28;
  const zoom = Math.min((size.width - 2 * margin) / (width || height || 1), (size.height - 2 * margin) / (height || width || 1));
  return { x: (box.x0 + box.x1) / 2, y: (box.y0 + box.y1) / 2, zoom: Math.max(zoom, 1e-300) };
}

/** What lies at a place of the screen stays there. */
export function zoomed(c: Camera, size: Size, at: Point, factor: number): Camera {
  const held = toPlane(c, size, at);
  const zoom = Math.min(Math.max(c.zoom * factor, 1e-9), 1e12);
  return { x: held.x - (at.x - size.width / 2) / zoom, y: held.y + (at.y - size.height / 2) / zoom, zoom };
}
export function moved(c: Camera, dx: number, dy: number): Camera {
  return { ...c, x: c.x - dx / c.zoom, y: c.y + dy / c.zoom };
}

export function unionOf(boxes: readonly (Box | undefined)[]): Box | undefined {
  let all: Box | undefined;
  for (const b of boxes) {
    if (!b) continue;
    all = all
      ? { x0: Math.min(all.x0, b.x0), y0: Math.min(all.y0, b.y0), x1: Math.max(all.x1, b.x1), y1: Math.max(all.y1, b.y1) }
      : b;
  }
  return all;
}

/** Of x, y, x, y, …; nothing where there are none. */
export function boxOf(vertices: ArrayLike<number>): Box | undefined {
  if (vertices.length === 0) return undefined;
  const box = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };
  for (let k = 0; k < vertices.length; k += 2) {
    const x = vertices[k]!, y = vertices[k + 1]!;
    if (x < box.x0) box.x0 = x;
    if (x > box.x1) box.x1 = x;
    if (y < box.y0) box.y0 = y;
    if (y > box.y1) box.y1 = y;
  }
  return box;
}
