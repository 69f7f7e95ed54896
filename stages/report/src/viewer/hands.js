// Mouse, touch and keys on the 3D view.
const pointers = new Map();
canvas.addEventListener("pointerdown", (e) => { canvas.setPointerCapture(e.pointerId); pointers.set(e.pointerId, [e.clientX, e.clientY]); });
for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) canvas.addEventListener(end, (e) => pointers.delete(e.pointerId));
const pan = (dx, dy) => { const k = state.away * size / Math.max(1, canvas.clientHeight); state.pan[0] += dx * k; state.pan[1] -= dy * k; };
canvas.addEventListener("pointermove", (e) => {
  const old = pointers.get(e.pointerId);
  if (!old) return;
  const now = [e.clientX, e.clientY], dx = now[0] - old[0], dy = now[1] - old[1];
  if (pointers.size > 1) {
    // Two fingers: apart is closer, together is moving.
    const other = [...pointers].find(([id]) => id !== e.pointerId)[1], span = (p) => Math.max(1, Math.hypot(p[0] - other[0], p[1] - other[1]));
    pan(dx / 2, dy / 2);
    zoom(span(old) / span(now));
  } else if (e.shiftKey || e.buttons === 2 || e.buttons === 4) pan(dx, dy);
  else { state.yaw -= dx * 0.008; tilt(dy * 0.008); }
  pointers.set(e.pointerId, now);
  changed();
});
canvas.addEventListener("wheel", (e) => { e.preventDefault(); zoom(Math.exp(Math.max(-1, Math.min(1, e.deltaY * 0.001)))); }, { passive: false });
canvas.addEventListener("contextmenu", (e) => e.preventDefault());
canvas.addEventListener("keydown", (e) => {
  const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key];
  if (e.ctrlKey || e.altKey || e.metaKey) return;
  if (arrow && e.shiftKey) pan(20 * arrow[0], 20 * arrow[1]);
  else if (arrow) { state.yaw -= 0.1 * arrow[0]; tilt(0.1 * arrow[1]); }
  else if (e.key === "+" || e.key === "=") zoom(0.9);
  else if (e.key === "-") zoom(1.1);
  else if (e.key === "0" || e.key === "Home") home();
  else if (e.key === "t") { element("tapes").checked = !element("tapes").checked; }
  else if (e.key >= "1" && e.key <= "9") show(Number(e.key) - 1);
  else return;
  e.preventDefault();
  changed();
});
