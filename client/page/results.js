// Programs, and what the service makes of them: views, compared two at a time.
import {api, inside} from './api.js';
import {fail, input, output, say, showSaid} from './found.js';
import {redraw, showAll} from './picture.js';
import {Tiles} from './scene.js';
import {settingName, settingWord} from './settings_texts.js';
import {$, inUnit, shown, withUnit} from './shown.js';
import {currentLanguage, t} from './texts.js';

export async function add(files) {
  for (const file of files) shown.programs.push({name: file.name, text: file, settings: null});
  listPrograms();
  if (shown.programs.length) await choose(shown.programs[shown.programs.length - files.length]);
}

export function listPrograms() {
  $('programs').replaceChildren(...shown.programs.map((program, i) => new Option(program.name, i)));
}

export async function choose(program) {
  shown.current = program;
  $('programs').value = shown.programs.indexOf(program);
  if (program.settings && shown.options) shown.options.values = program.settings;
  await compute(true);
}

export async function compute(fit) {
  const program = shown.current;
  if (!program) return;
  $('hint').hidden = true;
  say(t('working'));
  program.settings = shown.options?.values ?? {};
  shown.options?.refuse([]);
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
  if (shown.current !== program) return;
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
    if (shown.current === program) { showSaid(view); redraw(); }
  }
}

function tilesOf(view) {
  const tiles = new Tiles(view, redraw);
  // The server has given the view up: it is made again.
  tiles.lost = error => { if (error.problem?.reason === 'VIEW_GONE' && shown.current?.view === view) compute(false); };
  return tiles;
}

function forget(program) {
  forgetCompared(program);
  $('compared').textContent = '';
  if (!program.view) return;
  program.tiles.release();
  api.dropView(program.view.id);
}

async function show(program, fit) {
  const {view} = program;
  shown.line = 0;
  shown.place = null;
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

async function compare(program) {
  try {
    const view = await api.makeView(program, {...program.settings, ...program.compareWith}, program.plane);
    forgetCompared(program);
    program.compare = {view, tiles: tilesOf(view)};
    if (shown.current !== program) return;
    document.body.dataset.compared = view.id;
    $('compared').textContent = compared(program);
    redraw();
  } catch (error) { fail(error); }
}

export function compared({compareWith, compare: {view}}) {
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
  if (!shown.current?.view) return;
  shown.current.compareWith = {[$('compare-setting').value]: $('compare-value').value.trim()};
  compare(shown.current);
});
$('compare-off').addEventListener('click', () => {
  if (!shown.current) return;
  shown.current.compareWith = null;
  forgetCompared(shown.current);
  $('compared').textContent = '';
  redraw();
});
