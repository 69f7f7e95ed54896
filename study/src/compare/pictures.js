"use strict";
(() => {
  const { uris, photos, sides } = JSON.parse(document.getElementById("data").textContent).pictures;
  const place = document.getElementById("pictures"), choose = document.getElementById("photo");
  if (!place || !photos.length) return;
  photos.forEach((p, i) => choose.add(new Option(p.name, i)));
  const figure = (at, words) => {
    const figure = document.createElement("figure"), caption = document.createElement("figcaption");
    if (at === null) caption.textContent = words + ": none";
    else { const image = new Image(); image.src = uris[at]; image.alt = words; figure.append(image); caption.textContent = words; }
    figure.append(caption);
    return figure;
  };
  const row = (all) => { const row = document.createElement("div"); row.className = "pictures"; row.append(...all); return row; };
  const show = () => {
    const p = photos[choose.value];
    const silhouettes = p.masks.map((at, i) => figure(at, `${sides[i]}: silhouette`));
    const apart = p.masks_apart.map((a, i) => figure(a && a.picture, `${sides[i + 1]} against ${sides[0]}` + (a ? `: ${(100 * a.iou).toFixed(3)} % shared` : "")));
    const surfaces = p.surfaces.map((at, i) => figure(at, `${sides[i]}: surface`));
    const colored = p.surfaces_apart.map((at, i) => figure(at, `${sides[i + 1]} against ${sides[0]}: distance`));
    const rows = [[...silhouettes, ...apart], [...surfaces, ...colored]].filter((all) => all.some((f) => f.querySelector("img")));
    place.replaceChildren(...rows.map(row));
  };
  const step = (by) => { choose.value = (Number(choose.value) + by + photos.length) % photos.length; show(); };
  document.getElementById("before").addEventListener("click", () => step(-1));
  document.getElementById("after").addEventListener("click", () => step(1));
  choose.addEventListener("input", show);
  show();
})();
