"use strict";
// What the page carries, as arrays: the other side of packing.rs.
const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const whole = (text) => {
  const from = bytes(text), to = new Uint32Array(from.length);
  let n = 0, value = 0, shift = 0;
  for (const b of from) {
    value |= (b & 127) << shift;
    if (b & 128) shift += 7; else { to[n++] = value; value = shift = 0; }
  }
  return to.subarray(0, n);
};
const rows = (text, width) => {
  const steps = whole(text), to = new Int32Array(steps.length);
  for (let i = 0; i < steps.length; i++) to[i] = ((steps[i] >>> 1) ^ -(steps[i] & 1)) + (i < width ? 0 : to[i - width]);
  return to;
};
const corners = (text) => {
  const behind = whole(text), to = new Uint32Array(behind.length);
  let newest = 0;
  for (let i = 0; i < behind.length; i++) { to[i] = newest - behind[i]; if (behind[i] === 0) newest++; }
  return to;
};
// A surface in millimetres; normals are means over the faces around, by area.
const unpacked = (m) => {
  const index = corners(m.corners), at = m.exact ? new Float32Array(bytes(m.exact).buffer) : Float32Array.from(rows(m.at, 3), (x, i) => m.lo[i % 3] + x * m.step);
  const normals = new Float32Array(at.length);
  for (let i = 0; i < index.length; i += 3) {
    const a = index[i] * 3, b = index[i + 1] * 3, c = index[i + 2] * 3;
    const ux = at[b] - at[a], uy = at[b + 1] - at[a + 1], uz = at[b + 2] - at[a + 2];
    const vx = at[c] - at[a], vy = at[c + 1] - at[a + 1], vz = at[c + 2] - at[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    for (const k of [a, b, c]) { normals[k] += x; normals[k + 1] += y; normals[k + 2] += z; }
  }
  const color = m.colors ? Uint8Array.from(rows(m.colors, 3)) : null;
  const uv = m.uv ? Uint16Array.from(rows(m.uv, 2)) : null;
  return { label: m.label, index, at, normals, color, uv, atlas: m.atlas };
};
const scene = JSON.parse(document.getElementById("scene").textContent);
const element = (id) => document.getElementById(id);
// What the reader looks at: the same for the 3D view, the table and the photos.
const state = { yaw: 0, pitch: 0.05, away: 1, pan: [0, 0], mesh: 0, marked: null, picking: false, picked: [], told: null, found: null };
const listeners = [];
const changed = () => listeners.forEach((f) => f());
