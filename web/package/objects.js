// The live objects: classes and functions of web/wasm with their errors thrown, under the names of index.d.ts.
import { throwing, throwingGetter, whenIdle } from './calls.js';
import { refusal } from './errors.js';

const classes = [
  'Region', 'PlanarSum', 'ScalingSum', 'RotatingSum', 'ScalingFamily', 'EditableSum', 'PlanarDepth', 'CspaceObstacle', 'ObstacleQueries', 'Mesh', 'SpatialSum',
  'SolidSlice', 'SolidScaleEvents', 'SolidRotationEvents', 'MovingSolidSum', 'ConvexSum', 'SolidDepth', 'TurnedDepth', 'DiscSet', 'GrowingDisc',
  'ShapeFeatures', 'SumLocator', 'LocalSum', 'PlanarLocalSum', 'PlanarLocalPart',
];
const functions = [
  'nfp', 'erode', 'united', 'intersection', 'difference', 'symmetricDifference', 'unionOf', 'rotatedSum', 'convolutionSizes', 'scaleRange',
  'fitRange', 'sliceOfSum', 'cspaceSlice', 'checkPath', 'directPlan', 'drawRegion', 'drawSum', 'drawTrace', 'opening', 'closing', 'offset',
  'byPlanes', 'byLines',
];
/** What has another name, or that of the function for the plane. */
const inner = [
  'sumOfSets', 'sumOfMeshes', 'sumOfResult', 'setContains', 'meshContains', 'erodeMeshes', 'erodeResult', 'unitedMeshes', 'intersectionOfMeshes', 'differenceOfMeshes',
  'symmetricDifferenceOfMeshes', 'scaleRangeOfMeshes', 'fitRangeOfMeshes', 'plan',
];
const shapes = ['rectangle', 'grate', 'comb', 'noisyStar', 'letterU', 'letterL', 'randomPolygon'];
const roundShapes = ['disc', 'gear', 'star', 'spiral', 'pockets'];
const solids = [
  'box', 'prism', 'tessellatedCube', 'cone', 'cylinder', 'dipyramid', 'pyramid', 'geodesicSphere', 'ellipsoid',
  'triakisIcosahedron', 'truncatedIcosidodecahedron', 'rod',
];

function bound(object, of) {
  for (const [name, property] of Object.entries(Object.getOwnPropertyDescriptors(object))) {
    const { value, get, configurable } = property;
    if (typeof value === 'function' && value.argCount !== undefined) object[name] = throwing(value, `${of}.${name}`);
    else if (get && configurable) Object.defineProperty(object, name, { ...property, get: throwingGetter(get, `${of}.${name}`) });
  }
}

/** dispose() may be called more than once, also while the object is at work; copies of a handle are not made. */
function disposable(handles) {
  handles.dispose = function () {
    whenIdle(() => {
      if (!this.isDeleted()) this.delete();
    });
  };
  if (Symbol.dispose) handles[Symbol.dispose] = handles.dispose;
}

function bindClasses(instance) {
  const made = {};
  for (const name of classes.filter((name) => name in instance)) {
    made[name] = instance[name];
    bound(made[name], name);
    bound(made[name].prototype, name);
    disposable(made[name].prototype);
  }
  return made;
}

/** The functions of these names that the module has: that of a page may have fewer. */
const among = (instance, names) => Object.fromEntries(names.filter((name) => name in instance).map((name) => [name, throwing(instance[name], name)]));

/** Generators whose last argument, `snap`, may be left out. */
function snapping(instance, names) {
  const made = among(instance, names);
  const padded = (name) => (...given) => made[name](...given, ...(given.length === instance[name].argCount - 1 ? [0] : []));
  return Object.fromEntries(names.map((name) => [name, padded(name)]));
}

/** What is one object here and two in the module. */
function joined(made, calls) {
  const { Mesh, CspaceObstacle, ObstacleQueries, SolidSlice } = made;
  Mesh.convexHull = Mesh.hullOf;
  CspaceObstacle.prototype.queries = function () {
    return ObstacleQueries.of(this);
  };
  CspaceObstacle.prototype.plan = function (start, goal, options) {
    return calls.plan(this, start, goal, options);
  };
  Object.defineProperty(SolidSlice.prototype, 'section', {
    get() {
      this.sectionHandle ??= this.takeSection();
      return this.sectionHandle;
    },
  });
  const isSet = (x) => x instanceof made.Region || x instanceof made.PlanarSum, isMesh = (x) => x instanceof Mesh, isSum = (x) => x instanceof made.SpatialSum;
  /** One name for regions and for solids. */
  const either = (ofRegions, ofMeshes) => (p, ...rest) => (p instanceof Mesh ? ofMeshes : ofRegions)(p, ...rest);
  /** Operands of other kinds would be found in the midst of the work, and what was copied till then be lost. */
  const ofKind = (takes, operands, ofSets, ofMeshes, ofResult) => {
    const [first, ...others] = operands;
    if (operands.every(isSet)) return ofSets;
    if (ofMeshes && operands.every(isMesh)) return ofMeshes;
    if (ofResult && isSum(first) && others.every((x) => isMesh(x) || isSum(x))) return ofResult;
    throw refusal(`${takes} regions and planar sums${ofMeshes ? ', or meshes' : ''}${ofResult ? ', or a spatial sum and a mesh or another one' : ''}`);
  };
  const ofTwo = (name, ...of) => (p, q, ...rest) => ofKind(`${name} takes`, [p, q], ...of)(p, q, ...rest);
  const listed = (list) => (typeof list?.[Symbol.iterator] === 'function' ? Array.from(list) : [undefined]);
  const unionOf = (regions, options) => {
    const all = listed(regions);
    if (!all.every((region) => region instanceof made.Region)) throw refusal('unionOf takes a list of regions');
    return calls.unionOf(all, options);
  };
  const byLines = (given, options) => {
    const all = given instanceof made.Region ? given : listed(given);
    if (!(Array.isArray(all) ? all : [all]).every((region) => region instanceof made.Region)) throw refusal('byLines takes a region or a list of regions');
    return calls.byLines(all, options);
  };
  const united = (operands, options) => {
    const all = listed(operands);
    return ofKind('united takes a list of', all, calls.united, calls.unitedMeshes)(all, options);
  };
  return {
    unionOf,
    byLines,
    united,
    drawSum: (p, q, sum, names) => calls.drawSum(p, q, sum, names),
    minkowskiSum: ofTwo('minkowskiSum', calls.sumOfSets, calls.sumOfMeshes, calls.sumOfResult),
    nfp: ofTwo('nfp', calls.nfp),
    contains: ofTwo('contains', calls.setContains, calls.meshContains),
    erode: ofTwo('erode', calls.erode, calls.erodeMeshes, calls.erodeResult),
    intersection: ofTwo('intersection', calls.intersection, calls.intersectionOfMeshes),
    difference: ofTwo('difference', calls.difference, calls.differenceOfMeshes),
    symmetricDifference: ofTwo('symmetricDifference', calls.symmetricDifference, calls.symmetricDifferenceOfMeshes),
    scaleRange: either(calls.scaleRange, calls.scaleRangeOfMeshes),
    fitRange: either(calls.fitRange, calls.fitRangeOfMeshes),
  };
}

export function objectsOf(instance) {
  const made = bindClasses(instance);
  const calls = among(instance, functions);
  return {
    version: instance.version(),
    memoryBytes: () => instance.memoryBytes(),
    ...made,
    ...calls,
    ...joined(made, { ...calls, ...among(instance, inner) }),
    shapes: { ...among(instance, shapes), ...snapping(instance, roundShapes) },
    solids: snapping(instance, solids),
  };
}
