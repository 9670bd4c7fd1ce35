// The live page in Chromium: of `trivela match --watch` while the match goes on and after it, and of `trivela monitor` beside
// another process's match, with names that mean no good.
import assert from 'node:assert/strict';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {readFileSync, writeFileSync} from 'node:fs';
import test from 'node:test';
import {findings} from './axe.mjs';
import {Folder, Trivela} from './processes.mjs';

const {chromium} = createRequire(join(process.env.BROWSER_FOLDER, 'package.json'))('playwright-core');
const patience = {timeout: 120000};
const wide = {width: 1280, height: 900};
const phone = {width: 390, height: 844};
const folder = new Folder();
const started = [];
let browser;

function trivela(...args) {
  const program = new Trivela(folder, ...args);
  started.push(program);
  return program;
}

// A page that notes what it must not do: errors, and requests to anybody but its own server.
async function open(url, {viewport = wide, colorScheme = 'light', reducedMotion = 'no-preference'} = {}) {
  const page = await browser.newPage({viewport, colorScheme, reducedMotion});
  page.complaints = [];
  page.on('pageerror', (error) => page.complaints.push(error.message));
  page.on('dialog', (dialog) => { page.complaints.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
  page.on('console', (message) => message.type() === 'error' && page.complaints.push(message.text()));
  page.on('request', (request) => {
    if (new URL(request.url()).protocol !== 'data:' && new URL(request.url()).origin !== new URL(url).origin)
      page.complaints.push(`asks for ${request.url()}`);
  });
  await page.goto(url);
  return page;
}

const live = (page) => page.waitForSelector('#link[data-state="up"]', patience);
const robotThere = (page) => page.waitForSelector('#robots li .why:not(:empty)', patience);
const kicked = (page, n) => page.waitForFunction((wanted) => document.querySelectorAll('#kicks tbody tr').length >= wanted, n, patience);

async function photograph(page, name) {
  await page.screenshot({path: join(process.env.BROWSER_FOLDER, 'screenshots', `${name}.png`), fullPage: true});
}

test.before(async () => {
  browser = await chromium.launch({executablePath: process.env.CHROMIUM, args: ['--no-sandbox']});
});

test.after(async () => {
  await browser?.close();
  for (const program of started) program.stop();
  folder.remove();
});

test('a match is watched from the first kick to after its end', async () => {
  const match = trivela('match', '--random', 'stopped,moving,predictive', '--minutes', '0.6', '--seed', '1', '--watch', '--out', 'watched.db');
  const url = await match.firstLine;
  const page = await open(url);
  await live(page);
  await robotThere(page);
  await kicked(page, 3);

  assert.match(await page.textContent('#simulated'), /^simulated: a simulator/);
  assert.ok(await page.isVisible('#simulated'));
  for (const head of ['#pitch-title', '#robots-head', '#table-head', '#kicks-head'])
    assert.match(await page.textContent(head), /\(simulated\)/, `${head} says so itself`);
  assert.equal(await page.textContent('#pitch .stamp'), 'SIMULATED');
  assert.match(await page.textContent('#game'), /half 1/);
  assert.ok(await page.$$eval('#table tbody tr', (rows) => rows.length) >= 1);
  assert.match(await page.textContent('#table tbody .interval'), /\d+ % to \d+ %/);
  assert.match(await page.textContent('#nodes'), /kicker_driver/);
  await page.waitForSelector('#pitch line.s1[visibility="visible"]', {...patience, state: 'attached'});
  await page.waitForSelector('#pitch line.s2[visibility="visible"]', {...patience, state: 'attached'});
  await photograph(page, 'monitor-light-1280');
  assert.deepEqual(await findings(page), []);

  // Everything is there again at once.
  const before = await page.$$eval('#kicks tbody tr', (rows) => rows.length);
  await page.reload();
  await kicked(page, before);
  await robotThere(page);

  // Each way of looking.
  for (const [name, how] of [['dark-1280', {colorScheme: 'dark'}], ['light-390', {viewport: phone}],
    ['dark-390', {viewport: phone, colorScheme: 'dark'}], ['calm-1280', {reducedMotion: 'reduce'}]]) {
    const other = await open(url, how);
    await kicked(other, before);
    await robotThere(other);
    const width = await other.evaluate(() => document.documentElement.scrollWidth);
    assert.equal(width, (how.viewport ?? wide).width, `${name} sticks out sideways`);
    assert.deepEqual(await findings(other), [], name);
    await photograph(other, `monitor-${name}`);
    assert.deepEqual(other.complaints, []);
    await other.close();
  }

  // Keyboard alone, and the picture holds still. No reload here: after one, Tab may begin at the fragment (#robots).
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.className), 'skip');
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'pause');
  await page.keyboard.press('Space');
  assert.equal(await page.getAttribute('#pause', 'aria-pressed'), 'true');
  await page.waitForFunction(() => document.querySelector('#link').textContent === 'live, paused here', null, patience);
  const held = await page.evaluate(() => document.body.dataset.frames);
  await page.waitForFunction(() => new Promise((done) => {  // the events go on
    let n = 0;
    const events = new EventSource('/api/events');
    events.addEventListener('pitch', () => { if (++n === 10) { events.close(); done(true); } });
  }), null, patience);
  assert.equal(await page.evaluate(() => document.body.dataset.frames), held);
  await page.keyboard.press('Space');
  await page.waitForFunction((frames) => document.body.dataset.frames > frames, Number(held), patience);
  await page.keyboard.press('Shift+Tab');  // to the link past the picture
  await page.keyboard.press('Enter');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'robots');

  // Nothing can be ordered.
  for (const method of ['POST', 'PUT', 'DELETE', 'PATCH']) {
    const answer = await page.request.fetch(`${url}api/kick`, {method, data: {power: 50}});
    assert.equal(answer.status(), 405, method);
  }

  await page.waitForFunction(() => /the match is over/.test(document.querySelector('#game').textContent), null, patience);
  await page.waitForFunction(() => document.querySelector('#alarm-list').children.length === 0, null, patience);
  const table = await page.$$eval('#table tbody tr', (rows) => rows.map((row) => [...row.cells].slice(0, 5).map((cell) => cell.textContent)));
  const counted = Object.fromEntries(table.map(([policy, ...counts]) => [policy, counts.map(Number)]));
  const report = trivela('report', 'watched.db', '--json');
  const lines = [];
  report.lines.on('line', (line) => lines.push(line));
  assert.equal(await report.end(), 0, report.errors);
  for (const row of JSON.parse(lines.join('\n')).policies)
    assert.deepEqual(counted[row.policy],
      [row.inside, row.saved.observed ? row.saved.observed.of - row.saved.observed.saved : 0, row.outside, row.unknown],
      `${row.policy}: page and report`);
  assert.deepEqual(page.complaints, []);
  match.kill('SIGINT');
  assert.equal(await match.end(), 0, match.errors);
  await page.waitForSelector('#link[data-state="down"]', patience);
  await page.close();
});

test('names that mean no good stay text, and a token is asked for', async () => {
  const bad = '<img src=x onerror=alert(1)>';
  const worse = '</script><script>alert(2)</script>';
  const token = 'a-token-of-a-test-0123456789';
  writeFileSync(folder.file('token'), `${token}\n`, {mode: 0o600});
  const robot = readFileSync(new URL('../../config/robots/cambada_1.toml', import.meta.url), 'utf8');
  writeFileSync(folder.file('bad_robot.toml'), robot.replace('name = "cambada_1"', `name = "${worse}"`));
  writeFileSync(folder.file('bad.toml'), `[run]\nteam = "${bad}"\nrobot = "bad_robot.toml"\n`);
  const match = trivela('match', '--config', 'bad.toml', '--half', 'moving', '--minutes', '0.3', '--watch', '--token-file', 'token',
    '--out', '<b>bad.db');
  const url = await match.firstLine;
  assert.match(url, new RegExp(`/\\?token=${token}$`));
  const page = await open(url);
  await live(page);
  await kicked(page, 1);
  assert.equal(new URL(page.url()).search, '', 'the token is not left in the address');
  assert.match(await page.textContent('#title'), new RegExp(bad.replace(/[()]/g, '\\$&')));
  assert.equal(await page.textContent('#kicks tbody th'), `1 ${worse}`);
  assert.equal(await page.textContent('#robots .name'), `1 ${worse}`);
  assert.equal(await page.$$eval('img, script:not([src])', (found) => found.length), 0);
  await page.reload();
  await live(page);
  assert.deepEqual(await findings(page), []);
  await photograph(page, 'monitor-hostile-names');
  assert.equal((await (await browser.newContext()).request.get(`${new URL(url).origin}/`)).status(), 401);
  assert.deepEqual(page.complaints, []);
  match.kill('SIGINT');
  await match.end();
  await page.close();
});

test('where nobody plays the page says so and claims nothing', async () => {
  const monitor = trivela('monitor', '--domain', String(1 + process.pid % 100), '--tag', `browser-${process.pid}`);
  const page = await open(await monitor.firstLine, {viewport: phone});
  await live(page);
  await page.waitForSelector('#nobody:not([hidden])', patience);
  assert.ok(!await page.isVisible('#simulated'), 'nobody has said that it is simulated');
  assert.equal(await page.textContent('#game'), 'no referee received yet');
  assert.deepEqual(await findings(page), []);
  await photograph(page, 'monitor-nobody-390');
  assert.deepEqual(page.complaints, []);
  monitor.kill('SIGTERM');
  assert.equal(await monitor.end(), 0, monitor.errors);
  await page.close();
});
