"""Random edits of all sorts, by a session and by a window's own events."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import TYPE_CHECKING

import pygame

from ninja_game.tas.session import Session

if TYPE_CHECKING:
    from tests.support.tas_driver import TasDriver

MOST_BRANCHES = 6


def edit_at_random(session: Session, chance: Random, *, strokes: bool = True) -> None:
    """Any change that a session can make. ``strokes``: also edits of several changes, which a kill may tear."""
    track = session.track
    first = chance.randrange(len(track) + 2)
    what = chance.randrange(10)
    if what == 0 and len(session.branches) < MOST_BRANCHES:
        session.keep_branch("bé"[chance.randrange(2) :])
    elif what == 1 and len(session.branches):
        session.checkout_branch(chance.randrange(len(session.branches)))
    elif what == 2 and len(session.branches):
        (session.drop_branch if chance.random() < 0.5 else lambda n: session.rename_branch(n, "new"))(0)
    elif what == 3:
        session.undo()
    elif what == 4:
        session.redo()
    elif what == 5:
        session.change(track.named(first, f"n{chance.randrange(4)}"))
    elif what == 6 and strokes:
        session.begin()
        for tick in range(first, first + chance.randrange(6)):
            session.change(session.track.with_key(tick, tick + 1, chance.choice((1, 2, 4)), down=True))
        session.end()
    else:
        keys = [chance.randrange(8) for _ in range(chance.randrange(6))]
        # As many ticks in as out, on average: the run keeps about its length.
        session.change(track.replaced(first, first + chance.randrange(6), keys))


def _toggle_span(at: TasDriver) -> None:
    at.chord("pagedown", pygame.KMOD_LSHIFT)
    at.press("right")


EDITS: dict[str, Callable[[TasDriver, Random], object]] = {
    "a key toggled": lambda at, _: at.press("left"),
    "a key of a span toggled": lambda at, _: _toggle_span(at),
    "ticks put between": lambda at, _: at.press("insert"),
    "ticks taken out": lambda at, _: at.press("backspace"),
    "keys cleared": lambda at, _: at.press("delete"),
    "jump toggled": lambda at, _: at.press("z"),
    "undo": lambda at, _: at.chord("z", pygame.KMOD_LCTRL),
    "redo": lambda at, _: at.chord("y", pygame.KMOD_LCTRL),
    "a click on a key": lambda at, chance: at.drag(at.cell(at.editor.cursor, chance.choice(("left", "right", "jump")))),
    "a stroke over keys": lambda at, chance: at.drag(
        *(at.cell(at.editor.cursor + k, chance.choice(("left", "right"))) for k in range(4))
    ),
}
"""Edits by the window's own events, by name."""


def go_at_random(at: TasDriver, chance: Random) -> None:
    """Put the cursor on any tick, whose row is shown then."""
    at.editor.go(chance.randrange(at.editor.last_tick - 5))
    at.frames()


def use_at_random(at: TasDriver, chance: Random) -> str:
    """One edit of any sort at any tick; its name."""
    go_at_random(at, chance)
    name = chance.choice(list(EDITS))
    EDITS[name](at, chance)
    at.session.end()
    return name
