"""The mouse in the roll: keys are painted, ticks selected, rows scrolled."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pygame

from ninja_game.play.tas.roll.columns import Column
from ninja_game.play.tas.roll.differences import compared
from ninja_game.play.tas.roll.facts import in_words, keys_in_words, row_facts

if TYPE_CHECKING:
    from ninja_game.play.tas.roll.part import Roll

WHEEL_ROWS = 4
SCROLL_MS = 25
"""Beyond the edge a row comes after so many ms for each row that the pointer is beyond it, but for four at most."""
DOUBLE_MS = 400
LEFT, RIGHT = 1, 3


class RollMouse:
    """What the mouse is doing in the roll: "paint", "select", "scroll" or nothing."""

    def __init__(self, roll: Roll) -> None:
        self._roll = roll
        self._editor = roll.editor
        self._doing = ""
        self._key, self._down = 0, False
        self._tick = 0
        self._at = (0, 0)
        self._waited = 0
        self._clicked = (-1, -DOUBLE_MS)
        self._told = ""

    def handle_mouse(self, event: pygame.Event, x: int, y: int) -> bool:
        """A mouse event at a px; whether it was used."""
        self._at = x, y
        if event.type == pygame.MOUSEWHEEL:
            self._wheel(event.y)
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button in (LEFT, RIGHT):
            self._press(event.button, x, y)
        elif event.type == pygame.MOUSEBUTTONUP and event.button in (LEFT, RIGHT):
            self.stop()
        elif event.type == pygame.MOUSEMOTION:
            if self._doing and not any(event.buttons):
                self.stop()
            self._go_on()
        self._tell(x, y)
        return True

    def stop(self) -> None:
        """What is going on ends; painting is one edit."""
        if self._doing == "paint":
            self._editor.session.end()
        self._doing = ""

    def update(self, real_ms: int) -> None:
        """Scroll on while the pointer is beyond the upper or lower edge; what is told of a row stays true."""
        if self._told and self._editor.hint == self._told:
            self._tell(*self._at)
        if self._doing not in ("paint", "select"):
            return
        layout = self._roll.layout
        row = layout.row_at(self._at[1])
        beyond = row if row < 0 else max(0, row + 1 - layout.rows)
        self._waited += real_ms * min(4, abs(beyond))
        if not beyond:
            self._waited = 0
        elif self._waited >= SCROLL_MS:
            rows, self._waited = divmod(self._waited, SCROLL_MS)
            self._roll.scroll(self._roll.top + (rows if beyond > 0 else -rows))
            self._go_on()

    def _tick_at(self, y: int) -> int:
        """The tick whose row is at a px; beyond the edges the first or last one that is seen."""
        layout = self._roll.layout
        row = min(max(0, layout.row_at(y)), layout.rows - 1)
        return min(self._roll.top + row, self._editor.last_tick)

    def _wheel(self, notches: float) -> None:
        editor = self._editor
        if pygame.key.get_mods() & pygame.KMOD_CTRL:
            editor.go(editor.cursor - round(notches))
        else:
            self._roll.scroll(self._roll.top - round(notches * WHEEL_ROWS))
            self._go_on()

    def _press(self, button: int, x: int, y: int) -> None:
        self.stop()
        layout, tick = self._roll.layout, self._tick_at(y)
        column = layout.column_at(x)
        if layout.heads.collidepoint(x, y):
            if button == LEFT:
                self._roll.choose_columns()
        elif x >= layout.bar.left:
            self._doing = "scroll"
            self._go_on()
        elif column.key:
            self._paint(column, tick, lift=button == RIGHT)
        elif button == LEFT:
            self._select(column, tick)

    def _paint(self, column: Column, tick: int, *, lift: bool) -> None:
        """Begin to paint: the key goes up where it is down, else down."""
        self._key = column.key
        self._down = not lift and not self._editor.track.keys_at(tick) & column.key
        self._doing, self._tick = "paint", tick
        self._editor.session.begin()
        self._stroke(tick)

    def _select(self, column: Column, tick: int) -> None:
        """Begin to select; a second click names a tick."""
        now = pygame.time.get_ticks()
        twice = self._clicked[0] == tick and now - self._clicked[1] < DOUBLE_MS
        self._clicked = tick, now
        if column.name == "tick" and twice:
            self._roll.edits.name_tick()
            return
        self._editor.go(tick, select=bool(pygame.key.get_mods() & pygame.KMOD_SHIFT))
        self._roll.stay()
        self._doing = "select"

    def _go_on(self) -> None:
        """Paint, select or scroll up to where the pointer is."""
        if self._doing == "scroll":
            self._roll.scroll(self._roll.bar.tick_at(self._at[1], self._roll.layout) - self._roll.layout.rows // 2)
            return
        tick = self._tick_at(self._at[1])
        if self._doing == "select" and tick != self._editor.cursor:
            self._editor.go(tick, select=True)
            self._roll.stay()
        elif self._doing == "paint" and not self._editor.session.history.in_stroke:
            self.stop()
        elif self._doing == "paint" and tick != self._tick:
            self._stroke(tick)

    def _stroke(self, tick: int) -> None:
        """Paint from where the stroke is up to a tick."""
        first, last = min(tick, self._tick), max(tick, self._tick) + 1
        if not self._down:
            last = min(last, len(self._editor.track))
        if first < last:
            self._editor.edit(lambda track: track.with_key(first, last, self._key, down=self._down))
        self._tick = tick

    def _tell(self, x: int, y: int) -> None:
        """Say in the line below what is under the pointer, in full."""
        layout = self._roll.layout
        column = layout.column_at(x)
        if layout.heads.collidepoint(x, y):
            self._editor.hint = f"{column.meaning or column.head}; click: choose columns"
        elif x >= layout.bar.left:
            self._editor.hint = f"tick {self._roll.bar.tick_at(y, layout)}"
        elif layout.body.collidepoint(x, y) and layout.row_at(y) + self._roll.top <= self._editor.last_tick:
            tick = self._tick_at(y)
            other = compared(self._editor) if column.key else None
            rest = column.name in ("state", "jump_timer", "contacts", "gold", "exit")
            row = row_facts(self._editor, tick, tick + 1)[0]
            self._editor.hint = keys_in_words(row, other.name) if other else in_words(row, numbers=not rest)
        self._told = self._editor.hint
