// Where the robot is on its way along a path of translations and turns in place, for playing it.
import type { Configuration, Waypoint } from 'dymsum';

const kTurn = 2 * Math.PI;

/** From 0 to a whole turn, counter-clockwise. */
function turnFrom(a: number, b: number): number {
  const turn = (b - a) % kTurn;
  return turn < 0 ? turn + kTurn : turn;
}

/** The turn of a move: positive counter-clockwise, 0 for a translation. */
function turnOf(from: Waypoint, to: Waypoint): number {
  if (to.move === 'counter_clockwise') return turnFrom(from.theta, to.theta);
  if (to.move === 'clockwise') return -turnFrom(to.theta, from.theta);
  return 0;
}

export class PathMotion {
  private readonly turns: number[];
  /** the way up to each waypoint */
  private readonly until: number[] = [0];

  /** `weight` is a length per radian: how much way a turn is. Requires: at least one waypoint. */
  constructor(
    readonly waypoints: readonly Waypoint[],
    weight: number,
  ) {
    this.turns = waypoints.slice(1).map((to, k) => turnOf(waypoints[k]!, to));
    waypoints.slice(1).forEach((to, k) => {
      const from = waypoints[k]!;
      this.until.push(this.until[k]! + Math.hypot(to.x - from.x, to.y - from.y) + weight * Math.abs(this.turns[k]!));
    });
  }

  get length(): number {
    return this.until.at(-1)!;
  }

  /** The number of the move, from 0, at a share of the way from 0 to 1. */
  moveAt(share: number): number {
    const way = share * this.length, last = this.waypoints.length - 2;
    let low = 0, high = Math.max(0, last);
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.until[middle + 1]! >= way) high = middle;
      else low = middle + 1;
    }
    return low;
  }

  at(share: number): Configuration {
    const k = this.moveAt(share), from = this.waypoints[k]!, to = this.waypoints[k + 1] ?? from;
    const step = (this.until[k + 1] ?? 0) - this.until[k]!;
    const part = step > 0 ? Math.min(1, Math.max(0, (share * this.length - this.until[k]!) / step)) : 1;
    if (part === 1) return { x: to.x, y: to.y, theta: to.theta };
    return { x: from.x + part * (to.x - from.x), y: from.y + part * (to.y - from.y), theta: wrapped(from.theta + part * (this.turns[k] ?? 0)) };
  }

  /** The line through (x, y, theta), in pieces: it leaves at theta = pi and comes in again at -pi. x, y, theta after x, y, theta. */
  pieces(): Float64Array[] {
    const pieces: number[][] = [[]];
    this.waypoints.forEach((to, k) => {
      if (k > 0) this.addTurn(pieces, this.waypoints[k - 1]!, this.turns[k - 1]!);
      pieces.at(-1)!.push(to.x, to.y, to.theta);
    });
    return pieces.map((p) => Float64Array.from(p));
  }

  private addTurn(pieces: number[][], from: Waypoint, turn: number): void {
    const end = from.theta + turn, wraps = Math.abs(end) > Math.PI + 1e-9;
    if (!wraps) return;
    const edge = Math.sign(turn) * Math.PI;
    pieces.at(-1)!.push(from.x, from.y, edge);
    pieces.push([from.x, from.y, -edge]);
  }
}

/** The same angle, from -pi to pi. */
export function wrapped(theta: number): number {
  return Math.atan2(Math.sin(theta), Math.cos(theta));
}
