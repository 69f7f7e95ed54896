// From where to look: the front, the side, a photo's camera; and which surface.
const towards = (x, y) => Math.atan2(x, -y);
const front = towards(scene.front[0], scene.front[1]);
const look = (yaw, pitch) => { state.yaw = yaw; state.pitch = pitch; changed(); };
const home = () => { state.away = 1; state.pan = [0, 0]; look(front, 0.05); };
const zoom = (k) => { state.away = Math.max(0.08, Math.min(4, state.away * k)); changed(); };
const tilt = (by) => { state.pitch = Math.max(-1.5, Math.min(1.5, state.pitch + by)); };
const from = (photo) => {
  const c = scene.views[photo];
  if (c) look(towards(c[0], c[1]), Math.atan2(c[2] - middle[2], Math.hypot(c[0], c[1])));
  document.querySelectorAll(".cam").forEach((e) => e.classList.toggle("on", e.dataset.photo === String(photo)));
};
const show = (i) => { if (meshes[i]) { state.mesh = i; changed(); } };
meshes.forEach((m, i) => {
  const b = document.createElement("button");
  b.textContent = m.label;
  b.addEventListener("click", () => show(i));
  element("meshes").append(b);
});
listeners.push(() => [...element("meshes").children].forEach((b, i) => b.setAttribute("aria-pressed", String(i === state.mesh))));
element("front").addEventListener("click", home);
element("side").addEventListener("click", () => look(front + Math.PI / 2, 0.05));
element("back").addEventListener("click", () => look(front + Math.PI, 0.05));
element("closer").addEventListener("click", () => zoom(0.8));
element("farther").addEventListener("click", () => zoom(1.25));
element("tapes").addEventListener("change", changed);

// The table: a click marks the tape, here, in the 3D view and on the photos.
const lines = [...document.querySelectorAll("#girths tbody tr")];
const mark = (name) => { state.marked = state.marked === name ? null : name; changed(); };
const tell = (row) => { element("sure").textContent = row ? `${row.dataset.name}: ${row.dataset.sure}` : ""; };
lines.forEach((row) => {
  row.addEventListener("mouseenter", () => tell(row));
  row.addEventListener("focus", () => tell(row));
  row.addEventListener("click", () => mark(row.dataset.name));
  row.addEventListener("keydown", (e) => { if (e.key === "Enter" || e.key === " ") { e.preventDefault(); mark(row.dataset.name); } });
});
listeners.push(() => {
  lines.forEach((r) => r.classList.toggle("on", r.dataset.name === state.marked));
  document.querySelectorAll(".tape").forEach((p) => p.classList.toggle("on", p.dataset.name === state.marked));
  const t = scene.tapes.find((t) => t.name === state.marked);
  element("said").textContent = t ? `${t.label} ${t.text}` : "";
  element("where").textContent = t ? t.definition : "";
});
