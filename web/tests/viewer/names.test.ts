// What can be chosen says what it is, and what comes of it is in sight.
import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, launch, open } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

const kPages = ['sum', 'obstacle', 'solids', 'discs', 'nesting'] as const;
/** The heading of what is computed, and its first value. */
const kResults: Record<(typeof kPages)[number], [string, string]> = {
  sum: ['Sum', 'area'], obstacle: ['Clearance', 'The robot'], solids: ['Sum', 'Volume'], discs: ['Set', 'area'], nesting: ['No-fit polygon', 'vertices'],
};

describe('every page', () => {
  it('has a sentence for all that can be chosen, and no name twice', async () => {
    const it = await open(browser), { page } = it;
    for (const name of kPages) {
      await page.goto(new URL(`#/${name}`, page.url()).href);
      await expect.poll(() => page.locator('.choice, .toggle').count()).toBeGreaterThan(0);
      const [bare, names] = await page.evaluate(() => {
        const choices = [...document.querySelectorAll<HTMLElement>('.choice label, label.toggle')];
        return [choices.filter((e) => !/\.$/.test(e.title)).map((e) => e.textContent), [...document.querySelectorAll('.choice')].map((e) => [...e.children].map((label) => label.textContent.trim()))] as const;
      });
      expect([name, bare]).toEqual([name, []]);
      const alike = (a: string, b: string): boolean => a.length > 2 && b.length > 2 && a !== b && (a.startsWith(b) || b.startsWith(a));
      const groups = names.flatMap((group, k) => group.flatMap((text) => names.slice(k + 1).flat().filter((other) => alike(text, other) || (name === 'discs' && text === other))));
      expect([name, groups]).toEqual([name, []]);
    }
    await close(it);
  });
  it('shows its results at 1280 x 800 without scrolling', async () => {
    for (const name of kPages) {
      const it = await open(browser, { hash: `#/${name}` }), { page } = it, [section, value] = kResults[name];
      const row = page.getByRole('region', { name: section, exact: true }).locator(`dt:text-is("${value}") + dd`);
      await expect.poll(() => row.innerText(), { timeout: 60_000 }).toMatch(/\d/);
      const { y, height } = (await row.boundingBox())!;
      expect([name, y + height <= 800]).toEqual([name, true]);
      await close(it);
    }
  });
});
