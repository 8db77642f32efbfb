"use strict";
/* Animation of rigid bodies in WebGL 2: real geometry with edges, shadow, floor grid and contact forces. */

/* ---- mathematics (column-major 4x4 matrices, quaternions x y z w) ---- */

const vector = {
  add: (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]],
  subtract: (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]],
  scale: (a, f) => [a[0] * f, a[1] * f, a[2] * f],
  dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
  cross: (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]],
  length: a => Math.hypot(a[0], a[1], a[2]),
  unit: a => { const n = Math.hypot(a[0], a[1], a[2]) || 1; return [a[0] / n, a[1] / n, a[2] / n]; },
};

function multiply(a, b) {
  const c = new Float32Array(16);
  for (let j = 0; j < 4; j++) {
    for (let i = 0; i < 4; i++) {
      c[4 * j + i] = a[i] * b[4 * j] + a[4 + i] * b[4 * j + 1] + a[8 + i] * b[4 * j + 2] + a[12 + i] * b[4 * j + 3];
    }
  }
  return c;
}

function lookAt(eye, target, up) {
  const z = vector.unit(vector.subtract(eye, target)), x = vector.unit(vector.cross(up, z)), y = vector.cross(z, x);
  return new Float32Array([
    x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0,
    -vector.dot(x, eye), -vector.dot(y, eye), -vector.dot(z, eye), 1]);
}

function perspective(angle, aspect, near, far) {
  const f = 1 / Math.tan(angle / 2);
  return new Float32Array([f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0]);
}

function orthographic(half, near, far) {
  return new Float32Array([1 / half, 0, 0, 0, 0, 1 / half, 0, 0, 0, 0, -2 / (far - near), 0, 0, 0, -(far + near) / (far - near), 1]);
}

/** Parallel projection in which lengths at a distance are as in a perspective of an angle. */
function parallel(angle, aspect, distance, near, far) {
  const f = 1 / (distance * Math.tan(angle / 2));
  return new Float32Array([f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, -2 / (far - near), 0, 0, 0, -(far + near) / (far - near), 1]);
}

/** Matrix of a pose: position and quaternion (body to world) at an offset of an array of seven numbers each. */
function poseMatrix(pose, out) {
  const [px, py, pz, x, y, z, w] = pose;
  out[0] = 1 - 2 * (y * y + z * z); out[1] = 2 * (x * y + z * w); out[2] = 2 * (x * z - y * w); out[3] = 0;
  out[4] = 2 * (x * y - z * w); out[5] = 1 - 2 * (x * x + z * z); out[6] = 2 * (y * z + x * w); out[7] = 0;
  out[8] = 2 * (x * z + y * w); out[9] = 2 * (y * z - x * w); out[10] = 1 - 2 * (x * x + y * y); out[11] = 0;
  out[12] = px; out[13] = py; out[14] = pz; out[15] = 1;
  return out;
}

/**
 * Shading normals and feature edges of a triangle mesh.
 * Corners share a normal where faces meet at less than 35 degrees; steeper or open edges are drawn as lines.
 */
function prepareMesh(vertices, triangles) {
  const count = triangles.length / 3, key = new Map(), merged = new Uint32Array(vertices.length / 3);
  let size = 0;
  for (const v of vertices) size = Math.max(size, Math.abs(v));
  const grid = 1e6 / (size || 1);
  for (let k = 0; k < merged.length; k++) {
    const id = `${Math.round(vertices[3 * k] * grid)},${Math.round(vertices[3 * k + 1] * grid)},${Math.round(vertices[3 * k + 2] * grid)}`;
    let index = key.get(id);
    if (index === undefined) { index = k; key.set(id, k); }
    merged[k] = index;
  }
  const at = k => [vertices[3 * k], vertices[3 * k + 1], vertices[3 * k + 2]];
  const faceNormal = new Float32Array(3 * count), area = new Float32Array(count);
  const around = new Map(), edges = new Map();
  for (let f = 0; f < count; f++) {
    const [a, b, c] = [0, 1, 2].map(i => at(triangles[3 * f + i]));
    const n = vector.cross(vector.subtract(b, a), vector.subtract(c, a)), l = vector.length(n);
    area[f] = l;
    faceNormal.set(l > 0 ? vector.scale(n, 1 / l) : [0, 0, 1], 3 * f);
    for (let i = 0; i < 3; i++) {
      const v = merged[triangles[3 * f + i]], w = merged[triangles[3 * f + (i + 1) % 3]];
      if (!around.has(v)) around.set(v, []);
      around.get(v).push(f);
      const id = v < w ? `${v},${w}` : `${w},${v}`;
      if (!edges.has(id)) edges.set(id, {v, w, faces: []});
      edges.get(id).faces.push(f);
    }
  }
  const normalOf = f => [faceNormal[3 * f], faceNormal[3 * f + 1], faceNormal[3 * f + 2]];
  const limit = Math.cos(35 * Math.PI / 180);
  const position = new Float32Array(9 * count), normal = new Float32Array(9 * count);
  for (let f = 0; f < count; f++) {
    const own = normalOf(f);
    for (let i = 0; i < 3; i++) {
      const k = triangles[3 * f + i];
      let sum = [0, 0, 0];
      for (const g of around.get(merged[k])) {
        const other = normalOf(g);
        if (g === f || vector.dot(own, other) > limit) sum = vector.add(sum, vector.scale(other, area[g] || 1e-12));
      }
      position.set(at(k), 9 * f + 3 * i);
      normal.set(vector.length(sum) > 0 ? vector.unit(sum) : own, 9 * f + 3 * i);
    }
  }
  const lines = [];
  for (const {v, w, faces} of edges.values()) {
    const sharp = faces.length !== 2 || vector.dot(normalOf(faces[0]), normalOf(faces[1])) < limit;
    if (sharp) lines.push(...at(v), ...at(w));
  }
  return {position, normal, lines: new Float32Array(lines)};
}

/** An arrow of length 1 along z: shaft and head. */
function arrowMesh() {
  const vertices = [], triangles = [], n = 20;
  const ring = (radius, z) => {
    const first = vertices.length / 3;
    for (let k = 0; k < n; k++) vertices.push(radius * Math.cos(2 * Math.PI * k / n), radius * Math.sin(2 * Math.PI * k / n), z);
    return first;
  };
  const join = (a, b) => {
    for (let k = 0; k < n; k++) triangles.push(a + k, a + (k + 1) % n, b + k, a + (k + 1) % n, b + (k + 1) % n, b + k);
  };
  const tail = ring(1e-4, 0), r1 = ring(0.022, 0), r2 = ring(0.022, 0.76), r3 = ring(0.06, 0.76), tip = ring(1e-4, 1);
  join(tail, r1); join(r1, r2); join(r2, r3); join(r3, tip);
  return prepareMesh(new Float32Array(vertices), new Uint32Array(triangles));
}

/* ---- shaders ---- */

const VIEW_ANGLE = 0.6;
const HAZE = [0.72, 0.78, 0.86];
const SURFACE_VERTEX = `#version 300 es
layout(location=0) in vec3 position; layout(location=1) in vec3 normal;
uniform mat4 model, view, light; out vec3 worldNormal, worldPosition; out vec4 lightPosition;
void main() {
  vec4 world = model * vec4(position, 1.0);
  worldPosition = world.xyz; worldNormal = mat3(model) * normal; lightPosition = light * world; gl_Position = view * world;
}`;
const SHADOW_FUNCTION = `
float lit(sampler2DShadow map, vec4 position, float slope) {
  vec3 p = position.xyz / position.w * 0.5 + 0.5;
  if (any(lessThan(p, vec3(0.0))) || any(greaterThan(p, vec3(1.0)))) return 1.0;
  float texel = 1.0 / float(textureSize(map, 0).x), sum = 0.0;
  for (int i = -2; i <= 2; i++) for (int j = -2; j <= 2; j++)
    sum += texture(map, vec3(p.xy + vec2(i, j) * texel, p.z - 0.0012 - 0.003 * slope));
  return sum / 25.0;
}`;
const SURFACE_FRAGMENT = `#version 300 es
precision highp float; precision highp sampler2DShadow;
in vec3 worldNormal, worldPosition; in vec4 lightPosition;
uniform vec3 color, eye, up, sun, haze; uniform float alpha, flatLight, shading, shadows, air, clear;
uniform sampler2DShadow shadowMap; out vec4 result;
${SHADOW_FUNCTION}
void main() {
  vec3 n = normalize(worldNormal), v = normalize(eye - worldPosition);
  if (dot(n, v) < 0.0) n = -n;
  float diffuse = max(dot(n, sun), 0.0);
  float shade = flatLight > 0.5 || shadows < 0.5 ? 1.0 : lit(shadowMap, lightPosition, 1.0 - diffuse);
  vec3 h = normalize(sun + v);
  float gloss = pow(max(dot(n, h), 0.0), 48.0) * 0.22 * shade;
  float sky = 0.5 + 0.5 * dot(n, up);
  float fill = max(dot(n, v), 0.0);
  vec3 base = pow(color, vec3(2.2));
  vec3 light = base * (mix(vec3(0.20, 0.18, 0.17), vec3(0.42, 0.45, 0.50), sky) + 0.16 * fill + 0.78 * diffuse * shade * vec3(1.0, 0.97, 0.92)) + gloss;
  vec3 seen = shading < 0.5 ? color : pow(light, vec3(1.0 / 2.2));
  float hidden = 1.0 - exp(-air * max(0.0, length(eye - worldPosition) - clear));
  result = vec4(mix(seen, haze, hidden) * alpha, alpha);
}`;
const LINE_VERTEX = `#version 300 es
layout(location=0) in vec3 position; uniform mat4 model, view;
void main() { gl_Position = view * model * vec4(position, 1.0); gl_Position.z -= 2e-4 * gl_Position.w; }`;
const LINE_FRAGMENT = `#version 300 es
precision highp float; uniform vec4 color; out vec4 result;
void main() { result = vec4(color.rgb * color.a, color.a); }`;
const DEPTH_FRAGMENT = `#version 300 es
precision highp float; void main() {}`;
const FLOOR_VERTEX = `#version 300 es
layout(location=0) in vec3 position; uniform mat4 model, view, light; out vec3 place; out vec4 lightPosition; out vec3 world3;
void main() { vec4 world = model * vec4(position, 1.0); place = position; world3 = world.xyz; lightPosition = light * world; gl_Position = view * world; }`;
const FLOOR_FRAGMENT = `#version 300 es
precision highp float; precision highp sampler2DShadow;
in vec3 place, world3; in vec4 lightPosition; uniform float cell, reach; uniform vec3 ink, middle; uniform float strength, shadows;
uniform sampler2DShadow shadowMap; out vec4 result;
${SHADOW_FUNCTION}
float lines(vec2 p, float width) {
  vec2 d = fwidth(p) + 1e-9, g = abs(fract(p - 0.5) - 0.5) / d;
  float fade = 1.0 - smoothstep(0.25, 0.75, max(d.x, d.y));
  return (1.0 - clamp(min(g.x, g.y) - width, 0.0, 1.0)) * fade;
}
void main() {
  float away = 1.0 - smoothstep(0.25 * reach, reach, length(world3 - middle));
  float a = max(0.13 * lines(place.xy / cell, 0.0), 0.30 * lines(place.xy / (5.0 * cell), 0.0));
  float dark = shadows < 0.5 ? 0.0 : (1.0 - lit(shadowMap, lightPosition, 0.0)) * 0.30;
  float alpha = (a * strength + dark * (1.0 - a * strength)) * away;
  result = vec4(ink * alpha, alpha);
}`;

function program(gl, vertex, fragment) {
  const p = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(p, shader);
  }
  gl.linkProgram(p);
  if (!gl.getProgramParameter(p, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(p));
  const uniforms = {};
  for (let k = 0; k < gl.getProgramParameter(p, gl.ACTIVE_UNIFORMS); k++) {
    const name = gl.getActiveUniform(p, k).name;
    uniforms[name] = gl.getUniformLocation(p, name);
  }
  return {handle: p, uniforms};
}

/* ---- viewer ---- */

const IDENTITY = new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
const SHADOW_SIZE = 2048;

/**
 * Draws bodies where `place` put them, and `forces`: arrays of six numbers, point and force in world axes.
 * data: bodies with meshes, up, center, radius, floor, largestForce and follow as in animation.py; canvas: where.
 * `cues` of depth can be switched: perspective (else parallel projection), shading, shadows, aerial (haze that grows with distance).
 * `way` is how far the machine went: the camera follows it where `follow` is set. Throws if WebGL 2 is missing.
 */
class Viewer {
  constructor(canvas, data) {
    this.canvas = canvas;
    this.data = data;
    this.showEdges = this.showForces = this.showGrid = true;
    this.cues = {perspective: true, shading: true, shadows: true, aerial: false};
    this.follow = data.follow;
    this.way = [0, 0, 0];
    this.forces = [];
    const gl = this.gl = canvas.getContext("webgl2", {antialias: true, alpha: true, premultipliedAlpha: true, preserveDrawingBuffer: true});
    if (!gl) throw new Error("This browser does not offer WebGL 2.");
    this.surface = program(gl, SURFACE_VERTEX, SURFACE_FRAGMENT);
    this.line = program(gl, LINE_VERTEX, LINE_FRAGMENT);
    this.depth = program(gl, LINE_VERTEX, DEPTH_FRAGMENT);
    this.floor = program(gl, FLOOR_VERTEX, FLOOR_FRAGMENT);
    this.bodies = data.bodies.map(body => ({
      matrix: Float32Array.from(IDENTITY),
      meshes: body.meshes.map(mesh => this.upload(
        prepareMesh(decodeArray(mesh.vertices, Float32Array), decodeArray(mesh.triangles, Uint32Array)), mesh.color)),
    }));
    this.arrow = this.upload(arrowMesh(), [0.86, 0.16, 0.12]);
    const r = 1;
    this.plane = this.buffer(new Float32Array([-r, -r, 0, r, -r, 0, r, r, 0, -r, -r, 0, r, r, 0, -r, r, 0]), 3);
    this.makeShadowMap();
    this.axes();
    this.reset();
    this.listen();
    new ResizeObserver(() => this.paint()).observe(canvas);
  }

  buffer(data) {
    const gl = this.gl, array = gl.createVertexArray(), handle = gl.createBuffer();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, handle);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    return {array, count: data.length / 3};
  }

  upload(mesh, color) {
    const gl = this.gl, faces = this.buffer(mesh.position);
    const handle = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, handle);
    gl.bufferData(gl.ARRAY_BUFFER, mesh.normal, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 0, 0);
    return {faces, lines: mesh.lines.length ? this.buffer(mesh.lines) : null, color};
  }

  makeShadowMap() {
    const gl = this.gl;
    this.shadowTexture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.shadowTexture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, SHADOW_SIZE, SHADOW_SIZE);
    for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
      [gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE], [gl.TEXTURE_COMPARE_FUNC, gl.LEQUAL],
      [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) gl.texParameteri(gl.TEXTURE_2D, name, value);
    this.shadowFrame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowFrame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.shadowTexture, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  axes() {
    const up = this.up = vector.unit(this.data.up);
    const helper = Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
    this.side = vector.unit(vector.subtract(helper, vector.scale(up, vector.dot(helper, up))));
    this.front = vector.cross(up, this.side);
    this.sun = vector.unit(vector.add(vector.scale(up, 1.5), vector.add(vector.scale(this.side, 0.55), vector.scale(this.front, -0.75))));
  }

  reset() {
    const {center, radius} = this.data;
    this.target = center.slice();
    const aspect = (this.canvas.clientWidth || 16) / (this.canvas.clientHeight || 9);
    this.distance = radius / Math.sin(0.30) * (aspect < 1 ? 1 / Math.max(0.35, aspect) : 1) * 0.97;
    this.turn = -0.62;
    this.lift = 0.36;
  }

  /** Puts a body, counted as in the data, at a pose: position and quaternion x y z w, body to world. */
  place(body, pose) {
    poseMatrix(pose, this.bodies[body].matrix);
  }

  get offset() {
    return this.follow ? this.way : [0, 0, 0];
  }

  focus() {
    return vector.add(this.target, this.offset);
  }

  eye() {
    const c = Math.cos(this.lift), direction = vector.add(
      vector.add(vector.scale(this.side, c * Math.sin(this.turn)), vector.scale(this.front, -c * Math.cos(this.turn))),
      vector.scale(this.up, Math.sin(this.lift)));
    return vector.add(this.focus(), vector.scale(direction, this.distance));
  }

  draw() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => { this.pending = false; this.paint(); });
  }

  paint() {
    const gl = this.gl, canvas = this.canvas, ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio)), height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
    const radius = this.data.radius, center = vector.add(this.data.center, this.offset), eye = this.eye();
    const aspect = width / height, far = this.distance * 4 + radius * 12;
    const projection = this.cues.perspective ? perspective(VIEW_ANGLE, aspect, this.distance * 0.02, far)
      : parallel(VIEW_ANGLE, aspect, this.distance, -far, far);
    const view = multiply(projection, lookAt(eye, this.focus(), this.up));
    const reach = radius * 1.35;
    const light = multiply(orthographic(reach, 0.1 * radius, 8 * radius),
      lookAt(vector.add(center, vector.scale(this.sun, 4 * radius)), center, Math.abs(vector.dot(this.sun, this.front)) < 0.9 ? this.front : this.up));
    gl.enable(gl.DEPTH_TEST);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowFrame);
    gl.viewport(0, 0, SHADOW_SIZE, SHADOW_SIZE);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.useProgram(this.depth.handle);
    gl.uniformMatrix4fv(this.depth.uniforms.view, false, light);
    this.eachMesh((mesh, matrix) => {
      gl.uniformMatrix4fv(this.depth.uniforms.model, false, matrix);
      gl.bindVertexArray(mesh.faces.array);
      gl.drawArrays(gl.TRIANGLES, 0, mesh.faces.count);
    });
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.shadowTexture);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.useSurface(view, light, eye);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    this.eachMesh((mesh, matrix) => this.drawSurface(mesh, matrix, 1, 0));
    gl.disable(gl.POLYGON_OFFSET_FILL);
    if (this.showEdges) this.drawEdges(view);
    if (this.showGrid) this.drawFloor(view, light);
    if (this.showForces) this.drawForces(view, light, eye);
  }

  eachMesh(action) {
    for (const body of this.bodies) for (const mesh of body.meshes) action(mesh, body.matrix);
  }

  useSurface(view, light, eye) {
    const gl = this.gl, u = this.surface.uniforms;
    gl.useProgram(this.surface.handle);
    gl.uniformMatrix4fv(u.view, false, view);
    gl.uniformMatrix4fv(u.light, false, light);
    gl.uniform3fv(u.eye, eye);
    gl.uniform3fv(u.up, this.up);
    gl.uniform3fv(u.sun, this.sun);
    gl.uniform3fv(u.haze, HAZE);
    gl.uniform1f(u.shading, this.cues.shading ? 1 : 0);
    gl.uniform1f(u.shadows, this.cues.shadows ? 1 : 0);
    gl.uniform1f(u.air, this.cues.aerial ? 0.7 / this.data.radius : 0);
    gl.uniform1f(u.clear, Math.max(0, this.distance - this.data.radius));
    gl.uniform1i(u.shadowMap, 0);
  }

  drawSurface(mesh, matrix, alpha, flatLight) {
    const gl = this.gl, u = this.surface.uniforms;
    gl.uniformMatrix4fv(u.model, false, matrix);
    gl.uniform3fv(u.color, mesh.color);
    gl.uniform1f(u.alpha, alpha);
    gl.uniform1f(u.flatLight, flatLight);
    gl.bindVertexArray(mesh.faces.array);
    gl.drawArrays(gl.TRIANGLES, 0, mesh.faces.count);
  }

  drawEdges(view) {
    const gl = this.gl, u = this.line.uniforms;
    gl.useProgram(this.line.handle);
    gl.uniformMatrix4fv(u.view, false, view);
    gl.uniform4f(u.color, 0.06, 0.08, 0.12, 0.62);
    this.eachMesh((mesh, matrix) => {
      if (!mesh.lines) return;
      gl.uniformMatrix4fv(u.model, false, matrix);
      gl.bindVertexArray(mesh.lines.array);
      gl.drawArrays(gl.LINES, 0, mesh.lines.count);
    });
  }

  drawFloor(view, light) {
    const gl = this.gl, u = this.floor.uniforms, {radius, floor} = this.data;
    const center = vector.add(this.data.center, this.offset);
    const size = 30 * radius, height = floor - 2e-4 * radius;
    const middle = vector.add(vector.subtract(center, vector.scale(this.up, vector.dot(center, this.up))), vector.scale(this.up, height));
    const cell = Math.pow(10, Math.floor(Math.log10(radius / 2)));
    // The grid's lines go through the world's origin: the plane is centred there, and reaches around the scene.
    const origin = vector.scale(this.up, height);
    const model = new Float32Array([...vector.scale(this.side, 1), 0, ...vector.scale(this.front, 1), 0, ...this.up, 0, ...origin, 1]);
    const far = size + vector.length(middle);
    if (this.planeSize !== far) {
      this.planeSize = far;
      this.plane = this.buffer(new Float32Array([-far, -far, 0, far, -far, 0, far, far, 0, -far, -far, 0, far, far, 0, -far, far, 0]));
    }
    const dark = window.matchMedia && window.matchMedia("(prefers-color-scheme: dark)").matches;
    gl.useProgram(this.floor.handle);
    gl.uniformMatrix4fv(u.model, false, model);
    gl.uniformMatrix4fv(u.view, false, view);
    gl.uniformMatrix4fv(u.light, false, light);
    gl.uniform1f(u.cell, cell);
    gl.uniform1f(u.shadows, this.cues.shadows ? 1 : 0);
    gl.uniform1f(u.reach, Math.max(6 * radius, 1.5 * this.distance));
    gl.uniform3fv(u.middle, middle);
    gl.uniform3fv(u.ink, dark ? [0.02, 0.03, 0.05] : [0.12, 0.17, 0.26]);
    gl.uniform1f(u.strength, dark ? 1.4 : 0.85);
    gl.uniform1i(u.shadowMap, 0);
    gl.depthMask(false);
    gl.bindVertexArray(this.plane.array);
    gl.drawArrays(gl.TRIANGLES, 0, 6);
    gl.depthMask(true);
  }

  drawForces(view, light, eye) {
    const gl = this.gl, arrows = [];
    for (const t of this.forces) {
      const f = [t[3], t[4], t[5]], size = vector.length(f);
      if (!(size > this.data.largestForce * 1e-4)) continue;
      const length = this.data.radius * (0.12 + 0.55 * Math.sqrt(size / this.data.largestForce));
      const z = vector.scale(f, 1 / size), helper = Math.abs(z[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
      const x = vector.unit(vector.cross(helper, z)), y = vector.cross(z, x);
      arrows.push(new Float32Array([...vector.scale(x, length), 0, ...vector.scale(y, length), 0, ...vector.scale(z, length), 0,
        t[0], t[1], t[2], 1]));
    }
    if (!arrows.length) return;
    this.useSurface(view, light, eye);
    // Once faintly through everything, once where it is really seen.
    gl.disable(gl.DEPTH_TEST);
    for (const matrix of arrows) this.drawSurface(this.arrow, matrix, 0.28, 1);
    gl.enable(gl.DEPTH_TEST);
    for (const matrix of arrows) this.drawSurface(this.arrow, matrix, 1, 1);
  }

  listen() {
    const canvas = this.canvas, pointers = new Map();
    canvas.addEventListener("contextmenu", event => event.preventDefault());
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    const end = event => pointers.delete(event.pointerId);
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", end);
    canvas.addEventListener("pointermove", event => {
      const old = pointers.get(event.pointerId);
      if (!old) return;
      const now = [event.clientX, event.clientY], dx = now[0] - old[0], dy = now[1] - old[1];
      if (pointers.size === 1) {
        if (event.shiftKey || event.buttons & 6) this.pan(dx, dy);
        else {
          this.turn -= dx * 0.008;
          this.lift = Math.min(1.55, Math.max(-1.55, this.lift + dy * 0.008));
        }
      } else if (pointers.size === 2) {
        const other = [...pointers.entries()].find(([id]) => id !== event.pointerId)[1];
        const before = Math.hypot(old[0] - other[0], old[1] - other[1]), after = Math.hypot(now[0] - other[0], now[1] - other[1]);
        if (before > 0 && after > 0) this.zoom(before / after);
        this.pan(dx / 2, dy / 2);
      }
      pointers.set(event.pointerId, now);
      this.draw();
    });
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      this.zoom(Math.exp(event.deltaY * (event.deltaMode ? 0.05 : 0.0012)));
      this.draw();
    }, {passive: false});
    canvas.addEventListener("dblclick", () => { this.reset(); this.draw(); });
  }

  zoom(factor) {
    this.distance = Math.min(60 * this.data.radius, Math.max(0.03 * this.data.radius, this.distance * factor));
  }

  pan(dx, dy) {
    const back = vector.unit(vector.subtract(this.eye(), this.focus())), right = vector.unit(vector.cross(this.up, back));
    const above = vector.cross(back, right), step = this.distance * 0.62 / (this.canvas.clientHeight || 1);
    this.target = vector.add(this.target, vector.add(vector.scale(right, -dx * step), vector.scale(above, dy * step)));
  }
}

if (typeof module !== "undefined") module.exports = {poseMatrix, prepareMesh, multiply, lookAt, perspective, parallel};
