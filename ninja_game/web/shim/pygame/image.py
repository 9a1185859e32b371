"""Pictures as files."""

from __future__ import annotations

from base64 import b64decode
from typing import Any

from .display import flip, get_surface
from .host import LINK
from .surface import Surface


def save(surface: Surface, file: Any, namehint: str = "") -> None:
    """Write the picture of the screen as PNG; no other picture can be read back from the page."""
    if surface is not get_surface():
        raise NotImplementedError("only the screen can be saved in the page")
    flip()
    file.write(b64decode(LINK.page.picture()))
