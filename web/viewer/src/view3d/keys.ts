// The camera by keys: arrows turn it, + and - come nearer and go away, 0 shows all.
import { Spherical, Vector3, type PerspectiveCamera } from 'three';

const kTurn = Math.PI / 36;
const kZoom = 1.15;
const kNearest = 0.5, kFurthest = 30, kNearPole = 0.01;

/** Whether the key was one of these. */
export function turnByKey(key: string, camera: PerspectiveCamera, target: Vector3, fit: () => void): boolean {
  if (key === '0') {
    fit();
    return true;
  }
  const move = { ArrowLeft: [-1, 0, 1], ArrowRight: [1, 0, 1], ArrowUp: [0, -1, 1], ArrowDown: [0, 1, 1], '+': [0, 0, 1 / kZoom], '=': [0, 0, 1 / kZoom], '-': [0, 0, kZoom] }[key];
  if (!move) return false;
  const [around, down, away] = move as [number, number, number];
  // Spherical has y upwards.
  const { x, y, z } = camera.position.clone().sub(target);
  const seen = new Spherical().setFromVector3(new Vector3(x, z, -y));
  seen.theta += around * kTurn;
  seen.phi = Math.min(Math.PI - kNearPole, Math.max(kNearPole, seen.phi + down * kTurn));
  seen.radius = Math.min(kFurthest, Math.max(kNearest, seen.radius * away));
  const to = new Vector3().setFromSpherical(seen);
  camera.position.set(to.x, -to.z, to.y).add(target);
  return true;
}
