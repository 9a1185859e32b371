"""The scroll bar of the roll: where in the run the rows are, and where its gold, its exit and its markers are."""

from __future__ import annotations

import pygame

from ninja_game.play.tas.editor import TasEditor
from ninja_game.play.tas.roll.columns import RollLayout
from ninja_game.play.tas.roll.differences import compared, different_rows
from ninja_game.play.ui.theme import Theme, mixed
from ninja_game.tas.input_track import InputTrack


class ScrollBar:
    """``tick_at`` and ``draw`` measure along the whole run."""

    def __init__(self, editor: TasEditor) -> None:
        self._editor = editor
        self._known: tuple[InputTrack | None, int] = (None, -1)
        self._marks: list[tuple[int, str]] = []

    def _places(self) -> list[tuple[int, str]]:
        """Ticks with the palette's role of each one's mark."""
        timeline, track = self._editor.session.timeline, self._editor.track
        known = track, timeline.simulated_until
        if known != self._known:
            self._known = known
            end, outcome = timeline.end
            roles = (("gold-taken", "gold"), ("exit-opened", "exit"))
            self._marks = [
                *((tick, role) for tick, names in timeline.event_ticks for name, role in roles if name in names),
                *((tick, "ghost") for tick, _ in track.markers),
                *([(end, "good" if outcome == "exit" else "bad")] if end >= 0 else []),
            ]
        return self._marks

    def tick_at(self, y: int, layout: RollLayout) -> int:
        """The tick at a px of the bar."""
        share = (y - layout.bar.top) / layout.bar.height
        return int(min(1.0, max(0.0, share)) * self._editor.last_tick)

    def draw(self, surface: pygame.Surface, theme: Theme, layout: RollLayout, top: int) -> None:
        """The bar; ``top``: the first tick that has its row in the window."""
        palette, bar, editor = theme.palette, layout.bar, self._editor
        ticks = max(1, editor.last_tick + 1)

        def at(tick: int) -> int:
            return bar.top + min(bar.height - 1, tick * bar.height // ticks)

        surface.fill(mixed(palette.panel, palette.tile, 0.45), bar)
        known = at(editor.session.timeline.simulated_until) - bar.top
        surface.fill(mixed(palette.panel, palette.good, 0.17), (bar.left, bar.top, bar.width, known))
        first, last = at(top), at(top + layout.rows)
        window = pygame.Rect(bar.left, first, bar.width, max(theme.canvas.px(6), last - first))
        surface.fill(mixed(palette.panel, palette.tile, 0.6), window)
        begin, behind = editor.selection
        if behind - begin > 1:
            surface.fill(palette.bar_full, (bar.left, at(begin), bar.width // 2, max(1, at(behind) - at(begin))))
        other = compared(editor)
        if other is not None:
            wide, colour = bar.width // 4, other.colour(palette)
            for y in different_rows(editor.track.inputs, other.track.inputs, ticks, bar.height):
                surface.fill(colour, (bar.right - wide, bar.top + y, wide, 1))
        thick = theme.canvas.px(1.5)
        for tick, role in self._places():
            surface.fill(getattr(palette, role), (bar.left + bar.width // 4, at(tick), bar.width, thick))
        surface.fill(palette.accent, (bar.left, at(editor.cursor), bar.width, thick))
        pygame.draw.rect(surface, palette.panel_edge, window, 1)
        surface.fill(palette.panel_edge, (bar.left, bar.top, 1, bar.height))
