"""The runs that must be the same in a page, and Node and Chromium, which play them."""

import json
import subprocess
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import Any

from ninja_game.files.bundled import bundled_replays
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.level_string import write_level_string
from tests.support.golden_runs import AFTERMATH, GoldenRun, crowded_runs, replay_runs, scene_runs
from tests.support.web_page import DIGESTS, ROOT, run_in

CROWDED = 200

Run = tuple[str, str, str, str]  # name, level as N's string, body, keys in hexadecimal

NODE = """
import { readFileSync } from "node:fs";
const [folder, game, program, runs] = process.argv.slice(2);
const { loadPyodide } = await import(`${folder}/pyodide.mjs`);
const python = await loadPyodide({ indexURL: `${folder}/` });
python.FS.mkdirTree("/game");
python.FS.mount(python.FS.filesystems.NODEFS, { root: game }, "/game");
python.runPython("import sys; sys.path.insert(0, '/game')");
python.runPython(readFileSync(program, "utf8"));
console.log(python.globals.get("answer")(readFileSync(runs, "utf8")));
"""


def certificate_runs() -> Iterator[GoldenRun]:
    """The certificates of our levels, each carried on for a while after its end."""
    for path in bundled_replays():
        for recording in load_replays(path):
            inputs = recording.replay.playback(recording.ticks + AFTERMATH)
            yield GoldenRun(path.name, recording.level, inputs, recording.body)


def page_runs() -> list[Run]:
    """All of them: certificates, our other replays, our scenes, crowded levels."""
    runs = [*certificate_runs(), *replay_runs(), *scene_runs(), *islice(crowded_runs(), CROWDED)]
    return [(run.name, write_level_string(run.level, exact=True), run.body, run.inputs.hex()) for run in runs]


def digests_in_node(pyodide: Path, runs: list[Run], folder: Path) -> dict[str, str]:
    """What Node says of them. ``pyodide``: the folder with it; ``folder``: for files. Raises CalledProcessError."""
    (folder / "digests.mjs").write_text(NODE, "utf-8")
    (folder / "runs.json").write_text(json.dumps(runs), "utf-8")
    command = ["node", "digests.mjs", str(pyodide), str(ROOT), str(DIGESTS), "runs.json"]
    done = subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
    answer: dict[str, str] = json.loads(done.stdout.splitlines()[-1])
    return answer


def digests_in_page(page: Any, runs: list[Run]) -> dict[str, str]:
    """What an empty page with Python says of them."""
    run_in(page, DIGESTS)
    answer: dict[str, str] = json.loads(page.evaluate("text => python.globals.get('answer')(text)", json.dumps(runs)))
    return answer
