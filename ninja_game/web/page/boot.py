"""Starts the game in a page: ``import boot`` imports it, ``start`` builds it, ``turn`` makes each picture."""

from __future__ import annotations

import gc
import random
from time import perf_counter
from typing import Any

from pygame.host import LINK  # type: ignore[import-not-found]

from ninja_game.play.app import App, build_app
from ninja_game.play.main import first_screen

LONG_TURN = 0.02
"""A turn whose events and ticks take this many seconds, as one that opens a level, leaves the picture to the next."""


class _Game:
    """The game of the page. ``last``: the time of the last picture; ``due``: that of the next one, ms.

    ``top``: the screen it showed. ``late``: whether the last turn has left its picture to the next.
    """

    app: App
    last = due = 0.0
    top: Any = None
    late = False


def start(host: Any, level: str | None = None, replay: str | None = None) -> None:
    """Open the game in the page of ``host`` (host.js): the main menu, or a file of levels or replays."""
    LINK.page = host
    # A page may start from a memory snapshot, which contains the state of random numbers too.
    random.seed()
    first = first_screen(level, replay, body="circle", practice=False)
    _Game.app = build_app()
    _Game.app.push(first(_Game.app))
    # Play makes no cyclic garbage, and collecting takes longer than a frame: collect only when the screen changes.
    gc.collect()
    gc.freeze()
    gc.disable()
    resume()


def app() -> App:
    return _Game.app


def resume() -> None:
    """Continue after a time without turns, which does not count."""
    _Game.last = _Game.due = float(LINK.page.ticks())


def turn(now: float) -> bool:
    """Draw the picture that is due at a time in ms, if any; whether the game goes on."""
    app = _Game.app
    if _Game.late:
        _Game.late = False
        app.draw()
        return True
    limit = app.settings.frame_limit
    if limit:
        # Displays do not show frames quite evenly: a frame that comes a little early counts as due.
        if now < _Game.due - 2:
            return True
        _Game.due = max(_Game.due + 1000 / limit, now)
    elapsed_ms = int(now) - int(_Game.last)
    _Game.last = now
    started = perf_counter()
    app.advance(max(0, elapsed_ms))
    if not (app.running and app.stack):
        return False
    _Game.late = perf_counter() - started > LONG_TURN
    if _Game.late:
        return True
    app.draw()
    app.frame_ms = 1000 * (perf_counter() - started)
    if app.top is not _Game.top:
        _Game.top = app.top
        gc.collect()
    return True
