// What tests of the page look at: the canvas, and pixels of it.
import assert from 'node:assert/strict';

export const background = [238, 241, 243];

export function near(pixel, wanted, within, what) {
  const off = Math.max(...wanted.map((value, k) => Math.abs(value - pixel[k])));
  assert.ok(off <= within, `${what}: ${pixel} instead of ${wanted}`);
}

export async function stageOf(tab) {
  const { x, y, width, height } = await tab.rectangle('#canvas');
  return { x, y, width, height, cx: Math.round(x + width / 2), cy: Math.round(y + height / 2) };
}

/** Pixels of the canvas that meet a condition, of every third in both directions. */
export function count(picture, stage, condition) {
  let found = 0;
  for (let y = 60; y < stage.height - 60; y += 3)
    for (let x = 0; x < stage.width; x += 3) if (condition(picture.at(Math.round(stage.x) + x, Math.round(stage.y) + y))) ++found;
  return found;
}

export const isModel = (p) => Math.abs(p[0] - background[0]) + Math.abs(p[1] - background[1]) + Math.abs(p[2] - background[2]) > 30;
