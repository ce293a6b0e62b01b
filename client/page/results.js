// Programs, and what the service makes of them: views, compared two at a time.
import {api, inside} from './api.js';
import {fail, hasOwnRadius, input, lengthOf, output, reasonOf, say, showSaid} from './found.js';
import {redraw, seeAllNext, showAllAgain} from './picture.js';
import {Tiles} from './scene.js';
import {settingName, settingWord} from './settings_texts.js';
import {$, shown, withUnit} from './shown.js';
import {currentLanguage, t} from './texts.js';

export async function add(files) {
  // Text or a link that was dropped has none.
  if (!files.length) return;
  for (const file of files) shown.programs.push({name: file.name, text: file, settings: null});
  listPrograms();
  await choose(shown.programs[shown.programs.length - files.length]);
}

export function listPrograms() {
  $('programs').replaceChildren(...shown.programs.map((program, i) => new Option(program.name, i)));
}

export async function choose(program) {
  if (shown.current && shown.current !== program) forget(shown.current);
  shown.current = program;
  $('programs').value = shown.programs.indexOf(program);
  if (program.settings && shown.options) shown.options.values = program.settings;
  seeAllNext();
  await compute();
}

let latest = null;
export async function compute() {
  const program = shown.current;
  if (!program) return;
  latest?.abort();
  const own = latest = new AbortController();
  $('hint').hidden = true;
  say(t('working'));
  const settings = shown.options?.values ?? {};
  shown.options?.refuse([]);
  try {
    const began = performance.now();
    const view = await api.makeView(program, settings, program.plane, own.signal);
    // Somebody has asked for something else in the meantime.
    if (own !== latest) { api.dropView(view.id); return; }
    forget(program);
    Object.assign(program, {view, settings, began, tiles: tilesOf(view)});
    document.body.dataset.changed = false;
    delete document.body.dataset.pictureMs;
    document.body.dataset.viewMs = (performance.now() - began).toFixed(1);
  } catch (error) {
    if (own !== latest || error.name === 'AbortError') return;
    // What was there before would be taken for the answer.
    forget(program);
    program.settings = settings;
    showNothing();
    return fail(error, program);
  }
  await Promise.all([show(program), learn(program, program.view), program.compareWith && compare(program)]);
}

function showNothing() {
  for (const name of ['save-nc', 'save-svg', 'save-record', 'survey', 'way', 'play', 'plane']) $(name).disabled = true;
  for (const name of ['diagnostics', 'certificate', 'largest', 'place']) $(name).replaceChildren();
  shown.line = 0;
  shown.place = null;
  shown.measured = [];
  input.clear();
  output.clear();
  redraw();
}

// What is measured after the first picture.
async function learn(program, view) {
  await program.tiles.drawn;
  while (view.measuring && program.view === view) {
    await new Promise(resolve => setTimeout(resolve, 250));
    const now = await api.view(view.id).catch(() => null);
    if (!now || program.view !== view) return;
    if (now.measuring) continue;
    Object.assign(view, now, {measuring: false});
    if (shown.current === program) { showSaid(view); redraw(); }
  }
}

function tilesOf(view) {
  const tiles = new Tiles(view, redraw);
  // The server has given the view up: it is made again.
  tiles.lost = error => { if (error.problem?.reason === 'VIEW_GONE' && shown.current?.view === view) compute(); };
  return tiles;
}

function forget(program) {
  forgetCompared(program);
  $('compared').textContent = '';
  if (!program.view) return;
  program.tiles.release();
  api.dropView(program.view.id);
  program.view = program.tiles = null;
}

async function show(program) {
  const {view, tiles} = program;
  shown.line = 0;
  shown.place = null;
  shown.measured = [];
  $('place').textContent = '';
  const isEmpty = !view.pathBlocks && !view.contourBlocks;
  $('hint').hidden = !isEmpty;
  if (isEmpty) { $('hint').dataset.text = 'noMotion'; $('hint').textContent = t('noMotion'); }
  $('way').disabled = $('play').disabled = !view.pathBlocks;
  $('way').value = 0;
  $('save-nc').disabled = view.refused === true;
  $('save-svg').disabled = false;
  $('save-record').disabled = view.refused === true;
  $('plane').disabled = false;
  $('plane').value = view.plane ?? 'PLANE_XY';
  program.uncut = [];
  $('survey').disabled = inside !== null;
  $('largest').replaceChildren();
  showSaid(view);
  // Another path may reach farther.
  showAllAgain();
  redraw();
  document.body.dataset.view = view.id;
  await input.show(view);
  output.clear();
  // To make it is as much work as all before: the picture comes first.
  if (!view.refused) await tiles.drawn;
  if (program.view === view) await output.show(view);
}

// A radius that the program itself gives, or its only tool, outlives the setting: then another one
// is so much more or less of that.
function settingsToCompare({compareWith, settings, view}) {
  const radius = Number(compareWith.tool_radius), [own, ...others] = view.toolRadii ?? [];
  if (!(radius > 0) || !own || others.length || settings.tool_radius || settings.nominal_radius) return compareWith;
  const tool = /^\s*(\d*(?:"(?:[^"]|"")*")?(?:\/\d+)?)\s*:[^,]*$/.exec(settings.tools ?? '');
  if (tool) return {tools: `${tool[1]}:${radius}`};
  const wear = radius - own + Number(settings.wear ?? 0);
  return {...compareWith, wear, max_wear: Math.max(1, Math.abs(wear))};
}

async function compare(program) {
  try {
    const {view: own} = program;
    const view = await api.makeView(program, {...program.settings, ...settingsToCompare(program)}, program.plane);
    if (program.view !== own) { api.dropView(view.id); return; }
    forgetCompared(program);
    program.compare = {view, tiles: tilesOf(view)};
    if (shown.current !== program) return;
    document.body.dataset.compared = view.id;
    $('compared').textContent = compared(program);
    redraw();
  } catch (error) {
    forgetCompared(program);
    if (shown.current !== program) return;
    // What the program itself became still holds.
    $('compared').textContent = reasonOf(error, program.compareWith);
    redraw();
  }
}

// The lengths of two paths that differ anywhere hardly agree in every digit.
const isSamePath = (a, b) => a.pathLength === b.pathLength && a.pathBlocks === b.pathBlocks && a.refused === b.refused;

function compared({compareWith, compare: {view}, view: own}) {
  const [[name, value]] = Object.entries(compareWith);
  const error = (view.diagnostics ?? []).find(d => d.severity === 'ERROR');
  const smallest = view.summary?.path?.minClearance;
  const unit = shown.options.parameters.get(name)?.['x-unit'];
  return `${settingName(name, currentLanguage())} ${settingWord(value, currentLanguage())}${unit ? ` ${unit}` : ''}: ` + [
    view.refused ? `${t('refusedShort')} ${error?.code ?? ''}` + (error?.line ? `, ${t('line')} ${error.line}` : '') : '',
    `${t('length')} ${withUnit(lengthOf(view))}`,
    smallest ? `${t('smallest')} ${withUnit(smallest.distance)}, ${t('required')} ${withUnit(smallest.toolRadius)}` : '',
    isSamePath(view, own) ? t('noDifference') : '',
    hasOwnRadius(view, compareWith) ? t('ownRadius', {radius: withUnit(view.toolRadius)}) : '',
  ].filter(Boolean).join('; ');
}

function forgetCompared(program) {
  const {compare: old} = program;
  if (!old) return;
  old.tiles.release();
  api.dropView(old.view.id);
  program.compare = null;
}

$('compare-form').addEventListener('submit', async event => {
  event.preventDefault();
  if (!shown.current?.view) return;
  $('compared').textContent = '';
  shown.current.compareWith = {[$('compare-setting').value]: $('compare-value').value.trim()};
  await compare(shown.current);
  // On a low screen it lies below what is seen.
  $('compared').scrollIntoView({block: 'nearest'});
});
$('compare-off').addEventListener('click', () => {
  if (!shown.current) return;
  shown.current.compareWith = null;
  forgetCompared(shown.current);
  $('compared').textContent = '';
  redraw();
});
