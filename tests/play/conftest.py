"""A level of the game on an app without a display, played by a script."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from ninja_game.formats.load import load_replays
from ninja_game.formats.recording import Recording
from ninja_game.play.app import App
from tests.support.scripted import ScriptedControls, scripted_app

REPLAY = Path(__file__).parent.parent / "replays" / "01-first-steps.replay.txt"


@pytest.fixture(name="recording")
def recording_of_first_level() -> Recording:
    return load_replays(REPLAY)[0]


@pytest.fixture(name="stage")
def stage_with_app() -> Iterator[tuple[App, ScriptedControls]]:
    with scripted_app() as made:
        yield made
