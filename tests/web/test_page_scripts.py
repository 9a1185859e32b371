"""The scripts of the page can be parsed, every name in them is known, and what they declare is used."""

import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
NAMES = ROOT / "tests" / "support" / "page_names.mjs"

KNOWN = {
    "Array", "AudioContext", "Blob", "Boolean", "DataView", "Date", "DecompressionStream", "Error", "Float64Array",
    "Infinity", "IntersectionObserver", "JSON", "Map", "Math", "Number", "Object", "OfflineAudioContext",
    "OffscreenCanvas", "Promise", "Request", "ResizeObserver", "Response", "Set", "String", "TextDecoder",
    "TransformStream", "URL", "Uint8Array", "addEventListener", "caches", "clearTimeout", "console",
    "devicePixelRatio", "document", "fetch", "getSelection", "globalThis", "localStorage", "location", "matchMedia",
    "navigator", "parseInt", "performance", "requestAnimationFrame", "self", "sessionStorage", "setTimeout",
    "undefined", "window",
}  # fmt: skip
"""What the scripts use of the language and of the browser."""


def checked(sources: dict[str, str]) -> dict[str, dict[str, Any]]:
    """For each script its unknown and its unused names, or its error. Skips where Node.js or its parser is missing."""
    if shutil.which("node") is None:
        pytest.skip("there is no Node.js")
    command = ["node", "--expose-internals", str(NAMES)]
    done = subprocess.run(command, check=False, input=json.dumps(sources), capture_output=True, text=True)
    if "No such built-in module" in done.stderr or "Cannot find module" in done.stderr:
        pytest.skip("this Node.js has no parser that can be asked")
    assert done.returncode == 0, done.stderr
    answer: dict[str, dict[str, Any]] = json.loads(done.stdout)
    return answer


def test_every_name_in_a_script_is_known_and_used() -> None:
    scripts = {path.name: path.read_text("utf-8") for path in (ROOT / "ninja_game" / "web").rglob("*.js")}
    assert len(scripts) > 10
    filled = {name: re.sub(r"\{\{\w+\}\}", "0", text) for name, text in scripts.items()}
    wrong = {}
    used = set()
    for name, found in checked(filled).items():
        used |= set(found.get("unknown", ()))
        found["unknown"] = sorted(set(found.get("unknown", ())) - KNOWN)
        if any(found.values()):
            wrong[name] = found
    assert not wrong
    assert used == KNOWN, "the list has no name that nothing uses"


def test_the_check_sees_what_is_wrong() -> None:
    sources = {
        "unknown.js": "export function f(a, { b, c: [d = a] }) { return [b.length, d, lenght, f.c]; }",
        "unused.js": "import { a as b } from './a.js';\nconst c = 1;\nexport const d = (e) => ({ c: 2 });",
        "broken.js": "const a = ;",
    }
    found = checked(sources)
    assert found["unknown.js"] == {"unknown": ["lenght"], "unused": []}
    assert found["unused.js"] == {"unknown": [], "unused": ["b", "c", "e"]}
    assert "SyntaxError" in found["broken.js"]["error"]


STORAGE = """
import { PlayerFolder } from "./storage.mjs";
const said = [], syncs = [];
const fs = { syncfs: (reading, done) => syncs.push(done) };
const folder = new PlayerFolder(fs);
let state = 1, clock = 0;
Object.defineProperty(globalThis, "performance", { value: { now: () => clock } });
folder.state = () => state;
folder.seen = 0;
const tell = (text) => said.push(text);
const settled = () => new Promise((done) => setTimeout(done));
const save = (options) => folder.saveChanges(tell, options);
const answer = async (error) => { syncs.shift()(error); await settled(); };
const log = [];
const note = () => log.push([syncs.length, folder.unsaved, said.length ? said.pop() : ""]);
save(); note();
await answer(new Error("no room")); note();
save(); note(); // too early
clock += 3000; save(); note();
await answer(new Error("no room")); note();
save({ now: true }); note(); // the page is left
state = 2;
await answer(null); note(); // what changed meanwhile is written too
await answer(null); note();
save(); note();
state = 3; save(); await folder.saving; save(); note(); // a slow write: the game goes on, no second one begins
await answer(null); note();
console.log(JSON.stringify(log));
process.exit();
"""


def printed(folder: Path, script: str, program: str) -> Any:
    """What a program prints as JSON that imports a script of the page from beside it."""
    if shutil.which("node") is None:
        pytest.skip("there is no Node.js")
    text = (ROOT / "ninja_game/web/page" / f"{script}.js").read_text("utf-8")
    (folder / f"{script}.mjs").write_text(text, "utf-8")
    (folder / "try.mjs").write_text(program, "utf-8")
    done = subprocess.run(["node", "try.mjs"], cwd=folder, check=False, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_what_could_not_be_saved_is_tried_again_until_it_is(tmp_path: Path) -> None:
    failed = "Not saved in this browser: no room. It is tried again."
    assert printed(tmp_path, "storage", STORAGE) == [
        [1, True, ""],
        [0, True, failed],
        [0, True, ""],
        [1, True, ""],
        [0, True, failed],
        [1, True, ""],
        [1, True, ""],
        [0, False, "Saved in this browser"],
        [0, False, ""],
        [1, True, ""],
        [0, False, ""],
    ]


PAINTER = """
const maps = [];
globalThis.Map = class extends Map { constructor() { super(); maps.push(this); } };
const { Painter } = await import("./painter.mjs");
const styles = [];
const context = { save() {}, clearRect() {}, fillRect() { styles.push(this.fillStyle); } };
const painter = new Painter({ getContext: () => context });
const [CANVAS, FILL] = [2, 7];
painter.paint([CANVAS, 1, 99, 99, 1]);
let most = 0;
for (let number = 0; number < 20000; number++) {
  painter.paint([FILL, number * 256 + 255, 0, 0, 1, 1]);
  most = Math.max(most, ...maps.map((map) => map.size));
}
console.log(JSON.stringify([most, styles.length, styles[0x0102], styles.at(-1)]));
"""


def test_the_painter_keeps_the_texts_of_some_colours_only(tmp_path: Path) -> None:
    assert printed(tmp_path, "painter", PAINTER) == [4096, 20000, "rgb(0,1,2)", "rgb(0,78,31)"]


def test_the_classes_of_the_page_declare_their_fields() -> None:
    """Outside of any method, or in the constructor."""
    hidden = {}
    for path in (ROOT / "ninja_game" / "web").rglob("*.js"):
        classes = re.findall(
            r"^(?:export )?class (\w+) \{\n(.*?)^\}", path.read_text("utf-8"), re.MULTILINE | re.DOTALL
        )
        for name, body in classes:
            made = re.search(r"^  constructor\(.*?^  \}", body, re.MULTILINE | re.DOTALL)
            known = {*re.findall(r"^  (\w+)(?: = .*)?;", body, re.MULTILINE)}
            known |= {*re.findall(r"\bthis\.(\w+) = ", made[0] if made else "")}
            assigned = {*re.findall(r"\bthis\.(\w+) = ", body)}
            assigned |= {
                field for names in re.findall(r"assign\(this, \{ ([\w, ]+) \}", body) for field in names.split(", ")
            }
            hidden[name] = assigned - known
    assert len(hidden) > 7
    assert not {name: fields for name, fields in hidden.items() if fields}
