// What the game is made of: fetched with progress, kept for the next visit, and started, from the files or from a
// picture of Python's memory that an earlier visit has kept.

import { build } from "./build.js";

const SITE = new URL("..", import.meta.url);
const PREFIX = `ninja-game ${SITE.pathname} `;
const MEMORY = "memory.bin";
const TRYING = "ninja-game: starting from memory";
const DOWNLOADED = 80; // how much of the bar is the download: the steps after it take about a fifth of a first visit
let tell = () => {};
let received = 0;
let furthest = 0;
let step = [0, ""];

// `listener` gets the share of the start that is done (0 to 100) and words for it, at each change.
export function onProgress(listener) {
  tell = listener;
  progress(2, "Loading the game");
}

// A step of the start begins. It is shown only when all bytes are there: until then they are what is waited for.
function progress(share, words) {
  step = [share, words];
  count(0);
}

function count(bytes) {
  received += bytes;
  const total = Object.values(build.sizes).reduce((a, b) => a + b, 0);
  const part = received / total;
  const [share, words] = part < 1 ? [2 + part * (DOWNLOADED - 2), `Loading the game: ${Math.floor(100 * part)} %`] : step;
  furthest = Math.max(furthest, share);
  tell(furthest, words);
}

const address = (name) => new URL(name, import.meta.url).href;

async function openCache() {
  try {
    return await caches.open(PREFIX + build.id);
  } catch {
    return null; // no secure page, or storage is switched off: everything works, but nothing is kept
  }
}

// A file of the game, as a response; the first time it comes from the host and is kept.
async function get(cache, name) {
  const kept = await cache?.match(address(name));
  if (kept) {
    count(build.sizes[name]);
    return kept;
  }
  const response = await fetch(address(name));
  if (!response.ok) throw new Error(`${name}: the host answers ${response.status} ${response.statusText}`);
  const counted = response.body.pipeThrough(
    new TransformStream({
      transform(chunk, out) {
        count(chunk.length);
        out.enqueue(chunk);
      },
    }),
  );
  const headers = { "Content-Type": name.endsWith(".wasm") ? "application/wasm" : "application/octet-stream" };
  if (!cache) return new Response(counted, { headers });
  const [now, later] = counted.tee();
  cache.put(address(name), new Response(later, { headers })).catch(() => {}); // no room: not kept
  return new Response(now, { headers });
}

// The files of a compressed tar, as [name, bytes].
async function* filesOf(response) {
  const unpacked = response.body.pipeThrough(new DecompressionStream("gzip"));
  const data = new Uint8Array(await new Response(unpacked).arrayBuffer());
  const word = (at, length) => new TextDecoder().decode(data.subarray(at, at + length)).replace(/\0.*$/s, "");
  for (let at = 0; at + 512 <= data.length && data[at]; ) {
    const size = parseInt(word(at + 124, 12), 8);
    const folder = word(at + 345, 155);
    yield [(folder && `${folder}/`) + word(at, 100), data.subarray(at + 512, at + 512 + size)];
    at += 512 + Math.ceil(size / 512) * 512;
  }
}

async function unpack(fs, response) {
  const made = new Set();
  for await (const [name, bytes] of filesOf(response)) {
    const folder = `/game/${name.slice(0, name.lastIndexOf("/"))}`;
    if (!made.has(folder)) fs.mkdirTree(folder);
    made.add(folder);
    fs.writeFile(`/game/${name}`, bytes);
  }
}

// The picture of Python's memory that an earlier visit has kept; null if there is none, or if it failed the last time.
async function keptMemory(cache) {
  const failed = sessionStorage.getItem(TRYING);
  sessionStorage.removeItem(TRYING);
  if (failed) await cache?.delete(address(MEMORY));
  const kept = await cache?.match(address(MEMORY));
  return kept ? new Uint8Array(await kept.arrayBuffer()) : null;
}

// Python with the game imported, from its memory if there is one; a memory that cannot be used is deleted.
export async function startPython() {
  const cache = await openCache();
  const memory = await keptMemory(cache);
  try {
    return await begin(cache, memory);
  } catch (error) {
    if (!memory) throw error;
    console.warn("The kept memory cannot be used:", error);
    await cache.delete(address(MEMORY));
    location.reload();
    return new Promise(() => {});
  }
}

// Python with the game imported: {python, boot, services, keep}; `keep` puts its memory aside for the next visit.
async function begin(cache, picture) {
  const archive = get(cache, "game.tar.gz");
  const wasm = get(cache, "pyodide/pyodide.asm.wasm");
  const library = get(cache, "pyodide/python_stdlib.zip");
  for (const each of [archive, wasm, library]) each.catch(() => {}); // told where it is awaited
  const [{ loadPyodide }, { default: createPyodideModule }] = await Promise.all([
    import("./pyodide/pyodide.mjs"),
    import("./pyodide/pyodide.asm.mjs"),
  ]);
  if (picture) sessionStorage.setItem(TRYING, "1");
  progress(DOWNLOADED, "Starting Python");
  const answers = { "pyodide.asm.wasm": wasm, "python_stdlib.zip": library };
  const plainFetch = globalThis.fetch;
  globalThis.fetch = (what, ...more) => answers[String(what).split("/").pop()] ?? plainFetch(what, ...more);
  let python;
  try {
    python = await loadPyodide({
      indexURL: address("pyodide/"),
      createPyodideModule,
      lockFileContents: { info: build.pyodide, packages: {} },
      env: { HOME: "/home", NINJA_GAME_HOME: "/ninja-game-player" },
      ...(picture ? { _loadSnapshot: picture } : cache && { _makeSnapshot: true }),
    });
  } finally {
    globalThis.fetch = plainFetch;
  }
  progress(picture ? 95 : 90, "Unpacking the game");
  await unpack(python.FS, await archive);
  if (!picture) python.runPython(`import gc, sys\ngc.disable()  # boot.py decides when\nsys.path[:0] = ["/game/ninja_game/web/shim", "/game"]`);
  const boot = python.pyimport("boot");
  const services = python.pyimport("ninja_game.web.services");
  progress(98, "Opening the menu");
  sessionStorage.removeItem(TRYING);
  const taken = picture || !cache ? null : takeMemory(python);
  return { python, boot, services, fromMemory: picture !== null, keep: () => taken && cache.put(address(MEMORY), new Response(taken)).catch(() => {}) };
}

function takeMemory(python) {
  try {
    return python.makeMemorySnapshot();
  } catch (error) {
    console.warn("Python's memory cannot be kept; the next visit starts as slowly as this one:", error);
    return null;
  }
}

// For visits without a network.
export function keepForLater() {
  return navigator.serviceWorker?.register(new URL("sw.js", SITE)).catch(() => {}); // offline, or no secure page
}
