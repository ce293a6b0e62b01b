import {arcOf} from './arcs.js';
import {asideFlag, palette, pathFlag, rapidFlag, segmentSize, special, sweepAt, widths} from './styles.js';

// Draws the same without a graphics processor.
export class Canvas2d {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d', {alpha: false});
  }

  begin(camera, ratio) {
    this.camera = camera;
    this.ratio = ratio;
    const c = this.context;
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.fillStyle = special().back;
    c.fillRect(0, 0, this.canvas.width, this.canvas.height);
    c.lineCap = c.lineJoin = 'round';
  }

  draw(tiles, how) {
    const paths = new Map();
    for (const tile of tiles)
      for (let i = 0; i < tile.count; ++i) {
        const k = i * segmentSize, n = tile.numbers;
        const word = tile.words[k + 6], style = word & 255, isPath = (word & pathFlag) !== 0;
        const radius = how.band ? n[k + 7] : 0, rapid = (word & rapidFlag) !== 0;
        const marked = how.line && tile.words[k + 5] === how.line;
        if (how.band) {
          if (!isPath || rapid || (word & asideFlag) || style < 2 || style > 4 || radius <= 0) continue;
        } else if (how.compare ? !isPath : !(how.layers >> style & 1) || (rapid && !(how.layers >> 6 & 1))) {
          continue;
        }
        const key = `${style}/${rapid}/${marked}/${radius}`;
        if (!paths.has(key)) paths.set(key, {style, rapid, marked, radius, path: new Path2D()});
        const [ax, ay] = this.toPixels(tile.x + n[k], tile.y + n[k + 1]);
        const [bx, by] = this.toPixels(tile.x + n[k + 2], tile.y + n[k + 3]);
        const {path} = paths.get(key), sweep = n[k + sweepAt];
        path.moveTo(ax, ay);
        if (sweep) {
          // The screen counts angles the other way round.
          const {x, y, radius, begin} = arcOf(ax, ay, bx, by, -sweep);
          path.arc(x, y, radius, begin, begin - sweep, sweep > 0);
        } else {
          path.lineTo(bx, by + (ax === bx && ay === by ? 0.01 : 0));
        }
      }
    const c = this.context;
    for (const {style, rapid, marked, radius, path} of paths.values()) {
      c.strokeStyle = marked ? special().marked : how.color ?? palette()[style];
      c.lineWidth = how.band ? 2 * radius * this.camera.scale * this.ratio : widths[style] * this.ratio * (marked ? 2.4 : 1);
      c.setLineDash(rapid ? [5, 5] : []);
      c.stroke(path);
    }
  }

  toPixels(x, y) {
    const {camera, ratio} = this;
    return [((x - camera.x) * camera.scale + camera.width / 2) * ratio, (camera.height / 2 - (y - camera.y) * camera.scale) * ratio];
  }
}
