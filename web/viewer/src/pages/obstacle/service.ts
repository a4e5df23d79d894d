// Questions about a robot that moves and turns past an obstacle.
import type { Clearance, Contact, CspaceObstacle, Plan, PlanOptions, SumShape } from 'dymsum';
import type { Host } from '../../engine/host';
import { keyOf, type Shape } from '../../engine/shape';
import { using } from '../../operands/using';
import { angleOf, radiansOf } from '../angle';
import type { Pose } from './state';

export interface Operands {
  robot: Shape;
  obstacle: Shape;
}
export interface EventAngleText {
  theta: number;
  /** where it is rational */
  tanHalf: string | null;
}
export interface ObstacleScene {
  /** x, y, theta of each */
  vertices: Float64Array;
  triangles: Uint32Array;
  /** of each triangle: what touches there, as `contacts` has it; 0 an edge of the obstacle, 1 an edge of the robot */
  kinds: Uint8Array;
  patchOf: Uint32Array;
  /** of each patch three numbers: kind, index in the obstacle, index in the robot */
  contacts: Uint32Array;
  angles: EventAngleText[];
  patches: number;
  shells: number;
  cavities: number;
  components: number;
  events: number;
  ms: number;
}
export interface PlaceAnswer {
  /** the robot's interior meets that of the obstacle, decided exactly */
  overlaps: boolean;
  clearance: Clearance;
  freeAngles: { begin: number; end: number }[];
}

const kKinds: Record<Contact['kind'], number> = { edge_of_p: 0, edge_of_q: 1 };

function keyOfBoth({ robot, obstacle }: Operands): string {
  return `${keyOf(robot)} ${keyOf(obstacle)}`;
}

function obstacleOf(host: Host, of: Operands): CspaceObstacle {
  return host.keep(`cspace ${keyOfBoth(of)}`, () =>
    host.dymsum.CspaceObstacle.create(host.region(of.robot), host.region(of.obstacle), { progress: host.progress }),
  );
}

function sceneOf(host: Host, of: Operands): ObstacleScene {
  const obstacle = obstacleOf(host, of), mesh = obstacle.mesh({ progress: host.progress });
  const patches = obstacle.patches(), shells = obstacle.shells(), work = obstacle.work();
  const contacts = new Uint32Array(3 * patches.length);
  patches.forEach(({ contact }, k) => contacts.set([kKinds[contact.kind], contact.p, contact.q], 3 * k));
  return {
    vertices: mesh.vertices, triangles: mesh.triangles, patchOf: mesh.patches, contacts,
    kinds: Uint8Array.from(mesh.patches, (patch) => contacts[3 * patch]!),
    angles: obstacle.angles().map(({ theta, exactTanHalf }) => ({ theta, tanHalf: exactTanHalf })),
    patches: patches.length, shells: shells.length, cavities: shells.filter((s) => !s.outer).length,
    components: new Set(shells.map((s) => s.freeComponent)).size,
    events: work.alignments + work.vertexEvents + work.tripleEvents + work.tightEvents, ms: work.ms,
  };
}

function sliceOf(host: Host, of: Operands, tanHalf: string, strict: boolean): SumShape {
  return using(obstacleOf(host, of).slice(angleOf(tanHalf), strict ? 'closed' : 'open'), (sum) => sum.shape());
}

function placeOf(host: Host, of: Operands, pose: Pose, strict: boolean): PlaceAnswer {
  const obstacle = obstacleOf(host, of), queries = host.keep(`queries ${keyOfBoth(of)}`, () => obstacle.queries());
  const clearance = queries.clearance(configuration(pose), { touching: strict ? 'forbidden' : 'allowed' });
  return {
    overlaps: obstacle.contains(pose.x, pose.y, angleOf(pose.tanHalf)), clearance,
    freeAngles: queries.freeAngles(pose.x, pose.y).map(({ begin, end }) => ({ begin, end })),
  };
}

export function configuration({ x, y, tanHalf }: Pose): { x: number; y: number; theta: number } {
  return { x, y, theta: radiansOf(tanHalf) };
}

export type ObstacleFile = 'glb' | 'obstacle' | 'wkt' | 'path';

function fileOf(host: Host, of: Operands, tanHalf: string): Record<Exclude<ObstacleFile, 'path'>, () => string | Uint8Array> {
  const obstacle = obstacleOf(host, of);
  return {
    glb: () => obstacle.glb(),
    obstacle: () => obstacle.format(),
    wkt: () => using(obstacle.slice(angleOf(tanHalf)), (slice) => slice.format('wkt')),
  };
}

export const obstacleServices = {
  obstacleScene: (host: Host, of: Operands): ObstacleScene => sceneOf(host, of),
  obstacleSlice: (host: Host, { tanHalf, strict, ...of }: Operands & { tanHalf: string; strict: boolean }): SumShape => sliceOf(host, of, tanHalf, strict),
  obstaclePlace: (host: Host, { pose, strict, ...of }: Operands & { pose: Pose; strict: boolean }): PlaceAnswer => placeOf(host, of, pose, strict),
  obstaclePlan: (host: Host, { start, goal, touching, ...of }: Operands & { start: Pose; goal: Pose } & Pick<PlanOptions, 'touching'>): Plan =>
    obstacleOf(host, of).plan(configuration(start), configuration(goal), { touching: touching ?? 'allowed', progress: host.progress }),
  obstacleFile: (host: Host, { file, tanHalf, ...of }: Operands & { file: Exclude<ObstacleFile, 'path'>; tanHalf: string }): string | Uint8Array =>
    fileOf(host, of, tanHalf)[file](),
};
