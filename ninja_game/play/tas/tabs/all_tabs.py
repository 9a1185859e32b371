"""All tabs of the TAS editor."""

from __future__ import annotations

from ninja_game.play.tas.editor import TasEditor
from ninja_game.play.tas.tabs.branches_tab import BranchesTab
from ninja_game.play.tas.tabs.lead_tab import LeadTab
from ninja_game.play.tas.tabs.search_tab import SearchTab
from ninja_game.play.tas.tabs.tab import Tab
from ninja_game.play.tas.tabs.values_tab import ValuesTab


def all_tabs(editor: TasEditor) -> list[Tab]:
    """All tabs, in order."""
    return [ValuesTab(editor), BranchesTab(editor), LeadTab(editor), SearchTab(editor)]
