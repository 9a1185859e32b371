"""What an examination of a level finds: the words, the places, and how to mend it."""

from __future__ import annotations

from typing import NamedTuple

Cell = tuple[int, int]
"""Column 1…31, row 1…23."""

MENDS = {
    "more than": "Take some away.",
    "there is no ninja": "Put one where the run begins.",
    "there is no exit": "Put an exit and its switch.",
    "ninjas: the last one plays": "Delete all but one.",
    "dies at once": "Move the mine or the ninja.",
    "create nothing": "Delete them, or keep them as they are.",
    "a tile id": "Draw another tile there.",
    "look at the ninja in turn": "Take some of them away, or expect slow ones.",
    "values where its kind needs": "Delete it and place it again.",
    "not a number": "Delete it and place it again.",
    "outside the grid": "Move it into the level, or delete it.",
    "in the border": "Move it into the level.",
    "inside a tile": "Move it, or clear the tile.",
    "inside a full tile": "Move it, or clear the tile.",
    "cannot reach": "Open a way to it, or move it.",
    "normal has length": "Choose one of the eight directions.",
    "direction is not": "Choose a direction.",
    "hangs the original game": "Move it into the level.",
    "does not stand on a solid floor": "Put it on a floor, or a tile below it.",
    "its weapon is not": "Choose a weapon.",
    "its movement is not": "Choose how it moves.",
    "its seeker flag": "Make it a zap drone, or no seeker.",
    "seeker flag is not": "Choose whether it seeks.",
    "closed in on all sides": "Clear a cell beside it.",
    "vertical flag is not": "Choose the side of its cell.",
    "trap or locked flag": "Choose what sort of door it is.",
    "locked and as trap": "Choose what sort of door it is.",
    "not between two cells": "Move it between two cells of the level.",
    "on the same side": "Delete one of the two.",
    "the tiles close this side": "Clear the tiles on both sides, or move the door.",
    "in this place already": "Delete one of the two.",
    "the tiles hide it": "Move it, or clear the tile.",
    "over a piece of gold": "Move one of the two.",
}
"""How to mend a finding, by words of its text."""


class Finding(NamedTuple):
    """Something odd. ``text``: what; ``records``: numbers of the records that it is about; ``cells``: of odd tiles.

    ``names``: how a text calls what it is about, '' where ``text`` says it.
    """

    text: str
    records: tuple[int, ...] = ()
    cells: tuple[Cell, ...] = ()
    names: str = ""

    @property
    def sentence(self) -> str:
        """Names and text as one line."""
        return f"{self.names}: {self.text}" if self.names else self.text

    @property
    def mend(self) -> str:
        """How to mend it, a sentence."""
        return next((advice for words, advice in MENDS.items() if words in self.text), "")

    @property
    def about_switch(self) -> bool:
        """Whether it is about the objects' switches rather than about themselves."""
        return "its switch" in self.text
