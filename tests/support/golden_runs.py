"""The golden runs: which they are, what they show now, and what the files in ``tests/golden`` say they must show."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ninja_game.formats.load import load_replays
from ninja_game.formats.replay.text import write_replay
from ninja_game.runs.recording_reader import body_of
from ninja_game.runs.run import record_replay, trace_level
from ninja_game.runs.trace import trace_digests
from ninja_game.sim.level import Level
from ninja_game.simulation import Body
from tests.support.crowded import TICKS, crowded_inputs, crowded_level
from tests.support.own_scenes import SCENES

ROOT = Path(__file__).resolve().parent.parent.parent
GOLDEN = ROOT / "tests" / "golden"
REPLAYS = ROOT / "tests" / "replays"

AFTERMATH = 150
"""Ticks beyond a replay's end that are part of its golden run."""
CROWDED = 240
"""How many crowded levels there are; every eighth is played by the box."""
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
        digests = trace_digests(trace)
        objects = " ".join(f"{id_}:{digest}" for id_, digest in digests.objects.items())
        return {"name": self.name, "ticks": str(len(self.inputs)), "run": digests.run_sha256, "objects": objects}


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
    """Our own replays, each carried on for a while after its end."""
    for path in sorted(REPLAYS.glob("*.replay.txt")):
        for recording in load_replays(path):
            inputs = recording.playback(recording.ticks + AFTERMATH)
            body: Body = "box" if recording.replay and recording.replay.body == "box" else "circle"
            yield GoldenRun(path.name, recording.level, inputs, body)


FILES = {"crowded": crowded_runs, "replays": replay_runs, "scenes": scene_runs}
COLUMNS = ("name", "ticks", "run", "objects")


def golden_rows(name: str) -> dict[str, dict[str, str]]:
    """The rows of a golden file by the name of the run."""
    with (GOLDEN / f"{name}.tsv").open(encoding="utf-8", newline="") as lines:
        return {row["name"]: row for row in csv.DictReader(lines, delimiter="\t")}


def difference(ours: dict[str, str], golden: dict[str, str] | None) -> str:
    """What differs between a run and its golden row, in one line; empty if nothing does."""
    name = ours["name"]
    if golden is None:
        return f"{name}: has no golden row; write them anew (tests/golden/README.md)"
    if ours == golden:
        return ""
    mine, other = ours["objects"].split(), golden["objects"].split()
    parts = [part.partition(":")[0] for part, expected in zip(mine, other, strict=False) if part != expected]
    which = f"objects {', '.join(parts[:8])}" if parts else "the ninja"
    return f"{name}: {which} differ from the golden run"


def write_golden_files() -> None:
    """Write the golden files and our replays anew from what the world does now (plain memory)."""
    for path in sorted(REPLAYS.glob("*.replay.txt")):
        (old,) = load_replays(path)
        assert old.replay, f"{path.name} is no replay of ours"
        body, ticks = body_of(old), old.replay.ticks
        new = record_replay(old.level, old.replay.inputs, ticks=ticks, body=body, name=old.name, author=old.author)
        path.write_text(write_replay(new), "utf-8")
    for name, runs in FILES.items():
        with (GOLDEN / f"{name}.tsv").open("w", encoding="utf-8", newline="") as out:
            table = csv.DictWriter(out, COLUMNS, delimiter="\t", lineterminator="\n")
            table.writeheader()
            table.writerows(run.row("plain") for run in runs())
