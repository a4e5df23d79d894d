// The page of nesting: B snaps to exact fits, and what A and B are to each other is said exactly.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, example, launch, open, readout, shareLink } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

const opened = async () => {
  const it = await open(browser, { hash: '#/nesting' });
  await expect.poll(() => said(it.page), { timeout: 60_000 }).toMatch(/A and B/);
  return it;
};
const said = (page: Page): Promise<string> => page.locator('p[role=status]').innerText();
const place = (page: Page): Promise<string> => page.getByRole('button', { name: 'Copy the exact position' }).innerText();

const opensExample = async (page: Page, name: string): Promise<void> => {
  await example(page, name);
  await expect.poll(() => readout(page, 'vertices')).toMatch(/\d/);
};

describe('the page of nesting', () => {
  it('tells apart, overlapping and touching', async () => {
    const it = await opened(), { page } = it;
    await opensExample(page, 'A slot that fits exactly');
    await expect.poll(() => said(page)).toBe('A and B are apart by 1.');
    await page.getByRole('button', { name: 'To the nearest fit' }).click();
    await expect.poll(() => said(page)).toBe('A and B touch, exactly.');
    expect(await page.getByRole('button', { name: 'To the nearest fit' }).isDisabled()).toBe(true);
    await page.keyboard.press('Control+z');
    await expect.poll(() => said(page)).toBe('A and B are apart by 1.');
    await close(it);
  });
  it('tells distances exactly where squares are no doubles', async () => {
    const square = (power: string): string => `POLYGON ((${[[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]].map(([x, y]) => `${x}${power} ${y}${power}`).join(', ')}))`;
    const it = await opened(), { page } = it;
    for (const [power, squared, area] of [['e250', '2e+500', '4e+500'], ['e100', '2e+200', '4e+200'], ['e-250', '2e-500', '4e-500']] as const) {
      const shape = (name: string): object => ({ name: `${name}${power}.wkt`, text: square(power) }), at = { kind: 'free', x: Number(`2${power}`), y: Number(`2${power}`) };
      const open = async (detail: object): Promise<void> => await page.evaluate((data) => void dispatchEvent(new CustomEvent('dymsum-open', { detail: data })), detail);
      await open({ page: 'nesting', state: { a: shape('a'), b: shape('b'), at } });
      await expect.poll(() => readout(page, 'distance squared').catch(() => '')).toBe(squared);
      expect(await page.getByRole('button', { name: 'Copy the square of the distance' }).innerText()).toMatch(/^\d{30,}.*\((203|5\d\d) characters\)$/);
      await open({ page: 'sum', state: { p: shape('a'), q: shape('b') } });
      await expect.poll(() => readout(page, 'area').catch(() => '')).toBe(area);
    }
    await close(it);
  });
  it('knows the slot that B fits into without room', async () => {
    const it = await opened(), { page } = it;
    await opensExample(page, 'A slot that fits exactly');
    expect(await readout(page, 'exact fits: points, segments')).not.toBe('0, 0');
    await close(it);
  });
  it('snaps B to the boundary while it is dragged', async () => {
    const it = await opened(), { page } = it, canvas = page.locator('canvas.plane');
    await opensExample(page, 'A slot that fits exactly');
    await expect.poll(() => said(page)).toMatch(/apart/);
    const box = (await canvas.boundingBox())!;
    const [cx, cy, unit] = (await canvas.getAttribute('data-camera'))!.split(' ').map(Number) as [number, number, number];
    const at = (x: number, y: number): [number, number] => [box.x + box.width / 2 + (x - cx) * unit, box.y + box.height / 2 - (y - cy) * unit];
    const drag = async (from: [number, number], to: [number, number]): Promise<void> => {
      await page.mouse.move(...at(...from));
      await page.mouse.down();
      await page.mouse.move(...at(...to), { steps: 10 });
      await page.mouse.up();
    };
    await drag([6, 4], [5 + 2 / unit, 4]); // within two pixels of touching the side of A
    await expect.poll(() => said(page)).toBe('A and B touch, exactly.');
    expect(await place(page)).toMatch(/^\(4, /);
    await expect.poll(() => page.getByText('Contact:').innerText()).toMatch(/of A/);
    await drag([5, 4], [3, 4]);
    await expect.poll(() => said(page)).toMatch(/overlap/);
    const hash = await shareLink(page), where = await place(page);
    const second = await open(browser, { hash });
    await expect.poll(() => said(second.page), { timeout: 60_000 }).toMatch(/overlap/);
    expect(await place(second.page)).toBe(where);
    await close(second);
    await close(it);
  });
  it('moves B by keys', async () => {
    const it = await opened(), { page } = it;
    await opensExample(page, 'A slot that fits exactly');
    await expect.poll(() => place(page)).toBe('(5, 3)');
    await page.locator('canvas.plane').focus();
    await page.keyboard.press('Alt+ArrowUp');
    await expect.poll(() => place(page)).not.toBe('(5, 3)');
    await page.keyboard.press('Control+z');
    await expect.poll(() => place(page)).toBe('(5, 3)');
    await close(it);
  });
});
