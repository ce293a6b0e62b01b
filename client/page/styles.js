// Numbers a segment has in a tile: its ends, element, line, style with flags, radius of the tool,
// sweep of an arc.
export const segmentSize = 9;
export const sweepAt = 8;

// Colours that differ for every kind of colour vision (Okabe and Ito), by the style of an element.
export const styleNames = ['layerContour', 'layerMasked', 'layerPath', 'layerTransition', 'layerLead', 'layerPlain'];
// Aside: another plane holds there than the one that is shown.
export const rapidFlag = 0x100;
export const pathFlag = 0x200;
export const asideFlag = 0x400;
// A rapid from where nobody has said: not drawn.
export const fromUnknownFlag = 0x800;

const light = ['#1a1d21', '#d55e00', '#0072b2', '#1c9be0', '#007a5a', '#7a7a7a'];
const dark = ['#f0f2f4', '#ff8a3c', '#4db5f0', '#9bdcff', '#3fd0a4', '#9a9a9a'];
export const isDark = () => matchMedia('(prefers-color-scheme: dark)').matches;
export const palette = () => (isDark() ? dark : light);
export const special = () => isDark()
  ? {compare: '#e6a4cb', band: '#24384a', marked: '#ffd166', back: '#14171a', text: '#e8eaed', finding: '#ff8a3c', proposal: '#5ee08a', uncut: '#ff6f91'}
  : {compare: '#b0457f', band: '#dcecf7', marked: '#e69f00', back: '#ffffff', text: '#1a1d21', finding: '#a33b00', proposal: '#138a36', uncut: '#c2185b'};

export const rgb = hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16) / 255);
// Pixels: what matters is wider.
export const widths = [1.6, 3, 2.2, 2.6, 1.5, 1.4];
