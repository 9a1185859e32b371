"""Overlays that show how the world thinks: hitboxes, grid, edge states, rays, cells. They only read it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ninja_game.play.picture.stage import Stage

if TYPE_CHECKING:
    from ninja_game.play.level_view import LevelView


OVERLAY_ACTIONS = ("overlay_hitboxes", "overlay_grid", "overlay_edges", "overlay_rays", "overlay_cells")


class Overlays:
    """Those that are on."""

    def __init__(self) -> None:
        self.on: set[str] = set()

    def toggle(self, action: str) -> bool:
        """Switch the overlay of an action; whether it is one's."""
        if action not in OVERLAY_ACTIONS:
            return False
        self.on ^= {action}
        return True

    def draw(self, stage: Stage, view: LevelView) -> None:
        """Draw what is on."""
