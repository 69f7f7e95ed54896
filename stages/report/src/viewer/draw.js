// The 3D view: surfaces and tapes by WebGL 2. z is up, lengths are millimetres.
// Where there is none, the pictures that the page brings along are shown (class `live`).
document.documentElement.classList.add("live");
const canvas = element("view");
// The buffer is kept so that the picture can be saved and tested.
const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
const meshes = scene.meshes.map(unpacked);
const bounds = { lo: [1e9, 1e9, 1e9], hi: [-1e9, -1e9, -1e9] };
for (const m of meshes) m.at.forEach((x, i) => { const k = i % 3; if (x < bounds.lo[k]) bounds.lo[k] = x; if (x > bounds.hi[k]) bounds.hi[k] = x; });
const middle = [0, 1, 2].map((k) => (bounds.lo[k] + bounds.hi[k]) / 2);
const half = [0, 1, 2].map((k) => Math.max(1, (bounds.hi[k] - bounds.lo[k]) / 2));
const around = Math.hypot(half[0], half[1]), size = 2 * Math.max(...half);
let draw = () => {};
// From where the view was drawn last: rows of its turn, distance, focal length, width over height.
let seen = null;
// Without WebGL 2, or when a phone takes it away, the rest of the page still works.
const no3d = () => { document.documentElement.classList.remove("live"); element("no3d").hidden = false; canvas.hidden = true; draw = () => {}; };
canvas.addEventListener("webglcontextlost", no3d);
const prepare = () => {
  const program = (vertex, fragment) => {
    const p = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const s = gl.createShader(kind);
      gl.shaderSource(s, "#version 300 es\nprecision highp float;\n" + source);
      gl.compileShader(s);
      if (!gl.getShaderParameter(s, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(s));
      gl.attachShader(p, s);
    }
    ["at", "normal", "uv", "paint"].forEach((name, i) => gl.bindAttribLocation(p, i, name));
    gl.linkProgram(p);
    const uniform = {};
    for (let i = gl.getProgramParameter(p, gl.ACTIVE_UNIFORMS); i--;) { const u = gl.getActiveUniform(p, i).name; uniform[u] = gl.getUniformLocation(p, u); }
    return { p, uniform };
  };
  const surface = program(
    "in vec3 at; in vec3 normal; in vec2 uv; in vec3 paint; uniform mat4 view; uniform mat3 turn; out vec3 n; out vec2 t; out vec3 c;" +
    "void main() { n = turn * normal; t = uv; c = paint; gl_Position = view * vec4(at, 1.0); }",
    "in vec3 n; in vec2 t; in vec3 c; uniform sampler2D atlas; uniform int kind; out vec4 o;" +
    "void main() { vec3 m = normalize(n); float l = 0.35 + 0.65 * abs(m.z) + 0.1 * m.y; float soft = 0.75 + 0.25 * abs(m.z);" +
    "o = vec4(kind == 2 ? texture(atlas, t).rgb * soft : kind == 1 ? c * soft : vec3(0.80, 0.74, 0.68) * l, 1.0); }");
  const band = program(
    "in vec3 at; in vec3 normal; in vec2 uv; uniform mat4 view; uniform mat3 turn; out vec3 n; out float side;" +
    "void main() { n = turn * normal; side = uv.x; gl_Position = view * vec4(at, 1.0); gl_Position.z -= 0.0003 * gl_Position.w; }",
    "in vec3 n; in float side; uniform vec4 color; out vec4 o;" +
    "void main() { float l = 0.6 + 0.4 * abs(normalize(n).z); o = vec4(color.rgb * (abs(side) > 0.72 ? 0.55 : 1.0) * l, color.a); }");
  const feed = (place, data, width, type, unit) => {
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer); gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(place); gl.vertexAttribPointer(place, width, type, unit, 0, 0);
    return buffer;
  };
  for (const m of meshes) {
    m.vao = gl.createVertexArray(); gl.bindVertexArray(m.vao);
    feed(0, m.at, 3, gl.FLOAT, false); feed(1, m.normals, 3, gl.FLOAT, false);
    if (m.uv) feed(2, m.uv, 2, gl.UNSIGNED_SHORT, true);
    if (m.color) feed(3, m.color, 3, gl.UNSIGNED_BYTE, true);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer()); gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, m.index, gl.STATIC_DRAW);
    m.kind = m.color ? 1 : 0;
    if (m.atlas) {
      const image = new Image();
      image.onload = () => {
        m.texture = gl.createTexture(); gl.bindTexture(gl.TEXTURE_2D, m.texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, gl.RGB, gl.UNSIGNED_BYTE, image);
        gl.generateMipmap(gl.TEXTURE_2D); gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
        m.kind = 2; changed();
      };
      image.src = m.atlas;
    }
  }
  // A tape is a band around the hull of its section, as high as a tailor's: 1 % of the body.
  const height = 0.005 * size, outward = 0.0015 * size;
  const strip = (tape, along) => {
    const n = tape.length / 3, at = [], normal = [], side = [];
    const c = [0, 1, 2].map((k) => { let s = 0; for (let i = 0; i < n; i++) s += tape[3 * i + k] / n; return s; });
    for (let j = 0; j <= n; j++) {
      const p = [0, 1, 2].map((k) => tape[3 * (j % n) + k]), out = p.map((x, k) => x - c[k]), far = Math.hypot(...out) || 1;
      for (const s of [-1, 1]) { p.forEach((x, k) => { at.push(x + out[k] / far * outward + s * height * along[k]); normal.push(out[k] / far); }); side.push(s, 0); }
    }
    const vao = gl.createVertexArray(); gl.bindVertexArray(vao);
    const buffers = [feed(0, new Float32Array(at), 3, gl.FLOAT, false), feed(1, new Float32Array(normal), 3, gl.FLOAT, false), feed(2, new Float32Array(side), 2, gl.FLOAT, false)];
    return { vao, buffers, count: 2 * n + 2 };
  };
  const tapes = scene.tapes.map((t) => ({ name: t.name, ...strip(t.tape, t.normal) }));
  // The tape through picked points.
  let found = { of: null };
  const drawFound = () => {
    if (found.of !== state.found) {
      if (found.vao) { gl.deleteVertexArray(found.vao); found.buffers.forEach((b) => gl.deleteBuffer(b)); }
      found = { of: state.found, ...(state.found ? strip(state.found.around, state.found.normal) : {}) };
    }
    if (!found.vao) return;
    gl.uniform4f(band.uniform.color, 0, 0.45, 1, 1); gl.bindVertexArray(found.vao); gl.drawArrays(gl.TRIANGLE_STRIP, 0, found.count);
  };
  const multiply = (a, b) => { const o = new Float32Array(16); for (let c = 0; c < 4; c++) for (let r = 0; r < 4; r++) for (let k = 0; k < 4; k++) o[c * 4 + r] += a[k * 4 + r] * b[c * 4 + k]; return o; };
  // Picked points are small octahedra, drawn over the body.
  const dots = { vao: gl.createVertexArray(), buffer: gl.createBuffer(), of: null, count: 0 };
  gl.bindVertexArray(dots.vao); gl.bindBuffer(gl.ARRAY_BUFFER, dots.buffer); gl.enableVertexAttribArray(0); gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0); gl.vertexAttrib3f(1, 0, 0, 1);
  const drawDots = () => {
    if (dots.of !== state.picked) {
      const at = [], far = 0.006 * size;
      for (const p of state.picked) for (let i = 0; i < 8; i++) for (let k = 0; k < 3; k++) { const q = [...p]; q[k] += (i >> k & 1 ? 1 : -1) * far; at.push(...q); }
      gl.bindBuffer(gl.ARRAY_BUFFER, dots.buffer); gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(at), gl.DYNAMIC_DRAW);
      dots.of = state.picked; dots.count = at.length / 3;
    }
    gl.uniform4f(band.uniform.color, 0, 0.45, 1, 1);
    gl.bindVertexArray(dots.vao); gl.drawArrays(gl.TRIANGLES, 0, dots.count);
  };
  draw = () => {
    const ratio = Math.min(devicePixelRatio || 1, 2), w = Math.max(1, Math.round(canvas.clientWidth * ratio)), h = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
    gl.viewport(0, 0, w, h);
    const back = getComputedStyle(canvas).backgroundColor.match(/[\d.]+/g).map(Number);
    gl.clearColor(back[0] / 255, back[1] / 255, back[2] / 255, 1); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT); gl.enable(gl.DEPTH_TEST);
    const [cy, sy, cp, sp] = [Math.cos(state.yaw), Math.sin(state.yaw), Math.cos(state.pitch), Math.sin(state.pitch)];
    // Rows: right, up, towards the viewer, who stands at -y if nothing is turned.
    const r = [[cy, sy, 0], [-sp * sy, sp * cy, cp], [cp * sy, -cp * cy, sp]];
    // So far away that the body fits into height and width.
    const f = 2.4, d = state.away * (around + 1.06 * f * Math.max(half[2], around * h / w)), near = d * 0.02, far = d + 4 * size;
    seen = { r, d, f, wide: w / h };
    const move = (row, e) => e - row.reduce((s, x, k) => s + x * middle[k], 0);
    const view = [r[0][0], r[1][0], r[2][0], 0, r[0][1], r[1][1], r[2][1], 0, r[0][2], r[1][2], r[2][2], 0, move(r[0], state.pan[0]), move(r[1], state.pan[1]), move(r[2], -d), 1];
    const lens = [f * h / w, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0];
    const all = multiply(lens, view), turn = [r[0][0], r[1][0], r[2][0], r[0][1], r[1][1], r[2][1], r[0][2], r[1][2], r[2][2]];
    const use = (p) => { gl.useProgram(p.p); gl.uniformMatrix4fv(p.uniform.view, false, all); gl.uniformMatrix3fv(p.uniform.turn, false, turn); };
    const m = meshes[state.mesh];
    if (m) {
      use(surface); gl.uniform1i(surface.uniform.kind, m.kind);
      if (m.texture) gl.bindTexture(gl.TEXTURE_2D, m.texture);
      gl.bindVertexArray(m.vao); gl.drawElements(gl.TRIANGLES, m.index.length, gl.UNSIGNED_INT, 0);
    }
    if (element("tapes").checked) {
      use(band); gl.enable(gl.BLEND); gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
      for (const t of tapes) {
        const on = t.name === state.marked;
        gl.bindVertexArray(t.vao);
        // The marked tape shines through the body.
        if (on) { gl.uniform4f(band.uniform.color, 1, 0, 0.2, 0.35); gl.disable(gl.DEPTH_TEST); gl.drawArrays(gl.TRIANGLE_STRIP, 0, t.count); gl.enable(gl.DEPTH_TEST); }
        gl.uniform4fv(band.uniform.color, on ? [1, 0, 0.2, 1] : [1, 0.78, 0.2, 1]); gl.drawArrays(gl.TRIANGLE_STRIP, 0, t.count);
      }
      gl.disable(gl.BLEND);
    }
    if (state.picked.length) { use(band); drawFound(); drawDots(); }
    gl.bindVertexArray(null);
  };
};
if (gl) { try { prepare(); } catch (error) { console.warn(error); no3d(); } } else no3d();
let waiting = false;
const frame = () => { waiting = false; draw(); canvas.dataset.drawn = String(1 + Number(canvas.dataset.drawn || 0)); };
listeners.push(() => { if (!waiting) { waiting = true; requestAnimationFrame(frame); } });
