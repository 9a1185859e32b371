// The page's own menu: full screen, and what this page is.
import { build } from "./loading.js";
import { button, element } from "./trouble.js";

const dialog = document.getElementById("panel");
const opener = document.getElementById("panel-open");

// Keys that the browser owns (Ctrl+W and its like) reach the game in full screen, where the browser can do that.
export async function fullScreen() {
  if (document.fullscreenElement) return document.exitFullscreen();
  await document.documentElement.requestFullscreen({ navigationUI: "hide" });
  await navigator.keyboard?.lock?.().catch(() => {});
}

export class Panel {
  constructor(page) {
    this.page = page;
    opener.onclick = () => this.open();
    // Keys are the game's, but for those of this menu.
    for (const each of [dialog, opener]) {
      for (const kind of ["keydown", "keyup"]) each.addEventListener(kind, (event) => event.stopPropagation());
    }
    dialog.addEventListener("close", () => {
      page.pause(document.hidden);
      document.getElementById("stage").focus();
    });
  }

  open() {
    this.show(
      element("h2", { textContent: "ninja-game" }),
      element("div", { className: "row" }, this.closing("Full screen", fullScreen)),
      element("p", { className: "small" }, `Version ${build.version}. Nothing is loaded from elsewhere. `, element("a", { href: "licences/NOTICE.txt", target: "_blank", textContent: "Licences" })),
    );
  }

  tell(title, text) {
    this.show(element("h2", { textContent: title }), element("p", { textContent: text }));
  }

  // The dialog with these parts and a button that closes it; the game waits.
  show(...parts) {
    dialog.replaceChildren(...parts, element("div", { className: "row" }, button("Back to the game", () => dialog.close())));
    this.page.pause(true);
    if (!dialog.open) dialog.showModal();
  }

  closing(label, action) {
    return button(label, async () => {
      dialog.close();
      await action().catch((error) => this.tell("That did not work", String(error.message ?? error)));
    });
  }
}
