// The page of `trivela label --serve` in Chromium: with the keyboard alone, after a reload, with hostile texts, and after its
// end; it asks its own server alone.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import test from 'node:test';
import {findings} from './axe.mjs';
import {Folder, Trivela} from './processes.mjs';

const {chromium} = createRequire(join(process.env.BROWSER_FOLDER, 'package.json'))('playwright-core');
const patience = {timeout: 60000};
const wide = {width: 1280, height: 900};
const phone = {width: 390, height: 844};
const hostile = '<img src=x onerror="document.title=\'taken\'">';

const folder = new Folder();
const started = [];
let browser;

function trivela(...args) {
  const program = new Trivela(folder, ...args);
  started.push(program);
  return program;
}

async function done(...args) {
  const program = trivela(...args);
  assert.equal(await program.end(), 0, program.errors);
}

const ask = (sql) => execFileSync('sqlite3', [folder.file('sim.db'), sql], {encoding: 'utf8'}).trim();

async function open(url, viewport = wide, colorScheme = 'light') {
  const page = await browser.newPage({viewport, colorScheme});
  page.complaints = [];
  page.requests = [];
  page.on('request', (request) => page.requests.push(request.url()));
  page.on('pageerror', (error) => page.complaints.push(error.message));
  page.on('console', (message) => message.type() === 'error' && page.complaints.push(message.text()));
  await page.goto(url);
  await page.waitForSelector('#replay svg', patience);
  return page;
}

// Nothing was asked for but of the page's own server.
function askedItsServerAlone(page, url) {
  const own = new URL(url).origin;
  assert.ok(page.requests.length > 0);
  assert.deepEqual(page.requests.filter((request) => new URL(request).origin !== own && !request.startsWith('data:')), []);
}

const text = (page, selector) => page.textContent(selector);
const says = (page, selector, wanted) => page.waitForFunction(([selector, wanted]) =>
  document.querySelector(selector).textContent.includes(wanted), [selector, wanted], patience);

test.before(async () => {
  browser = await chromium.launch({executablePath: process.env.CHROMIUM, args: ['--no-sandbox']});
  await done('simulate', '--arms', 'moving', '--matches', '1', '--possessions', '12', '--out', 'sim.db');
  // As a recorder that saw little would have left it.
  ask('UPDATE kick_outcomes SET outcome = \'unknown\', on_target = 0 WHERE kick_id IN (SELECT kick_id FROM kick_outcomes ORDER BY t_ns LIMIT 4);' +
    'DELETE FROM digests; UPDATE sessions SET closed_t_ns = NULL');
});

test.after(async () => {
  await browser?.close();
  for (const program of started) program.stop();
  folder.remove();
});

test('unknown kicks are labelled with the keyboard alone, and each label is a row', async () => {
  const server = trivela('label', 'sim.db', '--serve');
  const url = await server.firstLine;
  const page = await open(url);
  assert.match(await text(page, '#log'), /^sim\.db: 4 of \d+ kicks are unknown$/);
  assert.match(await text(page, '#kick'), /, 1 of 4$/);
  const first = await page.evaluate(() => document.body.dataset.shown);

  await page.keyboard.press('4');  // nobody has said who
  await says(page, '#said', 'Who says so?');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'who');
  assert.equal(ask('SELECT count(*) FROM labels'), '0');
  await page.keyboard.type('Ada 123');  // digits in a field are no labels
  assert.equal(ask('SELECT count(*) FROM labels'), '0');
  await page.keyboard.press('Tab');
  await page.keyboard.type('clear of the bar');
  await page.keyboard.press('Tab');  // the first outcome's button
  await page.keyboard.press('4');
  await says(page, '#said', `Kick ${first}: over`);
  assert.equal(ask('SELECT outcome, who, note FROM labels'), 'over|Ada 123|clear of the bar');
  await says(page, '#log', '3 of');
  await page.waitForFunction((was) => document.body.dataset.shown !== was, first);  // the next one is shown

  await page.click('#time');
  await page.keyboard.type('12:30');
  await page.keyboard.press('Tab');
  await says(page, '#when', 'This kick is at 12:30.0 of the video.');
  await page.focus('#outcomes [data-outcome="post"]');
  await page.keyboard.press('Enter');
  await says(page, '#log', '2 of');
  assert.equal(ask('SELECT outcome, note FROM labels ORDER BY utc_ns DESC LIMIT 1'), 'post|video 12:30.0');
  await page.waitForFunction(() => /^This kick is at \d+:\d\d\.\d of the video\.$/.test(document.querySelector('#when').textContent));

  await page.focus('#kick');
  const shown = await text(page, '#kick');
  await page.keyboard.press('n');
  await page.waitForFunction((before) => document.querySelector('#kick').textContent !== before, shown, patience);
  await page.keyboard.press('p');
  await says(page, '#kick', shown.split(',')[0]);

  await page.selectOption('#which', 'labelled');
  await says(page, '#kick', `Kick ${first}, 1 of 2`);
  await page.focus('#kick');
  await page.keyboard.press('w');
  await says(page, '#said', 'the label is withdrawn');
  await says(page, '#log', '3 of');
  assert.equal(ask('SELECT count(*), sum(outcome IS NULL) FROM labels'), '3|1');
  assert.deepEqual(page.complaints, []);
  askedItsServerAlone(page, url);

  server.kill('SIGINT');
  assert.equal(await server.end(), 0, server.errors);
  await page.selectOption('#which', 'all');
  await page.focus('#kick');
  await page.keyboard.press('1');
  await says(page, '#said', 'does not answer: it has ended. Nothing was written.');
  await page.close();
});

test('a reload shows what stands in the log, and goes on labelling', async () => {
  const server = trivela('label', 'sim.db', '--serve');
  const url = await server.firstLine;
  const page = await open(url);
  const labels = Number(ask('SELECT count(*) FROM labels'));
  const left = /(\d+) of/.exec(await text(page, '#log'))[1];
  await page.reload();
  await page.waitForSelector('#replay svg', patience);
  assert.equal(/(\d+) of/.exec(await text(page, '#log'))[1], left);
  assert.match(await text(page, '#kick'), new RegExp(`, 1 of ${left}$`));
  await page.fill('#who', 'Grace');
  await page.focus('#kick');
  await page.keyboard.press('2');
  await says(page, '#said', 'Kick');
  await says(page, '#log', `${left - 1} of`);
  assert.equal(Number(ask('SELECT count(*) FROM labels')), labels + 1);
  await page.reload();
  await page.waitForSelector('#replay svg', patience);
  assert.equal(/(\d+) of/.exec(await text(page, '#log'))[1], String(left - 1), 'the label is in the log');
  assert.deepEqual(page.complaints, []);
  askedItsServerAlone(page, url);
  server.stop();
  await page.close();
});

test('texts of the log stay texts, nothing sticks out, and axe finds nothing', async () => {
  const kick = ask('SELECT robot_id || \':\' || (kick_id & 0xffffffffff) FROM kicks WHERE outcome = \'unknown\' ORDER BY t_ns LIMIT 1');
  await done('label', 'sim.db', kick, 'wide_left', '--by', hostile, '--note', hostile);
  const server = trivela('label', 'sim.db', '--serve');
  const url = await server.firstLine;
  for (const colorScheme of ['light', 'dark']) {
    for (const viewport of [wide, phone]) {
      const page = await open(url, viewport, colorScheme);
      await page.selectOption('#which', 'labelled');
      await says(page, '#facts', hostile);
      assert.equal(await page.$('img'), null);
      assert.equal(await page.title(), 'Labels of sim.db');
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), viewport.width);
      assert.deepEqual(await findings(page), []);
      await page.screenshot({path: join(process.env.BROWSER_FOLDER, 'screenshots',
        `label-${colorScheme}-${viewport.width}.png`), fullPage: true});
      assert.deepEqual(page.complaints, []);
      askedItsServerAlone(page, url);
      await page.close();
    }
  }
  server.stop();
});

test('without the token of the printed address kicks are seen and none is labelled', async () => {
  const server = trivela('label', 'sim.db', '--serve');
  const page = await open((await server.firstLine).split('#')[0]);
  await says(page, '#said', 'This address has no token');
  assert.equal(await page.$$eval('#outcomes button:enabled', (buttons) => buttons.length), 0);
  const rows = ask('SELECT count(*) FROM labels');
  await page.keyboard.press('1');
  const status = await page.evaluate(async () => (await fetch('/api/label', {method: 'POST',
    headers: {'Content-Type': 'application/json', 'X-Trivela-Token': 'guessed'}, body: '{}'})).status);
  assert.equal(status, 403);
  assert.equal(ask('SELECT count(*) FROM labels'), rows);
  server.stop();
  await page.close();
});
