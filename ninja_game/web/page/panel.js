// The page's own menu: full screen, the player's data as a file, verdicts on recordings.
import { build } from "./build.js";
import { download } from "./storage.js";
import { touchLook } from "./touch.js";
import { button, element, lastLine } from "./trouble.js";

const dialog = document.getElementById("panel");
const opener = document.getElementById("panel-open");
const drop = document.getElementById("drop");
const today = () => new Date().toISOString().slice(0, 10);

// Keys that the browser owns (Ctrl+W and its like) reach the game in full screen, where the browser can do that.
async function fullScreen() {
  if (document.fullscreenElement) return document.exitFullscreen();
  await document.documentElement.requestFullscreen({ navigationUI: "hide" });
  await navigator.keyboard?.lock?.().catch(() => {});
}

// A button that asks for a file and gives it to `action`.
function fileButton(label, accept, action) {
  const input = element("input", { type: "file", accept, hidden: true, onchange: () => action(input.files[0]) });
  return element("span", {}, button(label, () => input.click()), input);
}

export class Panel {
  results; // what a verification has shown so far

  constructor(page) {
    this.page = page;
    opener.onclick = () => this.open();
    // Keys are the game's, but for those of this menu.
    for (const each of [dialog, opener]) {
      for (const kind of ["keydown", "keyup"]) each.addEventListener(kind, (event) => event.stopPropagation());
    }
    dialog.addEventListener("close", () => {
      this.verifying = false;
      page.pause(document.hidden);
      document.getElementById("stage").focus();
    });
    this.acceptDrops();
  }

  // While recordings are verified, a dropped file is one; else it is the game's.
  acceptDrops() {
    const over = (event, shown) => this.verifying && (event.preventDefault(), (drop.hidden = !shown));
    addEventListener("dragover", (event) => over(event, true), { capture: true });
    addEventListener("dragleave", (event) => event.relatedTarget === null && over(event, false), { capture: true });
    addEventListener("drop", (event) => {
      if (!this.verifying) return;
      over(event, false);
      event.stopImmediatePropagation();
      if (event.dataTransfer.files[0]) this.verify(event.dataTransfer.files[0]);
    }, { capture: true });
  }

  open() {
    this.show(
      element("h2", { textContent: "ninja-game" }),
      element("div", { className: "row" },
        document.fullscreenEnabled ? this.closing(document.fullscreenElement ? "Leave full screen" : "Full screen", fullScreen) : "",
        button("Verify a recording", () => this.showVerify()),
        button("All levels", () => (location.href = "gallery/index.html"))),
      ...this.touchRows(),
      element("h3", { textContent: "Your data" }),
      element("p", { textContent: this.page.folder.lasting
        ? "Settings, records, levels and replays are kept in this browser. It may drop them, so keep a file now and then; ninja-game elsewhere reads it too."
        : "This browser keeps nothing when the page is closed (a private window, or its storage is switched off): save a file before." }),
      element("div", { className: "row" },
        button("Save all to a file", () => this.attempt(() => this.save())),
        fileButton("Take in a file", ".zip", (file) => this.attempt(() => this.takeIn(file)))),
      element("p", { className: "small" }, `Version ${build.version}. Everything runs in this page; nothing is sent anywhere. `,
        element("a", { href: "licences/NOTICE.txt", target: "_blank", textContent: "Licences" })),
    );
  }

  // Where the buttons on the screen lie, and how large they are.
  touchRows() {
    if (!document.body.classList.contains("touch")) return [];
    const { size, jumpsLeft } = touchLook();
    const side = button(`Jump with the ${jumpsLeft ? "right" : "left"} hand`, () => (touchLook({ jumpsLeft: !jumpsLeft }), this.open()));
    const slider = element("input", { type: "range", min: 60, max: 110, step: 10, value: size, oninput: () => touchLook({ size: slider.valueAsNumber }) });
    return [element("h3", { textContent: "Buttons on the screen" }), element("div", { className: "row" }, side, element("label", {}, "Size ", slider))];
  }

  // The dialog with these parts and a button that closes it; the game waits.
  show(...parts) {
    this.verifying = false;
    dialog.replaceChildren(...parts, element("p", { className: "row" }, button("Back to the game", () => dialog.close())));
    this.page.pause(true);
    if (!dialog.open) dialog.showModal();
  }

  tell(title, text) {
    this.show(element("h2", { textContent: title }), element("p", { textContent: text, className: "lines" }));
  }

  async attempt(action) {
    try {
      await action();
    } catch (error) {
      this.tell("That did not work", lastLine(error));
    }
  }

  closing(label, action) {
    return button(label, () => {
      dialog.close();
      this.attempt(action);
    });
  }

  save() {
    navigator.storage?.persist?.(); // asks the browser not to drop the data when it runs out of room
    const data = this.page.services.backup();
    download(`ninja-game-player-${today()}.zip`, data.toJs());
    data.destroy();
  }

  async takeIn(file) {
    const text = this.page.services.take_in(new Uint8Array(await file.arrayBuffer()));
    await this.page.folder.writing;
    await this.page.folder.sync(false);
    this.tell("Taken in", text);
    dialog.addEventListener("close", () => this.page.reload());
  }

  showVerify() {
    this.results = element("div", { id: "verdicts", role: "status" });
    this.show(
      element("h2", { textContent: "Verify a recording" }),
      element("p", { textContent: "Drop a replay, or a file of recordings of N, on this page: every run is played again, and its inputs alone count." }),
      element("div", { className: "row" }, fileButton("Choose a file", "", (file) => this.verify(file))),
      this.results,
    );
    this.verifying = true;
  }

  async verify(file) {
    this.results.replaceChildren(element("p", { textContent: `Verifying ${file.name}` }));
    await this.attempt(async () => {
      const verdicts = this.page.services.verdicts(file.name, new Uint8Array(await file.arrayBuffer()));
      const results = this.results;
      results.replaceChildren();
      for (const text of verdicts) {
        if (text) results.append(...verdictParts(JSON.parse(text), text));
        await new Promise((done) => setTimeout(done));
        if (this.results !== results || !dialog.open) break;
      }
      verdicts.destroy();
    });
  }
}

// A verdict: the result of the run, each claim that does not hold (the first difference first), and the JSON of `verify`.
function verdictParts(verdict, text) {
  if (verdict.unreadable) return [element("p", { className: "bad", textContent: verdict.unreadable })];
  const good = !verdict.problems;
  const rows = [
    ["outcome", verdict.outcome], ["ticks", verdict.ticks], ["gold", verdict.gold],
    ["score", verdict.score_ticks === null ? "none" : `${(verdict.score_ticks / 40).toFixed(3)} s`],
    ["level", verdict.level_name || "none of the game's own"], ["author", verdict.author],
    ...(verdict.problems ?? []).map((problem, k) => [k ? "also" : "first difference", problem]),
  ];
  const table = element("table", {});
  for (const [name, value] of rows) {
    const row = table.insertRow();
    row.append(element("th", { scope: "row", textContent: name }), element("td", { textContent: value }));
  }
  const json = element("details", {}, element("summary", { textContent: "As verify --json gives it" }), element("pre", { textContent: text }));
  return [element("h3", { textContent: verdict.name || `Recording ${verdict.record}` }),
    element("p", { className: good ? "good" : "bad", textContent: good ? "The run does what its file says." : "The run does not do what its file says." }), table, json];
}
