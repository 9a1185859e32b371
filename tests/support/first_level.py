"""Somebody who makes a first level as docs/editor.md says, with mouse and keys."""

from collections.abc import Iterator
from pathlib import Path

from tests.support.level_maker import Maker, examine

STEPS = ("tiles", "objects", "test", "problem", "certified", "saved")


def play(maker: Maker, inputs: list[int], ticks: int) -> None:
    """Test the level with these inputs, and come back to it."""
    maker.press("f5")
    maker.keys.script = inputs
    maker.press("space")
    maker.frames(ticks)
    maker.press("escape")
    show(maker)


def show(maker: Maker) -> None:
    """Have the screen show what is drawn and what is wrong with it."""
    examine(maker.editor)
    maker.frames(2)


def first_level(maker: Maker) -> Iterator[str]:
    """Do the steps of the page. Yields the name of each, as in STEPS, when the screen shows what it has done."""
    maker.open("Editor")
    maker.press("9", "r")
    maker.drag((36, 468), (756, 564))
    maker.drag((396, 420), (564, 444))
    maker.drag((36, 36), (756, 108))
    show(maker)
    yield "tiles"
    maker.press("shift+n")
    maker.mouse(*maker.at(84, 444))
    maker.press("shift+e")
    maker.mouse(*maker.at(708, 444))
    maker.mouse(*maker.at(480, 396))
    show(maker)
    yield "objects"
    play(maker, [2] * 400, 120)
    yield "test"
    maker.press("shift+g")
    maker.mouse(*maker.at(300, 492))
    show(maker)
    maker.press("f4")
    maker.frames(2)
    yield "problem"
    maker.press("delete")
    play(maker, [2] * 55 + [6] * 20 + [2] * 200, 200)
    yield "certified"
    maker.editor.session.save(maker.player.folder / "levels" / "first.txt", name="My first")
    maker.leave_editor()
    maker.open("Levels")
    maker.frames(40)
    yield "saved"


def made_until(step: str, folder: Path) -> Maker:
    """A new player in ``folder`` who has just done a step of STEPS."""
    maker = Maker(folder)
    next(name for name in first_level(maker) if name == step)
    return maker
