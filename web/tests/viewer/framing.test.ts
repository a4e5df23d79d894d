// What pictures show at first, on screens and in frames of any size.
import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import type { Browser, Frame, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, commandHash, dropFiles, example, kPage, launch, open, readout } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

const square = (side: number): string => `POLYGON ((0 0, ${side} 0, ${side} ${side}, 0 ${side}, 0 0))`;

/** How many pixels of the picture have not the colour of its corner. */
const painted = (where: Page | Frame): Promise<number> => where.locator('canvas.plane').first().evaluate((element: HTMLCanvasElement) => {
  if (element.width === 0) return 0;
  const { data } = element.getContext('2d')!.getImageData(0, 0, element.width, element.height);
  let count = 0;
  for (let k = 0; k < data.length; k += 4) if (data[k] !== data[0] || data[k + 1] !== data[1] || data[k + 2] !== data[2]) ++count;
  return count;
});
const camera = (page: Page): Promise<string | null> => page.locator('canvas.plane').first().getAttribute('data-camera');

describe('the picture', () => {
  it('is there in frames that have no size at first', async () => {
    const figure = (hidden: string): string => `<${hidden}><iframe width="900" height="560" src="${kPage}${commandHash('sum', 'sum', { 'a.wkt': square(40), 'b.wkt': square(10) })}"></iframe>`;
    const file = join(mkdtempSync(join(tmpdir(), 'dymsum-frames-')), 'frames.html');
    writeFileSync(file, `<!doctype html><details>${figure('summary>live</summary')}</details>${figure('div style="display: none"')}</div>`);
    const page = await (await browser.newContext()).newPage();
    await page.goto(pathToFileURL(file).href);
    await page.waitForTimeout(3000); // the frames compute, unseen
    await page.evaluate(() => {
      document.querySelector('details')!.open = true;
      document.querySelector('div')!.style.display = '';
    });
    for (const frame of page.frames().slice(1)) await expect.poll(() => painted(frame), { timeout: 60_000 }).toBeGreaterThan(20_000);
    await page.context().close();
  });
  it('of a robot and an obstacle is fitted to them, not to the pair before', async () => {
    const it = await open(browser, { hash: '#/obstacle' }), { page } = it;
    const known = async (): Promise<void> => await expect.poll(() => readout(page, 'The robot'), { timeout: 60_000 }).toMatch(/clearance|depth|touches/);
    const isFitted = async (): Promise<void> => {
      await known();
      await page.waitForTimeout(600);
      const before = await camera(page);
      await page.locator('canvas.plane').focus();
      await page.keyboard.press('0');
      await page.waitForTimeout(200);
      expect(await camera(page)).toBe(before);
    };
    await known();
    await dropFiles(page, { 'robot.wkt': square(100), 'obstacle.wkt': square(3000) });
    await expect.poll(() => page.getByLabel('Shape of Obstacle').locator('option:checked').innerText()).toBe('obstacle.wkt');
    await isFitted();
    await dropFiles(page, { 'small.wkt': square(0.01), 'little.wkt': square(0.1) });
    await expect.poll(() => page.getByLabel('Shape of Obstacle').locator('option:checked').innerText()).toBe('little.wkt');
    await isFitted();
    for (const name of (await examples(page)).slice(0, 3)) {
      await example(page, name);
      await isFitted();
    }
    await close(it);
  });
  it('and the panel fill a phone, which scrolls no further', async () => {
    const it = await open(browser, { width: 390, height: 844, touch: true }), { page } = it;
    for (const tab of await page.locator('.tabs a').all()) {
      await tab.click();
      await page.waitForTimeout(500);
      const [beyond, wider] = await page.evaluate(() => [document.documentElement.scrollHeight - innerHeight, document.documentElement.scrollWidth - innerWidth]);
      expect([await tab.innerText(), beyond, wider]).toEqual([await tab.innerText(), 0, 0]);
    }
    await close(it);
  });
});

async function examples(page: Page): Promise<string[]> {
  await page.getByRole('button', { name: 'Examples' }).click();
  const names = await page.locator('.menu li button').allInnerTexts();
  await page.keyboard.press('Escape');
  return names;
}
