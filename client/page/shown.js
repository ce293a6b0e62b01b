// What the page shows now, and how it says lengths.

export const $ = id => document.getElementById(id);

export const shown = {
  programs: [],
  current: null,       // {name, text, settings, plane, view, tiles, compareWith, compare}
  options: null,
  line: 0,             // of the program, marked
  place: null,         // of the tool
  measured: [],
  isMeasuring: false,
  layers: 0x7f,        // as bits: styles, then rapid
  also: {arrows: true, band: false, compare: true, marks: true, proposals: true, uncut: true},
};

// What was found in the plane that is compensated is drawn there.
export const isOwnPlane = view => (view.plane ?? '') === (view.ownPlane ?? '');
// Lengths are said as the program counts them.
export const unitOf = view => view?.unit === 'LENGTH_UNIT_INCH' ? {name: 'inch', size: 25.4, digits: 5} : {name: 'mm', size: 1, digits: 4};

// As controls write them, in every language.
export function inUnit(value) {
  const {size, digits} = unitOf(shown.current?.view);
  return String(Number(((value ?? 0) / size).toFixed(digits)) || 0);
}
export const withUnit = value => `${inUnit(value)} ${unitOf(shown.current?.view).name}`;

export const positionText = p => `X${inUnit(p.x)} Y${inUnit(p.y)} Z${inUnit(p.z)}`;
