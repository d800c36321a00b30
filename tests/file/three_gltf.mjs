// node three_gltf.mjs CHROMIUM NODE_MODULES FILES...
// What three.js's own GLTFLoader makes of .glb files in a browser, as one JSON array: counts, bounds, and the colour that a
// picture from +z shows at (1, 0). With GLCAST_PICTURES the pictures are left in that folder.
import { readFile, writeFile, mkdtemp, rm } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { basename, join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Chromium, softwareGl } from '../view/chromium.mjs';

const [program, modules, ...files] = process.argv.slice(2);
const size = 300, half = 1.5; // pixels; model units seen to either side

const script = `
import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js';

window.load = async (base64) => {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
  const { scene } = await loader.parseAsync(bytes.buffer, '');
  const meshes = [];
  scene.traverse((object) => { if (object.isMesh) meshes.push(object); });
  const box = new THREE.Box3().setFromObject(scene, true);
  const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
  renderer.setSize(${size}, ${size});
  document.body.replaceChildren(renderer.domElement);
  const camera = new THREE.OrthographicCamera(-${half}, ${half}, ${half}, -${half}, 0.1, 10);
  camera.position.z = 5;
  const world = new THREE.Scene();
  world.add(scene, new THREE.AmbientLight(0xffffff, Math.PI));
  renderer.render(world, camera);
  const gl = renderer.getContext(), pixel = new Uint8Array(4);
  gl.readPixels(${size / 2 + size / 2 / half}, ${size / 2}, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
  const { geometry, material } = meshes[0];
  const image = (texture) => texture ? [texture.image.width, texture.image.height] : null;
  return { meshes: meshes.length, triangles: geometry.index.count / 3, vertices: geometry.attributes.position.count,
    lo: box.min.toArray(), hi: box.max.toArray(), colour: [...pixel], attributes: Object.keys(geometry.attributes),
    map: image(material.map), normalMap: image(material.normalMap), extras: geometry.userData.meanError ?? meshes[0].userData.meanError };
};
window.ready = true;`;

const esbuild = createRequire(join(resolve(modules), 'none.js'))('esbuild');
const built = await esbuild.build({ stdin: { contents: script, resolveDir: resolve(modules, '..') }, bundle: true, write: false,
  format: 'iife', target: 'es2022', nodePaths: [resolve(modules)], logLevel: 'warning', charset: 'utf8' });
const folder = await mkdtemp(join(tmpdir(), 'glcast-three-'));
const page = join(folder, 'page.html');
await writeFile(page, `<!doctype html><meta charset="utf-8"><body style="margin:0"><script>\n${built.outputFiles[0].text.replaceAll('</script', '<\\/script')}</script>`);
const browser = await Chromium.start(program, softwareGl);
try {
  const tab = await browser.open(pathToFileURL(page).href, size, size);
  await tab.until('window.ready');
  const found = [];
  for (const file of files) {
    const base64 = (await readFile(file)).toString('base64');
    found.push(await tab.evaluate(`load(${JSON.stringify(base64)})`));
    if (process.env.GLCAST_PICTURES) {
      const { data } = await tab.send('Page.captureScreenshot', { format: 'png' });
      await writeFile(join(process.env.GLCAST_PICTURES, `${basename(file)}.png`), Buffer.from(data, 'base64'));
    }
  }
  if (tab.troubles.length) throw new Error(tab.troubles.join('\n'));
  console.log(JSON.stringify(found));
} finally {
  await browser.close();
  await rm(folder, { recursive: true, force: true });
}
