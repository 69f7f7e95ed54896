// What is wrong with this page for who hears it, sees little, or has no mouse: a list of sentences.
(() => {
  const wrong = [];
  const all = (selector) => [...document.querySelectorAll(selector)];
  const shown = (e) => e.getClientRects().length > 0 && getComputedStyle(e).visibility !== "hidden";
  const name = (e) => {
    const by = (e.getAttribute("aria-labelledby") ?? "").split(" ").map((id) => document.getElementById(id)?.textContent ?? "").join("");
    const labels = [...(e.labels ?? [])].map((l) => l.textContent).join("");
    const inner = e.textContent + [...e.querySelectorAll("img[alt]")].map((i) => i.alt).join("");
    return (by || e.getAttribute("aria-label") || labels || e.getAttribute("alt") || inner).trim();
  };
  const what = (e) => e.outerHTML.slice(0, 90);
  if (!document.documentElement.lang) wrong.push("no language");
  if (!document.title) wrong.push("no title");
  if (all("h1").length !== 1) wrong.push(`${all("h1").length} first headings`);
  if (all("main").length !== 1) wrong.push("no main part");
  let level = 0;
  for (const h of all("h1, h2, h3, h4")) {
    const now = Number(h.tagName[1]);
    if (now > level + 1) wrong.push(`a heading is left out before ${what(h)}`);
    level = now;
  }
  const ids = all("[id]").map((e) => e.id);
  for (const id of ids.filter((id, at) => ids.indexOf(id) !== at)) wrong.push(`the id ${id} stands twice`);
  for (const e of all("input:not([type=hidden]), select, textarea, button, a[href], progress, summary, [role=region]")) {
    if (!name(e)) wrong.push(`without a name: ${what(e)}`);
  }
  for (const e of all("img")) if (!e.hasAttribute("alt")) wrong.push(`without alt: ${what(e)}`);
  for (const e of all("[aria-describedby], [aria-labelledby]")) {
    for (const attribute of ["aria-describedby", "aria-labelledby"]) {
      for (const id of (e.getAttribute(attribute) ?? "").split(" ").filter((id) => id)) {
        if (!document.getElementById(id)) wrong.push(`${attribute} leads to nothing: ${id}`);
      }
    }
  }
  for (const e of all("table")) if (!e.querySelector("th[scope]")) wrong.push(`a table without heads: ${what(e)}`);
  for (const e of all("th")) if (!name(e)) wrong.push("a head without text");
  for (const e of all("[tabindex]")) if (Number(e.tabIndex) > 0) wrong.push(`jumps the order of Tab: ${what(e)}`);
  // Fingers: WCAG 2.2, 2.5.8 asks for 24 px; links in text are free.
  for (const e of all("button, select, input:not([type=hidden]), .button").filter(shown)) {
    const r = e.getBoundingClientRect();
    if (Math.min(r.width, r.height) < 20) wrong.push(`small to hit (${Math.round(r.width)}×${Math.round(r.height)}): ${what(e)}`);
  }
  // Contrast: WCAG 2.2, 1.4.3, over the first solid background behind.
  const rgb = (text) => {
    const parts = text.match(/[\d.]+/g).map(Number);
    const scale = text.startsWith("color(") ? 255 : 1;
    return [...parts.slice(0, 3).map((p) => p * scale), parts[3] ?? 1];
  };
  const light = ([r, g, b]) => {
    const linear = [r, g, b].map((c) => c / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
  };
  const behind = (e) => {
    for (let at = e; at; at = at.parentElement) {
      const color = rgb(getComputedStyle(at).backgroundColor);
      if (color[3] > 0.99) return color;
    }
    return [255, 255, 255, 1];
  };
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const e = texts.currentNode.parentElement;
    const style = getComputedStyle(e);
    if (!texts.currentNode.data.trim() || !shown(e) || e.closest("[disabled], fieldset:disabled, option, svg, noscript, script, .hidden")) continue;
    const [a, b] = [light(rgb(style.color)), light(behind(e))].sort((x, y) => y - x);
    const large = parseFloat(style.fontSize) >= 24 || (parseFloat(style.fontSize) >= 18.66 && Number(style.fontWeight) >= 700);
    const ratio = (a + 0.05) / (b + 0.05);
    if (ratio < (large ? 3 : 4.5)) wrong.push(`contrast ${ratio.toFixed(2)}: ${what(e)}`);
  }
  const over = document.documentElement.scrollWidth - innerWidth;
  if (over > 0) wrong.push(`${over} px wider than the window`);
  return wrong;
})()
