import {api} from './api.js';
import {arcOf, nearestOnArc} from './arcs.js';
import {segmentSize, sweepAt} from './styles.js';

// The part of the plane that is seen, and the tiles of a view that cover it.
export class Camera {
  constructor() { this.x = 0; this.y = 0; this.scale = 1; this.width = 1; this.height = 1; }
  toScreen(p) { return [(p.x - this.x) * this.scale + this.width / 2, this.height / 2 - (p.y - this.y) * this.scale]; }
  toPlane(sx, sy) { return {x: (sx - this.width / 2) / this.scale + this.x, y: (this.height / 2 - sy) / this.scale + this.y}; }
  zoom(factor, sx = this.width / 2, sy = this.height / 2) {
    const before = this.toPlane(sx, sy);
    this.scale = Math.min(1e7, Math.max(1e-5, this.scale * factor));
    const after = this.toPlane(sx, sy);
    this.x += before.x - after.x;
    this.y += before.y - after.y;
  }
  show(low, high) {
    this.x = (low.x + high.x) / 2;
    this.y = (low.y + high.y) / 2;
    // What is a point is shown in its surroundings.
    const least = Math.max(high.x - low.x, high.y - low.y) > 0 ? 1e-3 : 10;
    this.scale = 0.9 * Math.min(this.width / Math.max(high.x - low.x, least), this.height / Math.max(high.y - low.y, least));
  }
}

// The point of a segment of a tile that is nearest to another one.
function nearestOn(numbers, x, y) {
  const [ax, ay, bx, by] = numbers, sweep = numbers[sweepAt];
  if (sweep) return nearestOnArc(arcOf(ax, ay, bx, by, sweep), x, y);
  const dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;
  const s = square > 0 ? Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
  return {x: ax + s * dx, y: ay + s * dy};
}

const tilePixels = 512;
// Of all tiles that are seen together: lines, and the band that reaches in from beside the picture.
const mostSegments = 40_000, mostOfBand = 10_000, mostOfTile = 8192;
const mostTiles = 160;
const longestIncomplete = 100;  // ms that a picture waits for its last tiles

export class Tiles {
  constructor(view, changed) {
    this.view = view;
    this.changed = changed;
    this.loaded = new Map();  // "level/x/y" → tile, the one used longest ago first
    this.asked = new Map();
    this.wanted = new Set();
    // Once all that is seen of it has been drawn, or nothing more will be.
    this.drawn = new Promise(resolve => { this.settle = resolve; });
  }

  // Around what draws one picture: tiles that were asked for and nobody wants are given up.
  begin() { this.wanted = new Set(); }
  end() {
    for (const [key, {abort, isAhead}] of this.asked)
      if (!isAhead && !this.wanted.has(key)) { abort.abort(); this.asked.delete(key); }
  }

  // Tiles to draw, coarse ones first where fine ones are still on their way. `isAhead`: they are asked
  // for, but nobody waits for them.
  visible(camera, kind = '', isAhead = false) {
    const {view} = this;
    const size = view.tileSize;
    const level = Math.max(0, Math.min(view.mostLevel, Math.round(Math.log2(size * camera.scale / tilePixels))));
    const side = size / 2 ** level;
    const low = camera.toPlane(0, camera.height);
    const high = camera.toPlane(camera.width, 0);
    const index = (value, from) => Math.floor((value - from) / side);
    const clamp = i => Math.max(0, Math.min(2 ** level - 1, i));
    const lowX = view.tileLow?.x ?? 0, lowY = view.tileLow?.y ?? 0;
    if (high.x < lowX || high.y < lowY || low.x > lowX + size || low.y > lowY + size) return [];
    // A tile is seen at least that large, one more begins at each edge.
    const across = pixels => Math.ceil(pixels / (tilePixels * Math.SQRT1_2)) + 1;
    const segments = Math.floor(Math.min(mostOfTile, (kind ? mostOfBand : mostSegments) / (across(camera.width) * across(camera.height))));
    const draw = new Map();
    for (let y = clamp(index(low.y, lowY)); y <= clamp(index(high.y, lowY)); ++y)
      for (let x = clamp(index(low.x, lowX)); x <= clamp(index(high.x, lowX)); ++x) {
        const key = `${kind}${level}/${x}/${y}`;
        if (!isAhead) this.wanted.add(key);
        if (!this.loaded.has(key)) this.ask(key, {level, x, y, segments}, isAhead);
        const found = this.nearest(kind, level, x, y);
        if (found) draw.set(found.key, found);
      }
    return [...draw.values()].sort((a, b) => a.level - b.level);
  }

  // The tiles whose swept band may be seen: the tool reaches in from beside the picture.
  swept(camera, radius) {
    const reach = 2 * radius * camera.scale;
    const share = Math.min(camera.width / (camera.width + reach), camera.height / (camera.height + reach));
    if (share > 0.9) return this.visible(camera);
    const wide = Object.assign(new Camera(), camera);
    wide.scale *= share;
    return this.visible(wide, 'band/');
  }

  // Loads what is shown next by whoever looks closer at a point of the screen.
  lookAhead(camera, sx, sy) {
    const closer = Object.assign(new Camera(), camera);
    closer.zoom(2, sx, sy);
    this.visible(closer, '', true);
  }

  nearest(kind, level, x, y) {
    for (; level >= 0; --level, x >>= 1, y >>= 1) {
      const key = `${kind}${level}/${x}/${y}`;
      const found = this.loaded.get(key);
      if (!found) continue;
      this.loaded.delete(key);
      this.loaded.set(key, found);
      return found;
    }
    return null;
  }

  async ask(key, name, isAhead) {
    const before = this.asked.get(key);
    if (before) { before.isAhead &&= isAhead; return; }
    const own = {abort: new AbortController(), isAhead};
    this.asked.set(key, own);
    try {
      const {level, x, y} = name;
      const bytes = await api.tile(this.view.id, name, own.abort.signal);
      const count = new DataView(bytes).getUint32(4, true);
      const side = this.view.tileSize / 2 ** level;
      this.loaded.set(key, {key, level, count, side, bytes,
        x: (this.view.tileLow?.x ?? 0) + x * side, y: (this.view.tileLow?.y ?? 0) + y * side,
        numbers: new Float32Array(bytes, 16, count * segmentSize), words: new Uint32Array(bytes, 16, count * segmentSize)});
      while (this.loaded.size > mostTiles) {
        const [oldest, tile] = this.loaded.entries().next().value;
        tile.release?.();
        this.loaded.delete(oldest);
      }
      this.asked.delete(key);
      if (!own.isAhead) this.arrived(key);
    } catch (error) {
      this.asked.delete(key);
      if (own.isAhead || error.name === 'AbortError') return;
      this.settle();
      this.lost?.(error);
    }
  }

  // The tiles of a picture come at nearly the same time: each picture drawn in between holds the last
  // one up. Where they do not, what is there by then is shown.
  arrived(key) {
    if (this.complete) return this.changed();
    if (this.wanted.has(key)) this.later ??= setTimeout(() => { this.later = null; this.changed(); }, longestIncomplete);
  }

  get complete() { return ![...this.asked.values()].some(({isAhead}) => !isAhead); }

  release() {
    this.settle();
    clearTimeout(this.later);
    for (const {abort} of this.asked.values()) abort.abort();
    for (const tile of this.loaded.values()) tile.release?.();
    this.loaded.clear();
  }

  // The segment nearest to a point, within `reach` mm.
  pick(camera, at, reach) {
    let best = null;
    for (const tile of this.visible(camera))
      for (let i = 0; i < tile.count; ++i) {
        const n = tile.numbers, k = i * segmentSize, x = at.x - tile.x, y = at.y - tile.y;
        const near = nearestOn(n.subarray(k, k + segmentSize), x, y);
        const distance = Math.hypot(x - near.x, y - near.y);
        if (distance <= reach && (!best || distance < best.distance))
          best = {distance, element: tile.words[k + 4], line: tile.words[k + 5], style: tile.words[k + 6],
            point: {x: tile.x + near.x, y: tile.y + near.y}};
      }
    return best;
  }
}
