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

/** Moves a slider by a little before every frame, and gives the times between the sums that were painted. */
async function timesOfSlider(page: Page, label: string, from: number, to: number, frames: number): Promise<number[]> {
  return await page.getByRole('slider', { name: label }).evaluate(
    async (node, { from, to, frames }) => {
      const element = node as HTMLInputElement, canvas = document.querySelector<HTMLCanvasElement>('canvas.plane')!, times: number[] = [];
      let last = performance.now(), painted = canvas.dataset.shown;
      for (let k = 0; k < frames; ++k) {
        element.value = String(from + ((to - from) * k) / frames);
        element.dispatchEvent(new Event('input', { bubbles: true }));
        do await new Promise((done) => requestAnimationFrame(done));
        while (canvas.dataset.shown === painted);
        painted = canvas.dataset.shown;
        const now = performance.now();
        times.push(now - last);
        last = now;
      }
      element.dispatchEvent(new Event('change', { bubbles: true }));
      return times;
    },
    { from, to, frames },
  );
}

describe('speed', () => {
  it('the page has less than 1.5 MB, compressed, and 2 MB on disk', () => {
    const size = gzipSync(readFileSync(kBuilt)).length, onDisk = statSync(kBuilt).size;
    console.log(`page: ${(onDisk / 1e6).toFixed(2)} MB on disk, ${(size / 1e6).toFixed(2)} MB compressed`);
    expect(size).toBeLessThan(1.5e6);
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
    await page.getByRole('button', { name: 'Repair P' }).click(); // it has vertices twice
    await page.getByLabel('Shape of Q').selectOption('disc');
    await settled(page);
    console.log(`neuron and disc: ${await readout(page, 'vertices')} vertices of the sum`);
    await timesOfSlider(page, 'Scale of P', 1, 1.05, 30);
    const { median } = report('neuron and disc, scaled', await timesOfSlider(page, 'Scale of P', 1, 1.05, 300));
    expect(median).toBeLessThan(kFrameMs * 1.1);
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
    await timesOfSlider(page, 'Scale of P', 0.5, 2, 2000);
    const before = await memory(), engineBefore = await held();
    for (let k = 0; k < 4; ++k) await timesOfSlider(page, 'Scale of P', 0.5, 2, 2000);
    const after = await memory(), engineAfter = await held();
    console.log(`memory: page ${(before / 1e6).toFixed(1)} MB, engine ${engineBefore} MB; after 8000 more drags ${(after / 1e6).toFixed(1)} MB, ${engineAfter} MB`);
    expect(after).toBeLessThan(before + 5e6);
    expect(engineAfter).toBe(engineBefore); // the module's memory never shrinks: any leak shows
    await close(it);
  }, 900_000);
});
