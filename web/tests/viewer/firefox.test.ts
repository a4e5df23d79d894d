// The same page in Debian's Firefox.
import { existsSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { close, drag, launch, open, readout, settled, shareLink } from './viewer';

describe.skipIf(!existsSync('/usr/bin/firefox-esr'))('Firefox', () => {
  it('adds, drags, undoes, and opens permalinks', async () => {
    const browser = await launch('firefox'), it = await open(browser), { page } = it;
    await settled(page);
    await page.getByLabel('Shape of P').selectOption('square');
    await page.getByLabel('Shape of Q').selectOption('square');
    await expect.poll(() => readout(page, 'area')).toBe('4');
    await page.getByText('Scale', { exact: true }).first().click();
    await drag(page, [60, 60], [120, 120]);
    await expect.poll(() => readout(page, 'area')).not.toBe('4');
    await settled(page);
    const hash = await shareLink(page), area = await readout(page, 'area');
    const second = await open(browser, { hash });
    await settled(second.page);
    expect(await readout(second.page, 'area')).toBe(area);
    for (const name of ['discs', 'nesting']) {
      const other = await open(browser, { hash: `#/${name}` });
      await expect.poll(() => other.page.locator('canvas.plane').getAttribute('data-shown'), { timeout: 60_000 }).not.toBeNull();
      await close(other);
    }
    await close(second);
    await close(it);
    await browser.close();
  });
});
