// Long work tells how far it is, can be stopped, and leaves a page that goes on.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, dropFiles, launch, open, readout, spikes } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

const bar = (page: Page) => page.getByRole('progressbar', { name: 'Progress' });
const share = async (page: Page): Promise<number> => Number((await bar(page).getAttribute('aria-valuenow', { timeout: 500 }).catch(() => null)) ?? NaN);

/** A robot and an obstacle whose obstacle in (x, y, theta) takes long. */
async function atWork(): Promise<Awaited<ReturnType<typeof open>>> {
  const it = await open(browser, { hash: '#/obstacle' }), { page } = it;
  await expect.poll(() => readout(page, 'The robot'), { timeout: 60_000 }).toMatch(/clearance|depth|touches/);
  await dropFiles(page, { 'robot.wkt': spikes(220, 3), 'obstacle.wkt': spikes(260, 40) });
  await expect.poll(() => share(page), { timeout: 60_000 }).toBeGreaterThan(0);
  return it;
}

/** Small shapes again: the page computes them as if nothing had been. */
async function goesOn(page: Page): Promise<void> {
  await page.getByLabel('Shape of Obstacle').selectOption('U');
  await page.getByLabel('Shape of Robot').selectOption('square');
  await expect.poll(() => readout(page, 'Patches, shells'), { timeout: 60_000 }).toMatch(/\d/);
  await expect.poll(() => readout(page, 'The robot')).toMatch(/clearance|depth|touches/);
  expect(await bar(page).count()).toBe(0);
}

describe('long work', () => {
  it('tells how far it is, and more later', async () => {
    const it = await atWork(), { page } = it, first = await share(page);
    expect(await page.locator('.notice span').first().innerText()).toMatch(/\w/);
    await expect.poll(() => share(page), { timeout: 60_000 }).toBeGreaterThan(first);
    await page.getByRole('button', { name: 'Cancel' }).click();
    await close(it);
  });
  it('stops by its button, and the page goes on', async () => {
    const it = await atWork(), { page } = it;
    await page.getByRole('button', { name: 'Cancel' }).click();
    await expect.poll(() => page.getByText('Cancelled.').first().isVisible()).toBe(true);
    await expect.poll(() => bar(page).count()).toBe(0);
    expect(await page.getByRole('alert').count()).toBe(0);
    await goesOn(page);
    await close(it);
  });
  it('stops by a key, and undo leads back to what was shown', async () => {
    const it = await atWork(), { page } = it;
    await page.keyboard.press('Escape');
    await expect.poll(() => bar(page).count()).toBe(0);
    await page.locator('canvas.plane').focus();
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Control+z');
    await expect.poll(() => page.getByLabel('Shape of Robot').inputValue()).toBe('');
    await expect.poll(() => readout(page, 'The robot'), { timeout: 60_000 }).toMatch(/clearance|depth|touches/);
    await close(it);
  });
});
