// The site that ./run site built, opened from its folder in Debian's Chromium.
import assert from 'node:assert/strict';
import { readdirSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

const kSite = new URL('../../../build/site/html/', import.meta.url);
const kPages = readdirSync(fileURLToPath(kSite), { recursive: true }).filter((name) => name.endsWith('.html') && !/viewer|404/.test(name));
const kSizes = { desktop: { width: 1280, height: 900 }, phone: { width: 360, height: 740 } };

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

test('it is dark where the reader is in the dark', async () => {
  const { page, go } = await opened('desktop', 'dark');
  await go('index.html');
  const [red] = (await page.evaluate(() => getComputedStyle(document.body).backgroundColor)).match(/\d+/g).map(Number);
  assert.ok(red < 64, `background ${red}`);
});
