// monitor_picture.mjs FILE.png: README's picture of the live page, of a match that it plays. Several kicks in, at a moment at which
// the robot holds and the segments show why.
import {createRequire} from 'node:module';
import {join} from 'node:path';
import {Folder, Trivela} from './processes.mjs';

const {chromium} = createRequire(join(process.env.BROWSER_FOLDER, 'package.json'))('playwright-core');
const [, , file] = process.argv;
const folder = new Folder();
const match = new Trivela(folder, 'match', '--random', 'stopped,moving,predictive', '--minutes', '4', '--seed', '1', '--watch', '--pace', '3',
  '--out', 'picture.db');
const browser = await chromium.launch({executablePath: process.env.CHROMIUM, args: ['--no-sandbox']});
try {
  const page = await browser.newPage({viewport: {width: 1280, height: 900}});
  await page.goto(await match.firstLine);
  await page.waitForFunction(() => {
    const inside = [...document.querySelectorAll('#table tbody tr')].reduce((n, row) => n + Number(row.cells[1].textContent), 0);
    const holds = /segments do not meet/.test(document.querySelector('#robots .why')?.textContent);
    const found = inside >= 40 && holds && document.querySelector('#pitch line.s1[visibility="visible"]') !== null;
    if (found) document.querySelector('#pause').click();  // or it would be over before the picture is taken
    return found;
  }, null, {timeout: 300000, polling: 'raf'});
  await page.screenshot({path: file, fullPage: true});
} finally {
  await browser.close();
  match.stop();
  await match.end();
  folder.remove();
}
