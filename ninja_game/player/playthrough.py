"""What a passed level or a death means beyond it: bests, progress, statistics, lifetime (game.md §1.4, §2, §8).

A disk that is full or locked never ends the game: then the notice says that nothing was saved.
"""

from __future__ import annotations

import sqlite3
from contextlib import suppress

from ninja_game.formats.replay.text import Replay
from ninja_game.player.attempt import Attempt
from ninja_game.player.catalogue import Entry, Episode
from ninja_game.player.player_data import PlayerData
from ninja_game.player.progress import UNLOCKED
from ninja_game.player.scoring import seconds_text
from ninja_game.player.statistics import SELF, killer_of
from ninja_game.player.unlocks import new_unlocks
from ninja_game.sim.rules import LIFETIME

NEW_BEST = "Personal best {}: saved"
FIRST_PASS = "First time through, {}: saved"  # noqa: S105 - no password
EPISODE_BEST = "Episode best {}: saved"
NOT_SAVED = "It could not be saved: {}"


class LevelRun:
    """A level by itself (single level, time trial): every attempt starts with the full lifetime."""

    def __init__(self, data: PlayerData, entry: Entry, *, practice: bool = False) -> None:
        self.data = data
        self.entry = entry
        self.practice = practice
        self.lifetime = LIFETIME

    def passed(self, attempt: Attempt) -> list[str]:
        """Save what a passed attempt is worth; notices about it."""
        try:
            return self._save(attempt)
        except sqlite3.Error as error:
            return [NOT_SAVED.format(error)]

    def _save(self, attempt: Attempt) -> list[str]:
        with self.data.store.change():
            _count(self.data, self.entry, attempt, killer=None)
            return (
                [] if attempt.assisted else _save_best(self.data, attempt.replay(self.entry.title, _player(self.data)))
            )

    def died(self, attempt: Attempt) -> None:
        """Count a death."""
        _count_death(self.data, self.entry, attempt)


class EpisodeRun:
    """An episode from its first level on. ``level``: the present one, from 0; ``lifetime``: at its start, in ticks.

    ``legitimate``: neither practice nor a "cheated" episode; else nothing is a best and only "reached" moves on.
    """

    def __init__(self, data: PlayerData, episode: Episode, *, practice: bool = False, level: int = 0) -> None:
        self.data = data
        self.episode = episode
        self.practice = practice
        self.level = level
        self.lifetime = LIFETIME
        self.legitimate = not practice and level == 0 and data.progress.state(episode.number) == UNLOCKED
        self.score = 0
        self._replays: list[Replay] = []

    @property
    def entry(self) -> Entry:
        """The present level."""
        return self.episode.levels[self.level]

    @property
    def is_last(self) -> bool:
        """Whether the present level is the episode's last."""
        return self.level == len(self.episode.levels) - 1

    def passed(self, attempt: Attempt) -> list[str]:
        """Save what a passed attempt is worth, for its level and for the episode; notices about it."""
        legitimate = self.legitimate and not attempt.assisted
        self.legitimate = legitimate
        self.score = attempt.lifetime
        try:
            return self._save(attempt, legitimate=legitimate)
        except sqlite3.Error as error:
            return [NOT_SAVED.format(error)]

    def _save(self, attempt: Attempt, *, legitimate: bool) -> list[str]:
        with self.data.store.change():
            _count(self.data, self.entry, attempt, killer=None)
            place = self.episode.number, self.level
            self.data.progress.level_passed(place, levels=len(self.episode.levels), legitimate=legitimate)
            if not legitimate:
                return []
            replay = attempt.replay(self.entry.title, _player(self.data))
            self._replays = [*self._replays[: self.level], replay]
            notices = _save_best(self.data, replay)
            if self.is_last:
                notices += self._episode_passed()
        return notices

    def _episode_passed(self) -> list[str]:
        notices = []
        if self.data.records.episode_passed(self.episode.key, self.score, self._replays):
            notices.append(EPISODE_BEST.format(seconds_text(self.score)))
        return notices + new_unlocks(self.data.store, self.data.columns_complete, self.data.columns_present)

    def died(self, attempt: Attempt) -> None:
        """Count a death."""
        _count_death(self.data, self.entry, attempt)

    def advance(self, attempt: Attempt) -> bool:
        """Go on from a passed level with the lifetime at its exit; whether there is another level."""
        if self.is_last:
            return False
        self.level += 1
        self.lifetime = attempt.lifetime
        return True

    def skip(self) -> bool:
        """Leave the present level out (practice only); whether there is another one."""
        self.data.progress.level_passed(
            (self.episode.number, self.level), levels=len(self.episode.levels), legitimate=False
        )
        if self.is_last:
            return False
        self.level += 1
        return True


def _player(data: PlayerData) -> str:
    return data.settings.name


def _save_best(data: PlayerData, replay: Replay) -> list[str]:
    """Save a level's best; the notice for the player."""
    assert replay.level_digest  # noqa: S101 - attempts write it
    first = data.records.level_best(replay.level_digest, replay.body) is None
    if not data.records.level_passed(replay):
        return []
    best = data.records.level_best(replay.level_digest, replay.body)
    score = seconds_text(best.score) if best else ""
    return [(FIRST_PASS if first else NEW_BEST).format(score)]


def _count_death(data: PlayerData, entry: Entry, attempt: Attempt) -> None:
    killer = SELF if attempt.own_hand else killer_of(attempt.simulation.world)
    with suppress(sqlite3.Error):
        _count(data, entry, attempt, killer=killer)


def _count(data: PlayerData, entry: Entry, attempt: Attempt, *, killer: str | None) -> None:
    """Count an attempt that ended."""
    data.statistics.attempt_ended(
        entry.digest, killer=killer, passed=killer is None, ticks=max(attempt.ended_tick, 0), gold=attempt.gold
    )
