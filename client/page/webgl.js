import {palette, rgb, segmentSize, special, widths} from './styles.js';

const segmentBytes = 4 * segmentSize;

// Draws tiles with WebGL 2: one quad for each line or arc, its width in pixels.
const vertexSource = `#version 300 es
in vec4 ends;
in uvec3 about;
in vec2 tool_and_sweep;
uniform vec2 origin, half_size;
uniform float scale, band;
uniform uint line, layers;
uniform vec3 colors[6];
uniform float widths[6];
uniform vec3 own_color, marked;
uniform bool is_compare;
out vec2 local;
flat out float span, radius;
// Of an arc, along its chord and across it: its centre, its radius and half its sweep; 0: a line.
flat out vec2 center;
flat out float bend, half_sweep;
out vec4 color;
flat out uint dashed;
void main() {
  float tool = tool_and_sweep.x;
  uint style = min(about.z & 255u, 5u);
  bool rapid = (about.z & 256u) != 0u, path = (about.z & 512u) != 0u;
  bool shown = (layers >> style & 1u) != 0u && (!rapid || (layers >> 6 & 1u) != 0u);
  bool is_marked = line != 0u && about.y == line;
  if (band > 0.0) shown = path && tool > 0.0 && !rapid && (about.z & 1024u) == 0u && style >= 2u && style <= 4u;
  else if (is_compare) shown = path;
  vec2 a = origin + ends.xy * scale, b = origin + ends.zw * scale;
  span = distance(a, b);
  vec2 along = span > 0.0 ? (b - a) / span : vec2(1.0, 0.0);
  radius = band > 0.0 ? tool * band : widths[style] * (is_marked ? 2.4 : 1.0) * 0.5;
  float reach = radius + 0.5, below = -reach, above = reach;
  half_sweep = tool_and_sweep.y / 2.0;
  center = vec2(0.0);
  bend = 0.0;
  if (half_sweep != 0.0) {
    center = vec2(0.5, 0.5 / tan(half_sweep)) * span;
    bend = 0.5 * span / abs(sin(half_sweep));
    float rise = 0.5 * span * tan(half_sweep / 2.0);
    below -= max(rise, 0.0);
    above -= min(rise, 0.0);
  }
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  local = vec2(mix(-reach, span + reach, corner.x), mix(below, above, corner.y));
  vec2 at = a + along * local.x + vec2(-along.y, along.x) * local.y;
  gl_Position = vec4(shown ? at / half_size : vec2(2.0), 0.0, 1.0);
  color = vec4(is_marked ? marked : band > 0.0 || is_compare ? own_color : colors[style], 1.0);
  dashed = rapid ? 1u : 0u;
}`;
const fragmentSource = `#version 300 es
precision highp float;
in vec2 local;
flat in float span, radius;
flat in vec2 center;
flat in float bend, half_sweep;
in vec4 color;
flat in uint dashed;
out vec4 result;
float distance_to_line() { return length(vec2(local.x - clamp(local.x, 0.0, span), local.y)); }
float distance_to_arc() {
  vec2 from = local - center;
  bool beside = abs(from.x) * cos(half_sweep) > abs(sin(half_sweep)) * -sign(half_sweep) * from.y;
  if (beside) return min(length(local), length(local - vec2(span, 0.0)));
  // The difference of two large distances, but made of small ones.
  float squares = local.x * (local.x - span) + local.y * (local.y - 2.0 * center.y);
  return abs(squares) / (length(from) + bend);
}
void main() {
  float away = half_sweep == 0.0 ? distance_to_line() : distance_to_arc();
  float cover = clamp(radius + 0.5 - away, 0.0, 1.0);
  if (dashed == 1u && mod(local.x, 10.0) > 5.0) cover = 0.0;
  if (cover <= 0.0) discard;
  result = vec4(color.rgb, color.a * cover);
}`;

export class WebGl {
  // Null where there is no WebGL 2 that works. `restored`: what was drawn is gone.
  static make(canvas, restored) {
    const gl = canvas.getContext('webgl2', {antialias: false, alpha: false, preserveDrawingBuffer: true});
    if (!gl) return null;
    try { return new WebGl(canvas, gl, restored); } catch (error) { console.warn(error); return null; }
  }

  constructor(canvas, gl, restored) {
    this.canvas = canvas;
    this.gl = gl;
    this.program = this.makeProgram();
    // A graphics processor may go, and come back with nothing of what it had.
    canvas.addEventListener('webglcontextlost', event => event.preventDefault());
    canvas.addEventListener('webglcontextrestored', () => { this.program = this.makeProgram(); restored(); });
  }

  makeProgram() {
    const {gl} = this;
    const program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertexSource], [gl.FRAGMENT_SHADER, fragmentSource]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.bindAttribLocation(program, 0, 'ends');
    gl.bindAttribLocation(program, 1, 'about');
    gl.bindAttribLocation(program, 2, 'tool_and_sweep');
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    return program;
  }

  at(name) { return this.gl.getUniformLocation(this.program, name); }

  begin(camera, ratio) {
    const {gl} = this;
    this.camera = camera;
    this.ratio = ratio;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(...rgb(special().back), 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.useProgram(this.program);
    gl.uniform2f(this.at('half_size'), camera.width * ratio / 2, camera.height * ratio / 2);
    gl.uniform1f(this.at('scale'), camera.scale * ratio);
    gl.uniform3fv(this.at('colors'), palette().flatMap(rgb));
    gl.uniform1fv(this.at('widths'), widths.map(width => width * ratio));
    gl.uniform3fv(this.at('marked'), rgb(special().marked));
  }

  // `how`: layers as bits, the marked line, whether the band of the tool is drawn, a colour of its own.
  draw(tiles, how) {
    const {gl, camera, ratio} = this;
    gl.uniform1ui(this.at('layers'), how.layers);
    gl.uniform1ui(this.at('line'), how.line ?? 0);
    gl.uniform1f(this.at('band'), how.band ? camera.scale * ratio : 0);
    gl.uniform1i(this.at('is_compare'), how.compare ? 1 : 0);
    gl.uniform3fv(this.at('own_color'), rgb(how.color ?? '#000000'));
    // Strokes reach from tile to tile: each draws its own pixels, so that no seam is seen.
    if (!how.band) gl.enable(gl.SCISSOR_TEST);
    for (const tile of tiles) {
      if (tile.count === 0) continue;
      this.keepWithin(tile);
      gl.bindVertexArray(tile.program === this.program ? tile.array : this.upload(tile));
      // In double precision up to here: the tile's own numbers are small.
      gl.uniform2f(this.at('origin'), (tile.x - camera.x) * camera.scale * ratio, (tile.y - camera.y) * camera.scale * ratio);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, tile.count);
    }
    gl.bindVertexArray(null);
    gl.disable(gl.SCISSOR_TEST);
  }

  keepWithin(tile) {
    const {gl, camera, ratio} = this;
    const pixel = (at, from, extent) => Math.round(((at - from) * camera.scale + extent / 2) * ratio);
    const clamped = (at, most) => Math.max(0, Math.min(most, at));
    const [left, right] = [tile.x, tile.x + tile.side].map(x => clamped(pixel(x, camera.x, camera.width), this.canvas.width));
    const [below, above] = [tile.y, tile.y + tile.side].map(y => clamped(pixel(y, camera.y, camera.height), this.canvas.height));
    gl.scissor(left, below, right - left, above - below);
  }

  upload(tile) {
    const {gl} = this;
    const array = gl.createVertexArray(), buffer = gl.createBuffer();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, tile.numbers, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 4, gl.FLOAT, false, segmentBytes, 0);
    gl.vertexAttribDivisor(0, 1);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribIPointer(1, 3, gl.UNSIGNED_INT, segmentBytes, 16);
    gl.vertexAttribDivisor(1, 1);
    gl.enableVertexAttribArray(2);
    gl.vertexAttribPointer(2, 2, gl.FLOAT, false, segmentBytes, 28);
    gl.vertexAttribDivisor(2, 1);
    Object.assign(tile, {array, program: this.program});
    tile.release = () => { gl.deleteVertexArray(array); gl.deleteBuffer(buffer); };
    return array;
  }
}
