"use strict";
(() => {
  const scene = JSON.parse(document.getElementById("scene").textContent);
  const canvas = document.getElementById("view");
  const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

  // --- the table: a click marks the tape ---
  let marked = null;
  const rows = [...document.querySelectorAll("#girths tbody tr")];
  rows.forEach((row) => row.addEventListener("click", () => {
    marked = marked === row.dataset.name ? null : row.dataset.name;
    rows.forEach((r) => r.classList.toggle("on", r.dataset.name === marked));
    redraw();
  }));
  if (!gl) { document.getElementById("no3d").hidden = false; canvas.hidden = true; return; }

  // --- programs ---
  const program = (vertex, fragment) => {
    const p = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const s = gl.createShader(kind);
      gl.shaderSource(s, "#version 300 es\nprecision highp float;\n" + source);
      gl.compileShader(s);
      if (!gl.getShaderParameter(s, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(s));
      gl.attachShader(p, s);
    }
    gl.bindAttribLocation(p, 0, "at"); gl.bindAttribLocation(p, 1, "normal"); gl.bindAttribLocation(p, 2, "uv");
    gl.linkProgram(p);
    const uniform = {};
    for (let i = gl.getProgramParameter(p, gl.ACTIVE_UNIFORMS); i--;) { const u = gl.getActiveUniform(p, i).name; uniform[u] = gl.getUniformLocation(p, u); }
    return { p, uniform };
  };
  const surface = program(
    "in vec3 at; in vec3 normal; in vec2 uv; uniform mat4 view; uniform mat3 turn; uniform vec3 lo; uniform float step; out vec3 n; out vec2 t;" +
    "void main() { n = turn * normal; t = uv; gl_Position = view * vec4(lo + at * step, 1.0); }",
    "in vec3 n; in vec2 t; uniform sampler2D atlas; uniform bool painted; uniform vec3 color; out vec4 o;" +
    "void main() { vec3 m = normalize(n); float l = 0.35 + 0.65 * abs(m.z) + 0.1 * m.y; vec3 c = painted ? texture(atlas, t).rgb * (0.8 + 0.2 * abs(m.z)) : color * l; o = vec4(c, 1.0); }");
  const line = program(
    "in vec3 at; uniform mat4 view; void main() { gl_Position = view * vec4(at, 1.0); gl_Position.z -= 0.0005 * gl_Position.w; }",
    "uniform vec3 color; out vec4 o; void main() { o = vec4(color, 1.0); }");

  // --- meshes ---
  const buffer = (kind, data) => { const b = gl.createBuffer(); gl.bindBuffer(kind, b); gl.bufferData(kind, data, gl.STATIC_DRAW); return b; };
  const normals = (p, index) => {
    const n = new Float32Array(p.length);
    for (let i = 0; i < index.length; i += 3) {
      const [a, b, c] = [index[i] * 3, index[i + 1] * 3, index[i + 2] * 3];
      const u = [0, 1, 2].map((k) => p[b + k] - p[a + k]), v = [0, 1, 2].map((k) => p[c + k] - p[a + k]);
      const x = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      for (const d of [a, b, c]) for (let k = 0; k < 3; k++) n[d + k] += x[k];
    }
    return n;
  };
  const bounds = { lo: [1e9, 1e9, 1e9], hi: [-1e9, -1e9, -1e9] };
  const meshes = scene.meshes.map((m) => {
    const p = new Uint16Array(bytes(m.positions.data).buffer), index = new Uint32Array(bytes(m.indices).buffer);
    for (let i = 0; i < p.length; i++) {
      const x = m.positions.lo[i % 3] + p[i] * m.positions.step;
      bounds.lo[i % 3] = Math.min(bounds.lo[i % 3], x); bounds.hi[i % 3] = Math.max(bounds.hi[i % 3], x);
    }
    const vao = gl.createVertexArray();
    gl.bindVertexArray(vao);
    buffer(gl.ARRAY_BUFFER, p); gl.enableVertexAttribArray(0); gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, false, 0, 0);
    buffer(gl.ARRAY_BUFFER, normals(p, index)); gl.enableVertexAttribArray(1); gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 0, 0);
    if (m.uv) { buffer(gl.ARRAY_BUFFER, new Uint16Array(bytes(m.uv).buffer)); gl.enableVertexAttribArray(2); gl.vertexAttribPointer(2, 2, gl.UNSIGNED_SHORT, true, 0, 0); }
    buffer(gl.ELEMENT_ARRAY_BUFFER, index);
    const mesh = { ...m, vao, atlas: null };
    if (m.atlas) {
      const image = new Image();
      image.onload = () => {
        mesh.atlas = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, mesh.atlas);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, gl.RGB, gl.UNSIGNED_BYTE, image);
        gl.generateMipmap(gl.TEXTURE_2D);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
        redraw();
      };
      image.src = m.atlas;
    }
    return mesh;
  });
  const tapes = scene.tapes.map((t) => {
    const vao = gl.createVertexArray();
    gl.bindVertexArray(vao);
    buffer(gl.ARRAY_BUFFER, new Float32Array(t.points.flat())); gl.enableVertexAttribArray(0); gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    return { ...t, vao, count: t.points.length };
  });
  gl.bindVertexArray(null);

  // --- camera: orbits the middle of the body; z is up; the subject faces -y at the first photo ---
  const middle = [0, 1, 2].map((k) => (bounds.lo[k] + bounds.hi[k]) / 2);
  const size = Math.max(1, ...[0, 1, 2].map((k) => bounds.hi[k] - bounds.lo[k]));
  const state = { yaw: 0, pitch: 0.05, away: 1.5, pan: [0, 0], mesh: 0 };
  const multiply = (a, b) => { const o = new Float32Array(16); for (let c = 0; c < 4; c++) for (let r = 0; r < 4; r++) for (let k = 0; k < 4; k++) o[c * 4 + r] += a[k * 4 + r] * b[c * 4 + k]; return o; };
  const draw = () => {
    const ratio = Math.min(devicePixelRatio || 1, 2), w = Math.max(1, Math.round(canvas.clientWidth * ratio)), h = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
    gl.viewport(0, 0, w, h);
    const back = getComputedStyle(canvas).backgroundColor.match(/[\d.]+/g).map(Number);
    gl.clearColor(back[0] / 255, back[1] / 255, back[2] / 255, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT); gl.enable(gl.DEPTH_TEST);
    const [cy, sy, cp, sp] = [Math.cos(state.yaw), Math.sin(state.yaw), Math.cos(state.pitch), Math.sin(state.pitch)];
    // camera x = right, y = up, z = towards the viewer, who stands at -y
    const r = [[cy, sy, 0], [-sp * sy, sp * cy, cp], [cp * sy, -cp * cy, sp]];
    const d = state.away * size, f = 2.2 * Math.min(1, h / w * 1.4), near = d * 0.05, far = d * 6;
    const move = (row, e) => e - row.reduce((s, x, k) => s + x * middle[k], 0);
    const view = new Float32Array([r[0][0], r[1][0], r[2][0], 0, r[0][1], r[1][1], r[2][1], 0, r[0][2], r[1][2], r[2][2], 0, move(r[0], state.pan[0]), move(r[1], state.pan[1]), move(r[2], -d), 1]);
    const lens = new Float32Array([f * h / w, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0]);
    const all = multiply(lens, view), m = meshes[state.mesh];
    gl.useProgram(surface.p);
    gl.uniformMatrix4fv(surface.uniform.view, false, all);
    gl.uniformMatrix3fv(surface.uniform.turn, false, new Float32Array([r[0][0], r[1][0], r[2][0], r[0][1], r[1][1], r[2][1], r[0][2], r[1][2], r[2][2]]));
    gl.uniform3fv(surface.uniform.lo, m.positions.lo); gl.uniform1f(surface.uniform.step, m.positions.step);
    gl.uniform1i(surface.uniform.painted, m.atlas ? 1 : 0); gl.uniform3f(surface.uniform.color, 0.80, 0.74, 0.68);
    if (m.atlas && m.atlas instanceof WebGLTexture) gl.bindTexture(gl.TEXTURE_2D, m.atlas);
    gl.bindVertexArray(m.vao); gl.drawElements(gl.TRIANGLES, m.count, gl.UNSIGNED_INT, 0);
    if (document.getElementById("tapes").checked) {
      gl.useProgram(line.p); gl.uniformMatrix4fv(line.uniform.view, false, all);
      for (const t of tapes) {
        const on = t.name === marked;
        gl.uniform3f(line.uniform.color, on ? 1 : 0.85, on ? 0.1 : 0.35, on ? 0.1 : 0.05);
        gl.bindVertexArray(t.vao); gl.drawArrays(gl.LINE_LOOP, 0, t.count);
        if (on) { gl.disable(gl.DEPTH_TEST); gl.drawArrays(gl.LINE_LOOP, 0, t.count); gl.enable(gl.DEPTH_TEST); }
      }
    }
    gl.bindVertexArray(null);
    canvas.dataset.drawn = String(1 + Number(canvas.dataset.drawn || 0));
  };
  let waiting = false;
  function redraw() { if (!gl || waiting) return; waiting = true; requestAnimationFrame(() => { waiting = false; draw(); }); }

  // --- hands ---
  const pointers = new Map();
  canvas.addEventListener("pointerdown", (e) => { canvas.setPointerCapture(e.pointerId); pointers.set(e.pointerId, [e.clientX, e.clientY]); });
  const gone = (e) => pointers.delete(e.pointerId);
  canvas.addEventListener("pointerup", gone); canvas.addEventListener("pointercancel", gone);
  canvas.addEventListener("pointermove", (e) => {
    const from = pointers.get(e.pointerId);
    if (!from) return;
    const [dx, dy] = [e.clientX - from[0], e.clientY - from[1]];
    if (pointers.size === 1 && !e.shiftKey && e.buttons !== 2) {
      state.yaw -= dx * 0.008; state.pitch = Math.max(-1.5, Math.min(1.5, state.pitch + dy * 0.008));
    } else if (pointers.size === 1) {
      const k = state.away * size / canvas.clientHeight; state.pan[0] += dx * k; state.pan[1] -= dy * k;
    } else {
      const other = [...pointers].find(([id]) => id !== e.pointerId)[1];
      const span = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
      zoom(span(from) / Math.max(1, span([e.clientX, e.clientY])));
    }
    pointers.set(e.pointerId, [e.clientX, e.clientY]);
    redraw();
  });
  const zoom = (k) => { state.away = Math.max(0.15, Math.min(6, state.away * k)); redraw(); };
  canvas.addEventListener("wheel", (e) => { e.preventDefault(); zoom(Math.exp(e.deltaY * 0.001)); }, { passive: false });
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("keydown", (e) => {
    const turn = { ArrowLeft: 0.1, ArrowRight: -0.1 }[e.key];
    if (turn) { state.yaw += turn; redraw(); } else if (e.key === "+") zoom(0.9); else if (e.key === "-") zoom(1.1);
  });
  for (const [id, yaw] of [["front", 0], ["side", Math.PI / 2], ["back", Math.PI]]) document.getElementById(id).addEventListener("click", () => { state.yaw = yaw; state.pitch = 0.05; redraw(); });
  document.getElementById("tapes").addEventListener("change", redraw);
  const bar = document.getElementById("meshes");
  meshes.forEach((m, i) => {
    const b = document.createElement("button");
    b.textContent = m.label; b.setAttribute("aria-pressed", String(i === 0));
    b.addEventListener("click", () => { state.mesh = i; [...bar.children].forEach((c, k) => c.setAttribute("aria-pressed", String(k === i))); redraw(); });
    bar.append(b, " ");
  });
  addEventListener("resize", redraw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  redraw();
})();
