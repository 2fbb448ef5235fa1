// Two pictures: wipe, blink, side by side, difference, with one zoom for both.

const viewer = byId("viewer");
const [imageA, imageB, imageC] = ["image-a", "image-b", "image-c"].map(byId);
const MODES = ["wipe", "blink", "beside", "difference"];
// Where the picture's corner is in its pane, CSS pixels; how large a pixel is; where the line is, 0 to 1 of the pane.
const view = { x: 0, y: 0, scale: 1, fitted: true, mode: "wipe", line: 0.5, blinkB: false, held: false };
const MOST_SCALE = 64;

const paneSize = () => [byId("pane-a").clientWidth, byId("pane-a").clientHeight];
const pictureSize = () => [Math.max(imageA.naturalWidth, imageB.naturalWidth, 1), Math.max(imageA.naturalHeight, imageB.naturalHeight, 1)];

function fit() {
  const [[width, height], [w, h]] = [paneSize(), pictureSize()];
  view.scale = Math.min(width / w, height / h);
  view.x = (width - w * view.scale) / 2;
  view.y = (height - h * view.scale) / 2;
  view.fitted = true;
  draw();
}

// Makes a pixel so large; what is at a place of the pane stays there.
function zoomTo(scale, x = paneSize()[0] / 2, y = paneSize()[1] / 2) {
  const now = Math.min(Math.max(scale, 0.05), MOST_SCALE);
  view.x = x - ((x - view.x) * now) / view.scale;
  view.y = y - ((y - view.y) * now) / view.scale;
  view.scale = now;
  view.fitted = false;
  draw();
}

function draw() {
  const placed = `translate(${view.x}px, ${view.y}px) scale(${view.scale})`;
  for (const stage of viewer.querySelectorAll(".stage")) stage.style.transform = placed;
  viewer.classList.toggle("pixels", view.scale * devicePixelRatio > 1.5);
  const [w, h] = pictureSize();
  const over = byId("over");
  const begin = Math.min(Math.max((view.line * paneSize()[0] - view.x) / view.scale, 0), w);
  const from = view.mode === "wipe" ? begin : view.mode === "blink" && view.blinkB ? 0 : w;
  Object.assign(over.style, { left: `${from}px`, width: `${w - from}px`, height: `${h}px` });
  imageB.style.left = `${-from}px`;
  byId("line").hidden = view.mode !== "wipe";
  byId("line").style.left = `${view.line * 100}%`;
  byId("pane-b").hidden = view.mode !== "beside";
  byId("difference").hidden = view.mode !== "difference";
  byId("rate-label").hidden = view.mode !== "blink";
  byId("gain-label").hidden = view.mode !== "difference";
  tag();
}

function tag() {
  const [a, b] = [chosen.a, chosen.b].map((place) => data.members[place].name);
  const one = { wipe: `A  ${a}`, beside: `A  ${a}`, blink: view.blinkB ? `B  ${b}` : `A  ${a}`, difference: `|${a} − ${b}| × ${gain()}` };
  byId("tag-a").textContent = one[view.mode];
  // With the wipe, B is named at the right of the one pane.
  byId(view.mode === "beside" ? "pane-b" : "pane-a").append(byId("tag-b"));
  byId("tag-b").textContent = `B  ${b}`;
  byId("tag-b").hidden = view.mode === "blink" || view.mode === "difference";
}

function setMode(mode) {
  view.mode = mode;
  for (const button of byId("modes").children) {
    button.setAttribute("aria-checked", button.dataset.mode === mode);
  }
  draw();
  if (view.fitted) fit();
  if (mode === "difference") drawDifference();
}

// Pixels of an image: sRGB, 4 bytes each.
function pixelsOf(image) {
  const canvas = made("canvas", { width: image.naturalWidth, height: image.naturalHeight });
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, canvas.width, canvas.height);
}

const gain = () => 2 ** Number(byId("gain").value);

// |A − B| of the pictures as shown. Where they are of other sizes: of what both have.
function drawDifference() {
  if (!imageA.naturalWidth || !imageB.naturalWidth) return;
  const [a, b] = [read.a, read.b];
  const canvas = byId("difference");
  [canvas.width, canvas.height] = pictureSize();
  const context = canvas.getContext("2d");
  const out = context.createImageData(canvas.width, canvas.height);
  for (let y = 0; y < canvas.height; y++) {
    for (let x = 0; x < canvas.width; x++) {
      const to = 4 * (y * canvas.width + x);
      const both = x < a.width && x < b.width && y < a.height && y < b.height;
      for (let i = 0; i < 3; i++) {
        out.data[to + i] = both ? Math.abs(a.data[4 * (y * a.width + x) + i] - b.data[4 * (y * b.width + x) + i]) * gain() : 58;
      }
      out.data[to + 3] = 255;
    }
  }
  context.putImageData(out, 0, 0);
}

// The pixels of both, once they are there.
const read = { a: null, b: null };

async function load() {
  const [a, b] = [chosen.a, chosen.b];
  if (a < 0) return;
  const before = pictureSize().join();
  imageA.src = data.members[a].picture;
  imageB.src = imageC.src = data.members[b].picture;
  byId("choice-a").value = a;
  byId("choice-b").value = b;
  try {
    await Promise.all([imageA.decode(), imageB.decode(), imageC.decode()]);
  } catch {
    byId("reading").textContent = "A picture can't be shown: this file is damaged.";
    return;
  }
  // Another choice was made meanwhile.
  if (a !== chosen.a || b !== chosen.b) return;
  [read.a, read.b] = [pixelsOf(imageA), pixelsOf(imageB)];
  if (view.fitted || before !== pictureSize().join()) fit();
  else draw();
  if (view.mode === "difference") drawDifference();
}
listeners.push(load);

// Where a pointer is, in its pane.
function within(event) {
  const pane = event.target.closest(".pane") ?? byId("pane-a");
  const box = pane.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

viewer.addEventListener("wheel", (event) => {
  event.preventDefault();
  const lines = event.deltaY / (event.deltaMode === 0 ? 100 : 3);
  zoomTo(view.scale * 1.25 ** -lines, ...within(event));
}, { passive: false });

let drag = null;
viewer.addEventListener("pointerdown", (event) => {
  if (event.button !== 0) return;
  drag = { line: event.target === byId("line"), x: event.clientX, y: event.clientY };
  viewer.setPointerCapture(event.pointerId);
});
viewer.addEventListener("pointermove", (event) => {
  if (!drag) return say(event);
  if (drag.line) {
    const box = byId("pane-a").getBoundingClientRect();
    view.line = Math.min(Math.max((event.clientX - box.left) / box.width, 0), 1);
  } else {
    view.x += event.clientX - drag.x;
    view.y += event.clientY - drag.y;
    view.fitted = false;
  }
  [drag.x, drag.y] = [event.clientX, event.clientY];
  draw();
});
for (const end of ["pointerup", "pointercancel"]) viewer.addEventListener(end, () => (drag = null));
viewer.addEventListener("dblclick", fit);

// Says what both pictures are at the pointer.
function say(event) {
  if (!read.a) return;
  const [px, py] = within(event);
  const [x, y] = [Math.floor((px - view.x) / view.scale), Math.floor((py - view.y) / view.scale)];
  const at = (picture) => {
    if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return "-";
    const start = 4 * (y * picture.width + x);
    return [...picture.data.subarray(start, start + 3)].join(" ");
  };
  const zoom = view.scale < 1 ? view.scale.toFixed(2) : view.scale.toFixed(1);
  byId("reading").textContent = `pixel ${x}, ${y}   A ${at(read.a)}   B ${at(read.b)}   (sRGB)   × ${zoom}`;
}

let blinked = 0;
function blink(now) {
  if (view.mode === "blink" && !view.held && now - blinked > 1000 / Number(byId("rate").value)) {
    blinked = now;
    view.blinkB = !view.blinkB;
    draw();
  }
  requestAnimationFrame(blink);
}

for (const side of ["a", "b"]) {
  const choice = byId(`choice-${side}`);
  for (const place of shown) choice.append(made("option", { value: place, textContent: data.members[place].name }));
  choice.addEventListener("change", () => choose(side, Number(choice.value)));
}
const swap = () => {
  [chosen.a, chosen.b] = [chosen.b, chosen.a];
  listeners.forEach((tell) => tell());
};
byId("swap").addEventListener("click", swap);
for (const button of byId("modes").children) button.addEventListener("click", () => setMode(button.dataset.mode));
byId("fit").addEventListener("click", fit);
byId("actual").addEventListener("click", () => zoomTo(1 / devicePixelRatio));
byId("closer").addEventListener("click", () => zoomTo(view.scale * 2));
byId("farther").addEventListener("click", () => zoomTo(view.scale / 2));
byId("rate").addEventListener("input", () => (byId("rate-said").value = byId("rate").value));
byId("gain").addEventListener("input", () => {
  byId("gain-said").value = gain();
  drawDifference();
  tag();
});

// Moves the line, or the picture where there is none.
function step(x, y) {
  if (view.mode === "wipe" && y === 0) view.line = Math.min(Math.max(view.line - x / paneSize()[0], 0), 1);
  else [view.x, view.y, view.fitted] = [view.x + x, view.y + y, false];
  draw();
}
const KEYS = {
  0: fit, x: swap,
  "+": () => zoomTo(view.scale * 1.25), "=": () => zoomTo(view.scale * 1.25), "-": () => zoomTo(view.scale / 1.25),
  ArrowLeft: () => step(20, 0), ArrowRight: () => step(-20, 0), ArrowUp: () => step(0, 20), ArrowDown: () => step(0, -20),
  // Holds what blinks, and turns it by hand.
  " ": () => { view.held = true; view.blinkB = !view.blinkB; draw(); },
};
MODES.forEach((mode, i) => (KEYS[i + 1] = () => { view.held = false; setMode(mode); }));
viewer.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || !KEYS[event.key]) return;
  event.preventDefault();
  KEYS[event.key]();
});
addEventListener("resize", () => (view.fitted ? fit() : draw()));
if (shown.length > 0) {
  setMode("wipe");
  load();
  requestAnimationFrame(blink);
}
