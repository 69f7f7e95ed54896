// Paints corrections over an outline: body, room, or as it was found.
const place = document.getElementById("brush");
if (place) {
  const [said, canvas] = [place.querySelector("[role=status]"), place.querySelector("canvas")];
  const field = (name) => place.querySelector(`[name=${name}]`);
  const screen = canvas.getContext("2d");
  const INK = { body: "#fff", room: "#000" };
  /** Strokes by photo that are not kept yet: paint, radius, points. They stay when another photo is chosen. */
  const unkept = new Map();
  let number, photo, mask, painted, at, stroking;

  const layer = () => Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
  const load = async (url) => {
    const picture = new Image();
    picture.src = url;
    await picture.decode();
    return picture;
  };

  const strokes = (of = number) => unkept.get(of) ?? [];

  /** Says which photos have strokes that are not kept, after what was said before. */
  function tell(text) {
    const name = (of) => field("photo").querySelector(`option[value="${of}"]`).textContent;
    const open = [...unkept.keys()].filter((of) => of !== number && strokes(of).length > 0).map(name);
    const left = open.length > 0 ? place.dataset.unkept.replace("{photos}", open.join(", ")) : "";
    said.textContent = [text, left].filter((part) => part).join(" ");
  }

  /** Shows a photo with its outline and the strokes that are not kept yet. */
  async function open(wanted, text = "") {
    const loaded = await Promise.all([
      load(`${place.dataset.api}/files/${wanted}/small/1280`),
      load(`${place.dataset.api}/masks/${wanted}?at=${Date.now()}`),
    ]);
    // Another photo was chosen meanwhile.
    if (field("photo").value !== wanted) return;
    [number, [photo, mask]] = [wanted, loaded];
    [canvas.width, canvas.height] = [photo.naturalWidth, photo.naturalHeight];
    at = [canvas.width / 2, canvas.height / 2];
    stroking = null;
    repaint();
    tell(text);
  }

  /** Paints all strokes of the photo. */
  function repaint() {
    painted = layer();
    for (const one of strokes()) {
      const [first, ...rest] = one.points;
      if (rest.length === 0) line(one, first, first);
      rest.reduce((from, to) => (line(one, from, to), to), first);
    }
    draw();
  }

  /** A piece of a stroke. */
  function line(one, from, upto) {
    const to = painted.getContext("2d");
    to.globalCompositeOperation = one.paint === "clear" ? "destination-out" : "source-over";
    to.strokeStyle = INK[one.paint] ?? "#000";
    [to.lineWidth, to.lineCap] = [2 * one.size, "round"];
    to.beginPath();
    to.moveTo(...from);
    to.lineTo(upto[0], upto[1] + 0.01);
    to.stroke();
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
    [canvas.dataset.strokes, canvas.dataset.photo] = [strokes().length, number];
  }

  /** Begins a stroke where the brush is. */
  function begin() {
    stroking = { paint: place.querySelector("[name=paint]:checked").value, size: Number(field("size").value), points: [at] };
    unkept.set(number, [...strokes(), stroking]);
    line(stroking, at, at);
    draw();
  }

  /** Paints from where the brush was to where it is. */
  function stroke() {
    if (!stroking) return draw();
    line(stroking, stroking.points.at(-1), at);
    stroking.points.push(at);
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
  });
  canvas.addEventListener("pointermove", (event) => {
    at = point(event);
    if (event.buttons) stroke();
    else draw();
  });
  canvas.addEventListener("pointerup", () => (stroking = null));
  const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  canvas.addEventListener("keydown", (event) => {
    const step = STEPS[event.key];
    const size = field("size");
    if (step) at = at.map((v, i) => v + step[i] * Number(size.value));
    else if (event.key === "+") size.value = Number(size.value) + 2;
    else if (event.key === "-") size.value = Number(size.value) - 2;
    else if (event.key !== " ") return;
    event.preventDefault();
    if (event.key !== " ") return draw();
    begin();
    stroking = null;
  });
  field("size").addEventListener("input", draw);
  field("undo").addEventListener("click", () => {
    if (strokes().length === 0) return;
    unkept.set(number, strokes().slice(0, -1));
    repaint();
  });
  field("save").addEventListener("click", async () => {
    const [of, kept] = [number, strokes()];
    if (kept.length === 0) return tell(place.dataset.none);
    const body = await new Promise((ok) => painted.toBlob(ok, "image/png"));
    const answer = await fetch(`${place.dataset.api}/masks/${of}`, { method: "PUT", body }).catch(() => null);
    const why = answer?.ok ? "" : ((await answer?.json())?.error ?? "…");
    if (why) return tell(place.dataset.lost.replace("{why}", why));
    // What was painted meanwhile is not kept.
    unkept.set(of, strokes(of).filter((one) => !kept.includes(one)));
    if (field("photo").value === of) await open(of, place.dataset.saved);
    else tell(place.dataset.saved);
  });
  field("photo").addEventListener("change", (event) => open(event.target.value));
  // The browser asks before strokes are lost with the page.
  addEventListener("beforeunload", (event) => {
    if ([...unkept.values()].some((some) => some.length > 0)) event.preventDefault();
  });
  open(field("photo").value);
}
