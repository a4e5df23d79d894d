// How fast the pictures of space are, drawn by a processor alone: medians and 99th percentiles are printed, limits checked.
import { existsSync, readFileSync } from 'node:fs';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, dropFiles, launch, open, readout } from './viewer';

const kData = new URL('../../../../shared/data/planar/', import.meta.url);
const kDog = new URL('dog.poly', kData), kBird = new URL('bird.poly', kData);

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

function report(what: string, times: number[]): { median: number; p99: number } {
  const sorted = [...times].sort((a, b) => a - b), at = (share: number): number => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))]!;
  const result = { median: at(0.5), p99: at(0.99) };
  console.log(`${what}: median ${result.median.toFixed(1)} ms, p99 ${result.p99.toFixed(1)} ms, of ${times.length} frames`);
  return result;
}

/** Times between the answers that a readout of the panel shows, while a slider or the pointer is moved as fast as they come. */
async function timesOf(page: Page, shown: string, frames: number, move: 'drag' | { label: string; from: number; by: number }): Promise<number[]> {
  return await page.evaluate(
    async ({ shown, frames, move }) => {
      const space = document.querySelectorAll<HTMLElement>('.space'), picture = space[space.length - 1]!, times: number[] = [];
      const canvas = document.querySelector<HTMLCanvasElement>('canvas.plane');
      const [cx, cy, zoom] = (canvas?.dataset.camera ?? '0 0 1').split(' ').map(Number) as [number, number, number];
      const box = canvas?.getBoundingClientRect();
      const field = (label: string): HTMLInputElement => [...document.querySelectorAll('label')].find((l) => l.textContent.startsWith(label))!.querySelector('input')!;
      const start = box && [box.x + box.width / 2 + (Number(field('x').value) - cx) * zoom, box.y + box.height / 2 - (Number(field('y').value) - cy) * zoom];
      // Beyond what still counts as a click from the first move on.
      const pointer = (type: string, k: number): boolean | undefined => canvas?.dispatchEvent(new PointerEvent(type, {
        bubbles: true, pointerId: 1, pointerType: 'mouse', isPrimary: true, buttons: type === 'pointerup' ? 0 : 1, clientX: start![0]! + (k > 0 ? 8 : 0) + k / 4, clientY: start![1]! + (k % 9),
      }));
      if (move === 'drag') {
        canvas!.setPointerCapture = () => undefined; // of pointers that are there
        pointer('pointerdown', 0);
      }
      const slider = move === 'drag' ? undefined : document.querySelector<HTMLInputElement>(`[id="${[...document.querySelectorAll('label')].find((l) => l.textContent === move.label)!.htmlFor}"]`)!;
      let last = performance.now(), painted = picture.dataset[shown];
      for (let k = 1; k <= frames; ++k) {
        if (move === 'drag') pointer('pointermove', 10 + k);
        else {
          slider!.value = String(move.from + move.by * k);
          slider!.dispatchEvent(new Event('input', { bubbles: true }));
        }
        do {
          await new Promise((done) => requestAnimationFrame(done));
          if (performance.now() - last > 10_000) throw new Error(`frame ${k} was not drawn within ten seconds`);
        } while (picture.dataset[shown] === painted);
        painted = picture.dataset[shown];
        const now = performance.now();
        times.push(now - last);
        last = now;
      }
      if (move === 'drag') pointer('pointerup', 10 + frames);
      else slider!.dispatchEvent(new Event('change', { bubbles: true }));
      return times;
    },
    { shown, frames, move },
  );
}

describe('speed of pictures of space', () => {
  it.runIf(existsSync(kDog))('the dog is dragged in the obstacle of the bird at 30 frames a second', async () => {
    const it = await open(browser, { hash: '#/obstacle' }), { page } = it;
    await expect.poll(() => readout(page, 'The robot'), { timeout: 60_000 }).toMatch(/clearance/);
    const start = performance.now();
    await dropFiles(page, { 'dog.poly': readFileSync(kDog, 'utf8'), 'bird.poly': readFileSync(kBird, 'utf8') });
    await expect.poll(() => readout(page, 'Patches, shells'), { timeout: 100_000 }).toMatch(/^\d{5}/);
    await expect.poll(() => readout(page, 'The robot'), { timeout: 60_000 }).toMatch(/clearance/);
    console.log(`dog and bird: ${await readout(page, 'Patches, shells')} patches and shells, shown after ${((performance.now() - start) / 1000).toFixed(1)} s`);
    await timesOf(page, 'overlays', 20, 'drag');
    const { median } = report('dog dragged in the obstacle of the bird', await timesOf(page, 'overlays', 200, 'drag'));
    report('dog turned in the obstacle of the bird', await timesOf(page, 'overlays', 100, { label: 'θ', from: 0, by: 0.01 }));
    expect(median).toBeLessThan(1000 / 30);
    await close(it);
  });
  it.skipIf(existsSync(kDog))('dog.poly is not there: its frames are not timed', () => undefined);

  it('a torus of 1,024 triangles and a ball that turns: 10 frames a second', async () => {
    const it = await open(browser, { hash: '#/solids' }), { page } = it;
    await page.getByRole('button', { name: 'Examples' }).click();
    await page.getByRole('button', { name: 'Fine torus and small ball' }).click();
    await expect.poll(() => readout(page, 'Volume'), { timeout: 60_000 }).toMatch(/\d/);
    console.log(`torus and ball: ${await readout(page, 'Vertices, faces')} vertices and faces`);
    await timesOf(page, 'frames', 5, { label: 'Turn', from: 0, by: 0.5 });
    const { median } = report('torus 1,024 and a ball, turned by half a degree', await timesOf(page, 'frames', 60, { label: 'Turn', from: 3, by: 0.5 }));
    console.log(`the engine's share of the last frame: ${await readout(page, 'Updated in')}`);
    expect(median).toBeLessThan(100);
    await close(it);
  });

  it('memory is stable over many frames', async () => {
    const it = await open(browser, { hash: '#/solids' }), { page } = it;
    await expect.poll(() => readout(page, 'Volume'), { timeout: 60_000 }).toMatch(/\d/);
    const memory = (): Promise<number> => page.evaluate(() => {
      (globalThis as unknown as { gc: () => void }).gc();
      return (performance as unknown as { memory: { usedJSHeapSize: number } }).memory.usedJSHeapSize;
    });
    const turn = (frames: number) => timesOf(page, 'frames', frames, { label: 'Turn', from: -180, by: 360 / frames });
    await turn(100);
    const before = await memory(), geometries = await page.locator('.space').last().getAttribute('data-geometries');
    for (let k = 0; k < 3; ++k) await turn(100);
    const after = await memory();
    console.log(`memory: ${(before / 1e6).toFixed(1)} MB, after 300 more frames ${(after / 1e6).toFixed(1)} MB`);
    expect(after).toBeLessThan(before + 5e6);
    expect(await page.locator('.space').last().getAttribute('data-geometries')).toBe(geometries);
    await close(it);
  });
});
