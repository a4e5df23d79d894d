// How fast the page is: medians and 99th percentiles are printed, and limits are checked.
import { existsSync, readFileSync, statSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, dropFiles, launch, open, readout, settled } from './viewer';

const kBuilt = new URL('../../viewer/dist/index.html', import.meta.url);
const kNeuron = new URL('../../../../shared/data/planar/neuron.poly', import.meta.url);
const kFrameMs = 1000 / 60;

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

function report(what: string, times: number[]): { median: number; p99: number } {
  const sorted = [...times].sort((a, b) => a - b), at = (share: number): number => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))]!;
  const result = { median: at(0.5), p99: at(0.99) };
  console.log(`${what}: median ${result.median.toFixed(1)} ms, p99 ${result.p99.toFixed(1)} ms, of ${times.length} frames`);
  return result;
}

/** Something that changes before every frame: the slider by a thousandth, to and fro, or the place of what is dragged by a pixel. */
type Moving = { slider: string; from: number; to: number } | 'drag';

/** The times between pictures of something new, `frames` of them, while there is input before every frame. */
async function timesOf(page: Page, moving: Moving, frames: number): Promise<number[]> {
  const slider = moving === 'drag' ? undefined : await page.getByRole('slider', { name: moving.slider }).elementHandle();
  return await page.locator('canvas.plane').evaluate(
    async (node, { slider, moving, frames }) => {
      const canvas = node as HTMLCanvasElement, input = slider as HTMLInputElement | null, box = canvas.getBoundingClientRect(), times: number[] = [];
      const point = (type: string, k: number): void =>
        void canvas.dispatchEvent(new PointerEvent(type, { pointerId: 7, clientX: box.x + box.width / 2 + k, clientY: box.y + box.height / 2, pointerType: 'mouse', bubbles: true, button: 0 }));
      const move = (k: number): void => {
        if (moving === 'drag') return point('pointermove', 10 + (k % 200));
        const steps = Math.round((moving.to - moving.from) * 1000), step = k % (2 * steps);
        input!.value = String(moving.from + Math.min(step, 2 * steps - step) / 1000);
        input!.dispatchEvent(new Event('input', { bubbles: true }));
      };
      let last = performance.now();
      const observer = new MutationObserver(() => {
        times.push(performance.now() - last);
        last = performance.now();
      });
      canvas.setPointerCapture = () => undefined; // these pointers are not the browser's
      if (moving === 'drag') point('pointerdown', 0);
      observer.observe(canvas, { attributeFilter: [moving === 'drag' ? 'data-frame' : 'data-shown'] });
      for (let k = 1; times.length < frames; ++k) {
        move(k);
        await new Promise((done) => requestAnimationFrame(done));
        await new Promise((done) => setTimeout(done)); // input comes between frames, not while one is made
      }
      observer.disconnect();
      if (moving === 'drag') point('pointerup', 10);
      else input!.dispatchEvent(new Event('change', { bubbles: true }));
      return times;
    },
    { slider, moving, frames },
  );
}

describe('speed', () => {
  it('the page has less than 1.5 MB, compressed, and 2 MB on disk', () => {
    const size = gzipSync(readFileSync(kBuilt)).length, onDisk = statSync(kBuilt).size;
    console.log(`page: ${(onDisk / 1e6).toFixed(2)} MB on disk, ${(size / 1e6).toFixed(2)} MB compressed`);
    expect(size).toBeLessThan(1.5e6);
    expect(onDisk).toBeLessThan(2e6);
  });
  it('paints from disk within a second', async () => {
    const times: number[] = [];
    for (let k = 0; k < 5; ++k) {
      const it = await open(browser);
      await settled(it.page);
      times.push(await it.page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0]!.startTime));
      await close(it);
    }
    expect(report('first paint', times).median).toBeLessThan(1000);
  });
  it.runIf(existsSync(kNeuron))('neuron and disc scale at 60 frames a second', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    await dropFiles(page, { 'neuron.poly': readFileSync(kNeuron, 'utf8') });
    await page.getByLabel('Shape of Q').selectOption('disc');
    await settled(page);
    console.log(`neuron and disc: ${await readout(page, 'vertices')} vertices of the sum`);
    const slider = { slider: 'Scale of P', from: 1, to: 1.05 };
    await timesOf(page, slider, 30);
    const scaled = report('neuron and disc, scaled', await timesOf(page, slider, 300));
    const dragged = report('neuron and disc, dragged', await timesOf(page, 'drag', 300));
    for (const { median } of [scaled, dragged]) expect(median).toBeLessThan(kFrameMs * 1.1);
    await close(it);
  });
  it.skipIf(existsSync(kNeuron))('neuron.poly is not there: its frames are not timed', () => undefined);
  it('memory is stable over ten thousand drags', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    const memory = (): Promise<number> => page.evaluate(() => {
      (globalThis as unknown as { gc: () => void }).gc();
      return (performance as unknown as { memory: { usedJSHeapSize: number } }).memory.usedJSHeapSize;
    });
    const held = async (): Promise<number> => {
      await page.keyboard.press('?');
      const text = page.getByText(/The engine.* holds \d+ MB/);
      const megabytes = Number(/holds (\d+) MB/.exec(await text.innerText())![1]);
      await page.keyboard.press('Escape');
      return megabytes;
    };
    const slider = { slider: 'Scale of P', from: 0.5, to: 2 };
    await timesOf(page, slider, 3000);
    const before = await memory(), engineBefore = await held();
    for (let k = 0; k < 4; ++k) await timesOf(page, slider, 1750);
    const after = await memory(), engineAfter = await held();
    console.log(`memory: page ${(before / 1e6).toFixed(1)} MB, engine ${engineBefore} MB; after 7000 more drags ${(after / 1e6).toFixed(1)} MB, ${engineAfter} MB`);
    expect(after).toBeLessThan(before + 5e6);
    expect(engineAfter).toBe(engineBefore); // the module's memory never shrinks: any leak shows
    await close(it);
  }, 900_000);
});
