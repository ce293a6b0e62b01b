import {axesOf, inPlane} from './planes.js';
import {palette, special} from './styles.js';

// What lies over the picture: axes with a scale, the tool, findings, what is measured.
export class Overlay {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
  }

  draw(camera, ratio, {view, unit, arrows, place, measured, marks, proposals, uncut, aim}) {
    const c = this.context;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, camera.width, camera.height);
    if (!view) return;
    this.colors = special();
    c.font = '12px system-ui, sans-serif';
    if (view.pathBlocks || view.contourBlocks) this.axes(camera, unit, axesOf(view.plane));
    this.arrows(arrows);
    for (const stretch of uncut ?? []) this.way(camera, [stretch], {color: this.colors.uncut, width: 5, dash: [2, 4]});
    for (const proposal of proposals ?? []) this.proposal(camera, proposal);
    if (marks) for (const finding of view.diagnostics ?? []) this.finding(camera, view, finding);
    if (place?.point) this.tool(camera, view, place);
    this.measure(camera, measured);
    if (aim) this.aim(camera);
  }

  // Scales count in the unit of the program, which has so many mm.
  axes(camera, {size, name}, [first, second]) {
    const c = this.context;
    c.fillStyle = c.strokeStyle = this.colors.text;
    c.lineWidth = 3;
    const write = (text, x, y) => {
      c.strokeStyle = this.colors.back;
      c.strokeText(text, x, y);
      c.fillText(text, x, y);
    };
    c.textBaseline = 'bottom';
    const {across, up} = ticksOf(camera, size);
    for (const {at, text} of across) {
      c.fillRect(at, camera.height - 5, 1, 5);
      write(text, at + 3, camera.height - 2);
    }
    c.textBaseline = 'middle';
    for (const {at, text} of up) {
      c.fillRect(0, at, 5, 1);
      if (text) write(text, 8, at);
    }
    c.font = 'italic 13px system-ui, sans-serif';
    write(`${second.toUpperCase()} / ${name}`, 8, 12);
    c.textAlign = 'right';
    write(`${first.toUpperCase()} / ${name}`, camera.width - 8, camera.height - 26);
    c.textAlign = 'left';
    c.font = '12px system-ui, sans-serif';
  }

  arrows(arrows) {
    const c = this.context, colors = palette();
    for (const {x, y, dx, dy, style} of arrows) {
      c.fillStyle = colors[style];
      c.beginPath();
      c.moveTo(x + 7 * dx, y + 7 * dy);
      c.lineTo(x - 5 * dx - 5 * dy, y - 5 * dy + 5 * dx);
      c.lineTo(x - 5 * dx + 5 * dy, y - 5 * dy - 5 * dx);
      c.closePath();
      c.fill();
    }
  }

  // Where a key puts a point.
  aim(camera) {
    const c = this.context, x = camera.width / 2, y = camera.height / 2;
    c.strokeStyle = this.colors.marked;
    c.lineWidth = 2;
    c.beginPath();
    c.moveTo(x - 12, y); c.lineTo(x + 12, y);
    c.moveTo(x, y - 12); c.lineTo(x, y + 12);
    c.stroke();
  }

  // Motions after each other, each {from, to, center, sweep} in the plane.
  way(camera, motions, {color, width, dash}) {
    const c = this.context;
    c.strokeStyle = color;
    c.lineWidth = width;
    c.setLineDash(dash);
    c.beginPath();
    for (const {from, to, center, sweep} of motions) {
      c.moveTo(...camera.toScreen(from));
      if (!center) { c.lineTo(...camera.toScreen(to)); continue; }
      // The screen counts angles the other way round.
      const begin = Math.atan2(from.y - center.y, from.x - center.x);
      c.arc(...camera.toScreen(center), Math.hypot(from.x - center.x, from.y - center.y) * camera.scale, -begin, -begin - sweep, sweep > 0);
    }
    c.stroke();
    c.setLineDash([]);
  }

  // What may be put in place of an approach or a retract, with a ring where it begins.
  proposal(camera, motions) {
    const c = this.context;
    this.way(camera, motions, {color: this.colors.proposal, width: 2.5, dash: [9, 5]});
    c.beginPath();
    c.arc(...camera.toScreen(motions[0].from), 4, 0, 2 * Math.PI);
    c.stroke();
  }

  // A circle with a cross: a shape, not a colour alone.
  finding(camera, view, diagnostic) {
    if (!diagnostic.point || diagnostic.severity === 'NOTE') return;
    const [x, y] = camera.toScreen(inPlane(view.plane, diagnostic.point));
    const c = this.context, r = diagnostic.severity === 'ERROR' ? 9 : 6;
    c.strokeStyle = this.colors.finding;
    c.lineWidth = 2.5;
    c.beginPath();
    c.arc(x, y, r, 0, 2 * Math.PI);
    c.moveTo(x - r * 0.6, y - r * 0.6); c.lineTo(x + r * 0.6, y + r * 0.6);
    c.moveTo(x - r * 0.6, y + r * 0.6); c.lineTo(x + r * 0.6, y - r * 0.6);
    c.stroke();
  }

  // Round, or a shank with its tip where it is seen from the side.
  tool(camera, view, place) {
    const [x, y] = camera.toScreen({x: place.point.x ?? 0, y: place.point.y ?? 0});
    const radius = (place.block?.toolRadius ?? 0) * camera.scale;
    const c = this.context;
    c.strokeStyle = this.colors.text;
    c.lineWidth = 1.5;
    c.beginPath();
    const shown = view.plane ?? 'PLANE_XY', own = place.block?.plane ?? shown;
    if (radius > 0 && own === shown) {
      c.arc(x, y, radius, 0, 2 * Math.PI);
    } else if (radius > 0) {
      const length = Math.max(4 * radius, 40);
      if (axesOf(shown)[0] === axesOf(own)[2]) c.rect(x, y - radius, length, 2 * radius);
      else c.rect(x - radius, y - length, 2 * radius, length);
    }
    c.moveTo(x - 6, y); c.lineTo(x + 6, y);
    c.moveTo(x, y - 6); c.lineTo(x, y + 6);
    c.stroke();
    c.globalAlpha = 0.15;
    c.fillStyle = this.colors.text;
    c.fill();
    c.globalAlpha = 1;
  }

  measure(camera, points) {
    if (points.length === 0) return;
    const c = this.context;
    const [ax, ay] = camera.toScreen(points[0]);
    const [bx, by] = camera.toScreen(points.at(-1));
    c.strokeStyle = c.fillStyle = this.colors.marked;
    c.lineWidth = 2;
    c.beginPath();
    c.moveTo(ax, ay);
    c.lineTo(bx, by);
    c.stroke();
    for (const [x, y] of [[ax, ay], [bx, by]]) c.fillRect(x - 3, y - 3, 6, 6);
  }
}

// Where the scales have their marks, in pixels, and what stands there, in units of so many mm.
export function ticksOf(camera, size) {
  const unitStep = niceStep(90 / camera.scale / size), step = unitStep * size;
  const digits = Math.max(0, -Math.floor(Math.log10(unitStep) + 1e-9));
  const textOf = index => (index * unitStep).toFixed(digits);
  const low = camera.toPlane(0, camera.height), high = camera.toPlane(camera.width, 0);
  const across = [], up = [];
  for (let i = Math.ceil(low.x / step); i * step <= high.x; ++i)
    across.push({at: camera.toScreen({x: i * step, y: 0})[0], text: textOf(i)});
  for (let i = Math.ceil(low.y / step); i * step <= high.y; ++i) {
    const [, at] = camera.toScreen({x: 0, y: i * step});
    // Above and below stand the names of the axes and the other scale.
    up.push({at, text: at > 26 && at < camera.height - 20 ? textOf(i) : ''});
  }
  return {across, up};
}

// 1, 2 or 5 times a power of ten, not below.
function niceStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map(f => f * power).find(step => step >= least * 0.999);
}
