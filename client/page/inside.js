import {axesOf, inPlane, planeNames, positionOf} from './planes.js';
import {asideFlag, fromUnknownFlag, pathFlag, rapidFlag, segmentSize} from './styles.js';

// A program that lies in this file itself, as `trc plot -o part.html` writes it: it is asked as the
// server is.
const bytesOf = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));
// Text that is no UTF-8 is Latin-1, as on the page of a server.
const decoded = bytes => {
  try { return new TextDecoder('utf-8', {fatal: true}).decode(bytes); } catch { return new TextDecoder('latin1').decode(bytes); }
};
const linesOf = bytes => {
  const lines = decoded(bytes).split(/\r?\n/);
  if (lines.at(-1) === '') lines.pop();
  return lines;
};

const groupSize = 64;
const styleBits = 0xff, planeShift = 12;
const contourMasked = 1, transition = 3;

// The elements of the contour, or of the path, in columns.
class Elements {
  static decoded({ends, values, words, arcs}, plane) {
    return new Elements(plane, new Float64Array(bytesOf(ends).buffer), new Float32Array(bytesOf(values).buffer),
      new Uint32Array(bytesOf(words).buffer), new Float64Array(bytesOf(arcs).buffer));
  }

  // `plane` is the one they are seen in.
  constructor(plane, ends, values, words, arcs) {
    Object.assign(this, {plane, ends, values, words, arcs});
    this.count = this.ends.length / 4;
    this.boxes = new Float64Array(4 * Math.ceil(this.count / groupSize)).fill(NaN);
    this.lengths = new Float64Array(this.count + 1);
    const box = [0, 0, 0, 0];
    for (let i = 0; i < this.count; ++i) {
      this.boxOf(i, box);
      const k = 4 * Math.floor(i / groupSize), isNew = i % groupSize === 0;
      for (const at of [0, 1]) this.boxes[k + at] = isNew ? box[at] : Math.min(this.boxes[k + at], box[at]);
      for (const at of [2, 3]) this.boxes[k + at] = isNew ? box[at] : Math.max(this.boxes[k + at], box[at]);
      this.lengths[i + 1] = this.lengths[i] + this.lengthOf(i);
    }
  }

  line(i) { return this.words[3 * i]; }
  style(i) { return this.words[3 * i + 1] & styleBits; }
  isRapid(i) { return (this.words[3 * i + 1] & rapidFlag) !== 0; }
  isFromUnknown(i) { return (this.words[3 * i + 1] & fromUnknownFlag) !== 0; }
  isSpecial(i) { return this.style(i) === contourMasked || this.style(i) === transition; }
  arc(i) {
    const k = 3 * (this.words[3 * i + 2] - 1);
    return k < 0 ? null : {x: this.arcs[k], y: this.arcs[k + 1], sweep: this.arcs[k + 2]};
  }

  // The point after a share of an element.
  at(i, share) {
    const [ax, ay, bx, by] = this.ends.subarray(4 * i, 4 * i + 4);
    const arc = this.arc(i);
    if (share >= 1) return {x: bx, y: by};
    if (!arc) return {x: ax + share * (bx - ax), y: ay + share * (by - ay)};
    const c = Math.cos(arc.sweep * share), s = Math.sin(arc.sweep * share);
    const dx = ax - arc.x, dy = ay - arc.y;
    return {x: arc.x + c * dx - s * dy, y: arc.y + s * dx + c * dy};
  }

  lengthOf(i) {
    const [ax, ay, bx, by] = this.ends.subarray(4 * i, 4 * i + 4);
    const arc = this.arc(i);
    const flat = arc ? Math.abs(arc.sweep) * Math.hypot(ax - arc.x, ay - arc.y) : Math.hypot(bx - ax, by - ay);
    return Math.hypot(flat, this.values[4 * i + 1] - this.values[4 * i]);
  }

  planeOf(i) { return planeNames[this.words[3 * i + 1] >> planeShift & 3]; }
  positionAt(i, share) {
    const {x, y} = this.at(i, share), [from, to] = this.values.subarray(4 * i, 4 * i + 2);
    return positionOf(this.plane, x, y, from + share * (to - from));
  }

  // Turned to another side; arcs become chords.
  seenIn(plane) {
    if (plane === this.plane) return this;
    const ends = [], values = [], words = [];
    for (let i = 0; i < this.count; ++i) {
      const arc = this.arc(i), chords = arc ? Math.max(8, Math.ceil(Math.abs(arc.sweep) / 0.05)) : 1;
      for (let n = 0; n < chords; ++n) {
        const [a, b] = [n, n + 1].map(k => this.positionAt(i, k / chords));
        const [from, to] = [a, b].map(p => inPlane(plane, p)), third = axesOf(plane)[2];
        ends.push(from.x, from.y, to.x, to.y);
        values.push(a[third], b[third], this.values[4 * i + 2], this.values[4 * i + 3]);
        words.push(this.words[3 * i], this.words[3 * i + 1], 0);
      }
    }
    return new Elements(plane, Float64Array.from(ends), Float32Array.from(values), Uint32Array.from(words), new Float64Array(0));
  }

  // An arc lies within its whole circle.
  boxOf(i, box) {
    const [ax, ay, bx, by] = this.ends.subarray(4 * i, 4 * i + 4);
    const arc = this.arc(i);
    const r = arc ? Math.hypot(ax - arc.x, ay - arc.y) : 0;
    box[0] = arc ? arc.x - r : Math.min(ax, bx);
    box[1] = arc ? arc.y - r : Math.min(ay, by);
    box[2] = arc ? arc.x + r : Math.max(ax, bx);
    box[3] = arc ? arc.y + r : Math.max(ay, by);
  }

  described(i, onPath) {
    const arc = this.arc(i);
    return {onPath, index: i, line: this.line(i), plane: this.planeOf(i),
      start: this.positionAt(i, 0), end: this.positionAt(i, 1), feed: this.values[4 * i + 2], toolRadius: this.values[4 * i + 3],
      ...(arc && {center: {x: arc.x, y: arc.y}, sweep: arc.sweep})};
  }
}

// Where an arc meets the lines along the sides of a square, as shares of it.
function sharesOnSides(arc, start, left, below, side) {
  const turn = 2 * Math.PI, radius = Math.hypot(start.x - arc.x, start.y - arc.y), begin = Math.atan2(start.y - arc.y, start.x - arc.x);
  const upright = [left, left + side].map(x => Math.acos((x - arc.x) / radius)).flatMap(angle => [angle, -angle]);
  const level = [below, below + side].map(y => Math.asin((y - arc.y) / radius)).flatMap(angle => [angle, Math.PI - angle]);
  return [...upright, ...level].filter(angle => !Number.isNaN(angle))
    .map(angle => Math.sign(arc.sweep) * (angle - begin))
    .map(way => (way - turn * Math.floor(way / turn)) / Math.abs(arc.sweep)).filter(share => share < 1);
}

// The segments of a square, of which none is shorter than the tolerance but those that must be seen.
class Drawing {
  constructor(low, side, tolerance) {
    this.low = low;
    this.side = side;
    this.tolerance = tolerance;
    this.margin = side / 128;
    this.segments = [];
    this.dots = new Set();
  }

  sees(box, k) {
    const {low, side, margin} = this;
    return box[k] <= low.x + side + margin && box[k + 2] >= low.x - margin && box[k + 1] <= low.y + side + margin && box[k + 3] >= low.y - margin;
  }

  draw(elements, flags) {
    const box = [0, 0, 0, 0];
    let pen = null;
    const lift = () => {
      if (pen && (pen.x !== pen.atX || pen.y !== pen.atY)) this.add(pen.x, pen.y, pen.atX, pen.atY, pen);
      pen = null;
    };
    const goTo = (x, y) => {
      pen.atX = x;
      pen.atY = y;
      if (Math.hypot(x - pen.x, y - pen.y) < this.tolerance) return;
      this.add(pen.x, pen.y, x, y, pen);
      pen.x = x;
      pen.y = y;
    };
    for (let i = 0; i < elements.count; ++i) {
      if (i % groupSize === 0 && !this.sees(elements.boxes, 4 * i / groupSize)) {
        lift();
        i += groupSize - 1;
        continue;
      }
      elements.boxOf(i, box);
      if (elements.isFromUnknown(i) || !this.sees(box, 0)) { lift(); continue; }
      const [ax, ay, bx, by] = elements.ends.subarray(4 * i, 4 * i + 4);
      const word = elements.style(i) | flags | (elements.isRapid(i) ? rapidFlag : 0) |
        (elements.planeOf(i) === elements.plane ? 0 : asideFlag);
      const small = Math.max(box[2] - box[0], box[3] - box[1]) <= 2 * this.tolerance;
      const about = {element: i, line: elements.line(i), word, radius: elements.values[4 * i + 3]};
      // A circle that is too small to be one leads nowhere.
      const isClosed = elements.arc(i) !== null && ax === bx && ay === by;
      if (small && (elements.isSpecial(i) || isClosed)) this.dot(ax, ay, about);
      if (!small || !pen || pen.atX !== ax || pen.atY !== ay) {
        lift();
        pen = {x: ax, y: ay, atX: ax, atY: ay, ...about};
      }
      const arc = elements.arc(i);
      if (arc && !small) {
        // It stays an arc.
        pen = null;
        this.addArc(arc, share => elements.at(i, share), box, about);
        continue;
      }
      goTo(bx, by);
    }
    lift();
  }

  dot(x, y, about) {
    const cells = Math.min(256, Math.max(8, this.side / (4 * this.tolerance)));
    const key = `${Math.floor((x - this.low.x) / this.side * cells)}/${Math.floor((y - this.low.y) / this.side * cells)}`;
    if (this.dots.has(key)) return;
    this.dots.add(key);
    this.add(x, y, x, y, about);
  }

  // The parts of an arc within the square, in pieces that stay near to their chords.
  addArc(arc, place, box, about) {
    const {low, side, margin} = this;
    const [left, below] = [low.x - margin, low.y - margin], whole = side + 2 * margin;
    const within = (x, y) => x >= left && x <= left + whole && y >= below && y <= below + whole;
    if (within(box[0], box[1]) && within(box[2], box[3])) return this.addPieces(arc, place, 0, 1, about);
    let from = 0;
    for (const to of [...sharesOnSides(arc, place(0), left, below, whole), 1].sort((a, b) => a - b)) {
      const middle = place((from + to) / 2);
      if (to > from && within(middle.x, middle.y)) this.addPieces(arc, place, from, to, about);
      from = to;
    }
  }

  addPieces(arc, place, from, to, about) {
    const {low, tolerance} = this;
    const start = place(from), radius = Math.hypot(start.x - arc.x, start.y - arc.y);
    const step = 2 * Math.acos(1 - Math.min(16 * tolerance, radius) / radius);
    const count = Math.ceil((to - from) * Math.abs(arc.sweep) / step), sweep = (to - from) * arc.sweep / count;
    const isStraight = radius * (1 - Math.cos(sweep / 2)) < tolerance / 4;
    for (let i = 0; i < count; ++i) {
      const [a, b] = [i, i + 1].map(n => place(from + n / count * (to - from)));
      this.segments.push(a.x - low.x, a.y - low.y, b.x - low.x, b.y - low.y, about.element, about.line, about.word, about.radius, isStraight ? 0 : sweep);
    }
  }

  // The part within the square.
  add(ax, ay, bx, by, about) {
    const {low, side, margin} = this;
    let first = 0, last = 1;
    for (const [from, way, least] of [[ax, bx - ax, low.x], [ay, by - ay, low.y]]) {
      if (way === 0) {
        if (from < least - margin || from > least + side + margin) return;
        continue;
      }
      const a = (least - margin - from) / way, b = (least + side + margin - from) / way;
      first = Math.max(first, Math.min(a, b));
      last = Math.min(last, Math.max(a, b));
    }
    if (first > last) return;
    this.segments.push(ax + first * (bx - ax) - low.x, ay + first * (by - ay) - low.y,
      ax + last * (bx - ax) - low.x, ay + last * (by - ay) - low.y, about.element, about.line, about.word, about.radius, 0);
  }
}

const tilePixels = 512;

class Inside {
  constructor(json) {
    const {version, language, view, text, output, sources, contour, path} = JSON.parse(json);
    this.version = version;
    this.said = view;
    this.name = view.name;
    // Messages stay in the language they were written in.
    this.language = language ?? view.diagnostics?.[0]?.language;
    this.outputBytes = output === undefined ? null : bytesOf(output);
    this.texts = {lines: linesOf(bytesOf(text)), output: this.outputBytes && linesOf(this.outputBytes)};
    this.sources = sources ?? [];
    this.own = {said: view, contour: Elements.decoded(contour, view.plane), path: Elements.decoded(path, view.plane)};
    Object.assign(this, this.own);
  }

  async makeView(program, settings, asked) {
    const plane = planeNames.find(name => name === `PLANE_${asked?.toUpperCase()}`) ?? this.own.said.plane;
    if (plane === this.own.said.plane) Object.assign(this, this.own);
    else this.lookAt(plane);
    return this.said;
  }

  lookAt(plane) {
    this.contour = this.own.contour.seenIn(plane);
    this.path = this.own.path.seenIn(plane);
    const low = {x: Infinity, y: Infinity}, high = {x: -Infinity, y: -Infinity};
    for (const {ends} of [this.contour, this.path])
      ends.forEach((value, i) => {
        const axis = i % 2 ? 'y' : 'x';
        low[axis] = Math.min(low[axis], value);
        high[axis] = Math.max(high[axis], value);
      });
    const tileSize = 1.25 * Math.max(high.x - low.x, high.y - low.y, 1);
    const tileLow = {x: (low.x + high.x - tileSize) / 2, y: (low.y + high.y - tileSize) / 2};
    const thirds = this.path.values.filter((value, i) => i % 4 < 2);
    this.said = {...this.own.said, plane, low, high, tileLow, tileSize,
      lowest: thirds.reduce((a, b) => Math.min(a, b), Infinity), highest: thirds.reduce((a, b) => Math.max(a, b), -Infinity)};
  }

  async view() { return this.said; }
  async dropView() {}

  async tile(id, {level, x, y, segments}) {
    const side = this.said.tileSize / 2 ** level;
    const low = {x: (this.said.tileLow?.x ?? 0) + x * side, y: (this.said.tileLow?.y ?? 0) + y * side};
    for (let tolerance = side / (4 * tilePixels); ; tolerance *= 2) {
      const drawing = new Drawing(low, side, tolerance);
      drawing.draw(this.contour, 0);
      drawing.draw(this.path, pathFlag);
      const count = drawing.segments.length / segmentSize;
      if (count > segments && tolerance < side) continue;
      const bytes = new ArrayBuffer(16 + 4 * segmentSize * count);
      new DataView(bytes).setUint32(4, count, true);
      const numbers = new Float32Array(bytes, 16), words = new Uint32Array(bytes, 16);
      for (let i = 0; i < segmentSize * count; ++i) {
        const at = i % segmentSize, isWord = at >= 4 && at < 7;
        (isWord ? words : numbers)[i] = drawing.segments[i];
      }
      return bytes;
    }
  }

  async lines(id, what, from, count) {
    const all = this.texts[what];
    if (!all) return {refused: true};
    return {firstLine: from, count: all.length, lines: all.slice(from - 1, from - 1 + count),
      ...(what === 'output' && {sourceLines: this.sources.slice(from - 1, from - 1 + count)})};
  }

  async blocks(id, line) {
    const blocks = [];
    for (const [elements, onPath] of [[this.contour, false], [this.path, true]])
      for (let i = 0; i < elements.count && blocks.length < 1000; ++i)
        if (elements.line(i) === line) blocks.push(elements.described(i, onPath));
    return {blocks};
  }

  async place(id, share) {
    const {path} = this;
    if (path.count === 0) return {};
    const length = share * path.lengths[path.count];
    let low = 0, high = path.count - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (path.lengths[middle + 1] < length) low = middle + 1; else high = middle;
    }
    const own = path.lengths[low + 1] - path.lengths[low];
    const part = own > 0 ? Math.min(1, (length - path.lengths[low]) / own) : 1;
    const point = path.at(low, part);
    return {point, position: path.positionAt(low, part), block: path.described(low, true)};
  }

  async compensated() { return new Blob([this.outputBytes], {type: 'text/plain'}); }
}

// Null on the page that a server gives.
export function programInside() {
  const data = document.getElementById('inside');
  return data ? new Inside(data.textContent) : null;
}
