// The live objects: classes and functions of web/wasm with their errors thrown, under the names of index.d.ts.
import { throwing, throwingGetter, whenIdle } from './calls.js';
import { refusal } from './errors.js';

const classes = [
  'Region', 'PlanarSum', 'ScalingSum', 'RotatingSum', 'PlanarDepth', 'CspaceObstacle', 'ObstacleQueries', 'Mesh', 'SpatialSum',
  'SolidSlice', 'SolidScaleEvents', 'SolidRotationEvents', 'MovingSolidSum', 'ConvexSum', 'SolidDepth', 'TurnedDepth', 'DiscSet', 'GrowingDisc',
  'ShapeFeatures', 'SumLocator', 'LocalSum', 'PlanarLocalSum', 'PlanarLocalPart',
];
const functions = [
  'nfp', 'erode', 'unionOf', 'rotatedSum', 'convolutionSizes', 'scaleRange', 'fitRange', 'sliceOfSum', 'cspaceSlice', 'checkPath',
  'drawRegion', 'drawSum', 'drawTrace', 'sumOfRegions', 'sumOfMeshes', 'regionContains', 'meshContains', 'plan', 'directPlan',
  'erodeMeshes', 'opening', 'closing', 'offset', 'scaleRangeOfMeshes', 'fitRangeOfMeshes',
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
  for (const name of classes) {
    made[name] = instance[name];
    bound(made[name], name);
    bound(made[name].prototype, name);
    disposable(made[name].prototype);
  }
  return made;
}

const among = (instance, names) => Object.fromEntries(names.map((name) => [name, throwing(instance[name], name)]));

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
  /** One name for regions and for solids. */
  const either = (ofRegions, ofMeshes) => (p, ...rest) => (p instanceof Mesh ? ofMeshes : ofRegions)(p, ...rest);
  /** An element that is no region would be found in the midst of the work, and what was copied till then be lost. */
  const unionOf = (regions, options) => {
    const all = typeof regions?.[Symbol.iterator] === 'function' ? Array.from(regions) : [undefined];
    if (!all.every((region) => region instanceof made.Region)) throw refusal('unionOf takes a list of regions');
    return calls.unionOf(all, options);
  };
  return {
    unionOf,
    drawSum: (p, q, sum, names) => calls.drawSum(p, q, sum, names),
    minkowskiSum: either(calls.sumOfRegions, calls.sumOfMeshes),
    contains: either(calls.regionContains, calls.meshContains),
    erode: either(calls.erode, calls.erodeMeshes),
    scaleRange: either(calls.scaleRange, calls.scaleRangeOfMeshes),
    fitRange: either(calls.fitRange, calls.fitRangeOfMeshes),
  };
}

export function objectsOf(instance) {
  const made = bindClasses(instance);
  const all = among(instance, functions), both = joined(made, all);
  const { sumOfRegions, sumOfMeshes, regionContains, meshContains, erodeMeshes, scaleRangeOfMeshes, fitRangeOfMeshes, plan, ...calls } = all;
  return {
    version: instance.version(),
    memoryBytes: () => instance.memoryBytes(),
    ...made,
    ...calls,
    ...both,
    shapes: { ...among(instance, shapes), ...snapping(instance, roundShapes) },
    solids: snapping(instance, solids),
  };
}
