// Every class and function of the live objects, against what is known exactly and against the command line.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { runInNewContext } from 'node:vm';

import { DymsumError, load, NONE } from '../index.js';

const dymsum = await load();
const { Region, Mesh, shapes, solids } = dymsum;
const slot = () => shapes.letterU(4, 4, 1);
const peg = () => shapes.rectangle(0, 0, 2, 1);

/** The code of what is thrown, and its evidence. */
function thrown(action) {
  try {
    action();
  } catch (error) {
    assert.ok(error instanceof DymsumError, `${error}`);
    return error;
  }
  return assert.fail('nothing was thrown');
}

async function reported(args, files) {
  return JSON.parse((await dymsum.run([...args, '--json'], { files })).stdout);
}

test('a region is read, asked and written', () => {
  const region = Region.read('a.wkt', 'POLYGON ((0 0, 4 0, 0 3, 0 0))');
  assert.equal(region.vertexCount, 3);
  assert.equal(region.empty, false);
  assert.equal(region.area(), 6);
  assert.equal(region.areaText(), '6.0000000000000000e+00');
  assert.deepEqual(region.bounds(), [0, 0, 4, 3]);
  assert.deepEqual([...region.shape().vertices], [0, 0, 4, 0, 0, 3]);
  assert.deepEqual([...region.shape().ringStarts], [0, 3]);
  for (const format of ['wkt', 'poly', 'geojson', 'json', 'svg'])
    assert.ok(Region.read(`b.${format}`, region.format(format)).equals(region), format);
  assert.ok(Region.fromRings([[[0, 0], [4, 0], [0, 3]]]).equals(region));
  assert.ok(Region.fromRings([new Float64Array([0, 0, 4, 0, 0, 3])]).equals(region));
  assert.ok(Region.fromRings([[[0, 0], [4, 0], [0, 3], [0, 0]]]).equals(region), 'a ring that ends where it began');
  assert.ok(region.negated().negated().equals(region));
  assert.equal(region.scaled(2, 2).area(), 24);
  assert.deepEqual(region.translated(1, -1).bounds(), [1, -1, 5, 2]);
  assert.match(dymsum.drawRegion(region), /^<svg/);
});

test('bytes, shapes of a file by name, and regions with everything', () => {
  const bytes = new TextEncoder().encode('POLYGON ((0 0, 4 0, 0 3, 0 0))');
  assert.equal(Region.read('a.wkt', bytes).area(), 6);
  const json = { type: 'FeatureCollection', features: ['x', 'y'].map((name, k) => ({
    type: 'Feature', properties: { name }, geometry: { type: 'Polygon', coordinates: [[[k, 0], [k + 1, 0], [k, 1], [k, 0]]] } })) };
  const all = Region.readAll('two.geojson', JSON.stringify(json));
  assert.deepEqual(all.map(({ name }) => name), ['x', 'y']);
  assert.deepEqual(Region.read('two.geojson#y', JSON.stringify(json)).bounds(), [1, 0, 2, 1]);
  const mixed = Region.fromData({ parts: [{ outer: [0, 0, 1, 0, 0, 1] }], polylines: [[5, 5, 6, 6, 7, 5]], points: [9, 9] }).shape();
  assert.deepEqual([...mixed.polylineStarts], [3, 6]);
  assert.equal(mixed.firstPoint, 6);
});

test('errors have code, place and text, and travel as plain data', () => {
  const crossing = thrown(() => Region.fromRings([[0, 0, 1, 1, 1, 0, 0, 1]]));
  assert.equal(crossing.code, 'self_crossing');
  assert.deepEqual(crossing.evidence, { part: 0, ring: 0, vertex: 0, otherPart: 0, otherRing: 0, otherVertex: 2, x: 0.5, y: 0.5 });
  assert.deepEqual(new DymsumError(structuredClone(crossing.toData())).toData(), crossing.toData());
  const number = thrown(() => Region.read('dir/bad.wkt', 'POLYGON ((0 0,\n 1 x, 0 1, 0 0))'));
  assert.deepEqual([number.code, number.evidence.file, number.evidence.line], ['malformed', 'dir/bad.wkt', 2]);
  assert.equal(thrown(() => Region.read('a.xyz', '')).code, 'unsupported_format');
  assert.equal(thrown(() => slot().format('dwg')).code, 'malformed');
  assert.equal(thrown(() => dymsum.minkowskiSum(slot(), 5)).code, 'invalid_argument');
  const gone = slot();
  gone.dispose();
  gone.dispose();
  assert.equal(thrown(() => gone.area()).code, 'invalid_argument');
});

test('of a file of several shapes an error names the one that is refused', () => {
  const two = 'POLYGON ((0 0, 1 0, 0 1, 0 0))\nPOLYGON ((0 0, 1 0, 1 0, 0 1, 0 0))';
  const { code, evidence } = thrown(() => Region.readAll('two.wkt', two));
  assert.deepEqual([code, evidence.file], ['repeated_vertex', 'two.wkt#1']);
  assert.equal(Region.readAll('two.wkt', two, { repair: true }).length, 2);
});

test('a vertex that is pulled changes the region or tells where rings cross', () => {
  const square = shapes.rectangle(0, 0, 2, 2);
  assert.equal(square.withVertex(2, 3, 3).area(), 6);
  assert.equal(thrown(() => square.withVertex(0, 3, 1.5)).code, 'self_crossing');
  assert.equal(thrown(() => square.withVertex(4, 0, 0)).code, 'bad_index');
});

test('repair mends and reports', () => {
  const { region, changed, report } = Region.repair({ parts: [{ outer: [0, 0, 0, 3, 4, 0] }] });
  assert.deepEqual([region.area(), changed], [6, true]);
  assert.match(report, /reversed|turned|orient/i);
  assert.equal(Region.read('a.wkt', 'POLYGON ((0 0, 0 3, 4 0, 0 0))', { repair: true }).area(), 6);
});

test('a sum has its shape, its provenance and exact values', async () => {
  const p = slot();
  const q = peg();
  const sum = dymsum.nfp(p, q);
  const json = await reported(['nfp', 'slot.wkt', 'peg.wkt'], { 'slot.wkt': p.format('wkt'), 'peg.wkt': q.format('wkt') });
  assert.equal(sum.areaExact(), json.area_exact);
  assert.equal(sum.area(), json.area);
  assert.equal(sum.vertexCount, json.vertices);
  const shape = sum.shape();
  assert.equal(shape.tightSegments.length, 2 * json.tight.segments);
  assert.equal(shape.contacts.length, 3 * shape.vertices.length);
  assert.equal(shape.corners.length, shape.vertices.length);
  const [from, to] = shape.tightSegments;
  assert.deepEqual([sum.exact(from), sum.exact(to)], [{ x: '1/1', y: '1/1' }, { x: '1/1', y: '4/1' }]);
  assert.equal(thrown(() => sum.exact(10 ** 6)).code, 'bad_index');
  assert.ok(sum.equals(dymsum.nfp(p, q, { engine: 'winding' })));
  assert.equal(dymsum.nfp(p, q, { semantics: 'regular' }).shape().tightSegments.length, 0);
  assert.match(sum.format('wkt'), /^GEOMETRYCOLLECTION/);
  assert.equal(JSON.parse(sum.toJson()).parts?.length ?? 1, 1);
  assert.match(dymsum.drawSum(p, q, sum), /^<svg/);
});

test('corners of a sum are sums of vertices', () => {
  const p = shapes.gear(7, 1, 2);
  const q = shapes.star(5, 0.5, 1.5);
  const sum = dymsum.minkowskiSum(p, q, { trace: true });
  const { vertices, corners, atError } = sum.shape();
  const [a, b] = [p.shape().vertices, q.shape().vertices];
  let seen = 0;
  for (let k = 0; 2 * k < vertices.length; ++k) {
    const [i, j] = corners.subarray(2 * k, 2 * k + 2);
    if (i === NONE) continue;
    ++seen;
    for (const c of [0, 1]) assert.ok(Math.abs(a[2 * i + c] + b[2 * j + c] - vertices[2 * k + c]) <= atError + 1e-15);
  }
  assert.ok(seen > 10);
  const trace = sum.trace();
  assert.equal(trace.convolution.length, 4 * trace.convolutionEdgeOfP.length);
  assert.ok(sum.stats().reducedSegments > 0);
  assert.equal(dymsum.minkowskiSum(p, q).trace(), null);
  assert.match(dymsum.drawTrace(p, q, sum), /^<svg/);
  assert.ok(sum.rounded().area() > 0);
  assert.equal(sum.snapRounded().rounding.nearest, true);
  assert.ok(sum.snapRounded().region.area() > 0);
});

test('inner fits, unions, turned sums, membership, sizes', () => {
  assert.equal(dymsum.erode(shapes.rectangle(0, 0, 2, 2), shapes.rectangle(0, 0, 2, 2)).shape().points.length, 1);
  assert.equal(dymsum.unionOf([shapes.rectangle(0, 0, 2, 2), shapes.rectangle(1, 1, 3, 3)]).areaExact(), '7/1');
  const turned = dymsum.rotatedSum(shapes.rectangle(-1, -1, 1, 1), Region.fromData({ parts: [], points: [0, 0] }), { tanHalf: '1/2' });
  assert.equal(turned.areaExact(), '4/1');
  assert.equal(dymsum.contains(slot(), peg().negated(), { x: 1, y: 2 }), true);
  assert.equal(dymsum.contains(slot(), peg().negated(), { x: 1, y: 2 }, 'open'), false);
  const sizes = dymsum.convolutionSizes(slot(), peg());
  assert.ok(sizes.full >= sizes.kinetic && sizes.kinetic >= sizes.reduced);
  assert.equal(dymsum.nfp(Region.empty(), peg()).partCount, 0);
});

/** What the command line says of two operands: its result's area or volume, and how it ends. */
async function ofCommand(verb, a, b, extension, ...options) {
  const files = { [`a.${extension}`]: a.format(extension), [`b.${extension}`]: b.format(extension) };
  const { exit, stdout } = await dymsum.run([verb, ...Object.keys(files), '--json', '--exact', ...options], { files });
  return [JSON.parse(stdout)[extension === 'off' ? 'volume_exact' : 'area_exact'], exit];
}

test('Boolean operations of regions are those of the command line', async () => {
  // on no common grid: turned, decimal, single precision
  const gear = shapes.gear(9, 1, 2), bar = Region.fromRings([[[-3.1, -0.30000000000000004], [2.7, 0.1], [2.9, 0.7], [-3, Math.fround(0.3)]]]);
  const far = Region.fromRings([[[30, 0], [31, 0], [30, 1 / 3]]]);
  for (const semantics of ['closed', 'open', 'regular'])
    for (const b of [bar, gear, far]) {
      const options = { semantics }, told = ['--semantics', semantics];
      const [union, both, less] = [dymsum.united([gear, b], options), dymsum.intersection(gear, b, options), dymsum.difference(gear, b, options)];
      const empty = (set) => (set.partCount + set.shape().segments.length + set.shape().points.length === 0 ? 4 : 0);
      assert.deepEqual([union.areaExact(), 0], await ofCommand('union', gear, b, 'wkt', ...told));
      assert.deepEqual([both.areaExact(), empty(both)], await ofCommand('intersect', gear, b, 'wkt', ...told));
      assert.deepEqual([less.areaExact(), empty(less)], await ofCommand('subtract', gear, b, 'wkt', ...told));
      const one = dymsum.symmetricDifference(gear, b, options), other = dymsum.difference(b, gear, options);
      assert.ok(one.equals(dymsum.united([less, other], options)), semantics);
    }
  assert.equal(dymsum.united([]).partCount, 0);
  assert.equal(dymsum.united([gear, bar]).areaExact(), dymsum.unionOf([gear, bar]).areaExact());
});

test('results are operands, exactly', () => {
  const gear = shapes.gear(9, 1, 2), star = shapes.star(5, 0.3, 0.9), bar = Region.fromRings([[[-3.1, -0.3], [2.7, 0.1], [2.9, 0.7]]]);
  const both = dymsum.intersection(gear, bar), less = dymsum.difference(gear, bar);
  assert.ok(dymsum.united([both, less], { semantics: 'regular' }).equals(dymsum.united([gear])), 'cut in two and put together');
  assert.equal(dymsum.united([both, less]).shape().tightSegments.length, 4, 'where open sets leave out the cut');
  const sum = dymsum.minkowskiSum(gear, star), further = dymsum.minkowskiSum(sum, bar);
  assert.ok(further.equals(dymsum.minkowskiSum(gear, dymsum.minkowskiSum(star, bar))), 'sums of sums');
  assert.ok(dymsum.minkowskiSum(both, star).equals(dymsum.nfp(both, star.negated())));
  // What is summed over a union is the union of the sums.
  assert.ok(dymsum.united([dymsum.minkowskiSum(both, star), dymsum.minkowskiSum(less, star)]).equals(sum));
  assert.ok(dymsum.difference(dymsum.erode(sum, star), sum).partCount === 0 && dymsum.difference(gear, dymsum.erode(sum, star)).partCount === 0);
  const apart = dymsum.difference(shapes.rectangle(0, 0, 4, 4), shapes.rectangle(1, 1, 3, 3));
  assert.equal(dymsum.contains(apart, shapes.rectangle(0, 0, 0.5, 0.5), { x: 2, y: 2 }), false);
  assert.equal(dymsum.contains(apart, shapes.rectangle(-1, -1, 1, 1), { x: 2, y: 2 }), true);
  assert.equal(dymsum.intersection(shapes.rectangle(0, 0, 1, 1), shapes.rectangle(1, 0, 2, 1)).shape().segments.length, 2, 'an edge in common');
});

test('Boolean operations of solids are those of the command line', async () => {
  const ball = solids.geodesicSphere(2, 1.1), box = solids.box(0.1, -0.30000000000000004, 0, 2, 0.7, Math.fround(0.9)), far = solids.box(9, 9, 9, 10, 10, 10);
  for (const b of [box, ball, far]) {
    const both = dymsum.intersection(ball, b), less = dymsum.difference(ball, b), end = (solid) => (solid.faceCount === 0 ? 4 : 0);
    assert.deepEqual([dymsum.united([ball, b]).volumeExact(), 0], await ofCommand('union', ball, b, 'off'));
    assert.deepEqual([both.volumeExact(), end(both)], await ofCommand('intersect', ball, b, 'off'));
    assert.deepEqual([less.volumeExact(), end(less)], await ofCommand('subtract', ball, b, 'off'));
  }
  const one = dymsum.symmetricDifference(solids.box(0, 0, 0, 2, 2, 2), solids.box(1, 1, 1, 3, 3, 3));
  assert.equal(one.volumeExact(), '14/1');
  assert.equal(thrown(() => dymsum.united([ball, box], { memory: 1000 })).code, 'out_of_memory');
});

test('a turned box by its planes has six, and is the solid that the command line makes', async () => {
  const [c, s] = [Math.cos(0.4), Math.sin(0.4)], plain = solids.box(0, 0, 0, 1, 2, 3).shape();
  const turned = plain.vertices.map((v, k, all) => (k % 3 === 0 ? c * v - s * all[k + 1] : k % 3 === 1 ? s * all[k - 1] + c * v : v));
  const data = { vertices: turned, faces: plain.triangles }, made = dymsum.byPlanes(data);
  assert.deepEqual([made.solid.faceCount, made.solid.vertexCount, made.axes.length, made.bentFaces], [6, 8, 1, 0]);
  assert.ok(made.largestMove < 1e-12 && made.largestMove <= made.tolerance, `${made.largestMove}`);
  assert.match(made.report, /^12 faces became 6,/);
  const lines = (numbers, head) => Array.from({ length: numbers.length / 3 }, (_, k) => `${head}${[...numbers.subarray(3 * k, 3 * k + 3)].join(' ')}`);
  const off = ['OFF', '8 12 0', ...lines(turned, ''), ...lines(plain.triangles, '3 ')].join('\n');
  for (const [verb, operation, size] of [['sum', dymsum.minkowskiSum, 1], ['erode', dymsum.erode, 0.25]]) {
    const box = solids.box(0, 0, 0, size, size, size), files = { 'turned.off': off, 'box.off': box.format('off') };
    const { volume_exact: volume } = await reported([verb, 'turned.off', 'box.off', '--planes', '--exact'], files);
    const { vertices, faceStarts, faceVertices } = box.shape(), faces = [...faceStarts.subarray(1)].map((end, k) => [...faceVertices.subarray(faceStarts[k], end)]);
    const [first, second] = dymsum.byPlanes([data, { vertices, faces }]), other = second.solid; // as the command takes its operands
    assert.equal(operation(first.solid, other).volumeExact(), volume, verb);
    assert.ok(Math.abs(operation(made.solid, box).volume() - operation(made.solid, other).volume()) < 1e-11, verb);
  }
  assert.ok(dymsum.minkowskiSum(made.solid, made.solid).volume() > 47.99, 'twice as large');
  assert.ok(dymsum.byPlanes(data, { tolerance: 1e-9 }).tolerance === 1e-9);
  assert.equal(thrown(() => dymsum.byPlanes(data, { tolerance: 0 })).code, 'out_of_range');
});

test('a turned region by its lines has right angles and fits its slot', async () => {
  const [c, s] = [Math.cos(0.4), Math.sin(0.4)], turn = (ring) => ring.map(([x, y]) => [c * x - s * y, s * x + c * y]);
  const ell = dymsum.Region.fromRings([turn([[0, 0], [3, 0], [3, 1], [1, 1], [1, 2], [0, 2]])]);
  const made = dymsum.byLines(ell), sum = (region) => dymsum.minkowskiSum(region, region);
  assert.deepEqual([made.axes.length, made.looseEdges], [1, 0]);
  assert.equal(sum(made.region).shape().vertices.length / 2, 8, 'stairs of three steps');
  assert.ok(made.largestMove < 1e-12 && made.largestMove <= made.tolerance, `${made.largestMove}`);
  assert.match(made.report, /^6 edges became 6,/);
  const [first, second] = dymsum.byLines([ell, ell]);
  assert.ok(first.region.equals(second.region) && first.region.equals(made.region));
  assert.equal(thrown(() => dymsum.byLines(ell, { tolerance: 0 })).code, 'out_of_range');
  assert.equal(thrown(() => dymsum.byLines([1])).code, thrown(() => dymsum.unionOf([1])).code);
});

test('a scaling sum equals the sum of the scaled operand in every frame, and has its events', async () => {
  const p = shapes.star(6, 1, 2);
  const q = slot();
  const moving = dymsum.ScalingSum.create(p, q);
  for (const s of [1, 1.01, 1.02, 2, 0.5, '3/2']) {
    const changes = moving.set(s);
    assert.ok(Array.isArray(changes.rings));
    const factor = typeof s === 'string' ? 1.5 : s;
    if ([2, 0.5].includes(factor)) assert.ok(moving.sum().equals(dymsum.minkowskiSum(p.scaled(factor, factor), q)));
    assert.equal(moving.scale().approx, factor);
    assert.equal(moving.shape().ringStarts.length - 1, moving.ringIds().length);
  }
  assert.deepEqual(moving.scale(), { approx: 1.5, exact: '3/2' });
  const events = dymsum.ScalingSum.create(peg(), slot(), { reflectQ: true }).events(0.5, 3);
  assert.ok(events.some(({ visible }) => visible));
  assert.deepEqual(events.map(({ approx }) => approx), events.map(({ approx }) => approx).sort((a, b) => a - b));
  const next = moving.nextEvent(1, 3);
  assert.ok(next === null || next.approx > 1);
  assert.match(moving.combinatorialHash(), /^[0-9a-f]{16}$/);
  assert.equal(thrown(() => moving.set(0)).code, 'bad_scale');
  assert.equal(thrown(() => moving.set('nonsense')).code, 'malformed');
  assert.deepEqual(moving.scale().exact, '3/2');
  assert.equal(typeof moving.work().pieces, 'number');
});

test('an edited sum follows edits, undoes them and refuses what would be no region', () => {
  const p = shapes.star(6, 1, 2), q = slot(), edited = dymsum.EditableSum.create(p, q, { reflectQ: true });
  const same = () => assert.ok(edited.sum().equals(dymsum.nfp(edited.region('p'), edited.region('q'))));
  const hash = edited.hash(), names = Array.from(edited.vertexNames('p'));
  assert.match(hash, /^[0-9a-f]{16}$/);
  assert.ok(Array.isArray(edited.edit('p move 0 2.5 0.25').rings));
  same();
  const work = edited.work();
  assert.equal(typeof work.pairsTested, 'number');
  edited.edit('p insert 0 1.75 1\nq move 0 -0.25 0');
  same();
  assert.deepEqual(Array.from(edited.vertexNames('p')).filter((name) => names.includes(name)), names);
  assert.equal(edited.ringIds().length, edited.shape().ringStarts.length - 1);
  const before = edited.hash();
  const crossing = thrown(() => edited.edit('p move 0 -9 0'));
  assert.equal(crossing.code, 'self_crossing');
  assert.equal(typeof crossing.evidence.vertex, 'number');
  for (const lines of ['p move 0 1/3 0', 'undo', 'p mov 0 0 0']) assert.equal(thrown(() => edited.edit(lines)).code, 'malformed', lines);
  assert.equal(thrown(() => edited.edit('p remove 99')).code, 'out_of_range');
  assert.equal(edited.hash(), before);
  assert.equal(edited.undoCount(), 2);
  edited.undo(), edited.undo();
  assert.equal(edited.hash(), hash);
  assert.equal(thrown(() => edited.undo()).code, 'out_of_range');
  edited.redo(), edited.redo();
  assert.equal(edited.hash(), before);
  assert.equal(edited.redoCount(), 0);
  edited.dispose();
});

test('a family has every sum of its interval, its changes and lifetimes', () => {
  const p = shapes.gear(7, 1.1, 2), q = Region.fromRings([[[0.1, -0.3], [2.7, 0.1], [2.9, Math.fround(0.7)], [1, 0.6]]]), options = { reflectQ: true, semantics: 'open' };
  const family = dymsum.ScalingFamily.create(p, q, 0.5, 2, options), events = family.events(), moving = dymsum.ScalingSum.create(p, q, options);
  assert.deepEqual(events.filter(({ visible }) => visible), moving.events(0.5, 2).filter(({ visible }) => visible));
  assert.ok(events.length > 2, `${events.length} events`);
  const scales = [0.5, '2/3', 1.1, events[1].s, 2];
  for (const s of scales) {
    moving.set(s);
    assert.ok(family.at(s).equals(moving.sum()), s);
  }
  for (const change of ['visible', 'topology']) assert.deepEqual(family.changes(1, 2, change), events.filter((event) => event[change] && event.approx >= 1));
  const lives = family.lifetimes(), kinds = new Set(lives.map(({ feature }) => feature));
  assert.ok(lives.every(({ firstCell, lastCell }) => firstCell <= lastCell && lastCell <= events.length) && kinds.has('edge'));
  const begin = lives.filter(({ feature, firstCell }) => feature === 'vertex' && firstCell === 0);
  assert.equal(begin.length, family.at(0.5).shape().ringStarts.at(-1), 'the vertices of the first cell');
  const pegs = dymsum.ScalingFamily.create(shapes.pockets(3, 4), shapes.rectangle(0, 0, 1, 1), '1/4', 2, { moving: 'q', reflectQ: true });
  const holes = pegs.lifetimes().filter(({ feature }) => feature === 'hole').map(({ hole }) => hole);
  assert.equal(holes.length, 3);
  assert.deepEqual(Array.from(pegs.ringIds('1/4').slice(1)).sort(), holes.sort(), 'of one part all rings but the first are holes');
  assert.equal(pegs.ringIds(2).length, 1);
  assert.equal(thrown(() => pegs.ringIds(3)).code, 'bad_scale');
  const [inner, outer] = [family.inner(0.5, 2), family.outer(0.5, 2)], regular = { semantics: 'regular' };
  for (const s of scales) {
    assert.equal(dymsum.difference(inner, family.at(s), regular).partCount, 0, `${s}`);
    assert.equal(dymsum.difference(family.at(s), outer, regular).partCount, 0, `${s}`);
  }
  assert.ok(dymsum.difference(outer, inner, regular).partCount > 0);
  assert.equal(thrown(() => family.at(3)).code, 'bad_scale');
  assert.equal(thrown(() => dymsum.ScalingFamily.create(p, q, 2, 1)).code, 'bad_scale');
});

test('a turning sum equals the turned sum', () => {
  const p = shapes.star(5, 1, 2);
  const q = slot();
  const moving = dymsum.RotatingSum.create(p, q);
  for (const angle of [0.1, 0.11, { tanHalf: '1/3' }, Math.PI]) {
    moving.set(angle);
    assert.ok(moving.sum().equals(dymsum.rotatedSum(p, q, angle)));
  }
  assert.equal(moving.orientation().tanHalf, 'inf');
});

test('progress tells stages and can stop', () => {
  const stages = new Set();
  const p = shapes.spiral(5, 60, 1, 0.3);
  const q = shapes.gear(40, 1, 1.2);
  dymsum.minkowskiSum(p, q, { progress: (stage) => { stages.add(stage); } });
  assert.ok(stages.size > 0);
  assert.equal(thrown(() => dymsum.minkowskiSum(p, q, { progress: () => false })).code, 'cancelled');
  assert.throws(() => dymsum.minkowskiSum(p, q, { progress: () => { throw new RangeError('mine'); } }), /mine/);
  assert.ok(dymsum.minkowskiSum(p, q).area() > 0);
});

test('depths and ranges of scales', () => {
  const depth = dymsum.PlanarDepth.create(shapes.rectangle(0, 0, 4, 4), shapes.rectangle(0, 0, 2, 2));
  const inside = depth.at(1.5, 0);
  assert.deepEqual([inside.meeting, inside.squared, inside.distance], ['overlapping', '4/1', 2]);
  assert.equal(depth.at(10, 0).meeting, 'apart');
  assert.deepEqual(inside.ways[0].approx, { x: 0, y: -2 });
  const range = dymsum.scaleRange(peg(), [[9, 9]], slot());
  assert.equal(range.free.length, 1);
  const fit = dymsum.fitRange(shapes.rectangle(0, 0, 2, 1), shapes.rectangle(0, 0, 4, 4));
  assert.equal(fit.free[0].high, '2/1');
  assert.ok(fit.free[0].atHigh.length > 0);
});

test('an obstacle: slices, mesh, clearance, paths and why there is none', () => {
  const robot = shapes.rectangle(-1, -0.25, 1, 0.25);
  const wall = shapes.rectangle(0, 0, 4, 4);
  const obstacle = dymsum.CspaceObstacle.create(robot, wall);
  assert.ok(obstacle.angles().length > 0);
  assert.ok(obstacle.patches().length > 0);
  assert.equal(obstacle.shells().length, 1);
  assert.ok(obstacle.events().every(({ angle }) => angle < obstacle.angles().length));
  assert.ok(obstacle.slice({ tanHalf: '1/3' }).equals(dymsum.cspaceSlice(robot, wall, { tanHalf: '1/3' })));
  assert.equal(obstacle.contains(2, 2, 0), true);
  const outline = obstacle.outline(0.3);
  assert.equal(outline.starts.at(-1), outline.patches.length);
  const [first] = obstacle.patchEnds(outline.patches[0], 0.3);
  assert.ok(Math.hypot(first.x - outline.vertices[0], first.y - outline.vertices[1]) < 1e-9);
  const mesh = obstacle.mesh({ tolerance: 0.01 });
  assert.ok(mesh.watertight);
  assert.equal(mesh.triangles.length, 3 * mesh.patches.length);
  assert.equal(String.fromCharCode(...obstacle.glb({ tolerance: 0.01 }).subarray(0, 4)), 'glTF');
  const queries = obstacle.queries();
  const clearance = queries.clearance({ x: 4.5, y: 2, theta: Math.PI / 2 }, { weight: Infinity });
  assert.equal(clearance.distance, 0.25);
  assert.ok(queries.clearance({ x: 2, y: 2, theta: 0 }).distance < 0);
  assert.equal(queries.contains({ x: 2, y: 2, theta: 0 }), true);
  assert.ok(queries.freeAngles(4.5, 2).length > 0);
  assert.ok(queries.gyrationRadius() > 0);
  const way = obstacle.plan({ x: -3, y: 2, theta: 0 }, { x: 8, y: 2, theta: 1 });
  assert.equal(way.reason, null);
  assert.equal(way.path[0].move, 'start');
  assert.equal(way.path.at(-1).x, 8);
  const box = Region.fromRings([[-9, -9, 9, -9, 9, 9, -9, 9], [-5, -5, -5, 5, 5, 5, 5, -5]]);
  const none = dymsum.CspaceObstacle.create(robot, box).plan({ x: 0, y: 0, theta: 0 }, { x: 20, y: 0, theta: 0 });
  assert.equal(none.reason.kind, 'separated');
  assert.equal(none.path.length, 0);
  const again = dymsum.CspaceObstacle.read('o.obstacle', obstacle.format());
  assert.equal(again.patches().length, obstacle.patches().length);
  const check = dymsum.checkPath(robot, wall, [{ x: -3, y: 2, theta: 0 }, { x: 8, y: 2, theta: 0 }]);
  assert.equal(check.outcome, 'blocked');
  assert.ok(check.contact);
  assert.ok(obstacle.work().patches !== 0 && obstacle.mayHaveTightCurves() === false && obstacle.tight().length === 0);
});

test('a plan without the obstacle, where slices at the two angles tell it', () => {
  const bar = shapes.rectangle(-1.5, -0.25, 1.5, 0.25), grate = shapes.grate(4, 2, 1, 6), start = { x: -4, y: 3, theta: 0 };
  const direct = dymsum.directPlan(bar, grate, start, { ...start, theta: 1 });
  assert.equal(direct.reason, null);
  assert.deepEqual(direct.path.map(({ move }) => move), ['start', 'counter_clockwise']);
  assert.deepEqual(direct.path, dymsum.CspaceObstacle.create(bar, grate).plan(start, { ...start, theta: 1 }).path);
  const inside = dymsum.directPlan(bar, grate, { x: 0.5, y: 3, theta: 0 }, start);
  assert.deepEqual([inside.reason.kind, inside.path], ['start_not_free', []]);
  const slotted = { x: 1.5, y: 3, theta: Math.PI / 2 };
  assert.equal(dymsum.directPlan(bar, grate, slotted, { ...slotted, x: 12, theta: 0.3 }, { touching: 'forbidden' }), null);
});

test('third coordinates are refused, or left out where that is asked for', () => {
  const text = 'POLYGON Z ((0 0 1, 4 0 1, 0 3 2, 0 0 1))', options = { thirdCoordinates: 'dropped' };
  for (const read of [(...how) => Region.read('a.wkt', text, ...how), (...how) => Region.readAll('a.wkt', text, ...how), (...how) => Region.readData('a.wkt', text, ...how)]) {
    assert.equal(thrown(() => read()).code, 'malformed');
    assert.equal(thrown(() => read({ thirdCoordinates: 'refused' })).code, 'malformed');
    read(options);
  }
  assert.equal(Region.read('a.wkt', text, options).area(), 6);
  assert.equal(Region.readAll('a.geojson', '{"type":"Point","coordinates":[1,2,3]}', options).length, 1);
  assert.deepEqual([...Region.readData('a.wkt', text, options)[0].shape.vertices], [0, 0, 4, 0, 0, 3]);
  assert.equal(thrown(() => Region.read('a.wkt', text, { thirdCoordinates: 'kept' })).code, 'malformed');
});

test('parts without volume stay in a repair that is told so', () => {
  // two triangles with an edge in common, whose ends are there twice
  const data = { vertices: [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0], faces: [[0, 1, 2], [3, 4, 5]] };
  assert.equal(thrown(() => Mesh.repair(data)).code, 'not_closed');
  const { mesh, changed } = Mesh.repair(data, { thinParts: true });
  assert.deepEqual([mesh.vertexCount, mesh.faceCount, mesh.volume(), changed], [4, 2, 0, true]);
  const off = 'OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 3 4 5\n';
  assert.equal(Mesh.read('a.off', off, { repair: true, thinParts: true }).vertexCount, 4);
});

test('files of solids and obstacles are those that the command line writes', async () => {
  const ell = solids.prism([0, 0, 2, 0, 2, 1, 1, 1, 1, 2, 0, 2], 1), box = solids.box(0, 0, 0, 1, 1, 0.1), files = { 'ell.off': ell.format('off'), 'box.off': box.format('off') };
  const formats = ['off', 'obj', 'stl', 'ply', 'glb'], outputs = [...formats, 'json'].flatMap((format) => ['-o', `o.${format}`]);
  const same = async (args, sum) => {
    const { files: made } = await dymsum.run([...args, ...outputs], { files });
    for (const format of formats) assert.deepEqual(Buffer.from(sum.format(format)), Buffer.from(made[`o.${format}`]), format);
    assert.equal(sum.toJson(), new TextDecoder().decode(made['o.json']));
  };
  await same(['sum', 'ell.off', 'box.off'], dymsum.minkowskiSum(ell, box));
  await same(['nfp', 'ell.off', 'ell.off', '--semantics', 'open'], dymsum.minkowskiSum(ell, ell.negated(), { semantics: 'open' }));
  await same(['sum', 'box.off', 'box.off'], dymsum.ConvexSum.create(box, box));
  assert.equal(thrown(() => dymsum.ConvexSum.create(box, box).format('dwg')).code, 'malformed');
  const regions = { 'slot.wkt': slot().format('wkt'), 'peg.wkt': peg().format('wkt') }, obstacle = dymsum.CspaceObstacle.create(peg(), slot());
  const { files: made } = await dymsum.run(['cspace', 'peg.wkt', 'slot.wkt', '-o', 'o.glb', '-o', 'o.obstacle'], { files: regions });
  assert.deepEqual(Buffer.from(obstacle.glb()), Buffer.from(made['o.glb']));
  assert.equal(obstacle.format(), new TextDecoder().decode(made['o.obstacle']));
});

test('an obstacle stays for its queries when it is disposed of', () => {
  const obstacle = dymsum.CspaceObstacle.create(peg(), slot());
  const queries = obstacle.queries();
  obstacle.dispose();
  assert.equal(queries.contains({ x: 100, y: 0, theta: 0 }), false);
});

test('a mesh is read, asked and written', () => {
  const box = solids.box(0, 0, 0, 1, 2, 3);
  assert.deepEqual([box.volume(), box.surfaceArea(), box.shellCount, box.faceCount], [6, 22, 1, 6]);
  assert.deepEqual(box.bounds(), [0, 0, 0, 1, 2, 3]);
  assert.equal(box.convexityError(), null);
  const shape = box.shape();
  assert.equal(shape.triangles.length, 36);
  assert.equal(shape.faceStarts.at(-1), 24);
  for (const format of ['off', 'obj', 'stl', 'ply'])
    assert.equal(Mesh.read(`b.${format}`, box.format(format)).volume(), 6, format);
  assert.equal(String.fromCharCode(...box.format('glb').subarray(0, 4)), 'glTF');
  const { vertices, triangles } = shape;
  assert.ok(Mesh.fromData({ vertices, faces: triangles }).equals(box));
  assert.equal(Mesh.convexHull([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]).volume(), 1 / 6);
  assert.equal(box.translated(1, 0, 0).scaled(2, 1, 1).negated().volume(), 12);
  const open = thrown(() => Mesh.fromData({ vertices: [0, 0, 0, 1, 0, 0, 0, 1, 0], faces: [[0, 1, 2]] }));
  assert.equal(open.code, 'not_closed');
  assert.equal(Mesh.fromData({ vertices: [0, 0, 0, 1, 0, 0, 0, 1, 0], faces: [[0, 1, 2]] }, { thinParts: true }).faceCount, 1);
  assert.equal(Mesh.readData('x.off', box.format('off')).faceVertices.length, 24);
  assert.equal(Mesh.repair({ vertices, faces: triangles }).changed, false);
  const ell = solids.prism([0, 0, 2, 0, 2, 1, 1, 1, 1, 2, 0, 2], 1);
  assert.equal(ell.convexityError().code, 'not_convex');
  assert.equal(ell.convexHull().convexityError(), null);
});

test('solids have the coordinates that are given, and snap where that is asked for', () => {
  const box = solids.box(0, 0, 0, 0.1, 1, 1), snapped = solids.box(0, 0, 0, 0.1, 1, 1, 0.125);
  assert.equal(box.bounds()[3], 0.1);
  assert.equal(snapped.bounds()[3], 0.125);
  assert.equal(thrown(() => solids.box(0, 0, 0, 1, 1, 1, 0.3)).code, 'invalid_argument');
  assert.ok(thrown(() => solids.cone(12, 1)));
  for (const mesh of [box, snapped]) mesh.dispose();
});

test('sums of solids: shape, provenance, exact values, slices', () => {
  const ell = solids.prism([0, 0, 2, 0, 2, 1, 1, 1, 1, 2, 0, 2], 1);
  const box = solids.box(0, 0, 0, 1, 1, 1);
  const sum = dymsum.minkowskiSum(ell, box);
  assert.equal(sum.volumeExact(), '16/1');
  assert.equal(sum.volume(), 16);
  const shape = sum.shape();
  assert.equal(shape.faceContacts.length, 6 * sum.faceCount);
  assert.equal(shape.triangleFaces.length * 3, shape.triangles.length);
  assert.ok(shape.triangles.every((v) => v < sum.vertexCount));
  const exact = sum.exact(shape.triangles[0]);
  assert.equal(exact.x, `${shape.vertices[3 * shape.triangles[0]]}/1`);
  assert.ok(sum.asMesh().volume() === 16);
  assert.equal(Mesh.read('s.off', sum.format('off')).volume(), 16);
  assert.ok(sum.equals(dymsum.minkowskiSum(ell, box, { engine: 'brute' })));
  assert.equal(dymsum.contains(ell, box, { x: 0.5, y: 0.5, z: 0.5 }), true);
  const slice = dymsum.sliceOfSum(ell, box, 1);
  assert.equal(slice.section.areaExact(), '8/1');
  assert.equal(slice.touching().partStarts[0], 0);
  assert.ok(sum.stats().faceVertex > 0 && sum.tightContacts().faces.length === 0);
  assert.ok(sum.area() > 0);
});

test('solids that move: any shape, convex, scaling, turning', () => {
  const ell = solids.prism([0, 0, 2, 0, 2, 1, 1, 1, 1, 2, 0, 2], 1);
  const box = solids.box(-1, -1, -1, 1, 1, 1);
  const moving = dymsum.MovingSolidSum.create(ell, box);
  moving.set({ rotation: { axis: [0, 0, 1], angle: 0.1 } });
  moving.set({ rotation: { quaternion: [1, 0, 0, 1] }, scale: [1, 1, '3/2'] });
  assert.equal(moving.faceChanges().length, moving.sum().faceCount);
  assert.equal(moving.shape().faceContacts.length, 6 * moving.sum().faceCount);
  assert.ok(Array.isArray(moving.changes().appeared));
  assert.equal(moving.sum().volumeExact(), '105/2');
  const convex = dymsum.ConvexSum.create(box, solids.geodesicSphere(2, 1, 2 ** -20));
  convex.set({ rotation: { axis: [1, 2, 3], angle: 0.3 } });
  const buffers = convex.buffers();
  assert.equal(buffers.triangleFacets.length * 3, buffers.triangles.length);
  assert.ok(buffers.facetCount === convex.facetCount().all);
  assert.equal(typeof convex.exact(buffers.triangles[0]).x, 'string');
  assert.ok(convex.depth().inside && convex.support({ x: 1, y: 0, z: 0 }).at.x > 0);
  assert.ok(Math.abs(convex.mesh().volume() - convex.volume()) < 1e-6);
  assert.equal(convex.sum().volumeExact(), convex.volumeExact());
  const scaling = dymsum.SolidScaleEvents.create(ell, box);
  assert.equal(scaling.at(1).volumeExact(), dymsum.minkowskiSum(ell, box).volumeExact());
  const cup = solids.prism([0, 0, 3, 0, 3, 3, 2, 3, 2, 1, 1, 1, 1, 3, 0, 3], 1);
  const [closes] = dymsum.SolidScaleEvents.create(cup, box).events('1/8', 4);
  assert.deepEqual(closes, { s: '1/2', approx: 0.5, kind: 'coplanar_facets', visible: true, topology: true });
  const turning = dymsum.SolidRotationEvents.create(ell, box, [0, 0, 1], { changes: false });
  assert.equal(turning.at(0).volumeExact(), dymsum.minkowskiSum(ell, box).volumeExact());
  assert.ok(turning.events(0.1, 1.7).length > 0);
});

test('depths of solids', () => {
  const depth = dymsum.SolidDepth.create(solids.box(0, 0, 0, 4, 4, 4), solids.box(0, 0, 0, 2, 2, 2));
  const found = depth.at(1.5, 1, 1);
  assert.deepEqual([found.meeting, found.squared], ['overlapping', '25/4']);
  assert.ok(depth.facetCount > 0);
});

test('growing discs, bars and pieces', () => {
  const disc = dymsum.GrowingDisc.create(slot());
  assert.deepEqual(disc.events('outside').map(({ radius }) => radius), [1]);
  const grown = disc.sumAt({ event: 0 }, 'open');
  assert.equal(grown.shape().tightSegments.length, 4);
  assert.ok(Math.abs(grown.area().value - 34.712389) < 1e-6);
  assert.ok(grown.toRegion(0.01).region.area() < grown.area().value);
  assert.match(grown.svg(slot()), /^<svg/);
  assert.equal(disc.erodedAt('1/2').shape().parts.length + disc.erodedAt('1/2').shape().segments.length > 0, true);
  const arcs = disc.closedAt(1).shape().parts[0].outer.filter(({ arc }) => arc !== null);
  assert.ok(disc.openedAt('1/4').perimeter().value > 0 && Array.isArray(arcs));
  const features = dymsum.ShapeFeatures.create(shapes.comb(5, 2, 1, 3));
  assert.equal(features.bars().length, 8);
  assert.deepEqual([...features.lasting(2, 0, 5)], [0, 2, 4, 6]);
  assert.deepEqual([...features.significant(4)], []);
  assert.ok(features.bridges(0.5).length > 0);
  assert.equal(typeof features.eventText(0), 'string');
  assert.ok(features.eventAlpha(features.eventCount - 1) >= features.eventAlpha(0));
  const made = features.decompose({ persistence: 2 });
  assert.equal(made.cuts.length, 3); // the cut of the middle tooth ends the notches on both sides
  assert.equal(made.areas[0], 15);
  assert.deepEqual([...made.colours], [1, 0, 0, 0], 'three teeth, and what holds them');
  assert.equal(made.pieces.partStarts.length - 1, made.areas.length);
});

test('memory is given back', () => {
  const p = shapes.gear(20, 1, 2);
  const q = shapes.star(9, 0.5, 1);
  const once = () => dymsum.minkowskiSum(p, q).dispose();
  for (let k = 0; k < 200; ++k) once();
  const before = dymsum.memoryBytes();
  for (let k = 0; k < 2000; ++k) once();
  assert.equal(dymsum.memoryBytes(), before);
});

test('what needs more memory than there is throws, and the module goes on', () => {
  const torn = thrown(() => dymsum.minkowskiSum(solids.geodesicSphere(12, 1, 2 ** -20), solids.prism([0, 0, 2, 0, 2, 1, 1, 1, 1, 2, 0, 2], 1), { memory: 1000 }));
  assert.equal(torn.code, 'out_of_memory');
  assert.equal(dymsum.minkowskiSum(peg(), peg()).areaExact(), '8/1');
});

test('every name of index.d.ts is there', () => {
  const types = readFileSync(new URL('../index.d.ts', import.meta.url), 'utf8');
  const names = [...types.slice(types.indexOf('export interface Dymsum ')).matchAll(/^ {2}(?:readonly )?(\w+)[(:]/gm)].map(([, name]) => name);
  for (const name of names) assert.ok(dymsum[name] !== undefined, name);
  assert.ok(names.length > 50, `${names.length} names`);
});

test('inner fits, openings, closings and offsets of solids', () => {
  const block = solids.box(0, 0, 0, 4, 4, 4), rod = solids.box(-1, -1, -1, 1, 1, 1);
  assert.equal(dymsum.erode(block, rod).volumeExact(), '8/1');
  const flat = dymsum.erode(solids.box(0, 0, 0, 4, 4, 2), rod);
  assert.equal(flat.volumeExact(), '0/1');
  assert.equal(flat.shape().tightTriangles.length, 6, 'a plate of positions without room to move');
  const { solid, moved } = dymsum.opening(block, rod);
  assert.deepEqual([solid.volumeExact(), moved], ['64/1', 0]);
  assert.equal(dymsum.closing(block, rod).solid.volumeExact(), '64/1');
  const grown = dymsum.offset(block, 1, 0.125, { bound: 'outside' }), exact = 64 + 6 * 16 + 12 * Math.PI + (4 / 3) * Math.PI;
  assert.ok(grown.low >= 1 && grown.high <= 1.125 && grown.solid.volume() >= exact, `${grown.low} ${grown.high}`);
  assert.equal(thrown(() => dymsum.offset(block, 0, 0.125)).code, 'out_of_range');
});

test('sums near a place are the whole sums, cut', () => {
  const near = dymsum.PlanarLocalSum.create(slot(), peg().negated());
  const part = near.in({ low: { x: 0.5, y: 0 }, high: { x: 1.5, y: 3 } }), { tightSegments, vertices } = part.shape();
  assert.equal(part.where, 'crossed');
  assert.deepEqual([...tightSegments].map((v) => [...vertices.subarray(2 * v, 2 * v + 2)]), [[1, 1], [1, 3]]);
  assert.deepEqual(part.exact(tightSegments[0]), { x: '1/1', y: '1/1' });
  assert.ok(part.equals(dymsum.PlanarLocalSum.create(slot(), peg().negated(), { engine: 'brute' }).in(part.box())));
  assert.equal(near.in({ middle: { x: 20, y: 0 }, radius: 1 }).where, 'outside');
  const space = dymsum.LocalSum.create(solids.box(0, 0, 0, 4, 4, 4), solids.box(0, 0, 0, 1, 1, 1));
  const corner = space.in({ low: { x: 4, y: 4, z: 4 }, high: { x: 6, y: 6, z: 6 } });
  assert.equal(corner.where, 'crossed');
  assert.equal(corner.boundary.faceCount, 3, 'the sides of the sum');
  assert.equal(space.in({ middle: { x: 2, y: 2, z: 2 }, radius: 1 }).where, 'inside');
});

test('many points in a sum, and scales of solids', () => {
  const locator = dymsum.SumLocator.of(dymsum.minkowskiSum(slot(), peg()));
  assert.deepEqual([...locator.containsEach([[0, 0], [6, 5], [6.5, 5], [-0.5, 0]])], [1, 1, 0, 0]);
  assert.equal(locator.contains({ x: '1/3', y: '1/7' }), true);
  const range = dymsum.fitRange(solids.box(-1, -1, -1, 1, 1, 1), solids.box(-3, -3, -2, 3, 3, 2));
  assert.deepEqual(range.free.map(({ low, high }) => [low, high]), [[null, '2/1']]);
  const path = dymsum.scaleRange(solids.box(-1, -1, -1, 1, 1, 1), [[-9, 0, 0], [9, 0, 0]], solids.box(-1, 2, -5, 1, 4, 5));
  assert.deepEqual(path.free.map(({ low, high }) => [low, high]), [[null, '2/1']]);
});

test('what is disposed of while it is at work lives until that ends', () => {
  const block = solids.box(0, 0, 0, 9, 9, 9), cone = solids.cone(12, 1, 2, 2 ** -20);
  const dispose = () => void (block.dispose(), cone.dispose(), dymsum.shapes.gear(50, 1, 2));
  assert.equal(dymsum.erode(block, cone, { progress: dispose }).volumeExact(), '343/1');
  assert.equal(thrown(() => dymsum.erode(block, cone)).code, 'invalid_argument');
  assert.equal(thrown(() => block.faceCount).code, 'invalid_argument', 'a property of what is disposed of');
});

test('indices and counts are integers, places are finite', () => {
  const sum = dymsum.nfp(slot(), peg()), corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]].flat();
  for (const index of [-1, NaN, Infinity, 2 ** 32, 2 ** 32 + 1, 0.5, undefined, 'abc'])
    assert.equal(thrown(() => sum.exact(index)).code, 'bad_index', `${index}`);
  for (const index of [NaN, 2 ** 32, 1.5, 'zero'])
    assert.equal(thrown(() => Mesh.fromData({ vertices: corners, faces: [[index, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] })).code, 'bad_index', `${index}`);
  for (const count of [2 ** 30 + 1, 2 ** 32 + 5, 5.5, NaN]) assert.equal(thrown(() => shapes.gear(count, 1, 2)).code, 'invalid_argument', `${count}`);
  for (const at of [{ x: NaN, y: 0 }, { x: 0 }, { x: 0, y: Infinity }]) assert.equal(thrown(() => dymsum.contains(slot(), peg(), at)).code, 'not_finite');
  assert.equal(thrown(() => dymsum.contains(Mesh.fromData({ vertices: corners, faces: [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] }), solids.box(0, 0, 0, 1, 1, 1), { x: 0, y: 0 })).code, 'not_finite');
  assert.equal(dymsum.minkowskiSum(slot(), peg()).areaExact(Infinity), '30/1');
});

test('huge, foreign and wrong inputs', async () => {
  assert.equal(thrown(() => Region.read('a.wkt', { byteLength: 2 ** 31 })).code, 'out_of_memory');
  assert.equal(thrown(() => dymsum.unionOf([slot(), null])).code, 'invalid_argument');
  assert.equal(thrown(() => Region.read('bow.wkt', 'POLYGON ((0 0, 1 1, 1 0, 0 1, 0 0))')).evidence.file, 'bow.wkt');
  const bytes = runInNewContext(`Uint8Array.from([...'POLYGON((0 0,1 0,0 1,0 0))'].map((c) => c.charCodeAt(0)))`);
  for (const foreign of [bytes, bytes.buffer]) assert.equal(Region.read('a.wkt', foreign).area(), 0.5);
  const { exit, stdout } = await dymsum.run(['convert', '-', '-', '--from', 'wkt', '--to', 'poly'], { stdin: bytes.buffer });
  assert.equal(exit, 0);
  assert.match(stdout, /3 out/);
  await assert.rejects(load({ wasmBinary: new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0]) }));
});

test('files of a command have any name that a file can have', async () => {
  const text = 'POLYGON((0 0,1 0,0 1,0 0))';
  assert.deepEqual((await dymsum.run(['info', 'b.wkt'], { files: { './a/../b.wkt': text } })).files, {});
  const made = await dymsum.run(['convert', 'b.wkt', '/tmp/c.wkt'], { files: { 'b.wkt': text } });
  assert.deepEqual(Object.keys(made.files), ['/tmp/c.wkt']);
  for (const name of ['', '.', 'b.wkt/x'])
    await assert.rejects(dymsum.run(['info', 'b.wkt'], { files: { 'b.wkt': text, [name]: text } }), { name: 'DymsumError', code: 'invalid_argument' });
  await assert.rejects(dymsum.run(['info', 'b.wkt\0x'], { files: { 'b.wkt': text } }), { code: 'invalid_argument' });
});
