// node glb_test.mjs: what the page's button for a .glb writes of a level without a texture.
import assert from 'node:assert/strict';
import { glbOf } from '../../tools/view/page/glb.js';

const red = [204, 26, 0, 255], blue = [51, 51, 255, 255];
const scene = { version: '0', lo: [0, 0, 0], size: 2 };

/** Two triangles of three vertices each. */
function arraysOf(colours) {
  return {
    place: Uint16Array.from([0, 0, 0, 0, 65535, 0, 0, 0, 0, 65535, 0, 0, 0, 0, 65535, 0, 65535, 0, 65535, 0, 0, 65535, 65535, 0]),
    colour: Uint8Array.from(colours.flat()), corners: Uint32Array.from([0, 1, 2, 3, 4, 5]),
  };
}

async function jsonOf(colours) {
  const bytes = new Uint8Array(await glbOf(scene, arraysOf(colours), [null, null], 'a').arrayBuffer());
  const length = new DataView(bytes.buffer).getUint32(12, true);
  return JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
}

const plain = await jsonOf([red, red, red, blue, blue, blue]);
assert.equal(plain.meshes[0].primitives.length, 2);
assert.deepEqual(plain.materials.map((material) => material.name), ['colour_cc1a00', 'colour_3333ff']);
for (const { attributes } of plain.meshes[0].primitives) assert.ok(!('COLOR_0' in attributes), 'viewers multiply the two');
const corners = plain.meshes[0].primitives.reduce((sum, { indices }) => sum + plain.accessors[indices].count, 0);
assert.equal(corners, 6);

const mixed = await jsonOf([red, red, blue, blue, blue, blue]);
assert.equal(mixed.meshes[0].primitives.length, 1);
assert.ok('COLOR_0' in mixed.meshes[0].primitives[0].attributes);
assert.ok(!('baseColorFactor' in mixed.materials[0].pbrMetallicRoughness));
console.log('passed');
