// Where a horizontal plane cuts a closed mesh, for drawing. Vertices in the plane count as above it, so every edge is
// crossed once or not at all, the crossings are named by edges, and the loops close whatever lies in the plane.

/** Loops of x, y, z. */
export function sectionLoops(vertices: Float64Array | Float32Array, triangles: Uint32Array, height: number): Float64Array[] {
  const next = stepsAlong(vertices, triangles, height);
  const loops: Float64Array[] = [];
  while (next.size > 0) {
    const first = next.keys().next().value!;
    const points: number[] = [];
    for (let at: string | undefined = first; at !== undefined; ) {
      points.push(...crossing(vertices, at, height));
      const following: string | undefined = next.get(at)?.pop();
      if (next.get(at)?.length === 0) next.delete(at);
      at = following === first ? undefined : following;
    }
    loops.push(Float64Array.from(points));
  }
  return loops;
}

/** From crossed edge to crossed edge, through one triangle each. Edges of four faces are left as often as they are entered. */
function stepsAlong(vertices: Float64Array | Float32Array, triangles: Uint32Array, height: number): Map<string, string[]> {
  const next = new Map<string, string[]>();
  const above = (v: number): boolean => vertices[3 * v + 2]! >= height;
  for (let t = 0; t < triangles.length; t += 3) {
    let enters: string | undefined, leaves: string | undefined;
    for (let c = 0; c < 3; ++c) {
      const a = triangles[t + c]!, b = triangles[t + ((c + 1) % 3)]!;
      if (above(a) === above(b)) continue;
      const edge = a < b ? `${a} ${b}` : `${b} ${a}`;
      if (above(b)) enters = edge;
      else leaves = edge;
    }
    if (enters === undefined || leaves === undefined) continue;
    const steps = next.get(enters);
    if (steps) steps.push(leaves);
    else next.set(enters, [leaves]);
  }
  return next;
}

function crossing(vertices: Float64Array | Float32Array, edge: string, height: number): [number, number, number] {
  const [a, b] = edge.split(' ').map(Number) as [number, number];
  const za = vertices[3 * a + 2]!, zb = vertices[3 * b + 2]!;
  const share = (height - za) / (zb - za);
  const between = (axis: number): number => vertices[3 * a + axis]! + share * (vertices[3 * b + axis]! - vertices[3 * a + axis]!);
  return [between(0), between(1), height];
}
