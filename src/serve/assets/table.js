// Fills the table of captures while some of them are measured.
const EVERY_MS = 2000;
const captures = document.getElementById("captures");

/** Times in the reader's own zone. */
function zoned() {
  for (const time of document.querySelectorAll("time")) {
    const at = new Date(time.dateTime);
    time.textContent = at.toLocaleString(document.documentElement.lang, { dateStyle: "medium", timeStyle: "short" });
  }
}

async function fill() {
  const answer = await fetch("/rows").catch(() => null);
  const html = answer?.ok ? await answer.text() : null;
  // Whoever is on a link of the table keeps it.
  if (html && !captures.contains(document.activeElement)) captures.innerHTML = html;
  zoned();
  follow();
}

function follow() {
  if (captures?.querySelector("[data-goes-on]")) setTimeout(fill, EVERY_MS);
}

zoned();
follow();
