// Wires the page: files, downloads, layers, language.
import './survey.js';
import './stage.js';
import {api, inside} from './api.js';
import {arrowsOf} from './arrows.js';
import {fail, say, sayWhatBecame, showSaid} from './found.js';
import {Options} from './options.js';
import {camera, isShown, redraw, resized} from './picture.js';
import {axesOf, inPlane, planeNames} from './planes.js';
import {add, choose, compute, listPrograms} from './results.js';
import {$, shown, unitOf} from './shown.js';
import {palette, special, styleNames, widths} from './styles.js';
import {svgOf} from './svg.js';
import {currentLanguage, t, translate} from './texts.js';

$('file').addEventListener('change', () => {
  const files = [...$('file').files];
  // To choose a file again, as it is by now, is a change too.
  $('file').value = '';
  add(files);
});
$('programs').addEventListener('change', () => choose(shown.programs[Number($('programs').value)]));
addEventListener('dragover', event => { event.preventDefault(); $('stage').classList.add('dropping'); });
addEventListener('dragleave', () => $('stage').classList.remove('dropping'));
addEventListener('drop', event => {
  event.preventDefault();
  $('stage').classList.remove('dropping');
  if (inside) return;
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
  const program = shown.current;
  try {
    save(await api.compensated(program, program.settings), `${stem(program.name)}_g40.nc`);
  } catch (error) { await fail(error, program); }
});
$('save-svg').addEventListener('click', () => {
  const {view, tiles, compare, name} = shown.current;
  const found = shown.also.marks ? (view.diagnostics ?? []).filter(d => d.point && d.severity !== 'NOTE').map(d => ({...d, at: inPlane(view.plane, d.point)})) : [];
  const svg = svgOf(camera, {tiles: tiles.visible(camera), compared: compare && shown.also.compare ? compare.tiles.visible(camera) : [],
    arrows: shown.also.arrows ? arrowsOf(camera, tiles.visible(camera), isShown) : [], found, isShown, title: name, unit: unitOf(view), axes: axesOf(view.plane)});
  save(new Blob([svg], {type: 'image/svg+xml'}), `${stem(name)}.svg`);
});
$('save-record').addEventListener('click', async () => {
  const program = shown.current;
  try {
    save(await api.record(program, program.settings), `${stem(program.name)}_g40.json`);
  } catch (error) { await fail(error, program); }
});

$('form').addEventListener('submit', event => { event.preventDefault(); compute(); });
$('form').addEventListener('input', event => {
  event.target.setCustomValidity('');
  const {view, settings} = shown.current ?? {};
  if (!view) return;
  // The picture is that of other settings now.
  const sorted = values => JSON.stringify(Object.entries(values).sort());
  const isChanged = sorted(shown.options.values) !== sorted(settings);
  document.body.dataset.changed = isChanged;
  if (isChanged) say(t('changed'), 'warning'); else sayWhatBecame(view);
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
  const bit = (name, color, kind, i) => box(name, color, kind, () => (shown.layers >> i & 1) === 1,
    on => { shown.layers = on ? shown.layers | 1 << i : shown.layers & ~(1 << i); });
  const others = [['layerArrows', 'text', 'arrow', 'arrows'], ['layerBand', 'band', 'wide', 'band'],
    ['layerCompare', 'compare', '', 'compare'], ['layerMarks', 'finding', 'cross', 'marks'],
    ['layerProposal', 'proposal', 'dashed', 'proposals'], ['layerUncut', 'uncut', 'dotted', 'uncut']];
  $('layers').replaceChildren(
    ...styleNames.map((name, i) => bit(name, palette()[i], widths[i] < 2 ? 'thin' : '', i)),
    bit('layerRapid', special().text, 'dashed', 6),
    ...others.map(([name, color, kind, key]) =>
      box(name, special()[color], kind, () => shown.also[key], on => { shown.also[key] = on; })));
}

$('language').addEventListener('change', () => {
  translate($('language').value);
  shown.options?.translate();
  // Messages come in the language they were asked for in.
  if (shown.current?.view) { if (inside) showSaid(shown.current.view); else compute(); }
});

async function begin() {
  translate(inside?.language);
  $('language').value = currentLanguage();
  makeLayers();
  $('plane').replaceChildren(...planeNames.map((name, i) => new Option(`${name.slice(6)} (G${17 + i})`, name)));
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { makeLayers(); redraw(); });
  new ResizeObserver(resized).observe($('stage'));
  document.body.dataset.inside = inside !== null;
  if (inside) {
    shown.programs.push({name: inside.name, settings: null});
    listPrograms();
    document.title = inside.name;
    document.body.dataset.ready = 'true';
    return choose(shown.programs[0]);
  }
  shown.options = new Options($('form'), await api.openApi());
  shown.options.offerOther($('compare-setting'), $('compare-value'));
  document.body.dataset.ready = 'true';
  const token = new URLSearchParams(location.search).get('offer');
  if (!token) return;
  const {program, settings: {language, ...settings}} = await api.offer(token);
  if (language) {
    $('language').value = language;
    $('language').dispatchEvent(new Event('change'));
  }
  shown.programs.push({...program, settings});
  listPrograms();
  await choose(shown.programs[0]);
}
begin().catch(fail);
