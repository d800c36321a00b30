// Where one looks from: by mouse, touch and keys.
import { Matrix4, Quaternion, Vector3 } from 'three';

const fit = 0.62; // half the height seen, in cubes: a cast that fills its box has some room round it
const nearest = 0.005, farthest = 4;

export class Pose {
  constructor() { this.reset(); }

  reset() {
    this.turn = new Quaternion();
    this.turnBy(-0.5, 0.35);
    this.halfHeight = fit * 1.25;
    this.x = this.y = 0;
  }

  /** Radians about the screen's vertical axis, then about its horizontal one. */
  turnBy(vertical, horizontal) {
    const about = (axis, angle) => new Quaternion().setFromAxisAngle(axis, angle);
    this.turn.premultiply(about(new Vector3(0, 1, 0), vertical));
    this.turn.premultiply(about(new Vector3(1, 0, 0), horizontal)).normalize();
  }

  /** The stance of a captured view: three directions of the model, which come to lie along x, y and z of the screen. */
  take({ right, up, back }) {
    this.turn.setFromRotationMatrix(
      new Matrix4().makeBasis(new Vector3(...right), new Vector3(...up), new Vector3(...back)).transpose());
    this.halfHeight = fit;
    this.x = this.y = 0;
  }

  /** What lies at (x, y) of the screen's plane, in cubes from its centre, stays there. */
  zoomBy(factor, x = 0, y = 0) {
    const to = Math.min(Math.max(this.halfHeight * factor, nearest), farthest);
    const by = to / this.halfHeight;
    this.x += x * (1 - by);
    this.y += y * (1 - by);
    this.halfHeight = to;
  }

  moveBy(x, y) {
    this.x = Math.min(Math.max(this.x - x, -farthest), farthest);
    this.y = Math.min(Math.max(this.y - y, -farthest), farthest);
  }
}

const spread = ([a, b]) => Math.hypot(a.x - b.x, a.y - b.y);
const middle = (points) => ({
  x: points.reduce((sum, p) => sum + p.x, 0) / points.length, y: points.reduce((sum, p) => sum + p.y, 0) / points.length });

/** Cubes a CSS pixel. */
function pixelSize(canvas, pose) {
  return 2 * pose.halfHeight / Math.min(canvas.clientHeight, canvas.clientWidth);
}

function fromCentre(canvas, pose, event) {
  const box = canvas.getBoundingClientRect();
  const size = pixelSize(canvas, pose);
  return [(event.clientX - box.x - box.width / 2) * size, (box.y + box.height / 2 - event.clientY) * size];
}

/** @param {() => void} changed called after every change of the pose by hand */
export function listen(canvas, pose, changed) {
  const held = new Map();
  const drag = (event) => {
    const before = [...held.values()];
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const after = [...held.values()];
    const size = pixelSize(canvas, pose);
    const [from, to] = [middle(before), middle(after)];
    const move = event.shiftKey || (event.buttons & 6) || held.size > 1;
    if (move) pose.moveBy((to.x - from.x) * size, (from.y - to.y) * size);
    else pose.turnBy((to.x - from.x) / 150, (to.y - from.y) / 150);
    if (held.size === 2 && spread(after) > 0) pose.zoomBy(spread(before) / spread(after));
    changed();
  };
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  canvas.addEventListener('pointermove', (event) => { if (held.has(event.pointerId)) drag(event); });
  for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'])
    canvas.addEventListener(end, (event) => held.delete(event.pointerId));
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    const pixels = event.deltaMode === 0 ? event.deltaY : event.deltaY * 30;
    pose.zoomBy(Math.exp(Math.min(Math.max(pixels, -300), 300) * 0.0015), ...fromCentre(canvas, pose, event));
    changed();
  }, { passive: false });
}

const step = Math.PI / 12;
const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** Turns, moves or zooms when the key is one of those; true when it was. */
export function key(event, pose) {
  const arrow = arrows[event.key];
  if (arrow && event.shiftKey) pose.moveBy(arrow[0] * pose.halfHeight / 10, -arrow[1] * pose.halfHeight / 10);
  else if (arrow) pose.turnBy(arrow[0] * step, arrow[1] * step);
  else if (event.key === '+' || event.key === '=') pose.zoomBy(1 / 1.2);
  else if (event.key === '-') pose.zoomBy(1.2);
  else if (event.key === '0') pose.reset();
  else return false;
  return true;
}
