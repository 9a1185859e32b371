// The page: loads the game, runs it turn by turn, keeps the player's folder, and says what went wrong.
import { keepForLater, onProgress, startPython } from "./loading.js";
import { createHost } from "./host.js";
import { codeOf } from "./input.js";
import { Panel } from "./panel.js";
import { PlayerFolder, takeTurn } from "./storage.js";
import { Touch } from "./touch.js";
import { button, lastLine, reloading, showStop, showTrouble } from "./trouble.js";

const PAGE_STATE_MS = 100; // how often the page looks at what the game shows
const PAINTING_MS = 16; // how long a turn may paint what is not seen yet
const KEEP_AFTER_MS = 3000; // when the game runs, what the next visit needs is put aside
const MENU_KEYS = { back: "Escape", choose: "Enter", up: "ArrowUp", down: "ArrowDown", before: "ArrowLeft", next: "ArrowRight" };
const PHONE = "(pointer: coarse) and (max-width: 600px), (pointer: coarse) and (max-height: 500px)";
const canvas = document.getElementById("stage");
const game = document.getElementById("game");

class Page {
  taken; // ends the game when another tab takes it over
  python; // what loading gives: Python, whether it came out of the browser's memory, the program's turns
  fromMemory;
  boot;
  services; // what the page asks of the game
  folder; // the player's
  host;
  touch;
  panel;
  keys = {}; // that touch holds down, by the actions of its buttons
  state; // of the game, as its last look showed it
  looked; // when that was, ms
  paused;
  stopped; // for good: nothing is written any more
  still; // the timer that hides a pointer at rest
  kept; // a promise: the next visit's files are put aside

  async start() {
    this.taken = () => {
      this.stop();
      showStop("The game has been opened in another tab", "It goes on there: only one of them keeps records.", reloading("Play here instead"));
    };
    if (!(await takeTurn(this.taken))) return this.openElsewhere();
    await this.load();
  }

  openElsewhere() {
    const here = button("Play here instead", async () => {
      await takeTurn(this.taken, { byForce: true });
      document.getElementById("trouble").close();
      this.load().catch(failed);
    });
    showStop("The game is open in another tab or window", "Only one of them can keep records. Close it there, or go on here.", here);
  }

  async load() {
    const { python, boot, services, keep, fromMemory } = await startPython();
    Object.assign(this, { python, fromMemory });
    this.boot = boot;
    this.folder = new PlayerFolder(python.FS);
    await this.folder.open();
    game.hidden = false; // before the host asks for the canvas' size, which touch changes
    this.touch = new Touch((action, down) => this.press(action, down));
    this.host = createHost(canvas);
    this.host.attach(python);
    boot.start(this.host);
    this.services = services.PageServices(boot.app(), location.href.split("#")[0], matchMedia(PHONE).matches);
    this.touch.tell = (wanted) => this.services.use_touch(wanted);
    this.touch.tell(document.body.classList.contains("touch"));
    this.panel = new Panel(this);
    this.listen();
    await this.openLink();
    boot.turn(performance.now()); // a picture, even behind a message about the link
    this.host.patience = PAINTING_MS;
    this.look(0);
    this.turn(performance.now());
    document.getElementById("start").remove();
    performance.mark("ninja-game: menu");
    canvas.focus();
    this.kept = new Promise((done) => setTimeout(() => done(Promise.all([keep(), keepForLater()])), KEEP_AFTER_MS));
  }

  // A level or a replay in the address: opened at once. Untrusted text: nothing but Python's own reader sees it.
  async openLink() {
    try {
      const names = this.services.watched(location.hash);
      const texts = await Promise.all([...names].map(textOf));
      const message = this.services.open_link(location.hash, texts);
      if (message) throw new Error(message);
    } catch (error) {
      this.panel.tell("This link cannot be opened", lastLine(error));
    }
  }

  listen() {
    document.addEventListener("visibilitychange", () => this.pause(document.hidden || document.querySelector("dialog[open]") !== null));
    addEventListener("pagehide", () => this.saveAll());
    addEventListener("blur", () => this.touch.release());
    addEventListener("hashchange", () => this.openLink().catch(failed));
    addEventListener("beforeunload", (event) => this.leavingLoses && event.preventDefault());
    new ResizeObserver(() => this.host.resize()).observe(canvas);
    addEventListener("pointermove", () => this.stirred(), { passive: true });
  }

  get leavingLoses() {
    return this.state === "play" || this.folder.writing || (!this.stopped && this.folder.unsaved);
  }

  // The pointer and the page's button show themselves while the mouse moves.
  stirred() {
    document.body.classList.remove("still");
    clearTimeout(this.still);
    this.still = setTimeout(() => document.body.classList.toggle("still", this.state === "play"), 2000);
  }

  pause(wanted) {
    this.paused = wanted;
    this.host.pause(wanted);
    if (!wanted) return this.boot.resume();
    this.touch.release();
    this.saveAll();
  }

  // Also what the game keeps for its next save: a page may be closed without a word.
  saveAll() {
    if (this.stopped) return;
    this.services.flush();
    this.folder.saveChanges(() => {}, { now: true });
  }

  turn(now) {
    if (this.stopped) return;
    requestAnimationFrame((next) => this.turn(next));
    if (this.paused || this.folder.saving || this.host.painter.goOn(PAINTING_MS)) return;
    try {
      const goesOn = this.boot.turn(now);
      if (!goesOn) this.services.flush();
      this.folder.saveChanges((text) => this.services.notify(text));
      if (!goesOn) return this.end();
      if (now - this.looked >= PAGE_STATE_MS) this.look(now);
    } catch (error) {
      failed(error);
    }
  }

  // A touch button is the player's first key of its action; menus have keys of their own.
  press(action, down) {
    if (down) {
      const meant = action === "jump" && this.state !== "play" ? "confirm" : action;
      this.keys[action] = MENU_KEYS[meant] ?? codeOf(this.services.scancodes(meant)[0]);
    }
    if (this.keys[action]) this.host.input.key(this.keys[action], down);
  }

  // What the page itself shows follows what the game shows.
  look(now) {
    this.looked = now;
    const state = this.services.state();
    if (state !== this.state) {
      this.state = document.body.dataset.state = state;
      this.touch.show(state);
      if (state !== "play") document.body.classList.remove("still");
    }
    for (const name of this.folder.newExports()) this.folder.download(name);
  }

  reload() {
    this.stopped = true; // nothing is written any more
    location.reload();
  }

  async end() {
    this.stop();
    await this.folder.saving;
    const lost = this.folder.unsaved && "What you did last could not be saved in this browser.";
    showStop("The game has ended", lost || "You may close this tab.", reloading("Play again"));
  }

  stop() {
    this.stopped = true;
    this.state = "";
    this.host?.pause(true);
  }
}

const MAX_TEXT_BYTES = 4_000_000;

// A replay that lies beside the page.
async function textOf(name) {
  const response = await fetch(name);
  if (!response.ok) throw new Error(`${name}: the host answers ${response.status}`);
  const bytes = await response.arrayBuffer();
  if (bytes.byteLength > MAX_TEXT_BYTES) throw new Error(`${name}: too large for a replay`);
  return new TextDecoder().decode(bytes);
}

const page = new Page();
globalThis.ninjaGame = page; // for those who look into a running game

function failed(error) {
  console.error(error);
  if (page.stopped) return; // the first fault is the one to tell
  page.stop();
  showTrouble(error, "Something went wrong", "Your records are kept. Please report the text below, and load the page again.");
}

addEventListener("error", (event) => event.error && failed(event.error));
addEventListener("unhandledrejection", (event) => failed(event.reason));
onProgress((share, words) => {
  document.getElementById("start-bar").value = share;
  document.getElementById("start-text").textContent = words;
});
page.start().catch(failed);
