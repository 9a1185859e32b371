"""The line above the TAS editor and the line below it: which run, where the cursor is, what was just done."""

from __future__ import annotations

from pathlib import Path

import pygame

from ninja_game.play.tas.editor import TasPart
from ninja_game.play.ui.theme import Theme
from ninja_game.sim.rules import TICKS_PER_SECOND


class Head(TasPart):
    """The run's name and file, and whether it is saved."""

    slot = "head"

    def render_key(self) -> tuple[object, ...]:
        session = self.editor.session
        return session.about.name, session.file.path, session.is_saved, session.timeline.end, session.journal.problem

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        session, palette, right = self.editor.session, theme.palette, self.area[2] - 8
        theme.canvas.fill_rect(surface, palette.tile, *self.area)
        end, outcome = session.timeline.end
        opened = Path(session.about.file).name
        where = ", on another level" * session.moved
        unsaved = f"{opened}{where}, to be saved as a new file" if opened else "no file yet"
        file = session.file.path.name if session.file.path else unsaved
        author = f" - {session.about.author}" if session.about.author else ""
        name = f"{session.about.name}{author}"
        title = theme.text(surface, name, 8, 6, size=13, bold=True, colour=palette.on_tile, width=right / 2 - 62)
        x = title.right / theme.canvas.scale + 12
        saved = "" if not session.file.path and session.is_saved else ", saved" if session.is_saved else ", not saved"
        state = session.journal.problem or file + saved
        theme.text(surface, state, x, 9, size=9.5, colour=palette.on_tile, width=right - 224 - x)
        words = {"exit": f"exit in tick {end}", "dead": f"dead in tick {end}"}.get(outcome, "no exit yet")
        seconds = f", {(end + 1) / TICKS_PER_SECOND:.3f} s" if end >= 0 else ""
        theme.text(surface, words + seconds, right, 8, size=11, bold=True, colour=palette.on_tile, align="right")


class Foot(TasPart):
    """Where the cursor is, what is selected, and a hint."""

    slot = "foot"

    def render_key(self) -> tuple[object, ...]:
        """Cursor, selection, the run's length, the hint."""
        editor = self.editor
        beside = editor.chosen, len(editor.others), editor.ghosts
        run = len(editor.track), editor.session.timeline.simulated_until
        return editor.cursor, editor.selection, run, editor.hint, beside

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        editor, palette, (_, y, w, _) = self.editor, theme.palette, self.area
        theme.canvas.fill_rect(surface, palette.tile, *self.area)
        first, last = editor.selection
        selected = f", {last - first} selected" if last - first > 1 else ""
        timeline = editor.session.timeline
        known = "" if timeline.complete else f", simulated up to {timeline.simulated_until}"
        other = editor.others[editor.chosen % len(editor.others)] if editor.others and editor.ghosts else None
        beside = f", beside {theme.fit(other.name, 110, 9.5)}" if other else ""
        text = f"tick {editor.cursor} of {len(editor.track)}{selected}{known}{beside}"
        theme.text(surface, text, 8, y + 5, size=9.5, colour=palette.on_tile)
        hint = editor.hint or "Click L R J to change keys; Enter: take over; F: search; F1: help"
        room = w - 28 - theme.width(text, 9.5)
        theme.text(surface, hint, w - 8, y + 5, size=9.5, colour=palette.on_tile, align="right", width=room)
