// Figures of the lab in the text of a page: a still picture until it is touched, then drawn by the game's own code;
// and programs of the text, which a reader can change and run.
// All figures of a page share one Python, which knows nothing of a player: no lock, no records.

import { button, element } from "./trouble.js";

const KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const KEEP_AFTER_MS = 3000; // then what the next visit needs is put aside
const live = [];
let engine = null;

async function start() {
  const [{ keepForLater, onProgress, startPython }, { createHost }] = await Promise.all([import("./loading.js"), import("./host.js")]);
  onProgress((share, words) => {
    for (const each of document.querySelectorAll(".waiting button:first-of-type")) each.textContent = `${words} (${Math.round(share)} %)`;
  });
  const { python, keep } = await startPython();
  const host = createHost(element("canvas"));
  host.memory = python._module; // it paints, and hears nothing: the page's keys are the reader's
  const figures = python.pyimport("ninja_game.web.figures");
  requestAnimationFrame(turn);
  setTimeout(() => Promise.all([keep(), keepForLater()]), KEEP_AFTER_MS);
  return { host, figures, python };
}

class Live {
  state; // of the figure, as its numbers and controls show it

  constructor(place, { host, figures }) {
    this.host = host;
    const image = place.querySelector("img");
    const ratio = Math.min(3, devicePixelRatio || 1);
    const palette = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "classic";
    this.figure = figures.PageFigure(host, place.dataset.figure, Math.round(image.clientWidth * ratio), palette);
    this.area = this.figure.area.toJs();
    this.canvas = element("canvas", { width: this.area[2], height: this.area[3], tabIndex: 0 });
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `${image.alt} Arrow keys move it.`);
    this.numbers = element("dl");
    const { title, controls } = JSON.parse(this.figure.about());
    this.controls = controls.map((about, at) => this.control(about, at));
    this.buttons = element("p", {},
      button("Show me", () => this.figure.reset.callKwargs({ demonstrate: true })),
      button("Reset", () => this.figure.reset.callKwargs({ demonstrate: false })));
    const panel = element("div", { className: "panel" }, ...this.controls.map((each) => each.label), this.buttons, this.numbers);
    panel.setAttribute("role", "group");
    panel.setAttribute("aria-label", title);
    this.listen();
    place.querySelector("picture").replaceWith(this.canvas);
    place.querySelector("button").replaceWith(panel);
    new IntersectionObserver(([entry]) => (this.seen = entry.isIntersecting)).observe(this.canvas);
    this.seen = true;
    this.last = performance.now();
    this.turn(this.last);
  }

  control({ text, span, options }, at) {
    const [min, max, step] = span ?? [];
    const field = span ? element("input", { type: "range", min, max, step }) : element("select", {}, ...options.map((each) => element("option", { textContent: each })));
    field.addEventListener("input", () => this.figure.set(at, span ? field.valueAsNumber : field.selectedIndex));
    const shown = element("output");
    return { field, shown, label: element("label", {}, text, " ", field, " ", shown) };
  }

  listen() {
    const { canvas } = this;
    const touch = (what, event) => this.figure.touch(what, event.offsetX / canvas.clientWidth, event.offsetY / canvas.clientHeight);
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      touch("press", event);
    });
    canvas.addEventListener("pointermove", (event) => event.buttons && touch("drag", event));
    canvas.addEventListener("keydown", (event) => {
      const way = KEYS[event.code];
      if (!way || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      this.figure.touch("nudge", ...way);
    });
  }

  turn(now) {
    const state = this.figure.turn(now - this.last);
    this.last = now;
    const { canvas } = this.host.painter.sheets[this.figure.sheet];
    this.canvas.getContext("2d").drawImage(canvas, ...this.area, 0, 0, this.area[2], this.area[3]);
    if (state === this.state) return;
    this.state = state;
    const { numbers, values } = JSON.parse(state);
    this.numbers.replaceChildren(...numbers.map(([name, value]) => element("div", {}, element("dt", { textContent: name }), element("dd", { textContent: value }))));
    values.forEach(([value, text], at) => {
      const { field, shown } = this.controls[at];
      if (field.options) field.selectedIndex = value;
      else field.value = value;
      shown.textContent = text;
    });
  }
}

function turn(now) {
  requestAnimationFrame(turn);
  for (const each of live) if (each.seen) each.turn(now);
}

// Let a place of the text do something with the engine, once at a time; errors are shown.
async function use(place, act, say) {
  if (place.classList.contains("waiting")) return;
  place.classList.add("waiting");
  try {
    engine ??= start();
    act(await engine);
  } catch (error) {
    engine = null;
    console.error(error);
    say(`It cannot be started: ${String(error.message).trim().split("\n").pop()}`);
  }
  place.classList.remove("waiting");
}

for (const place of document.querySelectorAll("figure.lab")) {
  const button = place.querySelector("button");
  button.hidden = false;
  const wake = (ready) => {
    const made = new Live(place, ready);
    live.push(made);
    made.canvas.focus({ preventScroll: true });
  };
  const touched = () => use(place, wake, (words) => (button.textContent = words));
  place.querySelector("picture").addEventListener("click", touched);
  button.addEventListener("click", touched);
}

for (const place of document.querySelectorAll(".try")) {
  const [run, edit] = place.querySelectorAll("button");
  const shown = place.previousElementSibling;
  const written = shown.textContent.trimEnd();
  const field = element("textarea", { value: written, spellcheck: false, rows: written.split("\n").length + 1, ariaLabel: "Your program" });
  const output = element("output", { className: "output" });
  run.hidden = edit.hidden = false;
  edit.addEventListener("click", () => {
    if (field.isConnected) field.value = written;
    else shown.replaceWith(field);
    edit.textContent = "Reset";
    field.setSelectionRange(0, 0); // the end of it is far to the right
    field.focus();
  });
  const print = ({ python }) => {
    output.textContent = python.pyimport("ninja_game.web.program").run_program(field.value) || "It prints nothing.";
    run.textContent = "Run";
  };
  run.addEventListener("click", () => {
    place.after(output);
    use(place, print, (words) => (output.textContent = words));
  });
}
