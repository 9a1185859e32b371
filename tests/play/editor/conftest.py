"""A maker at the main menu, and one with a level in the editor."""

from collections.abc import Iterator
from pathlib import Path

import pygame
import pytest

from ninja_game.editor.draft import Draft
from ninja_game.editor.files import Source
from ninja_game.editor.stamp import Stamp, with_stamp
from ninja_game.play.editor import message_checks, message_picture
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.sim.level import Level
from ninja_game.ui.theme import Palette
from ninja_game.view.hud import Box, Hud
from ninja_game.view.sprites.thumbnail import thumbnail
from tests.support.level_maker import ROOM, Maker
from tests.support.message_page import DOORS, RIGHT, AtOnce


@pytest.fixture(name="maker")
def driver(tmp_path: Path) -> Iterator[Maker]:
    made = Maker(tmp_path)
    try:
        yield made
    finally:
        for screen in made.app.stack.screens:
            if isinstance(screen, EditorScreen):
                screen.session.certifier.stop()
                screen.session.close()
        made.close()


@pytest.fixture(name="room")
def maker_with_a_room(maker: Maker) -> Maker:
    maker.open("Editor")
    maker.editor.session.begin(Source(ROOM))
    maker.editor.follow_parts()
    maker.frames()
    return maker


@pytest.fixture(autouse=True)
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(message_checks, "NewestJob", AtOnce)


@pytest.fixture
def painted(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Palettes of the pictures that previews have had painted."""
    names: list[str] = []

    def paint(level: Level, palette: Palette, width: int, *, opened: bool) -> pygame.Surface:
        names.append(palette.name)
        return thumbnail(level, palette, width, opened=opened)

    monkeypatch.setattr(message_picture, "thumbnail", paint)
    return names


@pytest.fixture
def boxes(monkeypatch: pytest.MonkeyPatch) -> list[Box]:
    """Where messages of the level are drawn from now on."""
    made: list[Box] = []

    def draw(_: Hud, __: pygame.Surface, box: Box, *___: object) -> pygame.Rect:
        made.append(box)
        return pygame.Rect(0, 0, 1, 1)

    monkeypatch.setattr(Hud, "draw_message", draw)
    return made


@pytest.fixture
def doors(room: Maker, monkeypatch: pytest.MonkeyPatch) -> Maker:
    """In the level DOORS with a floor; RIGHT is known to pass it."""
    floor = Stamp(dict.fromkeys([(column, 23) for column in range(1, 32)], 1))
    draft = with_stamp(Draft(DOORS, "Doors", "me"), floor)
    room.editor.session.tools.history.change(draft)
    monkeypatch.setattr(type(room.editor.session), "certifying_inputs", property(lambda _: RIGHT))
    return room
