// Every word of the page, in each language. Messages come from the server in it.
export const words = {
  en: {
    open: 'Open …', program: 'Program', saveNc: 'Save NC', saveSvg: 'Save SVG', language: 'Language',
    settings: 'Settings', more: 'All settings', compute: 'Compensate', compare: 'Compare',
    compareSetting: 'The same with another', compareValue: 'Value', refusedShort: 'refused', saveRecord: 'Save record', show: 'Show', hide: 'Hide', layers: 'Layers',
    picture: 'Picture', pictureHelp: 'Contour and path. Arrow keys move, plus and minus zoom, 0 shows all, M measures, Enter takes the middle.',
    drop: 'Drop NC programs here, or open them', fit: 'Show all', zoomIn: 'Closer', zoomOut: 'Farther',
    measure: 'Measure', way: 'Way', said: 'What was found', certificate: 'Clearance', input: 'Program',
    output: 'Compensated', listings: 'NC text', done: 'Compensated, nothing to complain about',
    notes: 'Compensated, with remarks', refused: 'Refused: the path ends where it was certain',
    working: 'At work …', failed: 'The server says: ', unknown: 'unset', line: 'line',
    error: 'Error', warning: 'Warning', note: 'Note', leftOut: 'more are not shown',
    smallest: 'smallest', required: 'of', at: 'at', checked: 'blocks measured', tooNear: 'too near',
    none: 'nothing to measure', measuring: 'being measured …', notMeasured: 'not measured: a large program, set verify to report', length: 'way', blocks: 'blocks', tool: 'tool radius', plane: 'plane', seenIn: 'Plane',
    height: 'height', pending: 'being written …', noOutput: 'refused: there is no compensated program',
    layerContour: 'contour', layerMasked: 'not travelled', layerPath: 'path', layerTransition: 'inserted',
    layerLead: 'approach, retract', layerPlain: 'beside the contour', layerRapid: 'rapid',
    layerArrows: 'direction', layerBand: 'swept by the tool', layerCompare: 'compared path', layerMarks: 'findings',
    proposedEntry: 'Proposed entry',
    proposedExit: 'Proposed exit',
    asLine: 'line',
    asQuarter: 'quarter circle',
    arc: 'arc',
    tooShort: '{given} long, needs at least {needed}',
    mayStart: 'may start at {at}',
    mayEnd: 'may end at {at}',
    layerProposal: 'proposals',
    layerUncut: 'stays uncut',
    largest: 'Largest radius',
    largestIs: 'Largest radius that reaches every wall:',
    largestNone: 'No radius reaches every wall.',
    atLeast: 'at least',
    limitedBy: 'limited by',
    uncut: 'stay uncut with {radius}',
    of: 'of',
    insideNote: 'This file holds one program as it was compensated. trc view computes it anew, with other settings too.',
    all: 'as the program', offline: 'the server cannot be reached',
  },
  de: {
    open: 'Öffnen …', program: 'Programm', saveNc: 'NC speichern', saveSvg: 'SVG speichern', language: 'Sprache',
    settings: 'Einstellungen', more: 'Alle Einstellungen', compute: 'Korrigieren', compare: 'Vergleichen',
    compareSetting: 'Dasselbe, aber anders:', compareValue: 'Wert', refusedShort: 'abgelehnt', saveRecord: 'Protokoll speichern', show: 'Zeigen', hide: 'Verbergen', layers: 'Darstellung',
    picture: 'Bild', pictureHelp: 'Kontur und Bahn. Pfeiltasten verschieben, Plus und Minus zoomen, 0 zeigt alles, M misst, Enter nimmt die Mitte.',
    drop: 'NC-Programme hierher ziehen oder öffnen', fit: 'Alles zeigen', zoomIn: 'Näher', zoomOut: 'Weiter weg',
    measure: 'Messen', way: 'Weg', said: 'Befunde', certificate: 'Abstand', input: 'Programm',
    output: 'Korrigiert', listings: 'NC-Text', done: 'Korrigiert, nichts zu beanstanden',
    notes: 'Korrigiert, mit Hinweisen', refused: 'Abgelehnt: die Bahn endet, wo sie noch sicher war',
    working: 'Rechnet …', failed: 'Der Server meldet: ', unknown: 'nicht gesetzt', line: 'Zeile',
    error: 'Fehler', warning: 'Warnung', note: 'Hinweis', leftOut: 'weitere werden nicht gezeigt',
    smallest: 'kleinster', required: 'von', at: 'bei', checked: 'Sätze gemessen', tooNear: 'zu nah',
    none: 'nichts zu messen', measuring: 'wird gemessen …', notMeasured: 'nicht gemessen: großes Programm, verify auf report setzen', length: 'Weg', blocks: 'Sätze', tool: 'Werkzeugradius', plane: 'Ebene', seenIn: 'Ebene',
    height: 'Höhe', pending: 'wird geschrieben …', noOutput: 'abgelehnt: es gibt kein korrigiertes Programm',
    layerContour: 'Kontur', layerMasked: 'nicht befahren', layerPath: 'Bahn', layerTransition: 'eingefügt',
    layerLead: 'An- und Abfahren', layerPlain: 'neben der Kontur', layerRapid: 'Eilgang',
    layerArrows: 'Richtung', layerBand: 'vom Werkzeug überstrichen', layerCompare: 'verglichene Bahn', layerMarks: 'Befunde',
    proposedEntry: 'Vorschlag zum Anfahren',
    proposedExit: 'Vorschlag zum Abfahren',
    asLine: 'Strecke',
    asQuarter: 'Viertelkreis',
    arc: 'Bogen',
    tooShort: '{given} lang, braucht mindestens {needed}',
    mayStart: 'darf bei {at} beginnen',
    mayEnd: 'darf bei {at} enden',
    layerProposal: 'Vorschläge',
    layerUncut: 'bleibt stehen',
    largest: 'Größter Radius',
    largestIs: 'Größter Radius, der jede Wand erreicht:',
    largestNone: 'Kein Radius erreicht jede Wand.',
    atLeast: 'mindestens',
    limitedBy: 'begrenzt durch',
    uncut: 'bleiben mit {radius} stehen',
    of: 'von',
    insideNote: 'Diese Datei enthält ein Programm, wie es korrigiert wurde. trc view rechnet es neu, auch mit anderen Einstellungen.',
    all: 'wie im Programm', offline: 'der Server ist nicht erreichbar',
  },
};

let language = navigator.language.startsWith('de') ? 'de' : 'en';
// `values` stand where the text has their name in braces.
export const t = (key, values = {}) =>
  (words[language][key] ?? key).replace(/{(\w+)}/g, (all, name) => values[name] ?? all);
export const currentLanguage = () => language;

// Puts the words into the page: data-text is the content, data-label the accessible name.
export function translate(to = language) {
  language = to in words ? to : 'en';
  document.documentElement.lang = language;
  for (const element of document.querySelectorAll('[data-text]'))
    element.textContent = t(element.dataset.text);
  for (const element of document.querySelectorAll('[data-label]'))
    element.setAttribute('aria-label', t(element.dataset.label));
}
