// Every verb's page shows what the command computes: inputs and options as the program hands them over.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { choose, close, commandHash, launch, open, readout, set, settled } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

const kPlate = 'POLYGON ((0 0, 10 0, 10 6, 0 6, 0 0), (3 2, 4 2, 4 3, 3 3, 3 2))';
const kPeg = 'POLYGON ((-0.5 -0.5, 0.5 -0.5, 0.5 0.5, -0.5 0.5, -0.5 -0.5))';
const kSlot = 'POLYGON ((-4 -2, 4 -2, 4 4, 1.5 4, 1.5 0, -1.5 0, -1.5 4, -4 4, -4 -2))';
const kRegions = { 'plate.wkt': kPlate, 'peg.wkt': kPeg };

/** Eight corners, x changes first. */
function box(x0: number, y0: number, z0: number, x1: number, y1: number, z1: number): string {
  const corners = [z0, z1].flatMap((z) => [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(([x, y]) => `${x} ${y} ${z}`));
  return ['OFF', '8 6 0', ...corners, '4 0 3 2 1', '4 4 5 6 7', '4 0 1 5 4', '4 1 2 6 5', '4 2 3 7 6', '4 3 0 4 7', ''].join('\n');
}
const kSolids = { 'p.off': box(0, 0, 0, 3, 2, 1), 'q.off': box(-0.5, -0.5, -0.5, 0.5, 0.5, 0.5) };

/** Over a polygon that runs counter-clockwise, from z = 0. */
function prism(base: readonly (readonly [number, number])[], height: number): string {
  const n = base.length, around = base.map((_, k) => k), vertices = [0, height].flatMap((z) => base.map(([x, y]) => `${x} ${y} ${z}`));
  const faces = [[...around].reverse(), around.map((k) => k + n), ...around.map((k) => [k, (k + 1) % n, ((k + 1) % n) + n, k + n])];
  return ['OFF', `${2 * n} ${n + 2} 0`, ...vertices, ...faces.map((f) => `${f.length} ${f.join(' ')}`), ''].join('\n');
}
const kChannel = { 'channel.off': prism([[0, 0], [4, 0], [4, 4], [3, 4], [3, 1], [1, 1], [1, 4], [0, 4]], 3) };

async function asked(page: string, verb: string, inputs: Record<string, string>, options?: Record<string, unknown>) {
  return await open(browser, { hash: commandHash(page, verb, inputs, options) });
}
const exact = (page: Page, what: string): Promise<string> => page.getByRole('button', { name: `Copy ${what}` }).innerText();
const chosen = (page: Page, group: string): Promise<string> => page.getByRole('radiogroup', { name: group }).locator('label:has(:checked)').innerText();
const value = (page: Page, label: string): Promise<string> => page.getByLabel(label, { exact: true }).inputValue();

describe('commands of regions', () => {
  it('sum, with what touching counts', async () => {
    const it = await asked('sum', 'sum', kRegions, { semantics: 'regular' }), { page } = it;
    await expect.poll(() => readout(page, 'area')).toBe('77'); // the peg closes the hole, and touches itself there
    expect(await chosen(page, 'What touching counts')).toBe('Regular');
    expect(await readout(page, 'tight points, segments')).toBe('0, 0');
    await choose(page, 'What touching counts', 'Open');
    await expect.poll(() => readout(page, 'tight points, segments')).toBe('1, 0');
    await close(it);
  });
  it('erode: the inner fit, also scaled without rounding', async () => {
    const it = await asked('sum', 'erode', kRegions), { page } = it;
    await expect.poll(() => exact(page, 'the exact area')).toBe('41/1'); // 9 by 5, less 2 by 2 about the hole
    expect(await page.getByRole('radiogroup', { name: 'How it moves' }).innerText()).toBe('Scale');
    await set(page, 'Exactly', '3/2');
    await expect.poll(() => exact(page, 'the exact area')).toBe('423/4'); // 14 by 8, less 2.5 by 2.5
    await set(page, 'Exactly', '1/3');
    await expect.poll(() => page.getByRole('alert').innerText()).toMatch(/no doubles/);
    await close(it);
  });
  it('scale: a factor for each axis, Q reflected, a slider for all scales', async () => {
    const it = await asked('sum', 'scale', kRegions, { sweep: '1:8:10%', ratio: '1/2', robot: true }), { page } = it;
    await expect.poll(() => exact(page, 'the exact area')).toBe('44/1'); // 11 by 4
    expect(await chosen(page, 'What is computed')).toBe('P ⊕ −Q');
    expect(await value(page, 'Exactly')).toBe('1:1/2');
    expect(await page.getByRole('slider', { name: 'Scale of P' }).getAttribute('max')).toBe('8');
    await set(page, 'Exactly', '2:1/2');
    await expect.poll(() => exact(page, 'the exact area')).toBe('84/1'); // 21 by 4
    await close(it);
  });
  it('rotate: P, from no turn to the one that was asked for', async () => {
    const it = await asked('sum', 'rotate', kRegions, { steps: '6', angle: '90deg' }), { page } = it, slider = page.getByRole('slider', { name: 'Turn of P' });
    await settled(page);
    expect([await slider.getAttribute('min'), Number(await slider.getAttribute('max'))]).toEqual(['0', Math.PI / 2]);
    await set(page, 'Tangent of half the angle, exactly', '90deg');
    await expect.poll(() => slider.getAttribute('aria-valuetext')).toBe('90°');
    await expect.poll(() => exact(page, 'the exact area')).toBe('77/1');
    await close(it);
  });
  it('depth: of Q where it was moved', async () => {
    const it = await asked('sum', 'depth', kRegions, { move: '9.75,1' }), { page } = it;
    await expect.poll(() => readout(page, 'Q')).toBe('overlaps P, depth 0.75');
    expect(await exact(page, 'the square of the distance')).toBe('9/16');
    await page.locator('canvas.plane').focus();
    await choose(page, 'Which moves', 'Q');
    await page.locator('canvas.plane').focus();
    await page.keyboard.press('Alt+Shift+ArrowRight');
    await expect.poll(() => readout(page, 'Q')).not.toBe('overlaps P, depth 0.75');
    await close(it);
  });
  it('local-sum: looks there, and everywhere when told', async () => {
    const it = await asked('sum', 'local-sum', kRegions, { disc: '3,2,1.5' }), { page } = it;
    const camera = async (): Promise<number[]> => (await page.locator('canvas.plane').getAttribute('data-camera'))!.split(' ').map(Number);
    await settled(page);
    expect((await camera()).slice(0, 2)).toEqual([3, 2]);
    await page.getByRole('button', { name: 'Show all, not only the part' }).click();
    await expect.poll(async () => (await camera()).slice(0, 2)).toEqual([5, 3]);
    await close(it);
  });
  it('info: one shape alone, to which another may be added', async () => {
    const it = await asked('sum', 'info', { 'plate.wkt': kPlate }), { page } = it;
    await expect.poll(() => exact(page, 'the exact area')).toBe('59/1');
    expect([await readout(page, 'vertices'), await readout(page, 'holes')]).toEqual(['8', '1']);
    await page.getByLabel('Shape of Q').selectOption('square');
    await expect.poll(() => exact(page, 'the exact area')).toBe('77/1');
    await page.getByRole('button', { name: 'Leave out Q' }).click();
    await expect.poll(() => exact(page, 'the exact area')).toBe('59/1');
    await page.keyboard.press('Control+z');
    await expect.poll(() => exact(page, 'the exact area')).toBe('77/1');
    await close(it);
  });
  it('slice: the robot at its angle, the obstacle cut there', async () => {
    const it = await asked('obstacle', 'slice', { 'peg.wkt': kPeg, 'slot.wkt': kSlot }, { degrees: '30' }), { page } = it;
    await expect.poll(() => readout(page, 'The robot'), { timeout: 60_000 }).toMatch(/free/);
    expect(await page.getByLabel('θ', { exact: true }).getAttribute('aria-valuetext')).toBe('30°');
    expect(await page.getByLabel('Cut the obstacle at θ').isChecked()).toBe(true);
    await close(it);
  });
  it('path: from here to there, where touching is forbidden', async () => {
    const it = await asked('obstacle', 'path', { 'peg.wkt': kPeg, 'slot.wkt': kSlot }, { from: '0,6,90deg', to: ['0,1,0', '1,1,0'], strict: true }), { page } = it;
    await expect.poll(() => page.locator('.panel').innerText(), { timeout: 60_000 }).toMatch(/moves, every one checked exactly/);
    expect([await value(page, 'x'), await value(page, 'y'), await value(page, 'tan θ/2')]).toEqual(['0', '6', '90deg']);
    expect(await page.getByLabel('Touching is forbidden').isChecked()).toBe(true);
    await page.getByLabel('Along the path').focus();
    await page.keyboard.press('End');
    await expect.poll(() => value(page, 'y')).toBe('1');
    await close(it);
  });
  it('features: bars, and the bridges of a disc', async () => {
    const it = await asked('discs', 'features', { 'slot.wkt': kSlot }, { tau: '1/2', alpha: '2.5', concavity: 'shortest' }), { page } = it;
    await expect.poll(() => page.locator('.barcode [role=option]').count()).toBeGreaterThan(1);
    expect(await value(page, 'Exactly')).toBe('2.5');
    expect(await chosen(page, 'How deep pockets are')).toBe('Path');
    expect(await page.getByLabel('cuts', { exact: true }).isChecked()).toBe(false);
    await close(it);
  });
  it('disc: by a radius, or exactly at an event', async () => {
    const it = await asked('discs', 'disc', { 'plate.wkt': kPlate }, { radius: '1/2', set: 'erosion', semantics: 'open' }), { page } = it;
    await expect.poll(async () => Number(await readout(page, 'area'))).toBeCloseTo(45 - (1 + 2 + Math.PI / 4), 3);
    expect([await value(page, 'Exactly'), await chosen(page, 'What the disc makes'), await chosen(page, 'What touching counts')]).toEqual(['1', 'Shrunk', 'Open']);
    await close(it);
    const second = await asked('discs', 'disc', { 'plate.wkt': kPlate }, { radius: 'event:1', set: 'erosion' });
    await expect.poll(() => second.page.getByRole('slider', { name: 'Diameter α' }).getAttribute('aria-valuetext')).toBe('3');
    expect(await value(second.page, 'Exactly')).toBe('event 2');
    await close(second);
  });
  it('nfp: what touching counts', async () => {
    const it = await asked('nesting', 'nfp', kRegions), { page } = it;
    await expect.poll(() => readout(page, 'vertices')).toMatch(/\d/);
    expect(await chosen(page, 'What touching counts')).toBe('Closed');
    await choose(page, 'What touching counts', 'Regular');
    await expect.poll(() => readout(page, 'exact fits: points, segments')).toBe('0, 0');
    await choose(page, 'What touching counts', 'Open');
    await expect.poll(() => readout(page, 'exact fits: points, segments')).toBe('1, 0');
    await close(it);
  });
  it('view of a file that holds many parts', async () => {
    const square = (name: string, side: number): object => ({ type: 'Feature', properties: { name }, geometry: { type: 'Polygon', coordinates: [[[0, 0], [side, 0], [side, side], [0, side], [0, 0]]] } });
    const it = await asked('nesting', 'view', { 'parts.geojson': JSON.stringify({ type: 'FeatureCollection', features: [square('one', 1), square('two', 2), square('three', 3)] }) }), { page } = it;
    await expect.poll(() => page.getByLabel('Shape of A').inputValue()).toBe('one.wkt');
    await page.getByLabel('Shape of B').selectOption('three.wkt');
    await expect.poll(() => readout(page, 'vertices')).toBe('4');
    expect(await page.getByRole('alert').count()).toBe(0);
    await close(it);
  });
  it('view of many parts: each may be A or B', async () => {
    const it = await asked('nesting', 'view', { ...kRegions, 'slot.wkt': kSlot }), { page } = it;
    await expect.poll(() => readout(page, 'vertices')).toMatch(/\d/);
    await page.getByLabel('Shape of B').selectOption('slot.wkt');
    await expect.poll(() => page.getByLabel('Shape of B').inputValue()).toBe('slot.wkt');
    await page.getByLabel('Shape of A').selectOption('peg.wkt');
    await expect.poll(() => readout(page, 'vertices')).toBe('8');
    await close(it);
  });
});

describe('commands of solids', () => {
  const volume = (page: Page): Promise<string> => exact(page, 'the exact volume');
  it('sum: where the files say', async () => {
    const it = await asked('solids', 'sum', kSolids), { page } = it;
    await expect.poll(() => volume(page)).toBe('24/1'); // 4 by 3 by 2
    expect([await value(page, 'x of Q'), await value(page, 'Turn')]).toEqual(['0', '0']);
    await close(it);
  });
  it('rotate: P about any axis, at the frame that was asked for', async () => {
    const it = await asked('solids', 'rotate', kSolids, { steps: '4', axis: '0,0,5', frame: '1' }), { page } = it;
    await expect.poll(() => volume(page)).toBe('24/1'); // a quarter turn, exactly
    expect([await value(page, 'Axis of the turn'), await value(page, 'Turn'), await chosen(page, 'Which moves')]).toEqual(['0, 0, 5', '90', 'P turns and is scaled']);
    await set(page, 'Axis of the turn', '0, 0, 0');
    expect(await page.getByLabel('Axis of the turn').evaluate((e: HTMLInputElement) => e.validationMessage)).toMatch(/not all of them 0/);
    await choose(page, 'Axis', 'x');
    expect(await value(page, 'Axis of the turn')).toBe('1, 0, 0');
    await close(it);
  });
  it('scale: a factor for each axis, of P or of Q', async () => {
    const it = await asked('solids', 'scale', kSolids, { at: '1:1:2,3:1:1' }), { page } = it;
    await expect.poll(() => volume(page)).toBe('36/1'); // 4 by 3 by 3
    expect(await page.getByRole('slider', { name: 'Scale' }).getAttribute('max')).toBe('3');
    await choose(page, 'Which moves', 'Q does');
    await expect.poll(() => volume(page)).toBe('36/1'); // Q is 1 by 1 by 2 now: 4 by 3 by 3 again
    await close(it);
  });
  it('depth: of Q where it was moved, P turned first', async () => {
    const it = await asked('solids', 'depth', kSolids, { move: '0,0.75,0.5', axis: '0,0,1', degrees: '90' }), { page } = it;
    await expect.poll(() => readout(page, 'Q')).toBe('overlaps P, depth 0.5'); // P is from -2 to 0 along x now
    expect(await exact(page, 'the square of the depth')).toBe('1/4');
    await close(it);
  });
  it('depth of others: P turns, Q leaves', async () => {
    const it = await asked('solids', 'depth', kSolids, { move: '0,0,0.5' }), { page } = it;
    await page.getByLabel('Solid P').selectOption('channel');
    await page.getByLabel('Solid Q').selectOption('bar');
    await set(page, 'x of Q', '1');
    await set(page, 'z of Q', '0');
    await expect.poll(() => readout(page, 'Q')).toBe('overlaps P, depth 1');
    await page.getByLabel('Turn', { exact: true }).fill('180'); // upside down about z: the other way out is as long
    await expect.poll(() => readout(page, 'Q')).toBe('overlaps P, depth 1');
    await set(page, 'Scale, exactly', '1/3');
    await expect.poll(() => readout(page, 'Q')).toBe('not known exactly');
    await close(it);
  });
  it('depth: what touches after the way out, also in a passage that Q fits exactly', async () => {
    const it = await asked('solids', 'depth', { ...kChannel, 'plug.off': box(0, 0, 0, 2, 1, 1) }, { move: '0.75,1.5,0.5' }), { page } = it;
    await expect.poll(() => readout(page, 'Touches then')).toBe('face 5 of P, face 3 of Q; face 7 of P, face 5 of Q; face 5 of P, edge 1–2 of Q; face 5 of P, edge 1–5 of Q; 14 more'); // as the program says
    expect(await readout(page, 'Q')).toBe('overlaps P, depth 0.25');
    for (const [axis, value] of [['x', '2.5'], ['y', '3.5']] as const) await set(page, `${axis} of Q`, value);
    await expect.poll(() => readout(page, 'Touches then')).toBe('face 4 of P, face 2 of Q; edge 2–10 of P, face 2 of Q; edge 3–11 of P, face 2 of Q; face 4 of P, edge 0–1 of Q; 5 more');
    await page.getByLabel('Turn', { exact: true }).fill('0.5'); // the engine of turns names nothing for certain
    await expect.poll(() => readout(page, 'Touches then')).toMatch(/not named/);
    await close(it);
  });
  it('depth of what is very large', async () => {
    const it = await asked('solids', 'slice', { ...kChannel, 'bar.off': box(0, 0, 0, 2, 0.5, 0.25) }, { z: '1', reflect: true }), { page } = it;
    for (const scale of ['1000', '1e15', '1e16']) {
      await set(page, 'Scale, exactly', scale);
      await expect.poll(() => readout(page, 'Way out')).toBe('0, 0, 1');
      expect(await readout(page, 'Q')).toBe('overlaps P, depth 3');
    }
    await page.getByLabel('Turn', { exact: true }).fill('0.5');
    await expect.poll(() => readout(page, 'Q')).toBe('not known exactly');
    await close(it);
  });
  it('slice: at a height, Q reflected', async () => {
    const it = await asked('solids', 'slice', kSolids, { z: '0.75', reflect: true }), { page } = it;
    await expect.poll(() => exact(page, 'the exact area')).toBe('12/1');
    expect(await chosen(page, 'What is computed')).toMatch(/^P ⊕ −Q/);
    await close(it);
  });
  it('nfp: where Q hits P', async () => {
    const it = await asked('solids', 'nfp', { ...kChannel, 'bar.off': box(0, 0, 0, 2, 0.5, 0.25) }), { page } = it;
    await expect.poll(() => volume(page)).toBe('351/4'); // 87.75
    expect([await chosen(page, 'What is computed'), await readout(page, 'Tight')]).toEqual(['P ⊕ −Q', 'faces']);
    await close(it);
  });
  it('erode: where Q fits in P, while nothing turns', async () => {
    const it = await asked('solids', 'erode', { ...kChannel, 'bar.off': box(0, 0, 0, 2, 0.5, 0.25) }), { page } = it;
    await expect.poll(() => volume(page)).toBe('11/4');
    expect([await chosen(page, 'What is computed'), await readout(page, 'Q'), await readout(page, 'Tight')]).toEqual(['Fit in P', 'fits in P', 'nothing']);
    expect(await page.getByLabel('Turn', { exact: true }).count()).toBe(0);
    await set(page, 'Scale, exactly', '2'); // 4 by 1 by 1/2: the floor of the channel
    await expect.poll(() => readout(page, 'Q')).toBe('fits in P without room to move');
    expect(await readout(page, 'Tight')).toBe('segments');
    await expect.poll(() => readout(page, 'Volume')).toBe('0');
    await choose(page, 'What touching counts', 'Regular');
    await expect.poll(() => readout(page, 'Q')).toBe('fits nowhere in P with room to move');
    await choose(page, 'What touching counts', 'Closed');
    await set(page, 'Scale, exactly', '3');
    await expect.poll(() => readout(page, 'Q')).toBe('fits nowhere in P');
    await page.getByLabel('Cut the sum at a height').click();
    await set(page, 'Scale, exactly', '1/3');
    await expect.poll(() => page.getByRole('alert').innerText()).toMatch(/no doubles/);
    expect(await readout(page, 'Q')).toBe('–');
    await choose(page, 'What is computed', 'P ⊕ Q');
    await expect.poll(() => page.getByLabel('Turn', { exact: true }).count()).toBe(1);
    await close(it);
  });
  it('local-sum: looks at a part', async () => {
    const it = await asked('solids', 'local-sum', kSolids, { ball: '3.5,2.5,1.5,0.5' }), { page } = it;
    await expect.poll(() => volume(page)).toBe('24/1');
    await page.getByRole('button', { name: 'Show all, not only the part' }).click();
    expect(await page.getByRole('button', { name: 'Show all, not only the part' }).count()).toBe(0);
    await close(it);
  });
  it('thin parts count where they are asked for', async () => {
    const it = await asked('solids', 'sum', { ...kSolids, 'q.off': 'OFF\n2 1 0\n0 0 0\n1 1 1\n2 0 1\n' }, { thin: true }), { page } = it;
    await expect.poll(() => readout(page, 'Volume'), { timeout: 30_000 }).toBe('17'); // swept along a segment: 6 + 2 + 3 + 6
    await page.getByLabel('Parts of files without volume count, too').click();
    await expect.poll(() => page.getByRole('alert').count()).toBe(1);
    await page.keyboard.press('Control+z');
    await expect.poll(() => readout(page, 'Volume')).toBe('17');
    await close(it);
  });
  it('hull: one solid alone, to which another may be added', async () => {
    const it = await asked('solids', 'hull', { 'p.off': kSolids['p.off'] }), { page } = it;
    await expect.poll(() => readout(page, 'Volume')).toBe('6');
    expect([await readout(page, 'Vertices, faces'), await readout(page, 'Surface')]).toEqual(['8, 6', '22']);
    await page.getByLabel('See through').click();
    await page.getByLabel('Solid Q').selectOption('cube');
    await expect.poll(() => volume(page)).toBe('60/1'); // 5 by 4 by 3
    await page.getByRole('button', { name: 'Leave out Q' }).click();
    await expect.poll(() => readout(page, 'Volume')).toBe('6');
    await close(it);
  });
});
