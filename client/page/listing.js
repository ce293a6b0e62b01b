import {api} from './api.js';
import {t} from './texts.js';

const rowHeight = 18;
const chunk = 200;
// Browsers do not lay out more than some ten million pixels.
const mostPixels = 8e6;

// The lines of one text, of which those that are seen are fetched.
export class Listing {
  constructor(box, what, chosen) {
    this.box = box;
    this.what = what;
    this.fill = document.createElement('div');
    this.fill.className = 'fill';
    box.append(this.fill);
    box.addEventListener('scroll', () => this.draw());
    box.addEventListener('keydown', event => this.onKey(event));
    box.addEventListener('click', event => {
      const row = event.target.closest('[role=option]');
      if (row) this.choose(Number(row.dataset.row), chosen);
    });
    this.chosen = chosen;
    this.clear();
  }

  clear() {
    this.view = null;
    this.count = 0;
    this.chunks = new Map();
    this.selected = 0;
    this.at = 0;
    this.bad = new Set();
    this.fill.replaceChildren();
    this.fill.style.height = '0';
  }

  async show(view) {
    this.clear();
    this.view = view;
    this.bad = new Set((view.diagnostics ?? []).filter(d => d.severity === 'ERROR').map(d => d.line));
    await this.fetch(0);
    this.draw();
  }

  async fetch(index) {
    const {view} = this;
    if (!view || this.chunks.has(index)) return;
    this.chunks.set(index, null);
    const answer = await api.lines(view.id, this.what, index * chunk + 1, chunk)
      .catch(error => ({failed: true, reason: error.problem ? error.message : ''}));
    if (this.view !== view) return;
    if (answer.failed || answer.pending || answer.refused) {
      this.chunks.delete(index);
      // A list box holds options only.
      this.box.setAttribute('role', 'group');
      this.fill.textContent = answer.refused ? t('noOutput') : answer.pending ? t('pending') : answer.reason;
      if (answer.pending) setTimeout(() => this.view === view && this.fetch(index).then(() => this.draw()), 200);
      return;
    }
    if (this.count === 0) this.fill.replaceChildren();
    this.box.setAttribute('role', 'listbox');
    this.count = Number(answer.count ?? 0);
    this.chunks.set(index, {lines: answer.lines ?? [], sources: answer.sourceLines ?? []});
    this.fill.style.height = `${Math.min(this.count * rowHeight, mostPixels)}px`;
    this.draw();
  }

  get rows() { return Math.ceil(this.box.clientHeight / rowHeight); }
  get scaled() { return this.count * rowHeight > mostPixels; }
  get first() {
    if (!this.scaled) return Math.floor(this.box.scrollTop / rowHeight);
    const share = this.box.scrollTop / Math.max(1, this.box.scrollHeight - this.box.clientHeight);
    return Math.round(share * Math.max(0, this.count - this.rows + 1));
  }

  // The line of the program a row belongs to.
  sourceOf(row) {
    if (this.what === 'lines') return row + 1;
    const part = this.chunks.get(Math.floor(row / chunk));
    return part?.sources[row % chunk] ?? 0;
  }

  draw() {
    if (this.count === 0) return;
    const first = this.first, last = Math.min(this.count, first + this.rows + 1);
    const rows = [];
    for (let row = first; row < last; ++row) {
      const part = this.chunks.get(Math.floor(row / chunk));
      if (part === undefined) this.fetch(Math.floor(row / chunk));
      rows.push(this.row(row, part?.lines[row % chunk] ?? '', first));
    }
    this.fill.replaceChildren(...rows);
  }

  row(row, text, first) {
    const element = document.createElement('div');
    const number = document.createElement('span');
    number.className = 'number';
    number.textContent = row + 1;
    element.append(number, text || ' ');
    element.setAttribute('role', 'option');
    // Only those that are seen are there.
    element.setAttribute('aria-posinset', row + 1);
    element.setAttribute('aria-setsize', this.count);
    const selected = this.selected > 0 && this.sourceOf(row) === this.selected;
    element.setAttribute('aria-selected', selected);
    element.dataset.row = row;
    element.id = `${this.what}-${row}`;
    if (this.what === 'lines' && this.bad.has(row + 1)) element.classList.add('bad');
    element.style.top = this.scaled ? `${this.box.scrollTop + (row - first) * rowHeight}px` : `${row * rowHeight}px`;
    return element;
  }

  choose(row) {
    const line = this.sourceOf(row);
    if (line > 0) this.chosen(line);
  }

  onKey(event) {
    const {rows, count} = this;
    const step = {ArrowDown: 1, ArrowUp: -1, PageDown: rows, PageUp: -rows, End: count, Home: -count}[event.key];
    if (!step) return;
    event.preventDefault();
    if (this.what === 'output') return this.step(step);
    this.choose(Math.max(0, Math.min(count - 1, this.selected - 1 + step)));
  }

  // To the next row of compensated text that stems from another line; at an end, the last such row.
  async step(rows) {
    const {view, at, count, selected} = this, way = Math.sign(rows);
    const aim = Math.max(0, Math.min(count - 1, at + rows));
    for (const onwards of [way, -way])
      for (let row = aim; row >= 0 && row < count && row !== at; row += onwards) {
        await this.fetch(Math.floor(row / chunk));
        if (this.view !== view) return;
        const line = this.sourceOf(row);
        if (line > 0 && line !== selected) return this.chosen(line);
      }
  }

  // Marks a line of the program and brings it into sight.
  async select(line) {
    this.selected = line;
    const row = this.what === 'lines' ? line - 1 : await this.rowOf(line);
    this.at = Math.max(0, row);
    if (row >= 0) {
      if (row < this.first || row >= this.first + this.rows - 1) {
        const before = Math.max(0, row - Math.floor(this.rows / 2));
        this.box.scrollTop = this.scaled
          ? before / Math.max(1, this.count - this.rows + 1) * (this.box.scrollHeight - this.box.clientHeight)
          : before * rowHeight;
      }
      this.box.setAttribute('aria-activedescendant', `${this.what}-${row}`);
    }
    this.draw();
  }

  // The first row of compensated text that stems from a line: they follow the program's order, so
  // it is searched for by halves.
  async rowOf(line) {
    let low = 0, high = Math.ceil(this.count / chunk) - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      await this.fetch(middle);
      const sources = (this.chunks.get(middle)?.sources ?? []).filter(source => source > 0);
      if (sources.length && sources.at(-1) < line) low = middle + 1; else high = middle;
    }
    await this.fetch(low);
    const found = (this.chunks.get(low)?.sources ?? []).findIndex(source => source >= line);
    return found < 0 ? -1 : low * chunk + found;
  }
}
