// Paints corrections over an outline: body, room, or as it was found.
const place = document.getElementById("brush");
if (place) {
  const [said, canvas] = [place.querySelector("[role=status]"), place.querySelector("canvas")];
  const field = (name) => place.querySelector(`[name=${name}]`);
  const screen = canvas.getContext("2d");
  const INK = { body: "#fff", room: "#000" };
  const MOST_UNDONE = 20;
  let photo, mask, painted, strokes, undone, at, last;

  const layer = () => Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
  const load = async (url) => {
    const picture = new Image();
    picture.src = url;
    await picture.decode();
    return picture;
  };

  /** Shows a photo with its outline, nothing painted. */
  async function open(number) {
    photo = await load(`${place.dataset.api}/files/${number}/small/1280`);
    mask = await load(`${place.dataset.api}/masks/${number}?at=${Date.now()}`);
    [canvas.width, canvas.height] = [photo.naturalWidth, photo.naturalHeight];
    painted = layer();
    [strokes, undone, last] = [0, [], null];
    at = [canvas.width / 2, canvas.height / 2];
    said.textContent = "";
    draw();
  }

  /** The photo, dark where the room is, with a ring where the brush is. */
  function draw() {
    const now = layer().getContext("2d", { willReadFrequently: true });
    now.drawImage(mask, 0, 0, canvas.width, canvas.height);
    now.drawImage(painted, 0, 0);
    const room = now.getImageData(0, 0, canvas.width, canvas.height);
    for (let i = 0; i < room.data.length; i += 4) {
      const body = room.data[i] > 127;
      room.data[i] = room.data[i + 1] = room.data[i + 2] = 0;
      room.data[i + 3] = body ? 0 : 170;
    }
    now.putImageData(room, 0, 0);
    screen.drawImage(photo, 0, 0);
    screen.drawImage(now.canvas, 0, 0);
    for (const [width, color] of [[4, "#000"], [2, "#fff"]]) {
      screen.beginPath();
      screen.arc(at[0], at[1], Number(field("size").value), 0, 2 * Math.PI);
      [screen.lineWidth, screen.strokeStyle] = [width, color];
      screen.stroke();
    }
    canvas.dataset.strokes = strokes;
  }

  /** Remembers what was painted before a stroke. */
  function begin() {
    undone = [...undone, painted.getContext("2d").getImageData(0, 0, canvas.width, canvas.height)].slice(-MOST_UNDONE);
    strokes += 1;
    last = at;
  }

  /** Paints from where the brush was to where it is. */
  function stroke() {
    const paint = place.querySelector("[name=paint]:checked").value;
    const to = painted.getContext("2d");
    to.globalCompositeOperation = paint === "clear" ? "destination-out" : "source-over";
    to.strokeStyle = INK[paint] ?? "#000";
    [to.lineWidth, to.lineCap] = [2 * Number(field("size").value), "round"];
    to.beginPath();
    to.moveTo(...last);
    to.lineTo(at[0], at[1] + 0.01);
    to.stroke();
    last = at;
    draw();
  }

  const point = (event) => {
    const frame = canvas.getBoundingClientRect();
    return [((event.clientX - frame.x) / frame.width) * canvas.width, ((event.clientY - frame.y) / frame.height) * canvas.height];
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    at = point(event);
    begin();
    stroke();
  });
  canvas.addEventListener("pointermove", (event) => {
    at = point(event);
    if (event.buttons) stroke();
    else draw();
  });
  canvas.addEventListener("pointerup", () => (last = null));
  const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  canvas.addEventListener("keydown", (event) => {
    const step = STEPS[event.key];
    const size = field("size");
    if (step) at = at.map((v, i) => v + step[i] * Number(size.value));
    else if (event.key === "+") size.value = Number(size.value) + 2;
    else if (event.key === "-") size.value = Number(size.value) - 2;
    else if (event.key !== " ") return;
    event.preventDefault();
    if (event.key === " ") {
      begin();
      stroke();
    } else draw();
  });
  field("size").addEventListener("input", draw);
  field("undo").addEventListener("click", () => {
    const before = undone.pop();
    if (!before) return;
    strokes -= 1;
    painted.getContext("2d").putImageData(before, 0, 0);
    draw();
  });
  field("save").addEventListener("click", async () => {
    if (strokes === 0) return void (said.textContent = place.dataset.none);
    const number = field("photo").value;
    const body = await new Promise((ok) => painted.toBlob(ok, "image/png"));
    const answer = await fetch(`${place.dataset.api}/masks/${number}`, { method: "PUT", body }).catch(() => null);
    const why = answer?.ok ? "" : ((await answer?.json())?.error ?? "…");
    if (!why) await open(number);
    said.textContent = why ? place.dataset.lost.replace("{why}", why) : place.dataset.saved;
  });
  field("photo").addEventListener("change", (event) => open(event.target.value));
  open(field("photo").value);
}
