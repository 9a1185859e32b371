"""Random edits of all sorts, by a session and by a window's own events."""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import TYPE_CHECKING

import pygame

from ninja_game.tas.session import TasSession

if TYPE_CHECKING:
    from tests.support.tas_driver import TasDriver

MAX_BRANCHES = 6


def edit_at_random(session: TasSession, rng: Random, *, strokes: bool = True) -> None:
    """Any change that a session can make. ``strokes``: also edits of several changes, which a kill may tear."""
    track = session.track
    first = rng.randrange(len(track) + 2)
    what = rng.randrange(10)
    if what == 0 and len(session.branches) < MAX_BRANCHES:
        session.keep_branch("bé"[rng.randrange(2) :])
    elif what == 1 and len(session.branches):
        session.checkout_branch(rng.randrange(len(session.branches)))
    elif what == 2 and len(session.branches):
        (session.drop_branch if rng.random() < 0.5 else lambda n: session.rename_branch(n, "new"))(0)
    elif what == 3:
        session.undo()
    elif what == 4:
        session.redo()
    elif what == 5:
        session.change(track.named(first, f"n{rng.randrange(4)}"))
    elif what == 6 and strokes:
        session.begin()
        for tick in range(first, first + rng.randrange(6)):
            session.change(session.track.with_key(tick, tick + 1, rng.choice((1, 2, 4)), down=True))
        session.end()
    else:
        keys = [rng.randrange(8) for _ in range(rng.randrange(6))]
        # As many ticks in as out, on average: the run keeps about its length.
        session.change(track.replaced(first, first + rng.randrange(6), keys))


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
    "a click on a key": lambda at, rng: at.drag(at.cell(at.editor.cursor, rng.choice(("left", "right", "jump")))),
    "a stroke over keys": lambda at, rng: at.drag(
        *(at.cell(at.editor.cursor + k, rng.choice(("left", "right"))) for k in range(4))
    ),
}
"""Edits by the window's own events, by name."""


def go_at_random(at: TasDriver, rng: Random) -> None:
    """Put the cursor on any tick, whose row is shown then."""
    at.editor.go(rng.randrange(at.editor.last_tick - 5))
    at.frames()


def use_at_random(at: TasDriver, rng: Random) -> str:
    """One edit of any sort at any tick; its name."""
    go_at_random(at, rng)
    name = rng.choice(list(EDITS))
    EDITS[name](at, rng)
    at.session.end()
    return name
