"""The golden runs: which they are, what they show now, and what the files in ``tests/golden`` say they must show."""

import csv
import io
import os
import pickle
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZipFile

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.plain import PlainWorlds
from ninja_game.backend.self_test import DIGEST, self_test_digest
from ninja_game.formats.load import load_replays
from ninja_game.formats.replay.text import write_replay
from ninja_game.runs.run import record_replay
from ninja_game.runs.trace import first_difference, trace_digests, trace_level
from ninja_game.sim.level import Body, Level
from ninja_game.simulation import Simulation
from tests.support.crowded import TICKS, crowded_inputs, crowded_level
from tests.support.own_pack import PACK
from tests.support.own_scenes import SCENES

ROOT = Path(__file__).resolve().parent.parent.parent
GOLDEN = ROOT / "tests" / "golden"
REPLAYS = PACK / "certificates"

INTERVAL = 40  # ticks between two checkpoints (1 s): a failing test names the interval in which the difference begins
PLACE_DIGITS = 3

AFTERMATH = 150  # ticks beyond a replay's end that are part of its golden run
CROWDED = 240  # how many crowded levels there are; every eighth is played by the box
REVEALING = (252, 297, 417, 460, 464, 545, 645, 852, 886, 970, 1066, 1508, 1863, 2030, 2357, 2485, 2759, 2906, 2986)
"""More of them: in these shows what seldom shows (order of the nine cells, places in lists, …)."""


@dataclass(frozen=True)
class GoldenRun:
    """A run to be compared: level, inputs of every tick, body."""

    name: str
    level: Level
    inputs: bytes
    body: Body

    def row(self, memory: str) -> dict[str, str]:
        """What the run shows, as a row of the golden file."""
        trace = trace_level(self.level, self.inputs, body=self.body, memory=memory)
        objects = zip(trace.ids, trace.kinds, trace.objects.T, strict=True)
        return {
            "name": self.name,
            "ticks": str(len(self.inputs)),
            "run": trace_digests(trace).run_sha256,
            "ninja": checkpoints(trace.ninja, ("x", "y", "prev_x", "prev_y"), ("s", "gold")),
            "objects": " ".join(
                f"{id_}/{kind.replace(' ', '-')}:{checkpoints(rows, ('x', 'y'), ('s',))}" for id_, kind, rows in objects
            ),
            "events": self._event_digests(memory),
        }

    def _event_digests(self, memory: str) -> str:
        """Digests of everything that events say, one for each ``INTERVAL`` ticks."""
        run = Simulation(self.level, body=self.body, memory=memory)
        parts = []
        for start in range(0, len(self.inputs), INTERVAL):
            seen = sha256()
            for keys in self.inputs[start : start + INTERVAL]:
                run.step_keys(keys)
                for e in run.events:
                    seen.update(
                        f"{run.tick} {e.name} {e.object_id} {e.cause} {e.x!r} {e.y!r} {e.dx!r} {e.dy!r}\n".encode()
                    )
            parts.append(seen.hexdigest()[:4])
        return ".".join(parts)


def checkpoints(rows: NDArray[np.void], place: Sequence[str], state: Sequence[str]) -> str:
    """Digests of records (ticks,), one for each ``INTERVAL`` ticks: three digits of the place, one of the state."""
    starts = range(0, len(rows), INTERVAL)
    return ".".join(
        "".join(
            sha256(b"".join(rows[name][start : start + INTERVAL].tobytes() for name in names)).hexdigest()[:digits]
            for names, digits in ((place, PLACE_DIGITS), (state, 1))
        )
        for start in starts
    )


def crowded_runs() -> Iterator[GoldenRun]:
    """The crowded levels, by seed."""
    for seed in (*range(CROWDED), *REVEALING):
        body: Body = "box" if seed % 8 == 7 else "circle"
        yield GoldenRun(f"crowded-{seed:03}", crowded_level(seed), crowded_inputs(seed, TICKS), body)


def scene_runs() -> Iterator[GoldenRun]:
    """The scenes of our own."""
    for scene in SCENES:
        yield GoldenRun(scene.name, scene.level, scene.inputs, "circle")


def replay_runs() -> Iterator[GoldenRun]:
    """The replays of the tests' pack, each carried on for a while after its end."""
    for path in sorted(REPLAYS.glob("*.replay.txt")):
        for recording in load_replays(path):
            inputs = recording.replay.playback(recording.ticks + AFTERMATH)
            yield GoldenRun(path.name, recording.level, inputs, recording.body)


FILES = {"crowded": crowded_runs, "replays": replay_runs, "scenes": scene_runs}
COLUMNS = ("name", "ticks", "run", "ninja", "objects", "events")
SHOWN = ("inputs", "final_tick", "outcome", "gold", "digest", "rules", "waypoints")
"""What the world says of a replay; the rest is what people say."""


def golden_rows(name: str) -> dict[str, dict[str, str]]:
    """The rows of a golden file by the name of the run."""
    with (GOLDEN / f"{name}.tsv").open(encoding="utf-8", newline="") as lines:
        return {row["name"]: row for row in csv.DictReader(lines, delimiter="\t")}


def difference(ours: dict[str, str], golden: dict[str, str] | None) -> str:
    """What differs first between a run and its golden row, in one line; empty if nothing does."""
    name = ours["name"]
    if golden is None:
        return f"{name}: has no golden row"
    if ours == golden:
        return ""
    first = len(ours["ninja"])
    parts: list[str] = []
    for who, mine, other in _compared(ours, golden):
        pairs = zip(mine.split("."), other.split("."), strict=False)
        at, (now, before) = next(
            ((k, pair) for k, pair in enumerate(pairs) if pair[0] != pair[1]), (first + 1, ("", ""))
        )
        if at < first:
            first, parts = at, []
        if at == first:
            what = "" if who == "events" else " place" if now[:PLACE_DIGITS] != before[:PLACE_DIGITS] else " state"
            parts.append(who + what)
    when = f"ticks {first * INTERVAL} to {(first + 1) * INTERVAL - 1}: " if parts else ""
    return f"{name}: {when}{', '.join(parts[:8]) or 'ticks or objects'} not as in the golden run"


def _compared(ours: dict[str, str], golden: dict[str, str]) -> Iterator[tuple[str, str, str]]:
    """Who, our checkpoints, the golden ones: of the ninja, of every object that both have, of the events."""
    yield "ninja", ours["ninja"], golden["ninja"]
    expected = dict(part.split(":") for part in golden["objects"].split())
    for part in ours["objects"].split():
        who, _, mine = part.partition(":")
        number, _, kind = who.partition("/")
        yield f"object {number} ({kind.replace('-', ' ')})", mine, expected.get(who, mine)
    yield "events", ours["events"], golden["events"]


def first_place(run: GoldenRun, memory: str, golden: dict[str, str]) -> str:
    """The first tick, object and field in which a run is not as at HEAD; "" where HEAD does not show the golden run.

    The files hold digests only: what they are digests of, a copy of HEAD can still play.
    """
    play = (
        "import pickle, sys; from ninja_game.runs.trace import trace_level; run = pickle.load(sys.stdin.buffer); "
        "pickle.dump(trace_level(run.level, run.inputs, body=run.body, memory='plain'), sys.stdout.buffer)"
    )
    with TemporaryDirectory() as folder:
        copy = subprocess.run(["git", "-C", ROOT, "archive", "--format=zip", "HEAD"], capture_output=True, check=False)
        if copy.returncode:
            return ""
        ZipFile(io.BytesIO(copy.stdout)).extractall(folder)
        done = subprocess.run(
            [sys.executable, "-c", play], cwd=folder, env=os.environ | {"PYTHONPATH": folder},
            input=pickle.dumps(run), capture_output=True, check=False,
        )  # fmt: skip
    before = None if done.returncode else pickle.loads(done.stdout)
    if before is None or trace_digests(before).run_sha256 != golden["run"]:
        return ""
    now = trace_level(run.level, run.inputs, body=run.body, memory=memory)
    return str(first_difference(now, before) or "only events differ")


def write_golden_files() -> None:
    """Write the golden files and our replays again from what the world does now (plain memory)."""
    for path in sorted([*REPLAYS.glob("*.replay.txt"), *ROOT.glob("levels/certificates/*.replay.txt")]):
        (old,) = load_replays(path)
        assert old.replay, f"{path.name} is not a replay of ours"
        body, ticks = old.body, old.replay.ticks
        run = record_replay(old.level, old.replay.inputs, ticks=ticks, body=body)
        new = replace(old.replay, **{name: getattr(run, name) for name in SHOWN})
        if new != old.replay:
            path.write_text(write_replay(new), "utf-8")
    digest = self_test_digest(lambda level, box: PlainWorlds([level], box=box))
    if digest != DIGEST:
        module = ROOT / "ninja_game" / "backend" / "self_test.py"
        module.write_text(module.read_text("utf-8").replace(DIGEST, digest), "utf-8")
    for name, runs in FILES.items():
        with (GOLDEN / f"{name}.tsv").open("w", encoding="utf-8", newline="") as out:
            table = csv.DictWriter(out, COLUMNS, delimiter="\t", lineterminator="\n")
            table.writeheader()
            table.writerows(run.row("plain") for run in runs())
