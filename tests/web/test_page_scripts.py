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


def test_what_could_not_be_saved_is_tried_again_until_it_is(tmp_path: Path) -> None:
    if shutil.which("node") is None:
        pytest.skip("there is no Node.js")
    (tmp_path / "storage.mjs").write_text((ROOT / "ninja_game/web/page/storage.js").read_text("utf-8"), "utf-8")
    (tmp_path / "try.mjs").write_text(STORAGE, "utf-8")
    done = subprocess.run(["node", "try.mjs"], cwd=tmp_path, check=False, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    failed = "Not saved in this browser: no room. It is tried again."
    assert json.loads(done.stdout) == [
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
