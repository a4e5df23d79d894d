// What every page has: downloads of every format, undo, links, bad files marked where they are bad, keys, phones, the dark.
import type { Browser, CDPSession, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, download, dropFiles, example, launch, open, readout, set, settled, shareLink, type OpenOptions } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

interface Case {
  /** a readout that is there once all is computed */
  known: string;
  /** names of what the download menu saves, and how these files begin */
  files: Record<string, RegExp>;
  /** a list of shapes, one of them, and what is another one then */
  list: string;
  shape: string;
  field: [label: string, value: string];
}

const kText = { svg: /<svg/, wkt: /^(MULTI)?POLYGON|^GEOMETRYCOLLECTION/, json: /^\s*\{/, geojson: /^\s*\{/, poly: /^\d+/ };
const kCases: Record<string, Case> = {
  sum: {
    known: 'area', list: 'Shape of P', shape: 'comb', field: ['Exactly', '5/4'],
    files: { 'sum.svg': kText.svg, 'sum.wkt': kText.wkt, 'sum.json': kText.json, 'sum.geojson': kText.geojson, 'sum.poly': kText.poly },
  },
  obstacle: {
    known: 'Patches, shells', list: 'Shape of Obstacle', shape: 'U', field: ['tan θ/2', '1/3'],
    files: { 'obstacle.glb': /^glTF/, 'obstacle.obstacle': /\w/, 'obstacle.wkt': kText.wkt, 'path.json': kText.json },
  },
  solids: {
    known: 'Volume', list: 'Solid P', shape: 'cube', field: ['Scale, exactly', '3/4'],
    files: { 'sum.glb': /^glTF/, 'sum.stl': /[^]/, 'sum.off': /^OFF/, 'sum.json': kText.json },
  },
  discs: { known: 'area', list: 'Shape of P', shape: 'gear', field: ['Exactly', '1/3'], files: { 'disc.svg': kText.svg, 'disc.json': kText.json, 'disc.wkt': kText.wkt } },
  nesting: { known: 'vertices', list: 'Shape of A', shape: 'gear', field: ['', ''], files: { 'nfp.svg': kText.svg, 'nfp.wkt': kText.wkt, 'nfp.json': kText.json } },
};
const each = Object.entries(kCases);

const opened = async (id: string, options: OpenOptions = {}) => {
  const it = await open(browser, { hash: `#/${id}`, ...options });
  await expect.poll(() => readout(it.page, kCases[id]!.known), { timeout: 60_000 }).toMatch(/\d/);
  return it;
};

/** Pixels of the pictures that have a colour of the theme. */
async function pixels(page: Page, colour: string): Promise<number> {
  return await page.evaluate((name) => {
    const text = getComputedStyle(document.documentElement).getPropertyValue(name), rgb = [1, 3, 5].map((k) => parseInt(text.slice(k, k + 2), 16));
    let count = 0;
    for (const canvas of document.querySelectorAll('canvas')) {
      const { data } = canvas.getContext('2d')?.getImageData(0, 0, canvas.width, canvas.height) ?? { data: [] };
      for (let k = 0; k < data.length; k += 4) if (data[k + 3] === 255 && rgb.every((c, i) => Math.abs(data[k + i]! - c) < 6)) ++count;
    }
    return count;
  }, colour);
}

describe.each(each)('the page %s', (id, { known, files, list, shape, field }) => {
  it('saves every format', async () => {
    const it = await opened(id), { page } = it;
    if (id === 'obstacle') await expect.poll(() => page.getByLabel('Along the path').count(), { timeout: 30_000 }).toBe(1);
    await page.getByRole('button', { name: 'Download' }).click();
    const labels = await page.locator('.menu li').allInnerTexts(), saved: string[] = [];
    await page.keyboard.press('Escape');
    for (const label of labels) {
      const { name, bytes } = await download(page, label);
      expect(bytes.length).toBeGreaterThan(20);
      expect(bytes.toString('latin1').slice(0, 2000)).toMatch(files[name]!);
      saved.push(name);
    }
    expect(saved.sort()).toEqual(Object.keys(files).sort());
    await close(it);
  });
  it('shows every example', async () => {
    const it = await opened(id), { page } = it;
    await page.getByRole('button', { name: 'Examples' }).click();
    const names = await page.locator('.menu li').allInnerTexts();
    await page.keyboard.press('Escape');
    for (const name of names) {
      await example(page, name);
      await expect.poll(() => readout(page, known), { timeout: 60_000 }).toMatch(/\d/);
      expect(await page.getByRole('alert').count()).toBe(0);
    }
    await close(it);
  });
  it('opens a file in place of a shape', async () => {
    const it = await opened(id), { page } = it;
    const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.getByRole('button', { name: /^Open a file as/ }).first().click()]);
    const name = id === 'solids' ? 'mine.off' : 'mine.wkt', text = id === 'solids' ? 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n' : 'POLYGON ((0 0, 3 0, 3 2, 0 2, 0 0))';
    await chooser.setFiles({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });
    await expect.poll(() => page.locator('.panel select').first().locator('option:checked').innerText()).toBe(name);
    await expect.poll(() => readout(page, known), { timeout: 60_000 }).toMatch(/\d/);
    await close(it);
  });
  it('undoes, redoes, and keeps all in a link', async () => {
    const it = await opened(id), { page } = it, before = await page.getByLabel(list).inputValue();
    await page.getByLabel(list).selectOption(shape);
    if (field[0]) await set(page, ...field);
    const hash = await shareLink(page), second = await open(browser, { hash });
    await expect.poll(() => readout(second.page, known), { timeout: 60_000 }).toMatch(/\d/);
    expect(await second.page.getByLabel(list).inputValue()).toBe(shape);
    if (field[0]) expect(await second.page.getByLabel(field[0], { exact: true }).inputValue()).toBe(field[1]);
    await page.getByRole('button', { name: 'Undo' }).click();
    if (field[0]) await page.getByRole('button', { name: 'Undo' }).click();
    await expect.poll(() => page.getByLabel(list).inputValue()).toBe(before);
    await page.getByRole('button', { name: 'Redo' }).click();
    await expect.poll(() => page.getByLabel(list).inputValue()).toBe(shape);
    await close(second);
    await close(it);
  });
  it('marks what is wrong with a file where it is wrong', async () => {
    const it = await opened(id), { page } = it, before = await pixels(page, '--error');
    const cube = 'OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n';
    await dropFiles(page, id === 'solids' ? { 'bad.off': cube.replace('8 6 0', '8 5 0').replace('4 3 0 4 7\n', '') } : { 'bow.wkt': 'POLYGON ((0 0, 4 4, 4 0, 0 3, 0 0))' });
    await expect.poll(() => page.getByRole('alert').innerText()).toMatch(id === 'solids' ? /^not closed: / : /^self crossing: /);
    await expect.poll(() => pixels(page, '--error')).toBeGreaterThan(before + 60);
    await page.getByRole('button', { name: 'Close the message' }).click();
    await page.getByRole('button', { name: 'Undo' }).click();
    await expect.poll(() => readout(page, known), { timeout: 60_000 }).toMatch(/\d/);
    await close(it);
  });
  it('is there on phones, in the dark, with little motion', async () => {
    const it = await opened(id, { width: 390, height: 780, dark: true, touch: true, reducedMotion: true }), { page } = it;
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
    const panel = (await page.locator('.panel').boundingBox())!, stage = (await page.locator('.stage').boundingBox())!;
    expect(panel.y).toBeGreaterThanOrEqual(stage.y + stage.height - 1); // below the picture
    const dark = await page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g)!.slice(0, 3).map(Number));
    expect(Math.max(...dark)).toBeLessThan(80);
    expect(await page.getByRole('button', { name: /^Play: / }).count()).toBe(0); // nothing moves by itself
    await page.getByRole('button', { name: 'Light or dark' }).tap();
    expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe('light');
    await close(it);
  });
  it('is used by keys alone', async () => {
    const it = await opened(id), { page } = it, seen = new Set<string>();
    for (let k = 0; k < 90; ++k) {
      await page.keyboard.press('Tab');
      seen.add(await page.evaluate(() => (document.activeElement!.getAttribute('aria-label') ?? (document.activeElement as HTMLInputElement).labels?.[0]?.innerText ?? document.activeElement!.textContent ?? '').trim()));
    }
    const wanted = await page.evaluate(() =>
      [...document.querySelectorAll<HTMLElement>('button:enabled, select, input:not([type=radio]), .plane, .space, .barcode')]
        .map((e) => (e.getAttribute('aria-label') ?? (e as HTMLInputElement).labels?.[0]?.innerText ?? e.textContent ?? '').trim()),
    );
    expect(wanted.filter((name) => !seen.has(name))).toEqual([]);
    await page.getByLabel(list).focus();
    const before = await page.getByLabel(list).inputValue();
    await page.keyboard.press('ArrowDown');
    await expect.poll(() => page.getByLabel(list).inputValue()).not.toBe(before);
    await page.keyboard.press('Control+z');
    await expect.poll(() => page.getByLabel(list).inputValue()).toBe(before);
    await close(it);
  });
});

/** A finger that drags, as the browser has it. */
async function swipe(client: CDPSession, from: [number, number], to: [number, number]): Promise<void> {
  const at = (x: number, y: number) => ({ touchPoints: [{ x, y }] });
  await client.send('Input.dispatchTouchEvent', { type: 'touchStart', ...at(...from) });
  for (let k = 1; k <= 8; ++k) await client.send('Input.dispatchTouchEvent', { type: 'touchMove', ...at(from[0] + ((to[0] - from[0]) * k) / 8, from[1] + ((to[1] - from[1]) * k) / 8) });
  await client.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
}

describe('a finger', () => {
  const phone = { width: 390, height: 780, touch: true };
  it('drags shapes of the plane', async () => {
    const it = await opened('sum', phone), { page } = it, box = (await page.locator('canvas.plane').boundingBox())!;
    const x = box.x + box.width / 2, y = box.y + box.height / 2;
    await swipe(await page.context().newCDPSession(page), [x, y], [x + 60, y + 20]);
    await expect.poll(() => page.getByRole('button', { name: 'Reset' }).isEnabled()).toBe(true);
    await page.waitForTimeout(400); // a touch right after another one is no tap to the browser
    await page.getByRole('button', { name: 'Undo' }).tap();
    await expect.poll(() => page.getByRole('button', { name: 'Reset' }).isEnabled()).toBe(false);
    await close(it);
  });
  it('looks around solids', async () => {
    const it = await opened('solids', phone), { page } = it, space = page.locator('.space').last(), box = (await space.boundingBox())!;
    const frames = Number(await space.getAttribute('data-frames')), x = box.x + box.width / 2, y = box.y + box.height / 2;
    await swipe(await page.context().newCDPSession(page), [x, y], [x + 80, y]);
    await expect.poll(async () => Number(await space.getAttribute('data-frames'))).toBeGreaterThan(frames);
    await close(it);
  });
});

describe('all pages', () => {
  const kSquare = 'POLYGON ((0 0, 3 0, 3 3, 0 3, 0 0))';
  it('says which page takes which of files that none takes together', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    await dropFiles(page, { 'a.wkt': kSquare, 'b.off': 'OFF\n0 0 0\n' });
    await expect.poll(() => page.getByRole('alert').innerText()).toMatch(/No page takes these files together: "a\.wkt" is for Sum, .*"b\.off" is for Solids/);
    await close(it);
  });
  it('has one row of buttons on the narrowest phones', async () => {
    for (const width of [320, 360, 390]) {
      const it = await open(browser, { width, height: 640, touch: true }), { page } = it;
      const rows = await page.locator('.header > :not(.tabs)').evaluateAll((all) => all.map((e) => e.getBoundingClientRect()).filter((b) => b.width > 0).map((b) => Math.round(b.top + b.height / 2)));
      expect(rows.length).toBeGreaterThan(6);
      expect(Math.max(...rows) - Math.min(...rows)).toBeLessThan(8);
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
      await close(it);
    }
  });
  it('shows each page as it was left', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    await dropFiles(page, { 'a.wkt': kSquare, 'b.wkt': kSquare });
    await expect.poll(() => readout(page, 'area')).toBe('36');
    await page.locator('.tabs a', { hasText: 'Growing discs' }).click();
    await page.getByLabel('Shape of P').selectOption('star');
    await page.locator('.tabs a', { hasText: 'Sum' }).click();
    expect(await page.getByLabel('Shape of P').locator('option:checked').innerText()).toBe('a.wkt');
    await expect.poll(() => readout(page, 'area').catch(() => '')).toBe('36');
    await page.locator('.tabs a', { hasText: 'Growing discs' }).click();
    expect(await page.getByLabel('Shape of P').inputValue()).toBe('star');
    await close(it);
  });
});
