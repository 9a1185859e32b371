// Touch: three zones for left, right and jump, and buttons; shown from the first touch on, while a level is played.

const layer = document.getElementById("touch");
const KEPT = "ninja-game touch";

// Size (percent) and side of the buttons, as this browser keeps them; `change`: what is to be another one.
export function touchLook(change) {
  const look = { size: 100, jumpsLeft: false };
  try {
    Object.assign(look, JSON.parse(localStorage.getItem(KEPT)), change);
    localStorage.setItem(KEPT, JSON.stringify(look));
  } catch {
    Object.assign(look, change); // nothing is kept here
  }
  document.body.classList.toggle("jumps-left", look.jumpsLeft === true);
  document.documentElement.style.setProperty("--size", Math.min(110, Math.max(60, look.size)) / 100 || 1);
  return look;
}

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
    touchLook();
    if (matchMedia("(hover: none) and (pointer: coarse)").matches) this.used("touch");
  }

  used(device) {
    if (device === "mouse" || device === "pen") return;
    const before = document.body.classList.contains("touch");
    if (document.body.classList.toggle("touch", device === "touch") !== before) this.tell?.(!before);
    this.show(this.shows);
  }

  // What is on the screen, as in PageServices.state: each button says where it is of use. A finger on one that goes lets
  // go; the others stay down, as the move that begins a level.
  show(what) {
    this.shows = what;
    layer.hidden = !document.body.classList.contains("touch");
    for (const each of layer.querySelectorAll("button")) each.hidden = !each.dataset.in.split(" ").includes(what);
    for (const [finger, button] of this.fingers) if (button?.hidden) this.move(finger, null);
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
