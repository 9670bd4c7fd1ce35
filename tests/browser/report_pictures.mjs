// report_pictures.mjs PAGE.html FOLDER/report_NAME.png...: pictures of the page of `trivela report --html`, each of the figure that
// its file is named by (report_mouth.png: the figure mouth-figure), as wide as on a page of paper.
import {createRequire} from 'node:module';
import {basename, join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

const {chromium} = createRequire(join(process.env.BROWSER_FOLDER, 'package.json'))('playwright-core');
const [, , report, ...files] = process.argv;
const browser = await chromium.launch({executablePath: process.env.CHROMIUM, args: ['--no-sandbox']});
try {
  const page = await browser.newPage({viewport: {width: 760, height: 900}});
  await page.goto(pathToFileURL(resolve(report)).href);
  await page.waitForSelector('html[data-ready]', {state: 'attached'});
  for (const file of files) {
    const name = /^report_(\w+)\.png$/.exec(basename(file))?.[1];
    const figure = await page.$(`#${name}-figure`);
    if (!figure) throw new Error(`${file}: the page has no figure ${name}`);
    await figure.screenshot({path: file});
  }
} finally {
  await browser.close();
}
