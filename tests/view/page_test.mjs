// node page_test.mjs CHROMIUM PAGE.html
// The page of view_test.cpp in a browser: by clicking, by keys, by touch, and by looking at pixels. Ends with 1 when anything
// is not as it should be.
import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Chromium, softwareGl } from './chromium.mjs';
import { decode } from './png.mjs';
import { background, count, isModel, near, stageOf } from './stage.mjs';

const [program, page] = process.argv.slice(2);
const url = pathToFileURL(page).href;
const red = [230, 26, 26], blue = [26, 26, 230];

const isDark = (p) => p[0] < 60 && p[1] < 60 && p[2] < 70;

const steps = {
  async 'shows the surface in its colours'(tab, stage) {
    const picture = await tab.picture();
    const model = count(picture, stage, isModel);
    assert.ok(model > 0.01 * stage.width * stage.height, `${model} pixels of the model`);
    near(picture.at(Math.round(stage.x) + 5, stage.cy), background, 2, 'beside the model');
    assert.equal(await tab.evaluate('document.querySelectorAll("#levels tbody tr").length'), 3);
    assert.equal(await tab.evaluate('document.getElementById("level").max'), '1', 'one level is left out');
    assert.match(await tab.evaluate('document.getElementById("note").textContent'), /left out of this page/);
    assert.equal(await tab.evaluate('document.querySelectorAll("#title *").length'), 0, 'a file name is no HTML');
    assert.match(await tab.evaluate('document.title'), /^s<i>&\.glb/);
  },
  async 'captured views turn the cast'(tab, stage) {
    assert.equal(await tab.evaluate('document.querySelectorAll("#views img").length'), 6);
    await tab.click('#view-2');
    near((await tab.picture()).at(stage.cx, stage.cy), red, 8, 'from +x');
    await tab.click('#view-1');
    near((await tab.picture()).at(stage.cx, stage.cy), blue, 8, 'from -x');
    await tab.click('#view-6');
    const picture = await tab.picture();
    near(picture.at(stage.cx + 40, stage.cy), red, 12, 'from +z, right');
    near(picture.at(stage.cx - 40, stage.cy), blue, 12, 'from +z, left');
  },
  async 'captured views are the right way round'(tab) {
    // The capture's +z view has red growing with x and green with y; its -z view is seen from behind.
    for (const [view, sign] of [['#view-6', 1], ['#view-5', -1]]) {
      const source = await tab.evaluate(`document.querySelector('${view} img').src`);
      const image = decode(Buffer.from(source.split(',')[1], 'base64'));
      const [left, right] = [image.at(image.width >> 2, image.height >> 1), image.at(image.width * 3 >> 2, image.height >> 1)];
      const [top, bottom] = [image.at(image.width >> 1, image.height >> 2), image.at(image.width >> 1, image.height * 3 >> 2)];
      assert.ok((right[0] - left[0]) * sign > 10, `${view} left to right: ${left} ${right}`);
      assert.ok(top[1] - bottom[1] > 10, `${view} top to bottom: ${top} ${bottom}`);
      assert.equal(image.at(0, 0)[3], 0, 'nothing in the corner');
    }
  },
  async 'turns by mouse'(tab, stage) {
    await tab.click('#view-2');
    await tab.drag(stage.cx - 235, stage.cy, stage.cx + 236, stage.cy);
    near((await tab.picture()).at(stage.cx, stage.cy), blue, 8, 'half round by mouse');
  },
  async 'turns by keys'(tab, stage) {
    for (let k = 0; k < 12; ++k) await tab.key('ArrowRight');
    near((await tab.picture()).at(stage.cx, stage.cy), red, 8, 'half round by keys');
  },
  async 'turns by touch'(tab, stage) {
    await tab.touchDrag(stage.cx - 235, stage.cy, stage.cx + 236, stage.cy);
    near((await tab.picture()).at(stage.cx, stage.cy), blue, 8, 'half round by touch');
  },
  async 'zooms'(tab, stage) {
    const before = count(await tab.picture(), stage, isModel);
    await tab.key('-', 'Minus');
    const smaller = count(await tab.picture(), stage, isModel);
    assert.ok(smaller < 0.8 * before, `${before} to ${smaller} pixels by key`);
    await tab.send('Input.dispatchMouseEvent', { type: 'mouseWheel', x: stage.cx, y: stage.cy, deltaX: 0, deltaY: -240 });
    const larger = count(await tab.picture(), stage, isModel);
    assert.ok(larger > 1.2 * smaller, `${smaller} to ${larger} pixels by wheel`);
  },
  async 'shows normals'(tab, stage) {
    await tab.click('#view-2');
    const colours = await tab.evaluate('document.querySelector("#view-2 img").src');
    await tab.click('#show-normal');
    near((await tab.picture()).at(stage.cx, stage.cy), [255, 128, 128], 6, 'normal towards +x');
    assert.notEqual(await tab.evaluate('document.querySelector("#view-2 img").src'), colours, 'captured normals beside them');
    await tab.click('#view-6');
    near((await tab.picture()).at(stage.cx, stage.cy), [128, 128, 255], 6, 'normal towards +z');
  },
  async 'shows the error'(tab, stage) {
    await tab.click('#show-error');
    near((await tab.picture()).at(stage.cx, stage.cy), [223, 230, 234], 8, 'a level that hardly has any');
    await tab.click('#level', 0.98);
    await tab.until('document.getElementById("canvas").dataset.level === "2"');
    near((await tab.picture()).at(stage.cx, stage.cy), [109, 15, 43], 12, 'a level that is too large everywhere');
    assert.match(await tab.evaluate('document.getElementById("ramp-high").textContent'), /^3\.2 samples$/);
    assert.match(await tab.evaluate('document.getElementById("status").textContent'), /^Level 2 · 224 triangles/);
  },
  async 'shows the wireframe'(tab, stage) {
    await tab.click('#show-colour');
    const before = count(await tab.picture(), stage, isDark);
    await tab.click('#wireframe');
    const after = count(await tab.picture(), stage, isDark);
    assert.ok(after > before + 100, `${before} dark pixels, then ${after}`);
    await tab.click('#wireframe');
    assert.equal(count(await tab.picture(), stage, isDark), before, 'and is gone again');
  },
  async 'levels by keys'(tab, stage) {
    const coarse = count(await tab.picture(), stage, isModel);
    await tab.key(',', 'Comma');
    await tab.until('document.getElementById("canvas").dataset.level === "1"');
    const fine = count(await tab.picture(), stage, isModel);
    assert.ok(coarse > 1.2 * fine, `the coarse level is larger: ${fine}, ${coarse} pixels`);
    assert.equal(await tab.evaluate('document.querySelector("#levels .current").cells[0].textContent'), '1');
  },
  async 'saves the level and the picture'(tab, stage) {
    const folder = dirname(page);
    assert.equal(await tab.download(folder, () => tab.click('#save-glb')), 's_i_&_LOD1.glb');
    const drawn = (await tab.picture()).at(stage.cx, stage.cy);
    const name = await tab.download(folder, () => tab.click('#save-picture'));
    assert.equal(name, 's_i_&_LOD1.png');
    const saved = decode(await readFile(join(folder, name)));
    assert.deepEqual([saved.width, saved.height], [Math.round(stage.width), Math.round(stage.height)], 'the whole canvas');
    near(saved.at(saved.width >> 1, saved.height >> 1), drawn.slice(0, 3), 3, 'as it is seen');
  },
  async 'fits a phone'(tab) {
    await tab.resize(390, 800);
    await tab.picture();
    assert.equal(await tab.evaluate('document.documentElement.scrollWidth <= innerWidth'), true, 'no scrolling sideways');
    const stage = await stageOf(tab);
    assert.ok(count(await tab.picture(), stage, isModel) > 0.01 * stage.width * stage.height);
  },
  async 'never asks the network'(tab) {
    assert.deepEqual(tab.requests.filter((request) => request !== url && !/^(data|blob):/.test(request)), []);
    assert.ok(tab.requests.includes(url), 'requests are heard');
    assert.deepEqual(tab.troubles, []);
  },
};

/** Runs `work` with a tab; what is seen when it fails goes to PAGE.failed.png. */
async function browse(flags, work) {
  const browser = await Chromium.start(program, flags);
  try {
    const tab = await browser.open(url, 900, 560);
    await work(tab).catch(async (error) => {
      const { data } = await tab.send('Page.captureScreenshot', { format: 'png' });
      await writeFile(`${page}.failed.png`, Buffer.from(data, 'base64'));
      throw error;
    });
  } finally {
    await browser.close();
  }
}

await browse(softwareGl, async (tab) => {
  await tab.until('document.getElementById("canvas").dataset.drawn');
  const stage = await stageOf(tab);
  for (const [name, step] of Object.entries(steps)) {
    console.log(name);
    await step(tab, stage);
  }
});
await browse(['--disable-3d-apis'], async (tab) => {
  console.log('says so without WebGL');
  await tab.until('document.getElementById("message").innerText.includes("WebGL 2 is missing")');
  assert.equal(await tab.evaluate('document.querySelectorAll("#levels tbody tr").length'), 3, 'the rest is there');
});
console.log('all is well');
