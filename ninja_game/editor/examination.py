"""The problems of a level under edit, looked for in the background."""

from __future__ import annotations

from time import monotonic
from typing import NamedTuple

from ninja_game.levels.findings import Finding
from ninja_game.runs.problems import level_problems
from ninja_game.runtime import NewestJob
from ninja_game.sim.level import Level

UNREACHABLE_CODES = "unreachable", "unreachable-switch"
"""Codes of the findings about places that the ninja cannot reach."""

EXAMINATION_SPACING = 0.1  # least seconds between two examinations of the level


class LevelQuestion(NamedTuple):
    """A level to examine. ``obstacles``: what the solver has found; ``inputs``: of its known run, none without one."""

    level: Level
    obstacles: tuple[Finding, ...]
    says: str  #: its messages, as the header writes them
    inputs: bytes


class Examined(NamedTuple):
    """A level with what was found."""

    level: Level
    findings: list[Finding]


def examine_level(question: LevelQuestion) -> Examined:
    odd = level_problems(question.level, question.says, question.inputs)
    # An unreachable exit needs no finding of the solver too.
    out_of_reach = {number for finding in odd if finding.code in UNREACHABLE_CODES for number in finding.records}
    obstacles = [finding for finding in question.obstacles if not out_of_reach.intersection(finding.records)]
    return Examined(question.level, [*obstacles, *odd])


class Examination:
    """Examines a level again when it, or what is known about it, has changed."""

    def __init__(self) -> None:
        self.job = NewestJob(examine_level)
        self._asked: LevelQuestion | None = None
        self._asked_at = 0.0

    @property
    def findings(self) -> list[Finding]:
        """The findings of the last examination."""
        return self.job.result.findings if self.job.result else []

    @property
    def level(self) -> Level | None:
        """The level of the last examination."""
        return self.job.result.level if self.job.result else None

    def follow(self, question: LevelQuestion, *, at_once: bool = False) -> None:
        """Examine the level if anything in the question is new; within EXAMINATION_SPACING only if ``at_once``."""
        before, now = self._asked, monotonic()
        # Large values are compared by identity: this runs at every picture.
        same = before and question.level is before.level and question.obstacles is before.obstacles
        if not (before and same and question[2:] == before[2:]) and (
            at_once or now - self._asked_at >= EXAMINATION_SPACING
        ):
            self._asked, self._asked_at = question, now
            self.job.ask(question)
