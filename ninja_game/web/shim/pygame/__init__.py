"""The part of pygame-ce's interface that the game uses, for a page: painter.js paints the drawings.

Functions without a docstring do what pygame-ce documents; tests/web compares them.
"""

from __future__ import annotations

from typing import Any

from . import constants, draw, event, mixer
from .color import Color
from .constants import *
from .event import Event
from .host import LINK, error
from .modules import Window, display, font, image, joystick, key, mouse, scrap, time, transform
from .rect import Rect
from .surface import BLEND_PREMULTIPLIED, BLEND_RGBA_MULT, BLEND_RGBA_SUB, SRCALPHA, Surface

globals().update(constants.KEY_CONSTANTS)
init = quit = register_quit = display.init


def __getattr__(name: str) -> Any:
    raise AttributeError(f"the page's pygame has no {name}")
