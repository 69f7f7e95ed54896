// Sends dropped or chosen files: a capture each folder, one otherwise; then looks at it.
const form = document.getElementById("drop");
const bar = document.getElementById("drop-bar");
const said = document.getElementById("drop-word");
const AT_ONCE = 3;
const texts = form.dataset;
const fill = (text, put) => text.replace(/\{(\w+)\}/g, (all, key) => put[key] ?? all);
const order = new Intl.Collator(undefined, { numeric: true });
const isVideo = (file) => file.type.startsWith("video/") || /\.(mp4|mov|m4v|mkv|webm|avi)$/i.test(file.name);
const isPhoto = (file) => file.type.startsWith("image/") || /\.(jpe?g|png|tiff?|hei[cf]|hif|dng)$/i.test(file.name);

/** What is wrong with a file before it is sent, or nothing. */
function wrong(file) {
  const [most, text] = isVideo(file) ? [texts.mostVideo, texts.largeVideo] : [texts.mostPhoto, texts.largePhoto];
  return file.size > Number(most) ? fill(text, { name: file.name }) : "";
}

async function call(method, path, body, type) {
  const headers = type ? { "content-type": type } : {};
  const answer = await fetch(path, { method, body, headers });
  const told = answer.status === 204 ? {} : await answer.json();
  if (!answer.ok) throw new Error(told.error);
  return told;
}

/** Sends the files of one capture, some at a time, each once more if the line broke; its address. */
async function send(name, files, tick) {
  const { id } = await call("POST", "/api/captures", JSON.stringify({ name }), "application/json");
  const open = files.map((file, at) => [file, at + 1]);
  const one = async () => {
    for (let next = open.shift(); next; next = open.shift()) {
      const [file, number] = next;
      const path = `/api/captures/${id}/files/${number}?name=${encodeURIComponent(file.name)}`;
      try {
        await call("PUT", path, file);
      } catch (why) {
        if (!(why instanceof TypeError)) throw new Error(`${file.name}: ${why.message}`);
        await call("PUT", path, file);
      }
      tick();
    }
  };
  await Promise.all(Array.from({ length: AT_ONCE }, one));
  return id;
}

/** Files by the folder that holds them; `images` belongs to the folder above. */
function folders(files) {
  const all = new Map();
  for (const [path, file] of files) {
    const parts = path.split("/").slice(0, -1).filter((part, at, list) => !(part === "images" && at === list.length - 1));
    const folder = parts.join("/");
    all.set(folder, [...(all.get(folder) ?? []), file]);
  }
  return [...all].sort(([a], [b]) => order.compare(a, b));
}

async function take(files) {
  const wanted = files.filter(([path, file]) => (isPhoto(file) || isVideo(file)) && !/(^|\/)(\.|masks\/|truth\/)/.test(path));
  const large = wanted.map(([, file]) => wrong(file)).find((text) => text);
  const captures = folders(wanted);
  const many = captures.some(([, list]) => list.length > Number(texts.mostFiles));
  const refusal = wanted.length === 0 ? texts.none : large || (many && texts.many);
  if (refusal) return void (said.textContent = refusal);
  let done = 0;
  const tick = () => {
    done += 1;
    bar.value = done / wanted.length;
    said.textContent = fill(texts.sending, { done, of: wanted.length });
  };
  bar.hidden = false;
  bar.value = 0;
  form.setAttribute("aria-busy", "true");
  try {
    const ids = [];
    for (const [folder, list] of captures) {
      list.sort((a, b) => order.compare(a.name, b.name));
      const name = captures.length === 1 ? form.elements.name.value || folder : folder;
      ids.push(await send(name, list, tick));
    }
    said.textContent = texts.looking;
    location.assign(ids.length === 1 ? `/captures/${ids[0]}` : "/");
  } catch (why) {
    said.textContent = why instanceof TypeError ? texts.lost : why.message;
  } finally {
    bar.hidden = true;
    form.removeAttribute("aria-busy");
  }
}

/** Files of what was dropped, folders entered. */
async function dropped(items) {
  const found = [];
  const enter = async (entry, path) => {
    if (entry.isFile) return void found.push([path + entry.name, await new Promise((ok, no) => entry.file(ok, no))]);
    const reader = entry.createReader();
    for (;;) {
      const some = await new Promise((ok, no) => reader.readEntries(ok, no));
      if (some.length === 0) return;
      for (const inner of some) await enter(inner, `${path}${entry.name}/`);
    }
  };
  const entries = [...items].map((item) => item.webkitGetAsEntry()).filter((entry) => entry);
  for (const entry of entries) await enter(entry, "");
  return found;
}

const chosen = (input) => [...input.files].map((file) => [file.webkitRelativePath || file.name, file]);
for (const name of ["files", "folder"]) {
  form.elements[name].addEventListener("change", (event) => take(chosen(event.target)));
}
form.addEventListener("submit", (event) => event.preventDefault());
for (const kind of ["dragenter", "dragover"]) {
  addEventListener(kind, (event) => { event.preventDefault(); form.classList.add("over"); });
}
for (const kind of ["dragleave", "drop"]) addEventListener(kind, () => form.classList.remove("over"));
addEventListener("drop", async (event) => { event.preventDefault(); take(await dropped(event.dataTransfer.items)); });
