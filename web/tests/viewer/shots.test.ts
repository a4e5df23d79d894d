// Pictures of every page, compared with those beside this file. At most one pixel of a hundred may differ visibly: browsers
// smooth lines and letters differently. UPDATE_SHOTS=1 writes them anew; look at them before they are committed.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import pixelmatch from 'pixelmatch';
import type { Browser } from 'playwright-core';
import { PNG } from 'pngjs';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, launch, open, type OpenOptions } from './viewer';

const kShare = 0.01;
const kShots = new URL('shots/', import.meta.url);

const kCases: Record<string, OpenOptions> = {
  sum: {}, 'sum-dark': { dark: true }, 'sum-phone': { width: 390, height: 780, touch: true },
  obstacle: { hash: '#/obstacle' }, 'obstacle-phone-dark': { hash: '#/obstacle', width: 390, height: 780, dark: true, touch: true },
  solids: { hash: '#/solids' }, 'solids-dark': { hash: '#/solids', dark: true },
  discs: { hash: '#/discs' }, nesting: { hash: '#/nesting' }, 'nesting-phone-dark': { hash: '#/nesting', width: 390, height: 780, dark: true, touch: true },
};

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

describe('pictures', () => {
  it.each(Object.entries(kCases))('%s', async (name, options) => {
    const it = await open(browser, { ...options, reducedMotion: true });
    const drawn = it.page.locator('canvas.plane[data-shown], .space[data-triangles]:not([data-triangles="0"])');
    await expect.poll(() => drawn.count(), { timeout: 60_000 }).toBeGreaterThan(0);
    await it.page.waitForTimeout(1500); // what settles: area, barcode
    const shot = PNG.sync.read(await it.page.locator('.stage').screenshot()), file = new URL(`${name}.png`, kShots);
    if (process.env.UPDATE_SHOTS || !existsSync(file)) {
      mkdirSync(kShots, { recursive: true });
      writeFileSync(file, PNG.sync.write(shot));
      if (!process.env.UPDATE_SHOTS) expect.fail(`${name}.png was not there; it is now: look at it`);
    }
    const expected = PNG.sync.read(readFileSync(file));
    expect([shot.width, shot.height]).toEqual([expected.width, expected.height]);
    const different = pixelmatch(shot.data, expected.data, undefined, shot.width, shot.height, { threshold: 0.2 });
    expect(different / (shot.width * shot.height)).toBeLessThan(kShare);
    await close(it);
  });
});
