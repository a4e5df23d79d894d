// Kinds and outlines of a sum's faces.
import type { SolidFeature } from 'dymsum';

/** Kinds of triangles: a face of P on a vertex of Q (fv), a face of Q on a vertex of P (fv), two edges (ee), changed. */
export const kKinds = { faceOfP: 0, faceOfQ: 1, edges: 2, changed: 3 } as const;
const kFace = 2, kVertex = 0;
const kFeatures: readonly SolidFeature['kind'][] = ['vertex', 'edge', 'face'];

/** `contacts` has six numbers for each face: kind, a, b of the feature of P, then of Q. */
export function kindsOfFaces(faceOf: Uint32Array, contacts: Uint32Array, changes: Uint8Array): { kinds: Uint8Array; changedKinds: Uint8Array } {
  const kinds = Uint8Array.from(faceOf, (face) => {
    if (contacts[6 * face] === kFace) return kKinds.faceOfP;
    return contacts[6 * face + 3] === kFace ? kKinds.faceOfQ : kKinds.edges;
  });
  return { kinds, changedKinds: kinds.map((kind, t) => (changes[faceOf[t]!] === 0 ? kind : kKinds.changed)) };
}

export function contactOf(contacts: Uint32Array, face: number): { p: SolidFeature; q: SolidFeature } {
  const at = (k: number): SolidFeature => ({ kind: kFeatures[contacts[k]!]!, a: contacts[k + 1]!, b: contacts[k + 2]! });
  return { p: at(6 * face), q: at(6 * face + 3) };
}

export function featureText({ kind, a, b }: SolidFeature): string {
  return kind === 'edge' ? `edge ${a}–${b}` : `${kind} ${a}`;
}

export function contactText({ p, q }: { p: SolidFeature; q: SolidFeature }): string {
  return `${featureText(p)} of P, ${featureText(q)} of Q`;
}

const kMostContacts = 4;

/** All that touches at once, as far as it is known. */
export function touchingText(contacts: readonly { p: SolidFeature; q: SolidFeature }[] | undefined): string {
  if (!contacts || contacts.length === 0) return 'not named while one of them is turned';
  const more = contacts.length - kMostContacts;
  return contacts.slice(0, kMostContacts).map(contactText).join('; ') + (more > 0 ? `; ${more} more` : '');
}

/** "fv" or "ee", as the convolution has them; two parallel faces count as fv. */
export function kindText({ p, q }: { p: SolidFeature; q: SolidFeature }): string {
  const isVertex = (f: SolidFeature): boolean => f.kind === kFeatures[kVertex];
  return p.kind === 'edge' && q.kind === 'edge' ? 'ee' : isVertex(p) || isVertex(q) ? 'fv' : 'parallel';
}

/** Two vertices each: the sides of triangles between different faces, each once. */
export function boundaryEdges(triangles: Uint32Array, faceOf: Uint32Array): Uint32Array {
  const seen = new Map<number, number>(), edges: number[] = [], most = triangles.reduce((a, b) => Math.max(a, b), 0) + 1;
  for (let t = 0; t < faceOf.length; ++t)
    for (let c = 0; c < 3; ++c) {
      const a = triangles[3 * t + c]!, b = triangles[3 * t + ((c + 1) % 3)]!;
      const key = Math.min(a, b) * most + Math.max(a, b), other = seen.get(key);
      if (other === undefined) seen.set(key, faceOf[t]!);
      else if (other !== faceOf[t]) edges.push(a, b);
    }
  return Uint32Array.from(edges);
}
