// An arc by its ends and its sweep, of at most half a turn and not 0, positive counter-clockwise:
// centre, radius and the angle it begins at.
export function arcOf(ax, ay, bx, by, sweep) {
  const across = 0.5 / Math.tan(sweep / 2), dx = bx - ax, dy = by - ay;
  const x = (ax + bx) / 2 - across * dy, y = (ay + by) / 2 + across * dx;
  return {x, y, radius: Math.hypot(ax - x, ay - y), begin: Math.atan2(ay - y, ax - x), sweep};
}

// The point of it that is nearest to another one.
export function nearestOnArc({x, y, radius, begin, sweep}, px, py) {
  const turn = 2 * Math.PI, way = Math.sign(sweep) * (Math.atan2(py - y, px - x) - begin);
  const along = way - turn * Math.floor(way / turn), whole = Math.abs(sweep);
  // Beside it the nearer end is.
  const at = along <= whole ? along : along - whole < turn - along ? whole : 0;
  const angle = begin + Math.sign(sweep) * at;
  return {x: x + radius * Math.cos(angle), y: y + radius * Math.sin(angle)};
}
