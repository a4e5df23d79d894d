// A path as a file that `dymsum path --check-path` reads: the waypoints of the one that `dymsum path -o path.json` writes.
import type { Waypoint } from 'dymsum';

export function pathText(path: readonly Waypoint[]): string {
  const waypoints = path.map(({ x, y, theta, move, exact }) => ({ x, y, theta, tan_half: exact.tanHalf, exact: [exact.x, exact.y], move }));
  return `${JSON.stringify({ waypoints }, null, 2)}\n`;
}
