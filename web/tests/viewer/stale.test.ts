// What is shown is what was asked: after an error, a refusal or a cancel nothing of before stands under the new labels.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { choose, close, dropFiles, example, launch, open, readout, set, settled, spikes } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

const kBow = 'POLYGON ((0 0, 4 4, 4 0, 0 3, 0 0))';
const sumCounts = async (page: Page): Promise<string[]> => await Promise.all(['parts', 'vertices', 'computed in', 'area'].map((name) => readout(page, name)));
const triangles = (page: Page, k = 0): Promise<string | null> => page.locator('.space').nth(k).getAttribute('data-triangles');

describe('nothing of before stands under what is asked now', () => {
  it('where the page cannot compute it, which is a limit and no defect', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    await choose(page, 'What is computed', 'Fit in P');
    await settled(page);
    await set(page, 'Exactly', '1/3');
    await expect.poll(() => page.getByRole('alert').innerText().catch(() => '')).toMatch(/^limit: .*no doubles/);
    expect(await sumCounts(page)).toEqual(['–', '–', '–', '–']);
    expect(await page.getByRole('region', { name: 'Places of Q inside P' }).innerText()).toContain('Not computed: Scaled by 1/3');
    await page.getByRole('button', { name: 'Download' }).click();
    expect(await page.getByRole('button', { name: 'Picture (SVG)' }).count()).toBe(0);
    await set(page, 'Exactly', '1/2');
    await settled(page);
    expect(await readout(page, 'vertices')).toMatch(/\d/);
    await close(it);
  });
  it('after a cancel of a long sum, which can be asked for again', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    await dropFiles(page, { 'p.wkt': spikes(1800, 3), 'q.wkt': spikes(2000, 40) });
    await page.getByRole('button', { name: 'Cancel' }).click({ timeout: 60_000 });
    await expect.poll(() => sumCounts(page)).toEqual(['–', '–', '–', '–']);
    expect(await page.getByText('Cancelled: this has not been computed.').count()).toBe(1);
    await page.getByRole('button', { name: 'Compute it' }).click();
    await expect.poll(() => page.getByRole('progressbar').count(), { timeout: 60_000 }).toBe(1);
    expect(await page.getByText('Cancelled: this has not been computed.').count()).toBe(0);
    await page.getByRole('button', { name: 'Cancel' }).click();
    await close(it);
  });
  it('while it is computed, where that takes long: it is greyed', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    await dropFiles(page, { 'p.wkt': spikes(1800, 3), 'q.wkt': spikes(2000, 40) });
    await expect.poll(() => page.getByRole('progressbar').count(), { timeout: 60_000 }).toBe(1);
    for (const shown of ['canvas.plane', 'section:has-text("computed in") [aria-busy]'])
      await expect.poll(() => page.locator(shown).evaluate((e) => Number(getComputedStyle(e).opacity))).toBeLessThan(0.5);
    await page.getByRole('button', { name: 'Cancel' }).click();
    await close(it);
  });
  it('of a robot, whose old obstacle goes', async () => {
    const it = await open(browser, { hash: '#/obstacle' }), { page } = it;
    await expect.poll(() => triangles(page), { timeout: 60_000 }).toMatch(/^[1-9]/);
    await dropFiles(page, { 'robot.wkt': spikes(220, 3), 'obstacle.wkt': spikes(260, 40) });
    await page.getByRole('button', { name: 'Cancel' }).click({ timeout: 60_000 });
    await expect.poll(() => triangles(page)).toBe('0');
    expect([await readout(page, 'Patches, shells'), await readout(page, 'The robot')]).toEqual(['–', '–']);
    expect(await page.getByText('Cancelled: this has not been computed.').count()).toBe(1);
    await close(it);
  });
  it('of A and B, where A is refused', async () => {
    const it = await open(browser, { hash: '#/nesting' }), { page } = it;
    await example(page, 'A slot that fits exactly');
    await expect.poll(() => page.getByRole('status').first().innerText().catch(() => '')).toMatch(/^A and B/);
    await dropFiles(page, { 'bow.wkt': kBow });
    await expect.poll(() => page.getByRole('alert').innerText().catch(() => '')).toMatch(/^self crossing/);
    expect(await page.getByText(/^A and B/).count()).toBe(0);
    expect(await readout(page, 'vertices')).toBe('–');
    expect(await page.getByText('Not computed: one of the shapes is refused.').count()).toBe(2);
    await close(it);
  });
  it('of a disc, where the shape is refused', async () => {
    const it = await open(browser, { hash: '#/discs' }), { page } = it;
    await settled(page);
    await dropFiles(page, { 'bow.wkt': kBow });
    await expect.poll(() => page.getByRole('alert').innerText().catch(() => '')).toMatch(/^self crossing/);
    expect([await readout(page, 'parts'), await readout(page, 'area')]).toEqual(['–', '–']);
    await close(it);
  });
  it('of solids, where one is refused', async () => {
    const it = await open(browser, { hash: '#/solids' }), { page } = it;
    await expect.poll(() => triangles(page, 1), { timeout: 60_000 }).toMatch(/^[1-9]/);
    await dropFiles(page, { 'open.off': 'OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' });
    await expect.poll(() => page.getByRole('alert').innerText().catch(() => '')).toMatch(/^not closed/);
    await expect.poll(() => triangles(page, 1)).toBe('0');
    expect([await readout(page, 'Vertices, faces'), await readout(page, 'Volume')]).toEqual(['–', '–']);
    await close(it);
  });
});
