// What tools/view/packing.h writes: levels out of the page's own text.

/** @typedef {{name: string, triangles: number, vertices: number, bytes: number, meanError: number, maxError: number,
 *   vertexMean: number, vertexMax: number, normals: boolean, colours: boolean, included: boolean}} Level */
/** @typedef {{place: Uint16Array, normal: Int8Array|null, colour: Uint8Array|null, corners: Uint32Array}} Arrays
 *   place: x, y, z in the cube and the distance to level 0, each 0..65535; the others padded to 4 a vertex. */

/** @returns {any} what tools/view/page.cpp says of the page */
export function readScene() {
  return JSON.parse(document.getElementById('scene').textContent);
}

function fromBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Differences to the number before, one kind after the other. */
class Differences {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  numbers(target, from, step, count) {
    const { bytes } = this;
    let at = this.at;
    let last = 0;
    for (let i = 0, to = from; i < count; ++i, to += step) {
      let zigzag = 0;
      for (let unit = 1; ; unit *= 128) {
        const byte = bytes[at++];
        zigzag += (byte & 127) * unit;
        if (byte < 128) break;
      }
      last += zigzag % 2 ? -(zigzag + 1) / 2 : zigzag / 2;
      target[to] = last;
    }
    this.at = at;
  }

  triples(target, count) {
    for (let k = 0; k < 3; ++k) {
      let last = 0;
      for (let i = 0; i < count; ++i) target[4 * i + k] = last += this.bytes[this.at++];
    }
    return target;
  }
}

/** @param {Level} level @returns {Promise<Arrays>} */
export async function readLevel(level, index) {
  const text = document.getElementById(`level-${index}`);
  const from = new Differences(await inflated(fromBase64(text.textContent)));
  text.remove(); // the arrays stay, the text need not
  const { vertices } = level;
  const place = new Uint16Array(4 * vertices);
  for (let k = 0; k < 4; ++k) from.numbers(place, k, 4, vertices);
  const normal = level.normals ? from.triples(new Int8Array(4 * vertices), vertices) : null;
  const colour = level.colours ? from.triples(new Uint8Array(4 * vertices), vertices) : null;
  const corners = new Uint32Array(3 * level.triangles);
  from.numbers(corners, 0, 1, corners.length);
  return { place, normal, colour, corners };
}
