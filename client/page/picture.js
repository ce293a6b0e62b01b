// The picture: what is drawn, and which part of the plane.
import {inside} from './api.js';
import {arrowsOf} from './arrows.js';
import {Canvas2d} from './canvas2d.js';
import {Overlay} from './overlay.js';
import {inPlane} from './planes.js';
import {Camera} from './scene.js';
import {$, shown, unitOf} from './shown.js';
import {special} from './styles.js';
import {WebGl} from './webgl.js';

export const camera = new Camera();
function makeRenderer() {
  const made = WebGl.make($('lines'), redraw);
  if (made) return made;
  // One that has been asked for WebGL gives nothing else.
  $('lines').replaceWith($('lines').cloneNode());
  return new Canvas2d($('lines'));
}
const renderer = makeRenderer();
const overlay = new Overlay($('over'));
document.body.dataset.renderer = renderer.constructor.name;

let isDue = false;
export function redraw() {
  if (isDue) return;
  isDue = true;
  // What is on the screen is no longer all of it, until it is drawn.
  delete document.body.dataset.complete;
  requestAnimationFrame(() => { isDue = false; draw(); });
}

// Where somebody may look closer: nothing has to be waited for then.
const msToRest = 40;
let pointer = null, looksAhead = 0;
for (const kind of ['pointermove', 'wheel']) $('over').addEventListener(kind, event => { pointer = [event.offsetX, event.offsetY]; }, {passive: true});
function lookAheadSoon() {
  clearTimeout(looksAhead);
  if (!inside) looksAhead = setTimeout(() => shown.current?.tiles?.lookAhead(camera, ...(pointer ?? [])), msToRest);
}

function draw() {
  const ratio = window.devicePixelRatio || 1;
  for (const canvas of [$('lines'), $('over')]) {
    const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
    if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
  }
  camera.width = $('over').clientWidth;
  camera.height = $('over').clientHeight;
  const start = performance.now();
  renderer.begin(camera, ratio);
  if (shown.current?.tiles) {
    const {view, compare} = shown.current, own = shown.current.tiles;
    own.begin();
    const tiles = own.visible(camera);
    if (shown.also.band && view.toolRadii)
      renderer.draw(own.swept(camera, Math.max(...view.toolRadii)), {layers: shown.layers, band: true, color: special().band});
    own.end();
    if (compare && shown.also.compare) {
      compare.tiles.begin();
      renderer.draw(compare.tiles.visible(camera), {layers: shown.layers, compare: true, color: special().compare});
      compare.tiles.end();
    }
    renderer.draw(tiles, {layers: shown.layers, line: shown.line});
    document.body.dataset.segments = tiles.reduce((sum, tile) => sum + tile.count, 0);
    document.body.dataset.complete = own.complete;
    if (own.complete) {
      document.body.dataset.pictureMs ??= (performance.now() - shown.current.began).toFixed(1);
      own.settle();
      lookAheadSoon();
    }
  }
  const arrows = shown.current?.tiles && shown.also.arrows ? arrowsOf(camera, shown.current.tiles.visible(camera), isShown) : [];
  document.body.dataset.arrows = arrows.length;
  const aim = shown.isMeasuring && $('over').matches(':focus-visible');
  overlay.draw(camera, ratio, {view: shown.current?.view, unit: unitOf(shown.current?.view), arrows, aim, place: shown.place, measured: shown.measured, marks: shown.also.marks,
    proposals: shown.also.proposals ? shown.current?.proposals : [], uncut: shown.also.uncut ? shown.current?.uncut : []});
  document.body.dataset.drawMs = (performance.now() - start).toFixed(1);
}

export const isShown = (style, rapid) => (shown.layers >> style & 1) === 1 && (!rapid || (shown.layers >> 6 & 1) === 1);

const corner = point => ({x: point?.x ?? 0, y: point?.y ?? 0});

// What the camera showed where all was seen; null: what comes next is seen as a whole.
let whole = null;
export function seeAllNext() { whole = null; }

// Shows all again, unless somebody has looked closer or elsewhere since.
export function showAllAgain() {
  if (!whole || ['x', 'y', 'scale'].every(name => camera[name] === whole[name])) showAll();
}

export function resized() {
  showAllAgain();
  redraw();
}

export function showAll() {
  if (!shown.current?.view) return;
  camera.width = $('over').clientWidth;
  camera.height = $('over').clientHeight;
  // What may be put in place of an approach lies beside it.
  const proposed = (shown.current.proposals ?? []).flat().flatMap(({from, to}) => [from, to]);
  camera.show(...cornersOf([corner(shown.current.view.low), corner(shown.current.view.high), ...proposed]));
  whole = {...camera};
  redraw();
}

export const cornersOf = points => [Math.min, Math.max].map(end => ({x: end(...points.map(p => p.x)), y: end(...points.map(p => p.y))}));
export const boundsOf = (view, blocks) => cornersOf(blocks.flatMap(b => [inPlane(view.plane, b.start ?? {}), inPlane(view.plane, b.end ?? {})]));

export function zoomTo(view, low, high) {
  const least = Math.max(4 * (view.toolRadius ?? 0), 1);
  const x = (low.x + high.x) / 2, y = (low.y + high.y) / 2;
  const half = Math.max(high.x - low.x, high.y - low.y, least);
  camera.show({x: x - half, y: y - half}, {x: x + half, y: y + half});
}
