// The page of growing discs: every control does what it says.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { choose, close, launch, open, readout, readoutOtherThan, set, settled } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

const opened = async () => {
  const it = await open(browser, { hash: '#/discs' });
  await settled(it.page);
  return it;
};
const made = (page: Page, what: string): Promise<void> => page.getByRole('radiogroup', { name: 'What the disc makes' }).getByText(what, { exact: true }).click();

describe('the page of growing discs', () => {
  it('grows, shrinks, opens and closes a square', async () => {
    const it = await opened(), { page } = it;
    await page.getByLabel('Shape of P').selectOption('square');
    await page.getByLabel('Exactly').fill('1/2');
    await page.keyboard.press('Enter');
    await expect.poll(async () => Number(await readout(page, 'area'))).toBeCloseTo(1 + 4 * 0.25 + Math.PI / 16, 4);
    await made(page, 'Shrunk');
    await expect.poll(() => readout(page, 'area')).toBe('0.25');
    await made(page, 'Tips cut');
    await expect.poll(async () => Number(await readout(page, 'area'))).toBeCloseTo(0.25 + 0.5 + Math.PI / 16, 4);
    await made(page, 'Gaps filled');
    await expect.poll(() => readout(page, 'area')).toBe('1');
    await close(it);
  });
  it('goes from event to event, exactly', async () => {
    const it = await opened(), { page } = it;
    await page.getByLabel('Shape of P').selectOption('random');
    for (let k = 0; k < 2; ++k) await page.getByRole('button', { name: 'Next event ›' }).click();
    await expect.poll(() => page.getByLabel('Exactly').inputValue()).toMatch(/^event \d+$/);
    const first = await page.getByLabel('Exactly').inputValue();
    await page.getByRole('button', { name: '‹ Event' }).click();
    await expect.poll(() => page.getByLabel('Exactly').inputValue()).not.toBe(first);
    await page.getByRole('slider', { name: 'Diameter α' }).focus();
    await page.keyboard.press('ArrowRight');
    await expect.poll(() => page.getByLabel('Exactly').inputValue()).not.toMatch(/event/);
    await close(it);
  });
  it('shows bars, and the exact life of one', async () => {
    const it = await opened(), { page } = it;
    const bars = page.locator('.barcode [role=option]');
    await expect.poll(() => bars.count()).toBeGreaterThan(3);
    await bars.first().click();
    await expect.poll(() => page.getByRole('button', { name: 'Copy the exact birth' }).innerText()).toMatch(/^birth: /);
    await expect.poll(() => bars.first().getAttribute('aria-selected')).toBe('true');
    await page.locator('.barcode').focus();
    await page.keyboard.press('ArrowDown');
    await expect.poll(() => bars.nth(1).getAttribute('aria-selected')).toBe('true');
    await close(it);
  });
  it('cuts at bars that last, fewer the longer they have to', async () => {
    const it = await opened(), { page } = it;
    await page.getByRole('button', { name: 'Examples' }).click();
    await page.getByRole('button', { name: 'Gear, cut' }).click();
    await expect.poll(async () => Number(await readout(page, 'cuts'))).toBeGreaterThan(0);
    const pieces = await readout(page, 'pieces'), slider = page.getByRole('slider', { name: 'at pockets that last and are deep, at least τ' });
    await slider.focus();
    await page.keyboard.press('End');
    expect(Number(await readoutOtherThan(page, 'pieces', pieces))).toBeLessThan(Number(pieces));
    await page.getByLabel('cuts', { exact: true }).click();
    await expect.poll(() => page.locator('dt:text-is("pieces")').count()).toBe(0);
    await close(it);
  });
  it('tells what touching counts, and shows or hides bridges', async () => {
    const it = await opened(), { page } = it, canvas = page.locator('canvas.plane');
    await page.getByLabel('Shape of P').selectOption('square');
    await made(page, 'Shrunk');
    await set(page, 'Exactly', '1'); // the disc fits exactly, at one place
    await choose(page, 'What touching counts', 'Open');
    await expect.poll(() => readout(page, 'tight points, segments')).toBe('1, 0');
    await choose(page, 'What touching counts', 'Regular');
    await expect.poll(() => readout(page, 'tight points, segments')).toBe('0, 0');
    expect(await page.getByRole('button', { name: 'Copy the exact radius' }).innerText()).toMatch(/^radius /);
    await page.getByLabel('Shape of P').selectOption('comb');
    await made(page, 'Grown');
    await settled(page);
    const before = await canvas.screenshot();
    await page.getByLabel('discs that touch twice, and their bridges').click();
    await expect.poll(async () => before.equals(await canvas.screenshot())).toBe(false);
    await close(it);
  });
  it('counts lives between two diameters, and depths in four ways', async () => {
    const it = await opened(), { page } = it, bars = page.locator('.barcode [role=option]');
    await expect.poll(() => bars.count()).toBeGreaterThan(3);
    await set(page, 'lives from α', '1/4');
    await set(page, 'up to α', '1/2');
    await set(page, 'up to α', 'x');
    await expect.poll(() => page.getByLabel('up to α').evaluate((e: HTMLInputElement) => e.validationMessage)).toMatch(/not negative/);
    await expect.poll(() => page.locator('.refused').count()).toBe(1);
    expect(await page.getByLabel('up to α').inputValue()).toBe('x');
    await set(page, 'up to α', '1/2');
    await expect.poll(() => page.locator('.refused').count()).toBe(0);
    for (const way of ['Path', 'Hybrid 1', 'Hybrid 2']) {
      await choose(page, 'How deep pockets are', way);
      await expect.poll(() => bars.count()).toBeGreaterThan(3);
    }
    await set(page, 'pockets no deeper by shortest paths', '0.5');
    await expect.poll(() => bars.count()).toBeGreaterThan(3);
    await close(it);
  });
  it('plays', async () => {
    const it = await opened(), { page } = it, before = await page.getByLabel('Exactly').inputValue();
    await page.getByRole('button', { name: 'Play: Diameter α' }).click();
    await expect.poll(() => page.getByLabel('Exactly').inputValue()).not.toBe(before);
    await page.getByRole('button', { name: 'Stop: Diameter α' }).click();
    await close(it);
  });
});
