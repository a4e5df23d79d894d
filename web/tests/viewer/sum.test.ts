// The page of sums: every control does what it says.
import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { choose, close, drag, dropFiles, launch, open, pixelsOf, readout, readoutOtherThan, set, settled, type OpenOptions } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

const opened = async (options?: OpenOptions) => {
  const it = await open(browser, options);
  await settled(it.page);
  return it;
};

describe('the page of sums', () => {
  it('adds squares: area and vertices are those of the sum', async () => {
    const it = await opened(), { page } = it;
    await page.getByLabel('Shape of P').selectOption('square');
    await page.getByLabel('Shape of Q').selectOption('square');
    await expect.poll(() => readout(page, 'vertices')).toBe('4');
    await expect.poll(() => readout(page, 'area')).toBe('4');
    expect(await page.getByRole('button', { name: 'Copy the exact area' }).innerText()).toBe('4/1');
    await close(it);
  });
  it('scales: slider, exact field, events', async () => {
    const it = await opened(), { page } = it;
    await page.getByLabel('Shape of P').selectOption('square');
    await page.getByLabel('Shape of Q').selectOption('square');
    await expect.poll(() => readout(page, 'area')).toBe('4');
    await page.getByLabel('Exactly').fill('7/3');
    await page.keyboard.press('Enter');
    await expect.poll(() => readout(page, 'area')).toBe('11.1111');
    expect(await page.getByRole('button', { name: 'Copy the exact area' }).innerText()).toBe('100/9');
    await page.getByRole('slider', { name: 'Scale of P' }).focus();
    await page.keyboard.press('ArrowRight');
    expect(await page.getByLabel('Exactly').inputValue()).toBe('2.334');
    await page.getByLabel('Exactly').fill('-1');
    await page.keyboard.press('Enter');
    expect(await page.getByLabel('Exactly').evaluate((e: HTMLInputElement) => e.validationMessage)).toContain('positive');
    await page.getByLabel('Exactly').fill('1e400');
    await page.keyboard.press('Enter');
    await page.locator('canvas.plane').focus();
    expect([await page.getByLabel('Exactly').inputValue(), await page.getByLabel('Exactly').getAttribute('aria-invalid')]).toEqual(['1e400', 'true']);
    expect(await page.locator('.refused').innerText()).toMatch(/from 1e-150/);
    expect(await page.getByRole('slider', { name: 'Scale of P' }).getAttribute('aria-valuetext')).toBe('2.334');
    await page.getByRole('button', { name: 'Undo' }).click(); // another value is in force
    expect([await page.getByLabel('Exactly').inputValue(), await page.locator('.refused').count()]).toEqual(['7/3', 0]);
    await close(it);
  });
  it('jumps from event to event', async () => {
    const it = await opened(), { page } = it;
    await page.getByRole('button', { name: 'Examples' }).click();
    await page.getByRole('button', { name: 'A bar that fits exactly: comb' }).click();
    await settled(page);
    expect(await readout(page, 'tight points, segments')).not.toBe('0, 0');
    await page.getByLabel('Exactly').fill('1/2');
    await page.keyboard.press('Enter');
    await settled(page);
    expect(await readout(page, 'tight points, segments')).toBe('0, 0');
    await page.getByRole('button', { name: 'Next event ›' }).click();
    await expect.poll(() => page.getByLabel('Exactly').inputValue()).not.toBe('1/2');
    await page.getByRole('button', { name: 'Find all' }).click();
    await expect.poll(() => page.locator('.ticks i').count(), { timeout: 60_000 }).toBeGreaterThan(0);
    expect(await page.locator('.ticks i.strong').count()).toBeGreaterThan(0);
    await close(it);
  });
  it('shows what lives how long, marks it in the picture, and takes its frames from the family', async () => {
    const it = await opened(), { page } = it, at = ['1/2', '3/2', '5/7', '2'];
    await page.getByRole('button', { name: 'Examples' }).click();
    await page.getByRole('button', { name: 'A bar that fits exactly: comb' }).click();
    await choose(page, 'What is computed', 'P ⊕ −Q');
    await settled(page);
    const areas = async (): Promise<string[]> => {
      const found: string[] = [];
      for (const s of at) {
        await set(page, 'Exactly', s);
        await settled(page);
        found.push(`${await readout(page, 'vertices')} ${await page.getByRole('button', { name: 'Copy the exact area' }).innerText()}`);
      }
      return found;
    };
    const before = await areas(), bars = page.locator('.lifetimes [role=option]'), marked = (): Promise<number> => pixelsOf(page, '--mark');
    expect(await bars.count()).toBe(0);
    await page.getByRole('button', { name: 'Find all' }).click();
    await expect.poll(() => bars.count(), { timeout: 60_000 }).toBeGreaterThan(3);
    expect(await page.locator('.lifetimes p').first().innerText()).toMatch(/hole.*edge.*vert/);
    expect(await areas()).toEqual(before); // the family's sums are those of before

    // A bar over the scale of now: what it stands for is marked while it is pointed at, and stays marked once it is chosen.
    await set(page, 'Exactly', '1');
    await settled(page);
    const edge = page.locator('.lifetimes [role=option][aria-label^="edge"]').first(), none = await marked();
    await edge.hover();
    await expect.poll(marked).toBeGreaterThan(none);
    expect(await page.locator('.stage .status').innerText()).toMatch(/^edge: /);
    await edge.click();
    await page.mouse.move(5, 5);
    expect([await edge.getAttribute('aria-selected'), (await marked()) > none]).toEqual(['true', true]);

    // The line of now stands where the slider's thumb does.
    const slider = (await page.getByRole('slider', { name: 'Scale of Q' }).boundingBox())!, line = (await page.locator('.lifetimes .now').boundingBox())!;
    const share = (1 - 0.05) / (4 - 0.05), thumb = slider.x + 8 + share * (slider.width - 16);
    expect(Math.abs(line.x + line.width / 2 - thumb)).toBeLessThan(3);

    await page.locator('.lifetimes svg').focus();
    await page.keyboard.press('ArrowDown');
    expect(await page.locator('.lifetimes [role=option][aria-selected=true]').count()).toBe(1);
    await choose(page, 'Which lives are shown', 'Shortest');
    await expect.poll(() => bars.count()).toBeGreaterThan(3);
    await page.getByLabel('Shape of Q').selectOption('gear'); // of other shapes they say nothing
    await expect.poll(() => bars.count()).toBe(0);
    await close(it);
  });
  it('marks a hole while it is there, and no longer', async () => {
    const it = await opened(), { page } = it;
    await dropFiles(page, { 'plate.wkt': 'POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 2, 3 2, 3 1, 1 1))', 'peg.wkt': 'POLYGON ((0 0, 1 0, 1 0.5, 0 0.5, 0 0))' });
    await choose(page, 'What is computed', 'P ⊕ −Q');
    await choose(page, 'Which moves', 'Q');
    await settled(page);
    await page.getByRole('button', { name: 'Find all' }).click();
    const hole = page.locator('.lifetimes [role=option][aria-label^="hole"]');
    await expect.poll(() => hole.count(), { timeout: 60_000 }).toBe(1);
    expect(await hole.getAttribute('aria-label')).toBe('hole, up to 2');
    await hole.click();
    await page.mouse.move(5, 5);
    await expect.poll(() => pixelsOf(page, '--mark')).toBeGreaterThan(0);
    await set(page, 'Exactly', '5/2');
    await settled(page);
    await expect.poll(() => pixelsOf(page, '--mark')).toBe(0);
    await set(page, 'Exactly', '3/2');
    await settled(page);
    await expect.poll(() => pixelsOf(page, '--mark')).toBeGreaterThan(0);
    await close(it);
  });
  it('turns exactly: half a turn of a square is the square', async () => {
    const it = await opened(), { page } = it;
    await page.getByLabel('Shape of P').selectOption('square');
    await page.getByLabel('Shape of Q').selectOption('square');
    await page.getByText('Turn', { exact: true }).nth(1).click();
    await page.getByLabel('Tangent of half the angle, exactly').fill('1/2');
    await page.keyboard.press('Enter');
    await expect.poll(() => readout(page, 'vertices')).toBe('8');
    expect(await page.getByRole('button', { name: 'Copy the exact area' }).innerText()).toBe('24/5');
    await page.getByLabel('Tangent of half the angle, exactly').fill('inf');
    await page.keyboard.press('Enter');
    await expect.poll(() => readout(page, 'vertices')).toBe('4');
    await close(it);
  });
  it('moves, scales, turns and pulls what is dragged', async () => {
    const it = await opened(), { page } = it;
    await page.getByLabel('Shape of P').selectOption('square');
    await page.getByLabel('Shape of Q').selectOption('square');
    await expect.poll(() => readout(page, 'area')).toBe('4');
    await drag(page, [30, 20], [90, 60]);
    expect(await page.getByRole('button', { name: 'Reset' }).isEnabled()).toBe(true);
    expect(await readout(page, 'area')).toBe('4');
    await page.getByRole('button', { name: 'Reset' }).click();
    await page.getByText('Scale', { exact: true }).first().click();
    await drag(page, [60, 60], [120, 120]);
    await expect.poll(() => page.getByLabel('Exactly').inputValue()).not.toBe('1');
    await page.getByText('Turn', { exact: true }).first().click();
    await drag(page, [60, 60], [60, -60]);
    await expect.poll(() => page.getByLabel('Tangent of half the angle, exactly').inputValue()).not.toBe('0');
    await page.getByRole('button', { name: 'Reset' }).click();
    await settled(page);
    await page.getByText('Pull a vertex').click();
    const zoom = (await page.locator('canvas.plane').boundingBox())!, half = 0.25 * (Math.min(zoom.width, zoom.height) - 112); // the sum is two wide
    await drag(page, [half, half], [half + 40, half + 40]);
    const area = await readoutOtherThan(page, 'area', '4');
    await settled(page);
    expect(Number(area)).not.toBe(4);
    expect(await page.getByLabel('Shape of P').inputValue() + (await page.getByLabel('Shape of Q').inputValue())).not.toBe('squaresquare');
    await close(it);
  });
  it('names the pair under the pointer, and copies exact positions', async () => {
    const it = await opened(), { page } = it, canvas = page.locator('canvas.plane');
    await page.getByLabel('Shape of P').selectOption('square');
    await page.getByLabel('Shape of Q').selectOption('square');
    await expect.poll(() => readout(page, 'area')).toBe('4');
    const box = (await canvas.boundingBox())!, half = (Math.min(box.width, box.height) - 112) / 2;
    const at = (dx: number, dy: number) => ({ x: box.width / 2 + dx, y: box.height / 2 + dy });
    await canvas.hover({ position: at(half, 0.5 * half) });
    await expect.poll(() => page.locator('.status').innerText()).toMatch(/^(edge \d of P \+ vertex \d of Q|vertex \d of P \+ edge \d of Q)$/);
    await canvas.click({ position: at(half, -half) });
    await expect.poll(() => page.getByRole('button', { name: 'Copy the exact position' }).innerText()).toBe('(1, 1)');
    expect(await page.locator('.status').innerText()).toMatch(/^vertex \d of P \+ vertex \d of Q$/);
    await close(it);
  });
  it('shows the stages', async () => {
    const it = await opened(), { page } = it, canvas = page.locator('canvas.plane');
    for (const stage of ['convolution', 'cells proved to be covered', 'crossings', 'loops that were dropped', 'P', 'Q', 'sum']) {
      const before = await canvas.screenshot();
      await page.getByRole('checkbox', { name: stage, exact: true }).click();
      if (stage === 'cells proved to be covered' || stage === 'loops that were dropped') continue; // a small sum may have none
      await expect.poll(async () => before.equals(await canvas.screenshot()), { timeout: 10_000 }).toBe(false);
    }
    await close(it);
  });
  it('plays, and stops where it is pressed again', async () => {
    const it = await opened(), { page } = it;
    await page.getByRole('button', { name: 'Play: Scale of P' }).click();
    await expect.poll(() => page.getByLabel('Exactly').inputValue()).not.toBe('1');
    await page.getByRole('button', { name: 'Stop: Scale of P' }).click();
    const at = await page.getByLabel('Exactly').inputValue();
    await page.waitForTimeout(300);
    expect(await page.getByLabel('Exactly').inputValue()).toBe(at);
    await page.keyboard.press('Control+z'); // all of it is one step
    await expect.poll(() => page.getByLabel('Exactly').inputValue()).toBe('1');
    await close(it);
  });
  it('goes back to an event, and says where there are no more', async () => {
    const it = await opened(), { page } = it;
    await page.getByLabel('Shape of P').selectOption('square');
    await page.getByLabel('Shape of Q').selectOption('pockets');
    await choose(page, 'Which moves', 'P');
    await page.getByRole('button', { name: 'Find all' }).click();
    await expect.poll(() => page.getByRole('button', { name: /^\d+ events?$/ }).count()).toBe(1);
    await set(page, 'Exactly', '3.99');
    await page.getByRole('button', { name: 'Next event ›' }).click();
    await expect.poll(() => page.locator('.notice').allInnerTexts()).toContain('Nothing changes up to scale 4.');
    await page.getByRole('button', { name: '‹ Event' }).click();
    await expect.poll(() => page.getByLabel('Exactly').inputValue()).not.toBe('3.99');
    await close(it);
  });
  it('keeps what is typed while other things change', async () => {
    const it = await opened(), { page } = it, canvas = (await page.locator('canvas.plane').boundingBox())!, field = page.getByLabel('Exactly');
    await field.fill('7/3');
    for (let k = 0; k < 10; ++k) await page.mouse.move(canvas.x + (canvas.width * k) / 10, canvas.y + canvas.height / 2); // hovers over edges: the page is drawn again
    expect(await field.inputValue()).toBe('7/3');
    await field.press('Enter');
    await expect.poll(() => page.getByRole('slider', { name: 'Scale of P' }).getAttribute('aria-valuetext')).toBe('2.333');
    await close(it);
  });
  it('shows where Q hits P and where it fits into it, scaled by a drag', async () => {
    const it = await opened(), { page } = it;
    await page.getByLabel('Shape of P').selectOption('square');
    await page.getByLabel('Shape of Q').selectOption('square');
    await choose(page, 'What is computed', 'Fit in P');
    await expect.poll(() => readout(page, 'area')).toBe('0'); // one place
    await expect.poll(() => readout(page, 'tight points, segments')).toBe('1, 0');
    await set(page, 'Exactly', '2');
    await expect.poll(() => readout(page, 'area')).toBe('1');
    await page.getByRole('slider', { name: 'Scale of P' }).focus();
    await page.keyboard.press('ArrowRight');
    await expect.poll(() => page.getByLabel('Exactly').inputValue()).toBe('2.00390625');
    await expect.poll(() => page.getByRole('button', { name: 'Copy the exact area' }).innerText()).toBe('66049/65536');
    await choose(page, 'What is computed', 'P ⊕ −Q');
    await choose(page, 'How it moves', 'Turn');
    await set(page, 'Tangent of half the angle, exactly', '1/2');
    await expect.poll(() => page.getByRole('button', { name: 'Copy the exact area' }).innerText()).toBe('24/5');
    await close(it);
  });
  it('mends a file that is refused, or takes one of several shapes', async () => {
    const it = await opened(), { page } = it;
    await page.getByLabel('Shape of Q').selectOption('square');
    await dropFiles(page, { 'twice.wkt': 'POLYGON ((0 0, 3 0, 3 0, 3 3, 0 3, 0 0))' });
    await page.getByRole('button', { name: 'Repair P' }).click();
    await expect.poll(() => readout(page, 'area')).toBe('16');
    expect(await page.getByRole('button', { name: 'Repair P' }).count()).toBe(0);
    await dropFiles(page, { 'two.geojson': '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"name":"one"},"geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,1],[0,0]]]}},{"type":"Feature","properties":{"name":"two"},"geometry":{"type":"Polygon","coordinates":[[[0,0],[2,0],[2,2],[0,2],[0,0]]]}}]}' });
    await page.getByRole('button', { name: 'Repair P' }).click();
    await page.getByLabel('Shapes of the file of P').selectOption({ index: 2 });
    await expect.poll(() => readout(page, 'area')).toBe('9');
    await close(it);
  });
  it('leads from a file of several shapes to the page that takes them all', async () => {
    const it = await opened(), { page } = it;
    await dropFiles(page, { 'parts.wkt': 'POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))\nPOLYGON ((0 0, 2 0, 2 2, 0 2, 0 0))' });
    await page.getByRole('button', { name: 'Nest the shapes of parts.wkt' }).click();
    await expect.poll(() => page.getByLabel('Shape of B').locator('option:checked').innerText()).toMatch(/\.wkt$/);
    await expect.poll(() => readout(page, 'vertices')).toBe('4');
    expect(await page.getByRole('alert').count()).toBe(0);
    await close(it);
  });
  it('forgets what was picked when it moves away', async () => {
    const it = await opened(), { page } = it, canvas = page.locator('canvas.plane');
    const marked = (): Promise<number> => canvas.evaluate((element: HTMLCanvasElement) => {
      const text = getComputedStyle(document.documentElement).getPropertyValue('--mark'), rgb = [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16));
      const { data } = element.getContext('2d')!.getImageData(0, 0, element.width, element.height);
      let count = 0;
      for (let k = 0; k < data.length; k += 4) if (rgb.every((c, i) => Math.abs(data[k + i]! - c) < 6)) ++count;
      return count;
    });
    await page.getByLabel('Shape of P').selectOption('square');
    await page.getByLabel('Shape of Q').selectOption('square');
    await expect.poll(() => readout(page, 'area')).toBe('4');
    const box = (await canvas.boundingBox())!, half = (Math.min(box.width, box.height) - 112) / 2;
    await canvas.click({ position: { x: box.width / 2 + half, y: box.height / 2 - half } });
    await expect.poll(() => page.getByRole('button', { name: 'Copy the exact position' }).count()).toBe(1);
    await page.mouse.move(1, 1);
    await expect.poll(marked).toBeGreaterThan(20);
    await canvas.focus();
    await page.keyboard.press('Alt+ArrowRight');
    await expect.poll(() => page.getByRole('button', { name: 'Copy the exact position' }).count()).toBe(0);
    await expect.poll(marked).toBe(0);
    await close(it);
  });
});
