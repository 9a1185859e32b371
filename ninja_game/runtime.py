"""Where the program runs: on a desktop, or in a page of a browser. The only module that knows."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Callable
from threading import Thread
from typing import TypeVar

from ninja_game.errors import NinjaGameError, reason

Value = TypeVar("Value")

IN_PAGE = sys.platform == "emscripten"
"""Whether this is a page, which has no threads, no compiler, no NumPy and no Pillow."""

FOLDER_HANDLES = os.open in os.supports_dir_fd and not IN_PAGE
"""Whether files can be opened below the handle of a folder."""

ONLY_ON_A_DESKTOP = "only the program for the desktop can make that, not a page"


def in_page_or_not(page: Value, desktop: Value) -> Value:
    """One of two values: that for a page, or that for a desktop."""
    return page if IN_PAGE else desktop


def require_desktop() -> None:
    """Raises NinjaGameError in a page."""
    if IN_PAGE:
        raise NinjaGameError(ONLY_ON_A_DESKTOP)


def run_in_background(work: Callable[[], object], failed: Callable[[str], object]) -> Thread:
    """Do some work in a thread of its own. Where there are none, it is done when this comes back.

    ``failed``: called there with a sentence for the user if the work raises anything at all; nobody waits for what has
    ended. The traceback of a fault of ours is on stderr.
    """

    def attempt() -> None:
        try:
            work()
        except BaseException as error:  # noqa: BLE001 - also what a library calls no Exception
            failed(reason(error))
            if not isinstance(error, (NinjaGameError, OSError, MemoryError)):
                traceback.print_exc()

    thread = Thread(target=attempt, daemon=True)
    if IN_PAGE:
        thread.run()
    else:
        thread.start()
    return thread
