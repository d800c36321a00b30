// What tools/view/packing.h writes: levels out of the page's own text.

/** @typedef {{name: string, triangles: number, vertices: number, bytes: number, meanError: number, p999Error: number,
 *   maxError: number, normalError: number, colourError: number, colourP999: number, unsupported: number, vertexMean: number,
 *   vertexMax: number, normals: boolean, colours: boolean, included: boolean, packedVertices?: number,
 *   texture?: {width: number, height: number, colour: number, normal: number}}} Level
 *   packedVertices: once cut along the seams of its texture; texture: numbers of its pictures, -1: none */
/** @typedef {{place: Uint16Array, normal: Int8Array|null, colour: Uint8Array|null, coordinate: Uint16Array|null,
 *   tangent: Int8Array|null, corners: Uint32Array}} Arrays
 *   place: x, y, z in the cube and the distance to level 0, each 0..65535; coordinate: 2 a vertex; the others 4. */

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

  /** Four a vertex, of which the last may be padding. */
  bytesOf(target, count, kinds = 3) {
    for (let k = 0; k < kinds; ++k) {
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
  const vertices = level.packedVertices ?? level.vertices;
  const place = new Uint16Array(4 * vertices);
  for (let k = 0; k < 4; ++k) from.numbers(place, k, 4, vertices);
  const normal = level.normals ? from.bytesOf(new Int8Array(4 * vertices), vertices) : null;
  const colour = level.colours ? from.bytesOf(new Uint8Array(4 * vertices), vertices) : null;
  const coordinate = level.texture ? new Uint16Array(2 * vertices) : null;
  for (let k = 0; coordinate && k < 2; ++k) from.numbers(coordinate, k, 2, vertices);
  const tangent = level.texture ? from.bytesOf(new Int8Array(4 * vertices), vertices, 4) : null;
  const corners = new Uint32Array(3 * level.triangles);
  from.numbers(corners, 0, 1, corners.length);
  return { place, normal, colour, coordinate, tangent, corners };
}

const pictures = new Map();

/** @param {number} number of a picture of the page, -1: none @returns {Promise<HTMLImageElement|null>} each read once */
export function readPicture(number) {
  if (number < 0) return Promise.resolve(null);
  if (!pictures.has(number)) {
    const text = document.getElementById(`picture-${number}`);
    const image = new Image();
    image.src = `data:image/png;base64,${text.textContent}`;
    text.remove();
    pictures.set(number, image.decode().then(() => image));
  }
  return pictures.get(number);
}
