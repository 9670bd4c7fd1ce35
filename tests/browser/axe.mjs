// What axe-core finds in a page: WCAG and its best practices. By evaluation, since the page's policy lets no foreign script in.
import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';

const source = readFileSync(createRequire(join(process.env.BROWSER_FOLDER, 'package.json')).resolve('axe-core/axe.min.js'), 'utf8');

// A line a finding.
export async function findings(page) {
  await page.evaluate(source);
  const {violations} = await page.evaluate(() => globalThis.axe.run(document));
  return violations.map(({id, nodes}) => `${id}: ${nodes.map((node) => node.html).join(' | ')}`);
}
