// node screenshot.mjs CHROMIUM PAGE.html OUT.png [SELECTOR...]
// A picture of a page of glcast view after clicks, such as docs/images/view.png:
//   glcast view glxgears.glb --capture gears.exr -o gears.html
//   node tests/view/screenshot.mjs chromium gears.html docs/images/view.png '#levels tbody tr:last-child' '#show-error' '#wireframe'
import assert from 'node:assert/strict';
import { writeFile } from 'node:fs/promises';
import { pathToFileURL } from 'node:url';
import { Chromium, softwareGl } from './chromium.mjs';

const [program, page, out, ...clicks] = process.argv.slice(2);
const browser = await Chromium.start(program, softwareGl);
try {
  const tab = await browser.open(pathToFileURL(page).href, 1280, 940);
  for (const selector of clicks) await tab.click(selector);
  await tab.picture(); // waits for what the clicks changed
  const { data } = await tab.send('Page.captureScreenshot', { format: 'png' });
  await writeFile(out, Buffer.from(data, 'base64'));
  assert.deepEqual(tab.troubles, []);
} finally {
  await browser.close();
}
