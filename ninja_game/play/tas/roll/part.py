"""The piano roll in the window."""

from __future__ import annotations

from functools import partial

import pygame

from ninja_game.play.menus.panels import Menu
from ninja_game.play.tas.editor import TasEditor, TasPart
from ninja_game.play.tas.roll.bar import ScrollBar
from ninja_game.play.tas.roll.columns import COLUMNS, RollLayout, layout_of
from ninja_game.play.tas.roll.commands import RollCommands
from ninja_game.play.tas.roll.differences import compared
from ninja_game.play.tas.roll.facts import row_facts
from ninja_game.play.tas.roll.mouse import RollMouse
from ninja_game.play.tas.roll.rows import RowSheet
from ninja_game.play.ui.theme import Theme
from ninja_game.play.workspace.part import Commands

MARGIN = 4
"""The rows scroll with a cursor that moves in the first or the last of so many parts of the roll."""


class Roll(TasPart):
    """One row per tick. ``top``: the first tick that is seen; ``hidden``: the names of columns that are not."""

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
        """Where things are in the window as it is now."""
        return layout_of(self.editor.theme.canvas, self.area, self.hidden)

    def scroll(self, top: int) -> None:
        """Have this tick at the upper edge, as far as there are ticks."""
        self.top = max(0, min(top, self.editor.last_tick + 1 - self.layout.rows))

    def follow(self) -> None:
        """Scroll with the cursor where it comes near the edge, and to it where it is out of sight."""
        cursor, rows = self.editor.cursor, self.layout.rows
        moved, self._followed = cursor - self._followed, cursor
        # With the cursor there, ``lowest`` to ``highest`` are the first ticks that leave room above and below it.
        lowest, highest = cursor + 1 + rows // MARGIN - rows, cursor - rows // MARGIN
        if moved and not self.top <= cursor < self.top + rows:
            near = abs(moved) <= rows
            self.top = min(max(self.top, lowest), highest) if near else cursor - rows // 2
        elif moved > 0:
            self.top = max(self.top, min(lowest, self.top + moved))
        elif moved < 0:
            self.top = min(self.top, max(highest, self.top + moved))
        self.scroll(self.top)

    def stay(self) -> None:
        """Take the cursor's present tick as seen: no row moves under the mouse."""
        self._followed = self.editor.cursor

    def choose_columns(self) -> None:
        """Ask which columns are shown."""

        def switch(name: str) -> None:
            self.hidden = self.hidden ^ {name}
            self.choose_columns()

        rows = [
            (f"{each.meaning}: {'hidden' if each.name in self.hidden else 'shown'}", partial(switch, each.name), "")
            for each in COLUMNS
            if each.meaning
        ]
        self.editor.app.push(Menu(self.editor.app, "Columns", [*rows, ("Done", lambda: None, "")]))

    # --- a part of the window ---

    def render_key(self) -> tuple[object, ...]:
        """Runs, cursor, selection, what is simulated and what is seen of it."""
        editor = self.editor
        timeline = editor.session.timeline
        return (
            editor.track, editor.session.saved, compared(editor), editor.cursor, editor.selection,
            timeline.simulated_until, self.top, self.hidden,
        )  # fmt: skip

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        """Heads, rows, scroll bar."""
        layout, other, palette = self.layout, compared(self.editor), theme.palette
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
        """Painting, selecting, scrolling."""
        return self.pointer.handle_mouse(event, *self.editor.theme.canvas.point(x, y))

    def update(self, real_ms: int) -> None:
        """A drag beyond the edge scrolls on; the cursor stays in sight."""
        self.pointer.update(real_ms)
        self.follow()

    def commands(self) -> Commands:
        """Moving and editing."""
        return self.edits.commands()
