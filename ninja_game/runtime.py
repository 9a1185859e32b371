"""Where the program runs: on a desktop, or in a page of a browser. The only module that knows."""

from __future__ import annotations

import sys
from collections.abc import Callable
from threading import Thread

IN_PAGE = sys.platform == "emscripten"
"""Whether this is a page, which has no threads, no compiler, no NumPy and no Pillow."""

ONLY_ON_A_DESKTOP = "only the program for the desktop can do that, not a page"


def beside(work: Callable[[], object]) -> Thread:
    """Do some work in a thread of its own. Where there are none, it is done when this comes back."""
    thread = Thread(target=work, daemon=True)
    if IN_PAGE:
        thread.run()
    else:
        thread.start()
    return thread
