"""What a passed level or a death means beyond it: bests, progress, statistics, lifetime (game.md §1.4, §2, §8).

A disk that is full or locked never ends the game: then the notice says so, and saving is tried again.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from ninja_game.formats.replay.text import Replay
from ninja_game.player.attempt import Attempt
from ninja_game.player.catalogue import Entry, Episode
from ninja_game.player.player_data import PlayerData
from ninja_game.player.progress import UNLOCKED
from ninja_game.player.scoring import level_score, seconds_text
from ninja_game.player.statistics import SELF, killer_of
from ninja_game.player.store import Work
from ninja_game.player.unlocks import new_unlocks
from ninja_game.sim.rules import LIFETIME

SAVED = ": saved"
NEW_BEST = "Personal best {}" + SAVED
FIRST_PASS = "First time through, {}" + SAVED
EPISODE_BEST = "Episode best {}" + SAVED
REPLAY_KEPT = "Replay" + SAVED
NOT_SAVED = "Not saved yet: {}"


class LevelRun:
    """A level by itself (single level, time trial): every attempt starts with the full lifetime."""

    def __init__(self, data: PlayerData, entry: Entry, *, practice: bool = False) -> None:
        self.data = data
        self.entry = entry
        self.practice = practice
        self.lifetime = LIFETIME

    def passed(self, attempt: Attempt) -> list[str]:
        """Save what a passed attempt is worth; notices about it."""
        count = _count_of(self.data, self.entry, attempt, passed=True)
        replay = None if attempt.assisted else _replay(self.data, self.entry, attempt)

        def work() -> list[str]:
            count()
            return _save_best(self.data, replay) if replay else []

        return told(self.data, work)

    def died(self, attempt: Attempt) -> None:
        """Count a death."""
        _count_death(self.data, self.entry, attempt)

    def gave_up(self, attempt: Attempt) -> None:
        """Count an attempt that was left, or begun anew, before its end."""
        _count_given_up(self.data, self.entry, attempt)


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
        self.legitimate = self.legitimate and not attempt.assisted
        self.score = attempt.lifetime
        if self.legitimate:
            self._replays = [*self._replays[: self.level], _replay(self.data, self.entry, attempt)]
        count = _count_of(self.data, self.entry, attempt, passed=True)
        replays = tuple(self._replays) if self.legitimate else ()
        # All of it as it is now: the work may be done later, when the run has gone on.
        work = partial(self._save, count, self.level, self.score, replays, legitimate=self.legitimate)
        return told(self.data, work)

    def _save(self, count: Work, level: int, score: int, replays: Sequence[Replay], *, legitimate: bool) -> list[str]:
        count()
        levels = len(self.episode.levels)
        self.data.progress.level_passed((self.episode.number, level), levels=levels, legitimate=legitimate)
        if not replays:
            return []
        notices = _save_best(self.data, replays[-1])
        if level == levels - 1:
            if self.data.records.episode_passed(self.episode.key, score, replays):
                notices.append(EPISODE_BEST.format(seconds_text(score)))
            notices += new_unlocks(self.data.store, self.data.columns_complete, self.data.columns_present)
        return notices

    def died(self, attempt: Attempt) -> None:
        """Count a death."""
        _count_death(self.data, self.entry, attempt)

    def gave_up(self, attempt: Attempt) -> None:
        """Count an attempt that was left, or begun anew, before its end."""
        _count_given_up(self.data, self.entry, attempt)

    def advance(self, attempt: Attempt) -> bool:
        """Go on from a passed level with the lifetime at its exit; whether there is another level."""
        if self.is_last:
            return False
        self.level += 1
        self.lifetime = attempt.lifetime
        return True

    def skip(self) -> bool:
        """Leave the present level out (practice only); whether there is another one."""
        place, levels = (self.episode.number, self.level), len(self.episode.levels)

        def work() -> list[str]:
            self.data.progress.level_passed(place, levels=levels, legitimate=False)
            return []

        self.data.store.save(work)
        if self.is_last:
            return False
        self.level += 1
        return True


def keep_replay(data: PlayerData, replay: Replay) -> str:
    """Put a replay among the player's, whatever it is worth; a notice about it."""

    def work() -> list[str]:
        data.records.keep_replay(replay)
        return [REPLAY_KEPT]

    return told(data, work)[0]


def forget_replay(data: PlayerData, number: int) -> str:
    """Remove a replay of the records; why it is still there, or ''."""

    def work() -> list[str]:
        return [] if data.records.forget_replay(number) else ["A personal best needs this replay; it stays"]

    return "".join(told(data, work)[-1:])


def told(data: PlayerData, work: Work) -> list[str]:
    """Save ``work``; its notices, none of which says "saved" about what is not on the disk."""
    notices, problem = data.store.save(work)
    if not problem:
        return list(notices)
    return [*(notice.removesuffix(SAVED) for notice in notices), NOT_SAVED.format(problem)]


def _replay(data: PlayerData, entry: Entry, attempt: Attempt) -> Replay:
    return attempt.replay(entry.title, data.settings.name)


def _save_best(data: PlayerData, replay: Replay) -> list[str]:
    """Save a level's best; the notice for the player."""
    first = data.records.level_best(replay.level_digest, replay.body) is None
    if not data.records.level_passed(replay):
        return []
    return [(FIRST_PASS if first else NEW_BEST).format(seconds_text(level_score(replay.gold, replay.final_tick)))]


def _count_death(data: PlayerData, entry: Entry, attempt: Attempt) -> None:
    killer = SELF if attempt.own_hand else killer_of(attempt.simulation.world)
    told(data, _count_of(data, entry, attempt, killer=killer))


def _count_given_up(data: PlayerData, entry: Entry, attempt: Attempt) -> None:
    if attempt.outcome == "running" and attempt.simulation.tick:
        # Beginning anew must not wait for the disk.
        data.store.later(_count_of(data, entry, attempt))


def _count_of(
    data: PlayerData, entry: Entry, attempt: Attempt, *, killer: str | None = None, passed: bool = False
) -> Work:
    """What counts an attempt as it is now: passed, killed, or given up."""
    level, gold = entry.digest, attempt.gold
    ticks = attempt.simulation.tick if attempt.outcome == "running" else max(attempt.ended_tick, 0)

    def work() -> list[str]:
        data.statistics.attempt_ended(level, killer=killer, passed=passed, ticks=ticks, gold=gold)
        return []

    return work
