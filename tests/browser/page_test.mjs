// The page of `trivela lob` in Chromium: a replay, with the keyboard alone and after a reload, and a live scanner whose cable is
// pulled. It asks its own server alone, and axe-core finds nothing.
import assert from 'node:assert/strict';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import test from 'node:test';
import {findings} from './axe.mjs';
import {Folder, Trivela} from './processes.mjs';

const {chromium} = createRequire(join(process.env.BROWSER_FOLDER, 'package.json'))('playwright-core');
const patience = {timeout: 60000};
const wide = {width: 1280, height: 800};
const phone = {width: 390, height: 844};

const folder = new Folder();
let browser;
const started = [];

function trivela(...args) {
  const program = new Trivela(folder, ...args);
  started.push(program);
  return program;
}

async function open(url, viewport = wide, colorScheme = 'light') {
  const page = await browser.newPage({viewport, colorScheme});
  page.complaints = [];
  page.requests = [];
  page.on('request', (request) => page.requests.push(request.url()));
  page.on('pageerror', (error) => page.complaints.push(error.message));
  page.on('console', (message) => message.type() === 'error' && page.complaints.push(message.text()));
  await page.goto(url);
  return page;
}

// Nothing was asked for but of the page's own server.
function askedItsServerAlone(page, url) {
  const own = new URL(url).origin;
  assert.ok(page.requests.length > 0);
  assert.deepEqual(page.requests.filter((request) => new URL(request).origin !== own && !request.startsWith('data:')), []);
}

// Every way a user sees the page: pictures for a human to look at, and nothing sticks out sideways.
async function photograph(url, name) {
  for (const colorScheme of ['light', 'dark']) {
    for (const viewport of [wide, phone]) {
      const page = await open(url, viewport, colorScheme);
      await page.waitForFunction(() => document.body.dataset.drawn, null, patience);
      await page.screenshot({path: join(process.env.BROWSER_FOLDER, 'screenshots',
        `${name}-${colorScheme}-${viewport.width}.png`), fullPage: true});
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), viewport.width);
      assert.deepEqual(await findings(page), [], `${name} ${colorScheme} ${viewport.width}`);
      assert.deepEqual(page.complaints, []);
      askedItsServerAlone(page, url);
      await page.close();
    }
  }
}

// How many pixels of the picture are near a colour.
const pixels = (page, colour) => page.evaluate(([r, g, b]) => {
  const canvas = document.querySelector('#scan');
  const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let n = 0;
  for (let i = 0; i < data.length; i += 4) {
    n += Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b) < 24;
  }
  return n;
}, colour);

const rows = (page) => page.$$eval('#table tbody tr',
  (trs) => trs.map((tr) => [...tr.cells].map((td) => td.textContent)));
const picture = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() =>
  requestAnimationFrame(() => done(document.querySelector('#scan').toDataURL())))));
const drawn = (page, position) =>
  page.waitForFunction((wanted) => document.body.dataset.drawn === wanted, String(position), patience);

async function stepTo(page, button, position) {
  await page.click(button);
  await drawn(page, position);
  return picture(page);
}

test.before(async () => {
  browser = await chromium.launch({executablePath: process.env.CHROMIUM, args: ['--no-sandbox']});
  const made = trivela('scan', '--synthesize', 'lobs.db');  // of the default robot's set-points, two kicks each
  assert.equal(await made.end(), 0, made.errors);
});

test.after(async () => {
  await browser?.close();
  for (const program of started) program.stop();
  folder.remove();
});

test('a replayed lob appears, is rejected, and the table changes', async () => {
  const server = trivela('lob', '--replay', 'lobs.db', '--plan', '15,20,...,50');
  const url = await server.firstLine;
  const page = await open(url);
  await page.selectOption('#speed', '5');
  await page.waitForSelector('#lobs li[data-lob="0"][data-accepted="true"]', patience);
  await page.waitForSelector('#lobs li[data-lob="1"][data-accepted="true"]', patience);
  await page.click('#play');
  await page.waitForFunction(() => document.querySelector('#play').textContent === 'play', null, patience);
  assert.equal((await rows(page))[0][1], '2');
  assert.match(await page.textContent('#plan [data-power="15"]'), /●●/);

  await page.click('#lobs li[data-lob="1"] .values');
  await page.fill('#lobs li[data-lob="1"] input', 'touched a foot');
  await page.click('#lobs li[data-lob="1"] .judge');
  await page.waitForSelector('#lobs li[data-lob="1"][data-accepted="false"]', patience);
  assert.match(await page.textContent('#lobs li[data-lob="1"] .said'), /rejected by the operator: touched a foot/);
  assert.equal((await rows(page))[0][1], '1');
  assert.equal((await rows(page))[0][3], '–', 'one kick has no spread');
  await page.click('#lobs li[data-lob="1"] .judge');
  await page.waitForSelector('#lobs li[data-lob="1"][data-accepted="true"]', patience);
  assert.equal((await rows(page))[0][1], '2');
  await page.click('#lobs li[data-lob="1"] .more button');
  const {end} = await page.evaluate(async () => (await (await fetch('/api/state')).json()).lobs[1]);
  await drawn(page, end);
  await page.screenshot({path: join(process.env.BROWSER_FOLDER, 'screenshots', 'replay-chosen.png')});
  await page.click('#lobs li[data-lob="1"] .values');
  assert.deepEqual(page.complaints, []);

  await page.fill('#scrubber', '110');  // the first ball flies
  await drawn(page, 110);
  await photograph(url, 'replay');
  for (const [name, colour] of Object.entries({background: [26, 148, 56], object: [0, 0, 0], centre: [224, 0, 0],
    laser: [0, 80, 255]})) {
    assert.ok(await pixels(page, colour) > 10, `the picture shows the ${name}`);
  }

  const forwards = [];
  for (let i = 111; i <= 116; ++i) forwards.push(await stepTo(page, '#forward', i));
  assert.notEqual(forwards[0], forwards[5]);
  for (let i = 115; i >= 111; --i) assert.equal(await stepTo(page, '#back', i), forwards[i - 111], `scan ${i}`);

  const stopped = performance.now();
  server.kill('SIGINT');
  assert.equal(await server.end(), 0, server.errors);
  assert.ok(performance.now() - stopped < 1000, 'Ctrl-C with a viewer');
  await page.waitForFunction(() => document.querySelector('#link').textContent === 'server gone', null, patience);
  await page.close();
});

test('the keyboard alone plays, steps and judges, and a reload keeps the verdict', async () => {
  const server = trivela('lob', '--replay', 'lobs.db', '--plan', '15,20,...,50');
  const url = await server.firstLine;
  const page = await open(url);
  const reach = async (selector) => {
    for (let i = 0; i < 150; ++i) {
      if (await page.evaluate((wanted) => document.activeElement.matches(wanted), selector)) return;
      await page.keyboard.press('Tab');
    }
    assert.fail(`the keyboard does not reach ${selector}`);
  };
  await page.waitForFunction(() => document.body.dataset.drawn, null, patience);
  await reach('#play');
  if (await page.textContent('#play') !== 'play') await page.keyboard.press('Enter');
  await page.waitForFunction(() => document.querySelector('#play').textContent === 'play', null, patience);
  const at = Number(await page.evaluate(() => document.body.dataset.drawn));
  await reach('#forward');
  await page.keyboard.press('Enter');
  await drawn(page, at + 1);
  await reach('#speed');
  await page.keyboard.press('End');  // as fast as it goes
  await page.keyboard.press('Shift+Tab');
  await page.keyboard.press('Shift+Tab');
  await reach('#play');
  await page.keyboard.press('Enter');
  await page.waitForSelector('#lobs li[data-lob="0"][data-accepted="true"]', patience);
  await reach('#lobs li[data-lob="0"] .values');
  await page.keyboard.press('Enter');
  await reach('#lobs li[data-lob="0"] .judge');
  await page.keyboard.press('Enter');
  await page.waitForSelector('#lobs li[data-lob="0"][data-accepted="false"]', patience);
  await page.reload();
  await page.waitForSelector('#lobs li[data-lob="0"][data-accepted="false"]', patience);
  assert.deepEqual(page.complaints, []);
  askedItsServerAlone(page, url);
  server.kill('SIGINT');
  assert.equal(await server.end(), 0, server.errors);
  await page.close();
});

test('a live scanner is drawn at its rate; its cable is pulled and put back', async () => {
  const emulate = (port) => trivela('scan', '--emulate', 'lobs.db', '--loop', '--tcp', port);
  const scanner = emulate('0');
  const device = await scanner.firstLine;
  const server = trivela('lob', '--live', device, '--record', 'live.db', '--plan', '15,20,...,30');
  const url = await server.firstLine;
  const page = await open(url);
  await page.waitForSelector('#link[data-state="up"]', patience);
  await page.waitForFunction(() => {
    const rate = /(\d+) scans\/s/.exec(document.querySelector('#place').textContent);
    return rate && Number(rate[1]) >= 38;
  }, null, patience);
  await page.waitForSelector('#lobs li[data-lob="0"]', patience);
  assert.match(await page.textContent('#progress'), /1 of 8 kicks done; next: power 15, kick 2/);
  await page.click('#plan [data-power="25"]');
  await page.waitForSelector('#plan [data-power="25"][aria-pressed="true"]', patience);
  assert.equal(await page.textContent('#tested'), '25');

  await page.fill('#scrubber', '3');  // looks back while the record goes on
  await drawn(page, 3);
  const before = Number(await page.getAttribute('#scrubber', 'max'));
  await page.waitForFunction((max) => Number(document.querySelector('#scrubber').max) > max, before, patience);
  assert.equal(await page.evaluate(() => document.body.dataset.drawn), '3');
  await page.click('#follow');
  await photograph(url, 'live');

  const pulled = performance.now();
  scanner.kill('SIGKILL');
  await page.waitForSelector('#link[data-state="down"]', patience);
  const shown = performance.now() - pulled;
  assert.ok(shown < 1000, `the pulled cable showed after ${shown.toFixed(0)} ms`);
  console.log(`the pulled cable showed after ${shown.toFixed(0)} ms`);
  await page.screenshot({path: join(process.env.BROWSER_FOLDER, 'screenshots', 'live-pulled.png')});
  const scans = Number(await page.textContent('[data-counter="scans"]'));

  await scanner.end();
  await emulate(new URL(device).port).firstLine;
  await page.waitForSelector('#link[data-state="up"]', patience);
  await page.waitForFunction((before) => Number(document.querySelector('[data-counter="scans"]').textContent) > before + 40,
    scans, patience);
  assert.ok(Number(await page.textContent('[data-counter="reconnects"]')) >= 1);
  assert.deepEqual(page.complaints, []);

  const stopped = performance.now();
  server.kill('SIGINT');
  assert.equal(await server.end(), 0, server.errors);
  assert.ok(performance.now() - stopped < 1000, 'Ctrl-C with a viewer');
  const info = trivela('scan', '--info', 'live.db', '--json');
  assert.equal(await info.end(), 0, 'the record is whole');
  await page.close();
});
