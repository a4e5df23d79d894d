/**
 * dymsum: exact Minkowski sums of polygons and of solids, kept exact while shapes move; and what people build from them.
 *
 * Names are those of the C++ library and of Python's package, with camelCase for functions and fields: their guides hold
 * here too. `load` makes an instance of the WebAssembly module; it has two layers:
 *
 * 1. live objects: `Region`, `Mesh`, sums, and sums that follow a motion. The entry "dymsum/live" has these alone.
 * 2. `run`: the command line, with files in memory; every verb, the same text as the native program. Its own module is
 *    loaded when it is first called.
 *
 * Geometry comes as typed arrays, which are copies and stay valid. Exact numbers are strings, "3/2". Errors are thrown as
 * `DymsumError`. Objects with `dispose` hold memory of the module until it is called; all else is plain data. An object
 * that is made of others keeps what it needs of them: these may be disposed of before it. Computations are synchronous:
 * pages call them in a worker.
 */

export interface LoadOptions {
  /** The bytes of dymsum.wasm (or dymsum-simd.wasm, with `simd: true`), for pages that may not fetch: those opened from disk. */
  wasmBinary?: ArrayBuffer | Uint8Array;
  /** Likewise those of dymsum-command.wasm or dymsum-command-simd.wasm, for `run`. */
  commandBinary?: ArrayBuffer | Uint8Array;
  /** Which build; else the one with SIMD where the engine has it. */
  simd?: boolean;
  /** Where a file of the package is, by its name; else beside index.js. */
  locateFile?: (name: string) => string;
}

export function load(options?: LoadOptions): Promise<Dymsum>;

/** Whether the engine has WebAssembly's 128-bit SIMD. */
export function hasSimd(): boolean;

// ---------------------------------------------------------------------------------------------------------- errors

/** Codes as in C++ (result.h): "cannot_open", "malformed", "self_crossing", "out_of_memory", ... */
export type ErrorCode =
  | 'cannot_open' | 'cannot_write' | 'unsupported_format' | 'malformed' | 'truncated'
  | 'not_finite' | 'too_few_vertices' | 'repeated_vertex' | 'no_area' | 'wrong_orientation' | 'self_crossing' | 'rings_cross'
  | 'hole_outside' | 'parts_overlap'
  | 'bad_index' | 'not_planar' | 'not_closed' | 'not_manifold' | 'faces_cross' | 'not_convex'
  | 'unsupported_operand' | 'rounding_changed_topology' | 'bad_scale' | 'bad_rotation' | 'out_of_range' | 'cancelled'
  | 'out_of_memory'
  /** a broken contract: an argument that the function's description rules out */
  | 'invalid_argument'
  /** a defect of the library */
  | 'defect';

/** Where and what: fields are there only where they apply. Indices count from 0, lines from 1. Ring 0 of a part is its outer ring. */
export interface Evidence {
  file?: string;
  line?: number;
  part?: number;
  ring?: number;
  vertex?: number;
  otherPart?: number;
  otherRing?: number;
  otherVertex?: number;
  face?: number;
  otherFace?: number;
  x?: number;
  y?: number;
  z?: number;
}

/** What went wrong as plain data, for `postMessage` and where an error is a result. */
export interface ErrorData {
  code: ErrorCode;
  /** one sentence, without the evidence */
  reason: string;
  /** with file, line, ring, vertex and position: what the command line prints */
  message: string;
  evidence: Evidence;
}

export class DymsumError extends Error implements ErrorData {
  constructor(data: ErrorData);
  code: ErrorCode;
  reason: string;
  evidence: Evidence;
  /** Plain data that `postMessage` can send; `new DymsumError(data)` makes the error of it again. */
  toData(): ErrorData;
}

// ---------------------------------------------------------------------------------------------------- command line

export interface RunOptions {
  /** Files that the command can read, by their paths: "a.poly", "data/b.wkt". */
  files?: Record<string, string | Uint8Array | ArrayBuffer>;
  stdin?: string | Uint8Array;
  /** What goes to standard error, as it is written: progress among it, with `--progress`. What it throws is lost. */
  onStderr?: (text: string) => void;
}

export interface RunResult {
  /** 0 done; 1 wrong usage; 2 bad input; 3 a defect; 4 the answer is "no" */
  exit: number;
  stdout: string;
  stderr: string;
  /** standard output byte by byte: a .glb written to "-" is no text */
  stdoutBytes: Uint8Array;
  /** The files that the command made, and those whose content it changed. */
  files: Record<string, Uint8Array>;
}

// ------------------------------------------------------------------------------------------------------------ numbers

/** A number at face value, or what a text says exactly: "3/2", "1.01", "1e-3". */
export type ExactInput = number | string | bigint;
/** An exact number as text, "3/2"; integers too: "2/1". */
export type ExactText = string;
export interface ExactPoint { x: ExactText; y: ExactText; }
export interface ExactPoint3 { x: ExactText; y: ExactText; z: ExactText; }
export interface Point { x: number; y: number; }
export interface Point3 { x: number; y: number; z: number; }

/** Radians (the exact orientation within 2^-50 of them), or exactly the one whose half angle has this tangent; "inf" is half a turn. */
export type Angle = number | { tanHalf: ExactInput };

/** The stage's name and its finished share in [0, 1]. Return false to stop: the error is `cancelled`. */
export type Progress = (stage: string, fraction: number) => boolean | void;

/** Stands for "none" in arrays of indices: 2^32 - 1. */
export const NONE: 0xffffffff;

export interface Disposable { dispose(): void; }

// ------------------------------------------------------------------------------------------------------------ regions

/** x, y after x, y; or a list of pairs. */
export type Coordinates = Float64Array | number[] | ReadonlyArray<readonly [number, number]>;
/** The plain lists a region is made from. Outer rings run counter-clockwise, holes clockwise; the first vertex is not repeated. */
export interface RegionData {
  parts: { outer: Coordinates; holes?: Coordinates[] }[];
  polylines?: Coordinates[];
  points?: Coordinates;
}
export type RegionFormat = 'poly' | 'wkt' | 'geojson' | 'svg' | 'json' | 'dxf';

/**
 * A region's rings as flat arrays. Vertex k is at vertices[2 k], vertices[2 k + 1]; ring r has the vertices from
 * ringStarts[r] to ringStarts[r + 1], part i the rings from partStarts[i] to partStarts[i + 1], the outer one first; then
 * polylines, likewise; then points. These are the indices that provenance names; edge k starts at vertex k.
 */
export interface RegionShape {
  vertices: Float64Array;
  ringStarts: Uint32Array;
  partStarts: Uint32Array;
  polylineStarts: Uint32Array;
  /** the first of the points: all vertices from here on */
  firstPoint: number;
}

export interface NamedRegion { name: string; region: Region; }
export interface Repaired { region: Region; changed: boolean; report: string; }

export interface Region extends Disposable {
  readonly empty: boolean;
  readonly vertexCount: number;
  readonly holeCount: number;
  shape(): RegionShape;
  area(): number;
  /** 17 digits, also beyond the range of doubles */
  areaText(): string;
  /** min x, min y, max x, max y */
  bounds(): [number, number, number, number];
  radiusOfGyration(): number;
  negated(): Region;
  translated(dx: number, dy: number): Region;
  scaled(sx: number, sy: number): Region;
  /** The region with one vertex somewhere else, validated: errors name where rings cross. */
  withVertex(index: number, x: number, y: number): Region;
  canonical(): Region;
  equals(other: Region): boolean;
  format(format: RegionFormat): string;
}

/** What becomes of third coordinates and measures (Z and M): errors unless told, or left out, so that what lies above one another coincides. */
export type ThirdCoordinates = 'refused' | 'dropped';

export interface RegionClass {
  /** The file's only shape, or the one after "#" in `name`. The format is that of the name's extension: .poly, .wkt, .geojson, .svg, .json, .dxf; .yaml and .map name their picture, which is not there. */
  read(name: string, bytes: string | Uint8Array | ArrayBuffer, options?: { repair?: boolean; thirdCoordinates?: ThirdCoordinates }): Region;
  /** All shapes of a file. */
  readAll(name: string, bytes: string | Uint8Array | ArrayBuffer, options?: { repair?: boolean; thirdCoordinates?: ThirdCoordinates }): NamedRegion[];
  /** What a file says, not validated: to draw it where it is refused. */
  readData(name: string, bytes: string | Uint8Array | ArrayBuffer, options?: { thirdCoordinates?: ThirdCoordinates }): { name: string; shape: RegionShape }[];
  /** One part: the outer ring, then its holes. */
  fromRings(rings: Coordinates[]): Region;
  fromData(data: RegionData): Region;
  repair(data: RegionData): Repaired;
  empty(): Region;
}

// ------------------------------------------------------------------------------------------------------- planar sums

export type Semantics = 'closed' | 'open' | 'regular';
export type Engine = 'fast' | 'brute' | 'winding';

export interface SumOptions {
  engine?: Engine;
  semantics?: Semantics;
  /** keep the stages for `PlanarSum.trace` */
  trace?: boolean;
  progress?: Progress;
}

/** A segment of the convolution: an edge of one operand added to a vertex of the other. */
export interface Contact { kind: 'edge_of_p' | 'edge_of_q'; p: number; q: number; }

/**
 * All that a sum consists of. `vertices` has those of the rings (as in RegionShape), then those of the pieces and tight
 * features, which name theirs by index. Edge k of a ring runs from vertex k to the ring's next one.
 */
export interface SumShape {
  /** within `atError` of the exact positions */
  vertices: Float64Array;
  ringStarts: Uint32Array;
  partStarts: Uint32Array;
  /** pieces of the set without area: two vertices each; one each */
  segments: Uint32Array;
  points: Uint32Array;
  /** touching without overlap is allowed only exactly here: two vertices each; one each */
  tightSegments: Uint32Array;
  tightPoints: Uint32Array;
  /**
   * Provenance. Of vertex k six numbers from 6 k on: the segment that arrives and the one that leaves, each as kind (0: an edge
   * of P + a vertex of Q, 1: a vertex of P + an edge of Q), index in P, index in Q. The edge that starts at vertex k is the one
   * that leaves.
   */
  contacts: Uint32Array;
  /** Of vertex k the vertices of P and Q that it is the sum of, from 2 k on; NONE, NONE where two edges cross. */
  corners: Uint32Array;
  atError: number;
}

export interface SumStats {
  tierBits: number;
  reducedSegments: number;
  liveSegments: number;
  cellEntries: number;
  pairTests: number;
  crossings: number;
  degenerateNodes: number;
  loops: number;
  collisionTests: number;
  filteredSigns: number;
  exactSigns: number;
  maskGrid: number;
  peakBytes: number;
  stages: { name: string; ms: number }[];
}

/** The stages as data: positions are rounded. */
export interface PlanarTrace {
  /** x, y, x, y of each */
  convolution: Float64Array;
  /** of each: 1 for an edge of P + a vertex of Q */
  convolutionEdgeOfP: Uint8Array;
  /** low x, low y, high x, high y of each */
  maskedCells: Float64Array;
  crossings: Float64Array;
  keptLoops: { vertices: Float64Array; starts: Uint32Array };
  droppedLoops: { vertices: Float64Array; starts: Uint32Array };
  tightPoints: Float64Array;
  tightSegments: Float64Array;
}

/** What became of an exact set in doubles: counts, and how far set and region are from each other at most. */
export interface Rounding {
  nearest: boolean;
  mergedVertices: number; collapsedEdges: number; bends: number; lines: number; points: number; vanishedRings: number;
  moved: number; movedUlps: number;
}

export interface PlanarSum extends Disposable {
  shape(): SumShape;
  readonly vertexCount: number;
  readonly holeCount: number;
  readonly partCount: number;
  stats(): SumStats;
  trace(): PlanarTrace | null;
  area(): number;
  areaText(): string;
  /** null where the fraction would have more than so many bits (2^20 unless told) */
  areaExact(bits?: number): ExactText | null;
  /** The exact position of a vertex of `shape().vertices`. */
  exact(vertex: number): ExactPoint;
  /** The set rounded to doubles; `repair` merges what collides. */
  rounded(options?: { repair?: boolean }): Region;
  /** rounded() where that has an answer, else by snap rounding: always a region, and what became of the set */
  snapRounded(): { region: Region; rounding: Rounding };
  equals(other: PlanarSum): boolean;
  /** with tight features, as the command line writes it */
  format(format: RegionFormat): string;
  /** Rings with rounded and exact coordinates, and provenance. */
  toJson(): string;
}

/** What an operation takes: a region, or the exact result of another one (what open semantics left out of it counts again). */
export type PlanarOperand = Region | PlanarSum;

/**
 * Of Boolean operations. Closed: what is taken away is open, and what has no interior is in `segments` and `points`; open: operands
 * are open, and such pieces are tight features; regular: the closure of the interior.
 */
export interface BooleanOptions { semantics?: Semantics; progress?: Progress; }

export interface ConvolutionSizes { full: number; kinetic: number; reduced: number; }

// ------------------------------------------------------------------------------------------- planar sums that move

export interface MovingOptions {
  moving?: 'p' | 'q';
  /** P (+) -Q; provenance refers to Q */
  reflectQ?: boolean;
  semantics?: Semantics;
  mode?: 'automatic' | 'window' | 'rebuild';
  window?: number;
  keptWindowBytes?: number;
  progress?: Progress;
}

export interface FrameWork {
  rebuilt: boolean;
  newWindow: boolean;
  degenerate: boolean;
  pieces: number;
  candidates: number;
  piecesRepaired: number;
  listsChanged: number;
  crossingsChanged: number;
  loopsTraced: number;
  loopsKept: number;
  witnessed: number;
  witnessesLost: number;
  collisionTests: number;
  exactSigns: number;
  windowLow: number;
  windowHigh: number;
  ms: number;
  peakBytes: number;
}

export interface RingChange {
  kind: 'appeared' | 'disappeared' | 'reshaped' | 'moved';
  ring: number;
  verticesAppeared: number;
  verticesDisappeared: number;
}
export interface FrameChanges { rings: RingChange[]; tightPoints: number; tightSegments: number; topology: boolean; }

/** What follows a motion. `set` moves, and changes nothing where it throws. */
interface MovingPlanarSum extends Disposable {
  /** The geometry of the sum now: what a frame draws. */
  shape(): SumShape;
  /** The sum now, as an object that later moves leave as it is. */
  sum(): PlanarSum;
  /** identities of the rings, part by part, outer ring first */
  ringIds(): Float64Array;
  work(): FrameWork;
}

export interface ScaleEvent {
  s: ExactText;
  approx: number;
  /** in the plane the first two, of solids the others */
  kind: 'vertex_on_segment' | 'three_segments' | 'vertex_on_facet' | 'edge_on_edge' | 'four_facets' | 'coplanar_facets';
  visible: boolean;
  topology: boolean;
}

export interface ScalingSum extends MovingPlanarSum {
  /** To a scale; or to diag(s, sy). */
  set(s: ExactInput, sy?: ExactInput): FrameChanges;
  scale(): { approx: number; exact: ExactText };
  events(from: ExactInput, to: ExactInput, progress?: Progress): ScaleEvent[];
  nextEvent(after: ExactInput, limit: ExactInput, change?: 'visible' | 'topology', progress?: Progress): ScaleEvent | null;
  /** sixteen hexadecimal digits */
  combinatorialHash(): string;
}

export interface RotatingSum extends MovingPlanarSum {
  set(angle: Angle): FrameChanges;
  orientation(): { radians: number; tanHalf: ExactText };
}

/**
 * What a sum of a family has from cell `firstCell` to `lastCell`: a vertex by its contacts, and the vertices that it is the sum of; the
 * contact of an edge, which is `in` and `out`; a hole by its identity. Cell k lies before event k, and after the one before.
 */
export interface Lifetime {
  feature: 'vertex' | 'edge' | 'hole';
  in: Contact | null;
  out: Contact | null;
  cornerP: number | null;
  cornerQ: number | null;
  hole: number | null;
  firstCell: number;
  lastCell: number;
}
/** All sums s P (+) Q of an interval of scales, as one object. */
export interface ScalingFamily extends Disposable {
  /** The sum at a scale of the interval. */
  at(s: ExactInput): PlanarSum;
  /** All of the interval, each scale once. */
  events(): ScaleEvent[];
  changes(from: ExactInput, to: ExactInput, change?: 'visible' | 'topology'): ScaleEvent[];
  lifetimes(): Lifetime[];
  /** Identities of the rings of the sum at a scale, by which lifetimes name holes; 0 where a ring has none. */
  ringIds(s: ExactInput): Float64Array;
  /** What lies in the sum at some scale, and at every one. */
  outer(from: ExactInput, to: ExactInput): PlanarSum;
  inner(from: ExactInput, to: ExactInput): PlanarSum;
}

export interface EditOptions {
  semantics?: Semantics;
  /** P (+) -Q; edits refer to Q */
  reflectQ?: boolean;
  mode?: 'automatic' | 'window' | 'rebuild';
  /** that are kept */
  undoSteps?: number;
  progress?: Progress;
}
/** The work of one step. */
export interface EditWork {
  rebuilt: boolean;
  degenerate: boolean;
  segmentsRemoved: number;
  segmentsAdded: number;
  cellsChanged: number;
  cellsUncovered: number;
  pairsTested: number;
  eventsChanged: number;
  loopsTraced: number;
  loopsKept: number;
  collisionTests: number;
  exactSigns: number;
  ms: number;
}
/** P (+) Q, which follows edits of P and of Q, exactly. */
export interface EditableSum extends Disposable {
  /**
   * Makes all edits as one step, a line each: `p move 3 1 2`, `q insert 0 0.5 1`, `p remove 4`, `p extrude 2 5 0 1`, `p invert 3`,
   * `p add-hole 0 1 1 1 2 2 2`, ... (docs/guide/editing.md). Nothing changes where it throws.
   */
  edit(lines: string): FrameChanges;
  undo(): FrameChanges;
  redo(): FrameChanges;
  undoCount(): number;
  redoCount(): number;
  /** an operand as it is */
  region(operand: 'p' | 'q'): Region;
  /** by index; they last while vertices move, come and go */
  vertexNames(operand: 'p' | 'q'): Float64Array;
  ringIds(): Float64Array;
  /** The geometry of the sum now. */
  shape(): SumShape;
  /** The sum now, as an object that later steps leave as it is. */
  sum(): PlanarSum;
  work(): EditWork;
  /** sixteen hexadecimal digits, equal for equal sums */
  hash(): string;
}

// -------------------------------------------------------------------------------------------- scales that fit, depth

export interface ScaleContact {
  kind: 'vertex_on_edge' | 'edge_on_vertex' | 'vertex_on_vertex';
  part: number;
  obstacle: number;
  leg: number;
  along: ExactText;
  at: ExactPoint;
}
export interface ScaleInterval { low: ExactText | null; high: ExactText | null; atLow: ScaleContact[]; atHigh: ScaleContact[]; }
export interface ScaleRange { free: ScaleInterval[]; trap: ExactText | null; critical: number; tested: number; }

/** `vertex` index of a region, or the `edge` that starts there. */
export interface PlanarFeature { kind: 'vertex' | 'edge'; index: number; }
/**
 * Features that touch: their relative interiors have a point (`dimension` 0) or a segment (1) in common, of which `at` is a
 * position. `patch`: the connected piece of all that touches.
 */
export interface PlanarTouch { p: PlanarFeature; q: PlanarFeature; dimension: 0 | 1; at: ExactPoint; approx: Point; patch: number; }
/** `contacts`: all pairs that touch once Q is moved, the greatest dimension first. */
export interface PlanarWay { move: ExactPoint; approx: Point; direction: Point; contacts: PlanarTouch[]; }
export interface PlanarDistance {
  meeting: 'overlapping' | 'touching' | 'apart';
  squared: ExactText;
  distance: number;
  ways: PlanarWay[];
}
/** Penetration depth and distance of two regions, of which Q is moved. */
export interface PlanarDepth extends Disposable { at(x?: number, y?: number): PlanarDistance; }

// ---------------------------------------------------------------------------------------------------- near a place

/** How what is near the place is found; all give the same part. */
export type LocalEngine = 'updated' | 'hierarchy' | 'brute';
export interface PlanarPose { rotation?: Angle; scale?: ExactInput | readonly [ExactInput, ExactInput]; }
/** A box, or a disc: which selects edges, and whose bounding box cuts them. */
export type PlanarPlace = { low: Point; high: Point } | { middle: Point; radius: number };
export interface PlanarLocalSum extends Disposable { in(place: PlanarPlace, p?: PlanarPose, q?: PlanarPose): PlanarLocalPart; }
/** What the place cuts out of the boundary of P (+) Q. */
export interface PlanarLocalPart extends Disposable {
  readonly where: 'crossed' | 'inside' | 'outside';
  box(): { low: Point; high: Point };
  /** edges and tight segments as pairs of vertices, the sum on the left of an edge */
  shape(): { vertices: Float64Array; edges: Uint32Array; edgeContacts: Contact[]; tightSegments: Uint32Array; tightPoints: Uint32Array };
  exact(vertex: number): ExactPoint;
  equals(other: PlanarLocalPart): boolean;
  svg(): string;
}
export type SolidPlace = { low: Point3; high: Point3 } | { middle: Point3; radius: number };
export interface LocalSum extends Disposable {
  /** `boundary` is open where the box cuts it: volume, rounded and mesh are of no use. */
  in(place: SolidPlace, p?: SolidPose, q?: SolidPose): { where: 'crossed' | 'inside' | 'outside'; box: { low: Point3; high: Point3 }; boundary: SpatialSum };
}

/** Whether points lie in a sum, for many points. */
export interface SumLocator extends Disposable {
  contains(at: { x: ExactInput; y: ExactInput }): boolean;
  /** 1: inside */
  containsEach(points: Coordinates, progress?: Progress): Uint8Array;
}

// -------------------------------------------------------------------------------------- the obstacle in (x, y, theta)

export interface Configuration { x: number; y: number; theta: number; }
export interface EventAngle { theta: number; low: number; high: number; exactTanHalf: ExactText | null; }
export interface ObstacleEvent { kind: 'alignment' | 'vertex_on_segment' | 'three_segments' | 'tight'; angle: number; at: Point; }
/** Free at one angle only: a point, where `from` equals `to`, or a segment. */
export interface ObstacleTight { angle: number; from: Point; to: Point; error: number; }
/** A piece of ruled surface; `begin` and `end` are indices of angles, NONE, NONE: at every angle. In contacts `p` is the obstacle, `q` the robot. */
export interface Patch {
  contact: Contact; left: Contact; right: Contact;
  leftCorner: boolean; rightCorner: boolean;
  begin: number; end: number; shell: number; rotating: boolean;
}
export interface Shell { outer: boolean; patches: number; euler: number; freeComponent: number; }
export interface ObstacleWork {
  windows: number; segments: number; candidatePairs: number; candidateTriples: number; surfaces: number; potentialEvents: number; visibleEvents: number;
  alignments: number; vertexEvents: number; tripleEvents: number; tightEvents: number;
  localUpdates: number; slices: number; exactSigns: number; collisionTests: number; ms: number;
}

/** The boundary as triangles; vertices are x, y, theta. */
export interface ObstacleMeshShape {
  vertices: Float64Array;
  triangles: Uint32Array;
  /** of each triangle: its patch; whether it lies in the plane of an event angle */
  patches: Uint32Array;
  closing: Uint8Array;
  extent: number;
  tolerance: number;
  watertight: boolean;
}

export interface Clearance {
  /** negative inside the obstacle: the depth */
  distance: number;
  error: number;
  patch: number | null;
  nearest: Configuration;
  /** of that patch: what touches; p is the obstacle, q the robot */
  contact: Contact | null;
}
export interface FreeAngles { begin: number; end: number; beginError: number; endError: number; beginPatch: number | null; endPatch: number | null; }

export interface Waypoint extends Configuration {
  move: 'start' | 'translation' | 'counter_clockwise' | 'clockwise';
  exact: { x: ExactText; y: ExactText; tanHalf: ExactText };
}
export interface FreeComponent { index: number; unbounded: boolean; allAngles: boolean; from: number; to: number; shells: number[]; }
export interface NoPath {
  kind: 'start_not_free' | 'goal_not_free' | 'separated' | 'undecided';
  text: string;
  contact: Contact | null;
  start: FreeComponent[];
  goal: FreeComponent[];
  limit: { outOfTime: boolean; seconds: number; passage: { from: number; to: number; reached: Point; beyond: Point } | null } | null;
  unexaminedAngles: number;
}
export interface Plan {
  path: Waypoint[];
  reason: NoPath | null;
  work: { levels: number; slices: number; rotations: number; refinements: number; ms: number };
}
export interface PlanOptions { touching?: 'allowed' | 'forbidden'; timeLimitSeconds?: number; progress?: Progress; }

export interface CspaceObstacle extends Disposable {
  angles(): EventAngle[];
  events(): ObstacleEvent[];
  tight(): ObstacleTight[];
  patches(): Patch[];
  shells(): Shell[];
  work(): ObstacleWork;
  mayHaveTightCurves(): boolean;
  /** O (+) -R(theta), exactly; provenance: P is the obstacle, Q the robot. */
  slice(angle: Angle, semantics?: Semantics): PlanarSum;
  /** The boundary at an angle between events as loops of patches, from what is there: x, y of every patch's start. Faster than `slice`, in doubles. */
  outline(angle: Angle): { vertices: Float64Array; starts: Uint32Array; patches: Uint32Array } | null;
  contains(x: number, y: number, angle: Angle): boolean;
  /** Where the patch starts and ends at an angle. */
  patchEnds(patch: number, theta: number): [Point, Point];
  mesh(options?: { tolerance?: number; progress?: Progress }): ObstacleMeshShape;
  queries(): ObstacleQueries;
  plan(start: Configuration, goal: Configuration, options?: PlanOptions): Plan;
  /** a .glb of the mesh, as `dymsum cspace -o` */
  glb(options?: { tolerance?: number }): Uint8Array;
  /** the text of an .obstacle file */
  format(): string;
}

export interface ObstacleQueries extends Disposable {
  contains(at: Configuration): boolean;
  freeAngles(x: number, y: number): FreeAngles[];
  /** `weight`, a length per radian: Infinity counts translations alone; else the robot's radius of gyration. */
  clearance(at: Configuration, options?: { weight?: number; touching?: 'allowed' | 'forbidden' }): Clearance;
  gyrationRadius(): number;
}

export interface PathCheck {
  outcome: 'free' | 'blocked' | 'undecided';
  piece: number;
  /** what that piece does: it translates, it rotates */
  moves: boolean;
  turns: boolean;
  low: number;
  high: number;
  at: Configuration;
  contact: Contact | null;
  /** how many were examined */
  pieces: number;
}

// ------------------------------------------------------------------------------------------------------------- solids

export type MeshFormat = 'off' | 'obj' | 'stl' | 'ply' | 'glb';
export interface MeshData {
  /** x, y, z after x, y, z */
  vertices: Float64Array | number[];
  /** triangles, three indices each; or lists of any length */
  faces: Uint32Array | number[][];
}
/** For drawing: triangles of the mesh's own vertices, and the face that each is a part of. */
export interface MeshShape {
  vertices: Float64Array;
  triangles: Uint32Array;
  triangleFaces: Uint32Array;
  /** face k has the corners from faceStarts[k] to faceStarts[k + 1] */
  faceStarts: Uint32Array;
  faceVertices: Uint32Array;
}
export interface RepairedMesh { mesh: Mesh; changed: boolean; report: string; }

export interface Mesh extends Disposable {
  readonly empty: boolean;
  readonly vertexCount: number;
  readonly faceCount: number;
  readonly shellCount: number;
  shape(): MeshShape;
  volume(): number;
  surfaceArea(): number;
  /** min x, y, z, max x, y, z */
  bounds(): [number, number, number, number, number, number];
  /** null for a convex solid, else why it is none */
  convexityError(): ErrorData | null;
  negated(): Mesh;
  translated(dx: number, dy: number, dz: number): Mesh;
  scaled(sx: number, sy: number, sz: number): Mesh;
  convexHull(): Mesh;
  equals(other: Mesh): boolean;
  format(format: MeshFormat): Uint8Array;
}
export interface MeshClass {
  /** The format is that of the name's extension: .off, .obj, .stl, .ply. `repair` is before `hull`; with `thinParts` parts without volume stay. */
  read(name: string, bytes: string | Uint8Array | ArrayBuffer, options?: { repair?: boolean; hull?: boolean; thinParts?: boolean }): Mesh;
  /** What a file says, not validated: to draw it where it is refused. */
  readData(name: string, bytes: string | Uint8Array | ArrayBuffer): { vertices: Float64Array; faceStarts: Uint32Array; faceVertices: Uint32Array };
  fromData(data: MeshData, options?: { thinParts?: boolean }): Mesh;
  /** `thinParts`: points, segments and open surfaces stay. */
  repair(data: MeshData, options?: { thinParts?: boolean }): RepairedMesh;
  convexHull(points: Float64Array | number[]): Mesh;
}

export interface SolidFeature { kind: 'vertex' | 'edge' | 'face'; a: number; b: number; }
export interface SolidContact { p: SolidFeature; q: SolidFeature; }

export interface SolidScaleContact { part: SolidFeature; obstacle: SolidFeature; leg: number; along: ExactText; at: ExactPoint3; }
export interface SolidScaleInterval { low: ExactText | null; high: ExactText | null; atLow: SolidScaleContact[]; atHigh: SolidScaleContact[]; }
export interface SolidScaleRange { free: SolidScaleInterval[]; trap: ExactText | null; critical: number; tested: number; }

/** `moved`: no vertex between the two operations was moved by more; 0: exact. */
export interface SolidOpening { solid: SpatialSum; moved: number; }
/** The exact offset by `low` lies in the solid, and the solid in that by `high`. */
export interface SolidOffset { solid: SpatialSum; low: number; high: number; ballFacets: number; }

export interface SpatialOptions {
  engine?: 'fast' | 'brute';
  semantics?: Semantics;
  tight?: boolean;
  /** bytes; 0: no limit */
  memory?: number;
  progress?: Progress;
}
/** Of Boolean operations on solids, which are closed and regular. */
export interface SolidBooleanOptions {
  /** bytes; 0: no limit */
  memory?: number;
  progress?: Progress;
}
/** The directions of a part's axes: doubles of few digits. */
export type PartAxes = readonly [Point3, Point3, Point3];
export interface PlanesOptions {
  /** The most that a vertex may move; else 2^-40 of the part's size (2^-20 in single precision). */
  tolerance?: number;
  memory?: number;
  progress?: Progress;
}
/** `largestMove`: no vertex is further from where it was; `merged`: coordinates that became one with another one. */
export interface SolidByPlanes {
  /** one sentence with all of the below */
  report: string;
  solid: SpatialSum;
  axes: PartAxes[];
  tolerance: number;
  largestMove: number;
  merged: number;
  /** polygons in no plane, which became triangles */
  bentFaces: number;
}
/** Two directions, as columns. */
export type RingAxes = [Point, Point];
export interface LinesOptions {
  /** The most that a vertex may move; else 2^-40 of the region's size, 8 units of the last digit in single precision or decimals. */
  tolerance?: number;
  progress?: Progress;
}
/** `largestMove`: no vertex is further from where it was; `merged`: coordinates, and lines, that became one with another one. */
export interface RegionByLines {
  /** one sentence with all of the below */
  report: string;
  region: PlanarSum;
  axes: RingAxes[];
  tolerance: number;
  largestMove: number;
  merged: number;
  /** edges parallel to others but for rounding, and left so */
  looseEdges: number;
}
/**
 * A sum of solids, for drawing. `triangles` index `vertices`, which are those of the sum (`exact` takes their indices).
 * Features are three numbers: kind (0 vertex, 1 edge, 2 face), a, b; see SolidFeature.
 */
export interface SpatialShape {
  vertices: Float64Array;
  triangles: Uint32Array;
  /** of each triangle: its face */
  triangleFaces: Uint32Array;
  /** of each face from 6 k on: the feature of P, the feature of Q that touch there */
  faceContacts: Uint32Array;
  faceShells: Uint32Array;
  /** two vertices each: to draw the outlines of faces */
  edges: Uint32Array;
  tightTriangles: Uint32Array;
  tightSegments: Uint32Array;
  tightPoints: Uint32Array;
  atError: number;
}
export interface SpatialStats {
  bits: number; faceVertex: number; edgeEdge: number; innerFacets: number; boxPairs: number; contacts: number;
  points: number; cells: number; patches: number; collisionTests: number; tightTests: number; doublePairSigns: number;
  exactSigns: number;
  heldBytes: number; stages: { name: string; ms: number }[];
}
export interface SpatialSum extends Disposable {
  readonly shellCount: number;
  readonly faceCount: number;
  readonly vertexCount: number;
  shape(): SpatialShape;
  stats(): SpatialStats;
  volume(): number;
  area(): number;
  /** null where the fraction would have more than so many bits (2^20 unless told) */
  volumeExact(bits?: number): ExactText | null;
  exact(vertex: number): ExactPoint3;
  /** What touches at a tight face, segment or point. */
  tightContacts(): { faces: SolidContact[][]; segments: SolidContact[][]; points: SolidContact[][] };
  /** The regular part as an operand of further sums. */
  asMesh(): Mesh;
  equals(other: SpatialSum): boolean;
  /** As `dymsum sum -o` writes it: rounded once, of convex solids a convex solid with whole faces; error rounding_changed_topology where that would spoil it, but not of a glb, which is a picture. */
  format(format: MeshFormat): Uint8Array;
  /** As `dymsum sum -o sum.json`: exact vertices, edges, faces and what is tight, with provenance. */
  toJson(): string;
}

/** How P or Q stands: x -> rotation (diag(scale) x). Rounded to exact rational rotations, see `Rotation`. */
export interface SolidPose {
  rotation?: Rotation;
  scale?: ExactInput | readonly [ExactInput, ExactInput, ExactInput];
}
/** About an axis, counter-clockwise seen from its tip; or a quaternion w, x, y, z of any length (exact for integers up to 2^30). */
export type Rotation = { axis: readonly [number, number, number]; angle: number } | { quaternion: readonly [number, number, number, number] };

export interface MovingSolidOptions { semantics?: Semantics; tight?: boolean; mode?: 'automatic' | 'window' | 'rebuild'; progress?: Progress; }
export interface SolidFrameWork {
  rebuilt: boolean; normalsChecked: number; pairsChecked: number; facets: number; facetsAdded: number; facetsRemoved: number;
  innerKept: number; innerTested: number; contacts: number; exactSigns: number; ms: number;
}
export interface SolidFrameChanges {
  appeared: SolidContact[]; disappeared: SolidContact[]; changed: SolidContact[];
  shells: number; tightFaces: number; tightSegments: number; tightPoints: number;
}
/** A sum of solids of any shape that follows the poses of both. */
export interface MovingSolidSum extends Disposable {
  set(p: SolidPose, q?: SolidPose): SolidFrameWork;
  shape(): SpatialShape;
  /** Of each face of `shape()`: 0 as before, 1 appeared, 2 changed by the last `set`. */
  faceChanges(): Uint8Array;
  sum(): SpatialSum;
  work(): SolidFrameWork;
  changes(): SolidFrameChanges;
}

/** The sum of two convex solids that turn and scale. */
export interface ConvexSum extends Disposable {
  set(p: SolidPose, q?: SolidPose): MotionWork;
  work(): MotionWork;
  /** For renderers: indices of vertices and facets stay as long as they are there. */
  buffers(): ConvexBuffers;
  volume(): number;
  volumeExact(): ExactText;
  support(direction: Point3): { p: number; q: number; at: Point3 };
  /** how deep a point (the origin unless told) lies in the sum */
  depth(point?: Point3): ConvexDepth;
  facetCount(): { all: number; changed: number };
  /** at the poses that were set; the same as of all solids */
  sum(): SpatialSum;
  /** rounded: valid convex mesh */
  mesh(): Mesh;
  /** the exact position of a vertex of `buffers()` */
  exact(vertex: number): ExactPoint3;
  /** As `dymsum sum -o` of convex solids writes it; what the last `set` changed is red in a glb. */
  format(format: MeshFormat): Uint8Array;
  /** Likewise `-o sum.json`. */
  toJson(): string;
}
export interface MotionWork {
  vertexChecks: number; vertexErrors: number; crossingChecks: number; arcChecks: number; arcsChanged: number;
  steps: number; facetsAdded: number; facetsRemoved: number; exactSigns: number;
}
export interface ConvexBuffers {
  /** x, y, z of every vertex, single precision */
  positions: Float32Array;
  /** 0, 0, 0 where an index is free */
  triangles: Uint32Array;
  /** of each triangle: the facet */
  triangleFacets: Uint32Array;
  /** of each facet from 6 k on: the features of P and of Q */
  facetContacts: Uint32Array;
  /** of each facet: 0 as before, 1 appeared, 2 changed by the last motion */
  facetChanges: Uint8Array;
  vertexCount: number;
  facetCount: number;
}
export interface ConvexDepth { inside: boolean; depth: number; depthSquared: ExactText; direction: Point3; p: SolidFeature; q: SolidFeature; }

/** As PlanarTouch; of a face and a face that lie in one plane the `dimension` is 2. */
export interface SolidTouch { p: SolidFeature; q: SolidFeature; dimension: 0 | 1 | 2; at: ExactPoint3; approx: Point3; patch: number; }
/** `contacts`: all pairs that touch once Q is moved, the greatest dimension first. */
export interface SolidWay { move: ExactPoint3; approx: Point3; direction: Point3; contacts: SolidTouch[]; }
export interface SolidDistance {
  meeting: 'overlapping' | 'touching' | 'apart';
  squared: ExactText;
  distance: number;
  ways: SolidWay[];
  complete: boolean;
  atLeast: number;
  work: { facets: number; candidates: number; exactTests: number; collisionTests: number };
}
/** Penetration depth and distance of two solids of any shape, of which Q is moved. */
export interface SolidDepth extends Disposable {
  at(x?: number, y?: number, z?: number, timeLimitSeconds?: number): SolidDistance;
  readonly facetCount: number;
}

/**
 * The shortest way out of two solids of any shape, of which Q turns about its origin and moves. The nearest place is found in
 * doubles: an overlap below 2^-46 of the sizes counts as touching and is not `inside`, though `depthSquared` is exact; `p` and
 * `q` touch there within that error. Without a turn SolidDepth is exact, and names all that touches.
 */
export interface TurnedDepth extends Disposable { at(q: Point3, turned?: Rotation): ConvexDepth; }

export interface SolidScaleEvents extends Disposable {
  at(s: ExactInput, progress?: Progress): SpatialSum;
  events(from: ExactInput, to: ExactInput, progress?: Progress): ScaleEvent[];
  nextEvent(after: ExactInput, limit: ExactInput, change?: 'visible' | 'topology', progress?: Progress): ScaleEvent | null;
}

export interface SolidRotationEvent {
  radians: number;
  exactT: ExactText | null;
  polynomial: string[];
  contacts: { kind: string; at: Point3; features: SolidContact[] }[];
  visible: boolean;
  topology: boolean;
}
export interface SolidRotationEvents extends Disposable {
  at(radians: number, progress?: Progress): SpatialSum;
  /** from `from` counter-clockwise to `to`, in radians */
  events(from: number, to: number, progress?: Progress): SolidRotationEvent[];
}

export interface SolidSlice extends Disposable {
  readonly section: PlanarSum;
  /** parts of the section in which the solids only touch, as rings */
  touching(): { vertices: Float64Array; ringStarts: Uint32Array; partStarts: Uint32Array };
}

// ------------------------------------------------------------------------------------------ growing discs and features

export type DiscSide = 'outside' | 'inside';
/** A radius, or exactly the one of an event of that side. */
export type DiscRadius = ExactInput | { event: number };
export interface DiscEvent { radius: number; nodes: number; }
/** A segment or an arc, from (x, y) to where the next one of the ring begins. */
export interface DiscPiece {
  of: 'edge' | 'vertex' | 'disc';
  /** the edge or vertex of the region, where it is one */
  index: number;
  x: number;
  y: number;
  /** of an arc: centre, direction of its start seen from there, and the angle covered, positive counter-clockwise */
  arc: { cx: number; cy: number; fromAngle: number; sweep: number } | null;
  corner: 'none' | 'vertex' | 'centre' | 'contact' | 'crossing';
}
export interface DiscShape {
  parts: { outer: DiscPiece[]; holes: DiscPiece[][] }[];
  /** x, y, x, y of each */
  segments: Float64Array;
  points: Float64Array;
  tightSegments: Float64Array;
  tightPoints: Float64Array;
  radius: number;
  radiusExact: string;
  atError: number;
}
export interface Measured { value: number; error: number; }
export interface DiscSet extends Disposable {
  shape(): DiscShape;
  area(): Measured;
  perimeter(): Measured;
  bounds(): [number, number, number, number];
  /** segments in place of arcs */
  toRegion(error: number, bound?: 'inside' | 'outside' | 'nearest'): { region: Region; error: number; chords: number; collapsed: number };
  /** with true arcs */
  svg(over: Region): string;
  toJson(): string;
}
/** All discs of a region at once. */
export interface GrowingDisc extends Disposable {
  events(side: DiscSide, progress?: Progress): DiscEvent[];
  sumAt(radius: DiscRadius, semantics?: Semantics): DiscSet;
  erodedAt(radius: DiscRadius, semantics?: Semantics): DiscSet;
  openedAt(radius: DiscRadius, semantics?: Semantics): DiscSet;
  closedAt(radius: DiscRadius, semantics?: Semantics): DiscSet;
}

export interface FeatureOptions {
  concavity?: 'straight_line' | 'shortest_path' | 'hybrid1' | 'hybrid2';
  hybridTolerance?: number;
  progress?: Progress;
}
/** A bar of the barcode. alpha is the diameter of the disc; `deathAlpha` is Infinity for what never dies. */
export interface FeatureBar {
  born: 'corner' | 'neck';
  died: 'merged' | 'filled' | 'never';
  birth: number;
  death: number | null;
  birthAlpha: number;
  deathAlpha: number;
  parent: number | null;
  vertex: number | null;
  minimum: number | null;
  concavity: number;
  /** The diameter from which significant() counts its life, rounded. */
  countsFrom: number;
  /** How much it counts; infinity for gaps that never end. */
  significance: number;
  inHole: boolean;
  loop: number;
}
export interface BridgeContact { atVertex: boolean; index: number; x: number; y: number; }
export interface AlphaBridge {
  from: BridgeContact; to: BridgeContact; centre: Point; gap: boolean; length: number; bar: number;
  minimum: number | null; concavity: number; pocketSize: number;
}
export interface Cut {
  vertex: number; end: 'vertex' | 'edge' | 'cut'; index: number;
  from: Point; to: Point; exactFrom: ExactPoint; exactTo: ExactPoint; bar: number; partner: boolean;
  /** x, y, x, y of each stretch that separates pieces */
  runs: Float64Array;
}
export interface Decomposition {
  cuts: Cut[];
  /** rounded: rings as in RegionShape, each piece a part */
  pieces: { vertices: Float64Array; ringStarts: Uint32Array; partStarts: Uint32Array };
  /** of each piece a number from 0 to 5, different for neighbours */
  colours: number[];
  /** of each piece */
  areas: number[];
}
export interface DecomposeOptions { persistence?: ExactInput; alphaFrom?: ExactInput; alphaTo?: ExactInput; progress?: Progress; }
export interface ShapeFeatures extends Disposable {
  bars(): FeatureBar[];
  readonly eventCount: number;
  eventAlpha(event: number): number;
  eventText(event: number): string;
  bridges(alpha: ExactInput): AlphaBridge[];
  lasting(life: ExactInput, from?: ExactInput, to?: ExactInput): Uint32Array;
  significant(significance: ExactInput, from?: ExactInput, to?: ExactInput): Uint32Array;
  decompose(options?: DecomposeOptions): Decomposition;
}

// --------------------------------------------------------------------------------------------------------- the module

export interface Dymsum extends Live {
  /** `dymsum` with these arguments (the verb first), on files in memory. Each call starts anew. */
  run(args: string[], options?: RunOptions): Promise<RunResult>;
}

export interface Live {
  readonly version: string;
  readonly simd: boolean;

  readonly Region: RegionClass;
  readonly Mesh: MeshClass;

  /** P (+) Q of regions and results, or of solids: of a result what is tight does not count. */
  minkowskiSum(p: PlanarOperand, q: PlanarOperand, options?: SumOptions): PlanarSum;
  minkowskiSum(p: Mesh, q: Mesh, options?: SpatialOptions): SpatialSum;
  minkowskiSum(p: SpatialSum, q: Mesh | SpatialSum, options?: SpatialOptions): SpatialSum;
  /** A (+) -B: where B's reference point may stand so that B meets A. With `semantics: 'open'` exact fits are its tight features. */
  nfp(a: PlanarOperand, b: PlanarOperand, options?: SumOptions): PlanarSum;
  /** { x : x + Q inside P }; positions without freedom are `segments` and `points`. */
  erode(p: PlanarOperand, q: PlanarOperand, options?: SumOptions): PlanarSum;
  erode(p: Mesh, q: Mesh, options?: SpatialOptions): SpatialSum;
  erode(p: SpatialSum, q: Mesh | SpatialSum, options?: SpatialOptions): SpatialSum;
  /** What lies in one of the operands; of none it is an empty planar set. */
  united(sets: PlanarOperand[], options?: BooleanOptions): PlanarSum;
  united(solids: Mesh[], options?: SolidBooleanOptions): SpatialSum;
  /** What lies in both. */
  intersection(a: PlanarOperand, b: PlanarOperand, options?: BooleanOptions): PlanarSum;
  intersection(a: Mesh, b: Mesh, options?: SolidBooleanOptions): SpatialSum;
  /** What lies in `a` and not in `b`. */
  difference(a: PlanarOperand, b: PlanarOperand, options?: BooleanOptions): PlanarSum;
  difference(a: Mesh, b: Mesh, options?: SolidBooleanOptions): SpatialSum;
  /** What lies in one of both alone. */
  symmetricDifference(a: PlanarOperand, b: PlanarOperand, options?: BooleanOptions): PlanarSum;
  symmetricDifference(a: Mesh, b: Mesh, options?: SolidBooleanOptions): SpatialSum;
  /** The solid whose faces are plane and parallel where those of the data are but for rounding. */
  byPlanes(data: MeshData, options?: PlanesOptions): SolidByPlanes;
  /** Of several, with axes in common where that loses no planes: faces that are parallel in both stay so. */
  byPlanes(data: MeshData[], options?: PlanesOptions): SolidByPlanes[];
  /** The region whose edges are parallel, at right angles and on common lines where those of the region are but for rounding. */
  byLines(region: Region, options?: LinesOptions): RegionByLines;
  /** Of several: what is parallel in two of them is so exactly. */
  byLines(regions: Region[], options?: LinesOptions): RegionByLines[];
  /** (A (-) B) (+) B and (A (+) B) (-) B; `between: 'rounded'` where positions between the two are no doubles */
  opening(a: Mesh, b: Mesh, options?: SpatialOptions & { between?: 'exact' | 'rounded' }): SolidOpening;
  closing(a: Mesh, b: Mesh, options?: SpatialOptions & { between?: 'exact' | 'rounded' }): SolidOpening;
  /** grown, or for a negative distance shrunk, by a ball of plane facets with this tolerance */
  offset(mesh: Mesh, distance: number, tolerance: number, options?: SpatialOptions & { bound?: 'inside' | 'outside' }): SolidOffset;
  /** The union of regions, with the options of sums. */
  unionOf(regions: Region[], options?: SumOptions): PlanarSum;
  /** R(theta) P (+) Q */
  rotatedSum(p: Region, q: Region, angle: Angle, options?: SumOptions): PlanarSum;
  contains(p: PlanarOperand, q: PlanarOperand, z: Point, semantics?: Semantics): boolean;
  contains(p: Mesh, q: Mesh, z: Point3, semantics?: Semantics): boolean;
  convolutionSizes(p: Region, q: Region): ConvolutionSizes;
  scaleRange(part: Region, path: Coordinates, obstacles: Region, progress?: Progress): ScaleRange;
  /** at one position; anywhere without it */
  fitRange(part: Region, container: Region, at?: Point | null, progress?: Progress): ScaleRange;
  /** of solids; `path` has three numbers for each waypoint */
  scaleRange(part: Mesh, path: Float64Array | number[] | ReadonlyArray<readonly [number, number, number]>, obstacles: Mesh, progress?: Progress): SolidScaleRange;
  fitRange(part: Mesh, container: Mesh, at?: Point3 | null, progress?: Progress): SolidScaleRange;
  sliceOfSum(p: Mesh, q: Mesh, z: number, options?: SpatialOptions): SolidSlice;

  readonly ScalingSum: { create(p: Region, q: Region, options?: MovingOptions): ScalingSum };
  readonly RotatingSum: { create(p: Region, q: Region, options?: MovingOptions): RotatingSum };
  readonly ScalingFamily: {
    create(p: Region, q: Region, low: ExactInput, high: ExactInput, options?: { moving?: 'p' | 'q'; reflectQ?: boolean; semantics?: Semantics; progress?: Progress }): ScalingFamily;
  };
  readonly EditableSum: { create(p: Region, q: Region, options?: EditOptions): EditableSum };
  readonly PlanarDepth: { create(p: Region, q: Region): PlanarDepth };
  readonly CspaceObstacle: {
    create(robot: Region, obstacle: Region, options?: { progress?: Progress }): CspaceObstacle;
    /** of an .obstacle file */
    read(name: string, text: string | Uint8Array | ArrayBuffer): CspaceObstacle;
  };
  cspaceSlice(robot: Region, obstacle: Region, angle: Angle, options?: SumOptions): PlanarSum;
  /**
   * The plan where slices at the two angles tell it, without the obstacle of all angles: start or goal is not free, or translations
   * before or after one rotation in place lead from one to the other; null where they do not tell.
   */
  directPlan(robot: Region, obstacle: Region, start: Configuration, goal: Configuration, options?: PlanOptions): Plan | null;
  /** from each pose to the next, x, y and theta linear in time */
  checkPath(robot: Region, obstacle: Region, poses: Configuration[], options?: { touching?: 'allowed' | 'forbidden'; progress?: Progress }): PathCheck;

  readonly SumLocator: { of(sum: PlanarSum, semantics?: Semantics): SumLocator };
  readonly PlanarLocalSum: { create(p: Region, q: Region, options?: { engine?: LocalEngine; progress?: Progress }): PlanarLocalSum };
  readonly LocalSum: { create(p: Mesh, q: Mesh, options?: { engine?: LocalEngine; tight?: boolean; progress?: Progress }): LocalSum };

  readonly MovingSolidSum: { create(p: Mesh, q: Mesh, options?: MovingSolidOptions): MovingSolidSum };
  readonly ConvexSum: { create(p: Mesh, q: Mesh): ConvexSum };
  /** `contacts: false`: ways have none, which saves time */
  readonly SolidDepth: { create(p: Mesh, q: Mesh, options?: { contacts?: boolean; progress?: Progress }): SolidDepth };
  readonly TurnedDepth: { create(p: Mesh, q: Mesh, options?: { progress?: Progress }): TurnedDepth };
  readonly SolidScaleEvents: {
    create(p: Mesh, q: Mesh, options?: { moving?: 'p' | 'q'; semantics?: Semantics; tight?: boolean }): SolidScaleEvents;
  };
  readonly SolidRotationEvents: {
    create(p: Mesh, q: Mesh, axis: readonly [number, number, number], options?: { moving?: 'p' | 'q'; changes?: boolean; window?: number; tight?: boolean }): SolidRotationEvents;
  };

  readonly GrowingDisc: { create(region: Region): GrowingDisc };
  readonly ShapeFeatures: { create(region: Region, options?: FeatureOptions): ShapeFeatures };

  /** Regions to start with, as in C++ (shapes.h); `snap`, a power of two, rounds coordinates to its nearest multiples. */
  readonly shapes: {
    rectangle(x0: number, y0: number, x1: number, y1: number): Region;
    disc(vertices: number, radius: number, snap?: number): Region;
    gear(teeth: number, inner: number, outer: number, snap?: number): Region;
    grate(bars: number, pitch: number, bar: number, length: number): Region;
    comb(teeth: number, pitch: number, tooth: number, length: number): Region;
    star(points: number, inner: number, outer: number, snap?: number): Region;
    noisyStar(vertices: number, noise: number, seed: number): Region;
    spiral(turns: number, verticesPerTurn: number, pitch: number, width: number, snap?: number): Region;
    letterU(width: number, height: number, thickness: number): Region;
    letterL(width: number, height: number, thickness: number): Region;
    pockets(holes: number, size: number, snap?: number): Region;
    randomPolygon(vertices: number, holes: number, seed: number): Region;
  };
  /**
   * Solids to start with (solids.h). Coordinates that are given are those of the mesh; with `snap`, a power of two, all are
   * rounded to its nearest multiples.
   */
  readonly solids: {
    box(x0: number, y0: number, z0: number, x1: number, y1: number, z1: number, snap?: number): Mesh;
    prism(base: Coordinates, height: number, snap?: number): Mesh;
    tessellatedCube(size: number, k: number, snap?: number): Mesh;
    cone(sides: number, radius: number, height: number, snap?: number): Mesh;
    cylinder(sides: number, radius: number, height: number, snap?: number): Mesh;
    dipyramid(sides: number, radius: number, height: number, snap?: number): Mesh;
    pyramid(sides: number, radius: number, height: number, snap?: number): Mesh;
    geodesicSphere(frequency: number, radius: number, snap?: number): Mesh;
    ellipsoid(slices: number, stacks: number, rx: number, ry: number, rz: number, snap?: number): Mesh;
    triakisIcosahedron(radius: number, snap?: number): Mesh;
    truncatedIcosidodecahedron(radius: number, snap?: number): Mesh;
    rod(slices: number, stacks: number, radius: number, length: number, snap?: number): Mesh;
  };

  /** SVG pictures, as the command line draws them. */
  drawRegion(region: Region): string;
  drawSum(p: Region, q: Region, sum: PlanarSum, names?: { p?: string; q?: string; sum?: string }): string;
  drawTrace(p: Region, q: Region, sum: PlanarSum): string;

  /** Bytes of the module's memory now: it grows and never shrinks. */
  memoryBytes(): number;
}
