"""Searches from the pointer of the level editor: what a ninja can reach from there, and the round of a drone."""

from __future__ import annotations

from ninja_game.editor.playtests import PathPoints, drone_round, round_of
from ninja_game.editor.reach import STARTS, Ask, Reach, find_reach
from ninja_game.editor.tools import EditorTools
from ninja_game.runtime import NewestJob
from ninja_game.sim.grid import is_inside
from ninja_game.sim.kinds import DRONE
from ninja_game.sim.level import Level, ObjectSpec, well_formed
from ninja_game.ui.widgets import next_option


class PointerSearches:
    """Searches in the background, begun again when the pointer or the level has changed."""

    def __init__(self) -> None:
        self.start = "off"  #: the ninja's state at the pointer when the search of its reach begins, of STARTS
        self.reaches = NewestJob(find_reach)
        self.rounds: NewestJob[Level, tuple[Level, PathPoints]] = NewestJob(lambda level: (level, round_of(level)))
        self._asked: Ask | None = None
        self._drone: tuple[Level, ObjectSpec | None] | None = None
        self._round: Level | None = None

    @property
    def reach(self) -> Reach | None:
        """The reach of a ninja at the pointer, or at the pointer's last place."""
        return self.reaches.result if self.start != "off" else None

    @property
    def drone_round(self) -> PathPoints:
        """The round of the drone that is selected, or in hand over the level."""
        level, places = self.rounds.result or (None, ())
        return places if level is self._round else ()

    def next_start(self) -> None:
        self.start = next_option(list(STARTS), self.start)
        self._asked = None

    def follow(self, tools: EditorTools) -> str:
        """Search from the pointer's present place; gives why the last search failed, "" if it did not."""
        self._follow_drone(tools)
        speed, problem = STARTS[self.start], self.reaches.problem
        if problem:
            self.start, self.reaches.problem = "off", ""
        elif speed is not None:
            ask, before = Ask(tools.draft, tools.pointer, speed), self._asked
            if before is None or before.draft is not ask.draft or before[1:] != ask[1:]:
                self._asked = ask
                self.reaches.ask(ask)
        return problem

    def _follow_drone(self, tools: EditorTools) -> None:
        in_hand = tools.brush.draws_objects and not tools.selection and tools.effective_tool.draws
        spec = tools.selected.chosen or (tools.placed(*tools.pointer) if in_hand and is_inside(tools.cell) else None)
        drone = spec if spec and spec.kind == DRONE and well_formed(spec) else None
        if (tools.draft.level, drone) != self._drone:
            self._drone = tools.draft.level, drone
            self._round = drone_round(tools.draft, drone) if drone else None
            if self._round:
                self.rounds.ask(self._round)
