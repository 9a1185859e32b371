"""Where pygame-ce keeps gamepads with a standard layout."""

from .modules import controller as controller  # noqa: PLC0414 - pygame's name
