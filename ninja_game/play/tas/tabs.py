"""The tabs below the level: watched values, branches, the lead over another run, searches."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import pygame

from ninja_game.play.tas.bench import Bench
from ninja_game.play.tas.part import Part
from ninja_game.play.ui.theme import Area, Theme
from ninja_game.play.ui.widgets import Widget


class Tab(Part):
    """A part with widgets of its own. ``stale``: its widgets are to be made anew."""

    name: ClassVar[str] = ""
    strip: ClassVar[Area] = (6, 353, 424, 18)
    area = (6, 373, 424, 203)

    def __init__(self, bench: Bench) -> None:
        super().__init__(bench)
        self.stale = False

    def build(self) -> Sequence[Widget]:
        """Its widgets."""
        self.stale = False
        return []

    def look(self) -> tuple[object, ...]:
        """Nothing but its background."""
        return ()

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        """Its background."""
        theme.panel(surface, *self.area)


class ValuesTab(Tab):
    """Values that are watched, and their course."""

    name = "Values"


class BranchesTab(Tab):
    """Takes that are kept, as a tree."""

    name = "Branches"


class LeadTab(Tab):
    """How far the run is ahead of another one."""

    name = "Lead"


class SearchTab(Tab):
    """Searches in the selected ticks."""

    name = "Search"


def all_tabs(bench: Bench) -> list[Tab]:
    """All tabs, in order."""
    return [ValuesTab(bench), BranchesTab(bench), LeadTab(bench), SearchTab(bench)]
