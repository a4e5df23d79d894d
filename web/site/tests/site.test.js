// The site that ./run site built, opened from its folder in Debian's Chromium.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

const kSite = new URL('../../../build/site/html/', import.meta.url);
const kPages = readdirSync(fileURLToPath(kSite), { recursive: true }).filter((name) => name.endsWith('.html') && !/viewer|404/.test(name));
const kSizes = { desktop: { width: 1280, height: 900 }, phone: { width: 360, height: 740 } };

const kColoured = 5; // of 1000 pixels of a picture: more than the marks of a position without its shapes

let browser;
before(async () => (browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox'] })));
after(() => browser.close());

/** A page of that size, what it asked for beyond the folder, and what went wrong in it. */
async function opened(size, colorScheme = 'light') {
  const page = await (await browser.newContext({ viewport: kSizes[size], colorScheme })).newPage();
  const wrong = [];
  page.on('request', (request) => /^(file|data|blob):/.test(request.url()) || wrong.push(request.url()));
  page.on('pageerror', (error) => wrong.push(error.message));
  // What is cut off by going to the next page, as its icon, has not failed.
  page.on('requestfailed', (request) => request.failure()?.errorText === 'net::ERR_ABORTED' || wrong.push(request.url()));
  return { page, wrong, go: (name) => page.goto(new URL(name, kSite).href) };
}

test('every page opens from disk without network or errors, and fits the width', async () => {
  assert.ok(kPages.length > 50, `${kPages.length} pages`);
  for (const size of Object.keys(kSizes)) {
    const { page, wrong, go } = await opened(size);
    for (const name of kPages) {
      await go(name);
      const beyond = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(beyond <= 0, `${name} is ${beyond} pixels wider than a ${size}`);
      const broken = await page.evaluate(() => [...document.images].filter((i) => i.complete && !i.naturalWidth).map((i) => i.src));
      assert.deepEqual(broken, [], name);
    }
    assert.deepEqual(wrong, []);
  }
});

test('the search finds pages from disk', async () => {
  const { page, wrong, go } = await opened('desktop');
  await go('docs/guide/sums.html');
  await page.click('.md-search__input');
  await page.keyboard.type('penetration depth');
  const first = page.locator('.md-search-result__link').first();
  await first.waitFor();
  assert.match(await first.getAttribute('href'), /depth/);
  await first.click();
  await page.waitForURL(/depth/);
  assert.deepEqual(wrong, []);
});

test('the search finds the licence, also as a license, and what there is for Windows', async () => {
  const { page, go } = await opened('desktop');
  for (const [word, where] of [['license', /packaging|index/], ['licence', /packaging|index/], ['windows', /packaging/]]) {
    await go('docs/guide/sums.html');
    await page.click('.md-search__input');
    await page.keyboard.type(word);
    const found = page.locator('.md-search-result__item > .md-search-result__link'); // of each page its first
    await found.first().waitFor();
    const links = await found.evaluateAll((all) => all.slice(0, 8).map((link) => link.getAttribute('href')));
    assert.ok(links.some((link) => where.test(link)), `${word}: ${links}`);
  }
});

/** What the pictures of a frame show: of each, how many of a thousand pixels are coloured, which paper, grid and letters are not. */
async function coloured(frame, counter) {
  const parts = [];
  for (const picture of await frame.locator('.stage').locator('canvas.plane, .space').all()) {
    const png = (await picture.screenshot()).toString('base64'); // of the screen: the canvas of a picture of space keeps nothing
    parts.push(await counter.evaluate(async (data) => {
      const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob()), { width, height } = image;
      const to = new OffscreenCanvas(width, height).getContext('2d');
      to.drawImage(image, 0, 0);
      const pixels = to.getImageData(0, 0, width, height).data;
      let count = 0;
      for (let k = 0; k < pixels.length; k += 4) if (Math.max(...pixels.subarray(k, k + 3)) - Math.min(...pixels.subarray(k, k + 3)) > 24) ++count;
      return (1000 * count) / (width * height);
    }, png));
  }
  return parts;
}

test('every live figure of the documents is drawn where it is opened from the folder', async (t) => {
  const counter = await browser.newPage();
  let figures = 0;
  for (const size of Object.keys(kSizes)) {
    const { page, wrong, go } = await opened(size);
    for (const name of kPages) {
      if (!readFileSync(new URL(name, kSite), 'utf8').includes('<details class="live">')) continue;
      await go(name);
      for (const figure of await page.locator('details.live').all()) {
        const title = `${name}, ${size}: ${await figure.locator('summary').innerText()}`;
        await figure.locator('summary').click();
        const frame = await (await figure.locator('iframe').elementHandle()).contentFrame();
        let parts = [];
        const isBlank = () => parts.length === 0 || Math.min(...parts) < kColoured;
        for (const end = Date.now() + 60_000; isBlank() && Date.now() < end; ) {
          parts = await coloured(frame, counter).catch(() => []); // while the frame is opened
          if (isBlank()) await page.waitForTimeout(200);
        }
        t.diagnostic(`${title}: ${parts.map((part) => part.toFixed(0)).join(', ')} of 1000 pixels`);
        if (process.env.DYMSUM_FIGURES) await figure.locator('iframe').screenshot({ path: `${process.env.DYMSUM_FIGURES}/${size}-${figures}.png` });
        assert.ok(!isBlank(), `${title} is blank`);
        assert.equal(await frame.getByRole('alert').count(), 0, title);
        await figure.locator('summary').click();
        ++figures;
      }
    }
    assert.deepEqual(wrong, []);
  }
  assert.ok(figures >= 16, `${figures} figures`);
});

test('it is dark where the reader is in the dark', async () => {
  const { page, go } = await opened('desktop', 'dark');
  await go('index.html');
  const [red] = (await page.evaluate(() => getComputedStyle(document.body).backgroundColor)).match(/\d+/g).map(Number);
  assert.ok(red < 64, `background ${red}`);
});
