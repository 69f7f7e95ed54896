"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const rows = data.rows.map((r, i) => ({ ...r, i }));
  const number = (t) => (t.trim() !== "" && isFinite(t) ? Number(t) : null);
  const distinct = (list) => [...new Set(list)];
  const short = (x) => (Math.abs(x) >= 1000 ? x.toFixed(0) : String(+x.toPrecision(4)));
  const escape = (t) => String(t).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
  const colors = ["#2a6fdb", "#d4500c", "#1f9e6e", "#a04ac0", "#c79a00", "#0e98b0", "#c2386c", "#6b7a1e", "#8a5a3c", "#5a5ad0"];

  // --- a place on an axis for every value: numbers by size (log if they span decades), else words in order ---
  const axis = (texts) => {
    const known = texts.filter((t) => t !== null), numbers = known.map((t) => (typeof t === "number" ? t : number(t)));
    if (known.length && numbers.every((x) => x !== null)) {
      const [lo, hi] = [Math.min(...numbers), Math.max(...numbers)], log = lo > 0 && hi / lo > 30;
      const f = (x) => (log ? Math.log(x) : x), span = f(hi) - f(lo) || 1;
      const all = distinct(numbers).sort((a, b) => a - b);
      const ticks = all.length <= 6 ? all : log ? [lo, Math.exp((Math.log(lo) + Math.log(hi)) / 2), hi] : [0, 1, 2, 3, 4].map((k) => lo + ((hi - lo) * k) / 4);
      return { at: (t) => (hi === lo ? 0.5 : (f(typeof t === "number" ? t : number(t)) - f(lo)) / span), ticks: ticks.map((x) => [x, short(x)]) };
    }
    const words = distinct(known);
    return { at: (t) => (words.indexOf(t) + 0.5) / words.length, ticks: words.map((w) => [w, w]) };
  };
  const [W, H, L, R, T, B] = [320, 210, 48, 10, 8, 26];
  const legend = document.getElementById("legend"), plots = document.getElementById("view");
  const vary = data.params.map((_, p) => distinct(rows.map((r) => r.params[p])).length > 1);

  // --- one plot a param and a number; a line joins points that differ in this param only ---
  const others = (row, p) => row.params.filter((_, q) => q !== p && vary[q]).join(", ");
  const plot = (p, m) => {
    const shown = rows.filter((r) => r.metrics[m] !== null);
    if (!shown.length) return;
    const x = axis(shown.map((r) => r.params[p])), y = axis(shown.map((r) => r.metrics[m]));
    const X = (r) => L + 8 + x.at(r.params[p]) * (W - L - R - 16), Y = (v) => H - B - 6 - y.at(v) * (H - T - B - 12);
    const values = shown.map((r) => r.metrics[m]), lo = Math.min(...values), hi = Math.max(...values);
    let svg = `<svg viewBox="0 0 ${W} ${H}" role="img">`;
    for (const v of lo === hi ? [lo] : [lo, (lo + hi) / 2, hi]) svg += `<line class="grid" x1="${L}" x2="${W - R}" y1="${Y(v)}" y2="${Y(v)}"/><text x="${L - 4}" y="${Y(v) + 3}" text-anchor="end">${short(v)}</text>`;
    for (const [t, word] of x.ticks) { const at = L + 8 + x.at(t) * (W - L - R - 16); svg += `<text x="${at}" y="${H - B + 12}" text-anchor="middle">${escape(word)}</text>`; }
    const groups = distinct(shown.map((r) => others(r, p)));
    groups.forEach((g, k) => {
      const color = colors[k % colors.length];
      const line = shown.filter((r) => others(r, p) === g).sort((a, b) => x.at(a.params[p]) - x.at(b.params[p]));
      svg += `<polyline fill="none" stroke="${color}" stroke-width="1.5" opacity=".75" points="${line.map((r) => `${X(r)},${Y(r.metrics[m])}`).join(" ")}"/>`;
      for (const r of line) svg += `<circle data-row="${r.i}" cx="${X(r)}" cy="${Y(r.metrics[m])}" r="3.2" fill="${color}"><title>${escape(r.name)}: ${r.metrics[m]}</title></circle>`;
    });
    const figure = document.createElement("figure");
    figure.innerHTML = `<figcaption><b>${escape(data.metrics[m])}</b> over ${escape(data.params[p])}${groups.length > 1 && groups.length <= 10 ? "" : groups.length > 10 ? ` <span class="soft">(${groups.length} lines)</span>` : ""}</figcaption>${svg}</svg>`;
    if (groups.length > 1 && groups.length <= 10) figure.innerHTML += `<div class="legend">${groups.map((g, k) => `<span><i style="background:${colors[k % 10]}"></i>${escape(g)}</span>`).join("")}</div>`;
    plots.append(figure);
  };
  data.metrics.forEach((_, m) => data.params.forEach((_, p) => { if (vary[p] && plots.children.length < 60) plot(p, m); }));
  if (!plots.children.length) legend.textContent = "Nothing varies, or no metric was given.";

  // --- all columns as parallel axes: a line a point ---
  const place = document.getElementById("parallel");
  const shown = rows.filter((r) => r.metrics.some((v) => v !== null));
  const axes = [...data.params.map((name, p) => ({ name, of: (r) => r.params[p], on: vary[p] })), ...data.metrics.map((name, m) => ({ name, of: (r) => r.metrics[m], on: shown.some((r) => r.metrics[m] !== null) }))].filter((a) => a.on).slice(0, 14);
  if (shown.length && axes.length > 1) {
    const w = Math.max(700, axes.length * 110), h = 300, at = (i) => 50 + (i * (w - 110)) / (axes.length - 1);
    const scales = axes.map((a) => axis(shown.map(a.of))), Y = (i, v) => h - 24 - scales[i].at(v) * (h - 70);
    let svg = `<svg viewBox="0 0 ${w} ${h}" style="min-width:${w * 0.8}px">`;
    const last = axes.length - 1;
    for (const r of shown) {
      const points = axes.map((a, i) => [a.of(r), i]).filter(([v]) => v !== null).map(([v, i]) => `${at(i)},${Y(i, v)}`);
      const v = axes[last].of(r), share = v === null ? 0 : scales[last].at(v);
      svg += `<polyline data-row="${r.i}" fill="none" stroke="hsl(${215 - 195 * share} 70% 50%)" stroke-width="1.6" opacity=".7" points="${points.join(" ")}"><title>${escape(r.name)}</title></polyline>`;
    }
    axes.forEach((a, i) => {
      svg += `<line class="grid" x1="${at(i)}" x2="${at(i)}" y1="40" y2="${h - 18}"/><text x="${at(i)}" y="${i % 2 ? 26 : 12}" text-anchor="middle">${escape(a.name)}</text>`;
      for (const [t, word] of scales[i].ticks) svg += `<text x="${at(i) + 4}" y="${Y(i, t) + 3}">${escape(word)}</text>`;
    });
    place.innerHTML = svg + "</svg>";
  } else place.textContent = "Too few columns.";

  // --- a row, its dots and its line light up together; a click on a head sorts ---
  const table = document.getElementById("points"), body = table.tBodies[0];
  const mark = (i) => {
    body.querySelectorAll("tr").forEach((tr) => tr.classList.toggle("on", tr.dataset.row === i));
    document.querySelectorAll("circle[data-row]").forEach((c) => c.setAttribute("r", c.dataset.row === i ? 6 : 3.2));
    document.querySelectorAll("polyline[data-row]").forEach((c) => c.setAttribute("stroke-width", c.dataset.row === i ? 4 : 1.6));
  };
  document.addEventListener("mouseover", (e) => { const hit = e.target.closest("[data-row]"); if (hit) mark(hit.dataset.row); });
  [...table.tHead.rows[0].cells].forEach((head, k) => head.addEventListener("click", () => {
    const down = head.dataset.down === "1"; head.dataset.down = down ? "0" : "1";
    const key = (tr) => { const t = tr.cells[k].textContent; const x = parseFloat(t); return isNaN(x) ? t : x; };
    const sorted = [...body.rows].sort((a, b) => { const [x, y] = [key(a), key(b)]; const c = typeof x === "number" && typeof y === "number" ? x - y : String(x).localeCompare(String(y)); return down ? -c : c; });
    body.append(...sorted);
  }));
  plots.dataset.drawn = String(plots.children.length);
})();
