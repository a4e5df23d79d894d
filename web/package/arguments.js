// What of the arguments is looked at before the module sees them: names of options, and what is too large for its memory.
// index.d.ts tells what the options mean; a test compares the names.
import { refusal } from './errors.js';

const sum = ['engine', 'semantics', 'trace', 'progress'];
const spatial = ['engine', 'semantics', 'tight', 'memory', 'progress'];
const boolean = ['semantics', 'progress'];
const solidBoolean = ['memory', 'progress'];
const moving = ['moving', 'reflectQ', 'semantics', 'mode', 'window', 'keptWindowBytes', 'progress'];

/** Of each function of the module that takes options: which argument they are, and their names. */
export const optionsOf = {
  sumOfSets: [2, sum],
  sumOfMeshes: [2, spatial],
  sumOfResult: [2, spatial],
  nfp: [2, sum],
  erode: [2, sum],
  erodeMeshes: [2, spatial],
  erodeResult: [2, spatial],
  opening: [2, [...spatial, 'between']],
  closing: [2, [...spatial, 'between']],
  offset: [3, [...spatial, 'bound']],
  unionOf: [1, sum],
  united: [1, boolean],
  unitedMeshes: [1, solidBoolean],
  intersection: [2, boolean],
  intersectionOfMeshes: [2, solidBoolean],
  difference: [2, boolean],
  differenceOfMeshes: [2, solidBoolean],
  symmetricDifference: [2, boolean],
  symmetricDifferenceOfMeshes: [2, solidBoolean],
  byLines: [1, ['tolerance', 'progress']],
  byPlanes: [1, ['tolerance', ...solidBoolean]],
  rotatedSum: [3, sum],
  sliceOfSum: [3, spatial],
  cspaceSlice: [3, sum],
  checkPath: [3, ['touching', 'progress']],
  plan: [3, ['touching', 'timeLimitSeconds', 'progress']],
  directPlan: [4, ['touching', 'timeLimitSeconds', 'progress']],
  'Region.read': [2, ['repair', 'thirdCoordinates']],
  'Region.readAll': [2, ['repair', 'thirdCoordinates']],
  'Region.readData': [2, ['thirdCoordinates']],
  'PlanarSum.rounded': [0, ['repair']],
  'CspaceObstacle.create': [2, ['progress']],
  'CspaceObstacle.mesh': [0, ['tolerance', 'progress']],
  'CspaceObstacle.glb': [0, ['tolerance']],
  'ObstacleQueries.clearance': [1, ['weight', 'touching']],
  'Mesh.read': [2, ['repair', 'hull', 'thinParts']],
  'Mesh.fromData': [1, ['thinParts']],
  'Mesh.repair': [1, ['thinParts']],
  'ScalingSum.create': [2, moving],
  'RotatingSum.create': [2, moving],
  'ScalingFamily.create': [4, ['moving', 'reflectQ', 'semantics', 'progress']],
  'EditableSum.create': [2, ['semantics', 'reflectQ', 'mode', 'undoSteps', 'progress']],
  'PlanarLocalSum.create': [2, ['engine', 'progress']],
  'LocalSum.create': [2, ['engine', 'tight', 'progress']],
  'MovingSolidSum.create': [2, ['semantics', 'tight', 'mode', 'progress']],
  'SolidDepth.create': [2, ['contacts', 'progress']],
  'TurnedDepth.create': [2, ['progress']],
  'SolidScaleEvents.create': [2, ['moving', 'semantics', 'tight']],
  'SolidRotationEvents.create': [3, ['moving', 'changes', 'window', 'tight']],
  'ShapeFeatures.create': [1, ['concavity', 'hybridTolerance', 'progress']],
  'ShapeFeatures.decompose': [0, ['persistence', 'alphaFrom', 'alphaTo', 'progress']],
};

const switches = new Set(['trace', 'tight', 'reflectQ', 'repair', 'hull', 'thinParts', 'changes', 'simd']);
const callbacks = new Set(['progress', 'onStderr', 'locateFile']);

/** Throws for an option that there is not, and for one that is no switch or no function where it has to be. */
export function checkOptions(name, options, known) {
  if (options === undefined || options === null) return;
  if (typeof options !== 'object') throw refusal(`${name}: options are an object`);
  for (const [option, value] of Object.entries(options)) {
    if (!known.includes(option)) throw refusal(`${name}: there is no option "${option}"; there are: ${known.join(', ')}`);
    if (value === undefined || value === null) continue;
    if (switches.has(option) && typeof value !== 'boolean') throw refusal(`${name}: ${option} is true or false`);
    if (callbacks.has(option) && typeof value !== 'function') throw refusal(`${name}: ${option} is a function`);
  }
}

/** What no memory of the module's kind holds is told before it is copied there. */
const mostBytes = 2 ** 30;
const longText = 2 ** 16;

function tooLarge() {
  return refusal('an input of a gigabyte and more does not fit into the memory of WebAssembly', 'out_of_memory');
}

/** The caller's function, which leaves in `watch` what it throws. */
function watched(callback, watch) {
  return (...args) => {
    try {
      return callback(...args);
    } catch (error) {
      watch.thrown = { error };
      throw error;
    }
  };
}

/** An argument as the module takes it: buffers of another realm (a frame, a test's sandbox) are known by their names alone. */
export function taken(argument, watch) {
  if (typeof argument === 'function') return watched(argument, watch);
  if (typeof argument === 'string') {
    if (argument.length >= mostBytes) throw tooLarge();
    return argument.length < longText ? argument : new TextEncoder().encode(argument); // quicker than letter by letter
  }
  if (typeof argument !== 'object' || argument === null) return argument;
  if (argument.byteLength >= mostBytes) throw tooLarge();
  if (argument instanceof ArrayBuffer || argument instanceof Uint8Array) return argument;
  const tag = Object.prototype.toString.call(argument);
  if (tag === '[object ArrayBuffer]' || tag === '[object Uint8Array]') return new Uint8Array(argument);
  return typeof argument.progress === 'function' ? { ...argument, progress: watched(argument.progress, watch) } : argument;
}
