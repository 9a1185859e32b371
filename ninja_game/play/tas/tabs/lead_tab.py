"""Lead."""

from __future__ import annotations

from ninja_game.play.tas.tabs.tab import Tab


class LeadTab(Tab):
    """Lead."""

    name = "Lead"

    def look(self) -> tuple[object, ...]:
        """Nothing but its background."""
        return ()
