// Points picked around the body by hand, for the paper's girth: a click on the surface is a point.
const hit = (x, y) => {
  const box = canvas.getBoundingClientRect(), m = meshes[state.mesh];
  if (!m || !seen) return null;
  const across = [(2 * (x - box.left) / box.width - 1) * seen.wide / seen.f, (1 - 2 * (y - box.top) / box.height) / seen.f, -1];
  const turned = (v) => [0, 1, 2].map((k) => v[0] * seen.r[0][k] + v[1] * seen.r[1][k] + v[2] * seen.r[2][k]);
  const eye = turned([-state.pan[0], -state.pan[1], seen.d]).map((v, k) => v + middle[k]), [dx, dy, dz] = turned(across);
  // The nearest triangle that the ray meets (Moller and Trumbore 1997).
  let least = Infinity;
  for (let i = 0; i < m.index.length; i += 3) {
    const a = 3 * m.index[i], b = 3 * m.index[i + 1], c = 3 * m.index[i + 2];
    const ax = m.at[a], ay = m.at[a + 1], az = m.at[a + 2];
    const ux = m.at[b] - ax, uy = m.at[b + 1] - ay, uz = m.at[b + 2] - az, vx = m.at[c] - ax, vy = m.at[c + 1] - ay, vz = m.at[c + 2] - az;
    const px = dy * vz - dz * vy, py = dz * vx - dx * vz, pz = dx * vy - dy * vx, det = ux * px + uy * py + uz * pz;
    if (Math.abs(det) < 1e-12) continue;
    const sx = eye[0] - ax, sy = eye[1] - ay, sz = eye[2] - az, u = (sx * px + sy * py + sz * pz) / det;
    if (u < 0 || u > 1) continue;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux, v = (dx * qx + dy * qy + dz * qz) / det;
    if (v < 0 || u + v > 1) continue;
    const t = (vx * qx + vy * qy + vz * qz) / det;
    if (t > 0 && t < least) least = t;
  }
  return least < Infinity ? [dx, dy, dz].map((v, k) => Math.round(10 * (eye[k] + least * v)) / 10) : null;
};
const pick = (points) => { state.picked = points; changed(); };
let down = null;
canvas.addEventListener("pointerdown", (e) => { down = [e.clientX, e.clientY]; });
canvas.addEventListener("pointerup", (e) => {
  if (!state.picking || !down || Math.hypot(e.clientX - down[0], e.clientY - down[1]) > 4) return;
  const point = hit(e.clientX, e.clientY);
  if (point) pick([...state.picked, point]);
});
element("pick").addEventListener("click", () => { state.picking = !state.picking; changed(); });
element("unpick").addEventListener("click", () => pick(state.picked.slice(0, -1)));
element("nopick").addEventListener("click", () => pick([]));
// Points of an earlier line may be put in, too.
element("points").addEventListener("input", () => {
  const rows = element("points").value.match(/\[\s*-?[\d.]+\s*,\s*-?[\d.]+\s*,\s*-?[\d.]+\s*\]/g) || [];
  pick(rows.map((row) => JSON.parse(row)));
});
// The girth through the points, on the surface that was measured, whichever is shown.
let measured = null;
const shownIn = (mm) => (mm / scene.lengths.mm).toFixed(scene.lengths.digits);
const through = (points) => {
  if (points.length < 3) return { why: `${points.length} of at least 3 points` };
  if (scene.measured === null) return { why: "this page carries a coarser surface than the one that was measured: the line below gives the girth" };
  measured = measured || welded(meshes[scene.measured]);
  return girthThrough(measured, points);
};
listeners.push(() => {
  element("pick").setAttribute("aria-pressed", String(state.picking));
  element("picker").hidden = !state.picking;
  canvas.classList.toggle("picking", state.picking);
  if (state.told === state.picked) return;
  state.told = state.picked;
  const text = state.picked.map((p) => `[${p.map((x) => x.toFixed(1)).join(", ")}]`).join(", ");
  if (document.activeElement !== element("points")) element("points").value = state.picked.length < 3 ? "" : `--set 'girths.points=[${text}]'`;
  const girth = through(state.picked), tape = girth.tape * scene.lengths.worn;
  state.found = girth.why ? null : girth;
  element("picked").textContent = girth.why || `${state.picked.length} points: tape ${shownIn(tape)}, contour ${shownIn(girth.contour)}, spline ${shownIn(girth.spline)} ${scene.lengths.word}`;
  Object.assign(element("picked").dataset, { tape: tape || "", contour: girth.contour || "", spline: girth.spline || "" });
});
