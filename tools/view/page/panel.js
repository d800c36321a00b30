// Slider, table and legend beside the cast.
import { ramp } from './shading.js';

const byId = (id) => document.getElementById(id);
const counted = new Intl.NumberFormat('en');

export function bytes(count) {
  const units = ['B', 'kB', 'MB', 'GB'];
  let k = 0;
  let value = count;
  for (; value >= 999.5 && k < units.length - 1; ++k) value /= 1000;
  return `${k === 0 || value >= 99.5 ? Math.round(value) : value.toPrecision(2)} ${units[k]}`;
}

/** A length in samples where the sample is known, else in the model's units. */
export function lengthIn(scene) {
  const unit = scene.sample > 0 ? scene.sample : 1;
  return (length) => {
    const value = length / unit;
    if (value === 0) return '0';
    if (value < 1e-4) return value.toExponential(0);
    return value < 99.5 ? value.toPrecision(2) : Math.round(value).toString();
  };
}

export const unitName = (scene) => (scene.sample > 0 ? 'samples' : 'units');

function cell(row, kind, text) {
  const element = document.createElement(kind);
  element.textContent = text;
  row.append(element);
}

function addHead(table, names) {
  const row = table.createTHead().insertRow();
  for (const name of names) cell(row, 'th', name);
  for (const head of row.cells) head.scope = 'col';
}

/** For the keyboard: the whole row can be clicked, but not reached by Tab. */
function addPick(row, index) {
  const button = document.createElement('button');
  button.className = 'pick';
  button.textContent = String(index);
  button.setAttribute('aria-label', `Show level ${index}`);
  row.cells[0].replaceChildren(button);
}

const short = (value) => (value === 0 ? '0' : value < 1e-4 ? value.toExponential(0) : value.toPrecision(2));

/** What is known of the errors of any level; what nobody measured has no column. */
function columnsOf(scene) {
  const length = lengthIn(scene);
  const known = (name) => scene.levels.some((level) => level[name] > 0);
  return [
    { head: 'Mean error', value: (level) => length(level.meanError) },
    known('p999Error') && { head: '99.9 %', value: (level) => length(level.p999Error) },
    { head: 'Max', value: (level) => length(level.maxError) },
    known('normalError') && { head: 'Normals', value: (level) => `${short(level.normalError)}°` },
    known('colourP999') && { head: 'Colours', value: (level) => short(level.colourError) },
  ].filter(Boolean);
}

/** @param {(index: number) => void} choose */
export function fillTable(scene, choose) {
  const table = byId('levels');
  const columns = columnsOf(scene);
  addHead(table, ['Level', 'Triangles', 'Size', ...columns.map(({ head }) => head)]);
  const body = table.createTBody();
  scene.levels.forEach((level, index) => {
    const row = body.insertRow();
    row.className = level.included ? '' : 'absent';
    const errors = columns.map(({ value }) => (index === 0 ? '–' : value(level)));
    row.title = level.included ? level.name : `${level.name}: not in this page`;
    for (const text of [String(index), counted.format(level.triangles), bytes(level.bytes), ...errors]) cell(row, 'td', text);
    if (!level.included) return;
    addPick(row, index);
    row.addEventListener('click', () => choose(index));
  });
  byId('note').textContent = noteOn(scene);
}

function noteOn(scene) {
  const absent = scene.levels.filter((level) => !level.included).length;
  const parts = ['Size: as a .glb of its own.'];
  if (scene.levels.length > 1) {
    const sample = scene.sample > 0 ? ` (a sample is ${Number(scene.sample.toPrecision(4))} units)` : '';
    parts.push(`Errors: distance to level 0, both ways, in ${unitName(scene)}${sample}.`);
  }
  if (scene.levels.some((level) => level.normalError > 0)) parts.push('Normals: mean angle to those of level 0.');
  if (scene.levels.some((level) => level.colourP999 > 0)) parts.push('Colours: mean of the largest difference of a channel, of 1.');
  const unseen = scene.levels[0].unsupported;
  if (unseen > 0) parts.push(`${short(100 * unseen)} % of the surface was seen by no ray, and is filled in.`);
  if (absent > 0)
    parts.push(`${absent === 1 ? 'The grey level is' : 'Grey levels are'} left out of this page: more than ` +
      `${counted.format(scene.most)} triangles (glcast view --max-triangles).`);
  return parts.join(' ');
}

export function markLevel(scene, index) {
  [...byId('levels').tBodies[0].rows].forEach((row, k) => {
    row.classList.toggle('current', k === index);
    if (k === index) row.setAttribute('aria-current', 'true');
    else row.removeAttribute('aria-current');
  });
  const level = scene.levels[index];
  byId('level').setAttribute('aria-valuetext', `level ${index}, ${counted.format(level.triangles)} triangles`);
  byId('status').textContent = `Level ${index} · ${counted.format(level.triangles)} triangles · ${bytes(level.bytes)}`;
}

export function showLegend(scene, index, mode, largest) {
  byId('legend').hidden = mode !== 'error';
  byId('ramp').style.background = `linear-gradient(to right, ${ramp.join(', ')})`;
  byId('ramp-low').textContent = '0';
  byId('ramp-high').textContent = largest > 0 ? `${lengthIn(scene)(largest)} ${unitName(scene)}` : '';
  byId('legend-note').textContent = index === 0 ? 'Level 0 is what the others are measured against.'
    : 'Distance of each vertex to level 0.';
}

/** The button is there for levels that have a texture. */
export function showTexture(level, on) {
  const { texture } = level;
  byId('texture').disabled = !texture;
  byId('texture').title = texture ? `${texture.width} × ${texture.height} pixels` : 'this level has none';
  press('texture', Boolean(texture) && on);
}

export function press(id, on) {
  byId(id).setAttribute('aria-pressed', String(on));
}
