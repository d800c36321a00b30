// A level of the page as a .glb: glTF 2.0, binary. Positions are as exact as the page has them.

const float = 5126, uint16 = 5123, uint32 = 5125;
const arrayBuffer = 34962, elementArrayBuffer = 34963;

/** The binary chunk, and what the JSON says of it. */
class Chunk {
  views = [];
  accessors = [];
  #parts = [];
  #length = 0;

  /** @param {ArrayBufferView} data @returns {number} of its view */
  view(data, more = {}) {
    const bytes = new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
    this.views.push({ buffer: 0, byteOffset: this.#length, byteLength: bytes.length, ...more });
    const padding = new Uint8Array((4 - bytes.length % 4) % 4);
    this.#parts.push(bytes, padding);
    this.#length += bytes.length + padding.length;
    return this.views.length - 1;
  }

  /** @returns {number} of its accessor */
  accessor(data, componentType, type, count, { target = arrayBuffer, ...more } = {}) {
    this.accessors.push({ bufferView: this.view(data, { target }), componentType, type, count, ...more });
    return this.accessors.length - 1;
  }

  get length() { return this.#length; }
  get parts() { return this.#parts; }
}

const toLinear = (display) => (display <= 0.04045 ? display / 12.92 : ((display + 0.055) / 1.055) ** 2.4);

/** About the middle of the cube, which becomes the place of the node: floats keep their digits far from the origin too. */
function positions(place, size) {
  const count = place.length / 4;
  const data = new Float32Array(3 * count);
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < count; ++i)
    for (let k = 0; k < 3; ++k) {
      const value = Math.fround((place[4 * i + k] / 65535 - 0.5) * size);
      data[3 * i + k] = value;
      min[k] = Math.min(min[k], value);
      max[k] = Math.max(max[k], value);
    }
  return { data, count, min, max };
}

/** Unit vectors out of bytes; `w` goes with them as a sign. */
function directions(bytes, count, size) {
  const data = new Float32Array(size * count);
  for (let i = 0; i < count; ++i) {
    let [x, y, z] = bytes.subarray(4 * i, 4 * i + 3);
    if (!x && !y && !z) z = 1;
    const length = Math.hypot(x, y, z);
    data.set([x / length, y / length, z / length], size * i);
    if (size === 4) data[4 * i + 3] = bytes[4 * i + 3] < 0 ? -1 : 1;
  }
  return data;
}

/** glTF has linear light. */
function colours(bytes, count) {
  const linear = Uint16Array.from({ length: 256 }, (_, value) => Math.round(65535 * toLinear(value / 255)));
  const data = new Uint16Array(4 * count);
  for (let i = 0; i < count; ++i) {
    for (let k = 0; k < 3; ++k) data[4 * i + k] = linear[bytes[4 * i + k]];
    data[4 * i + 3] = 65535;
  }
  return data;
}

function pngOf(image) {
  const binary = atob(image.src.slice(image.src.indexOf(',') + 1));
  return Uint8Array.from(binary, (letter) => letter.charCodeAt(0));
}

function addTextures(json, chunk, material, images) {
  const add = (image) => {
    json.images.push({ bufferView: chunk.view(pngOf(image)), mimeType: 'image/png' });
    json.textures.push({ source: json.images.length - 1, sampler: 0 });
    return { index: json.textures.length - 1 };
  };
  const [colour, normal] = images;
  Object.assign(json, { images: [], textures: [], samplers: [{ magFilter: 9729, minFilter: 9987, wrapS: 33071, wrapT: 33071 }] });
  material.pbrMetallicRoughness.baseColorTexture = add(colour);
  if (normal) material.normalTexture = add(normal);
}

function withHeader(json, chunk) {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const padded = Math.ceil(text.length / 4) * 4;
  const head = new Uint8Array(28 + padded).fill(32);
  const numbers = new DataView(head.buffer);
  const put = (at, ...values) => values.forEach((value, k) => numbers.setUint32(at + 4 * k, value, true));
  put(0, 0x46546c67, 2, head.length + chunk.length, padded, 0x4e4f534a);
  head.set(text, 20);
  put(20 + padded, chunk.length, 0x004e4942);
  return new Blob([head, ...chunk.parts], { type: 'model/gltf-binary' });
}

const mostMaterials = 32;

/** Corners of the triangles of each plain colour, by that; null where corners of a triangle differ, or there are too many. */
function plainColours({ colour, corners }) {
  const parts = new Map();
  const of = (corner) => (colour[4 * corner] << 16) | (colour[4 * corner + 1] << 8) | colour[4 * corner + 2];
  for (let k = 0; k < corners.length; k += 3) {
    const triangle = corners.subarray(k, k + 3), first = of(triangle[0]);
    if (of(triangle[1]) !== first || of(triangle[2]) !== first) return null;
    if (!parts.has(first) && parts.size === mostMaterials) return null;
    parts.set(first, parts.get(first) ?? []).get(first).push(...triangle);
  }
  return parts;
}

const matt = (more = {}) => ({ pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 0.8, ...more } });

function plainMaterial(colour) {
  const factor = [colour >> 16, (colour >> 8) & 255, colour & 255].map((byte) => toLinear(byte / 255));
  return { name: `colour_${colour.toString(16).padStart(6, '0')}`, ...matt({ baseColorFactor: [...factor, 1] }) };
}

/**
 * Plain colours are materials: Blender 3.4 and Godot 3.2 show no colours of vertices.
 *
 * @param {any} scene its cube: lo, size @param {import('./levels.js').Arrays} arrays
 * @param {(HTMLImageElement|null)[]} images colours and normals of its texture @param {string} name
 * @returns {Blob}
 */
export function glbOf(scene, arrays, images, name) {
  const chunk = new Chunk();
  const { data, count, min, max } = positions(arrays.place, scene.size);
  const attributes = { POSITION: chunk.accessor(data, float, 'VEC3', count, { min, max }) };
  if (arrays.normal) attributes.NORMAL = chunk.accessor(directions(arrays.normal, count, 3), float, 'VEC3', count);
  const textured = Boolean(images[0] && arrays.coordinate);
  const plain = !textured && arrays.colour ? plainColours(arrays) : null;
  if (textured) {
    const coordinates = Float32Array.from(arrays.coordinate, (value) => value / 65535);
    attributes.TEXCOORD_0 = chunk.accessor(coordinates, float, 'VEC2', count);
    if (images[1] && arrays.normal) attributes.TANGENT = chunk.accessor(directions(arrays.tangent, count, 4), float, 'VEC4', count);
  } else if (arrays.colour && !plain) {
    attributes.COLOR_0 = chunk.accessor(colours(arrays.colour, count), uint16, 'VEC4', count, { normalized: true });
  }
  const parts = plain ? [...plain.values()].map((corners) => Uint32Array.from(corners)) : [arrays.corners];
  const materials = plain ? [...plain.keys()].map(plainMaterial) : [matt()];
  const primitives = parts.map((corners, material) => ({
    attributes, material, indices: chunk.accessor(corners, uint32, 'SCALAR', corners.length, { target: elementArrayBuffer }),
  }));
  const json = {
    asset: { version: '2.0', generator: `glcast ${scene.version}, the page of glcast view` },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ name, mesh: 0, translation: scene.lo.map((value) => value + scene.size / 2) }],
    meshes: [{ name, primitives }],
    materials,
  };
  if (textured) addTextures(json, chunk, materials[0], images);
  return withHeader({ ...json, accessors: chunk.accessors, bufferViews: chunk.views, buffers: [{ byteLength: chunk.length }] }, chunk);
}

/** Hands a file to the browser, which asks nobody: the page has no network. */
export function save(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
