// What a page saves is byte by byte what the command writes that it shows: the native program's file, of the same inputs.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, commandHash, download, launch, open, readout, set } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

const native = process.env.DYMSUM_NATIVE ?? fileURLToPath(new URL('../../../build/release/dymsum', import.meta.url));
if (!existsSync(native)) throw new Error(`${native} is not there: cmake --build build/release --target dymsum_cli`);

type Files = Record<string, string>;

/** The files that a command makes. */
function written(args: readonly string[], inputs: Files, names: readonly string[]): Record<string, Buffer> {
  const folder = mkdtempSync(join(tmpdir(), 'dymsum-'));
  try {
    for (const [name, text] of Object.entries(inputs)) writeFileSync(join(folder, name), text);
    const { status, stderr } = spawnSync(native, args, { cwd: folder, encoding: 'utf8' });
    expect(`${status} ${stderr}`).toMatch(/^0 /);
    return Object.fromEntries(names.map((name) => [name, readFileSync(join(folder, name))]));
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** Solids over a polygon that runs counter-clockwise. */
function prism(base: readonly (readonly [number, number])[], low: number, high: number): string {
  const n = base.length, around = base.map((_, k) => k), vertices = [low, high].flatMap((z) => base.map(([x, y]) => `${x} ${y} ${z}`));
  const faces = [[...around].reverse(), around.map((k) => k + n), ...around.map((k) => [k, (k + 1) % n, ((k + 1) % n) + n, k + n])];
  return ['OFF', `${2 * n} ${n + 2} 0`, ...vertices, ...faces.map((f) => `${f.length} ${f.join(' ')}`), ''].join('\n');
}
const kBox = prism([[-0.5, -0.5], [0.75, -0.5], [0.75, 0.5], [-0.5, 0.5]], -0.5, 0.5);
const kWedge = prism([[0, 0], [3.1, 0.2], [0.4, 2.7]], 0, 1.3);
const kChannel = prism([[0, 0], [4, 0], [4, 4], [3, 4], [3, 1], [1, 1], [1, 4], [0, 4]], 0, 3);
const kBar = prism([[0, 0], [2, 0], [2, 1], [0, 1]], 0, 1); // as wide as the channel
const kPlate = 'POLYGON ((0 0, 10 0, 10 6, 0 6, 0 0), (3 2, 4 2, 4 3, 3 3, 3 2))';
const kPeg = 'POLYGON ((-0.5 -0.5, 0.5 -0.5, 0.5 0.5, -0.5 0.5, -0.5 -0.5))';
const kTurned = 'POLYGON ((0.1 -0.7, 1.3 0.2, 0.3 1.1, -0.9 0.4, 0.1 -0.7))'; // of decimal coordinates, off the axes
const kSlot = 'POLYGON ((0 0, 4 0, 4 4, 3 4, 3 1, 1 1, 1 4, 0 4, 0 0))';
const kFit = 'POLYGON ((0 0, 2 0, 2 1, 0 1, 0 0))';

interface Case {
  name: string;
  page: string;
  /** the command, whose inputs and options the page is opened with */
  verb: string;
  inputs: Files;
  options?: Record<string, string | boolean>;
  arrange?: (page: Page) => Promise<void>;
  /** labels of what is saved, with the name of the command's file */
  files: Record<string, string>;
  known: string;
}

const kOfSum = { 'Picture (SVG)': 'o.svg', 'Sum, rounded (WKT)': 'o.wkt', 'Sum, exact (JSON)': 'o.json', 'Sum, rounded (GeoJSON)': 'o.geojson', 'Sum, rounded (.poly)': 'o.poly' };
const kOfFit = Object.fromEntries(Object.entries(kOfSum).map(([label, file]) => [label.replace('Sum', 'Inner fit'), file]));
const kOfSolids = { 'Sum (GLB)': 'o.glb', 'Sum (STL)': 'o.stl', 'Sum (OFF)': 'o.off', 'Sum, exact (JSON)': 'o.json' };
const kOfSolidFit = Object.fromEntries(Object.entries(kOfSolids).map(([label, file]) => [label.replace('Sum', 'Fit'), file]));
const kOfDiscs = { 'Picture (SVG)': 'o.svg', 'Set with true arcs (JSON)': 'o.json', 'Polygons (WKT)': 'o.wkt' };

const kOfNfp = { 'Picture (SVG)': 'o.svg', 'No-fit polygon, rounded (WKT)': 'o.wkt', 'No-fit polygon, exact (JSON)': 'o.json' };

const turn = (degrees: string) => async (page: Page): Promise<void> => {
  await set(page, 'Turn', degrees);
  await page.waitForTimeout(500);
};

const kCases: Case[] = [
  { name: 'a sum', page: 'sum', verb: 'sum', inputs: { 'plate.wkt': kPlate, 'turned.wkt': kTurned }, files: kOfSum, known: 'area' },
  { name: 'a sum with tight points', page: 'sum', verb: 'sum', inputs: { 'plate.wkt': kPlate, 'peg.wkt': kPeg }, options: { semantics: 'open' }, files: kOfSum, known: 'area' },
  { name: 'an inner fit', page: 'sum', verb: 'erode', inputs: { 'plate.wkt': kPlate, 'turned.wkt': kTurned }, files: kOfFit, known: 'area' },
  { name: 'a region alone', page: 'sum', verb: 'convert', inputs: { 'plate.wkt': kPlate }, files: { 'Picture (SVG)': 'o.svg', 'Shape (WKT)': 'o.wkt', 'Shape (GeoJSON)': 'o.geojson', 'Shape (.poly)': 'o.poly' }, known: 'area' },
  { name: 'a solid alone', page: 'solids', verb: 'convert', inputs: { 'p.off': kChannel }, files: { 'Solid (GLB)': 'o.glb', 'Solid (STL)': 'o.stl', 'Solid (OFF)': 'o.off', 'Solid (OBJ)': 'o.obj', 'Solid (PLY)': 'o.ply' }, known: 'Volume' },
  { name: 'a sum of convex solids', page: 'solids', verb: 'sum', inputs: { 'p.off': kWedge, 'q.off': kBox }, files: kOfSolids, known: 'Volume' },
  { name: 'the places at which convex solids meet', page: 'solids', verb: 'nfp', inputs: { 'p.off': kWedge, 'q.off': kBox }, files: kOfSolids, known: 'Volume' },
  { name: 'a sum of solids of any shape', page: 'solids', verb: 'sum', inputs: { 'p.off': kChannel, 'q.off': kBox }, files: kOfSolids, known: 'Volume' },
  { name: 'an exact fit of solids', page: 'solids', verb: 'nfp', inputs: { 'p.off': kChannel, 'q.off': kBar }, options: { semantics: 'open' }, files: kOfSolids, known: 'Volume' },
  { name: 'an inner fit of solids', page: 'solids', verb: 'erode', inputs: { 'p.off': kChannel, 'q.off': kBar }, files: kOfSolidFit, known: 'Volume' },
  { name: 'a convex solid that is scaled', page: 'solids', verb: 'scale', inputs: { 'p.off': kWedge, 'q.off': kBox }, options: { at: '3/7' }, files: kOfSolids, known: 'Volume' },
  { name: 'a solid of any shape that is scaled', page: 'solids', verb: 'scale', inputs: { 'p.off': kChannel, 'q.off': kBox }, options: { at: '3/7', scaled: 'q' }, files: kOfSolids, known: 'Volume' },
  { name: 'a convex solid that is turned', page: 'solids', verb: 'rotate', inputs: { 'p.off': kWedge, 'q.off': kBox }, options: { steps: '1', axis: '1,2,3', degrees: '37' }, arrange: turn('37'), files: kOfSolids, known: 'Volume' },
  { name: 'a solid of any shape that is turned', page: 'solids', verb: 'rotate', inputs: { 'p.off': kChannel, 'q.off': kBox }, options: { steps: '1', axis: '1,2,3', degrees: '37' }, arrange: turn('37'), files: kOfSolids, known: 'Volume' },
  { name: 'a no-fit polygon', page: 'nesting', verb: 'nfp', inputs: { 'slot.wkt': kSlot, 'peg.wkt': kFit }, options: { semantics: 'open' }, files: kOfNfp, known: 'vertices' },
  { name: 'an obstacle', page: 'obstacle', verb: 'cspace', inputs: { 'peg.wkt': kFit, 'slot.wkt': kSlot }, files: { 'Obstacle (GLB)': 'o.glb', 'Obstacle, exact (.obstacle)': 'o.obstacle' }, known: 'Patches, shells' },
  { name: 'a slice', page: 'obstacle', verb: 'slice', inputs: { 'peg.wkt': kTurned, 'slot.wkt': kSlot }, options: { 'tan-half': '1/3' }, files: { 'Slice (WKT)': 'o.wkt' }, known: 'Patches, shells' },
  ...(['sum', 'erosion', 'opening', 'closing'] as const).map((name): Case => ({ name: `a disc's ${name}`, page: 'discs', verb: 'disc', inputs: { 'plate.wkt': kPlate }, options: { radius: '1/3', set: name }, files: kOfDiscs, known: 'area' })),
];

/** One command writes all files, but for `convert`, which writes one. */
function expectedOf({ verb, inputs, options = {}, files }: Case): Record<string, Buffer> {
  const names = Object.values(files), given = Object.entries(options).flatMap(([name, value]) => [`--${name}`, ...(value === true ? [] : [String(value)])]);
  if (verb === 'convert') return Object.assign({}, ...names.map((name) => written([verb, ...Object.keys(inputs), name], inputs, [name]))) as Record<string, Buffer>;
  return written([verb, ...Object.keys(inputs), ...given, ...names.flatMap((name) => ['-o', name])], inputs, names);
}

async function compare(one: Case): Promise<void> {
  const { page: id, verb, inputs, options = {}, files, known, arrange } = one;
  const expected = expectedOf(one);
  const it = await open(browser, { hash: commandHash(id, verb, inputs, options) }), { page } = it;
  await expect.poll(() => readout(page, known), { timeout: 60_000 }).toMatch(/\d/);
  await arrange?.(page);
  for (const [label, name] of Object.entries(files)) {
    const { bytes } = await download(page, label);
    expect(bytes.equals(expected[name]!), `${label}: ${bytes.length} bytes, of the command ${expected[name]!.length}`).toBe(true);
  }
  await close(it);
}

describe('files that pages save are those of the command line', () => {
  it.each(kCases)('$name', compare);
  it('a path is one that the command line reads, with the waypoints of its own', async () => {
    const inputs = { 'peg.wkt': kFit, 'slot.wkt': kSlot }, options = { from: '1,6,0', to: '1,1,0' };
    const own = JSON.parse(written(['path', ...Object.keys(inputs), '--from', options.from, '--to', options.to, '-o', 'o.json'], inputs, ['o.json'])['o.json']!.toString()) as { waypoints: unknown };
    const it = await open(browser, { hash: commandHash('obstacle', 'path', inputs, options) }), { page } = it;
    await expect.poll(() => page.getByLabel('Along the path').count(), { timeout: 60_000 }).toBe(1);
    const text = (await download(page, 'Path (JSON)')).bytes.toString();
    expect((JSON.parse(text) as { waypoints: unknown }).waypoints).toEqual(own.waypoints);
    written(['path', 'peg.wkt', 'slot.wkt', '--check-path', 'saved.json'], { ...inputs, 'saved.json': text }, []);
    await close(it);
  });
});
