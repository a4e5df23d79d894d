// Sums of two regions.
import type { PlanarSum, SumShape } from 'dymsum';
import type { Host } from '../../engine/host';
import { keyOf, type Shape } from '../../engine/shape';

export interface SumFrame {
  shape: SumShape;
}

function sumOf(host: Host, p: Shape, q: Shape): PlanarSum {
  return host.keep(`sum ${keyOf(p)} ${keyOf(q)}`, () => host.dymsum.minkowskiSum(host.region(p), host.region(q), { progress: host.progress }));
}

export const sumServices = {
  sumFrame: (host: Host, { p, q }: { p: Shape; q: Shape }): SumFrame => ({ shape: sumOf(host, p, q).shape() }),
};
