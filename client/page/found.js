// What was found in a program: messages, the certificate, and the ways to a line.
import {api, inside} from './api.js';
import {Listing} from './listing.js';
import {motionsOf, textOf} from './motions.js';
import {boundsOf, cornersOf, redraw, zoomTo} from './picture.js';
import {axesOf, inPlane} from './planes.js';
import {settingWord} from './settings_texts.js';
import {$, inUnit, isOwnPlane, positionText, shown, withUnit} from './shown.js';
import {currentLanguage, t} from './texts.js';

export function say(text, kind = '') {
  $('state').textContent = text;
  $('state').className = kind;
}

// A file that has changed since it was opened can no longer be read.
const isReadable = ({text}) => !(text instanceof Blob) || text.slice(0, 1).arrayBuffer().then(() => true, () => false);

export async function fail(error, program) {
  const problem = error.problem;
  const setting = problem?.fields && shown.options.refuse(problem.fields);
  say(setting || (problem ? t('failed') + error.message : t(await isReadable(program) ? 'offline' : 'unreadable')), 'error');
}

// Why another setting gives nothing to compare with.
export function reasonOf(error, settings) {
  const {problem} = error;
  if (!problem) return t('offline');
  const [[name, value]] = Object.entries(settings);
  const isOfSetting = problem.fields?.some(f => f.field === name || f.field.endsWith(`.${name}`));
  return isOfSetting ? shown.options.impossible(name, value) : t('failed') + error.message;
}

// As the summary tells it; of a refused program only the picture knows.
export const lengthOf = view => view.summary?.path?.compensatedLength ?? view.pathLength;

export function showSaid(view) {
  const found = view.diagnostics ?? [];
  sayWhatBecame(view);
  const order = {ERROR: 0, WARNING: 1, NOTE: 2};
  const items = [...wayOut(found), ...[...found].sort((a, b) => order[a.severity] - order[b.severity]).map(item)];
  shown.current.proposals = !isOwnPlane(view) ? [] : found.flatMap(d => (d.entryHelp?.proposals ?? []).map(p => motionsOf(p, at => inPlane(view.plane, at))));
  if (view.diagnosticsLeftOut) {
    const rest = document.createElement('li');
    rest.textContent = `${view.diagnosticsLeftOut} ${t('leftOut')}`;
    items.push(rest);
  }
  $('diagnostics').replaceChildren(...items);
  showCertificate(view);
}

// In a word; what is worst.
export function sayWhatBecame(view) {
  const found = view.diagnostics ?? [];
  if (view.refused) return say(t(view.pathBlocks ? 'refused' : 'refusedAll'), 'error');
  if (view.summary?.path?.minClearance?.blocksGouging) return say(t('gouges'), 'error');
  if (found.some(d => d.severity === 'WARNING')) return say(t('warnings'), 'warning');
  if (!view.toolRadius) return say(t('uncompensated'), 'warning');
  say(t(view.measuring ? 'doneSoFar' : found.length ? 'notes' : 'done'));
}

// The radius that was set is none of those the program compensates with.
export function hasOwnRadius(view, settings) {
  const given = Math.abs(Number(settings?.tool_radius));
  if (!(given > 0) || !view.toolRadii || ['wear', 'allowance', 'nominal_radius', 'tools'].some(name => name in {...shown.current.settings, ...settings})) return false;
  return !view.toolRadii.some(radius => Math.abs(radius - given) < 1e-6);
}

function item(diagnostic) {
  const kind = diagnostic.severity.toLowerCase();
  const button = document.createElement('button');
  button.className = kind;
  const head = document.createElement('strong');
  head.textContent = `${t(kind)} ${diagnostic.code}` + (diagnostic.line ? `, ${t('line')} ${diagnostic.line}` : '');
  const remedy = document.createElement('span');
  remedy.className = 'remedy';
  remedy.textContent = helpOf(diagnostic).replace('SurveyRadii (trc radii)', inside ? 'trc radii' : t('quoted', {word: t('largest')}));
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

const helpOf = diagnostic => diagnostic.help ?? diagnostic.remedy ?? '';

// A program of another control is read as one by a click. Where several would do none is offered.
function wayOut(found) {
  const dialect = inside ? null : found.filter(d => d.severity === 'ERROR').map(d => /--dialect (\w+)\b(?!, \w)/.exec(helpOf(d))?.[1]).find(Boolean);
  if (!dialect || shown.options.values.dialect === dialect) return [];
  const entry = document.createElement('li'), button = document.createElement('button');
  button.className = 'way-out';
  button.textContent = t('readAs', {dialect: settingWord(dialect, currentLanguage())});
  button.addEventListener('click', () => {
    shown.options.inputs.get('dialect').value = dialect;
    $('form').requestSubmit();
  });
  entry.append(button);
  return [entry];
}

// What would do in place of the approach or the retract that was refused.
function helpWithEntry(help) {
  const {view} = shown.current;
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
    const shape = t({SHAPE_LINE: 'asLine', SHAPE_INSIDE_CORNER: 'asCorner'}[proposal.shape] ?? 'asQuarter');
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

function radiiText(radii) {
  const few = 4, sorted = [...radii].sort((a, b) => a - b);
  if (sorted.length > few) return `${inUnit(sorted[0])} … ${withUnit(sorted.at(-1))}`;
  return [...sorted.slice(0, -1).map(inUnit), withUnit(sorted.at(-1))].join(', ');
}

function showCertificate(view) {
  const rows = [];
  const add = (name, value) => {
    const dt = document.createElement('dt'), dd = document.createElement('dd');
    dt.textContent = name;
    // Numbers stay with their units.
    dd.append(...[value].flat().flatMap((part, i) => {
      const whole = document.createElement('span');
      whole.textContent = part;
      return i ? [' ', whole] : [whole];
    }));
    rows.push(dt, dd);
  };
  const c = view.summary?.path?.minClearance;
  if (c) {
    add(t('smallest'), [`${withUnit(c.distance)},`, `${t('required')} ${withUnit(c.toolRadius)}`]);
    if (c.point) add(t('at'), positionText(c.point).split(' '));
    add(t('checked'), `${c.blocksChecked ?? 0}`);
    if (c.blocksGouging) add(t('tooNear'), `${c.blocksGouging}`);
    const {coverage} = view.summary.path;
    if (coverage !== undefined) add(t('touched'), `${(100 * coverage).toFixed(1)} %`);
  } else {
    add(t('smallest'), t(view.measuring ? 'measuring' : view.refused ? 'notMeasuredRefused' : view.toolRadius ? 'notMeasured' : 'none'));
  }
  if (view.toolRadii) add(t('tool'), radiiText(view.toolRadii));
  if (hasOwnRadius(view, shown.current.settings)) add('', t('ownRadius', {radius: withUnit(view.toolRadius)}));
  if (!view.pathBlocks) return $('certificate').replaceChildren(...rows);
  add(t('plane'), axesOf(view.plane).slice(0, 2).join('').toUpperCase());
  const measured = axesOf(view.ownPlane).slice(0, 2).join('').toUpperCase();
  add(isOwnPlane(view) ? t('length') : t('lengthIn', {plane: measured}), [`${withUnit(lengthOf(view))},`, `${view.pathBlocks} ${t(Number(view.pathBlocks) === 1 ? 'block' : 'blocks')}`]);
  add(t('height'), `${axesOf(view.plane)[2].toUpperCase()} ${inUnit(view.lowest)} … ${withUnit(view.highest)}`);
  $('certificate').replaceChildren(...rows);
}

async function goTo(diagnostic) {
  const {view} = shown.current;
  // On a narrow screen it lies above.
  $('stage').scrollIntoView({block: 'nearest'});
  if (diagnostic.point) {
    const at = inPlane(view.plane, diagnostic.point);
    zoomTo(view, at, at);
  }
  await mark(diagnostic.line ?? 0, !diagnostic.point);
}

export async function mark(to, zoom) {
  shown.line = to;
  redraw();
  input.select(to);
  output.select(to);
  if (!zoom || !to) return;
  const {view} = shown.current;
  const {blocks = []} = await api.blocks(view.id, to);
  if (blocks.length && shown.current?.view === view) {
    zoomTo(view, ...boundsOf(view, blocks));
    redraw();
  }
}

export const input = new Listing($('input'), 'lines', to => mark(to, true));
export const output = new Listing($('output'), 'output', to => mark(to, true));
