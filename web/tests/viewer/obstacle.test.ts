// The page of a robot that turns: every control does what it says, and the two pictures follow each other.
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, download, dropFiles, example, launch, open, readout, set, shareLink, type OpenOptions } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

const opened = async (options: OpenOptions = {}) => {
  const it = await open(browser, { hash: '#/obstacle', ...options });
  await expect.poll(() => readout(it.page, 'The robot'), { timeout: 60_000 }).toMatch(/clearance|depth|touches/);
  return it;
};
const space = (page: Page) => page.locator('.space');
const frames = async (page: Page, what: 'frames' | 'overlays'): Promise<number> => Number(await space(page).getAttribute(`data-${what}`));

describe('the page of a robot that turns', () => {
  it('tells clearance, contact and overlap exactly', async () => {
    const it = await opened(), { page } = it;
    await set(page, 'x', '2.5');
    await set(page, 'y', '6.25'); // the rod lies on the teeth, whose tops are at 6
    await expect.poll(() => readout(page, 'The robot')).toBe('touches');
    await set(page, 'y', '6.5');
    await expect.poll(() => readout(page, 'The robot')).toMatch(/^free, clearance 0\.\d+$/);
    await expect.poll(() => readout(page, 'Nearest contact')).toMatch(/^(edge|vertex) \d+ of the obstacle, (edge|vertex) \d+ of the robot$/);
    await set(page, 'y', '6');
    await expect.poll(() => readout(page, 'The robot')).toMatch(/^overlaps, depth/);
    await close(it);
  });
  it('goes to event angles exactly, and to an exact tangent', async () => {
    const it = await opened(), { page } = it;
    await set(page, 'tan θ/2', '1/3');
    await expect.poll(() => page.getByLabel('θ', { exact: true }).getAttribute('aria-valuetext')).toBe('36.87°');
    await page.getByRole('button', { name: 'Event ›' }).click();
    await expect.poll(() => page.getByLabel('tan θ/2').inputValue()).not.toBe('1/3');
    const later = await page.getByLabel('tan θ/2').inputValue();
    await page.getByRole('button', { name: '‹ Event' }).click();
    await expect.poll(() => page.getByLabel('tan θ/2').inputValue()).not.toBe(later);
    await set(page, 'tan θ/2', 'half'); // refused, with a reason
    await expect.poll(() => page.getByLabel('tan θ/2').evaluate((e: HTMLInputElement) => e.validationMessage)).toMatch(/tangent of half the angle/);
    await close(it);
  });
  it('keeps what it refuses marked, with the reason, until it is mended or taken back', async () => {
    const it = await opened(), { page } = it, x = page.getByLabel('x', { exact: true }), before = await x.inputValue();
    const marks = async (): Promise<unknown[]> => [await x.inputValue(), await x.getAttribute('aria-invalid'), await page.locator('.refused').count()];
    await set(page, 'x', '1/3');
    await page.locator('canvas.plane').focus();
    await page.waitForTimeout(300);
    expect(await marks()).toEqual(['1/3', 'true', 1]);
    expect(await page.locator('.refused').innerText()).toMatch(/decimal number/);
    await x.fill('1');
    expect(await marks()).toEqual(['1', 'false', 0]);
    await x.fill('1/3'); // the same text again is refused again
    await x.blur();
    expect(await marks()).toEqual(['1/3', 'true', 1]);
    await x.focus();
    await page.keyboard.press('Escape');
    expect(await marks()).toEqual([before, 'false', 0]);
    await set(page, 'y', '1e400');
    expect(await page.locator('.refused').innerText()).toMatch(/too large/);
    await set(page, 'y', '.5');
    await expect.poll(() => page.getByLabel('y', { exact: true }).inputValue()).toBe('0.5');
    expect(await page.locator('.refused').count()).toBe(0);
    await close(it);
  });
  it('moves and turns the robot by hand, start and goal too, and undoes it', async () => {
    const it = await opened(), { page } = it, before = await readout(page, 'The robot');
    const canvas = (await page.locator('canvas.plane').boundingBox())!;
    const camera = (await page.locator('canvas.plane').getAttribute('data-camera'))!.split(' ').map(Number) as [number, number, number];
    const at = (x: number, y: number): [number, number] => [canvas.x + canvas.width / 2 + (x - camera[0]) * camera[2], canvas.y + canvas.height / 2 - (y - camera[1]) * camera[2]];
    const drag = async (from: [number, number], to: [number, number]): Promise<void> => {
      await page.mouse.move(...at(...from));
      await page.mouse.down();
      await page.mouse.move(...at(...to), { steps: 6 });
      await page.mouse.up();
    };
    await drag([-3, 10], [-2, 9]);
    expect(Number(await page.getByLabel('x', { exact: true }).inputValue())).toBeCloseTo(-2, 1);
    await expect.poll(() => readout(page, 'The robot')).not.toBe(before);
    await drag([-2 + 1.15 * Math.hypot(1.5, 0.25), 9], [-2, 11]); // its handle, a quarter turn
    await expect.poll(() => page.getByLabel('θ', { exact: true }).getAttribute('aria-valuetext')).toMatch(/^(89|90)/);
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Control+z');
    expect(await page.getByLabel('x', { exact: true }).inputValue()).toBe('-3');
    await drag([1.5, 3], [1.5, 2]); // the goal
    await expect.poll(() => page.locator('.panel').innerText()).toMatch(/moves, every one checked exactly/);
    await close(it);
  });
  it('finds a path, plays it, pauses and scrubs', async () => {
    const it = await opened(), { page } = it;
    await page.getByRole('button', { name: 'Play' }).click({ timeout: 30_000 });
    await expect.poll(async () => Number(await page.getByLabel('Along the path').inputValue())).toBeGreaterThan(0.05);
    await page.getByRole('button', { name: 'Pause' }).click();
    const share = await page.getByLabel('Along the path').inputValue();
    await page.waitForTimeout(300);
    expect(await page.getByLabel('Along the path').inputValue()).toBe(share);
    await page.getByLabel('Along the path').focus();
    await page.keyboard.press('End');
    await expect.poll(() => page.getByLabel('y', { exact: true }).inputValue()).toBe('3');
    await expect.poll(() => readout(page, 'The robot')).toMatch(/^on the path/);
    await page.getByRole('button', { name: 'Clear the path' }).click();
    expect(await page.getByLabel('Along the path').count()).toBe(0);
    await page.getByRole('button', { name: 'Find a path' }).click();
    await expect.poll(() => page.getByLabel('Along the path').count()).toBe(1);
    await close(it);
  });
  it('says why there is no path', async () => {
    const it = await opened(), { page } = it;
    await example(page, 'No path leads into a grate');
    await expect.poll(() => page.locator('.reason').innerText(), { timeout: 30_000 }).toMatch(/separates start and goal[\s\S]*component 0, which reaches infinity[\s\S]*enclosed/);
    await page.getByRole('button', { name: 'Goal here' }).click();
    await expect.poll(() => page.locator('.reason').count()).toBe(0);
    await close(it);
  });
  it('cuts, shines through, names patches under the pointer, and draws only when something changes', async () => {
    const it = await opened(), { page } = it;
    await page.waitForTimeout(500);
    const still = await frames(page, 'frames');
    await page.waitForTimeout(700);
    expect(await frames(page, 'frames')).toBe(still);
    const box = (await space(page).boundingBox())!;
    await page.mouse.move(box.x + box.width / 2, box.y + box.height * 0.62);
    await expect.poll(() => space(page).locator('.status').innerText()).toMatch(/of the obstacle, (edge|vertex) \d+ of the robot/);
    await page.getByLabel('Cut the obstacle at θ').click();
    await page.getByLabel('See through it').click();
    await expect.poll(() => frames(page, 'frames')).toBeGreaterThan(still);
    await space(page).focus();
    const turned = await frames(page, 'frames');
    await page.keyboard.press('ArrowLeft');
    await expect.poll(() => frames(page, 'frames')).toBeGreaterThan(turned);
    await close(it);
  });
  it('only draws the overlay while the robot is moved', async () => {
    const it = await opened(), { page } = it;
    await page.waitForTimeout(500);
    const surface = await frames(page, 'frames'), overlay = await frames(page, 'overlays');
    await set(page, 'x', '-2.5');
    await expect.poll(() => frames(page, 'overlays')).toBeGreaterThan(overlay);
    expect(await frames(page, 'frames')).toBe(surface);
    await close(it);
  });
  it('takes files and permalinks, and refuses what is wrong with its place', async () => {
    const it = await opened(), { page } = it;
    await dropFiles(page, { 'peg.wkt': 'POLYGON((-1 -1, 1 -1, 1 1, -1 1, -1 -1))', 'slot.wkt': 'POLYGON((4 0, 8 0, 8 4, 4 4, 4 0))' });
    await expect.poll(() => page.getByLabel('Shape of Robot').locator('option:checked').innerText()).toBe('peg.wkt');
    await expect.poll(() => page.getByLabel('x', { exact: true }).inputValue()).not.toBe('0'); // beside the obstacle
    await set(page, 'x', '3');
    await set(page, 'y', '2');
    await expect.poll(() => readout(page, 'The robot')).toBe('touches');
    await page.getByLabel('Touching is forbidden').click();
    const hash = await shareLink(page), second = await open(browser, { hash });
    await expect.poll(() => readout(second.page, 'The robot'), { timeout: 60_000 }).toBe('touches');
    expect(await second.page.getByLabel('Touching is forbidden').isChecked()).toBe(true);
    await dropFiles(page, { 'bow.wkt': 'POLYGON((0 0, 2 2, 2 0, 0 2, 0 0))' });
    await expect.poll(() => page.getByRole('alert').innerText()).toMatch(/self crossing/);
    await close(second);
    await close(it);
  });
  it('saves the obstacle, the slice and the path', async () => {
    const it = await opened(), { page } = it;
    await expect.poll(() => page.getByLabel('Along the path').count(), { timeout: 30_000 }).toBe(1);
    for (const [label, name] of [['Obstacle (GLB)', 'obstacle.glb'], ['Obstacle, exact (.obstacle)', 'obstacle.obstacle'], ['Slice (WKT)', 'obstacle.wkt'], ['Path (JSON)', 'path.json']] as const) {
      expect((await download(page, label)).name).toBe(name);
    }
    await close(it);
  });
  it('plays in still steps where motion is to be reduced', async () => {
    const it = await opened({ reducedMotion: true }), { page } = it;
    await page.getByRole('button', { name: 'Play' }).click({ timeout: 30_000 });
    const seen = new Set<string>();
    for (let k = 0; k < 20; ++k) {
      seen.add(await page.getByLabel('Along the path').inputValue());
      await page.waitForTimeout(80);
    }
    expect(seen.size).toBeLessThanOrEqual(5); // 1.6 seconds of 12 steps in 6
    await close(it);
  });
  it('starts where the robot is, at an angle that keys turn', async () => {
    const it = await opened(), { page } = it, theta = page.getByLabel('θ', { exact: true });
    await theta.focus();
    await page.keyboard.press('ArrowRight');
    await expect.poll(() => page.getByLabel('tan θ/2').inputValue()).toMatch(/^\d+\/1024$/);
    await set(page, 'tan θ/2', '90deg');
    expect(await theta.getAttribute('aria-valuetext')).toBe('90°');
    await set(page, 'x', '-4');
    await page.getByRole('button', { name: 'Start here' }).click();
    await page.getByRole('button', { name: 'Goal here' }).click();
    await expect.poll(() => page.locator('.panel').innerText()).toMatch(/already there|0 moves/);
    await page.getByLabel('Shape of Robot').selectOption('L');
    await expect.poll(() => readout(page, 'The robot'), { timeout: 30_000 }).toMatch(/clearance|depth|touches/);
    await close(it);
  });
});
