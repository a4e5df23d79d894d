// Dragging P and Q with the chosen tool.
import { snapped } from '../../numbers/snap';
import type { Outline } from '../../operands/outline';
import type { Change, Shell } from '../../shell/page';
import { inverted, type Affine } from '../../view2d/affine';
import type { Point } from '../../view2d/camera';
import { isInside } from '../../view2d/edge_grid';
import type { Grip } from '../../view2d/gestures';
import { placing } from './placing';
import type { SumState, Which } from './state';
import { draggedState, type Tool } from './tools';
import type { Pull } from './use_sum';

/** The operand at a place: the smaller of two. */
export function operandAt(outlines: Record<Which, Outline | undefined>, state: SumState, at: Point, reach: number): Which | undefined {
  const size = (which: Which): number => {
    const box = outlines[which]?.box;
    return box ? (box.x1 - box.x0) * (box.y1 - box.y0) : Infinity;
  };
  const hit = (which: Which): boolean => {
    const outline = outlines[which], by = placing(state, which), own = inverted(by, at);
    return !!outline && state.layers.includes(which) && (isInside(outline.rings, own) || !!outline.grid.nearest(own, reach / Math.hypot(by.a, by.b)));
  };
  const order: Which[] = size('q') < size('p') ? ['q', 'p'] : ['p', 'q'];
  return order.find(hit);
}

function nearestVertex(outline: Outline, by: Affine, at: Point, reach: number): number | undefined {
  const near = outline.grid.nearest(inverted(by, at), reach / Math.hypot(by.a, by.b));
  return near?.kind === 'vertex' ? near.index : undefined;
}

const pulledName = (name: string): string => `${name.replace(/\*?(\.\w+)?$/, '')}*.wkt`;

export interface DragContext {
  shell: Shell;
  state: SumState;
  change: Change<SumState>;
  outlines: Record<Which, Outline | undefined>;
  tool: Tool;
  setPull: (pull: Pull | undefined) => void;
}

async function finishPull({ shell, state, change, setPull }: DragContext, { which, vertex, x, y }: Pull): Promise<void> {
  try {
    const text = await shell.engine.ask('pulledText', { shape: state[which], vertex, x, y });
    change({ ...state, [which]: { name: pulledName(state[which].name), text } });
  } catch (error) {
    shell.report(error);
  } finally {
    setPull(undefined);
  }
}

function pullGrip(context: DragContext, which: Which, vertex: number, reach: number): Grip {
  const by = placing(context.state, which);
  const to = (at: Point): Pull => {
    const own = inverted(by, at);
    return { which, vertex, x: snapped(own.x, reach / 4), y: snapped(own.y, reach / 4) };
  };
  return {
    drag: (_, at) => context.setPull(to(at)),
    drop: (_, at) => (at ? void finishPull(context, to(at)) : context.setPull(undefined)),
  };
}

/** What begins to be dragged at a place, if anything does. */
export function gripOf(context: DragContext, at: Point, reach: number): Grip | undefined {
  const { state, change, outlines, tool } = context;
  const which = operandAt(outlines, state, at, reach), outline = which && outlines[which];
  if (!which || !outline) return undefined;
  if (tool === 'pull') {
    const vertex = nearestVertex(outline, placing(state, which), at, reach);
    return vertex === undefined ? undefined : pullGrip(context, which, vertex, reach);
  }
  return {
    drag: (from, to) => change(draggedState(tool, state, which, from, to, reach / 4), 'live'),
    drop: (from, to) => change(to ? draggedState(tool, state, which, from, to, reach / 4) : state),
  };
}
