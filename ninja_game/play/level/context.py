"""What surrounds a level being played: its title and lifetime, who runs along, and what comes after it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from ninja_game.errors import LevelError
from ninja_game.play.screen import Screen
from ninja_game.player.attempt import Attempt
from ninja_game.sim.level import Level
from ninja_game.sim.rules import LIFETIME
from ninja_game.simulation import Body, Simulation


@dataclass(frozen=True)
class GhostRun:
    """A recording that runs along: ``inputs``, a byte a tick as in demos; ``colour`` "#rrggbb" or the palette's."""

    label: str
    inputs: bytes
    colour: str = ""


class Course(Protocol):
    """A level in its context: single, of an episode, a time trial. ``lesson``: the keys are told at its start."""

    title: str
    level: Level
    body: Body
    lifetime: int
    practice: bool
    lesson: bool

    def ghosts(self) -> list[GhostRun]:
        """The recordings that run along."""

    def passed(self, attempt: Attempt) -> list[str]:
        """Called once, right after the tick of the exit contact: saves; gives notices to show."""

    def died(self, attempt: Attempt) -> None:
        """Called once per death."""

    def gave_up(self, attempt: Attempt) -> None:
        """Called when an attempt is left or begun anew, whether it has ended or not."""

    def onward(self) -> Course | None:
        """What to play when the player goes on from a passed level; None: leave."""

    def leaving(self) -> Screen | None:
        """What to show instead of the screen below when the level is left; None: just that."""


class SingleLevel:
    """A level by itself, without records; the last passing run of this session is its ghost."""

    def __init__(
        self, title: str, level: Level, *, body: Body = "circle", lifetime: int = LIFETIME, practice: bool = False
    ) -> None:
        self.title = title
        self.level = level
        self.body: Body = body
        self.lifetime = lifetime
        self.practice = practice
        self.lesson = False
        self.best: tuple[int, bytes] | None = None

    def ghosts(self) -> list[GhostRun]:
        """The best run of this session."""
        return [GhostRun("best", self.best[1])] if self.best else []

    def passed(self, attempt: Attempt) -> list[str]:
        """Keep the run if it is the best so far."""
        if attempt.assisted or (self.best and self.best[0] >= attempt.score):
            return []
        first = self.best is None
        self.best = attempt.score, bytes(attempt.inputs)
        return [] if first else ["Best run so far"]

    def died(self, attempt: Attempt) -> None:
        """Nothing is counted."""

    def gave_up(self, attempt: Attempt) -> None:
        """Nothing is counted."""

    def onward(self) -> Course | None:
        """The same level again."""
        return self

    def leaving(self) -> Screen | None:
        """Back to where we came from."""
        return None


def _is_playable(course: Course) -> bool:
    """Whether the course's level can be loaded; files may hold levels without a ninja."""
    try:
        Simulation(course.level, body=course.body)
    except LevelError:
        return False
    return True


class InOrder:
    """The levels of a file, one after the other; after the last one the first again. ``courses``: makes each."""

    def __init__(self, courses: Sequence[Callable[[], Course]], number: int = 0) -> None:
        self._courses = courses
        self._number = number
        self._course = courses[number]()
        self.title = self._course.title
        self.level = self._course.level
        self.body = self._course.body
        self.lifetime = self._course.lifetime
        self.practice = self._course.practice
        self.lesson = self._course.lesson

    def ghosts(self) -> list[GhostRun]:
        """Those of the present level."""
        return self._course.ghosts()

    def passed(self, attempt: Attempt) -> list[str]:
        """The present level's."""
        return self._course.passed(attempt)

    def died(self, attempt: Attempt) -> None:
        """The present level's."""
        self._course.died(attempt)

    def gave_up(self, attempt: Attempt) -> None:
        """The present level's."""
        self._course.gave_up(attempt)

    def onward(self) -> Course | None:
        """The next level of the file that can be played."""
        for step in range(1, len(self._courses) + 1):
            following = InOrder(self._courses, (self._number + step) % len(self._courses))
            if _is_playable(following):
                return following
        return None

    def leaving(self) -> Screen | None:
        """The present level's."""
        return self._course.leaving()
