"""An event of the window with what it means, decoded once by ``Bindings.decode``."""

from __future__ import annotations

from dataclasses import dataclass

import pygame


@dataclass(frozen=True)
class InputEvent:
    """What an event presses and releases.

    ``raw``: as SDL gave it. ``pressed``, ``released``: actions in play (``actions.ACTIONS``). ``menu``,
    ``menu_released``: what it means in menus (the values of ``MENU_KEYS``), "" if nothing. ``source``: the input that
    it presses, ("keys", "x") or ("pad", "a"); None for any other event.
    """

    raw: pygame.Event
    pressed: tuple[str, ...] = ()
    released: tuple[str, ...] = ()
    menu: str = ""
    menu_released: str = ""
    source: tuple[str, str] | None = None
