"""The piano roll in the window: its rows, its scroll bar, and the mouse that paints keys, selects and scrolls."""

from __future__ import annotations

from functools import partial

import pygame

from ninja_game.play.menu_screen import Menu, nothing
from ninja_game.play.workspace import Commands
from ninja_game.tas.tracks import InputTrack
from ninja_game.tas_editor.editor import TasEditor, TasPart
from ninja_game.tas_editor.roll.commands import RollCommands
from ninja_game.tas_editor.roll.facts import compared_run, different_rows, key_difference_text, row_facts, row_text
from ninja_game.tas_editor.roll.rows import ROLL_COLUMNS, Column, RollLayout, RowSheet, layout_of
from ninja_game.ui.text_entry import DOUBLE_MS
from ninja_game.ui.theme import Theme, mixed

_MARGIN = 4  # the rows scroll when the cursor is in the first or the last of this many parts of the roll

WHEEL_ROWS = 4
SCROLL_MS = 25  # ms per row of scrolling beyond the edge, for each row (at most four) between the edge and the pointer


class Roll(TasPart):
    """One row per tick. ``top``: the first visible tick; ``hidden``: the names of hidden columns."""

    slot = "roll"

    def __init__(self, editor: TasEditor) -> None:
        super().__init__(editor)
        self.top = 0
        self.hidden: frozenset[str] = frozenset()
        self._followed = 0
        self._sheet: RowSheet | None = None
        self.bar = ScrollBar(editor)
        self.edits = RollCommands(editor, lambda: self.layout.rows)
        self.pointer = RollMouse(self)

    @property
    def layout(self) -> RollLayout:
        return layout_of(self.editor.theme.canvas, self.area, self.hidden)

    def scroll(self, top: int) -> None:
        """Scroll until this tick is at the upper edge, at most to the last ticks."""
        self.top = max(0, min(top, self.editor.last_tick + 1 - self.layout.rows))

    def follow(self) -> None:
        """Scroll with the cursor near the edge, and to it when it is out of sight."""
        cursor, rows = self.editor.cursor, self.layout.rows
        moved, self._followed = cursor - self._followed, cursor
        # The first visible tick must be from ``lowest`` to ``highest`` for room above and below the cursor.
        lowest, highest = cursor + 1 + rows // _MARGIN - rows, cursor - rows // _MARGIN
        if moved and not self.top <= cursor < self.top + rows:
            near = abs(moved) <= rows
            self.top = min(max(self.top, lowest), highest) if near else cursor - rows // 2
        elif moved > 0:
            self.top = max(self.top, min(lowest, self.top + moved))
        elif moved < 0:
            self.top = min(self.top, max(highest, self.top + moved))
        self.scroll(self.top)

    def stay(self) -> None:
        """Do not scroll to the cursor: no row moves under the mouse."""
        self._followed = self.editor.cursor

    def choose_columns(self) -> None:

        def switch(name: str) -> None:
            self.hidden = self.hidden ^ {name}
            self.choose_columns()

        rows = [
            (f"{col.meaning}: {'hidden' if col.name in self.hidden else 'shown'}", partial(switch, col.name), "")
            for col in ROLL_COLUMNS
            if col.meaning
        ]
        self.editor.app.push(Menu(self.editor.app, "Columns", [*rows, ("Done", nothing, "")]))

    def render_key(self) -> tuple[object, ...]:
        editor = self.editor
        timeline = editor.session.timeline
        return (
            editor.track, editor.session.saved, compared_run(editor), editor.cursor, editor.selection,
            timeline.simulated_until, self.top, self.hidden, editor.leads,
        )  # fmt: skip

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        layout = self.layout
        other = compared_run(self.editor)
        palette = theme.palette
        mark = other.colour(palette) if other else palette.ghost
        sheet = self._sheet
        if sheet is None or sheet.theme is not theme or sheet.layout != layout or sheet.mark != mark:
            self._sheet = sheet = RowSheet(theme, layout, mark)
        sheet.draw(surface, row_facts(self.editor, self.top, min(self.top + layout.rows, self.editor.last_tick + 1)))
        self.bar.draw(surface, theme, layout, self.top)
        surface.fill(palette.tile, layout.heads)
        scale = theme.canvas.scale
        for place in layout.places:
            x = (place.left - theme.canvas.origin[0] + place.width / 2) / scale
            y = self.area[1] + 4
            theme.text(surface, place.column.head, x, y, size=8, colour=palette.on_tile, align="centre")
        theme.canvas.frame_rect(surface, palette.panel_edge, *self.area)

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        return self.pointer.handle_mouse(event, *self.editor.theme.canvas.point(x, y))

    def mouse_left(self) -> None:
        self.pointer.leave()

    def update(self, real_ms: int) -> None:
        self.pointer.update(real_ms)
        self.follow()

    def commands(self) -> Commands:
        return self.edits.commands()


class RollMouse:
    """The mouse in the roll: it does "paint", "select", "scroll" or nothing."""

    def __init__(self, roll: Roll) -> None:
        self._roll = roll
        self._editor = roll.editor
        self._doing = ""
        self._key, self._down = 0, False
        self._tick = 0
        self._at = (0, 0)
        self._waited = 0
        self._clicked, self._twice = (-1, -DOUBLE_MS), False
        self._over = False  # whether the mouse is over the roll: the hint tells what is there

    def handle_mouse(self, event: pygame.Event, x: int, y: int) -> bool:
        """A mouse event at a px; whether it was used."""
        self._at, self._over = (x, y), True
        if event.type == pygame.MOUSEWHEEL:
            self._wheel(event.y)
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button in (pygame.BUTTON_LEFT, pygame.BUTTON_RIGHT):
            self._press(event.button, x, y)
        elif event.type == pygame.MOUSEBUTTONUP and event.button in (pygame.BUTTON_LEFT, pygame.BUTTON_RIGHT):
            named, self._twice = self._twice and self._doing == "select", False
            self.stop()
            if named:
                self._roll.edits.name_tick()
        elif event.type == pygame.MOUSEMOTION:
            if self._doing and not any(event.buttons):
                self.stop()
            self._go_on()
        self._tell(x, y)
        return True

    def leave(self) -> None:
        self._over = False

    def stop(self) -> None:
        if self._doing == "paint":
            self._editor.session.end()
        self._doing = ""

    def update(self, real_ms: int) -> None:
        """Scroll while the pointer is beyond the upper or lower edge, and update the hint."""
        if self._over:
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
            if button == pygame.BUTTON_LEFT:
                self._roll.choose_columns()
        elif x >= layout.bar.left:
            self._doing = "scroll"
            self._go_on()
        elif column.key:
            self._paint(column, tick, lift=button == pygame.BUTTON_RIGHT)
        elif button == pygame.BUTTON_LEFT:
            self._select(column, tick)

    def _paint(self, column: Column, tick: int, *, lift: bool) -> None:
        """Begin to paint: release the key if it is down, else press it."""
        self._key = column.key
        self._down = not lift and not self._editor.track.keys_at(tick) & column.key
        self._doing, self._tick = "paint", tick
        self._editor.session.begin()
        self._stroke(tick)

    def _select(self, column: Column, tick: int) -> None:
        now = pygame.time.get_ticks()
        self._twice = column.name == "tick" and self._clicked[0] == tick and now - self._clicked[1] < DOUBLE_MS
        self._clicked = tick, now
        self._editor.go(tick, select=bool(pygame.key.get_mods() & pygame.KMOD_SHIFT))
        self._roll.stay()
        self._doing = "select"

    def _go_on(self) -> None:
        if self._doing == "scroll":
            self._roll.scroll(self._roll.bar.tick_at(self._at[1], self._roll.layout) - self._roll.layout.rows // 2)
            return
        tick = self._tick_at(self._at[1])
        if self._doing == "select" and tick != self._editor.cursor:
            self._clicked, self._twice = (-1, -DOUBLE_MS), False  # a drag is no click
            self._editor.go(tick, select=True)
            self._roll.stay()
        elif self._doing == "paint" and not self._editor.session.history.in_stroke:
            self.stop()
        elif self._doing == "paint" and tick != self._tick:
            self._stroke(tick)

    def _stroke(self, tick: int) -> None:
        first, last = min(tick, self._tick), max(tick, self._tick) + 1
        if not self._down:
            last = min(last, len(self._editor.track))
        if first < last:
            self._editor.edit(lambda track: track.with_key(first, last, self._key, down=self._down))
        self._tick = tick

    def _tell(self, x: int, y: int) -> None:
        layout = self._roll.layout
        column = layout.column_at(x)
        if layout.heads.collidepoint(x, y):
            self._editor.hint = f"{column.meaning or column.head}; click: choose columns"
        elif x >= layout.bar.left:
            self._editor.hint = f"tick {self._roll.bar.tick_at(y, layout)}"
        elif layout.body.collidepoint(x, y) and layout.row_at(y) + self._roll.top <= self._editor.last_tick:
            tick = self._tick_at(y)
            other = compared_run(self._editor) if column.key else None
            rest = column.name in ("state", "jump_timer", "contacts", "gold", "exit")
            row = row_facts(self._editor, tick, tick + 1)[0]
            self._editor.hint = key_difference_text(row, other.name) if other else row_text(row, numbers=not rest)


class ScrollBar:
    """The bar beside the piano roll: the whole run, with its marks. ``tick_at`` and ``draw`` measure along it."""

    def __init__(self, editor: TasEditor) -> None:
        self._editor = editor
        self._known: tuple[InputTrack | None, int] = (None, -1)
        self._marks: list[tuple[int, str]] = []

    def _places(self) -> list[tuple[int, str]]:
        """The marked ticks, with their colours' roles in the palette."""
        timeline, track = self._editor.session.timeline, self._editor.track
        state = track, timeline.simulated_until
        if state != self._known:
            self._known = state
            end, outcome = timeline.end
            roles = (("gold-taken", "gold"), ("exit-opened", "exit"))
            self._marks = [
                *((tick, role) for tick, names in timeline.event_ticks for name, role in roles if name in names),
                *((tick, "ghost") for tick, _ in track.markers),
            ]
            if end >= 0:
                self._marks.append((end, "good" if outcome == "exit" else "bad"))
        return self._marks

    def tick_at(self, y: int, layout: RollLayout) -> int:
        share = (y - layout.bar.top) / layout.bar.height
        return int(min(1.0, max(0.0, share)) * self._editor.last_tick)

    def draw(self, surface: pygame.Surface, theme: Theme, layout: RollLayout, top: int) -> None:
        palette, bar, editor = theme.palette, layout.bar, self._editor
        ticks = max(1, editor.last_tick + 1)

        def at(tick: int) -> int:
            return bar.top + min(bar.height - 1, tick * bar.height // ticks)

        surface.fill(mixed(palette.panel, palette.tile, 0.45), bar)
        height = at(editor.session.timeline.simulated_until) - bar.top
        surface.fill(mixed(palette.panel, palette.good, 0.17), (bar.left, bar.top, bar.width, height))
        first, last = at(top), at(top + layout.rows)
        window = pygame.Rect(bar.left, first, bar.width, max(theme.canvas.px(6), last - first))
        surface.fill(mixed(palette.panel, palette.tile, 0.6), window)
        begin, behind = editor.selection
        if behind - begin > 1:
            surface.fill(palette.bar_full, (bar.left, at(begin), bar.width // 2, max(1, at(behind) - at(begin))))
        other = compared_run(editor)
        if other is not None:
            width, colour = bar.width // 4, other.colour(palette)
            for y in different_rows(editor.track.inputs, other.track.inputs, ticks, bar.height):
                surface.fill(colour, (bar.right - width, bar.top + y, width, 1))
        thick = theme.canvas.px(1.5)
        for tick, role in self._places():
            surface.fill(getattr(palette, role), (bar.left + bar.width // 4, at(tick), bar.width, thick))
        surface.fill(palette.accent, (bar.left, at(editor.cursor), bar.width, thick))
        pygame.draw.rect(surface, palette.panel_edge, window, 1)
        surface.fill(palette.panel_edge, (bar.left, bar.top, 1, bar.height))
