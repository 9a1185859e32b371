"""What a page paints looks as what pygame-ce paints: twenty scenes over all palettes."""

import base64
from typing import Any

import numpy as np
import pygame
import pytest
from numpy.typing import NDArray

from benchmarks.busy import BusyRun, Restless, busy_level
from ninja_game.play.app import App, build_app
from ninja_game.ui.audio.player import AudioOutput
from ninja_game.ui.theme import PALETTES
from tests.support.page_scenes import Scene, scenes, show_scene
from tests.support.slow import the_rest_is_slow
from tests.support.web_page import BUSY, SCENES, SIZE, run_in

MAX_DIFFERENCE = 1.6
"""Mean difference of a channel, of 255: a page rounds faint layers down, a desktop up, so that rock is darker there."""
MAX_IN_A_CELL = 9.0
"""The same of a square of 24 px, of rock with a stone in it say; most sprites that are missing differ by more."""

ALL = scenes(busy_level, BusyRun, Restless)

START = """
import os, tempfile
os.environ["NINJA_GAME_HOME"] = tempfile.mkdtemp()
import boot
import js
boot.start(js.host)
NAMED = {scene[0]: scene for scene in scenes(busy_level, BusyRun, Restless)}
def show(name):
    show_scene(boot.app(), NAMED[name])
"""

PIXELS = """
(name) => {
  python.globals.get("show")(name);
  const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  let text = "";
  for (let k = 0; k < data.length; k += 32768) text += String.fromCharCode.apply(null, data.subarray(k, k + 32768));
  return btoa(text);
}
"""


@pytest.fixture(scope="module")
def app(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The game here, without a display."""
    app = build_app(tmp_path_factory.mktemp("player"), size=SIZE, audio_output=AudioOutput())
    yield app
    app.player.close()


@pytest.fixture(scope="module")
def page(python: Any) -> Any:
    """The game in the page, with a player as new as the one here: what one did, both did."""
    run_in(python, BUSY, SCENES)
    python.evaluate("text => { python.runPython(text); }", START)
    return python


def pixels(data: bytes) -> NDArray[np.int16]:
    """A picture's channels, without alpha."""
    return np.frombuffer(data, np.uint8).reshape(SIZE[1], SIZE[0], 4)[..., :3].astype(np.int16)


def test_scenes_are_twenty_over_all_palettes() -> None:
    assert len({name for name, *_ in ALL}) == 20
    assert {palette for _, palette, _ in ALL} == set(PALETTES)


@pytest.mark.parametrize("scene", the_rest_is_slow({scene[0]: scene for scene in ALL}, 10))
def test_a_scene_looks_as_it_does_here(scene: Scene, app: App, page: Any) -> None:
    show_scene(app, scene)
    here = pixels(pygame.image.tobytes(app.surface, "RGBA"))
    there = pixels(base64.b64decode(page.evaluate(PIXELS, scene[0])))
    assert here.std() > 1, "nothing is shown"
    difference = np.abs(here - there)
    assert difference.mean() <= MAX_DIFFERENCE
    cells = difference.reshape(SIZE[1] // 24, 24, SIZE[0] // 24, 24, 3).mean((1, 3, 4))
    assert cells.max() <= MAX_IN_A_CELL, f"row, column {divmod(int(cells.argmax()), SIZE[0] // 24)}"
