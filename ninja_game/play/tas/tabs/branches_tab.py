"""Branches."""

from __future__ import annotations

from ninja_game.play.tas.tabs.tab import Tab


class BranchesTab(Tab):
    """Branches."""

    name = "Branches"

    def look(self) -> tuple[object, ...]:
        """Nothing but its background."""
        return ()
