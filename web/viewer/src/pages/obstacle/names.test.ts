import { expect, test } from 'vitest';
import { clearanceText, contactText, freeAnglesText, noPathTexts } from './names';

test('contacts name what belongs to which', () => {
  expect(contactText({ kind: 'edge_of_p', p: 3, q: 1 })).toBe('edge 3 of the obstacle, vertex 1 of the robot');
  expect(contactText({ kind: 'edge_of_q', p: 3, q: 1 })).toBe('vertex 3 of the obstacle, edge 1 of the robot');
});

test('only a contact that is exact is called one', () => {
  const at = { patch: null, nearest: { x: 0, y: 0, theta: 0 }, contact: null };
  expect(clearanceText({ ...at, distance: 0, error: 0 }, false)).toBe('touches');
  expect(clearanceText({ ...at, distance: 0, error: 1e-12 }, false)).toBe('free, clearance 0');
  expect(clearanceText({ ...at, distance: -0.25, error: 0 }, true)).toBe('overlaps, depth 0.25');
});

test('free angles', () => {
  expect(freeAnglesText([])).toBe('none');
  expect(freeAnglesText([{ begin: -Math.PI, end: Math.PI }])).toBe('all');
  expect(freeAnglesText([{ begin: 0, end: Math.PI / 2 }, { begin: 3, end: 3 }])).toBe('0° to 90°, 171.89°');
});

test('the reason ends as a sentence', () => {
  const none = { kind: 'separated', text: 'there is no path', contact: null, start: [], goal: [], limit: null, unexaminedAngles: 0 } as const;
  expect(noPathTexts({ ...none, start: [], goal: [] })).toEqual({ title: 'There is no path: the obstacle separates start and goal.', text: 'There is no path.' });
});
