import { expect, test } from 'vitest';
import { boundaryEdges, contactOf, contactText, kindsOfFaces, kindText, kKinds, touchingText } from './faces';

// Three faces: face 4 of P on vertex 7 of Q; vertex 1 of P on face 2 of Q; edge 0-1 of P on edge 5-6 of Q.
const contacts = Uint32Array.of(2, 4, 0, 0, 7, 0, 0, 1, 0, 2, 2, 0, 1, 0, 1, 1, 5, 6);

test('kinds follow what touches, and changes go over them', () => {
  const { kinds, changedKinds } = kindsOfFaces(Uint32Array.of(0, 1, 1, 2), contacts, Uint8Array.of(0, 1, 0));
  expect([...kinds]).toEqual([kKinds.faceOfP, kKinds.faceOfQ, kKinds.faceOfQ, kKinds.edges]);
  expect([...changedKinds]).toEqual([kKinds.faceOfP, kKinds.changed, kKinds.changed, kKinds.edges]);
});

test('names of what generates a facet', () => {
  expect(contactText(contactOf(contacts, 0))).toBe('face 4 of P, vertex 7 of Q');
  expect(contactText(contactOf(contacts, 2))).toBe('edge 0–1 of P, edge 5–6 of Q');
  expect([0, 1, 2].map((face) => kindText(contactOf(contacts, face)))).toEqual(['fv', 'fv', 'ee']);
});

test('outlines leave out what lies within a face', () => {
  // A square of two triangles, one face, with a triangle of another face beside it.
  const edges = boundaryEdges(Uint32Array.of(0, 1, 2, 0, 2, 3, 1, 4, 2), Uint32Array.of(0, 0, 1));
  expect([...edges]).toEqual([2, 1]);
});

test('all that touches is named, and nothing where it is not known', () => {
  const contact = { p: { kind: 'face', a: 5, b: 0 }, q: { kind: 'edge', a: 1, b: 2 } } as const;
  expect(touchingText([contact])).toBe('face 5 of P, edge 1–2 of Q');
  expect(touchingText(Array(6).fill(contact))).toMatch(/; 2 more$/);
  expect([touchingText(undefined), touchingText([])]).toEqual(Array(2).fill(expect.stringMatching(/^not named/)));
});
