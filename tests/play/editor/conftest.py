"""A maker at the main menu, and one with a level in the editor."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from ninja_game.editor.files import Source
from ninja_game.play.editor.screen import EditorScreen
from tests.support.level_maker import ROOM, Maker


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
