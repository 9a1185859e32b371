"""Where the parts of the TAS editor are in a window of any size: half of a larger window goes to the text."""

from __future__ import annotations

from math import ceil
from typing import NamedTuple

from ninja_game.play.ui.canvas import HEIGHT, WIDTH, Canvas, Point
from ninja_game.play.ui.theme import Area

NARROWEST_LEFT, LOWEST_LEVEL, LOWEST_TABS, NARROWEST_ROLL = 424.0, 200.0, 150.0, 350.0
WIDEST_ROLL, USUAL_TABS = 460.0, 203.0
"""Where nothing else is wished, logical px."""

_HEAD, _FOOT, _STRIP = 26.0, 21.0, 18.0
_EDGE, _GAP, _THIN = 6.0, 3.0, 2.0
_ABOVE, _BELOW = _HEAD + _THIN, _FOOT + _GAP
_BETWEEN = _GAP + _STRIP + _THIN
"""From the level to the tabs."""


class LayoutPreferences(NamedTuple):
    """What the player has chosen, each a percentage or 0 for what suits the window.

    ``text_scale``: the size of a logical px; ``left``: the level's share of the width; ``tabs``: of the height.
    """

    text_scale: int = 0
    left: int = 0
    tabs: int = 0


class TasLayout(NamedTuple):
    """Logical px: areas of the parts. ``strip``: of the names of the tabs; ``notices``: a part of the foot."""

    size: Point
    head: Area
    level: Area
    strip: Area
    tabs: Area
    roll: Area
    foot: Area
    notices: Area


def tas_canvas(window: tuple[int, int], text_scale: int = 0) -> Canvas:
    """A canvas that fills the window. A logical px, and so the text, grows as the root of the window does.

    >>> [round(tas_canvas(size).scale, 2) for size in ((792, 600), (1920, 1080), (2560, 1440))]
    [1.0, 1.34, 1.55]
    """
    width, height = max(1, window[0]), max(1, window[1])
    largest = min(width / WIDTH, height / HEIGHT)
    scale = min(largest, text_scale / 100 if text_scale else largest**0.5)
    return Canvas((width, height), (width / scale, height / scale))


def tas_layout(size: Point, preferences: LayoutPreferences) -> TasLayout:
    """The areas in a window of this logical size, at least that of the stage.

    Level and tabs are at the left, the roll at the right. Where nothing is wished, the level is as large as the usual
    height of the tabs lets it be, and the roll has what that leaves of the width.
    """
    w, h = size
    shared = w - 3 * _EDGE
    high = h - _ABOVE - _BETWEEN - _BELOW
    roll = min(max(NARROWEST_ROLL, shared - (high - USUAL_TABS) * WIDTH / HEIGHT), WIDEST_ROLL)
    left = shared * preferences.left / 100 if preferences.left else shared - roll
    left = min(max(NARROWEST_LEFT, left), shared - NARROWEST_ROLL)
    tabs = high * preferences.tabs / 100 if preferences.tabs else max(USUAL_TABS, high - ceil(left * HEIGHT / WIDTH))
    tabs = min(max(LOWEST_TABS, tabs), high - LOWEST_LEVEL)
    top = _ABOVE + high - tabs
    aside = left + 2 * _EDGE
    return TasLayout(
        size,
        head=(0, 0, w, _HEAD),
        level=(_EDGE, _ABOVE, left, high - tabs),
        strip=(_EDGE, top + _GAP, left, _STRIP),
        tabs=(_EDGE, top + _BETWEEN, left, tabs),
        roll=(aside, _ABOVE, w - aside - _EDGE, h - _ABOVE - _BELOW),
        foot=(0, h - _FOOT, w, _FOOT),
        notices=(236, h - _FOOT, w - 236, _FOOT),
    )
