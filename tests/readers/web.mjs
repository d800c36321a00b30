// node web.mjs CHROMIUM NODE_MODULES three|model-viewer MESH OUT.png: what a page makes of a mesh file.
// Prints one line "found: {...}" and leaves a picture.
import { readFile, writeFile, mkdtemp, rm } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { extname, join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Chromium, softwareGl } from '../view/chromium.mjs';

const [program, modules, reader, file, out] = process.argv.slice(2);
const size = 320;

// A mesh of several materials becomes an object for each, in a group that has the mesh's name.
const asked = `
const owners = (meshes) => [...new Set(meshes.map((m) => m.parent?.isGroup && m.parent.name ? m.parent : m))].map((m) => m.name);
const coloured = (meshes) => meshes.some((m) => 'color' in m.geometry.attributes && [m.material].flat().every((one) => one.vertexColors)) ||
  new Set(meshes.flatMap((m) => [m.material].flat().map((one) => one.color.getHexString()))).size > 1;
`;

const three = `
${asked}
import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { OBJLoader } from 'three/examples/jsm/loaders/OBJLoader.js';
import { MTLLoader } from 'three/examples/jsm/loaders/MTLLoader.js';
import { PLYLoader } from 'three/examples/jsm/loaders/PLYLoader.js';
import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js';

const text = (bytes) => new TextDecoder().decode(bytes);

async function materials(name, siblings) {
  const bytes = siblings[name];
  if (!bytes) return null;
  const manager = new THREE.LoadingManager();
  manager.setURLModifier((url) => {
    const found = siblings[url.split('/').pop()];
    return found ? URL.createObjectURL(new Blob([found])) : url;
  });
  const loaded = new Promise((done) => { manager.onLoad = done; setTimeout(done, 5000); });
  const set = new MTLLoader(manager).parse(text(bytes), '');
  set.preload();
  await loaded;
  return set;
}

const readers = {
  '.glb': async (bytes) => (await new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).parseAsync(bytes.buffer, '')).scene,
  '.obj': async (bytes, siblings) => {
    const loader = new OBJLoader(), library = /^mtllib (.*)$/m.exec(text(bytes))?.[1];
    const set = library && await materials(library, siblings);
    if (set) loader.setMaterials(set);
    return loader.parse(text(bytes));
  },
  '.ply': async (bytes) => {
    const geometry = new PLYLoader().parse(bytes.buffer);
    return new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ vertexColors: 'color' in geometry.attributes }));
  },
};

window.load = async (extension, base64, others) => {
  const decode = (s) => Uint8Array.from(atob(s), (c) => c.charCodeAt(0));
  const siblings = Object.fromEntries(Object.entries(others).map(([name, s]) => [name, decode(s)]));
  const model = await readers[extension](decode(base64), siblings);
  const meshes = [];
  model.traverse((object) => { if (object.isMesh && object.visible) meshes.push(object); });
  const box = new THREE.Box3().setFromObject(model, true), centre = box.getCenter(new THREE.Vector3());
  const span = box.getSize(new THREE.Vector3()).length();
  const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true, antialias: true });
  renderer.setSize(${size}, ${size});
  renderer.setClearColor(0xbbbbbb);
  document.body.replaceChildren(renderer.domElement);
  const half = span * 0.475, camera = new THREE.OrthographicCamera(-half, half, half, -half, span * 0.05, span * 10);
  camera.position.copy(centre).add(new THREE.Vector3(0.5, 0.5, 0.7).normalize().multiplyScalar(2 * span));
  camera.lookAt(centre);
  const sun = new THREE.DirectionalLight(0xffffff, 2.2), world = new THREE.Scene();
  sun.position.set(0.2, 0.9, 0.5);
  world.add(model, sun, new THREE.AmbientLight(0xffffff, 1.2));
  renderer.render(world, camera);
  const image = (texture) => texture ? [[texture.image.width, texture.image.height]] : [];
  const each = (get) => meshes.flatMap((m) => [m.material].flat().flatMap(get));
  return { names: owners(meshes), hidden: 0,
    triangles: meshes.reduce((n, m) => n + (m.geometry.index ?? m.geometry.attributes.position).count / 3, 0),
    textures: each((m) => [...image(m.map), ...image(m.normalMap)]),
    colours: coloured(meshes),
    normals: meshes.length > 0 && meshes.every((m) => 'normal' in m.geometry.attributes) };
};
window.ready = true;`;

const viewer = `
${asked}
import '@google/model-viewer/dist/model-viewer.min.js';

window.load = async (extension, base64) => {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const view = document.createElement('model-viewer');
  Object.assign(view.style, { width: '${size}px', height: '${size}px', background: '#bbbbbb' });
  view.setAttribute('camera-orbit', '35deg 60deg auto');
  view.src = URL.createObjectURL(new Blob([bytes]));
  const loaded = new Promise((done, failed) => {
    view.addEventListener('load', done);
    view.addEventListener('error', (event) => failed(new Error(event.detail?.sourceError?.message ?? 'not loaded')));
  });
  document.body.replaceChildren(view);
  await loaded;
  await new Promise((done) => setTimeout(done, 3000));
  const scene = view[Object.getOwnPropertySymbols(view).find((s) => s.description === 'scene')], meshes = [];
  scene.traverse((object) => {
    if (object.isMesh && object.visible && object.geometry.index && object.geometry.index.count > 36) meshes.push(object);
  });
  const image = (texture) => texture ? [[texture.image.width, texture.image.height]] : [];
  return { names: owners(meshes), hidden: 0, triangles: meshes.reduce((n, m) => n + m.geometry.index.count / 3, 0),
    textures: meshes.flatMap((m) => [...image(m.material.map), ...image(m.material.normalMap)]),
    colours: coloured(meshes),
    normals: meshes.length > 0 && meshes.every((m) => 'normal' in m.geometry.attributes) };
};
window.ready = true;`;

/** The files beside an .obj that it may name. */
async function siblings() {
  if (extname(file) !== '.obj') return {};
  const { readdir } = await import('node:fs/promises');
  const folder = resolve(file, '..'), found = {};
  for (const name of await readdir(folder))
    if (/\.(mtl|png)$/.test(name)) found[name] = (await readFile(join(folder, name))).toString('base64');
  return found;
}

const esbuild = createRequire(join(resolve(modules), 'none.js'))('esbuild');
const built = await esbuild.build({ stdin: { contents: reader === 'three' ? three : viewer, resolveDir: resolve(modules, '..') },
  bundle: true, write: false, format: 'iife', target: 'es2022', nodePaths: [resolve(modules)], logLevel: 'error', charset: 'utf8' });
const folder = await mkdtemp(join(tmpdir(), 'glcast-readers-'));
const page = join(folder, 'page.html');
await writeFile(page, `<!doctype html><meta charset="utf-8"><body style="margin:0"><script>\n${built.outputFiles[0].text.replaceAll('</script', '<\\/script')}</script>`);
const browser = await Chromium.start(program, softwareGl);
try {
  const tab = await browser.open(pathToFileURL(page).href, size, size);
  await tab.until('window.ready');
  const base64 = (await readFile(file)).toString('base64');
  const found = await tab.evaluate(`load('${extname(file)}', '${base64}', ${JSON.stringify(await siblings())})`);
  const { data } = await tab.send('Page.captureScreenshot', { format: 'png' });
  await writeFile(out, Buffer.from(data, 'base64'));
  console.log(`found: ${JSON.stringify(found)}`);
} finally {
  await browser.close();
  await rm(folder, { recursive: true, force: true });
}
