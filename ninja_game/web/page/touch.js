// Touch: three zones for left, right and jump, and buttons; shown from the first touch on, while a level is played.

const layer = document.getElementById("touch");

export class Touch {
  // `press(action, down)`: called for every action that a finger begins or ends.
  constructor(press) {
    this.press = press;
    this.fingers = new Map();
    this.shows = "";
    for (const kind of ["pointerdown", "pointermove"]) layer.addEventListener(kind, (event) => this.follow(event));
    for (const kind of ["pointerup", "pointercancel"]) layer.addEventListener(kind, (event) => this.lift(event));
    layer.addEventListener("contextmenu", (event) => event.preventDefault());
    addEventListener("pointerdown", (event) => this.used(event.pointerType), { capture: true });
    addEventListener("keydown", (event) => event.isTrusted && this.used("keyboard"), { capture: true });
    if (matchMedia("(hover: none) and (pointer: coarse)").matches) this.used("touch");
  }

  used(device) {
    if (device === "mouse" || device === "pen") return;
    document.body.classList.toggle("touch", device === "touch");
    this.show(this.shows);
  }

  // What is on the screen, as of PageServices.state: each button says where it is of use.
  show(what) {
    this.shows = what;
    layer.hidden = !document.body.classList.contains("touch");
    for (const each of layer.querySelectorAll("button")) each.hidden = !each.dataset.in.split(" ").includes(what);
  }

  // A finger may slide from one zone into another.
  follow(event) {
    event.preventDefault();
    if (event.type === "pointermove" && !this.fingers.has(event.pointerId)) return;
    if (event.type === "pointerdown") event.target.releasePointerCapture?.(event.pointerId);
    const under = document.elementFromPoint(event.clientX, event.clientY)?.closest("#touch button");
    this.move(event.pointerId, under ?? null);
  }

  lift(event) {
    this.move(event.pointerId, null);
    this.fingers.delete(event.pointerId);
  }

  move(finger, target) {
    const before = this.fingers.get(finger) ?? null;
    this.fingers.set(finger, target);
    if (before === target) return;
    for (const [button, down] of [[before, false], [target, true]]) {
      if (!button || [...this.fingers].some(([other, held]) => other !== finger && held === button)) continue;
      button.classList.toggle("down", down);
      this.press(button.dataset.action, down);
    }
  }

  // Everything is let go: the page is left, or other buttons are shown.
  release() {
    for (const finger of [...this.fingers.keys()]) this.move(finger, null);
    this.fingers.clear();
  }
}
