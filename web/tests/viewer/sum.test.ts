// The page of sums: every control does what it says.
import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, drag, launch, open, readout, readoutOtherThan, settled, type OpenOptions } from './viewer';

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
});
