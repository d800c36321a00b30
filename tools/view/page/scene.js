// The levels in three.js, drawn when something changed.
import {
  BufferAttribute, BufferGeometry, DoubleSide, GLSL3, Group, Matrix3, Matrix4, Mesh, OrthographicCamera, RawShaderMaterial,
  Scene, Texture, WebGLRenderer,
} from 'three';
import { fragmentShader, modes, vertexShader, wireFragmentShader } from './shading.js';

const background = 0xeef1f3;

function geometryOf(arrays) {
  const geometry = new BufferGeometry();
  const { place, normal, colour, coordinate, tangent, corners } = arrays;
  geometry.setAttribute('place', new BufferAttribute(place, 4, true));
  geometry.setAttribute('position', geometry.getAttribute('place')); // where three.js looks for a count
  if (normal) geometry.setAttribute('normal', new BufferAttribute(normal, 4, true));
  if (colour) geometry.setAttribute('colour', new BufferAttribute(colour, 4, true));
  if (coordinate) {
    geometry.setAttribute('coordinate', new BufferAttribute(coordinate, 2, true));
    geometry.setAttribute('tangent', new BufferAttribute(tangent, 4, true));
  }
  geometry.setIndex(new BufferAttribute(corners, 1));
  return geometry;
}

const maps = new Map();

/** One for each picture, however many levels share it. */
function mapOf(image, anisotropy) {
  if (image && !maps.has(image)) {
    const map = new Texture(image);
    map.flipY = false; // coordinates count from the top left
    map.anisotropy = anisotropy;
    map.needsUpdate = true;
    maps.set(image, map);
  }
  return maps.get(image) ?? null;
}

/** Draws one level at a time. Throws where there is no WebGL 2. */
export class Stage {
  #renderer;
  #canvas;
  #scene = new Scene();
  #camera = new OrthographicCamera(-1, 1, 1, -1, -10, 10);
  #turned = new Group();
  #shown = null;
  #waiting = false;
  #uniforms = {
    mode: { value: modes.colour }, hasNormals: { value: false }, hasColours: { value: false },
    distanceScale: { value: 0 }, turn: { value: new Matrix3() }, colourMap: { value: null }, normalMap: { value: null },
    textured: { value: false }, bent: { value: false },
  };
  #surface = new RawShaderMaterial({
    uniforms: this.#uniforms, vertexShader, fragmentShader, glslVersion: GLSL3, side: DoubleSide,
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
  });
  #lines = new RawShaderMaterial({
    vertexShader, fragmentShader: wireFragmentShader, glslVersion: GLSL3, wireframe: true,
  });

  constructor(canvas, pose) {
    this.#canvas = canvas;
    this.pose = pose;
    this.wireframe = false;
    this.textured = true;
    this.#renderer = new WebGLRenderer({ canvas, antialias: true });
    this.#renderer.setClearColor(background, 1);
    this.#turned.matrixAutoUpdate = false;
    this.#scene.add(this.#turned);
    new ResizeObserver(() => this.draw()).observe(canvas);
    canvas.addEventListener('webglcontextrestored', () => this.draw());
  }

  /** @param {import('./levels.js').Level} level @param {(HTMLImageElement|null)[]} images colours and normals */
  meshes(level, arrays, images) {
    const geometry = geometryOf(arrays);
    const pair = [new Mesh(geometry, this.#surface), new Mesh(geometry, this.#lines)];
    for (const mesh of pair) {
      mesh.frustumCulled = false;
      mesh.matrixAutoUpdate = false;
    }
    const anisotropy = Math.min(8, this.#renderer.capabilities.getMaxAnisotropy());
    const [colourMap, normalMap] = images.map((image) => mapOf(image, anisotropy));
    return { level, pair, colourMap, normalMap };
  }

  show(meshes) {
    this.#shown = meshes;
    this.#turned.clear();
    this.#turned.add(...meshes.pair);
    this.#uniforms.hasNormals.value = meshes.level.normals;
    this.#uniforms.hasColours.value = meshes.level.colours;
    this.#uniforms.colourMap.value = meshes.colourMap;
    this.#uniforms.normalMap.value = meshes.normalMap;
    this.draw();
  }

  setMode(name) {
    this.#uniforms.mode.value = modes[name];
    this.draw();
  }

  /** @param {number} largest the distance at the end of the ramp, model units */
  setErrorScale(largest) {
    this.#uniforms.distanceScale.value = largest > 0 && this.#shown ? this.#shown.level.vertexMax / largest : 0;
    this.draw();
  }

  /** What is on the canvas, as a PNG. Drawn anew: between frames a canvas may be empty. @returns {Promise<Blob>} */
  picture() {
    this.#drawNow();
    return new Promise((done) => this.#canvas.toBlob(done, 'image/png'));
  }

  draw() {
    if (this.#waiting) return;
    this.#waiting = true;
    requestAnimationFrame(() => {
      this.#waiting = false;
      this.#drawNow();
    });
  }

  #drawNow() {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (!width || !height || !this.#shown) return;
    this.#renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.#renderer.setSize(width, height, false);
    const { halfHeight, x, y } = this.pose;
    const half = halfHeight * Math.max(1, height / width);
    Object.assign(this.#camera, {
      left: x - half * width / height, right: x + half * width / height, bottom: y - half, top: y + half });
    this.#camera.updateProjectionMatrix();
    // Levels lie in the cube 0..1; it is turned about its centre.
    const rotation = new Matrix4().makeRotationFromQuaternion(this.pose.turn);
    this.#turned.matrix.copy(rotation).multiply(new Matrix4().makeTranslation(-0.5, -0.5, -0.5));
    this.#turned.matrixWorldNeedsUpdate = true;
    this.#uniforms.turn.value.setFromMatrix4(rotation);
    this.#shown.pair[1].visible = this.wireframe;
    this.#uniforms.textured.value = this.textured && this.#shown.colourMap !== null;
    this.#uniforms.bent.value = this.textured && this.#shown.normalMap !== null;
    this.#renderer.render(this.#scene, this.#camera);
    this.#canvas.dataset.drawn = String(Number(this.#canvas.dataset.drawn ?? 0) + 1);
  }
}
