"""A level of the game on an app without a display, played by a script."""

from collections.abc import Iterator

import pytest

from ninja_game.formats.load import load_replays
from ninja_game.formats.recording import Recording
from ninja_game.play.app import App
from tests.support.own_pack import PACK, instead_of_ours
from tests.support.scripted import ScriptedControls, scripted_app

REPLAY = PACK / "certificates" / "00-0-run-and-hop.exit.replay.txt"


@pytest.fixture(autouse=True)
def levels_of_the_tests() -> Iterator[None]:
    """What the screens show does not change with the game's own levels."""
    with instead_of_ours():
        yield


@pytest.fixture(name="recording")
def recording_of_first_level() -> Recording:
    return load_replays(REPLAY)[0]


@pytest.fixture(name="stage")
def stage_with_app() -> Iterator[tuple[App, ScriptedControls]]:
    with scripted_app() as made:
        yield made


@pytest.fixture(name="app")
def app_of_the_stage(stage: tuple[App, ScriptedControls]) -> App:
    return stage[0]
