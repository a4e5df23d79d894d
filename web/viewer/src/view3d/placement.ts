// From the coordinates of the data to those of the picture, in which everything lies around the origin within about 1:
// single precision, which graphics cards compute with, is then fine enough wherever the data lie.

/** Low and high x, y, z. */
export type Box = readonly [number, number, number, number, number, number];
export type Triple = readonly [number, number, number];

export class Placement {
  private constructor(
    private readonly centre: Triple,
    private readonly scale: Triple,
  ) {}

  /** The box's longest side becomes 2. */
  static of(box: Box): Placement {
    const size = Math.max(box[3] - box[0], box[4] - box[1], box[5] - box[2]) || 1;
    return new Placement(middleOf(box), [2 / size, 2 / size, 2 / size]);
  }

  /** The longer side in x and y becomes 2, and so does the height, whatever its unit. */
  static withHeightOfItsOwn(box: Box): Placement {
    const size = Math.max(box[3] - box[0], box[4] - box[1]) || 1;
    return new Placement(middleOf(box), [2 / size, 2 / size, 2 / (box[5] - box[2] || 1)]);
  }

  at(x: number, y: number, z: number): [number, number, number] {
    const { centre, scale } = this;
    return [(x - centre[0]) * scale[0], (y - centre[1]) * scale[1], (z - centre[2]) * scale[2]];
  }

  /** x, y, z after x, y, z. */
  all(vertices: Float64Array): Float32Array {
    const { centre, scale } = this;
    const out = new Float32Array(vertices.length);
    for (let k = 0; k < vertices.length; ++k) out[k] = (vertices[k]! - centre[k % 3]!) * scale[k % 3]!;
    return out;
  }

  /** Where a height of the data is in the picture. */
  height(z: number): number {
    return (z - this.centre[2]) * this.scale[2];
  }

  back(x: number, y: number, z: number): [number, number, number] {
    const { centre, scale } = this;
    return [x / scale[0] + centre[0], y / scale[1] + centre[1], z / scale[2] + centre[2]];
  }
}

function middleOf(box: Box): Triple {
  return [(box[0] + box[3]) / 2, (box[1] + box[4]) / 2, (box[2] + box[5]) / 2];
}

/** The box of x, y, z after x, y, z; that of the unit cube about the origin for nothing. */
export function boxOf(...lists: Float64Array[]): Box {
  const box: [number, number, number, number, number, number] = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  for (const vertices of lists)
    for (let k = 0; k < vertices.length; ++k) {
      const axis = k % 3;
      box[axis] = Math.min(box[axis]!, vertices[k]!);
      box[axis + 3] = Math.max(box[axis + 3]!, vertices[k]!);
    }
  return box[0] <= box[3] ? box : [-1, -1, -1, 1, 1, 1];
}
