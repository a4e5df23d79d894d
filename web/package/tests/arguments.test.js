// Wrong arguments are refused by a DymsumError, and options that there are not by name.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { inspect } from 'node:util';

import { optionsOf } from '../arguments.js';
import { DymsumError, load } from '../index.js';

const dymsum = await load();
const { Region, Mesh, shapes, solids } = dymsum;
const square = shapes.rectangle(0, 0, 2, 2), bar = shapes.rectangle(0, 0, 1, 3), box = solids.box(0, 0, 0, 1, 1, 1);
const folder = new URL('..', import.meta.url);
const types = readFileSync(new URL('index.d.ts', folder), 'utf8');

/** A valid call of everything: what it is called of, its name, its arguments. */
function* calls() {
  const sum = dymsum.nfp(square, bar), solid = dymsum.minkowskiSum(box, box), obstacle = dymsum.CspaceObstacle.create(bar, square);
  const pose = { x: 9, y: 0, theta: 0 }, ring = [0, 0, 1, 0, 0, 1], tetrahedron = { vertices: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], faces: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] };
  yield [Region, 'read', ['a.wkt', 'POLYGON ((0 0, 1 0, 0 1, 0 0))', {}]];
  yield [Region, 'readAll', ['a.wkt', 'POLYGON ((0 0, 1 0, 0 1, 0 0))', {}]];
  yield [Region, 'readData', ['a.wkt', 'POLYGON ((0 0, 1 0, 0 1, 0 0))', {}]];
  yield [Region, 'fromRings', [[ring]]];
  for (const name of ['fromData', 'repair']) yield [Region, name, [{ parts: [{ outer: ring }] }]];
  yield [square, 'translated', [1, 1]];
  yield [square, 'scaled', [2, 2]];
  yield [square, 'withVertex', [2, 3, 3]];
  yield [square, 'equals', [bar]];
  yield [square, 'format', ['wkt']];
  yield [sum, 'exact', [0]];
  yield [sum, 'areaExact', [99]];
  yield [sum, 'rounded', [{}]];
  yield [sum, 'equals', [sum]];
  yield [sum, 'format', ['wkt']];
  const booleans = ['intersection', 'difference', 'symmetricDifference'];
  for (const name of ['minkowskiSum', 'nfp', 'erode', ...booleans]) for (const p of [square, dymsum.united([square])]) yield [dymsum, name, [p, bar, {}]];
  for (const name of ['minkowskiSum', 'erode', 'opening', 'closing', ...booleans]) yield [dymsum, name, [box, box, {}]];
  for (const name of ['minkowskiSum', 'erode']) for (const q of [box, solid]) yield [dymsum, name, [solid, q, {}]];
  for (const list of [[square, sum], [box, box]]) yield [dymsum, 'united', [list, {}]];
  yield [dymsum, 'byPlanes', [tetrahedron, {}]];
  yield [dymsum, 'offset', [box, 1, 0.5, {}]];
  yield [dymsum, 'unionOf', [[square, bar], {}]];
  yield [dymsum, 'rotatedSum', [square, bar, { tanHalf: '1/2' }, {}]];
  yield [dymsum, 'contains', [square, bar, { x: 0, y: 0 }, 'closed']];
  yield [dymsum, 'contains', [box, box, { x: 0, y: 0, z: 0 }, 'closed']];
  yield [dymsum, 'convolutionSizes', [square, bar]];
  yield [dymsum, 'scaleRange', [square, [0, 0, 9, 0], shapes.rectangle(4, 4, 5, 5), () => true]];
  yield [dymsum, 'fitRange', [square, bar, { x: 0, y: 0 }, () => true]];
  yield [dymsum, 'sliceOfSum', [box, box, 0.5, {}]];
  yield [dymsum, 'cspaceSlice', [bar, square, 0.5, {}]];
  yield [dymsum, 'directPlan', [bar, square, pose, { ...pose, x: 8 }, {}]];
  yield [dymsum, 'checkPath', [bar, square, [pose, { ...pose, x: 8 }], {}]];
  for (const name of ['drawSum', 'drawTrace']) yield [dymsum, name, [square, bar, sum]];
  yield [dymsum, 'drawRegion', [square]];
  for (const name of ['ScalingSum', 'RotatingSum']) yield [dymsum[name], 'create', [square, bar, {}]];
  yield [dymsum.ScalingSum.create(square, bar), 'set', ['3/2', 1]];
  yield [dymsum.ScalingSum.create(square, bar), 'events', [1, 2, () => true]];
  yield [dymsum.ScalingSum.create(square, bar), 'nextEvent', [1, 2, 'visible', () => true]];
  yield [dymsum.RotatingSum.create(square, bar), 'set', [0.5]];
  yield [dymsum.ScalingFamily, 'create', [square, bar, 1, '3/2', {}]];
  const family = dymsum.ScalingFamily.create(square, bar, 1, 2);
  for (const name of ['at', 'ringIds']) yield [family, name, ['3/2']];
  yield [family, 'changes', [1, 2, 'visible']];
  for (const name of ['outer', 'inner']) yield [family, name, [1, 2]];
  yield [dymsum.PlanarDepth, 'create', [square, bar]];
  yield [dymsum.PlanarDepth.create(square, bar), 'at', [0, 0]];
  yield [dymsum.CspaceObstacle, 'create', [bar, square, {}]];
  yield [dymsum.CspaceObstacle, 'read', ['a.obstacle', obstacle.format()]];
  yield [obstacle, 'slice', [0.5, 'closed']];
  yield [obstacle, 'outline', [0.5]];
  yield [obstacle, 'contains', [0, 0, 0.5]];
  yield [obstacle, 'patchEnds', [0, obstacle.angles()[0].theta]];
  for (const name of ['mesh', 'glb']) yield [obstacle, name, [{}]];
  yield [obstacle, 'plan', [pose, { ...pose, x: 8 }, {}]];
  yield [obstacle.queries(), 'clearance', [pose, {}]];
  yield [obstacle.queries(), 'contains', [pose]];
  yield [obstacle.queries(), 'freeAngles', [0, 0]];
  yield [Mesh, 'read', ['a.off', box.format('off'), {}]];
  yield [Mesh, 'readData', ['a.off', box.format('off')]];
  for (const name of ['fromData', 'repair']) yield [Mesh, name, [tetrahedron, {}]];
  yield [box, 'translated', [1, 1, 1]];
  yield [box, 'scaled', [1, 1, 1]];
  yield [box, 'equals', [box]];
  yield [box, 'format', ['off']];
  yield [solid, 'exact', [0]];
  yield [solid, 'format', ['off']];
  for (const name of ['PlanarLocalSum', 'LocalSum', 'MovingSolidSum', 'SolidDepth', 'TurnedDepth', 'SolidScaleEvents'])
    yield [dymsum[name], 'create', name === 'PlanarLocalSum' ? [square, bar, {}] : [box, box, {}]];
  yield [dymsum.PlanarLocalSum.create(square, bar), 'in', [{ low: { x: 0, y: 0 }, high: { x: 9, y: 9 } }, {}, { scale: 2 }]];
  yield [dymsum.LocalSum.create(box, box), 'in', [{ middle: { x: 0, y: 0, z: 0 }, radius: 1 }, {}, { scale: 2 }]];
  yield [dymsum.SolidRotationEvents, 'create', [box, box, [0, 0, 1], {}]];
  yield [dymsum.SolidRotationEvents.create(box, box, [0, 0, 1]), 'at', [0.1]];
  yield [dymsum.SolidScaleEvents.create(box, box), 'at', [2]];
  yield [dymsum.MovingSolidSum.create(box, box), 'set', [{ scale: 2 }, {}]];
  yield [dymsum.ConvexSum, 'create', [box, box]];
  const convex = dymsum.ConvexSum.create(box, box);
  yield [convex, 'set', [{ rotation: { axis: [0, 0, 1], angle: 0.5 } }, {}]];
  yield [convex, 'support', [{ x: 0, y: 0, z: 1 }]];
  yield [convex, 'depth', [{ x: 0, y: 0, z: 0 }]];
  yield [convex, 'exact', [0]];
  yield [dymsum.SolidDepth.create(box, box), 'at', [0, 0, 0, 5]];
  yield [dymsum.TurnedDepth.create(box, box), 'at', [{ x: 0, y: 0, z: 0 }, { quaternion: [1, 0, 0, 0] }]];
  yield [dymsum.SumLocator, 'of', [sum, 'closed']];
  yield [dymsum.SumLocator.of(sum), 'contains', [{ x: 0, y: '1/3' }]];
  yield [dymsum.SumLocator.of(sum), 'containsEach', [[0, 0]]];
  yield [dymsum.GrowingDisc, 'create', [square]];
  const disc = dymsum.GrowingDisc.create(square), features = dymsum.ShapeFeatures.create(shapes.letterU(4, 4, 1));
  yield [disc, 'events', ['outside', () => true]];
  for (const name of ['sumAt', 'erodedAt', 'openedAt', 'closedAt']) yield [disc, name, ['1/2', 'closed']];
  yield [disc.sumAt(1), 'toRegion', [0.1, 'nearest']];
  yield [disc.sumAt(1), 'svg', [square]];
  yield [dymsum.ShapeFeatures, 'create', [square, {}]];
  yield [features, 'bridges', ['1/2']];
  for (const name of ['lasting', 'significant']) yield [features, name, ['1/2', 0, 9]];
  for (const name of ['eventAlpha', 'eventText']) yield [features, name, [0]];
  yield [features, 'decompose', [{}]];
  const numbers = { disc: [8, 1], gear: [5, 1, 2], grate: [2, 2, 1, 5], comb: [2, 2, 1, 5], star: [5, 1, 2], noisyStar: [9, 0.5, 1], spiral: [2, 9, 1, 0.3], letterU: [4, 4, 1], letterL: [4, 4, 1], pockets: [2, 1], randomPolygon: [9, 1, 1], rectangle: [0, 0, 1, 1] };
  for (const [name, args] of Object.entries(numbers)) yield [shapes, name, args];
  const sizes = { box: [0, 0, 0, 1, 1, 1], prism: [ring, 1], tessellatedCube: [1, 2], cone: [5, 1, 1], cylinder: [5, 1, 1], dipyramid: [5, 1, 1], pyramid: [5, 1, 1], geodesicSphere: [2, 1], ellipsoid: [5, 5, 1, 1, 1], triakisIcosahedron: [1], truncatedIcosidodecahedron: [1], rod: [5, 5, 1, 1] };
  for (const [name, args] of Object.entries(sizes)) yield [solids, name, args];
}

const wrong = [undefined, null, true, -1, 0.5, NaN, Infinity, 2 ** 40, 10n, '', 'x', Symbol('s'), {}, [], [[]], [null], [1], () => 1, box, square, new Date(0), Object.create(null)];

test('a wrong argument anywhere is answered, or refused by a DymsumError', () => {
  let refused = 0;
  for (const [of, name, args] of calls()) {
    of[name](...args);
    for (let k = 0; k < args.length; ++k)
      for (const value of wrong) {
        if (['disc', 'gear', 'grate', 'comb', 'star', 'noisyStar', 'spiral', 'pockets', 'randomPolygon'].includes(name) && value === 2 ** 40) continue; // as large as asked for
        try {
          of[name](...args.with?.(k, value) ?? args.map((a, i) => (i === k ? value : a)));
        } catch (error) {
          assert.ok(error instanceof DymsumError, `${name}, argument ${k}, ${inspect(value)}: ${error?.stack ?? error}`);
          assert.notEqual(error.code, 'defect', `${name}, argument ${k}, ${inspect(value)}: ${error}`);
          ++refused;
        }
      }
  }
  assert.ok(refused > 1000, `${refused} refused`);
});

test('what a function of the caller throws is the caller\'s', () => {
  const own = new TypeError('mine');
  const progress = () => {
    throw own;
  };
  for (const work of [() => dymsum.ScalingSum.create(shapes.gear(40, 1, 2), shapes.star(30, 1, 2)).events(1, 2, progress), () => dymsum.minkowskiSum(shapes.gear(90, 1, 2), shapes.gear(90, 1, 2), { progress })])
    assert.throws(work, (error) => error === own);
});

test('options that there are not are refused, with those that there are', async () => {
  const refused = (action, text) => assert.throws(action, (error) => error instanceof DymsumError && error.code === 'invalid_argument' && error.message.includes(text));
  refused(() => dymsum.nfp(square, bar, { semantcs: 'open' }), 'there is no option "semantcs"; there are: engine, semantics, trace, progress');
  refused(() => dymsum.minkowskiSum(box, box, { trace: true }), '"trace"');
  refused(() => dymsum.difference(square, bar, { engine: 'fast' }), 'difference: there is no option "engine"; there are: semantics, progress');
  refused(() => dymsum.intersection(square, box), 'intersection takes regions and planar sums, or meshes');
  refused(() => dymsum.erode(box, dymsum.united([box])), 'erode takes regions and planar sums, or meshes, or a spatial sum and a mesh or another one');
  refused(() => dymsum.nfp(box, box), 'nfp takes regions and planar sums');
  refused(() => dymsum.united([square, box]), 'united takes a list of regions and planar sums, or meshes');
  refused(() => dymsum.byPlanes({ vertices: [], faces: [] }, { tolerance: 1, planes: 1 }), '"planes"');
  refused(() => dymsum.nfp(square, bar, { trace: 'no' }), 'trace is true or false');
  refused(() => dymsum.nfp(square, bar, { progress: 5 }), 'progress is a function');
  refused(() => dymsum.nfp(square, bar, 5), 'options are an object');
  await assert.rejects(load({ smid: true }), DymsumError);
  await assert.rejects(dymsum.run(['--version'], { file: {} }), DymsumError);
  for (const args of [undefined, 'sum', [5], [null]]) await assert.rejects(dymsum.run(args), DymsumError);
  for (const how of [{ files: { 'a.wkt': 5 } }, { files: 5 }, { stdin: 5 }, { onStderr: 5 }, 5]) await assert.rejects(dymsum.run(['--version'], how), DymsumError);
});

/** The names of options in index.d.ts: of an interface, or written out. */
function namesOf(type) {
  return type.split('&').flatMap((part) => {
    const fields = /^\s*(\w+)\s*$/.test(part) ? new RegExp(`interface ${part.trim()} \\{([^}]*)\\}`).exec(types)[1] : part;
    return [...fields.replace(/\/\*[^]*?\*\//g, '').matchAll(/(\w+)\?:/g)].map(([, name]) => name);
  });
}

test('the options that are looked at are those of index.d.ts', () => {
  const written = [...types.matchAll(/(\w+)\(([^)]*?(?:\([^)]*\)[^)]*?)*)options\?: ([^)]*)\)/g)].map(([, name, , type]) => `${name}: ${namesOf(type).sort()}`);
  const looked = Object.entries(optionsOf).map(([name, [, names]]) => {
    const plain = name.split('.').at(-1), given = { sumOfSets: 'minkowskiSum', sumOfMeshes: 'minkowskiSum', sumOfResult: 'minkowskiSum', erodeResult: 'erode' }[plain] ?? plain.replace(/(Of)?Meshes$/, '');
    return `${given}: ${[...names].sort()}`;
  });
  const own = ['load', 'run'];
  const once = (lines) => [...new Set(lines)].sort(); // a call may take several kinds of operands
  assert.deepEqual(once(written.filter((line) => !own.includes(line.split(':')[0]))), once(looked));
});

test('the package has a guide and its licence', () => {
  const [{ files }] = JSON.parse(execFileSync('npm', ['pack', '--dry-run', '--json', '--ignore-scripts'], { cwd: fileURLToPath(folder), encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }));
  const names = files.map(({ path }) => path);
  for (const name of ['README.md', 'LICENSE', 'NOTICES', 'index.js', 'index.d.ts', 'arguments.js']) assert.ok(names.includes(name), name);
  assert.equal(readFileSync(new URL('LICENSE', folder), 'utf8'), readFileSync(new URL('../../LICENSE', folder), 'utf8'));
});
