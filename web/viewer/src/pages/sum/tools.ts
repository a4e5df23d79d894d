// What dragging P or Q does: each tool makes the state of a pointer's way.
import { snapped, tanHalfOf } from '../../numbers/snap';
import type { Option } from '../../shell/controls';
import type { Point } from '../../view2d/camera';
import { radiansOf } from '../angle';
import { firstFactor, withFirstFactor } from '../scale';
import type { SumState, Which } from './state';

export const kTools = [
  ['move', 'Move', 'Dragging P or Q moves it.'],
  ['scale', 'Scale', 'Dragging P or Q scales it.'],
  ['turn', 'Turn', 'Dragging P or Q turns it.'],
  ['pull', 'Pull a vertex', 'Dragging a vertex of P or Q moves that vertex alone.'],
] as const;
export type Tool = (typeof kTools)[number][0];

/** The inner fit does not turn. */
export function toolsOf({ shown }: Pick<SumState, 'shown'>): readonly Option<Tool>[] {
  return shown === 'fit' ? kTools.filter(([tool]) => tool !== 'turn') : kTools;
}

const kScaleRange = [0.05, 4] as const;

export function scaleRange({ range, motion }: Pick<SumState, 'range' | 'motion'>): readonly [number, number] {
  return motion === 'scale' && range ? [Math.min(kScaleRange[0], range[0]), Math.max(kScaleRange[1], range[1])] : kScaleRange;
}

/** Scales of sliders and drags are of few digits; of the inner fit binary ones, so that nothing is rounded. */
export function scaleStep({ shown }: Pick<SumState, 'shown'>): number {
  return shown === 'fit' ? 1 / 256 : 1 / 1000;
}

export function withScale(state: SumState, value: number): SumState {
  const step = scaleStep(state), steps = Math.max(1, Math.round(value / step));
  return { ...state, motion: 'scale', scale: withFirstFactor(state.scale, String(state.shown === 'fit' ? steps * step : steps / 1000)) };
}

/** `seen`: what can just be told apart. */
function movedState(state: SumState, which: Which, from: Point, to: Point, seen: number): SumState {
  const [x, y] = which === 'p' ? state.atP : state.atQ;
  const at: [number, number] = [snapped(x + to.x - from.x, seen), snapped(y + to.y - from.y, seen)];
  return which === 'p' ? { ...state, atP: at } : { ...state, atQ: at };
}

function scaledState(state: SumState, which: Which, from: Point, to: Point): SumState {
  const [x, y] = which === 'p' ? state.atP : state.atQ, [low, high] = scaleRange(state);
  const goesOn = state.motion === 'scale' && state.moving === which;
  const factor = Math.hypot(to.x - x, to.y - y) / (Math.hypot(from.x - x, from.y - y) || 1);
  const value = Math.min(Math.max((goesOn ? firstFactor(state.scale) : 1) * factor, low), high);
  return withScale({ ...state, moving: which, ...(goesOn ? {} : { scale: '1' }) }, value);
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
