// Looks at photos that nobody has looked at, and shows how far a measuring is.
const AGAIN_MS = 2000;
const seen = document.getElementById("seen");
const measuring = document.getElementById("measuring");

/** Puts HTML of the server's where it belongs, if it changed: a picture that is there is not loaded again. */
function put(id, html) {
  const place = document.getElementById(id);
  if (place.dataset.html !== html) place.innerHTML = place.dataset.html = html;
}

if (seen?.dataset.look) {
  seen.setAttribute("aria-busy", "true");
  fetch(`/api${seen.dataset.look}`, { method: "POST" }).then((answer) => answer.ok && location.reload());
}

if (measuring?.dataset.events) {
  // The browser connects again by itself, also after the lid was closed.
  const source = new EventSource(measuring.dataset.events);
  source.addEventListener("progress", (event) => {
    const now = JSON.parse(event.data);
    const sentence = document.getElementById("sentence");
    if (sentence.textContent !== now.sentence) sentence.textContent = now.sentence;
    put("steps", now.steps);
    put("pictures", now.pictures);
    if (!["waiting", "running"].includes(now.state)) {
      source.close();
      location.reload();
    }
  });
  // The program was ended, or does not know of this measuring any more: the page says so.
  source.addEventListener("error", () => source.readyState === EventSource.CLOSED && setTimeout(() => location.reload(), AGAIN_MS));
}

for (const time of document.querySelectorAll("time")) {
  const at = new Date(time.dateTime);
  time.textContent = at.toLocaleString(document.documentElement.lang, { dateStyle: "medium", timeStyle: "short" });
}
