import {palette, rapidFlag, widths} from './styles.js';

const escaped = text => text.replace(/[&<>"]/g, c => `&#${c.charCodeAt(0)};`);

// What is seen, as SVG.
export function svgOf(camera, tiles, title) {
  const paths = new Map();
  for (const tile of tiles)
    for (let i = 0; i < tile.count; ++i) {
      const word = tile.words[i * 7 + 6];
      const [ax, ay] = camera.toScreen({x: tile.x + tile.numbers[i * 7], y: tile.y + tile.numbers[i * 7 + 1]});
      const [bx, by] = camera.toScreen({x: tile.x + tile.numbers[i * 7 + 2], y: tile.y + tile.numbers[i * 7 + 3]});
      const key = word & (0xff | rapidFlag);
      if (!paths.has(key)) paths.set(key, []);
      paths.get(key).push(`M${ax.toFixed(2)} ${ay.toFixed(2)}L${bx.toFixed(2)} ${by.toFixed(2)}`);
    }
  const drawn = [...paths].sort(([a], [b]) => a - b).map(([key, parts]) => {
    const style = key & 0xff;
    return `<path d="${parts.join('')}" stroke="${palette()[style]}" stroke-width="${widths[style]}"` +
      `${key & rapidFlag ? ' stroke-dasharray="5 5"' : ''}/>`;
  });
  return `<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg" width="${camera.width}" height="${camera.height}">` +
    `<title>${escaped(title)}</title><g fill="none" stroke-linecap="round">${drawn.join('\n')}</g></svg>\n`;
}
