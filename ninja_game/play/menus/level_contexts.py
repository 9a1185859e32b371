"""Levels in their context, with records behind them: single levels, time trials, episodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ninja_game.formats.named_level import NamedLevel
from ninja_game.play.level.context import Course, GhostRun
from ninja_game.play.screen import Screen
from ninja_game.player.attempt import Attempt
from ninja_game.player.catalogue import Entry, Episode
from ninja_game.player.player_data import PlayerData
from ninja_game.player.playthrough import EpisodeRun, LevelRun
from ninja_game.simulation import Body

if TYPE_CHECKING:
    from ninja_game.play.app import App

YOUR_BEST = "your best"


def _is_new(player: PlayerData) -> bool:
    """Whether the player has passed no level yet."""
    return not player.statistics.played().passes


class BestGhost:
    """The personal best of a level as a ghost; read again only when there is another one, since every retry asks."""

    def __init__(self, player: PlayerData, entry: Entry) -> None:
        self.player = player
        self.entry = entry
        self._id = -1
        self._runs: list[GhostRun] = []

    def runs(self) -> list[GhostRun]:
        """The ghost; none without a best."""
        best = self.player.records.level_best(self.entry.digest)
        if best is not None and best.id != self._id:
            replay = self.player.records.replay(best.id)
            self._runs = [GhostRun(YOUR_BEST, replay.inputs)] if replay else []
            self._id = best.id
        return self._runs


class LevelCourse:
    """A level by itself, played again and again; its personal best runs along and is saved."""

    body: Body = "circle"

    def __init__(self, player: PlayerData, entry: Entry, *, practice: bool = False) -> None:
        self._run = LevelRun(player, entry, practice=practice)
        self.player = player
        self.entry = entry
        self.title = entry.title
        self.level = entry.named.level
        self.lifetime = self._run.lifetime
        self.practice = practice
        self.lesson = _is_new(player)
        self._best = BestGhost(player, entry)

    def ghosts(self) -> list[GhostRun]:
        """The personal best."""
        return self._best.runs()

    def passed(self, attempt: Attempt) -> list[str]:
        """Save; what to tell the player about it."""
        return self._run.passed(attempt)

    def died(self, attempt: Attempt) -> None:
        """Count it."""
        self._run.died(attempt)

    def gave_up(self, attempt: Attempt) -> None:
        """Count it."""
        self._run.gave_up(attempt)

    def onward(self) -> Course | None:
        """The same level again."""
        return self

    def leaving(self) -> Screen | None:
        """Back to where we came from."""
        return None


class EpisodeCourse:
    """A level of an episode: what comes after it is the next one, with the lifetime that is left."""

    body: Body = "circle"

    def __init__(self, app: App, run: EpisodeRun) -> None:
        self.app = app
        self.run = run
        self.entry = run.entry
        self.title = run.episode.title(run.level)
        self.level = run.entry.named.level
        self.lifetime = run.lifetime
        self.practice = run.practice
        self._passed: Attempt | None = None
        self._notices: list[str] = []
        self.lesson = _is_new(run.data)
        self._best = BestGhost(run.data, run.entry)

    def ghosts(self) -> list[GhostRun]:
        """The personal best of this level."""
        return self._best.runs()

    def passed(self, attempt: Attempt) -> list[str]:
        """Save; what to tell the player about it."""
        self._passed = attempt
        self._notices = self.run.passed(attempt)
        return self._notices

    def died(self, attempt: Attempt) -> None:
        """Count it."""
        self.run.died(attempt)

    def gave_up(self, attempt: Attempt) -> None:
        """Count it."""
        self.run.gave_up(attempt)

    def onward(self) -> Course | None:
        """The next level, in practice also without passing this one; after the last one None."""
        if self._passed is not None:
            more = self.run.advance(self._passed)
        else:
            more = self.practice and self.run.skip()
        return EpisodeCourse(self.app, self.run) if more else None

    def leaving(self) -> Screen | None:
        """After the last level: what was achieved. Else back to the grid."""
        if self._passed is None or not self.run.is_last:
            return None
        from ninja_game.play.menus.episode_passed import EpisodePassed

        return EpisodePassed(self.app, self.run, self._notices, episode_course)


def episode_course(app: App, player: PlayerData, episode: Episode) -> EpisodeCourse:
    """An episode from its first level on, in practice mode if that is set."""
    return EpisodeCourse(app, EpisodeRun(player, episode, practice=player.settings.practice))


def course_for(app: App, named: NamedLevel, *, practice: bool = False) -> Course:
    """A level of any file as a course with records."""
    player = app.player
    return LevelCourse(player, Entry(named, "yours"), practice=practice or player.settings.practice)
