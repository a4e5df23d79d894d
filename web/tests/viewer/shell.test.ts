// What is the same on all pages.
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { close, download, dropFiles, launch, open, readout, settled, shareLink } from './viewer';

let browser: Browser;
beforeAll(async () => void (browser = await launch()));
afterAll(() => browser.close());

const kSquare = 'POLYGON ((0 0, 3 0, 3 3, 0 3, 0 0))';

describe('the shell', () => {
  it('undoes and redoes, by buttons and keys', async () => {
    const it = await open(browser), { page } = it, shape = () => page.getByLabel('Shape of P').inputValue();
    await settled(page);
    await page.getByLabel('Shape of P').selectOption('disc');
    await page.getByLabel('Shape of P').selectOption('comb');
    await page.getByRole('button', { name: 'Undo' }).click();
    expect(await shape()).toBe('disc');
    await page.locator('canvas.plane').focus();
    await page.keyboard.press('Control+z');
    expect(await shape()).toBe('gear');
    await page.keyboard.press('Control+Shift+z');
    await page.keyboard.press('Control+y');
    expect(await shape()).toBe('comb');
    await close(it);
  });
  it('keeps everything in the address', async () => {
    const first = await open(browser);
    await settled(first.page);
    await dropFiles(first.page, { 'mine.wkt': kSquare });
    await expect.poll(() => readout(first.page, 'area')).not.toBe('…');
    await first.page.getByLabel('Exactly').fill('5/4');
    await first.page.keyboard.press('Enter');
    await first.page.getByLabel('convolution').click();
    await settled(first.page);
    const area = await readout(first.page, 'area'), hash = await shareLink(first.page);
    await close(first);
    const second = await open(browser, { hash });
    await settled(second.page);
    expect(await readout(second.page, 'area')).toBe(area);
    expect(await second.page.getByLabel('Exactly').inputValue()).toBe('5/4');
    expect(await second.page.getByLabel('convolution').isChecked()).toBe(true);
    await close(second);
  });
  it('says what is wrong with an address', async () => {
    const it = await open(browser, { hash: '#/sum/AAAA' });
    await expect.poll(() => it.page.getByRole('alert').innerText()).toContain('damaged');
    await settled(it.page);
    await it.page.getByLabel('Shape of P').selectOption('comb');
    const good = await shareLink(it.page);
    await close(it);
    for (const after of ['%%%%', '==', '?x=1', '#/sum']) {
      const damaged = await open(browser, { hash: good + after });
      await expect.poll(() => damaged.page.getByRole('alert').innerText()).toContain('damaged');
      await close(damaged);
    }
  });
  it('opens files that are dropped', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    await dropFiles(page, { 'a.wkt': kSquare, 'b.geojson': '{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,1],[0,0]]]}' });
    await expect.poll(() => readout(page, 'area')).toBe('16');
    await close(it);
  });
  it('marks what is wrong with a file in the picture', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    await dropFiles(page, { 'bow.wkt': 'POLYGON ((0 0, 4 4, 4 0, 0 3, 0 0))' });
    await expect.poll(() => page.getByRole('alert').innerText()).toMatch(/^self crossing: .*ring crosses itself/);
    const error = await page.evaluate(() => getComputedStyle(document.documentElement).getPropertyValue('--error'));
    const [r, g, b] = [1, 3, 5].map((k) => parseInt(error.slice(k, k + 2), 16));
    const marked = (): Promise<number> =>
      page.locator('canvas.plane').evaluate((canvas: HTMLCanvasElement, rgb) => {
        const { data } = canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height);
        let count = 0;
        for (let k = 0; k < data.length; k += 4) if (rgb.every((c, i) => Math.abs(data[k + i]! - c!) < 6)) ++count;
        return count;
      }, [r, g, b]);
    await expect.poll(marked).toBeGreaterThan(60);
    await page.keyboard.press('Control+z');
    await settled(page);
    await dropFiles(page, { 'broken.poly': '1\n3 out\n0 0\n1 x\n' });
    await expect.poll(() => page.getByRole('alert').innerText()).toMatch(/broken\.poly:\d/);
    await page.getByRole('button', { name: 'Close the message' }).click();
    expect(await page.getByRole('alert').count()).toBe(0);
    await dropFiles(page, { 'a.png': 'x' });
    await expect.poll(() => page.getByRole('alert').innerText()).toContain('"a.png" holds no region');
    await close(it);
  });
  it('saves files', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    expect((await download(page, 'Picture (SVG)')).bytes.toString()).toContain('<svg');
    expect((await download(page, 'Sum, rounded (WKT)')).bytes.toString()).toMatch(/POLYGON/);
    const json = JSON.parse((await download(page, 'Sum, exact (JSON)')).bytes.toString()) as object;
    expect(Object.keys(json).length).toBeGreaterThan(0);
    await close(it);
  });
  it('has keys for pages, examples, theme and help', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    await page.keyboard.press('e');
    expect(await page.locator('.menu li').count()).toBeGreaterThan(3);
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('Enter');
    await settled(page);
    await page.keyboard.press('t');
    expect(await page.evaluate(() => document.documentElement.dataset.theme)).toBe('dark');
    await page.keyboard.press('?');
    await expect.poll(() => page.getByRole('dialog').isVisible()).toBe(true);
    await page.keyboard.press('Escape');
    await expect.poll(() => page.getByRole('dialog').count()).toBe(0);
    const tabs = await page.locator('.tabs a').count();
    for (let k = 1; k <= tabs; ++k) {
      await page.keyboard.press(String(k));
      expect(await page.locator('.tabs a').nth(k - 1).getAttribute('aria-current')).toBe('page');
    }
    await close(it);
  });
  it('opens files by its button, and the list of keys', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.getByRole('button', { name: 'Open files' }).click()]);
    await chooser.setFiles(['a.wkt', 'b.wkt'].map((name) => ({ name, mimeType: 'text/plain', buffer: Buffer.from(kSquare) })));
    await expect.poll(() => readout(page, 'area')).toBe('36');
    await page.getByRole('button', { name: 'Keys' }).click();
    await expect.poll(() => page.getByRole('dialog').isVisible()).toBe(true);
    await close(it);
  });
  it('has a name for every control', async () => {
    const it = await open(browser), { page } = it;
    for (const tab of await page.locator('.tabs a').all()) {
      await tab.click();
      const nameless = await page.evaluate(() =>
        [...document.querySelectorAll<HTMLElement>('button, select, input, canvas.plane, .space, svg[tabindex]')]
          .filter((e) => !(e.ariaLabel ?? e.textContent?.trim()) && !((e as HTMLInputElement).labels?.length))
          .map((e) => e.outerHTML),
      );
      expect(nameless).toEqual([]);
    }
    await close(it);
  });
  it('pans and zooms by wheel, keys and two fingers', async () => {
    const it = await open(browser, { touch: true }), { page } = it, canvas = page.locator('canvas.plane');
    await settled(page);
    const shot = () => canvas.screenshot(), home = await shot();
    await canvas.hover();
    await page.mouse.wheel(0, -300);
    await expect.poll(async () => home.equals(await shot())).toBe(false);
    await canvas.focus();
    await page.keyboard.press('0');
    await page.mouse.move(1, 1);
    await expect.poll(async () => home.length - (await shot()).length).toBeLessThan(2000);
    const before = await shot();
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('+');
    await expect.poll(async () => before.equals(await shot())).toBe(false);
    const pinched = await canvas.evaluate((element) => {
      const send = (type: string, pointerId: number, clientX: number): void =>
        void element.dispatchEvent(new PointerEvent(type, { pointerId, clientX, clientY: 300, pointerType: 'touch', bubbles: true, button: 0 }));
      element.setPointerCapture = () => undefined; // these pointers are not the browser's
      send('pointerdown', 11, 300);
      send('pointerdown', 12, 400);
      send('pointermove', 12, 600);
      send('pointerup', 12, 600);
      send('pointerup', 11, 300);
      return true;
    });
    expect(pinched).toBe(true);
    await close(it);
  });
  it('takes a document from outside', async () => {
    const it = await open(browser), { page } = it;
    await settled(page);
    await page.evaluate((text) => dispatchEvent(new CustomEvent('dymsum-open', { detail: { page: 'sum', inputs: [{ name: 'a.wkt', text }, { name: 'b.wkt', text }] } })), kSquare);
    await expect.poll(() => readout(page, 'area')).toBe('36');
    await close(it);
  });
  it('takes a notice back when what is computed is right again', async () => {
    const it = await open(browser), { page } = it, alerts = page.getByRole('alert');
    await settled(page);
    await page.getByRole('radiogroup', { name: 'What is computed' }).getByText('Fit in P').click();
    await settled(page);
    await page.getByLabel('Exactly').fill('1/3');
    await page.keyboard.press('Enter');
    await expect.poll(() => alerts.count()).toBe(1);
    await page.waitForTimeout(600); // the area has been asked for, and is refused, too
    await page.getByLabel('Exactly').fill('3/2');
    await page.keyboard.press('Enter');
    await settled(page);
    await page.waitForTimeout(600);
    expect(await alerts.count()).toBe(0);
    await close(it);
  });
});

/** A page with a server behind it, as `dymsum view` is one: it tells of files that were saved. */
async function live(inputs: Record<string, string>, shown = 'sum') {
  const html = readFileSync(new URL('../../viewer/dist/index.html', import.meta.url), 'utf8');
  let revision = 1, tell: () => void = () => undefined;
  const data = (): string => JSON.stringify({ format: 1, page: shown, live: true, revision, inputs: Object.entries(inputs).map(([name, text]) => ({ name, text })), parameters: { verb: 'view' } });
  const server = createServer((request, response) => {
    if (request.url!.startsWith('/events')) {
      response.writeHead(200, { 'content-type': 'text/event-stream' }).write(': there\n\n');
      tell = () => void response.write(`id: ${revision}\nevent: change\ndata: ${revision}\n\n`);
    } else if (request.url === '/data.json') response.end(data());
    else response.setHeader('content-type', 'text/html').end(html.replace(/(<script[^>]*id="dymsum-data"[^>]*>)[^<]*/, (_, tag: string) => tag + data()));
  });
  await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
  const page = await (await browser.newContext({ viewport: { width: 1280, height: 800 } })).newPage(), address = `http://127.0.0.1:${(server.address() as AddressInfo).port}/`;
  await page.goto(address);
  return {
    page, address,
    save: (name: string, text: string): void => {
      inputs[name] = text;
      ++revision;
      tell();
    },
    stop: (): void => {
      server.close();
      server.closeAllConnections();
    },
    end: async (): Promise<void> => {
      await page.context().close();
      server.closeAllConnections();
      server.close();
    },
  };
}

describe('a live page', () => {
  const square = (side: number): string => kSquare.replaceAll('3', String(side));
  it('takes the notice of a file back once it is mended', async () => {
    const { page, save, end } = await live({ 'a.wkt': square(3), 'b.wkt': square(1) });
    await expect.poll(() => readout(page, 'area').catch(() => '')).toBe('16');
    save('a.wkt', 'POLYGON ((0 0, 4 4, 4 0, 0 3, 0 0))');
    await expect.poll(() => page.getByRole('alert').innerText().catch(() => '')).toMatch(/^self crossing/);
    save('b.wkt', square(2)); // still wrong
    await page.waitForTimeout(500);
    expect(await page.getByRole('alert').count()).toBe(1);
    save('a.wkt', square(4));
    await expect.poll(() => readout(page, 'area')).toBe('36');
    expect(await page.getByRole('alert').count()).toBe(0);
    await end();
  });
  it('goes back and forth among files as they are now', async () => {
    const { page, save, end } = await live({ 'a.wkt': square(3), 'b.wkt': square(1) });
    await expect.poll(() => readout(page, 'area').catch(() => '')).toBe('16');
    await page.getByLabel('Shape of Q').selectOption('square');
    await page.getByLabel('Exactly').fill('2');
    await page.keyboard.press('Enter');
    await expect.poll(() => readout(page, 'area')).toBe('49');
    await page.getByRole('button', { name: 'Undo' }).click();
    await page.getByRole('button', { name: 'Undo' }).click();
    save('a.wkt', square(9));
    await expect.poll(() => readout(page, 'area')).toBe('100');
    await page.getByRole('button', { name: 'Redo' }).click();
    await expect.poll(() => page.getByLabel('Shape of Q').inputValue()).toBe('square');
    await expect.poll(() => readout(page, 'area')).toBe('100');
    await page.getByRole('button', { name: 'Redo' }).click();
    await expect.poll(() => readout(page, 'area')).toBe('361');
    await end();
  });
  it('of no page shows the list of examples', async () => {
    const { page, end } = await live({}, 'home');
    await expect.poll(() => page.locator('.menu li').count()).toBeGreaterThan(3);
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('Enter');
    await expect.poll(() => page.getByLabel('Shape of P').inputValue()).toBe('grate');
    expect(await page.locator('.menu li').count()).toBe(0);
    await end();
  });
  it('shows its files where the link is damaged', async () => {
    const { page, address, end } = await live({ 'a.wkt': square(3), 'b.wkt': square(1) });
    await page.goto('about:blank');
    await page.goto(`${address}#/sum/AAAA`);
    await expect.poll(() => page.getByRole('alert').innerText().catch(() => '')).toContain('damaged');
    await expect.poll(() => readout(page, 'area').catch(() => '')).toBe('16');
    await end();
  });
  it('says when its server is gone', async () => {
    const { page, stop, end } = await live({ 'a.wkt': square(3), 'b.wkt': square(1) });
    await expect.poll(() => readout(page, 'area').catch(() => '')).toBe('16');
    expect(await page.getByRole('alert').count()).toBe(0);
    stop();
    await expect.poll(() => page.getByRole('alert').innerText().catch(() => '')).toContain('The server of this page does not answer');
    expect(await readout(page, 'area')).toBe('16');
    await end();
  });
});
