// node picture.mjs CHROMIUM FOLDER PAGE OUT.png WIDTH HEIGHT
// A picture of a page that sets document.body.dataset.drawn, served from FOLDER. Prints what its #told says. Ends with 1 when
// the page has trouble, asks for something that is not there, or draws nothing.
import assert from 'node:assert/strict';
import { createReadStream } from 'node:fs';
import { stat, writeFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { Chromium, softwareGl } from '../view/chromium.mjs';
import { decode } from '../view/png.mjs';

const [program, folder, page, out, width, height] = process.argv.slice(2);
const kinds = { '.html': 'text/html', '.js': 'text/javascript', '.glb': 'model/gltf-binary' };
const missing = [];

const server = createServer(async (request, response) => {
  const path = normalize(decodeURIComponent(new URL(request.url, 'http://x').pathname));
  const file = join(folder, path);
  const there = await stat(file).then((s) => s.isFile(), () => false);
  if (!there && path !== '/favicon.ico') missing.push(path);
  response.writeHead(there ? 200 : 404, { 'content-type': kinds[extname(path)] ?? 'application/octet-stream' });
  if (there) createReadStream(file).pipe(response);
  else response.end();
});
await new Promise((done) => { server.listen(0, '127.0.0.1', done); });

const browser = await Chromium.start(program, softwareGl);
try {
  const tab = await browser.open(`http://127.0.0.1:${server.address().port}/${page}`, Number(width), Number(height));
  for (let k = 0; k < 8 && missing.length === 0 && !(await tab.evaluate('document.body.dataset.drawn === "yes"')); ++k)
    await tab.until('document.body.dataset.drawn === "yes"').catch(() => {}); // large levels take a while without a GPU
  assert.deepEqual(missing, []);
  assert.deepEqual(tab.troubles, []);
  assert.equal(await tab.evaluate('document.body.dataset.drawn'), 'yes');
  await tab.evaluate('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))');
  const { data } = await tab.send('Page.captureScreenshot', { format: 'png' });
  const bytes = Buffer.from(data, 'base64');
  const picture = decode(bytes);
  const colours = new Set();
  for (let y = 0; y < picture.height; y += 4)
    for (let x = 0; x < picture.width; x += 4) colours.add(picture.at(x, y).map((value) => value >> 4).join());
  assert.ok(colours.size > 60, `only ${colours.size} colours: nothing is drawn`);
  await writeFile(out, bytes);
  console.log(await tab.evaluate('document.getElementById("told").textContent'));
} finally {
  await browser.close();
  server.close();
}
