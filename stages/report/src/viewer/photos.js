// The photos: a click enlarges one and turns the 3D view to where its camera stood.
const figures = [...document.querySelectorAll("figure[data-photo]")];
const big = element("big");
let open = 0;
const enlarge = (i) => {
  open = (i + figures.length) % figures.length;
  const figure = figures[open], picture = figure.querySelector("svg").cloneNode(true);
  const box = picture.viewBox.baseVal;
  for (const button of ["role", "tabindex", "aria-label"]) picture.removeAttribute(button);
  picture.setAttribute("width", 4 * box.width); picture.setAttribute("height", 4 * box.height);
  element("bigger").replaceChildren(picture);
  element("which").textContent = figure.querySelector("figcaption").textContent;
  from(Number(figure.dataset.photo));
  if (!big.open) big.showModal();
};
figures.forEach((figure, i) => {
  figure.addEventListener("click", () => enlarge(i));
  figure.addEventListener("keydown", (e) => { if (e.key === "Enter" || e.key === " ") { e.preventDefault(); enlarge(i); } });
});
element("before").addEventListener("click", () => enlarge(open - 1));
element("after").addEventListener("click", () => enlarge(open + 1));
element("close").addEventListener("click", () => big.close());
big.addEventListener("click", (e) => { if (e.target === big) big.close(); });
big.addEventListener("keydown", (e) => { const by = { ArrowLeft: -1, ArrowRight: 1 }[e.key]; if (by) enlarge(open + by); });
// A scan has no photos, and no boxes for them.
for (const [box, kind] of [["outlines", "no-outlines"], ["sections", "no-sections"]]) {
  element(box)?.addEventListener("change", () => document.body.classList.toggle(kind, !element(box).checked));
}
addEventListener("resize", changed);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", changed);
home();
