import {pathFlag, rapidFlag, segmentSize, sweepAt} from './styles.js';

// Pixels: of way between two arrows at least, of a segment that carries one in its middle, and of
// short pieces that carry one together.
const nearest = 110, carrying = 34, together = 16;
// How near another arrow may be.
const cell = 30;
const mostArrows = 120;

// Where arrows say which way the path is travelled: {x, y, dx, dy, style} in pixels, the way of
// unit length. `shown` says of a style with its flags whether it is drawn.
export function arrowsOf(camera, tiles, shown) {
  const arrows = [], taken = new Set();
  const put = (x, y, dx, dy, style) => {
    if (x < 0 || y < 0 || x > camera.width || y > camera.height) return false;
    const key = `${Math.round(x / cell)}/${Math.round(y / cell)}`;
    if (taken.has(key)) return false;
    taken.add(key);
    arrows.push({x, y, dx, dy, style});
    return true;
  };
  // Where much of the path is seen they lie farther apart, over all of it.
  let whole = 0;
  for (const tile of tiles)
    for (let k = 0; k < tile.count * segmentSize; k += segmentSize)
      if (tile.words[k + 6] & pathFlag)
        whole += camera.scale * Math.hypot(tile.numbers[k + 2] - tile.numbers[k], tile.numbers[k + 3] - tile.numbers[k + 1]);
  const apart = Math.max(nearest, whole / mostArrows);
  for (const tile of tiles) {
    let since = apart / 2, way = 0, from = null, at = null;
    for (let i = 0; i < tile.count; ++i) {
      const word = tile.words[i * segmentSize + 6], n = tile.numbers, k = i * segmentSize;
      if (!(word & pathFlag) || !shown(word & 0xff, (word & rapidFlag) !== 0)) { at = null; continue; }
      const [ax, ay] = camera.toScreen({x: tile.x + n[k], y: tile.y + n[k + 1]});
      const [bx, by] = camera.toScreen({x: tile.x + n[k + 2], y: tile.y + n[k + 3]});
      const length = Math.hypot(bx - ax, by - ay);
      since += length;
      if (length >= carrying) {
        at = null;
        // In its middle an arc goes the way its chord goes, and lies beside it.
        const dx = (bx - ax) / length, dy = (by - ay) / length, aside = length / 2 * Math.tan(n[k + sweepAt] / 4);
        if (since >= apart && put((ax + bx) / 2 - aside * dy, (ay + by) / 2 + aside * dx, dx, dy, word & 0xff)) since = 0;
        continue;
      }
      if (!at || Math.hypot(at.x - ax, at.y - ay) > 1) { from = {x: ax, y: ay}; way = 0; }
      at = {x: bx, y: by};
      way += length;
      if (way < together) continue;
      const straight = Math.hypot(bx - from.x, by - from.y);
      if (since >= apart && straight > 0.95 * way && put(bx, by, (bx - from.x) / straight, (by - from.y) / straight, word & 0xff)) since = 0;
      from = at;
      way = 0;
    }
  }
  return arrows;
}
