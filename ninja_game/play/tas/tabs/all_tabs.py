"""All tabs of the bench."""

from __future__ import annotations

from ninja_game.play.tas.bench import Bench
from ninja_game.play.tas.tabs.branches_tab import BranchesTab
from ninja_game.play.tas.tabs.lead_tab import LeadTab
from ninja_game.play.tas.tabs.search_tab import SearchTab
from ninja_game.play.tas.tabs.tab import Tab
from ninja_game.play.tas.tabs.values_tab import ValuesTab


def all_tabs(bench: Bench) -> list[Tab]:
    """All tabs, in order."""
    return [ValuesTab(bench), BranchesTab(bench), LeadTab(bench), SearchTab(bench)]
