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
    const scale = 1 / (Math.max(...halvesOf(box)) || 0.5);
    return new Placement(middleOf(box), [scale, scale, scale]);
  }

  /** All of the box is seen at first, whichever way it is turned. */
  static inSight(box: Box): Placement {
    const scale = kSeen / (Math.hypot(...halvesOf(box)) || 1);
    return new Placement(middleOf(box), [scale, scale, scale]);
  }

  /** The longer side in x and y becomes 2, and so does the height, whatever its unit. */
  static withHeightOfItsOwn(box: Box): Placement {
    const [x, y, z] = halvesOf(box), scale = 1 / (Math.max(x, y) || 0.5);
    return new Placement(middleOf(box), [scale, scale, 1 / (z || 0.5)]);
  }

  at(x: number, y: number, z: number): [number, number, number] {
    const { centre, scale } = this;
    return [drawn((x - centre[0]) * scale[0]), drawn((y - centre[1]) * scale[1]), drawn((z - centre[2]) * scale[2])];
  }

  /** x, y, z after x, y, z. */
  all(vertices: Float64Array): Float32Array {
    const { centre, scale } = this;
    const out = new Float32Array(vertices.length);
    for (let k = 0; k < vertices.length; ++k) out[k] = drawn((vertices[k]! - centre[k % 3]!) * scale[k % 3]!);
    return out;
  }

  /** Where a height of the data is in the picture. */
  height(z: number): number {
    return drawn((z - this.centre[2]) * this.scale[2]);
  }

  back(x: number, y: number, z: number): [number, number, number] {
    const { centre, scale } = this;
    return [x / scale[0] + centre[0], y / scale[1] + centre[1], z / scale[2] + centre[2]];
  }
}

const kSeen = 1.2; // a ball of this radius fits between the sides of the picture, see SpaceView.fit
const kFar = 1e6; // far behind what is seen, and single precision has it

/** A coordinate that graphics cards can take, whatever was computed. */
function drawn(x: number): number {
  return Number.isNaN(x) ? 0 : Math.max(-kFar, Math.min(kFar, x));
}

/** Of whatever box, in numbers: low and high, without overflow. */
function finite(x: number): number {
  return Math.max(-Number.MAX_VALUE, Math.min(Number.MAX_VALUE, x)) / 2;
}
function middleOf(box: Box): Triple {
  return [finite(box[0]) + finite(box[3]), finite(box[1]) + finite(box[4]), finite(box[2]) + finite(box[5])];
}
function halvesOf(box: Box): Triple {
  return [finite(box[3]) - finite(box[0]), finite(box[4]) - finite(box[1]), finite(box[5]) - finite(box[2])];
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
