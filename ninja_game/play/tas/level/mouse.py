"""The mouse over the level: it goes along the run, shows the level larger and moves it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pygame

from ninja_game.play.tas.level.pointing import nearest_tick, object_at
from ninja_game.play.tas.tabs.object_list import proposal
from ninja_game.sim.kinds import KIND_NAMES

if TYPE_CHECKING:
    from ninja_game.play.tas.level.part import LevelPart

_STILL = 3
"""The mouse that moves less, px, clicks."""

Px = tuple[int, int]


class LevelPointer:
    """What the mouse is doing in the level."""

    def __init__(self, part: LevelPart) -> None:
        self._part = part
        self._editor = part.editor
        self._goes = False
        self._grabbed: Px | None = None
        self._moved = False

    @property
    def busy(self) -> bool:
        """Whether it goes along the run, or moves the picture."""
        return self._goes or self._grabbed is not None

    def release(self) -> None:
        """What is going on ends."""
        self._goes, self._grabbed = False, None

    def handle_mouse(self, event: pygame.Event, x: float, y: float) -> None:
        """A mouse event at logical px of the window."""
        rect = self._editor.theme.canvas.rect(*self._part.area)
        left, top = self._editor.theme.canvas.point(x, y)
        at = left - rect.left, top - rect.top
        if event.type == pygame.MOUSEMOTION and not any(event.buttons):
            self.release()
        if event.type == pygame.MOUSEWHEEL:
            self._wheel(event.y, rect.size, at)
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button in (pygame.BUTTON_MIDDLE, pygame.BUTTON_RIGHT):
            self._grabbed, self._moved = at, False
        elif event.type == pygame.MOUSEMOTION and self._grabbed is not None:
            self._drag(rect.size, at)
        elif event.type == pygame.MOUSEBUTTONUP and self._grabbed is not None:
            self._click(event.button)
        elif event.type == pygame.MOUSEBUTTONUP:
            self.release()
        elif not self._part.take_over.on:
            self._point(event, at)

    def _wheel(self, notches: float, size: Px, at: Px) -> None:
        part = self._part
        if not pygame.key.get_mods() & pygame.KMOD_CTRL:
            part.picture.camera.zoom_at(size, at, notches)
        elif not part.take_over.on:
            part.playing.step(-round(notches))

    def _drag(self, size: Px, at: Px) -> None:
        if self._grabbed is None:
            return
        dx, dy = at[0] - self._grabbed[0], at[1] - self._grabbed[1]
        self._moved = self._moved or max(abs(dx), abs(dy)) > _STILL
        if self._moved:
            self._part.picture.camera.move(size, dx, dy)
            self._grabbed = at

    def _click(self, button: int) -> None:
        """A button that was down without a drag is up again."""
        part, moved = self._part, self._moved
        self.release()
        if moved or part.take_over.on:
            return
        if button == pygame.BUTTON_MIDDLE:
            part.picture.camera.show_all()
        elif part.pointed is not None:
            part.ask_to_watch(proposal(part.pointed.id, KIND_NAMES.index(part.pointed.kind)))

    def _point(self, event: pygame.Event, at: Px) -> None:
        """Tell what is there; a click, or a drag, goes to the tick in which the ninja was nearest."""
        part, editor = self._part, self._editor
        positions = editor.session.timeline.positions
        if not len(positions):
            return
        place = part.picture.canvas.logical(at)
        dragged = event.type == pygame.MOUSEMOTION and bool(event.buttons[0])
        pressed = event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_LEFT
        tick = nearest_tick(positions, *place, editor.cursor, dragged=dragged)
        part.point_at(tick, None if dragged else object_at(part.picture.run, *place))
        found = part.pointed
        words = f"{found.kind} {found.id}; right button: watch it   " if found else ""
        zoomed = part.picture.camera.zoom > 1
        editor.hint = f"{words}Click: to tick {tick}; wheel: zoom{', right button: move, 0: all' if zoomed else ''}"
        self._goes = dragged or pressed
        if self._goes:
            part.playing.stop()
            editor.go(tick, select=bool(pygame.key.get_mods() & pygame.KMOD_SHIFT))
