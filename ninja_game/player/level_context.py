"""What surrounds a level being played: title and lifetime, who runs along, what is saved, and what comes after it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from ninja_game.formats.pack.pars import Pars
from ninja_game.player.attempt import Attempt
from ninja_game.player.catalogue import Entry
from ninja_game.player.marks import next_par
from ninja_game.player.player_data import PlayerData
from ninja_game.player.saving import count_of, told
from ninja_game.sim.level import Level
from ninja_game.sim.rules import LIFETIME
from ninja_game.simulation import Body

YOUR_BEST = "your best"


@dataclass(frozen=True)
class GhostRun:
    """A recording that runs along: ``inputs``, one byte per tick as in demos; ``colour`` "#rrggbb" or the palette's."""

    label: str
    inputs: bytes
    colour: str = ""


class Navigation(Enum):
    """Where the player goes from a level."""

    SAME_LEVEL = "the level again"
    NEXT_LEVEL = "the level at which the context now stands"
    EPISODE_END = "what the episode has brought"
    BACK = "the screen from which the level was opened"


class LevelContext:
    """A level by itself, of a file, of an episode. Its subclasses, in ``playthrough``, say what follows.

    ``entry``: the level to play now. ``lifetime``: ticks at its start. ``notices``: of what was saved.
    """

    def __init__(self, data: PlayerData, entry: Entry, *, body: Body = "circle", practice_mode: bool = False) -> None:
        self.data = data
        self.entry = entry
        self.body: Body = body
        self.practice_mode = practice_mode
        self.lifetime = LIFETIME
        self.notices: list[str] = []
        self._ghosts: tuple[tuple[str, int], list[GhostRun]] = ("", -1), []

    @property
    def leads_on(self) -> bool:
        """Whether something else comes after this level is passed; else it begins again."""
        return True

    @property
    def title(self) -> str:
        """How the level is announced."""
        return self.entry.title

    @property
    def level(self) -> Level:
        return self.entry.named.level

    @property
    def pars(self) -> Pars | None:
        """The level's par times, which go by the classic body."""
        return self.entry.pars if self.body == "circle" else None

    def aim(self) -> str:
        """The next medal of the level and its par, in words; "" where there is none, or in practice."""
        if self.pars is None or self.practice_mode:
            return ""
        return next_par(self.pars, self.data.marks.of(self.entry.digest))

    @property
    def show_tutorial(self) -> bool:
        """Whether the keys are explained at its start: to a player who has passed no level yet."""
        return not self.data.statistics.played().passes

    def ghosts(self) -> list[GhostRun]:
        """The personal best; read again only when there is another one, since every retry asks."""
        best = self.data.records.level_best(self.entry.digest, self.body)
        wanted = self.entry.digest, best.id if best else -1
        if wanted != self._ghosts[0]:
            replay = self.data.records.replay(best.id) if best else None
            self._ghosts = wanted, [GhostRun(YOUR_BEST, replay.inputs)] if replay else []
        return self._ghosts[1]

    def passed(self, attempt: Attempt) -> list[str]:
        """Called once, right after the tick of the exit contact: saves; gives notices to show."""
        raise NotImplementedError

    def died(self, attempt: Attempt) -> None:
        """Called once per death: counts it."""
        told(self.data, count_of(self.data, self.entry, attempt, killer=attempt.killer))

    def gave_up(self, attempt: Attempt) -> None:
        """Called when an attempt is left or started again, whether it has ended or not: counts one that has not."""
        if attempt.outcome == "running" and attempt.simulation.tick:
            # Starting again must not wait for the disk.
            self.data.store.later(count_of(self.data, self.entry, attempt))

    def restart(self) -> bool:
        """Called when the level starts again; whether it is another one, since its file has changed.

        Raises NinjaGameError or OSError for a changed file that cannot be played; the level stays as it was.
        """
        return False

    def advance(self) -> Navigation:
        """Go on from this level, passed or (in practice) left out; NEXT_LEVEL: this context is at another one now."""
        return Navigation.SAME_LEVEL

    @property
    def way_out(self) -> Navigation:
        """Where leaving leads: BACK or EPISODE_END."""
        return Navigation.BACK
