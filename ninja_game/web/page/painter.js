// Paints the display list of shim/pygame/surface.py on canvases. Entries, each a kind and its numbers:
const TARGET = 1; // canvas: where the next entries paint
const CANVAS = 2; // canvas, width, height, opaque: a new canvas, which becomes the target
const FREE = 3; // canvas: no longer needed
const CLIP = 4; // x, y, width, height
const IMAGE = 5; // canvas, x, y, width, height, to x, to y, opacity; below 0: take away
const STRETCH = 6; // canvas, width, height, to width, to height
const FILL = 7; // colour, x, y, width, height: in the place of what is there
const SHIFT = 8; // scale, x, y: of the entries up to UNSHIFT; with a scale of 1 they are a copy, which is blended
const UNSHIFT = 9;
const POLYGON = 10; // colour, count of corners, x, y, ...: whole px, those of the corners included
const DISC = 11; // colour, x, y, radius
const RING = 12; // colour, x, y, radius, width inwards
const LINE = 13; // colour, x, y, to x, to y, width: across or down, whichever the line is not
const FRAME = 14; // colour, x, y, width, height, line width (0: filled), corner radius
const TEXT = 15; // colour, text, size, height
const STROKE = 16; // colour, count of points, width, x, y, ...: round at its ends and bends
const LIMB = 17; // colour, count of points, x, y, radius, ...: the same, of a width that changes

const SCREEN = 1;
const GRAIN = 32; // sizes of canvases are multiples of it, so that freed ones fit again
const MAX_KEPT = 400; // freed canvases
const MAX_COLOURS = 4096; // colours whose text is kept: what fades has ever new ones

const css = new Map();

function colourOf(number) {
  let text = css.get(number);
  if (text === undefined) {
    const [r, g, b, a] = [number / 16777216, number / 65536, number / 256, number].map((value) => Math.floor(value) & 255);
    text = a === 255 ? `rgb(${r},${g},${b})` : `rgba(${r},${g},${b},${a / 255})`;
    if (css.size >= MAX_COLOURS) css.clear();
    css.set(number, text);
  }
  return text;
}

export class Painter {
  // screen: the canvas that the player sees.
  constructor(screen) {
    this.screen = screen;
    this.sheets = []; // by number: {canvas, context, key}
    this.free = new Map(); // canvases by size
    this.kept = 0;
    this.texts = [];
    this.context = null;
    this.colour = 0; // of the shapes whose path is open
    this.wide = 0; // of the lines whose path is open; 0: it is filled
    this.open = false;
    this.scale = 1;
    this.x = 0;
    this.y = 0;
    this.stack = [];
    this.copies = 0; // how many of the shifts that are open copy a picture onto another, which is blended
    this.rest = null; // of a list that takes longer than a turn may
  }

  // --- canvases ---

  sheet(number, width, height, opaque) {
    if (number === SCREEN) {
      this.screen.width = width;
      this.screen.height = height;
      const context = this.screen.getContext("2d", { alpha: false });
      context.save();
      this.sheets[SCREEN] = { canvas: this.screen, context, key: 0 };
      return;
    }
    const [wide, high] = [width, height].map((length) => Math.max(1, Math.ceil(length / GRAIN)) * GRAIN);
    const key = wide * 65536 + high;
    const stock = this.free.get(key);
    let sheet = stock && stock.pop();
    if (sheet) {
      this.kept -= 1;
      sheet.context.clearRect(0, 0, wide, high);
    } else {
      const canvas = new OffscreenCanvas(wide, high);
      sheet = { canvas, context: canvas.getContext("2d"), key };
      sheet.context.save();
    }
    if (opaque) {
      sheet.context.fillStyle = "black";
      sheet.context.fillRect(0, 0, width, height);
    }
    this.sheets[number] = sheet;
  }

  release(number) {
    const sheet = this.sheets[number];
    this.sheets[number] = undefined;
    if (!sheet || this.kept >= MAX_KEPT) return;
    sheet.context.restore();
    sheet.context.save();
    if (!this.free.has(sheet.key)) this.free.set(sheet.key, []);
    this.free.get(sheet.key).push(sheet);
    this.kept += 1;
  }

  // --- shapes: those of one colour are filled as one path ---

  begin(colour, wide = 0) {
    if (this.open && this.colour === colour && this.wide === wide) return;
    this.finish();
    this.colour = colour;
    this.wide = wide;
    this.open = true;
    this.context.beginPath();
  }

  finish() {
    if (!this.open) return;
    this.open = false;
    const { context, wide } = this;
    const draw = (style) => {
      context[wide ? "strokeStyle" : "fillStyle"] = style;
      if (wide) context.stroke();
      else context.fill();
    };
    if (wide) Object.assign(context, { lineWidth: wide, lineCap: "round", lineJoin: "round" });
    if (this.colour % 256 !== 255 && this.copies === 0) {
      // A shape takes the place of what is there, also where one can look through it.
      context.globalCompositeOperation = "destination-out";
      draw("black");
      context.globalCompositeOperation = "source-over";
    }
    draw(colourOf(this.colour));
  }

  // Corners at list[at...]; px of the outline are part of the shape, so it is half a px larger on all sides.
  polygon(list, at, count, grow) {
    const { context, scale, x, y } = this;
    let area = 0;
    let [px, py] = [list[at + 2 * count - 2], list[at + 2 * count - 1]];
    const corners = [];
    for (let k = 0; k < count; k++) {
      const [cx, cy] = [list[at + 2 * k], list[at + 2 * k + 1]];
      area += px * cy - cx * py;
      if (cx !== px || cy !== py) corners.push(cx, cy);
      [px, py] = [cx, cy];
    }
    const n = corners.length / 2;
    const side = area < 0 ? -1 : 1;
    for (let k = 0; k < n; k++) {
      // Always the same way round: what lies on top of each other must not cancel out.
      const i = 2 * (side > 0 ? k : n - 1 - k);
      const before = (i + corners.length - 2) % corners.length;
      const after = (i + 2) % corners.length;
      let [ax, ay] = [corners[i] - corners[before], corners[i + 1] - corners[before + 1]];
      let [bx, by] = [corners[after] - corners[i], corners[after + 1] - corners[i + 1]];
      const [la, lb] = [Math.hypot(ax, ay), Math.hypot(bx, by)];
      [ax, ay, bx, by] = [ax / la, ay / la, bx / lb, by / lb];
      const cosine = Math.max(0.2, 1 + ax * bx + ay * by);
      const reach = (grow * side) / cosine;
      const cx = corners[i] + 0.5 + (ay + by) * reach;
      const cy = corners[i + 1] + 0.5 - (ax + bx) * reach;
      if (k === 0) context.moveTo(cx * scale + x, cy * scale + y);
      else context.lineTo(cx * scale + x, cy * scale + y);
    }
    context.closePath();
  }

  disc(cx, cy, radius) {
    const { context, scale, x, y } = this;
    const [px, py, r] = [cx * scale + x, cy * scale + y, radius * scale];
    context.moveTo(px + r, py);
    context.arc(px, py, r, 0, 2 * Math.PI);
    context.closePath();
  }

  line(ax, ay, bx, by, width) {
    const { context, scale, x, y } = this;
    let [dx, dy] = [bx - ax, by - ay];
    const steep = Math.abs(dx) < Math.abs(dy);
    const longer = steep ? Math.abs(dy) : Math.abs(dx);
    [dx, dy] = longer ? [dx / longer / 2, dy / longer / 2] : [0.5, 0];
    const [nx, ny] = steep ? [width / 2, 0] : [0, width / 2];
    const turned = dx * ny - dy * nx < 0 ? -1 : 1;
    const point = (px, py) => [px * scale + x, py * scale + y];
    context.moveTo(...point(ax - dx - nx * turned, ay - dy - ny * turned));
    context.lineTo(...point(bx + dx - nx * turned, by + dy - ny * turned));
    context.lineTo(...point(bx + dx + nx * turned, by + dy + ny * turned));
    context.lineTo(...point(ax - dx + nx * turned, ay - dy + ny * turned));
    context.closePath();
  }

  // Points at list[at...].
  stroke(list, at, count) {
    const { context, scale, x, y } = this;
    context.moveTo(list[at] * scale + x - 1e-3, list[at + 1] * scale + y); // a line of no length is not drawn
    for (let k = at; k < at + 2 * count; k += 2) context.lineTo(list[k] * scale + x, list[k + 1] * scale + y);
  }

  // Points at list[at...], whole px as ui/canvas.py has it where there is no such shape.
  limb(list, at, count) {
    for (let k = at; k < at + 3 * count; k += 3) {
      const [x, y, radius] = [list[k], list[k + 1], list[k + 2]];
      if (radius >= 1) this.disc(Math.trunc(x), Math.trunc(y), Math.trunc(radius));
      if (k === at) continue;
      const [bx, by, before] = [list[k - 3], list[k - 2], list[k - 1]];
      const length = Math.hypot(x - bx, y - by);
      if (length === 0) continue;
      const [nx, ny] = [(by - y) / length, (x - bx) / length];
      const [ax, ay, cx, cy] = [nx * before, ny * before, nx * radius, ny * radius];
      const corners = [bx + ax, by + ay, x + cx, y + cy, x - cx, y - cy, bx - ax, by - ay];
      this.polygon(corners.map(Math.trunc), 0, 4, 0.5);
    }
  }

  fillBox(colour, left, top, width, height) {
    const { context, scale, x, y } = this;
    const box = [left * scale + x, top * scale + y, width * scale, height * scale];
    if (colour % 256 !== 255 && this.copies === 0) context.clearRect(...box);
    if (colour % 256 === 0) return;
    context.fillStyle = colourOf(colour);
    context.fillRect(...box);
  }

  frame(colour, left, top, width, height, line, radius) {
    const { context, scale, x, y } = this;
    const inset = line / 2;
    const box = [(left + inset) * scale + x, (top + inset) * scale + y, (width - line) * scale, (height - line) * scale];
    context.beginPath();
    if (radius > 0) context.roundRect(...box, Math.max(0, radius - inset) * scale);
    else context.rect(...box);
    if (line > 0) {
      context.strokeStyle = colourOf(colour);
      context.lineWidth = line * scale;
      context.lineJoin = "miter";
      context.stroke();
    } else {
      context.fillStyle = colourOf(colour);
      context.fill();
    }
  }

  image(source, list, at) {
    const { context } = this;
    const opacity = list[at + 6];
    if (opacity !== 1) context.globalAlpha = Math.abs(opacity);
    if (opacity < 0) context.globalCompositeOperation = "destination-out";
    const [w, h] = [list[at + 2], list[at + 3]];
    context.drawImage(source, list[at], list[at + 1], w, h, list[at + 4], list[at + 5], w, h);
    if (opacity !== 1) context.globalAlpha = 1;
    if (opacity < 0) context.globalCompositeOperation = "source-over";
  }

  // Larger as pygame does it: the first px lies on the first one, and between two there is a line.
  stretch(source, width, height, toWidth, toHeight) {
    const { context } = this;
    const larger = toWidth > width && height > 1;
    const from = (few, many) => (larger ? [(1 - (few - 1) / many) / 2, few - 1] : [0, few]);
    const [[x, wide], [y, high]] = [from(width, toWidth), from(height, toHeight)];
    context.imageSmoothingQuality = larger ? "low" : "high";
    context.drawImage(source, x, y, wide, high, 0, 0, toWidth, toHeight);
  }

  clip(x, y, width, height) {
    const { context } = this;
    context.restore();
    context.save();
    context.beginPath();
    context.rect(x, y, width, height);
    context.clip();
  }

  text(colour, number, size, height) {
    const { context } = this;
    context.font = `${0.62 * size}px sans-serif`;
    context.textBaseline = "middle";
    context.fillStyle = colourOf(colour);
    context.fillText(this.texts[number], 0, height / 2);
  }

  // A number for a text.
  letters(text) {
    const known = this.texts.indexOf(text);
    return known >= 0 ? known : this.texts.push(text) - 1;
  }

  shift(scale, x, y) {
    this.stack.push([this.scale, this.x, this.y, this.copies]);
    if (scale === 1) this.copies += 1;
    [this.x, this.y] = [x * this.scale + this.x, y * this.scale + this.y];
    this.scale *= scale;
  }

  // --- the list ---

  // After `patience` ms what is left becomes the rest, unless it paints on the screen already. A rest comes first.
  paint(list, patience = Infinity) {
    this.goOn();
    const { sheets } = this;
    const until = performance.now() + patience;
    let hidden = true;
    let at = 0;
    while (at < list.length) {
      const kind = list[at];
      if (hidden && (kind === CANVAS || kind === TARGET)) {
        hidden = list[at + 1] !== SCREEN;
        if (at > 0 && performance.now() > until) {
          this.finish();
          this.rest = list.slice(at);
          return;
        }
      } else if (hidden && kind !== FREE) {
        hidden = this.context !== sheets[SCREEN]?.context;
      }
      if (kind >= POLYGON && kind <= LINE && kind !== RING) {
        this.begin(list[at + 1]);
        if (kind === DISC) {
          this.disc(list[at + 2], list[at + 3], list[at + 4]);
          at += 5;
        } else if (kind === POLYGON) {
          this.polygon(list, at + 3, list[at + 2], 0.5);
          at += 3 + 2 * list[at + 2];
        } else {
          this.line(list[at + 2], list[at + 3], list[at + 4], list[at + 5], list[at + 6]);
          at += 7;
        }
        continue;
      }
      if (kind === STROKE) {
        this.begin(list[at + 1], list[at + 3] * this.scale);
        this.stroke(list, at + 4, list[at + 2]);
        at += 4 + 2 * list[at + 2];
        continue;
      }
      if (kind === LIMB) {
        this.begin(list[at + 1]);
        this.limb(list, at + 3, list[at + 2]);
        at += 3 + 3 * list[at + 2];
        continue;
      }
      if (kind === SHIFT) {
        if (this.stack.length === 0) this.finish();
        this.shift(list[at + 1], list[at + 2], list[at + 3]);
        at += 4;
        continue;
      }
      if (this.stack.length <= 1) this.finish();
      if (kind === UNSHIFT) {
        [this.scale, this.x, this.y, this.copies] = this.stack.pop();
        at += 1;
        continue;
      }
      this.finish();
      switch (kind) {
        case TARGET:
          this.context = sheets[list[at + 1]].context;
          at += 2;
          break;
        case CANVAS:
          this.sheet(list[at + 1], list[at + 2], list[at + 3], list[at + 4]);
          this.context = sheets[list[at + 1]].context;
          at += 5;
          break;
        case FREE:
          this.release(list[at + 1]);
          at += 2;
          break;
        case CLIP:
          this.clip(list[at + 1], list[at + 2], list[at + 3], list[at + 4]);
          at += 5;
          break;
        case IMAGE:
          this.image(sheets[list[at + 1]].canvas, list, at + 2);
          at += 9;
          break;
        case STRETCH:
          this.stretch(sheets[list[at + 1]].canvas, ...list.slice(at + 2, at + 6));
          at += 6;
          break;
        case FILL:
          this.fillBox(list[at + 1], list[at + 2], list[at + 3], list[at + 4], list[at + 5]);
          at += 6;
          break;
        case RING:
          this.begin(list[at + 1]);
          this.ring(list[at + 2], list[at + 3], list[at + 4], list[at + 5]);
          at += 6;
          break;
        case FRAME:
          this.frame(...list.slice(at + 1, at + 8));
          at += 8;
          break;
        case TEXT:
          this.text(list[at + 1], list[at + 2], list[at + 3], list[at + 4]);
          at += 5;
          break;
        default:
          throw new Error(`display list: no entry is of kind ${kind} (at ${at} of ${list.length})`);
      }
    }
    this.finish();
  }

  // Paint what was left; whether there was something.
  goOn(patience) {
    const { rest } = this;
    this.rest = null;
    if (rest) this.paint(rest, patience);
    return rest !== null;
  }

  ring(cx, cy, radius, width) {
    const { context, scale, x, y } = this;
    const [px, py] = [cx * scale + x, cy * scale + y];
    this.disc(cx, cy, radius);
    context.moveTo(px + (radius - width) * scale, py);
    context.arc(px, py, (radius - width) * scale, 0, 2 * Math.PI, true);
    context.closePath();
    this.finish();
  }
}
