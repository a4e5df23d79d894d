// An operand as it is drawn, also where it is refused.
import { DymsumError, type RegionFormat, type RegionShape } from 'dymsum';
import type { Host } from '../engine/host';
import type { ErrorData } from '../engine/protocol';
import { bytesOf, isMade, type Shape } from '../engine/shape';
import { using } from './using';

export interface OperandAnswer {
  /** of a file that is refused: what it says, as far as it can be read */
  shape: RegionShape | undefined;
  /** why no sum can be made of it */
  error: ErrorData | undefined;
}

export interface RegionNumbers {
  parts: number;
  holes: number;
  vertices: number;
  area: string;
  exact: string | null;
}

const kAreaBits = 1 << 15;

function unchecked(host: Host, shape: Shape): RegionShape | undefined {
  if (isMade(shape)) return undefined;
  try {
    return host.dymsum.Region.readData(shape.name, bytesOf(shape))[0]?.shape;
  } catch {
    return undefined; // a file that is no such file has nothing to draw; the first error says why
  }
}

export const operandServices = {
  operand: (host: Host, { shape }: { shape: Shape }): OperandAnswer => {
    try {
      return { shape: host.region(shape).shape(), error: undefined };
    } catch (error) {
      if (!(error instanceof DymsumError)) throw error;
      const isRead = error.evidence.line === undefined; // else it is no such file, and has nothing to draw
      return { shape: isRead ? unchecked(host, shape) : undefined, error: error.toData() };
    }
  },
  /** The shapes of a file, as texts of their own. */
  shapesOfFile: (host: Host, { shape, repair }: { shape: Shape; repair: boolean }): { name: string; text: string }[] => {
    if (isMade(shape)) throw new Error('A shape that was made has no file.');
    const all = host.dymsum.Region.readAll(shape.name, bytesOf(shape), { repair });
    return all.map(({ name, region }) => ({ name, text: using(region, (r) => r.format('wkt')) }));
  },
  /** What is known of a region by itself; the area also as a fraction, where that is not very long. */
  regionNumbers: (host: Host, { shape }: { shape: Shape }): RegionNumbers => {
    const region = host.region(shape), { partStarts } = region.shape();
    const exact = using(host.dymsum.unionOf([region]), (union) => union.areaExact(kAreaBits));
    const count = { parts: partStarts.length - 1, holes: region.holeCount, vertices: region.vertexCount };
    return { ...count, area: region.areaText(), exact };
  },
  regionFile: (host: Host, { shape, format }: { shape: Shape; format: RegionFormat }): string => {
    const region = host.region(shape);
    return format === 'svg' ? host.dymsum.drawRegion(region) : region.format(format);
  },
};
