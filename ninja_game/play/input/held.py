"""A key that is held and repeats what it does."""

from __future__ import annotations

from typing import Generic, TypeVar

import pygame

from ninja_game.play.input.keys import scancode_of

T = TypeVar("T")

LONGEST_STEP_MS = 50
"""More than this in one picture is a stall, which is not a long press: the release may be waiting behind it."""


class HeldKey(Generic[T]):
    """``what``: what the key that is held does, if it is one that repeats; else None."""

    def __init__(self) -> None:
        self.what: T | None = None
        self._key = self._again_in = self._every = 0

    def begin(self, what: T, scancode: int = 0, *, first: int, every: int) -> None:
        """It was done; its key is down. It comes again after ``first`` ms, then every so many ms."""
        self.what, self._key, self._again_in, self._every = what, scancode, first, every

    def end(self) -> None:
        """Nothing repeats."""
        self.what = None

    def follow(self, event: pygame.Event) -> None:
        """It ends when its key is released."""
        if event.type == pygame.KEYUP and scancode_of(event) == self._key:
            self.end()

    def due(self, real_ms: int) -> list[T]:
        """What is to be done after so much more real time, once for each time."""
        self._again_in -= min(real_ms, LONGEST_STEP_MS)
        found = []
        while self.what is not None and self._again_in <= 0:
            self._again_in += self._every
            found.append(self.what)
        return found
