"""The page's side, host.js: it paints, sounds, tells what happened."""

from __future__ import annotations

from typing import Any


class error(RuntimeError):
    """What the page cannot do."""


class Link:
    """``page``: host.js, which the start of the game gives."""

    page: Any = None


LINK = Link()
