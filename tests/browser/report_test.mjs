// The page of `trivela report --html` in Chromium, opened as a file: filter, replay, reload, a narrow window, the keyboard
// alone, without JavaScript, on paper; no request, no complaint, no finding of axe-core.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {createRequire} from 'node:module';
import {copyFileSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';
import test from 'node:test';
import {findings} from './axe.mjs';
import {Folder, Trivela} from './processes.mjs';

const {chromium} = createRequire(join(process.env.BROWSER_FOLDER, 'package.json'))('playwright-core');
const wide = {width: 1280, height: 900};
const phone = {width: 390, height: 844};
const folder = new Folder();
const hostile = `<img src=x onerror=alert(1)>"'&.db`;
let browser, url;

async function run(...args) { return ends(0, ...args); }

async function ends(wanted, ...args) {
  const program = new Trivela(folder, ...args);
  const code = await program.end();
  assert.equal(code, wanted, `trivela ${args.join(' ')} ended with ${code}: ${program.errors}`);
}

// A page with the requests and complaints that came of it.
async function open(address, options = {}) {
  const context = await browser.newContext({viewport: wide, ...options});
  const page = await context.newPage();
  page.complaints = [];
  page.requests = [];
  page.on('pageerror', (error) => page.complaints.push(error.message));
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && page.complaints.push(message.text()));
  page.on('dialog', (dialog) => { page.complaints.push(`dialog ${dialog.message()}`); dialog.dismiss(); });
  page.on('request', (request) => page.requests.push(request.url()));
  await page.goto(address);
  if (options.javaScriptEnabled !== false) await page.waitForSelector('html[data-ready]', {state: 'attached'});
  return page;
}

// Nothing complained, and the file asked for itself alone.
async function close(page) {
  assert.deepEqual(page.complaints, []);
  const asked = page.requests.filter((request) => !request.startsWith('file:') && !request.startsWith('data:'));
  assert.deepEqual(asked, []);
  assert.ok(page.requests.filter((request) => request.startsWith('file:')).every((request) => request.split('#')[0].endsWith('.html')));
  await page.context().close();
}

const screenshot = (name) => join(process.env.BROWSER_FOLDER, 'screenshots', `report-${name}.png`);
const visible = (page) => page.$$eval('#kicks tbody tr', (trs) => trs.filter((tr) => !tr.hidden).length);
const instant = (page) => page.$eval('.replay', (replay) => Number(replay.dataset.t_ms));

test.before(async () => {
  browser = await chromium.launch({executablePath: process.env.CHROMIUM, args: ['--no-sandbox']});
  await run('match', '--half', 'stopped', '--half', 'moving', '--minutes', '0.5', '--seed', '1', '--out', 'match.db');
  await run('report', 'match.db', '--html', 'report.html');
  url = pathToFileURL(folder.file('report.html')).href;
});

test.after(async () => {
  await browser?.close();
  folder.remove();
});

test('the list is filtered by policy, outcome and distance, and shows all again', async () => {
  const page = await open(url);
  const all = await visible(page);
  assert.ok(all > 10, `${all} kicks`);
  await page.selectOption('[data-filter="policy"]', 'moving');
  const moving = await visible(page);
  assert.ok(moving > 0 && moving < all);
  assert.equal(await page.textContent('#shown'), `${moving} of ${all} kicks`);
  assert.ok((await page.$$eval('#kicks tbody tr:not([hidden])', (trs) => trs.map((tr) => tr.dataset.policy)))
    .every((policy) => policy === 'moving'));
  await page.fill('[data-filter="near"]', '4');
  assert.ok((await page.$$eval('#kicks tbody tr:not([hidden])', (trs) => trs.map((tr) => Number(tr.dataset.distance))))
    .every((distance_m) => distance_m >= 4));
  await page.click('button[type="reset"]');
  await page.waitForFunction((n) => document.querySelector('#shown').textContent.startsWith(`${n} of`), all);
  assert.equal(await visible(page), all);
  await close(page);
});

test('a kick is replayed, stepped, stopped and closed', async () => {
  const page = await open(url);
  await page.click('#k3 button');
  await page.waitForSelector('#replay .replay-above');
  assert.match(await page.textContent('#replay-words'), /^Kick \d+:\d+/);
  assert.match(await page.textContent('#replay'), /simulated/);
  for (const mark of ['.robot-trail', '.ball-trail', '.s1', '.s2', '.robot', '.ball'])
    assert.ok(await page.$(`#replay ${mark}`), mark);
  await page.keyboard.press('ArrowRight');
  assert.equal(await instant(page), 40);
  await page.selectOption('#replay select', '1');
  await page.click('.replay-play');
  await page.waitForFunction(() => document.querySelector('.replay-play').textContent === 'Play' &&
    Number(document.querySelector('.replay').dataset.t_ms) > 300);
  await page.screenshot({path: screenshot('replay'), caret: 'initial'});
  await page.click('#mouth [data-kick]', {force: true});
  assert.ok(await page.$('#replay .replay-above'), 'a mark in a figure opens its replay');
  await page.keyboard.press('Escape');
  assert.ok(await page.isHidden('#replay'));
  await close(page);
});

test('a reload keeps filter and replay', async () => {
  const page = await open(url);
  await page.selectOption('[data-filter="policy"]', 'stopped');
  const shown = await visible(page);
  const kick = await page.$eval('#kicks tbody tr:not([hidden])', (tr) => tr.id);
  await page.click(`#${kick} button`);
  const words = await page.textContent('#replay-words');
  await page.reload();
  await page.waitForSelector('html[data-ready]', {state: 'attached'});
  assert.equal(await page.inputValue('[data-filter="policy"]'), 'stopped');
  assert.equal(await visible(page), shown);
  assert.equal(await page.textContent('#replay-words'), words);
  await close(page);
});

test('the keyboard alone filters, replays and comes back to the kick', async () => {
  const page = await open(url);
  const reach = async (selector) => {
    for (let i = 0; i < 120; ++i) {
      if (await page.evaluate((wanted) => document.activeElement.matches(wanted), selector)) return;
      await page.keyboard.press('Tab');
    }
    assert.fail(`the keyboard does not reach ${selector}`);
  };
  await reach('[data-filter="policy"]');
  await page.keyboard.press('ArrowDown');
  assert.notEqual(await page.inputValue('[data-filter="policy"]'), '');
  await reach('[data-replay]');
  const number = await page.evaluate(() => document.activeElement.dataset.replay);
  await page.keyboard.press('Enter');
  assert.ok(await page.evaluate(() => document.activeElement.matches('.replay-play')), 'the replay has the focus');
  await page.keyboard.press('Shift+Tab');
  await reach('.replay input');
  await page.keyboard.press('ArrowLeft');
  assert.equal(await instant(page), -40);
  await page.keyboard.press('Escape');
  assert.equal(await page.evaluate(() => document.activeElement.dataset.replay), number, 'the focus is back');
  await close(page);
});

test('without JavaScript everything but filter and replay is there', async () => {
  const page = await open(url, {javaScriptEnabled: false});
  for (const id of ['verdict', 'table2', 'forest', 'mouth', 'pitch', 'rates', 'predictions', 'drift', 'held', 'list', 'quality'])
    assert.ok(await page.isVisible(`#${id}`), id);
  assert.ok(await page.isHidden('#filter'));
  assert.ok(await page.isHidden('#k0 button'));
  assert.ok(await page.isVisible('#k0 th'));
  assert.ok(await page.isVisible('#mouth svg .mark >> nth=0'));
  await close(page);
});

test('every figure says that it is simulated, and names itself', async () => {
  const page = await open(url);
  const figures = await page.$$eval('figure', (all) => all.map((figure) => [figure.id, figure.textContent,
    figure.querySelector('svg').getAttribute('aria-label')]));
  assert.ok(figures.length >= 6, `${figures.length} figures`);
  for (const [id, text, label] of figures) {
    assert.match(text, /simulated: the simulation's assumptions/, id);
    assert.ok(label.length > 10, id);
  }
  await close(page);
});

test('axe-core finds nothing, and nothing sticks out: light, dark, wide, narrow', async () => {
  for (const colorScheme of ['light', 'dark']) {
    for (const viewport of [wide, phone]) {
      const page = await open(url, {viewport, colorScheme});
      await page.click('#k0 button');
      await page.waitForSelector('#replay .replay-above');
      assert.deepEqual(await findings(page), [], `${colorScheme} ${viewport.width}`);
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), viewport.width);
      await page.screenshot({path: screenshot(`${colorScheme}-${viewport.width}`), fullPage: true, caret: 'initial'});
      await close(page);
    }
  }
});

test('words overlap in no figure', async () => {
  const page = await open(url);
  const overlaps = await page.$$eval('figure svg', (svgs) => svgs.flatMap((svg) => {
    const texts = [...svg.querySelectorAll('text')];
    const boxes = texts.map((text) => text.getBoundingClientRect());
    const frame = svg.getBoundingClientRect();
    const found = [];
    for (let i = 0; i < boxes.length; ++i) {
      if (boxes[i].left < frame.left - 1 || boxes[i].right > frame.right + 1) found.push(`outside: ${texts[i].textContent}`);
      for (let j = 0; j < i; ++j) {
        if (Math.min(boxes[i].right, boxes[j].right) - Math.max(boxes[i].left, boxes[j].left) > 1 &&
          Math.min(boxes[i].bottom, boxes[j].bottom) - Math.max(boxes[i].top, boxes[j].top) > 4)
          found.push(`${svg.parentElement.id}: ${texts[j].textContent} / ${texts[i].textContent}`);
      }
    }
    return found;
  }));
  assert.deepEqual(overlaps, []);
  await close(page);
});

test('on paper it is light, without controls, whole', async () => {
  const page = await open(url, {colorScheme: 'dark'});
  await page.emulateMedia({media: 'print', colorScheme: 'dark'});
  assert.ok(await page.isHidden('#filter'));
  assert.ok(await page.isHidden('#k0 button'));
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), 'rgb(255, 255, 255)');
  await page.setViewportSize({width: 720, height: 1000});
  await page.screenshot({path: screenshot('print'), fullPage: true, caret: 'initial'});
  const pdf = await page.pdf({path: join(process.env.BROWSER_FOLDER, 'screenshots', 'report.pdf'), format: 'A4'});
  assert.ok(pdf.length > 20000);
  await close(page);
});

test('hostile names stay text', async () => {
  copyFileSync(folder.file('match.db'), folder.file(hostile));
  // A scenario's name is anybody's; a session that was never closed has no digest.
  const said = '<script>alert(4)</script><img src=x onerror=alert(5)>"\'&';
  await run('note', hostile, said, '--match', said, '--opponent', said, '--venue', said, '--by', said);
  execFileSync('sqlite3', [folder.file(hostile),
    `DELETE FROM digests; UPDATE sessions SET closed_t_ns = NULL, scenario = '</script><script>alert(2)</script>', software_version = '"><svg onload=alert(3)>';`]);
  await ends(3, 'report', hostile, '--html', 'hostile.html');
  const page = await open(pathToFileURL(folder.file('hostile.html')).href);
  assert.equal(await page.textContent('h1'), `Match report: ${hostile}`);
  assert.match(await page.textContent('#quality'), /<\/script><script>alert\(2\)<\/script>/);
  const header = await page.textContent('header');
  assert.equal(header.split(said).length - 1 >= 4, true, `match, opponent, venue and note stand in: ${header}`);
  assert.equal(await page.$('img'), null);
  assert.equal(await page.$$eval('script', (scripts) => scripts.filter((script) => script.textContent.startsWith('alert')).length), 0);
  assert.equal(await page.$('main svg[onload]'), null);
  await page.click('#k0 button');
  await page.waitForSelector('#replay .replay-above');
  await close(page);
});

test('the page of a whole match is a small file, and soon ready', async () => {
  await run('match', '--half', 'stopped', '--half', 'moving', '--seed', '1', '--out', 'whole.db');
  await run('report', 'whole.db', '--html', 'whole.html');
  const size_B = readFileSync(folder.file('whole.html')).length;
  assert.ok(size_B < 2_000_000, `${size_B} bytes`);
  const page = await open(pathToFileURL(folder.file('whole.html')).href);
  const ready_ms = await page.evaluate(() => performance.now());
  const {domInteractive, domContentLoadedEventEnd} = await page.evaluate(() => performance.getEntriesByType('navigation')[0].toJSON());
  console.log(`${size_B} bytes; read after ${domInteractive.toFixed(0)} ms, its scripts after ${domContentLoadedEventEnd.toFixed(0)} ms, ` +
    `seen ready after ${ready_ms.toFixed(0)} ms`);
  await close(page);
});

test('the same log gives the same bytes', async () => {
  await run('report', 'match.db', '--html', 'again.html');
  assert.ok(readFileSync(folder.file('report.html')).equals(readFileSync(folder.file('again.html'))));
});
