// The page of growing discs: every control does what it says.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, launch, open, readout, readoutOtherThan, settled } from './viewer';

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
    await made(page, 'Opened');
    await expect.poll(async () => Number(await readout(page, 'area'))).toBeCloseTo(0.25 + 0.5 + Math.PI / 16, 4);
    await made(page, 'Closed');
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
    expect(await page.getByLabel('Exactly').inputValue()).not.toMatch(/event/);
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
});
