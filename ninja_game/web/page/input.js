// Keyboard, mouse, gamepads and dropped files as the events of shim/pygame/event.py: [name, fields].

// Scancodes of SDL (USB usage numbers) by KeyboardEvent.code.
const SCANCODES = {
  Enter: 40, Escape: 41, Backspace: 42, Tab: 43, Space: 44, Minus: 45, Equal: 46, BracketLeft: 47, BracketRight: 48,
  Backslash: 49, Semicolon: 51, Quote: 52, Backquote: 53, Comma: 54, Period: 55, Slash: 56, CapsLock: 57,
  PrintScreen: 70, ScrollLock: 71, Pause: 72, Insert: 73, Home: 74, PageUp: 75, Delete: 76, End: 77, PageDown: 78,
  ArrowRight: 79, ArrowLeft: 80, ArrowDown: 81, ArrowUp: 82, NumLock: 83, NumpadDivide: 84, NumpadMultiply: 85,
  NumpadSubtract: 86, NumpadAdd: 87, NumpadEnter: 88, NumpadDecimal: 99, IntlBackslash: 100, NumpadEqual: 103,
  ContextMenu: 118, ControlLeft: 224, ShiftLeft: 225, AltLeft: 226, MetaLeft: 227, ControlRight: 228, ShiftRight: 229,
  AltRight: 230, MetaRight: 231,
};
for (let k = 0; k < 26; k++) SCANCODES[`Key${String.fromCharCode(65 + k)}`] = 4 + k;
for (let k = 0; k < 10; k++) SCANCODES[`Digit${(k + 1) % 10}`] = 30 + k;
for (let k = 0; k < 10; k++) SCANCODES[`Numpad${(k + 1) % 10}`] = 89 + k;
for (let k = 1; k <= 12; k++) SCANCODES[`F${k}`] = 57 + k;

// The code of a key by its scancode.
export const codeOf = (scancode) => Object.keys(SCANCODES).find((code) => SCANCODES[code] === scancode);

// What those keys mean whose meaning is a control character; printing keys mean their character.
const CONTROLS = { Enter: 13, Escape: 27, Backspace: 8, Tab: 9, Space: 32, Delete: 127 };
const MODIFIERS = [["Shift", 1], ["Control", 64], ["Alt", 256], ["Meta", 1024]];

// SDL's buttons by the number of a standard gamepad's button in a page; 6 and 7 are the triggers.
const PAD_BUTTONS = { 0: 0, 1: 1, 2: 2, 3: 3, 4: 9, 5: 10, 8: 4, 9: 6, 10: 7, 11: 8, 12: 11, 13: 12, 14: 13, 15: 14, 16: 5 };
const PLAIN = 100; // added to the number of a pad that is not a standard one

// With Ctrl these are the editor's: save, open, undo, redo, choose all. The others stay with the browser.
const EDITING = ["KeyS", "KeyO", "KeyZ", "KeyY", "KeyA"];

function keycode(event) {
  if (event.code in CONTROLS) return CONTROLS[event.code];
  const letter = event.key.length === 1 && !event.code.startsWith("Numpad");
  return letter ? event.key.toLowerCase().codePointAt(0) : (SCANCODES[event.code] || 0) + 2 ** 30;
}

export class Input {
  // canvas: where the game is seen. scale(): its px per CSS px. pressed(): called at every press of the player.
  constructor(canvas, scale, pressed) {
    this.canvas = canvas;
    this.scale = scale;
    this.pressed = pressed;
    this.queue = [];
    this.held = new Map(); // codes to what their keys meant
    this.buttons = [0, 0, 0];
    this.pads = new Map();
    this.typing = false;
    this.clipboard = "";
    this.dropped = () => {}; // (name, bytes) -> path
  }

  listen(page = window) {
    const { canvas } = this;
    page.addEventListener("keydown", (event) => this.keyDown(event));
    page.addEventListener("keyup", (event) => this.release(event.code, this.modifiers(event)));
    page.addEventListener("blur", () => this.focus(false));
    page.addEventListener("focus", () => this.focus(true));
    page.addEventListener("paste", (event) => (this.clipboard = event.clipboardData.getData("text")));
    page.addEventListener("gamepadconnected", (event) => this.addPad(event.gamepad));
    page.addEventListener("gamepaddisconnected", (event) => this.removePad(event.gamepad));
    canvas.addEventListener("mousedown", (event) => this.button("MOUSEBUTTONDOWN", event));
    page.addEventListener("mouseup", (event) => this.button("MOUSEBUTTONUP", event));
    page.addEventListener("mousemove", (event) => this.move(event));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    page.addEventListener("dragover", (event) => event.preventDefault());
    page.addEventListener("drop", (event) => this.drop(event));
  }

  post(name, fields = {}) {
    this.queue.push([name, fields]);
  }

  // Everything since the last call, as JSON.
  take() {
    this.pollPads();
    if (!this.queue.length) return "[]";
    const text = JSON.stringify(this.queue);
    this.queue = [];
    return text;
  }

  modifiers(event) {
    return MODIFIERS.reduce((sum, [name, bit]) => sum + (event.getModifierState(name) ? bit : 0), 0);
  }

  keyDown(event) {
    this.pressed();
    const command = event.ctrlKey || event.metaKey;
    const browsers = (command && !EDITING.includes(event.code)) || event.altKey || event.key === "F12";
    if (!browsers) event.preventDefault();
    const scancode = SCANCODES[event.code];
    if (!scancode || event.isComposing) return;
    if (!event.repeat || this.typing) {
      const key = keycode(event);
      this.held.set(event.code, key);
      this.post("KEYDOWN", { key, scancode, mod: this.modifiers(event), unicode: event.key.length === 1 ? event.key : "" });
    }
    if (this.typing && event.key.length === 1 && !event.ctrlKey && !event.metaKey) this.post("TEXTINPUT", { text: event.key });
  }

  release(code, mod = 0) {
    if (!this.held.has(code)) return;
    this.post("KEYUP", { key: this.held.get(code), scancode: SCANCODES[code], mod });
    this.held.delete(code);
  }

  // A key of a screen keyboard or a touch button; code as KeyboardEvent.code.
  key(code, down) {
    this.pressed();
    if (!(code in SCANCODES)) return;
    if (!down) return this.release(code);
    if (this.held.has(code)) return;
    const key = CONTROLS[code] || (code.startsWith("Key") ? code.toLowerCase().codePointAt(3) : SCANCODES[code] + 2 ** 30);
    this.held.set(code, key);
    this.post("KEYDOWN", { key, scancode: SCANCODES[code], mod: 0, unicode: "" });
  }

  focus(gained) {
    if (!gained) for (const code of [...this.held.keys()]) this.release(code);
    this.post(gained ? "WINDOWFOCUSGAINED" : "WINDOWFOCUSLOST");
  }

  place(event) {
    const box = this.canvas.getBoundingClientRect();
    return [Math.floor((event.clientX - box.left) * this.scale()), Math.floor((event.clientY - box.top) * this.scale())];
  }

  button(name, event) {
    this.pressed();
    const down = name === "MOUSEBUTTONDOWN" ? 1 : 0;
    if (!down && !this.buttons[event.button]) return;
    if (event.button < 3) this.buttons[event.button] = down;
    this.post(name, { pos: this.place(event), button: event.button + 1, touch: false });
  }

  move(event) {
    const last = this.queue[this.queue.length - 1];
    if (last && last[0] === "MOUSEMOTION") this.queue.pop();
    const rel = last && last[0] === "MOUSEMOTION" ? last[1].rel : [0, 0];
    const ratio = this.scale();
    this.post("MOUSEMOTION", {
      pos: this.place(event),
      rel: [rel[0] + Math.round(event.movementX * ratio), rel[1] + Math.round(event.movementY * ratio)],
      buttons: [...this.buttons],
      touch: false,
    });
  }

  wheel(event) {
    event.preventDefault();
    const step = event.deltaMode === 0 ? 100 : 3;
    const [x, y] = [event.deltaX / step, -event.deltaY / step];
    const whole = (value) => (value ? Math.sign(value) * Math.max(1, Math.round(Math.abs(value))) : 0);
    this.post("MOUSEWHEEL", { x: whole(x), y: whole(y), precise_x: x, precise_y: y, flipped: false });
  }

  async drop(event) {
    event.preventDefault();
    for (const file of event.dataTransfer.files) {
      const path = this.dropped(file.name, new Uint8Array(await file.arrayBuffer()));
      this.post("DROPFILE", { file: path });
    }
  }

  addPad(pad) {
    const number = pad.mapping === "standard" ? pad.index : pad.index + PLAIN;
    this.pads.set(pad.index, { number, buttons: [], axes: [] });
    this.post("JOYDEVICEADDED", { device_index: number });
  }

  removePad(pad) {
    const known = this.pads.get(pad.index);
    this.pads.delete(pad.index);
    if (known) this.post("JOYDEVICEREMOVED", { instance_id: known.number });
  }

  pollPads() {
    if (!this.pads.size) return;
    for (const pad of navigator.getGamepads()) {
      const known = pad && this.pads.get(pad.index);
      if (known) this.pollPad(pad, known);
    }
  }

  pollPad(pad, known) {
    const standard = known.number < PLAIN;
    const kind = standard ? "CONTROLLER" : "JOY";
    pad.buttons.forEach((button, k) => {
      if (standard && (k === 6 || k === 7)) return this.axis(known, k - 2, button.value, kind);
      if (button.pressed === Boolean(known.buttons[k])) return;
      known.buttons[k] = button.pressed;
      const number = standard ? PAD_BUTTONS[k] : k;
      if (number === undefined) return;
      if (button.pressed) this.pressed();
      this.post(`${kind}BUTTON${button.pressed ? "DOWN" : "UP"}`, { instance_id: known.number, button: number });
    });
    pad.axes.forEach((value, k) => {
      if (!standard || k < 4) this.axis(known, k, value, kind);
    });
  }

  axis(known, number, value, kind) {
    if (Math.abs(value - (known.axes[number] || 0)) < 0.01) return;
    known.axes[number] = value;
    const given = kind === "JOY" ? value : Math.round(value * 32767);
    this.post(`${kind}AXISMOTION`, { instance_id: known.number, axis: number, value: given });
  }
}
