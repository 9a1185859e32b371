"""Search."""

from __future__ import annotations

from ninja_game.play.tas.tabs.tab import Tab


class SearchTab(Tab):
    """Search."""

    name = "Search"

    def look(self) -> tuple[object, ...]:
        """Nothing but its background."""
        return ()
