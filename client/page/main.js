import {api, inside} from './api.js';
import {arrowsOf} from './arrows.js';
import {Canvas2d} from './canvas2d.js';
import {Listing} from './listing.js';
import {motionsOf, textOf} from './motions.js';
import {Options} from './options.js';
import {Overlay} from './overlay.js';
import {axesOf, inPlane, planeNames} from './planes.js';
import {Camera, Tiles} from './scene.js';
import {settingName, settingWord} from './settings_texts.js';
import {palette, special, styleNames, widths} from './styles.js';
import {svgOf} from './svg.js';
import {currentLanguage, t, translate} from './texts.js';
import {WebGl} from './webgl.js';

const $ = id => document.getElementById(id);
const camera = new Camera();
const programs = [];
let current = null;      // {name, text, settings, plane, view, tiles, compareWith, compare}
let options = null;
let line = 0;            // of the program, marked
let place = null;        // of the tool
let measured = [];
let isMeasuring = false;
let layers = 0x7f;       // as bits: styles, then rapid
const also = {arrows: true, band: false, compare: true, marks: true, proposals: true, uncut: true};

const renderer = WebGl.make($('lines')) ?? new Canvas2d($('lines'));
const overlay = new Overlay($('over'));
document.body.dataset.renderer = renderer.constructor.name;

// ---- drawing

let isDue = false;
function redraw() {
  if (isDue) return;
  isDue = true;
  // What is on the screen is no longer all of it, until it is drawn.
  delete document.body.dataset.complete;
  requestAnimationFrame(() => { isDue = false; draw(); });
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
  if (current?.tiles) {
    const tiles = current.tiles.visible(camera);
    if (also.band) renderer.draw(tiles, {layers, band: 2 * (current.view.toolRadius ?? 0), color: special().band});
    if (current.compare && also.compare)
      renderer.draw(current.compare.tiles.visible(camera), {layers, compare: true, color: special().compare});
    renderer.draw(tiles, {layers, line});
    document.body.dataset.segments = tiles.reduce((sum, tile) => sum + tile.count, 0);
    document.body.dataset.complete = current.tiles.complete;
    if (current.tiles.complete) document.body.dataset.pictureMs ??= (performance.now() - current.began).toFixed(1);
  }
  const arrows = current?.tiles && also.arrows ? arrowsOf(camera, current.tiles.visible(camera), isShown) : [];
  document.body.dataset.arrows = arrows.length;
  const aim = isMeasuring && stage.matches(':focus-visible');
  overlay.draw(camera, ratio, {view: current?.view, unit: unitOf(current?.view), arrows, aim, place, measured, marks: also.marks,
    proposals: also.proposals ? current?.proposals : [], uncut: also.uncut ? current?.uncut : []});
  document.body.dataset.drawMs = (performance.now() - start).toFixed(1);
}

const isShown = (style, rapid) => (layers >> style & 1) === 1 && (!rapid || (layers >> 6 & 1) === 1);

// ---- programs

// What was found in the plane that is compensated is drawn there.
const isOwnPlane = view => (view.plane ?? '') === (view.ownPlane ?? '');
// Lengths are said as the program counts them.
const unitOf = view => view?.unit === 'LENGTH_UNIT_INCH' ? {name: 'inch', size: 25.4, digits: 5} : {name: 'mm', size: 1, digits: 4};
const corner = point => ({x: point?.x ?? 0, y: point?.y ?? 0});

async function add(files) {
  for (const file of files) programs.push({name: file.name, text: file, settings: null});
  listPrograms();
  if (programs.length) await choose(programs[programs.length - files.length]);
}

function listPrograms() {
  $('programs').replaceChildren(...programs.map((program, i) => new Option(program.name, i)));
}

async function choose(program) {
  current = program;
  $('programs').value = programs.indexOf(program);
  if (program.settings && options) options.values = program.settings;
  await compute(true);
}

function say(text, kind = '') {
  $('state').textContent = text;
  $('state').className = kind;
}

async function compute(fit) {
  const program = current;
  if (!program) return;
  $('hint').hidden = true;
  say(t('working'));
  program.settings = options?.values ?? {};
  options?.refuse([]);
  try {
    const began = performance.now();
    const view = await api.makeView(program, program.settings, program.plane);
    forget(program);
    program.view = view;
    program.tiles = tilesOf(view);
    program.began = began;
    delete document.body.dataset.pictureMs;
    document.body.dataset.viewMs = (performance.now() - began).toFixed(1);
  } catch (error) {
    return fail(error);
  }
  if (current !== program) return;
  await Promise.all([show(program, fit), learn(program, program.view), program.compareWith && compare(program)]);
}

// What is measured behind the first picture.
async function learn(program, view) {
  while (view.measuring && program.view === view) {
    await new Promise(resolve => setTimeout(resolve, 250));
    const now = await api.view(view.id).catch(() => null);
    if (!now || program.view !== view) return;
    if (now.measuring) continue;
    Object.assign(view, now, {measuring: false});
    if (current === program) { showSaid(view); redraw(); }
  }
}

function tilesOf(view) {
  const tiles = new Tiles(view, redraw);
  // The server has given the view up: it is made again.
  tiles.lost = error => { if (error.problem?.reason === 'VIEW_GONE' && current?.view === view) compute(false); };
  return tiles;
}

function forget(program) {
  forgetCompared(program);
  $('compared').textContent = '';
  if (!program.view) return;
  program.tiles.release();
  api.dropView(program.view.id);
}

function fail(error) {
  const problem = error.problem;
  say(problem ? t('failed') + error.message : t('offline'), 'error');
  if (problem?.fields) options.refuse(problem.fields);
}

async function show(program, fit) {
  const {view} = program;
  line = 0;
  place = null;
  $('way').disabled = false;
  $('way').value = 0;
  $('save-nc').disabled = view.refused === true;
  $('save-svg').disabled = false;
  $('save-record').disabled = view.refused === true;
  $('plane').disabled = false;
  $('plane').value = view.plane ?? 'PLANE_XY';
  program.uncut = [];
  $('survey').disabled = inside !== null;
  $('largest').replaceChildren();
  if (fit) showAll();
  showSaid(view);
  redraw();
  document.body.dataset.view = view.id;
  await Promise.all([input.show(view), output.show(view)]);
}

function showAll() {
  if (!current?.view) return;
  camera.width = $('over').clientWidth;
  camera.height = $('over').clientHeight;
  camera.show(corner(current.view.low), corner(current.view.high));
  redraw();
}

// ---- what was said

// As controls write them, in every language.
function inUnit(value) {
  const {size, digits} = unitOf(current?.view);
  return String(Number(((value ?? 0) / size).toFixed(digits)) || 0);
}
const withUnit = value => `${inUnit(value)} ${unitOf(current?.view).name}`;

function showSaid(view) {
  const found = view.diagnostics ?? [];
  say(t(view.refused ? 'refused' : found.length ? 'notes' : 'done'), view.refused ? 'error' : '');
  const order = {ERROR: 0, WARNING: 1, NOTE: 2};
  const items = [...found].sort((a, b) => order[a.severity] - order[b.severity]).map(item);
  current.proposals = !isOwnPlane(view) ? [] : found.flatMap(d => (d.entryHelp?.proposals ?? []).map(p => motionsOf(p, at => inPlane(view.plane, at))));
  if (view.diagnosticsLeftOut) {
    const rest = document.createElement('li');
    rest.textContent = `${view.diagnosticsLeftOut} ${t('leftOut')}`;
    items.push(rest);
  }
  $('diagnostics').replaceChildren(...items);
  showCertificate(view);
}

function item(diagnostic) {
  const kind = diagnostic.severity.toLowerCase();
  const button = document.createElement('button');
  button.className = kind;
  const head = document.createElement('strong');
  head.textContent = `${t(kind)} ${diagnostic.code}` + (diagnostic.line ? `, ${t('line')} ${diagnostic.line}` : '');
  const remedy = document.createElement('span');
  remedy.className = 'remedy';
  remedy.textContent = diagnostic.help ?? diagnostic.remedy ?? '';
  const message = document.createElement('span');
  message.textContent = ` ${diagnostic.text ?? diagnostic.message ?? ''}`;
  message.lang = remedy.lang = diagnostic.language || 'en';
  button.append(head, message, remedy);
  button.dataset.code = diagnostic.code;
  button.addEventListener('click', () => goTo(diagnostic));
  const entry = document.createElement('li');
  entry.append(button);
  if (diagnostic.entryHelp) entry.append(...helpWithEntry(diagnostic.entryHelp));
  return entry;
}

// What would do in place of the approach or the retract that was refused.
function helpWithEntry(help) {
  const {view} = current;
  const names = axesOf(view.plane).slice(0, 2);
  const at = point => names.map(name => `${name.toUpperCase()}${inUnit(point[name])}`).join(' ');
  const list = document.createElement('ul');
  list.className = 'proposals';
  const facts = [
    help.neededLength && t('tooShort', {given: withUnit(help.givenLength), needed: withUnit(help.neededLength)}),
    help.legalPoint && t(help.leaves ? 'mayEnd' : 'mayStart', {at: at(help.legalPoint)}),
  ].filter(Boolean);
  if (facts.length) {
    const entry = document.createElement('li'), text = document.createElement('p');
    text.textContent = facts.join('; ');
    entry.append(text);
    list.append(entry);
  }
  for (const proposal of help.proposals ?? []) {
    const entry = document.createElement('li'), button = document.createElement('button');
    const shape = proposal.shape === 'SHAPE_LINE' ? t('asLine') : t('asQuarter');
    const head = document.createElement('strong');
    head.textContent = `${t(help.leaves ? 'proposedExit' : 'proposedEntry')}, ${shape}`;
    const motions = motionsOf(proposal, point => inPlane(view.plane, point));
    button.append(head, ` ${textOf(proposal, motions, at, radius => `${t('arc')} R${inUnit(radius)}`)}`);
    button.addEventListener('click', () => {
      const points = motions.flatMap(({from, to}) => [from, to]);
      zoomTo(view, ...cornersOf(points));
      redraw();
    });
    entry.append(button);
    list.append(entry);
  }
  return [list];
}

const positionText = p => `X${inUnit(p.x)} Y${inUnit(p.y)} Z${inUnit(p.z)}`;

function showCertificate(view) {
  const rows = [];
  const add = (name, value) => {
    const dt = document.createElement('dt'), dd = document.createElement('dd');
    dt.textContent = name;
    dd.textContent = value;
    rows.push(dt, dd);
  };
  const c = view.summary?.path?.minClearance;
  if (c) {
    add(t('smallest'), `${inUnit(c.distance)} ${t('required')} ${withUnit(c.toolRadius)}`);
    if (c.point) add(t('at'), positionText(c.point));
    add(t('checked'), `${c.blocksChecked ?? 0}`);
    if (c.blocksGouging) add(t('tooNear'), `${c.blocksGouging}`);
  } else {
    add(t('certificate'), t(view.measuring ? 'measuring' : view.toolRadius && !view.refused ? 'notMeasured' : 'none'));
  }
  add(t('tool'), withUnit(view.toolRadius));
  add(t('plane'), axesOf(view.plane).slice(0, 2).join('').toUpperCase());
  add(t('length'), `${withUnit(view.pathLength)}, ${view.pathBlocks ?? 0} ${t('blocks')}`);
  add(t('height'), `${axesOf(view.plane)[2].toUpperCase()} ${inUnit(view.lowest)} … ${withUnit(view.highest)}`);
  $('certificate').replaceChildren(...rows);
}

// ---- going to a line

const cornersOf = points => [Math.min, Math.max].map(end => ({x: end(...points.map(p => p.x)), y: end(...points.map(p => p.y))}));
const boundsOf = (view, blocks) => cornersOf(blocks.flatMap(b => [inPlane(view.plane, b.start ?? {}), inPlane(view.plane, b.end ?? {})]));

function zoomTo(view, low, high) {
  const least = Math.max(4 * (view.toolRadius ?? 0), 1);
  const x = (low.x + high.x) / 2, y = (low.y + high.y) / 2;
  const half = Math.max(high.x - low.x, high.y - low.y, least);
  camera.show({x: x - half, y: y - half}, {x: x + half, y: y + half});
}

async function goTo(diagnostic) {
  const {view} = current;
  if (diagnostic.point) {
    const at = inPlane(view.plane, diagnostic.point);
    zoomTo(view, at, at);
  }
  await mark(diagnostic.line ?? 0, !diagnostic.point);
}

async function mark(to, zoom) {
  line = to;
  redraw();
  input.select(to);
  output.select(to);
  if (!zoom || !to) return;
  const {view} = current;
  const {blocks = []} = await api.blocks(view.id, to);
  if (blocks.length && current?.view === view) {
    zoomTo(view, ...boundsOf(view, blocks));
    redraw();
  }
}

const input = new Listing($('input'), 'lines', to => mark(to, true));
const output = new Listing($('output'), 'output', to => mark(to, true));

// ---- which tool fits

async function survey() {
  const program = current, {view} = program;
  $('survey').disabled = true;
  $('largest').textContent = t('working');
  let answer = null;
  try {
    answer = await api.survey(program, program.settings, view.toolRadius ?? 0);
  } catch (error) { fail(error); }
  if (current !== program || program.view !== view) return;
  $('survey').disabled = false;
  $('largest').replaceChildren(...(answer ? surveyed(answer, view) : []));
  program.uncut = !isOwnPlane(view) ? [] : (answer?.radii?.[0]?.uncut ?? []).map(({start, end, center, sweep}) => (
    {from: inPlane(view.plane, start ?? {}), to: inPlane(view.plane, end ?? {}), ...(center && sweep && {center: inPlane(view.plane, center), sweep})}));
  redraw();
}

function surveyed({radii = [], summary}, view) {
  const largest = summary?.largest ?? {};
  const head = document.createElement('strong');
  head.textContent = !largest.radius ? t('largestNone')
    : `${t('largestIs')} ${largest.isLimited ? '' : `${t('atLeast')} `}${withUnit(largest.radius)}`;
  const parts = [head];
  (largest.limits ?? []).filter(place => place.line).forEach((place, i) => {
    const button = document.createElement('button');
    button.textContent = `${t('line')} ${place.line}`;
    button.addEventListener('click', () => mark(place.line, true));
    parts.push(i === 0 ? `, ${t('limitedBy')} ` : ' ', button);
  });
  const [own] = radii;
  if (own?.wallLength) {
    const uncut = document.createElement('p');
    uncut.textContent = `${withUnit(own.uncutLength)} ${t('of')} ${withUnit(own.wallLength)} ${t('uncut', {radius: withUnit(view.toolRadius)})}`;
    parts.push(uncut);
  }
  return parts;
}
$('survey').addEventListener('click', survey);

// ---- the tool on its way

let asked = null;
async function move() {
  const {view} = current;
  asked?.abort();
  asked = new AbortController();
  try {
    place = await api.place(view.id, Number($('way').value) / Number($('way').max), asked.signal);
  } catch { return; }
  $('place').textContent = positionText(place.position ?? {}) + (place.block?.line ? `, ${t('line')} ${place.block.line}` : '');
  line = place.block?.line ?? 0;
  input.select(line);
  output.select(line);
  redraw();
}

// ---- pointer and keys

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
  const names = axesOf(current?.view?.plane);
  const {name: unit, size, digits} = unitOf(current?.view);
  $('cursor').textContent = !current ? ''
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
  if (drag && !drag.moved && current?.tiles) click(event.offsetX, event.offsetY);
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
  const found = current.tiles.pick(camera, at, 8 / camera.scale);
  if (isMeasuring) {
    measured = measured.length === 1 ? [measured[0], found?.point ?? at] : [found?.point ?? at];
    if (measured.length === 2) {
      const [dx, dy] = [measured[1].x - measured[0].x, measured[1].y - measured[0].y];
      const [first, second] = axesOf(current.view.plane).map(name => name.toUpperCase());
      $('place').textContent = `${withUnit(Math.hypot(dx, dy))} (${first} ${inUnit(dx)}, ${second} ${inUnit(dy)})`;
    }
    return redraw();
  }
  mark(found?.line ?? 0, false);
}

stage.addEventListener('keydown', event => {
  const step = 60 / camera.scale;
  const act = {
    ArrowLeft: () => { camera.x -= step; }, ArrowRight: () => { camera.x += step; },
    ArrowUp: () => { camera.y += step; }, ArrowDown: () => { camera.y -= step; },
    '+': () => camera.zoom(1.4), '-': () => camera.zoom(1 / 1.4), 0: showAll,
    Escape: () => { measured = []; line = 0; },
    m: () => $('measure').click(), Enter: () => { if (current?.tiles) click(camera.width / 2, camera.height / 2); },
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
  isMeasuring = !isMeasuring;
  measured = [];
  $('measure').setAttribute('aria-pressed', isMeasuring);
  redraw();
});
$('way').addEventListener('input', move);
stage.addEventListener('focus', redraw);
stage.addEventListener('blur', redraw);
$('plane').addEventListener('change', () => {
  current.plane = {PLANE_XY: 'xy', PLANE_ZX: 'zx', PLANE_YZ: 'yz'}[$('plane').value];
  compute(true);
});

// ---- files

$('file').addEventListener('change', () => add([...$('file').files]));
$('programs').addEventListener('change', () => choose(programs[Number($('programs').value)]));
addEventListener('dragover', event => { event.preventDefault(); $('stage').classList.add('dropping'); });
addEventListener('dragleave', () => $('stage').classList.remove('dropping'));
addEventListener('drop', event => {
  event.preventDefault();
  if (inside) return;
  $('stage').classList.remove('dropping');
  add([...event.dataTransfer.files]);
});

function save(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
const stem = name => name.replace(/\.[^.]*$/, '');
$('save-nc').addEventListener('click', async () => {
  try {
    save(await api.compensated(current, current.settings), `${stem(current.name)}_g40.nc`);
  } catch (error) { fail(error); }
});
$('save-svg').addEventListener('click', () => {
  const {view, tiles, compare, name} = current;
  const found = also.marks ? (view.diagnostics ?? []).filter(d => d.point && d.severity !== 'NOTE').map(d => ({...d, at: inPlane(view.plane, d.point)})) : [];
  const svg = svgOf(camera, {tiles: tiles.visible(camera), compared: compare && also.compare ? compare.tiles.visible(camera) : [],
    arrows: also.arrows ? arrowsOf(camera, tiles.visible(camera), isShown) : [], found, isShown, title: name});
  save(new Blob([svg], {type: 'image/svg+xml'}), `${stem(name)}.svg`);
});
$('save-record').addEventListener('click', async () => {
  try {
    save(await api.record(current, current.settings), `${stem(current.name)}_g40.json`);
  } catch (error) { fail(error); }
});

// ---- forms

$('form').addEventListener('submit', event => { event.preventDefault(); compute(false); });
$('form').addEventListener('input', event => event.target.setCustomValidity(''));
// ---- two results on top of each other

async function compare(program) {
  try {
    const view = await api.makeView(program, {...program.settings, ...program.compareWith}, program.plane);
    forgetCompared(program);
    program.compare = {view, tiles: tilesOf(view)};
    if (current !== program) return;
    document.body.dataset.compared = view.id;
    $('compared').textContent = compared(program);
    redraw();
  } catch (error) { fail(error); }
}

function compared({compareWith, compare: {view}}) {
  const [[name, value]] = Object.entries(compareWith);
  const error = (view.diagnostics ?? []).find(d => d.severity === 'ERROR');
  const smallest = view.summary?.path?.minClearance;
  return `${settingName(name, currentLanguage())} ${settingWord(value, currentLanguage())}: ` + [
    view.refused ? `${t('refusedShort')} ${error?.code ?? ''}` + (error?.line ? `, ${t('line')} ${error.line}` : '') : '',
    `${t('length')} ${withUnit(view.pathLength)}`,
    smallest ? `${t('smallest')} ${inUnit(smallest.distance)} ${t('required')} ${withUnit(smallest.toolRadius)}` : '',
  ].filter(Boolean).join('; ');
}

function forgetCompared(program) {
  const {compare: old} = program;
  if (!old) return;
  old.tiles.release();
  api.dropView(old.view.id);
  program.compare = null;
}

$('compare-form').addEventListener('submit', event => {
  event.preventDefault();
  if (!current?.view) return;
  current.compareWith = {[$('compare-setting').value]: $('compare-value').value.trim()};
  compare(current);
});
$('compare-off').addEventListener('click', () => {
  if (!current) return;
  current.compareWith = null;
  forgetCompared(current);
  $('compared').textContent = '';
  redraw();
});

function makeLayers() {
  // `kind`: how it is drawn, as a class of the sample.
  const box = (name, color, kind, get, set) => {
    const label = document.createElement('label');
    const check = document.createElement('input');
    check.type = 'checkbox';
    check.checked = get();
    check.addEventListener('change', () => { set(check.checked); redraw(); });
    const swatch = document.createElement('span');
    swatch.className = `swatch ${kind}`;
    swatch.style.borderTopColor = color;
    const text = document.createElement('span');
    text.dataset.text = name;
    text.textContent = t(name);
    label.append(check, swatch, text);
    return label;
  };
  const bit = (name, color, kind, i) => box(name, color, kind, () => (layers >> i & 1) === 1,
    on => { layers = on ? layers | 1 << i : layers & ~(1 << i); });
  const others = [['layerArrows', 'text', 'arrow', 'arrows'], ['layerBand', 'band', 'wide', 'band'],
    ['layerCompare', 'compare', '', 'compare'], ['layerMarks', 'finding', 'cross', 'marks'],
    ['layerProposal', 'proposal', 'dashed', 'proposals'], ['layerUncut', 'uncut', 'dotted', 'uncut']];
  $('layers').replaceChildren(
    ...styleNames.map((name, i) => bit(name, palette()[i], widths[i] < 2 ? 'thin' : '', i)),
    bit('layerRapid', special().text, 'dashed', 6),
    ...others.map(([name, color, kind, key]) =>
      box(name, special()[color], kind, () => also[key], on => { also[key] = on; })));
}

$('language').addEventListener('change', () => {
  translate($('language').value);
  options?.translate();
  if (current?.view) showSaid(current.view);
  if (current?.compare) $('compared').textContent = compared(current);
});

async function begin() {
  translate();
  $('language').value = currentLanguage();
  makeLayers();
  $('plane').replaceChildren(...planeNames.map((name, i) => new Option(`${name.slice(6)} (G${17 + i})`, name)));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { makeLayers(); redraw(); });
  new ResizeObserver(redraw).observe($('stage'));
  document.body.dataset.inside = inside !== null;
  if (inside) {
    programs.push({name: inside.name, settings: null});
    listPrograms();
    document.title = inside.name;
    document.body.dataset.ready = 'true';
    return choose(programs[0]);
  }
  options = new Options($('form'), await api.openApi(), await api.info());
  options.offerOther($('compare-setting'), $('compare-value'));
  document.body.dataset.ready = 'true';
  const token = new URLSearchParams(location.search).get('offer');
  if (!token) return;
  const {program, settings} = await api.offer(token);
  programs.push({...program, settings});
  listPrograms();
  await choose(programs[0]);
}
begin().catch(fail);
