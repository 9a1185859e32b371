"""The scroll bar of the roll: where in the run the rows are, and where its gold, its exit and its markers are."""

from __future__ import annotations

import pygame

from ninja_game.play.tas.bench import Bench
from ninja_game.play.tas.roll.columns import Layout
from ninja_game.play.tas.roll.differences import compared, different_rows
from ninja_game.play.ui.palette import mixed
from ninja_game.play.ui.theme import Theme
from ninja_game.tas.take import Take


class ScrollBar:
    """``tick_at`` and ``draw`` measure along the whole run."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench
        self._known: tuple[Take | None, int] = (None, -1)
        self._marks: list[tuple[int, str]] = []

    def _places(self) -> list[tuple[int, str]]:
        """Ticks with the palette's role of each one's mark."""
        timeline, take = self._bench.session.timeline, self._bench.take
        known = take, timeline.valid
        if known != self._known:
            self._known = known
            end, outcome = timeline.end
            roles = (("gold-taken", "gold"), ("exit-opened", "exit"))
            self._marks = [
                *((tick, role) for tick, names in timeline.event_ticks for name, role in roles if name in names),
                *((tick, "ghost") for tick, _ in take.markers),
                *([(end, "good" if outcome == "exit" else "bad")] if end >= 0 else []),
            ]
        return self._marks

    def tick_at(self, y: int, layout: Layout) -> int:
        """The tick at a px of the bar."""
        share = (y - layout.bar.top) / layout.bar.height
        return int(min(1.0, max(0.0, share)) * self._bench.last_tick)

    def draw(self, surface: pygame.Surface, theme: Theme, layout: Layout, top: int) -> None:
        """The bar; ``top``: the first tick that has its row in the window."""
        palette, bar, bench = theme.palette, layout.bar, self._bench
        ticks = max(1, bench.last_tick + 1)

        def at(tick: int) -> int:
            return bar.top + min(bar.height - 1, tick * bar.height // ticks)

        surface.fill(mixed(palette.panel, palette.tile, 0.45), bar)
        known = at(bench.session.timeline.valid) - bar.top
        surface.fill(mixed(palette.panel, palette.good, 0.17), (bar.left, bar.top, bar.width, known))
        first, last = at(top), at(top + layout.rows)
        window = pygame.Rect(bar.left, first, bar.width, max(theme.canvas.px(6), last - first))
        surface.fill(mixed(palette.panel, palette.tile, 0.6), window)
        begin, behind = bench.selection
        if behind - begin > 1:
            surface.fill(palette.bar_full, (bar.left, at(begin), bar.width // 2, max(1, at(behind) - at(begin))))
        other = compared(bench)
        if other is not None:
            wide, colour = bar.width // 4, other.colour(palette)
            for y in different_rows(bench.take.inputs, other.take.inputs, ticks, bar.height):
                surface.fill(colour, (bar.right - wide, bar.top + y, wide, 1))
        thick = theme.canvas.px(1.5)
        for tick, role in self._places():
            surface.fill(getattr(palette, role), (bar.left + bar.width // 4, at(tick), bar.width, thick))
        surface.fill(palette.accent, (bar.left, at(bench.cursor), bar.width, thick))
        pygame.draw.rect(surface, palette.panel_edge, window, 1)
        surface.fill(palette.panel_edge, (bar.left, bar.top, 1, bar.height))
