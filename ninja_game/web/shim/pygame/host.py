"""The page's side, host.js: it paints, plays sounds, reports events."""

from __future__ import annotations

from typing import Any


class error(RuntimeError):
    """A failure of the page."""


class PageLink:
    """The way to the page. ``page``: host.js, set at the start of the game."""

    page: Any = None


LINK = PageLink()
