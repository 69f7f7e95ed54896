"use strict";
(() => {
  // --- a row, its dots and its line light up together; a click on a head sorts ---
  const body = document.getElementById("points").tBodies[0];
  const mark = (i) => {
    body.querySelectorAll("tr").forEach((tr) => tr.classList.toggle("on", tr.dataset.row === i));
    document.querySelectorAll("circle[data-row]").forEach((c) => c.setAttribute("r", c.dataset.row === i ? 6 : 3.2));
    document.querySelectorAll("polyline[data-row]").forEach((c) => c.setAttribute("stroke-width", c.dataset.row === i ? 4 : 1.6));
  };
  document.addEventListener("mouseover", (e) => { const hit = e.target.closest("[data-row]"); if (hit) mark(hit.dataset.row); });
  document.querySelectorAll("table").forEach((table) => [...table.tHead.rows[0].cells].forEach((head, k) => head.addEventListener("click", () => {
    const down = head.dataset.down === "1"; head.dataset.down = down ? "0" : "1";
    const key = (tr) => { const t = tr.cells[k].textContent; const x = parseFloat(t); return isNaN(x) ? t : x; };
    const sorted = [...table.tBodies[0].rows].sort((a, b) => { const [x, y] = [key(a), key(b)]; const c = typeof x === "number" && typeof y === "number" ? x - y : String(x).localeCompare(String(y)); return down ? -c : c; });
    table.tBodies[0].append(...sorted);
  })));
  // --- who comes by a link to a row sees what is behind it ---
  const open = () => { const row = document.getElementById(location.hash.slice(1)); const more = row && row.querySelector("details"); if (more) more.open = true; };
  addEventListener("hashchange", open); open();
  const plots = document.getElementById("view");
  plots.dataset.drawn = String(plots.children.length);
})();
