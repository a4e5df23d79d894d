// The built page in Debian's browsers. Every page that is opened here is watched: it may ask for nothing but itself, and
// write no error.
import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { deflateRawSync } from 'node:zlib';
import { chromium, firefox, type Browser, type Page } from 'playwright-core';
import { expect } from 'vitest';

export const kPage = new URL('../../viewer/dist/index.html', import.meta.url).href;
const kDesk = { width: 1280, height: 800 };

export interface Opened {
  page: Page;
  /** addresses that were asked for, the page's own left out */
  requests: string[];
  errors: string[];
}

export async function launch(name: 'chromium' | 'firefox' = 'chromium'): Promise<Browser> {
  if (!existsSync(fileURLToPath(kPage))) throw new Error('web/viewer/dist/index.html is not there: npm run build');
  // Debian's Firefox speaks WebDriver BiDi, not the protocol of Playwright's own build.
  return name === 'firefox'
    ? await firefox.launch({ executablePath: '/usr/bin/firefox-esr', channel: 'moz-firefox' })
    : await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--enable-precise-memory-info', '--js-flags=--expose-gc'] });
}

export interface OpenOptions {
  hash?: string;
  width?: number;
  height?: number;
  dark?: boolean;
  touch?: boolean;
  reducedMotion?: boolean;
}

export async function open(browser: Browser, { hash = '', width = kDesk.width, height = kDesk.height, dark, touch, reducedMotion }: OpenOptions = {}): Promise<Opened> {
  const context = await browser.newContext({
    viewport: { width, height }, colorScheme: dark ? 'dark' : 'light', acceptDownloads: true,
    ...(touch ? { hasTouch: true } : {}), ...(reducedMotion ? { reducedMotion: 'reduce' as const } : {}),
  });
  const page = await context.newPage(), requests: string[] = [], errors: string[] = [];
  page.on('request', (request) => {
    const url = request.url();
    if (!url.startsWith(kPage) && !url.startsWith('blob:') && !url.startsWith('data:')) requests.push(url);
  });
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error') errors.push(message.text());
  });
  await page.goto(kPage + hash);
  return { page, requests, errors };
}

/** Ends with a page that was quiet: no request, no error. */
export async function close({ page, requests, errors }: Opened): Promise<void> {
  await page.context().close();
  expect(requests).toEqual([]);
  expect(errors).toEqual([]);
}

/** The value beside a name of a list of readouts. */
export async function readout(page: Page, name: string): Promise<string> {
  return await page.locator(`dt:text-is("${name}") + dd`).innerText();
}

/** Waits until a readout says something else, and gives it. */
export async function readoutOtherThan(page: Page, name: string, before: string): Promise<string> {
  await expect.poll(() => readout(page, name), { timeout: 20_000 }).not.toBe(before);
  return await readout(page, name);
}

/** Waits for a sum that is computed and settled: its area is known. */
export async function settled(page: Page): Promise<void> {
  await expect.poll(() => readout(page, 'area'), { timeout: 60_000 }).toMatch(/\d/);
}

/** Drags from one place of the picture to another, in pixels from its middle. */
export async function drag(page: Page, from: [number, number], to: [number, number], steps = 8): Promise<void> {
  const box = (await page.locator('canvas.plane').boundingBox())!, x = box.x + box.width / 2, y = box.y + box.height / 2;
  await page.mouse.move(x + from[0], y + from[1]);
  await page.mouse.down();
  await page.mouse.move(x + to[0], y + to[1], { steps });
  await page.mouse.up();
}

/** A hash that opens a state; made by the page's own code for permalinks is what `shareLink` gives. */
export async function shareLink(page: Page): Promise<string> {
  await page.evaluate(() => history.replaceState(null, '', location.pathname)); // what stands there may be older
  await page.getByRole('button', { name: 'Copy a link to what is shown' }).click();
  await expect.poll(() => page.evaluate(() => location.hash)).toMatch(/^#\/\w+\/./);
  return await page.evaluate(() => location.hash);
}

/** The hash that opens what a command hands over: its page, inputs and options. */
export function commandHash(page: string, verb: string, inputs: Record<string, string>, options: Record<string, unknown> = {}): string {
  const data = { format: 1, page, inputs: Object.entries(inputs).map(([name, text]) => ({ name, text })), parameters: { verb, ...options } };
  return `#data=${deflateRawSync(JSON.stringify(data)).toString('base64url')}`;
}

/** How many pixels of the plane's picture have the colour of this name. */
export async function pixelsOf(page: Page, name: string): Promise<number> {
  return await page.evaluate((colour) => {
    const canvas = document.querySelector<HTMLCanvasElement>('canvas.plane')!, probe = document.createElement('canvas').getContext('2d')!;
    probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue(colour);
    probe.fillRect(0, 0, 1, 1);
    const [r, g, b] = probe.getImageData(0, 0, 1, 1).data, { data } = canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let k = 0; k < data.length; k += 4) count += Number(data[k] === r && data[k + 1] === g && data[k + 2] === b);
    return count;
  }, name);
}

/** Types into a field, and leaves it by Enter. */
export async function set(page: Page, label: string, value: string): Promise<void> {
  await page.getByLabel(label, { exact: true }).fill(value);
  await page.keyboard.press('Enter');
}

/** Chooses one of a group of which one is chosen. */
export async function choose(page: Page, group: string, text: string): Promise<void> {
  await page.getByRole('radiogroup', { name: group }).getByText(text, { exact: true }).click();
}

export async function example(page: Page, name: string): Promise<void> {
  await page.getByRole('button', { name: 'Examples' }).click();
  await page.getByRole('button', { name, exact: true }).click();
}

/** What an entry of the download menu saves: its name and its bytes. */
export async function download(page: Page, label: string): Promise<{ name: string; bytes: Buffer }> {
  await page.getByRole('button', { name: 'Download' }).click();
  const [file] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: label, exact: true }).click()]);
  return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
}

/** Drops files on the page. */
export async function dropFiles(page: Page, files: Record<string, string>): Promise<void> {
  const transfer = await page.evaluateHandle((list) => {
    const data = new DataTransfer();
    for (const [name, text] of Object.entries(list)) data.items.add(new File([text], name));
    return data;
  }, files);
  await page.dispatchEvent('main', 'dragover', { dataTransfer: transfer });
  await page.dispatchEvent('main', 'drop', { dataTransfer: transfer });
}

/** A polygon of many long spikes, as text. */
export function spikes(vertices: number, shift: number): string {
  const at = (k: number): string => {
    const angle = (2 * Math.PI * k) / vertices, radius = 1 + ((k * 7919 + shift) % 101) / 50;
    return `${(radius * Math.cos(angle)).toFixed(6)} ${(radius * Math.sin(angle)).toFixed(6)}`;
  };
  return `POLYGON ((${[...Array(vertices).keys(), 0].map(at).join(', ')}))`;
}
