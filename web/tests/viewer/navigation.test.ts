// Back and forth by the browser, links, and files as large as they come.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, dropFiles, launch, open, readout, set, settled } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

const shown = (page: Page): Promise<string> => page.locator('.tabs a[aria-current]').innerText();
const kSettled = 600; // addresses are written once changes have settled

/** A polygon of so many vertices and digits: it does not pack well. */
function large(vertices: number): string {
  const at = (k: number): string => {
    const angle = (2 * Math.PI * k) / vertices;
    const radius = 2 + 1e-6 * Math.sin(k * k);
    return `${Math.cos(angle) * radius} ${Math.sin(angle) * radius}`;
  };
  return `POLYGON ((${[...Array(vertices).keys(), 0].map(at).join(', ')}))`;
}

describe('the browser', () => {
  it('goes back to the page and the shape before, and forth again', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    await set(page, 'Exactly', '3/2');
    await page.waitForTimeout(kSettled);
    await page.getByLabel('Shape of P').selectOption('square');
    await page.waitForTimeout(kSettled);
    await page.locator('.tabs a').nth(1).click();
    await page.waitForTimeout(kSettled);
    await page.goBack();
    await expect.poll(() => shown(page)).toBe('Sum');
    await expect.poll(() => page.getByLabel('Shape of P').inputValue()).toBe('square');
    await page.goBack();
    await expect.poll(() => page.getByLabel('Shape of P').inputValue()).toBe('gear');
    expect(await page.getByLabel('Exactly').inputValue()).toBe('3/2');
    await page.waitForTimeout(kSettled);
    await page.goForward();
    await expect.poll(() => page.getByLabel('Shape of P').inputValue()).toBe('square');
    await page.goForward();
    await expect.poll(() => shown(page)).toBe('Robot');
    await close(it);
  });
  it('copies no link that browsers would not open, and keeps what is shown all the same', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    await page.getByRole('button', { name: 'Leave out Q' }).click();
    await dropFiles(page, { 'large.wkt': large(70_000) });
    await expect.poll(() => page.getByLabel('Shape of P').locator('option:checked').innerText()).toBe('large.wkt');
    await page.waitForTimeout(1500);
    await page.getByRole('button', { name: 'Copy a link to what is shown' }).click();
    await expect.poll(() => page.getByRole('alert').innerText().catch(() => ''), { timeout: 30_000 }).toMatch(/too large for a link/);
    expect((await page.evaluate(() => location.href)).length).toBeLessThan(2000);
    await page.reload();
    await expect.poll(() => page.getByLabel('Shape of P').locator('option:checked').innerText()).toBe('large.wkt');
    await close(it);
  });
  it('refuses much of what is no file of shapes soon', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    for (const [name, kind] of [['junk.wkt', 'letters'], ['junk.wkt', 'POLYGON ((0 0, '], ['junk.json', 'bytes'], ['junk.json', '[['], ['junk.stl', 'bytes']] as const) {
      const took = await page.evaluate(async ([file, of]) => {
        const bytes = new Uint8Array(60_000_000);
        for (let k = 0, x = 1; k < bytes.length; ++k) {
          x = (x * 48271) % 2147483647;
          bytes[k] = of === 'bytes' ? x & 255 : 97 + (x % 26);
        }
        if (of !== 'bytes' && of !== 'letters') bytes.set(new TextEncoder().encode(of)); // what such a file begins with
        const data = new DataTransfer();
        data.items.add(new File([bytes], file));
        const start = performance.now();
        document.querySelector('main')!.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true }));
        while (!document.querySelector('[role=alert]')?.textContent) await new Promise((done) => setTimeout(done, 20));
        return performance.now() - start;
      }, [name, kind] as const);
      console.log(`${name}: refused after ${Math.round(took)} ms: ${(await page.getByRole('alert').innerText()).slice(0, 120)}`);
      expect(took).toBeLessThan(5000);
      await page.getByRole('button', { name: 'Close the message' }).click();
      await page.locator('canvas').first().focus();
      await page.keyboard.press('Control+z');
    }
    await close(it);
  });
});

describe('nesting instances', () => {
  const item = (id: number, ring: number[][]): object => ({ id, demand: 1, shape: { type: 'simple_polygon', data: ring } });
  const square = [[0, 0], [2, 0], [2, 2], [0, 2]];
  const instance = (rings: number[][][]): string => JSON.stringify({ name: 'swim', items: rings.map((ring, k) => item(k, ring)), strip_height: 9 });
  it('open with rings that are closed, as they mostly are', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    await dropFiles(page, { 'swim.json': instance([[...square, square[0]!], [[0, 0], [1, 0], [0, 1], [0, 0]]]) });
    await page.getByRole('button', { name: 'Nest the shapes of swim.json' }).click();
    await expect.poll(() => readout(page, 'vertices').catch(() => '')).toBe('5');
    expect(await page.getByRole('alert').count()).toBe(0);
    await close(it);
  });
  it('with a shape that is refused say which and why, and offer to repair', async () => {
    const it = await open(browser, { hash: '#/nesting' }), { page } = it;
    await expect.poll(() => readout(page, 'vertices').catch(() => '')).toMatch(/\d/);
    await dropFiles(page, { 'swim.json': instance([square, [[0, 0], [1, 0], [1, 0], [0, 1]]]) });
    await expect.poll(() => page.getByRole('alert').innerText().catch(() => '')).toMatch(/^repeated vertex: swim\.json#1/);
    await page.getByRole('button', { name: 'Repair and nest the shapes of swim.json' }).click();
    await expect.poll(() => page.getByLabel('Shape of A').locator('option:checked').innerText()).toBe('0*.wkt');
    await expect.poll(() => readout(page, 'vertices')).toBe('5');
    expect(await page.getByRole('alert').count()).toBe(0);
    await close(it);
  });
});
