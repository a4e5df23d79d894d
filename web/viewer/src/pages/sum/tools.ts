// What dragging P or Q does: each tool makes the state of a pointer's way.
import { snapped, tanHalfOf } from '../../numbers/snap';
import { short } from '../../numbers/display';
import type { Point } from '../../view2d/camera';
import { radiansOf, scaleOf } from './placing';
import type { SumState, Which } from './state';

export const kTools = [['move', 'Move'], ['scale', 'Scale'], ['turn', 'Turn'], ['pull', 'Pull a vertex']] as const;
export type Tool = (typeof kTools)[number][0];

export const kScaleRange = [0.05, 4] as const;

/** `seen`: what can just be told apart. */
function movedState(state: SumState, which: Which, from: Point, to: Point, seen: number): SumState {
  const [x, y] = which === 'p' ? state.atP : state.atQ;
  const at: [number, number] = [snapped(x + to.x - from.x, seen), snapped(y + to.y - from.y, seen)];
  return which === 'p' ? { ...state, atP: at } : { ...state, atQ: at };
}

function scaledState(state: SumState, which: Which, from: Point, to: Point): SumState {
  const [x, y] = which === 'p' ? state.atP : state.atQ;
  const before = state.motion === 'scale' && state.moving === which ? scaleOf(state) : 1;
  const factor = Math.hypot(to.x - x, to.y - y) / (Math.hypot(from.x - x, from.y - y) || 1);
  const scale = Math.min(Math.max(before * factor, kScaleRange[0]), kScaleRange[1]);
  return { ...state, moving: which, motion: 'scale', scale: short(Math.round(scale * 1000) / 1000) };
}

function turnedState(state: SumState, which: Which, from: Point, to: Point): SumState {
  const [x, y] = which === 'p' ? state.atP : state.atQ;
  const before = state.motion === 'turn' && state.moving === which ? radiansOf(state.tanHalf) : 0;
  const by = Math.atan2(to.y - y, to.x - x) - Math.atan2(from.y - y, from.x - x);
  return { ...state, moving: which, motion: 'turn', tanHalf: tanHalfOf(before + by) };
}

/** `state` is the one in which the drag began. */
export function draggedState(tool: Exclude<Tool, 'pull'>, state: SumState, which: Which, from: Point, to: Point, seen: number): SumState {
  if (tool === 'move') return movedState(state, which, from, to, seen);
  return tool === 'scale' ? scaledState(state, which, from, to) : turnedState(state, which, from, to);
}
