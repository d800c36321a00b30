// docs/guide/tutorial.md: casts of three programs on one floor, each drawn by the coarsest level that is good enough from where one looks.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

const casts = [ // file, place on the floor, how to stand it up
  { file: '../../../out/gears.glb', x: -2.3, turn: [0, 0.5, 0] },
  { file: '../../../out/rings.glb', x: 0, turn: [Math.PI, 0.4, 0] },
  { file: '../../../out/cow.glb', x: 2.3, turn: [0, -0.6, 0] },
];

/** All levels of a .glb: three.js loads the first, MSFT_lod names the others. */
async function levelsOf(file) {
  const gltf = await new GLTFLoader().loadAsync(file);
  const { parser } = gltf;
  const node = parser.json.nodes[0];
  const ids = [0, ...(node.extensions?.MSFT_lod?.ids ?? [])];
  const coverage = node.extras?.MSFT_screencoverage ?? ids.map((_, k) => 0.3 / 4 ** k);
  const levels = await Promise.all(ids.map((id) => parser.getDependency('node', id)));
  return levels.map((level, k) => ({ level, from: coverage[k] ?? 0, triangles: trianglesOf(level) }));
}

function trianglesOf(object) {
  let count = 0;
  object.traverse(({ geometry }) => { count += geometry ? (geometry.index ?? geometry.attributes.position).count / 3 : 0; });
  return count;
}

/** Stands on the floor, about 2 wide. */
function placed(levels, { x, turn }) {
  const turned = new THREE.Group(), whole = new THREE.Group();
  for (const { level } of levels) turned.add(level);
  turned.rotation.set(...turn);
  whole.add(turned);
  const box = new THREE.Box3().setFromObject(turned);
  const size = box.getSize(new THREE.Vector3());
  const scale = 2 / Math.max(size.x, size.y, size.z);
  whole.scale.setScalar(scale);
  const centre = box.getCenter(new THREE.Vector3());
  whole.position.set(x - centre.x * scale, -box.min.y * scale, -centre.z * scale);
  whole.traverse((object) => { object.castShadow = object.receiveShadow = true; });
  return whole;
}

/** Shares of the screen's height; the last level is kept whatever the distance. */
function choose(cast, camera) {
  const distance = camera.position.distanceTo(cast.middle);
  const share = 1 / (distance * Math.tan(THREE.MathUtils.degToRad(camera.fov / 2)));
  let chosen = cast.levels.findIndex(({ from }) => share * share >= from);
  if (chosen < 0) chosen = cast.levels.length - 1;
  cast.levels.forEach(({ level }, k) => { level.visible = k === chosen; });
  return cast.levels[chosen];
}

function litScene() {
  const scene = new THREE.Scene();
  scene.background = new THREE.Color('#dfe5ea');
  scene.add(new THREE.HemisphereLight('#ffffff', '#9aa4ab', 1.6));
  const sun = new THREE.DirectionalLight('#fff4e0', 2.6);
  sun.position.set(-3, 6, 4);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  sun.shadow.normalBias = 0.03;
  Object.assign(sun.shadow.camera, { left: -5, right: 5, top: 5, bottom: -5 });
  scene.add(sun);
  const floor = new THREE.Mesh(new THREE.PlaneGeometry(60, 60), new THREE.MeshStandardMaterial({ color: '#cfd6da' }));
  floor.rotation.x = -Math.PI / 2;
  floor.receiveShadow = true;
  scene.add(floor);
  return scene;
}

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.shadowMap.enabled = true;
document.body.append(renderer.domElement);
const scene = litScene();
const distance = Number(new URLSearchParams(location.search).get('distance') ?? 5.4);
const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 200);
camera.position.set(0, 0.38 * distance, distance);
const controls = new OrbitControls(camera, renderer.domElement);
controls.target.set(0, 0.8, 0);
controls.update();

const shown = await Promise.all(casts.map(async (cast) => {
  const levels = await levelsOf(cast.file);
  scene.add(placed(levels, cast));
  return { levels, middle: new THREE.Vector3(cast.x, 1, 0), name: cast.file.split('/').pop() };
}));

function draw() {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
  const lines = shown.map((cast) => `${cast.name}: ${choose(cast, camera).triangles.toLocaleString('en')} triangles`);
  document.getElementById('told').textContent = lines.join('\n');
  renderer.render(scene, camera);
  document.body.dataset.drawn = 'yes';
}

controls.addEventListener('change', draw);
addEventListener('resize', draw);
draw();
