"""A level from nothing, in a real window with a real mouse and keys: drawn, tried, certified, saved, found, passed."""

from pathlib import Path

import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.formats.load import load_levels
from ninja_game.play.editor.view import LAYOUT
from ninja_game.play.menus.packs import PackScreen
from ninja_game.sim.kinds import DOOR
from tests.support.real_window import NEEDS_WINDOW, GuidedPlayer, Player, difference, guided_player
from tests.support.waiting import LONGEST

pytestmark = NEEDS_WINDOW


def at(column: float, row: float) -> tuple[float, float]:
    """The px of the window, in its size of 792 x 600, where the middle of a cell is seen."""
    left, top, width, _ = LAYOUT.level
    return left + (24 * column + 12) * width / 792, top + (24 * row + 12) * width / 792


def draw(maker: Player) -> None:
    """A floor, a wall with a locked door in it, its key and gold before it, the exit behind it."""
    maker.drag(at(1, 23), at(16, 23), at(31, 23))
    maker.drag(at(16, 1), at(16, 12), at(16, 21))
    maker.press("shift+n")
    maker.drag(at(3, 22))
    maker.press("shift+k")
    maker.drag(at(15.6, 22))
    maker.drag(at(8, 22))
    maker.press("shift+e")
    maker.drag(at(28, 22))
    maker.drag(at(22, 22))
    maker.press("shift+g")
    maker.drag(*(at(column, 22) for column in range(5, 13)))


@pytest.mark.slow
def test_a_level_from_nothing(tmp_path: Path, root: Path) -> None:
    with guided_player(tmp_path, root) as maker:
        maker.choose("Editor")
        maker.press_both("ctrl+n")
        maker.choose("Empty")  # instead of the room
        empty = maker.picture()
        draw(maker)
        assert maker.differs_from(empty) > 5000
        drawn = maker.picture()
        maker.press("F5", "space")
        standing = maker.still_picture()
        assert difference(standing, drawn) > 50_000
        maker.tool("keydown", "Right")
        maker.wait_for(lambda: maker.differs_from(standing) > 400, "ninja that is far away")
        maker.tool("keyup", "Right")
        maker.press("Escape")
        maker.catch_up()
        assert 50 < maker.differs_from(drawn) < 5000  # only the way of the try is new
        if compiled_available():
            before = maker.count("replay")
            maker.press("F7")
            maker.wait_for(lambda: kept_certificate(maker, before), "certificate", seconds=LONGEST)
        maker.press_both("ctrl+s")
        maker.choose("Save")
        path = tmp_path / "levels" / "my-level.txt"
        maker.wait_for(path.exists, "saved level")
        maker.choose("File", "Leave the editor", "Levels")
        maker.tool("type", "my level")  # is searched for
        maker.choose("Play")
        maker.press("space")
        maker.tool("keydown", "Right")
        maker.wait_for(lambda: maker.count("level_best") == 1, "pass")
        maker.tool("keyup", "Right")
    level = load_levels(path)[0].level
    assert sum(tile > 0 for tile in level.tiles) >= 30
    assert len(level.objects) >= 10
    assert [record.values[6] for record in level.objects if record.kind == DOOR] == [1.0]


@pytest.mark.slow
def test_a_pack_from_nothing(tmp_path: Path, root: Path) -> None:
    """A pack, an episode, a level drawn with a line of gold, a copy of it, and the copy dragged before it."""
    with guided_player(tmp_path, root) as maker:
        maker.choose("Levels", "Packs", "New pack...", "OK")
        folder = tmp_path / "levels" / "my-pack"
        maker.wait_for((folder / "pack.toml").exists, "pack")
        maker.press_both("Return")  # its episode
        maker.choose("New level...", "OK")
        level = folder / "new-level.txt"
        maker.wait_for(level.exists, "level")
        maker.drag(at(1, 23), at(16, 23), at(31, 23))
        maker.press("shift+n")
        maker.drag(at(3, 22))
        maker.press("shift+e")
        maker.drag(at(28, 22))
        maker.drag(at(22, 22))
        maker.press("shift+g")
        maker.choose("Line")
        maker.drag(at(5, 20), at(10, 20), at(15, 20))
        maker.press_both("ctrl+s")
        maker.choose("File", "Leave the editor")
        maker.wait_for(lambda: len(load_levels(level)[0].level.objects) == 13, "saved level")
        shelves = maker.guide.shown(PackScreen)
        left, top, width, height = shelves.shelves.row_area(1)
        maker.click((left + width / 2, top + height / 2))  # choose it, then what can be done with it
        maker.press_both("Return")
        maker.choose("Copy")
        copy = folder / "new-level-copy.txt"
        maker.wait_for(copy.exists, "copy")
        goal = (left + 0.2 * width, top + height / 2)  # its left half
        maker.drag((left + 1.5 * width, goal[1]), (left + 1.4 * width, goal[1]), (left + width / 2, goal[1]), goal)
        index = folder / "pack.toml"
        maker.wait_for(lambda: 0 < index.read_text().find(copy.name) < index.read_text().find(level.name), "order")


def kept_certificate(maker: GuidedPlayer, before: int) -> bool:
    """Ask the file menu to keep the solver's run; whether there is one more replay than before."""
    maker.choose("File", "Save the run that was found")
    maker.catch_up()
    return maker.count("replay") > before
