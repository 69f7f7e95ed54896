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
  // Letters of 10 px are about 5.8 px wide.
  const wide = (text) => 5.8 * String(text).length;
  const [W, H, R, T] = [320, 220, 12, 10];
  const legend = document.getElementById("legend"), plots = document.getElementById("view");
  const vary = data.params.map((_, p) => distinct(rows.map((r) => r.params[p])).length > 1);
  const moves = data.metrics.map((_, m) => distinct(rows.map((r) => r.metrics[m]).filter((v) => v !== null)).length > 1);

  // --- one plot a param and a number; a line joins points that differ in this param only ---
  const others = (row, p) => row.params.map((value, q) => (q !== p && vary[q] ? `${data.params[q]} = ${value}` : "")).filter((t) => t).join(", ");
  // Ticks that lie on each other, or reach out of the drawing, are left out or moved in.
  const along = (ticks, at, low, high, y) => {
    let svg = "", end = -Infinity;
    for (const [t, word] of ticks) {
      const x = Math.min(Math.max(at(t), low + wide(word) / 2), high - wide(word) / 2);
      if (x - wide(word) / 2 < end + 4) continue;
      end = x + wide(word) / 2;
      svg += `<text x="${x}" y="${y}" text-anchor="middle">${escape(word)}</text>`;
    }
    return svg;
  };
  const slanted = (ticks, at, y) => ticks.map(([t, word]) => `<text transform="translate(${at(t) + 3} ${y}) rotate(-35)" text-anchor="end">${escape(word)}</text>`).join("");
  const plot = (p, m) => {
    const shown = rows.filter((r) => r.metrics[m] !== null);
    const x = axis(shown.map((r) => r.params[p])), y = axis(shown.map((r) => r.metrics[m]));
    const values = shown.map((r) => r.metrics[m]), lo = Math.min(...values), hi = Math.max(...values);
    const levels = [lo, (lo + hi) / 2, hi];
    // The name of a method may be longer than its share of the axis: then all names stand aslant.
    const words = x.ticks.map((t) => t[1]), longest = Math.max(...words.map(wide)), text = words.some((w) => number(w) === null);
    const crowded = text && longest > 230 / words.length, L = Math.max(...levels.map((v) => wide(short(v)))) + 10, B = crowded ? 16 + Math.min(90, 0.6 * longest) : 26;
    const left = crowded ? Math.max(L, 0.8 * longest - 100 / words.length) : L, at = (t) => left + 8 + x.at(t) * (W - left - R - 16);
    const X = (r) => at(r.params[p]), Y = (v) => H - B - 6 - y.at(v) * (H - T - B - 12);
    let svg = `<svg viewBox="0 0 ${W} ${H}" role="img" aria-label="${escape(data.metrics[m])} over ${escape(data.params[p])}">`;
    for (const v of levels) svg += `<line class="grid" x1="${left}" x2="${W - R}" y1="${Y(v)}" y2="${Y(v)}"/><text x="${left - 4}" y="${Y(v) + 3}" text-anchor="end">${short(v)}</text>`;
    svg += crowded ? slanted(x.ticks, at, H - B + 8) : along(x.ticks, at, 0, W, H - B + 12);
    const groups = distinct(shown.map((r) => others(r, p)));
    groups.forEach((g, k) => {
      const color = colors[k % colors.length];
      const line = shown.filter((r) => others(r, p) === g).sort((a, b) => x.at(a.params[p]) - x.at(b.params[p]));
      svg += `<polyline fill="none" stroke="${color}" stroke-width="1.5" opacity=".75" points="${line.map((r) => `${X(r)},${Y(r.metrics[m])}`).join(" ")}"/>`;
      for (const r of line) svg += `<circle data-row="${r.i}" cx="${X(r)}" cy="${Y(r.metrics[m])}" r="3.2" fill="${color}"><title>${escape(r.name)}: ${r.metrics[m]}</title></circle>`;
    });
    const figure = document.createElement("figure");
    figure.innerHTML = `<figcaption><b>${escape(data.metrics[m])}</b> over ${escape(data.params[p])}${groups.length > 10 ? ` <span class="soft">(${groups.length} lines)</span>` : ""}</figcaption>${svg}</svg>`;
    if (groups.length > 1 && groups.length <= 10) figure.innerHTML += `<div class="legend">${groups.map((g, k) => `<span><i style="background:${colors[k % 10]}"></i>${escape(g)}</span>`).join("")}</div>`;
    plots.append(figure);
  };
  data.metrics.forEach((_, m) => data.params.forEach((_, p) => { if (vary[p] && moves[m] && plots.children.length < 60) plot(p, m); }));
  const still = data.metrics.map((name, m) => [name, rows.map((r) => r.metrics[m]).find((v) => v !== null), m]).filter(([, v, m]) => !moves[m] && v !== undefined);
  const told = plots.children.length ? [] : ["Nothing varies, or no metric was given."];
  if (still.length && rows.length > 1) told.push(`The same at every point, so not drawn: ${still.map(([name, v]) => `${name} ${short(v)}`).join("; ")}.`);
  legend.textContent = told.join(" ");

  // --- all columns as parallel axes: a line a point ---
  const place = document.getElementById("parallel");
  const shown = rows.filter((r) => r.metrics.some((v) => v !== null));
  const axes = [...data.params.map((name, p) => ({ name, of: (r) => r.params[p], on: vary[p] })), ...data.metrics.map((name, m) => ({ name, of: (r) => r.metrics[m], on: moves[m] }))].filter((a) => a.on).slice(0, 14);
  if (shown.length && axes.length > 1) {
    // A name stands on two lines: the node, and what is its own.
    const names = axes.map((a) => { const dot = a.name.indexOf("."); return dot < 0 ? ["", a.name] : [a.name.slice(0, dot), a.name.slice(dot + 1)]; });
    const room = Math.max(...names.flat().map(wide), ...axes.flatMap((a) => axis(shown.map(a.of)).ticks.map((t) => wide(t[1])))) + 14, step = Math.max(100, room), w = axes.length * step, h = 300, at = (i) => (i + 0.5) * step;
    const scales = axes.map((a) => axis(shown.map(a.of))), Y = (i, v) => h - 24 - scales[i].at(v) * (h - 70);
    let svg = `<svg viewBox="0 0 ${w} ${h}" style="min-width:${w * 0.8}px;max-width:${w * 1.3}px">`;
    const last = axes.length - 1;
    for (const r of shown) {
      const points = axes.map((a, i) => [a.of(r), i]).filter(([v]) => v !== null).map(([v, i]) => `${at(i)},${Y(i, v)}`);
      const v = axes[last].of(r), share = v === null ? 0 : scales[last].at(v);
      svg += `<polyline data-row="${r.i}" fill="none" stroke="hsl(${215 - 195 * share} 70% 50%)" stroke-width="1.6" opacity=".7" points="${points.join(" ")}"><title>${escape(r.name)}</title></polyline>`;
    }
    axes.forEach((a, i) => {
      svg += `<line class="grid" x1="${at(i)}" x2="${at(i)}" y1="40" y2="${h - 18}"/><text x="${at(i)}" y="12" text-anchor="middle">${escape(names[i][0])}</text><text x="${at(i)}" y="26" text-anchor="middle">${escape(names[i][1])}</text>`;
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
