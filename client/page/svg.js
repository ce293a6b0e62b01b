import {arcOf} from './arcs.js';
import {ticksOf} from './overlay.js';
import {palette, pathFlag, rapidFlag, segmentSize, special, sweepAt, widths} from './styles.js';

const escaped = text => text.replace(/[&<>"]/g, c => `&#${c.charCodeAt(0)};`);
const px = value => value.toFixed(2);

// To the end of a segment, as SVG has lines and arcs.
function wayTo(ax, ay, bx, by, sweep) {
  if (!sweep) return `L${px(bx)} ${px(by)}`;
  const {radius} = arcOf(ax, ay, bx, by, sweep);
  return `A${px(radius)} ${px(radius)} 0 0 ${sweep < 0 ? 1 : 0} ${px(bx)} ${px(by)}`;
}

// The segments of one look together: [key, "M…L…"].
function pathsOf(camera, tiles, keyOf) {
  const paths = new Map();
  for (const tile of tiles)
    for (let i = 0; i < tile.count; ++i) {
      const k = i * segmentSize, n = tile.numbers;
      const key = keyOf(tile.words[k + 6]);
      if (key === null) continue;
      const [ax, ay] = camera.toScreen({x: tile.x + n[k], y: tile.y + n[k + 1]});
      const [bx, by] = camera.toScreen({x: tile.x + n[k + 2], y: tile.y + n[k + 3]});
      if (!paths.has(key)) paths.set(key, []);
      paths.get(key).push(`M${px(ax)} ${px(ay)}${wayTo(ax, ay, bx, by, n[k + sweepAt])}`);
    }
  return [...paths].sort(([a], [b]) => a - b).map(([key, parts]) => [key, parts.join('')]);
}

function scales(camera, {size, name}, [first, second]) {
  const {across, up} = ticksOf(camera, size), {width, height} = camera;
  const label = (text, x, y, more = '') => `<text x="${px(x)}" y="${px(y)}"${more}>${text}</text>`;
  const names = ' font-size="13" font-style="italic"';
  return `<g font-family="sans-serif" font-size="12" fill="${special().text}">` +
    `<path d="${across.map(({at}) => `M${px(at)} ${height}v-5`).join('')}${up.map(({at}) => `M0 ${px(at)}h5`).join('')}" stroke="${special().text}"/>` +
    across.map(({at, text}) => label(text, at + 3, height - 4)).join('') +
    up.filter(({text}) => text).map(({at, text}) => label(text, 8, at + 4)).join('') +
    label(`${second.toUpperCase()} / ${name}`, 8, 16, names) +
    label(`${first.toUpperCase()} / ${name}`, width - 8, height - 22, `${names} text-anchor="end"`) + '</g>';
}

// What is seen, as SVG. `found` has the place of each finding in the plane as `at`; `unit` is that
// of the scales, `axes` are their names.
export function svgOf(camera, {tiles, compared, arrows, found, isShown, title, unit, axes}) {
  const {width, height} = camera;
  const dashes = key => (key & rapidFlag ? ' stroke-dasharray="5 5"' : '');
  const drawn = pathsOf(camera, compared, word => (word & pathFlag ? word & rapidFlag : null))
    .map(([key, d]) => `<path d="${d}" stroke="${special().compare}" stroke-width="${widths[2]}"${dashes(key)}/>`);
  const shown = word => (isShown(word & 0xff, (word & rapidFlag) !== 0) ? word & (0xff | rapidFlag) : null);
  for (const [key, d] of pathsOf(camera, tiles, shown))
    drawn.push(`<path d="${d}" stroke="${palette()[key & 0xff]}" stroke-width="${widths[key & 0xff]}"${dashes(key)}/>`);
  for (const {x, y, dx, dy, style} of arrows)
    drawn.push(`<path d="M${px(x + 7 * dx)} ${px(y + 7 * dy)}L${px(x - 5 * dx - 5 * dy)} ${px(y - 5 * dy + 5 * dx)}` +
      `L${px(x - 5 * dx + 5 * dy)} ${px(y - 5 * dy - 5 * dx)}Z" fill="${palette()[style]}" stroke="none"/>`);
  for (const {at, severity, code, text, message} of found) {
    const [x, y] = camera.toScreen(at), r = severity === 'ERROR' ? 9 : 6, s = 0.6 * r;
    drawn.push(`<path d="M${px(x - r)} ${px(y)}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0` +
      `M${px(x - s)} ${px(y - s)}L${px(x + s)} ${px(y + s)}M${px(x - s)} ${px(y + s)}L${px(x + s)} ${px(y - s)}" ` +
      `stroke="${special().finding}" stroke-width="2.5"><title>${escaped(`${code} ${text ?? message ?? ''}`)}</title></path>`);
  }
  return `<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}">` +
    `<title>${escaped(title)}</title><rect width="100%" height="100%" fill="${special().back}"/>\n` +
    `<g fill="none" stroke-linecap="round">${drawn.join('\n')}</g>\n${scales(camera, unit, axes)}</svg>\n`;
}
