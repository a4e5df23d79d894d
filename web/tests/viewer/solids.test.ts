// The page of solids: every control does what it says, with exact values.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { choose, close, download, dropFiles, launch, open, readout, readoutOtherThan, set, shareLink, type OpenOptions } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

const known = async (page: Page): Promise<void> => await expect.poll(() => readout(page, 'Volume'), { timeout: 60_000 }).toMatch(/\d/);
const opened = async (options: OpenOptions = {}) => {
  const it = await open(browser, { hash: '#/solids', ...options });
  await known(it.page);
  return it;
};
/** Two cubes, not turned. */
const cubes = async () => {
  const it = await opened();
  await it.page.getByLabel('Solid P').selectOption('cube');
  await it.page.getByLabel('Turn', { exact: true }).fill('0');
  await expect.poll(() => readout(it.page, 'Volume')).toBe('64');
  return it;
};
const pictures = (page: Page) => page.locator('.space');

describe('the page of solids', () => {
  it('turns and scales exactly', async () => {
    const it = await cubes(), { page } = it;
    expect(await page.getByRole('button', { name: 'Copy the exact volume' }).innerText()).toBe('64/1');
    await set(page, 'Scale, exactly', '1/3');
    await expect.poll(() => page.getByRole('button', { name: 'Copy the exact volume' }).innerText()).toBe('512/27');
    await page.getByText('z', { exact: true }).click();
    await page.getByLabel('Turn', { exact: true }).fill('45');
    await expect.poll(() => readout(page, 'Vertices, faces')).toBe('16, 10');
    await page.keyboard.press('Control+z');
    await expect.poll(() => readout(page, 'Vertices, faces')).toBe('8, 6');
    await close(it);
  });
  it('colours what changes, and nothing in a first frame', async () => {
    const it = await opened(), { page } = it;
    expect(await readout(page, 'Changed')).toBe('0 faces');
    await page.getByLabel('Turn', { exact: true }).focus();
    await page.keyboard.press('ArrowRight');
    expect(await readoutOtherThan(page, 'Changed', '0 faces')).toMatch(/^[1-9]\d* faces$/);
    await page.getByLabel('Colour what changes').click();
    await page.getByLabel('See through').click();
    await close(it);
  });
  it('turns round and stops where it is paused', async () => {
    const it = await opened(), { page } = it, before = await page.getByLabel('Turn', { exact: true }).inputValue();
    await page.getByRole('button', { name: 'Turn round' }).click();
    await expect.poll(() => page.getByLabel('Turn', { exact: true }).inputValue()).not.toBe(before);
    await page.getByRole('button', { name: 'Pause' }).click();
    const at = await page.getByLabel('Turn', { exact: true }).inputValue();
    await page.waitForTimeout(300);
    expect(await page.getByLabel('Turn', { exact: true }).inputValue()).toBe(at);
    await page.keyboard.press('Control+z'); // all of it is one step
    await expect.poll(() => page.getByLabel('Turn', { exact: true }).inputValue()).toBe(before);
    await close(it);
  });
  it('tells the depth exactly, of convex solids and of others', async () => {
    const it = await cubes(), { page } = it, squared = page.getByRole('button', { name: 'Copy the square of the depth' });
    await choose(page, 'What is computed', 'P ⊕ −Q');
    await set(page, 'x of Q', '1.5');
    await set(page, 'y of Q', '0');
    await set(page, 'z of Q', '0');
    await expect.poll(() => readout(page, 'Q')).toBe('overlaps P, depth 0.5');
    expect(await squared.innerText()).toBe('1/4');
    await set(page, 'x of Q', '3');
    await expect.poll(() => readout(page, 'Q')).toBe('does not overlap P');
    await page.getByLabel('Solid P').selectOption('channel');
    await page.getByLabel('Solid Q').selectOption('bar');
    await set(page, 'x of Q', '1');
    await expect.poll(() => readout(page, 'Q')).toBe('overlaps P, depth 1'); // back into the groove, which it fits exactly
    expect(await squared.innerText()).toBe('1/1');
    expect(await readout(page, 'Tight')).toBe('faces');
    await close(it);
  });
  it('drags Q', async () => {
    const it = await opened(), { page } = it, box = (await pictures(page).first().boundingBox())!;
    const before = await page.getByLabel('x of Q').inputValue(), x = box.x + box.width / 2, y = box.y + box.height / 2;
    // The cube is somewhere right of the middle: what is dragged there is Q, or else the camera.
    for (const [dx, dy] of [[90, 30], [70, 40], [110, 40], [60, 20]] as const) {
      await page.mouse.move(x + dx, y + dy);
      await page.mouse.down();
      await page.mouse.move(x + dx + 40, y + dy, { steps: 5 });
      await page.mouse.up();
      if ((await page.getByLabel('x of Q').inputValue()) !== before) break;
    }
    expect(Number(await page.getByLabel('x of Q').inputValue())).toBeGreaterThan(Number(before));
    await close(it);
  });
  it('cuts at a height, with the exact area', async () => {
    const it = await cubes(), { page } = it;
    await page.getByLabel('Cut the sum at a height').click();
    await expect.poll(() => page.getByRole('button', { name: 'Copy the exact area' }).innerText()).toBe('16/1');
    await page.getByLabel('z', { exact: true }).last().focus();
    await page.keyboard.press('End');
    await expect.poll(() => page.getByLabel('z', { exact: true }).last().inputValue()).toBe('2');
    await close(it);
  });
  it('names the features that make a face, and its exact corners', async () => {
    const it = await cubes(), { page } = it, right = pictures(page).last(), box = (await right.boundingBox())!;
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await expect.poll(() => right.locator('.status').innerText()).toMatch(/: (face|vertex|edge) .* of P, .* of Q/);
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await expect.poll(() => page.getByRole('button', { name: 'Copy corner 0' }).innerText()).toMatch(/^-?2\/1, -?2\/1, -?2\/1$/);
    await close(it);
  });
  it('takes files, refuses others with the place, and keeps all in a link', async () => {
    const it = await opened(), { page } = it;
    const tetrahedron = 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n';
    await dropFiles(page, { 'p.off': tetrahedron, 'q.off': tetrahedron });
    await page.getByLabel('Turn', { exact: true }).fill('0');
    await expect.poll(() => page.getByRole('button', { name: 'Copy the exact volume' }).innerText()).toBe('4/3');
    const second = await open(browser, { hash: await shareLink(page) });
    await known(second.page);
    expect(await second.page.getByRole('button', { name: 'Copy the exact volume' }).innerText()).toBe('4/3');
    await dropFiles(page, { 'open.off': tetrahedron.replace('4 4 0', '4 3 0').replace('3 0 3 2\n', '') });
    await expect.poll(() => page.getByRole('alert').innerText()).toMatch(/not closed/);
    await close(second);
    await close(it);
  });
  it('saves GLB, STL, OFF and JSON', async () => {
    const it = await cubes(), { page } = it;
    for (const [label, format] of [['Sum (GLB)', 'glb'], ['Sum (STL)', 'stl'], ['Sum (OFF)', 'off'], ['Sum, exact (JSON)', 'json']] as const) {
      const { name, bytes } = await download(page, label);
      expect(name).toBe(`sum.${format}`);
      if (format === 'off') expect(bytes.toString()).toMatch(/^OFF/);
      if (format === 'json') expect((JSON.parse(bytes.toString()) as { vertex_list: object[] }).vertex_list.length).toBe(8);
    }
    await close(it);
  });
  it('is there on phones, in the dark, by touch', async () => {
    const it = await opened({ width: 390, height: 780, dark: true, touch: true }), { page } = it;
    const [left, right] = await pictures(page).all(), a = (await left!.boundingBox())!, b = (await right!.boundingBox())!;
    expect(b.y).toBeGreaterThanOrEqual(a.y + a.height - 1); // one above the other
    const frames = Number(await right!.getAttribute('data-frames'));
    await page.touchscreen.tap(b.x + b.width / 2, b.y + b.height / 2);
    await expect.poll(() => page.locator('h2').allInnerTexts()).toContain('CHOSEN FACE');
    expect(Number(await right!.getAttribute('data-frames'))).toBeGreaterThanOrEqual(frames);
    await close(it);
  });
  it('refuses numbers that nothing can be computed with', async () => {
    const it = await cubes(), { page } = it, refusal = (label: string) => page.getByLabel(label, { exact: true }).evaluate((e: HTMLInputElement) => e.validationMessage);
    for (const scale of ['1e400', '1:2:1e400', '1e-400']) {
      await set(page, 'Scale, exactly', scale);
      expect(await refusal('Scale, exactly')).toMatch(/1e-150 to 1e\+150/);
    }
    await set(page, 'x of Q', '1e308');
    expect(await refusal('x of Q')).toMatch(/1e-150 to 1e\+150/);
    for (const scale of ['1e18', '1e150', '1e-150', '1/2']) await set(page, 'Scale, exactly', scale); // beyond 2^64 there is no sum, and no wrong picture
    await expect.poll(() => readout(page, 'Volume')).toBe('27');
    await set(page, 'x of Q', '-1e150');
    await expect.poll(() => readout(page, 'Volume')).toBe('27');
    await close(it);
  });
  it('turns and scales P or Q, and keeps what is typed', async () => {
    const it = await cubes(), { page } = it, box = (await pictures(page).last().boundingBox())!;
    await page.getByLabel('Solid Q').selectOption('bar'); // 2 by 1 by 1
    await expect.poll(() => readout(page, 'Volume')).toBe('36');
    await page.getByRole('slider', { name: 'Scale' }).focus();
    await page.keyboard.press('End');
    await expect.poll(() => readout(page, 'Volume')).toBe('96'); // 6 by 4 by 4
    await choose(page, 'Which moves', 'P turns and is scaled');
    await expect.poll(() => readout(page, 'Volume')).toBe('150'); // 6 by 5 by 5
    await choose(page, 'What touching counts', 'Regular');
    await expect.poll(() => readout(page, 'Tight')).toBe('nothing');
    const field = page.getByLabel('x of Q', { exact: true });
    await field.fill('3');
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2); // names a face: the page is drawn again
    await expect.poll(() => pictures(page).last().locator('.status').innerText()).toMatch(/of P/);
    expect(await field.inputValue()).toBe('3');
    await close(it);
  });
});
