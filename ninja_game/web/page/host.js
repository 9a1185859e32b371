// What the page does for shim/pygame: painting, sound, events, clipboard, full screen.
import { Input } from "./input.js";
import { Painter } from "./painter.js";
import { Sounds } from "./sound.js";

class Host {
  memory; // Pyodide's
  files;
  width; // of the canvas, px of the screen, of which ratio make one of the page
  height;
  ratio;

  constructor(canvas) {
    this.canvas = canvas;
    this.painter = new Painter(canvas);
    this.sounds = new Sounds();
    this.input = new Input(canvas, () => this.ratio, () => this.sounds.unlock());
    this.rate = 60;
    this.patience = Infinity; // ms after which a picture is painted on in the next turn
    this.resize();
  }

  // To be called once Pyodide is loaded.
  attach(pyodide) {
    this.memory = pyodide._module;
    this.files = pyodide.FS;
    this.input.dropped = (name, bytes) => {
      const path = `/tmp/${name.replaceAll("/", "_")}`;
      this.files.writeFile(path, bytes);
      return path;
    };
    this.input.listen();
  }

  // Read the canvas' size on the page.
  resize() {
    const box = this.canvas.getBoundingClientRect();
    const size = [this.width, this.height];
    this.ratio = window.devicePixelRatio || 1;
    this.width = Math.max(1, Math.round(box.width * this.ratio));
    this.height = Math.max(1, Math.round(box.height * this.ratio));
    if (size[0] !== undefined && (size[0] !== this.width || size[1] !== this.height)) {
      this.input.post("WINDOWSIZECHANGED", { x: this.width, y: this.height });
    }
  }

  // Silence, and the focus lost; or both back.
  pause(wanted) {
    this.sounds.mute(wanted);
    this.input.focus(!wanted);
  }

  // --- called by shim/pygame, as are the painter, the sounds and the input ---

  paint(address, count) {
    this.painter.paint(new Float64Array(this.memory.HEAPF64.buffer, address, count), this.patience);
  }

  ticks() {
    return performance.now();
  }

  measure(text, size) {
    const context = new OffscreenCanvas(1, 1).getContext("2d");
    context.font = `${0.62 * size}px sans-serif`;
    return Math.ceil(context.measureText(text).width);
  }

  // A canvas of the painter, as a PNG in base 64.
  picture(number, width, height) {
    const sheet = Object.assign(document.createElement("canvas"), { width, height });
    sheet.getContext("2d").drawImage(this.painter.sheets[number].canvas, 0, 0);
    return sheet.toDataURL("image/png").split(",")[1];
  }

  fullscreen(wanted) {
    const done = wanted ? document.documentElement.requestFullscreen() : document.fullscreenElement && document.exitFullscreen();
    if (done) done.catch(() => {});
  }

  // Whether there is a clipboard.
  copy(text) {
    if (!navigator.clipboard) return false;
    navigator.clipboard.writeText(text).catch(() => {});
    return true;
  }

  sound(path) {
    const music = path.split("/sounds/music/")[1];
    return music ? this.sounds.fetch(`music/${music}`) : this.sounds.add(this.files.readFile(path));
  }
}

export function createHost(canvas) {
  return new Host(canvas);
}
