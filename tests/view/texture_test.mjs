// node texture_test.mjs CHROMIUM PAGE.html
// The page of browser_test.cpp whose ball is textured: seen from +z green on the left and yellow on the right, with normals
// that lean to the right; red and blue where the colours of the vertices show. Ends with 1 when anything is not so.
import assert from 'node:assert/strict';
import { dirname } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Chromium, softwareGl } from './chromium.mjs';
import { near, stageOf } from './stage.mjs';

const [program, page] = process.argv.slice(2);
const url = pathToFileURL(page).href;
const green = [0, 200, 0], yellow = [230, 200, 0], red = [230, 26, 26], blue = [26, 26, 230];

/** Colours alone, whatever the light does. */
function hue(pixel, wanted, what) {
  const scale = Math.max(...wanted) / Math.max(...pixel);
  near(pixel.map((value) => value * scale), wanted, 14, what);
}

async function sides(tab, stage) {
  const picture = await tab.picture();
  return [picture.at(stage.cx - 40, stage.cy), picture.at(stage.cx + 40, stage.cy)];
}

const steps = {
  async 'nothing sticks out of the panel'(tab) {
    const inside = await tab.evaluate(`(() => {
      const panel = document.querySelector('aside');
      const right = panel.getBoundingClientRect().right - parseFloat(getComputedStyle(panel).paddingRight);
      return [...panel.querySelectorAll('button')].map((b) => right - b.getBoundingClientRect().right); })()`);
    assert.ok(inside.length > 5 && Math.min(...inside) > -0.5, `room to the right of each button: ${inside}`);
  },
  async 'shows the texture first'(tab, stage) {
    await tab.click('#view-6');
    const [left, right] = await sides(tab, stage);
    hue(left, green, 'left');
    hue(right, yellow, 'right');
    assert.equal(await tab.evaluate('document.getElementById("texture").getAttribute("aria-pressed")'), 'true');
    assert.equal(await tab.evaluate('document.getElementById("texture").title'), '64 × 64 pixels');
  },
  async 'saves it with its pictures'(tab) {
    assert.equal(await tab.download(dirname(page), () => tab.click('#save-glb')), 'textured_LOD0.glb');
  },
  async 'top and bottom are not turned over'(tab, stage) {
    const picture = await tab.picture();
    const [top, bottom] = [picture.at(stage.cx - 10, stage.cy - 120), picture.at(stage.cx - 10, stage.cy + 120)];
    assert.ok(top[2] > bottom[2] + 30, `blue is at the top of the picture: ${top} ${bottom}`);
  },
  async 'the normal map turns the light'(tab, stage) {
    // The map leans every normal by 45 degrees to the right: there the ball faces away, on the left it faces us.
    const [left, right] = await sides(tab, stage);
    assert.ok(Math.max(...left) / 200 > Math.max(...right) / 230 + 0.1, `${left} ${right}`);
    await tab.click('#show-normal');
    near((await tab.picture()).at(stage.cx, stage.cy), [217, 128, 217], 8, 'leaning');
    await tab.click('#texture');
    near((await tab.picture()).at(stage.cx, stage.cy), [128, 128, 255], 6, 'of the vertices');
    await tab.click('#show-colour');
  },
  async 'colours of the vertices instead'(tab, stage) {
    const [left, right] = await sides(tab, stage);
    hue(left, blue, 'left');
    hue(right, red, 'right');
    assert.equal(await tab.evaluate('document.getElementById("texture").getAttribute("aria-pressed")'), 'false');
    await tab.key('t', 'KeyT');
    hue((await sides(tab, stage))[0], green, 'and back by key');
  },
  async 'a coarser level shares the pictures'(tab, stage) {
    await tab.key('.', 'Period');
    await tab.until('document.getElementById("canvas").dataset.level === "1"');
    const [left, right] = await sides(tab, stage);
    hue(left, green, 'left');
    hue(right, yellow, 'right');
  },
  async 'a level without one says so'(tab, stage) {
    await tab.key('.', 'Period');
    await tab.until('document.getElementById("canvas").dataset.level === "2"');
    hue((await sides(tab, stage))[1], red, 'right');
    assert.equal(await tab.evaluate('document.getElementById("texture").disabled'), true);
  },
  async 'the certificate is in the table'(tab) {
    const head = await tab.evaluate('[...document.querySelectorAll("#levels th")].map((cell) => cell.textContent)');
    assert.deepEqual(head, ['Level', 'Triangles', 'Size', 'Mean error', '99.9 %', 'Max', 'Normals', 'Colours']);
    const row = await tab.evaluate('[...document.querySelectorAll("#levels tbody tr")[1].cells].map((cell) => cell.textContent)');
    assert.deepEqual(row.slice(3), ['0.010', '0.020', '0.030', '4.0°', '0.050']);
    assert.match(await tab.evaluate('document.getElementById("note").textContent'), /6\.0 % of the surface was seen by no ray/);
  },
  async 'never asks the network'(tab) {
    assert.deepEqual(tab.requests.filter((request) => request !== url && !/^(data|blob):/.test(request)), []);
    assert.deepEqual(tab.troubles, []);
  },
};

const browser = await Chromium.start(program, softwareGl);
try {
  const tab = await browser.open(url, 940, 560);
  await tab.until('document.getElementById("canvas").dataset.drawn');
  const stage = await stageOf(tab);
  for (const [name, step] of Object.entries(steps)) {
    console.log(name);
    await step(tab, stage);
  }
} finally {
  await browser.close();
}
console.log('all is well');
