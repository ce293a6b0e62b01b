// Every word of the page, in each language. Messages come from the server in it.
export const words = {
  en: {
    open: 'Open …', program: 'Program', saveNc: 'Save NC', saveSvg: 'Save SVG', language: 'Language',
    settings: 'Settings', more: 'All settings', compute: 'Compensate', compare: 'Compare with',
    compareSetting: 'Another', compareValue: 'Value', refusedShort: 'refused', saveRecord: 'Save record', show: 'Show', hide: 'Hide', layers: 'Shown',
    picture: 'Picture', pictureHelp: 'Contour and path. Arrow keys move, plus and minus zoom, 0 shows all, M measures, Enter takes the middle.',
    drop: 'Drop NC programs here, or open them', fit: 'Show all', zoomIn: 'Closer', zoomOut: 'Farther',
    measure: 'Measure', way: 'Tool on its path', play: 'Run', halt: 'Stop', said: 'Findings', certificate: 'Clearance', input: 'Program',
    output: 'Compensated', listings: 'NC text', done: 'Compensated, nothing to complain about', doneSoFar: 'Compensated, being measured …', warnings: 'Compensated, with warnings',
    gouges: 'Do not machine this: the path comes too near to the contour', uncompensated: 'Nothing is compensated: no G41 or G42 with a radius',
    notes: 'Compensated, with remarks', refused: 'Refused: the path ends where it was certain', refusedAll: 'Refused: nothing of it is compensated', readAs: 'Read it as {dialect}', changed: 'The settings have changed: compensate again',
    noMotion: 'There is no motion to show', unreadable: 'the file has changed or cannot be read: open it again',
    working: 'At work …', failed: 'The server says: ', impossible: '{name}: “{value}” is not possible; it takes: {takes}', line: 'line',
    error: 'Error', warning: 'Warning', note: 'Note', leftOut: 'more are not shown',
    smallest: 'smallest distance', required: 'needed', at: 'at', checked: 'blocks measured', tooNear: 'too near',
    noDifference: 'no difference', ownRadius: 'the program has its own radius: {radius}; wear changes it',
    none: 'nothing to measure', measuring: 'being measured …', notMeasured: 'not measured: a large program, set “Measure the path”', notMeasuredRefused: 'not measured: refused', length: 'path length in the plane', lengthIn: 'path length in {plane}', touched: 'wall touched', blocks: 'blocks', block: 'block', tool: 'tool radius', plane: 'plane', seenIn: 'Plane',
    height: 'height', pending: 'being written …', noOutput: 'refused: there is no compensated program',
    layerContour: 'contour', layerMasked: 'not travelled', layerPath: 'path', layerTransition: 'inserted',
    layerLead: 'leads, approach, retract', layerPlain: 'not compensated', layerRapid: 'rapid',
    layerArrows: 'direction', layerBand: 'swept by the tool', layerCompare: 'compared path', layerMarks: 'findings',
    proposedEntry: 'Proposed entry',
    proposedExit: 'Proposed exit',
    asLine: 'line',
    asQuarter: 'quarter circle',
    asCorner: 'line with G238',
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
    of: 'of', quoted: '“{word}”', decimalPoint: 'with a decimal point: {number}',
    insideNote: 'This file holds one program as it was compensated. trc view computes it anew, with other settings too.',
    aboutSettings: 'What a setting means is said here, when you point at it.',
    unset: 'not set', initially: 'default {value}', offline: 'the server cannot be reached',
  },
  de: {
    open: 'Öffnen …', program: 'Programm', saveNc: 'NC speichern', saveSvg: 'SVG speichern', language: 'Sprache',
    settings: 'Einstellungen', more: 'Alle Einstellungen', compute: 'Korrigieren', compare: 'Vergleichen mit',
    compareSetting: 'Andere Einstellung', compareValue: 'Wert', refusedShort: 'abgelehnt', saveRecord: 'Protokoll speichern', show: 'Zeigen', hide: 'Verbergen', layers: 'Darstellung',
    picture: 'Bild', pictureHelp: 'Kontur und Bahn. Pfeiltasten verschieben, Plus und Minus zoomen, 0 zeigt alles, M misst, Enter nimmt die Mitte.',
    drop: 'NC-Programme hierher ziehen oder öffnen', fit: 'Alles zeigen', zoomIn: 'Näher', zoomOut: 'Weiter weg',
    measure: 'Messen', way: 'Werkzeug auf der Bahn', play: 'Abfahren', halt: 'Anhalten', said: 'Befunde', certificate: 'Abstand', input: 'Programm',
    output: 'Korrigiert', listings: 'NC-Text', done: 'Korrigiert, nichts zu beanstanden', doneSoFar: 'Korrigiert, wird gemessen …', warnings: 'Korrigiert, mit Warnungen',
    gouges: 'Nicht fertigen: die Bahn kommt der Kontur zu nah', uncompensated: 'Nichts wird korrigiert: kein G41 oder G42 mit einem Radius',
    notes: 'Korrigiert, mit Hinweisen', refused: 'Abgelehnt: die Bahn endet, wo sie noch sicher war', refusedAll: 'Abgelehnt: nichts davon ist korrigiert', readAs: 'Als {dialect} lesen', changed: 'Die Einstellungen sind geändert: neu korrigieren',
    noMotion: 'Keine Bewegung zu zeigen', unreadable: 'die Datei ist geändert oder nicht lesbar: neu öffnen',
    working: 'Rechnet …', failed: 'Der Server meldet: ', impossible: '{name}: „{value}“ ist nicht möglich; möglich: {takes}', line: 'Zeile',
    error: 'Fehler', warning: 'Warnung', note: 'Hinweis', leftOut: 'weitere werden nicht gezeigt',
    smallest: 'kleinster Abstand', required: 'nötig', at: 'bei', checked: 'Sätze gemessen', tooNear: 'zu nah',
    noDifference: 'kein Unterschied', ownRadius: 'das Programm hat einen eigenen Radius: {radius}; Verschleiß ändert ihn',
    none: 'nichts zu messen', measuring: 'wird gemessen …', notMeasured: 'nicht gemessen: großes Programm, „Bahn nachmessen“ setzen', notMeasuredRefused: 'nicht gemessen: abgelehnt', length: 'Bahnlänge in der Ebene', lengthIn: 'Bahnlänge in {plane}', touched: 'Wand berührt', blocks: 'Sätze', block: 'Satz', tool: 'Werkzeugradius', plane: 'Ebene', seenIn: 'Ebene',
    height: 'Höhe', pending: 'wird geschrieben …', noOutput: 'abgelehnt: es gibt kein korrigiertes Programm',
    layerContour: 'Kontur', layerMasked: 'nicht befahren', layerPath: 'Bahn', layerTransition: 'eingefügt',
    layerLead: 'Ein-/Auslauf, An- und Abfahren', layerPlain: 'ohne Korrektur', layerRapid: 'Eilgang',
    layerArrows: 'Richtung', layerBand: 'vom Werkzeug überstrichen', layerCompare: 'verglichene Bahn', layerMarks: 'Befunde',
    proposedEntry: 'Vorschlag zum Anfahren',
    proposedExit: 'Vorschlag zum Abfahren',
    asLine: 'Strecke',
    asQuarter: 'Viertelkreis',
    asCorner: 'Strecke mit G238',
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
    of: 'von', quoted: '„{word}“', decimalPoint: 'mit Dezimalpunkt: {number}',
    insideNote: 'Diese Datei enthält ein Programm, wie es korrigiert wurde. trc view rechnet es neu, auch mit anderen Einstellungen.',
    aboutSettings: 'Was eine Einstellung bedeutet, steht hier, wenn Sie auf sie zeigen.',
    unset: 'nicht gesetzt', initially: 'sonst {value}', offline: 'der Server ist nicht erreichbar',
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
