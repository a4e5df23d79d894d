// Triangles sorted by kind, so that each kind is drawn in one go with a material of its own.

export interface Group {
  kind: number;
  /** of the first index, and how many there are */
  start: number;
  count: number;
}
export interface SortedTriangles {
  /** three indices each, the kinds in their order */
  index: Uint32Array;
  groups: Group[];
  /** of each triangle in this order: its number in the order given */
  from: Uint32Array;
}

export function sortByKind(triangles: Uint32Array, kinds: Uint8Array, kindCount: number): SortedTriangles {
  const count = triangles.length / 3;
  const next = new Uint32Array(kindCount + 1);
  for (let t = 0; t < count; ++t) next[kinds[t]! + 1]! += 1;
  for (let k = 0; k < kindCount; ++k) next[k + 1]! += next[k]!;
  const groups: Group[] = [];
  for (let kind = 0; kind < kindCount; ++kind)
    groups.push({ kind, start: 3 * next[kind]!, count: 3 * (next[kind + 1]! - next[kind]!) });
  const index = new Uint32Array(triangles.length), from = new Uint32Array(count);
  for (let t = 0; t < count; ++t) {
    const place = next[kinds[t]!]!++;
    from[place] = t;
    for (let c = 0; c < 3; ++c) index[3 * place + c] = triangles[3 * t + c]!;
  }
  return { index, groups, from };
}
