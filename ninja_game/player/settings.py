"""What a player can choose, with what each choice may be and its default."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

DEFAULT_PALETTE = "classic"
DEFAULT_COLOUR = ""
"""The ninja's colour that comes with the palette."""

MOST_INPUTS = 16
"""Keys or buttons of one action at most."""

_SITE = re.compile(r"https?://[!-~]+")
_COLOUR = re.compile(r"#[0-9a-fA-F]{6}")

InputNames = Mapping[str, tuple[str, ...]]
"""Action to the names of its inputs (``play/input/bindings.py``)."""


@dataclass(frozen=True)
class Settings:
    """Every setting. ``keys`` and ``pad`` hold only the actions whose inputs are not the default ones.

    ``volume`` and ``loop_volume``: 0 to 99. ``dead_zone``: share of a stick's way that counts as rest. ``site``:
    address of the page with the game to which links lead, "" for none. ``ninja_colour``: "" or "#rrggbb".
    ``frame_limit``: pictures a second, 0: as the display. ``window_width`` and ``window_height``: px, 0: as it fits.
    Of the TAS editor: ``text_scale``, ``level_width`` and ``tabs_height`` in percent, 0: as it suits the window;
    ``play_speed`` in percent.
    """

    palette: str = DEFAULT_PALETTE
    ninja_colour: str = DEFAULT_COLOUR
    fullscreen: bool = False
    smooth: bool = True
    reduced_motion: bool = False
    reduced_gore: bool = False
    show_ghost: bool = True
    show_keys: bool = False
    show_frame_time: bool = False
    frame_limit: int = 0
    window_width: int = 0
    window_height: int = 0
    volume: int = 70
    loop_volume: int = 99
    text_scale: int = 0
    level_width: int = 0
    tabs_height: int = 0
    play_speed: int = 100
    practice: bool = False
    name: str = ""
    site: str = ""
    dead_zone: float = 0.35
    keys: InputNames = field(default_factory=dict)
    pad: InputNames = field(default_factory=dict)

    def changed(self, **values: Any) -> Settings:
        """These settings with some of them changed. Raises ValueError for a value that a setting cannot have."""
        for name, value in values.items():
            if not RULES[name].fits(value):
                raise ValueError(f"{name} is {value!r}; expected {RULES[name].expected}")
        return replace(self, **values)


class Rule(NamedTuple):
    """Where a setting stands in the file, and what it may be."""

    table: str
    fits: Callable[[Any], bool]
    expected: str


def _flag(table: str) -> Rule:
    return Rule(table, lambda value: isinstance(value, bool), "true or false")


def _whole(table: str, low: int, high: int) -> Rule:
    def fits(value: Any) -> bool:
        return isinstance(value, int) and not isinstance(value, bool) and low <= value <= high

    return Rule(table, fits, f"a whole number from {low} to {high}")


def _is_share(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and 0.05 <= value <= 0.95


def _is_name(value: Any) -> bool:
    return isinstance(value, str) and len(value) <= 40 and (not value or value.isprintable())


def _is_word(value: Any) -> bool:
    """A name in small letters; which palettes there are is known where they are drawn."""
    return isinstance(value, str) and re.fullmatch(r"[a-z-]{1,24}", value) is not None


def _is_site(value: Any) -> bool:
    return isinstance(value, str) and len(value) <= 200 and (not value or _SITE.fullmatch(value) is not None)


def _is_colour(value: Any) -> bool:
    return isinstance(value, str) and (value == DEFAULT_COLOUR or _COLOUR.fullmatch(value) is not None)


def _is_bindings(value: Any) -> bool:
    return isinstance(value, Mapping) and all(
        isinstance(action, str)
        and isinstance(inputs, (list, tuple))
        and len(inputs) <= MOST_INPUTS
        and all(isinstance(name, str) and name.isprintable() for name in inputs)
        for action, inputs in value.items()
    )


RULES = {
    "palette": Rule("look", _is_word, "the name of a palette, such as 'classic'"),
    "ninja_colour": Rule("look", _is_colour, "'' or a colour such as '#186285'"),
    "fullscreen": _flag("look"),
    "smooth": _flag("look"),
    "reduced_motion": _flag("look"),
    "reduced_gore": _flag("look"),
    "show_ghost": _flag("look"),
    "show_keys": _flag("look"),
    "show_frame_time": _flag("look"),
    "frame_limit": _whole("look", 0, 1000),
    "window_width": _whole("look", 0, 16384),
    "window_height": _whole("look", 0, 16384),
    "volume": _whole("sound", 0, 99),
    "loop_volume": _whole("sound", 0, 99),
    "text_scale": _whole("tas", 0, 400),
    "level_width": _whole("tas", 0, 99),
    "tabs_height": _whole("tas", 0, 99),
    "play_speed": _whole("tas", 10, 800),
    "practice": _flag("play"),
    "name": Rule("play", _is_name, "at most 40 printable characters"),
    "site": Rule("play", _is_site, "'' or an address such as 'https://example.org/game/'"),
    "dead_zone": Rule("pad", _is_share, "a number from 0.05 to 0.95"),
    "keys": Rule("", _is_bindings, "lists of names of keys, such as jump = ['z', 'lshift']"),
    "pad": Rule("", _is_bindings, "lists of names of buttons, such as jump = ['a']"),
}
"""By setting. Bindings are tables of their own: ``[keys]`` and ``[pad-buttons]``."""
