// The page of `glcast view`: reads its own data, shows it, and follows mouse, touch and keys.
import { glbOf, save } from './glb.js';
import { readLevel, readPicture, readScene } from './levels.js';
import { fillTable, markLevel, press, showLegend, showTexture } from './panel.js';
import { Stage } from './scene.js';
import { Pose, key, listen } from './turning.js';
import { dressViews, markView, showViews } from './views.js';

const byId = (id) => document.getElementById(id);

function tell(text) {
  const message = byId('message');
  message.replaceChildren();
  if (!text) return;
  const line = document.createElement('p');
  line.textContent = text;
  message.append(line);
}

class Page {
  constructor(scene) {
    this.scene = scene;
    this.pose = new Pose();
    this.mode = 'colour';
    this.loaded = new Map();
    this.included = scene.levels.map((level, index) => index).filter((index) => scene.levels[index].included);
    this.current = this.included[0];
    this.stage = null;
  }

  describe() {
    const { scene } = this;
    document.title = `${scene.title} – glcast`;
    byId('title').textContent = scene.title;
    const { capture } = scene;
    byId('subtitle').textContent = capture
      ? `Frame ${capture.frame} of ${capture.program || 'a program'}, captured at n = ${capture.n}` : '';
    fillTable(scene, (index) => this.showLevel(index));
    this.views = showViews(scene, (view) => this.showView(view));
    dressViews(this.views, this.mode);
    const slider = byId('level');
    slider.max = String(this.included.length - 1);
    slider.disabled = this.included.length < 2;
    markLevel(scene, this.current);
  }

  start() {
    this.stage = new Stage(byId('canvas'), this.pose);
    listen(byId('canvas'), this.pose, () => this.turned());
    byId('level').addEventListener('input', (event) => this.showLevel(this.included[event.target.valueAsNumber]));
    for (const mode of ['colour', 'normal', 'error']) byId(`show-${mode}`).addEventListener('click', () => this.setMode(mode));
    byId('texture').addEventListener('click', () => this.toggleTexture());
    byId('wireframe').addEventListener('click', () => this.toggleWireframe());
    byId('save-glb').addEventListener('click', () => this.saveLevel());
    byId('save-picture').addEventListener('click', () => this.savePicture());
    byId('own-scale').addEventListener('change', () => this.updateErrors());
    document.addEventListener('keydown', (event) => this.keyed(event));
    return this.showLevel(this.current);
  }

  /** Levels are read when first shown; of quick slides the last one wins. */
  async showLevel(index) {
    this.current = index;
    byId('level').value = String(this.included.indexOf(index));
    markLevel(this.scene, index);
    if (!this.stage) return;
    const level = this.scene.levels[index];
    if (!this.loaded.has(index)) this.loaded.set(index, this.load(level, index));
    const meshes = await this.loaded.get(index);
    if (this.current !== index) return;
    this.stage.show(meshes);
    byId('canvas').dataset.level = String(index);
    for (const button of ['save-glb', 'save-picture']) byId(button).disabled = false;
    showTexture(level, this.stage.textured);
    this.updateErrors();
  }

  async load(level, index) {
    const { colour = -1, normal = -1 } = level.texture ?? {};
    const [arrays, ...images] = await Promise.all([readLevel(level, index), readPicture(colour), readPicture(normal)]);
    return { ...this.stage.meshes(level, arrays, images), arrays, images };
  }

  /** "gears_LOD1": of the file that is shown. */
  get name() {
    return `${this.scene.title.replace(/\.[^.]*$/, '').replace(/[\\/:*?"<>|]/g, '_')}_LOD${this.current}`;
  }

  async saveLevel() {
    const { name, current } = this;
    const { arrays, images } = await this.loaded.get(current);
    save(glbOf(this.scene, arrays, images, name), `${name}.glb`);
  }

  async savePicture() {
    const { name } = this;
    save(await this.stage.picture(), `${name}.png`);
  }

  setMode(mode) {
    this.mode = mode;
    for (const name of ['colour', 'normal', 'error']) press(`show-${name}`, name === mode);
    dressViews(this.views, mode);
    this.stage.setMode(mode);
    this.updateErrors();
  }

  updateErrors() {
    const { levels } = this.scene;
    const all = Math.max(...this.included.map((index) => levels[index].vertexMax));
    const largest = byId('own-scale').checked ? levels[this.current].vertexMax : all;
    this.stage.setErrorScale(largest);
    showLegend(this.scene, this.current, this.mode, largest);
  }

  toggleTexture() {
    const level = this.scene.levels[this.current];
    if (!level.texture) return;
    this.stage.textured = !this.stage.textured;
    showTexture(level, this.stage.textured);
    this.stage.draw();
  }

  toggleWireframe() {
    this.stage.wireframe = !this.stage.wireframe;
    press('wireframe', this.stage.wireframe);
    this.stage.draw();
  }

  showView(view) {
    if (!this.stage) return;
    this.pose.take(view);
    markView(this.views, view);
    this.stage.draw();
  }

  turned() {
    markView(this.views, null);
    this.stage.draw();
  }

  stepLevel(by) {
    const at = this.included.indexOf(this.current) + by;
    if (at >= 0 && at < this.included.length) this.showLevel(this.included[at]);
  }

  keyed(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.target === byId('level') && event.key.startsWith('Arrow')) return;
    const actions = {
      ',': () => this.stepLevel(-1), '.': () => this.stepLevel(1), w: () => this.toggleWireframe(),
      t: () => this.toggleTexture(),
      c: () => this.setMode('colour'), n: () => this.setMode('normal'), e: () => this.setMode('error'),
    };
    this.views.forEach((view, index) => { actions[index + 1] = () => this.showView(view); });
    if (Object.hasOwn(actions, event.key)) actions[event.key]();
    else if (key(event, this.pose)) this.turned();
    else return;
    event.preventDefault();
  }
}

async function open() {
  const page = new Page(readScene());
  page.describe();
  if (typeof DecompressionStream === 'undefined') {
    tell('This browser is too old to unpack the levels. Any browser of 2023 or later shows them.');
    return;
  }
  try {
    await page.start();
  } catch (error) {
    console.error(error);
    tell(byId('canvas').getContext('webgl2') ? `The cast cannot be shown: ${error.message}`
      : 'The cast cannot be shown, as WebGL 2 is missing here. Switch on hardware acceleration in the browser’s settings, '
        + 'or open this page in another browser.');
    document.body.classList.add('no-webgl');
  }
}

byId('canvas').addEventListener('webglcontextlost', () => tell('The graphics driver gave up on this page; reload it.'));
byId('canvas').addEventListener('webglcontextrestored', () => tell(''));
open();
