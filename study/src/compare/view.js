"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const canvas = document.getElementById("view");
  if (!canvas) return;
  const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) { document.getElementById("no3d").hidden = false; canvas.parentElement.hidden = true; return; }

  // --- one program: the colour is a mix of blue, white and orange by signed distance ---
  const shader = (kind, source) => {
    const s = gl.createShader(kind);
    gl.shaderSource(s, "#version 300 es\nprecision highp float;\n" + source);
    gl.compileShader(s);
    if (!gl.getShaderParameter(s, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(s));
    return s;
  };
  const program = gl.createProgram();
  gl.attachShader(program, shader(gl.VERTEX_SHADER, "layout(location=0) in vec3 at; layout(location=1) in vec3 normal; layout(location=2) in float off; uniform mat4 view; uniform mat3 turn; out vec3 n; out float d; void main() { n = turn * normal; d = off; gl_Position = view * vec4(at, 1.0); }"));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER, "in vec3 n; in float d; uniform float full; uniform bool colored; out vec4 o; void main() { float l = 0.3 + 0.7 * abs(normalize(n).z); float t = clamp(d / full, -1.0, 1.0); vec3 white = vec3(0.93), base = vec3(0.80, 0.74, 0.68); vec3 c = t < 0.0 ? mix(white, vec3(0.10, 0.35, 0.85), -t) : mix(white, vec3(0.88, 0.35, 0.05), t); o = vec4((colored ? c : base) * l, 1.0); }"));
  gl.linkProgram(program);
  const at = (name) => gl.getUniformLocation(program, name);
  const uniform = { view: at("view"), turn: at("turn"), full: at("full"), colored: at("colored") };

  const lo = [1e9, 1e9, 1e9], hi = [-1e9, -1e9, -1e9];
  const meshes = data.meshes.map((m) => {
    const p = Float32Array.from(m.positions, (x) => x / 10), d = Float32Array.from(m.distances, (x) => x / 100), f = Uint32Array.from(m.faces), n = new Float32Array(p.length);
    for (let i = 0; i < p.length; i++) { lo[i % 3] = Math.min(lo[i % 3], p[i]); hi[i % 3] = Math.max(hi[i % 3], p[i]); }
    for (let i = 0; i < f.length; i += 3) {
      const [a, b, c] = [f[i] * 3, f[i + 1] * 3, f[i + 2] * 3];
      const u = [0, 1, 2].map((k) => p[b + k] - p[a + k]), v = [0, 1, 2].map((k) => p[c + k] - p[a + k]);
      const x = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      for (const e of [a, b, c]) for (let k = 0; k < 3; k++) n[e + k] += x[k];
    }
    const vao = gl.createVertexArray();
    gl.bindVertexArray(vao);
    [[p, 3], [n, 3], [d, 1]].forEach(([values, size], place) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer()); gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(place); gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
    });
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer()); gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, f, gl.STATIC_DRAW);
    gl.bindVertexArray(null);
    return { name: m.name, vao, count: f.length };
  });

  const $ = (id) => document.getElementById(id);
  const [left, right, split, full] = [$("left"), $("right"), $("split"), $("full")];
  for (const select of [left, right]) meshes.forEach((m, i) => select.add(new Option(m.name, i)));
  left.value = 0; right.value = 1;
  const middle = lo.map((x, k) => (x + hi[k]) / 2), size = Math.max(1, ...hi.map((x, k) => x - lo[k]));
  const state = { yaw: 0, pitch: 0.05, away: 1.2, pan: [0, 0], mode: "wipe" };
  const multiply = (a, b) => { const o = new Float32Array(16); for (let c = 0; c < 4; c++) for (let r = 0; r < 4; r++) for (let k = 0; k < 4; k++) o[c * 4 + r] += a[k * 4 + r] * b[c * 4 + k]; return o; };

  const draw = () => {
    const ratio = Math.min(devicePixelRatio || 1, 2), W = Math.max(2, Math.round(canvas.clientWidth * ratio)), H = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== W || canvas.height !== H) { canvas.width = W; canvas.height = H; }
    const back = getComputedStyle(canvas).backgroundColor.match(/[\d.]+/g).map(Number);
    gl.disable(gl.SCISSOR_TEST); gl.enable(gl.DEPTH_TEST);
    gl.clearColor(back[0] / 255, back[1] / 255, back[2] / 255, 1); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const beside = state.mode === "beside", w = beside ? W / 2 : W;
    const [cy, sy, cp, sp] = [Math.cos(state.yaw), Math.sin(state.yaw), Math.cos(state.pitch), Math.sin(state.pitch)];
    const r = [[cy, sy, 0], [-sp * sy, sp * cy, cp], [cp * sy, -cp * cy, sp]];
    const d = state.away * size, f = 2.2 * Math.min(1, (w / H) * 1.6), near = d * 0.05, far = d * 6;
    const move = (row, e) => e - row.reduce((s, x, k) => s + x * middle[k], 0);
    const view = new Float32Array([r[0][0], r[1][0], r[2][0], 0, r[0][1], r[1][1], r[2][1], 0, r[0][2], r[1][2], r[2][2], 0, move(r[0], state.pan[0]), move(r[1], state.pan[1]), move(r[2], -d), 1]);
    const lens = new Float32Array([(f * H) / w, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0]);
    gl.useProgram(program);
    gl.uniformMatrix4fv(uniform.view, false, multiply(lens, view));
    gl.uniformMatrix3fv(uniform.turn, false, new Float32Array([r[0][0], r[1][0], r[2][0], r[0][1], r[1][1], r[2][1], r[0][2], r[1][2], r[2][2]]));
    gl.uniform1f(uniform.full, Number(full.value)); gl.uniform1i(uniform.colored, $("colored").checked ? 1 : 0);
    $("shown").textContent = full.value;
    const cut = Math.round((beside ? 0.5 : Number(split.value)) * W);
    gl.enable(gl.SCISSOR_TEST);
    for (const [mesh, x, width, shift] of [[meshes[left.value], 0, cut, 0], [meshes[right.value], cut, W - cut, beside ? W / 2 : 0]]) {
      if (width < 1) continue;
      gl.viewport(shift, 0, w, H); gl.scissor(x, 0, width, H);
      gl.bindVertexArray(mesh.vao); gl.drawElements(gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0);
    }
    // The line between.
    gl.scissor(Math.max(0, cut - 1), 0, 2, H); gl.clearColor(0.5, 0.5, 0.5, 1); gl.clear(gl.COLOR_BUFFER_BIT);
    gl.bindVertexArray(null);
    canvas.dataset.drawn = String(1 + Number(canvas.dataset.drawn || 0));
  };
  let waiting = false;
  const redraw = () => { if (waiting) return; waiting = true; requestAnimationFrame(() => { waiting = false; draw(); }); };

  // --- hands ---
  const pointers = new Map();
  canvas.addEventListener("pointerdown", (e) => { canvas.setPointerCapture(e.pointerId); pointers.set(e.pointerId, [e.clientX, e.clientY]); });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (e) => pointers.delete(e.pointerId));
  const zoom = (k) => { state.away = Math.max(0.15, Math.min(6, state.away * k)); redraw(); };
  canvas.addEventListener("pointermove", (e) => {
    const from = pointers.get(e.pointerId);
    if (!from) return;
    const [dx, dy] = [e.clientX - from[0], e.clientY - from[1]];
    if (pointers.size > 1) {
      const other = [...pointers].find(([id]) => id !== e.pointerId)[1], span = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
      zoom(span(from) / Math.max(1, span([e.clientX, e.clientY])));
    } else if (e.shiftKey || e.buttons === 2) {
      const k = (state.away * size) / canvas.clientHeight; state.pan[0] += dx * k; state.pan[1] -= dy * k;
    } else { state.yaw -= dx * 0.008; state.pitch = Math.max(-1.5, Math.min(1.5, state.pitch + dy * 0.008)); }
    pointers.set(e.pointerId, [e.clientX, e.clientY]);
    redraw();
  });
  canvas.addEventListener("wheel", (e) => { e.preventDefault(); zoom(Math.exp(e.deltaY * 0.001)); }, { passive: false });
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("keydown", (e) => { const turn = { ArrowLeft: 0.1, ArrowRight: -0.1 }[e.key]; if (turn) { state.yaw += turn; redraw(); } else if (e.key === "+") zoom(0.9); else if (e.key === "-") zoom(1.1); });
  for (const control of [left, right, split, full, $("colored")]) control.addEventListener("input", redraw);
  for (const [id, yaw] of [["front", 0], ["side", Math.PI / 2], ["back", Math.PI]]) $(id).addEventListener("click", () => { state.yaw = yaw; state.pitch = 0.05; redraw(); });
  const modes = [...document.querySelectorAll("[data-mode]")];
  modes.forEach((b) => b.addEventListener("click", () => { state.mode = b.dataset.mode; modes.forEach((c) => c.setAttribute("aria-pressed", String(c === b))); redraw(); }));
  addEventListener("resize", redraw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  redraw();
})();
