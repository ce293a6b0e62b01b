// Pointer, fingers and keys on the picture, and the tool on its way.
import {api} from './api.js';
import {input, mark, output} from './found.js';
import {camera, redraw, seeAllNext, showAll} from './picture.js';
import {axesOf} from './planes.js';
import {compute} from './results.js';
import {$, inUnit, positionText, shown, unitOf, withUnit} from './shown.js';
import {t} from './texts.js';

// `live`: whether a screen reader says it; of the slider it says the value.
function tell(text, live) {
  $('place').setAttribute('aria-live', live);
  $('place').textContent = text;
}

let asked = null;
async function move() {
  const {view} = shown.current;
  if (!view) return;
  asked?.abort();
  asked = new AbortController();
  let place = null;
  try {
    place = await api.place(view.id, Number($('way').value) / Number($('way').max), asked.signal);
  } catch { return; }
  if (shown.current?.view !== view) return;
  shown.place = place;
  tell(positionText(shown.place.position ?? {}) + (shown.place.block?.line ? `, ${t('line')} ${shown.place.block.line}` : ''), 'off');
  $('way').setAttribute('aria-valuetext', $('place').textContent);
  shown.line = shown.place.block?.line ?? 0;
  input.select(shown.line);
  output.select(shown.line);
  redraw();
}

const stage = $('over');
let drag = null;
const fingers = new Map();
stage.addEventListener('pointerdown', event => {
  stage.setPointerCapture(event.pointerId);
  fingers.set(event.pointerId, event);
  drag = {x: event.offsetX, y: event.offsetY, moved: false};
});
stage.addEventListener('pointermove', event => {
  const at = camera.toPlane(event.offsetX, event.offsetY);
  const names = axesOf(shown.current?.view?.plane);
  const {name: unit, size, digits} = unitOf(shown.current?.view);
  $('cursor').textContent = !shown.current ? ''
    : `${names[0].toUpperCase()} ${(at.x / size).toFixed(digits - 1)}  ${names[1].toUpperCase()} ${(at.y / size).toFixed(digits - 1)} ${unit}`;
  if (!drag || !fingers.has(event.pointerId)) return;
  const before = fingers.get(event.pointerId);
  const dx = event.offsetX - before.offsetX, dy = event.offsetY - before.offsetY;
  if (fingers.size === 2) {
    const other = [...fingers.values()].find(finger => finger.pointerId !== event.pointerId);
    const length = finger => Math.hypot(finger.offsetX - other.offsetX, finger.offsetY - other.offsetY);
    camera.zoom(length(event) / Math.max(1, length(before)), other.offsetX, other.offsetY);
  } else if (drag.moved || Math.hypot(event.offsetX - drag.x, event.offsetY - drag.y) > 4) {
    drag.moved = true;
    camera.x -= dx / camera.scale;
    camera.y += dy / camera.scale;
  }
  fingers.set(event.pointerId, event);
  redraw();
});
stage.addEventListener('pointerup', event => {
  fingers.delete(event.pointerId);
  if (drag && !drag.moved && shown.current?.tiles) click(event.offsetX, event.offsetY);
  if (fingers.size === 0) drag = null;
});
stage.addEventListener('pointercancel', event => { fingers.delete(event.pointerId); drag = null; });
stage.addEventListener('wheel', event => {
  event.preventDefault();
  camera.zoom(Math.exp(-event.deltaY * 0.0015), event.offsetX, event.offsetY);
  redraw();
}, {passive: false});

function click(x, y) {
  const at = camera.toPlane(x, y);
  const found = shown.current.tiles.pick(camera, at, 8 / camera.scale);
  if (shown.isMeasuring) {
    shown.measured = shown.measured.length === 1 ? [shown.measured[0], found?.point ?? at] : [found?.point ?? at];
    if (shown.measured.length === 2) {
      const [dx, dy] = [shown.measured[1].x - shown.measured[0].x, shown.measured[1].y - shown.measured[0].y];
      const [first, second] = axesOf(shown.current.view.plane).map(name => name.toUpperCase());
      tell(`${withUnit(Math.hypot(dx, dy))} (${first} ${inUnit(dx)}, ${second} ${inUnit(dy)})`, 'polite');
    }
    return redraw();
  }
  stop();
  mark(found?.line ?? 0, false);
}

stage.addEventListener('keydown', event => {
  const step = 60 / camera.scale;
  const act = {
    ArrowLeft: () => { camera.x -= step; }, ArrowRight: () => { camera.x += step; },
    ArrowUp: () => { camera.y += step; }, ArrowDown: () => { camera.y -= step; },
    '+': () => camera.zoom(1.4), '-': () => camera.zoom(1 / 1.4), 0: showAll,
    Escape: () => { shown.measured = []; shown.line = 0; },
    m: () => $('measure').click(), Enter: () => { if (shown.current?.tiles) click(camera.width / 2, camera.height / 2); },
  }[event.key];
  if (!act) return;
  event.preventDefault();
  act();
  redraw();
});

$('fit').addEventListener('click', showAll);
$('zoom-in').addEventListener('click', () => { camera.zoom(1.4); redraw(); });
$('zoom-out').addEventListener('click', () => { camera.zoom(1 / 1.4); redraw(); });
$('measure').addEventListener('click', () => {
  shown.isMeasuring = !shown.isMeasuring;
  shown.measured = [];
  $('measure').setAttribute('aria-pressed', shown.isMeasuring);
  redraw();
});
let running = null;
// The button says what it does next.
function offer(what) {
  $('play').dataset.text = what;
  $('play').textContent = t(what);
}
function stop() {
  running = null;
  offer('play');
}

// Runs the tool along its whole path, from where it is; from the start where it is at the end.
async function run() {
  const own = running = {}, {view} = shown.current, most = Number($('way').max);
  const msForAll = 20_000;
  offer('halt');
  let way = Number($('way').value) % most, before = performance.now();
  while (running === own && shown.current?.view === view && way < most) {
    await new Promise(requestAnimationFrame);
    if (running !== own) return;
    const now = performance.now();
    way = Math.min(most, way + (now - before) / msForAll * most);
    before = now;
    $('way').value = way;
    await move();
  }
  if (running === own) stop();
}

$('play').addEventListener('click', () => { if (running) stop(); else if (shown.current?.view) run(); });
$('way').addEventListener('input', () => { stop(); move(); });
stage.addEventListener('focus', redraw);
stage.addEventListener('blur', redraw);
$('plane').addEventListener('change', () => {
  shown.current.plane = {PLANE_XY: 'xy', PLANE_ZX: 'zx', PLANE_YZ: 'yz'}[$('plane').value];
  seeAllNext();
  compute();
});
