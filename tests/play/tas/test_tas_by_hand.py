"""A person's speedrun made shorter in a real window, with real keys and a real mouse, saved and verified."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.demo import parse_demo, write_demo
from ninja_game.formats.n14.level_file import LevelRecord, write_level_file
from ninja_game.formats.n14.level_string import parse_level_string, write_level_string
from ninja_game.runs.run import run_level
from ninja_game.sim.inputs import KEY_LEFT, Demo, with_press_bits
from ninja_game.sim.level import Level
from ninja_game.tas.journal import JOURNAL_FOLDER, read_journal
from ninja_game.tas.tracks import InputTrack
from tests.play.tas.conftest import RUN
from tests.support import reference
from tests.support.real_window import NEEDS_WINDOW, TIMEOUT, Player, virtual_screen
from tests.support.tas_driver import TasDriver
from tests.support.waiting import LONGEST

DELAYS = (30, 45, 60)
"""Ticks of standing at the start with which the run must still reach its exit, whatever the height of the roll."""

pytestmark = NEEDS_WINDOW


def exit_tick(level: Level, inputs: bytes) -> int:
    """The tick of the exit contact; far away without one."""
    run = run_level(level, inputs + bytes(5))
    return run.ticks - 1 if run.outcome == "exit" else 10**6


def late(inputs: bytes, ticks: int) -> bytes:
    """The same after standing for this many ticks."""
    return with_press_bits([0] * ticks + list(inputs))


def two_runs() -> tuple[Level, bytes, bytes]:
    """A person's speedrun and a tool-assisted one that still reaches the exit when it is late; else one of ours."""
    if reference.reference_folder() is not None:
        people: dict[str, bytes] = {}
        for row in reference.recordings():
            inputs = parse_demo(row.demo).playback(row.ticks)
            if row.kind == "speedrun" and row.source == "rta" and row.ticks < 500:
                people[row.data] = inputs
            elif row.kind == "speedrun" and row.source == "tas" and row.data in people:
                level = parse_level_string(row.data)
                if all(exit_tick(level, late(inputs, delay)) < 10**6 for delay in DELAYS):
                    return level, people[row.data], inputs
    recording = load_replays(RUN)[0]
    inputs = recording.inputs
    return recording.level, late(inputs, 5), inputs


def written(path: Path, author: str, level: Level, inputs: bytes) -> Path:
    """A run as a file of N."""
    demo = write_demo(Demo(inputs, float(len(inputs))))
    record = LevelRecord("a level", author, "", write_level_string(level, exact=True), demo)
    path.write_text(write_level_file([record]), "utf-8")
    return path


class Runner(Player):
    """Someone at the TAS editor, whose edits are seen in the journal."""

    def play(self, key: str) -> None:
        """Take over, and hold a key until it is in the run."""
        self.press("Return")

        self.tool("keydown", key)
        self.wait_for(lambda: self.track() is not None, "tick that was played")
        self.tool("keyup", key)
        self.press("Return")
        self.catch_up()

    def track(self) -> InputTrack | None:
        """The run after the last edit; None before the first."""
        for file in (self.home / JOURNAL_FOLDER).glob("*.jsonl"):
            found = read_journal(file)
            return (found.opened.track, *found.tracks)[-1]
        return None

    def edit(self, *keys: str) -> InputTrack:
        """Press keys that change the run; what it is then."""
        before = self.track()
        self.press(*keys)
        self.wait_for(lambda: self.track() != before, f"edit by {keys}")
        track = self.track()
        assert track is not None
        return track


@pytest.mark.slow
def test_a_speedrun_is_made_shorter_by_hand(tmp_path: Path, root: Path) -> None:
    level, mine, theirs = two_runs()
    file = written(tmp_path / "mine.txt", "a person", level, mine)
    other = written(tmp_path / "theirs.txt", "a tool", level, theirs)
    opened = load_replays(file)[0].replay.playback(10**4).rstrip(b"\0")
    places = TasDriver(tmp_path / "places", file)
    cell = places.cell(8, "left")
    places.press("f")
    places.frames(2)
    what_for = places.button("Presets").centre
    left, top, _, _ = places.screen.tab.list.area  # type: ignore[attr-defined]
    places.close()
    with virtual_screen() as display:
        home = tmp_path / "home"
        home.mkdir()
        runner = Runner(display, home, root, "tas", str(file), "--against", str(other))
        try:
            # Take over, with a key that the run has not: ticks change, and undo brings all of them back at once.
            key = "Left" if sum(each & KEY_LEFT for each in mine[:40]) < 20 else "Right"
            runner.play(key)
            assert runner.edit("ctrl+z").inputs.rstrip(b"\0") == opened
            # A click changes a key.
            before = runner.track()
            runner.drag(cell)
            runner.wait_for(lambda: runner.track() != before, "edit by the mouse")
            runner.edit("ctrl+z")
            # Splice: everything from the other run.
            spliced = runner.edit("ctrl+a", "ctrl+p")
            assert exit_tick(level, spliced.inputs) == exit_tick(level, theirs)
            # Wait at the start for as long as a page, and let the search find that this is not needed.
            delayed = runner.edit("Home", "shift+Next", "i")
            slow = exit_tick(level, delayed.inputs)
            assert exit_tick(level, theirs) < slow < 10**6
            if compiled_available():
                runner.press("Home", "shift+Next", "shift+Next", "f")
                runner.drag(what_for)
                runner.press("Return")

                def a_result_is_in_the_run() -> bool:
                    runner.drag((left + 150, top + 8))
                    runner.catch_up()
                    found = runner.track()  # what only comes near stands in the list before there is a result
                    return found is not None and exit_tick(level, found.inputs) < slow

                runner.wait_for(a_result_is_in_the_run, "result of the search", seconds=LONGEST)
                found = runner.track()
                assert found is not None
                assert exit_tick(level, found.inputs) < slow
                slow = exit_tick(level, found.inputs)
            runner.press("ctrl+e", "ctrl+s", "Return")
            saved = tmp_path / "a-level.replay.txt"
            runner.wait_for(saved.exists, "saved run")
        finally:
            runner.game.kill()
            runner.game.wait(TIMEOUT)
    (recording,) = load_replays(saved)
    assert (recording.author, recording.replay.level_author) == ("", "a person")
    verify = [sys.executable, "-m", "ninja_game", "verify", str(saved)]
    done = subprocess.run(
        verify, env=os.environ | {"PYTHONPATH": str(root)}, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert exit_tick(level, recording.inputs) == slow
