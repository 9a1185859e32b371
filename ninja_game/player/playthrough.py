"""Levels as they are played: title and ghosts, saving, and the next level of a file or an episode.

game.md §1.4, §2, §8.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from enum import Enum
from functools import partial
from pathlib import Path
from typing import NamedTuple

from ninja_game.errors import DAMAGED, LevelError
from ninja_game.files.reading import file_stamp
from ninja_game.formats.load import load_levels
from ninja_game.formats.messages import LevelMessage, parse_messages
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.pars import Pars
from ninja_game.formats.replay.text import Replay, lifetimes, parse_replay, write_replay
from ninja_game.levels.episodes import YOURS, Entry, Episode
from ninja_game.player.attempt import Attempt
from ninja_game.player.player_data import EPISODE_BEST, PlayerData, count_of, replay_of, save_best, save_work
from ninja_game.player.progress import LOCKED, UNLOCKED, new_unlocks, next_par
from ninja_game.player.store import Store, StoreWork
from ninja_game.sim.level import Body, Level
from ninja_game.sim.rules import LIFETIME
from ninja_game.simulation import Simulation


class PacedRun(NamedTuple):
    """A run to race against; ``pace``: its ticks for each tick of the clock, at most 1."""

    inputs: bytes
    pace: float = 1.0


class Navigation(Enum):
    """The next screen after a level."""

    SAME_LEVEL = "the level again"
    NEXT_LEVEL = "the level at which the playthrough now stands"
    EPISODE_END = "what the episode has brought"
    BACK = "the screen from which the level was opened"


class Playthrough:
    """A level by itself, of a file, or of an episode. The subclasses below choose the next level.

    ``entry``: the present level. ``lifetime``: ticks at its start. ``notices``: of what was saved. ``next_label``: the
    label of the way on from a passed level. ``lead``: inputs that have been played when it waits for the player.
    ``deaths``: for its texts, how many there were before.
    """

    next_label = "next level"
    lead, deaths = b"", 0

    def __init__(self, player: PlayerData, entry: Entry, *, body: Body = "circle", practice_mode: bool = False) -> None:
        self.player = player
        self.entry = entry
        self.body: Body = body
        self.practice_mode = practice_mode
        self.lifetime = LIFETIME
        self.notices: list[str] = []
        self._ghosts: tuple[tuple[str, int, str], list[PacedRun]] = ("", -1, ""), []

    @property
    def has_next(self) -> bool:
        """Whether another level follows a pass; else this one begins again."""
        return True

    @property
    def carries_clock(self) -> bool:
        """Whether the next level begins with the lifetime left in this one."""
        return False

    @property
    def title(self) -> str:
        return self.entry.title

    @property
    def level(self) -> Level:
        return self.entry.named.level

    def beginning(self) -> tuple[Level, bytes]:
        """The level at its start, and the inputs of its author's run, if there is one: both decide where texts lie."""
        run = self.player.catalogue.author_run(self.entry)
        return self.level, run.inputs if run else b""

    @property
    def pars(self) -> Pars | None:
        """The level's par times, for the classic body."""
        return self.entry.pars if self.body == "circle" else None

    def next_par(self) -> str:
        """The next medal and its time, in words; "" before the first pass, after the last medal, in practice."""
        mark = self.player.marks.of(self.entry.digest)
        return "" if self.pars is None or self.practice_mode or mark is None else next_par(self.pars, mark)

    @property
    def show_tutorial(self) -> bool:
        """Whether the keys are explained at its start: to a player without any pass."""
        return not self.player.statistics.played().passes

    def ghosts(self) -> list[PacedRun]:
        """Runs to race against; read again only when they change, since every retry asks."""
        best = self.player.records.level_best(self.entry.digest, self.body)
        medal = self._raced_medal()
        state = self.entry.digest, best.id if best else -1, medal
        if state != self._ghosts[0]:
            author = self.player.catalogue.author_run(self.entry) if medal else None
            if author and self.pars:
                # The certificate, slowed down so that it just wins the medal.
                runs = [PacedRun(author.inputs, author.final_tick / self.pars.par(medal))]
            else:
                replay = self.player.records.replay(best.id) if best else None
                runs = [PacedRun(replay.inputs)] if replay else []
            self._ghosts = state, runs
        return self._ghosts[1]

    def _raced_medal(self) -> str:
        """The medal whose pace a ghost has; "" for the player's best."""
        medal_ghost, pars = self.player.settings.ghost, self.pars
        if medal_ghost == "best" or pars is None:
            return ""
        if medal_ghost != "next":
            return medal_ghost
        mark = self.player.marks.of(self.entry.digest)
        return pars.next_medal(mark.fastest) if mark else "silver"

    def passed(self, attempt: Attempt) -> list[str]:
        """Called once, right after the tick of the exit contact: saves; gives notices to show."""
        raise NotImplementedError

    @property
    def shows_messages(self) -> bool:
        """Whether the level shows its messages: not after a pass, nor if the player does not want them."""
        marks, level = self.player.marks, self.entry.digest
        return self.player.settings.level_texts and not marks.is_passed(level) and marks.of(level, self.body) is None

    def messages(self) -> tuple[LevelMessage, ...]:
        if not self.shows_messages:
            return ()
        with suppress(LevelError):
            return parse_messages(self.entry.named.says)
        return ()

    def died(self, attempt: Attempt) -> None:
        """Called once per death: counts it."""
        save_work(self.player, count_of(self.player, self.entry, attempt, killer=attempt.killer))

    def gave_up(self, attempt: Attempt) -> None:
        """Called when an attempt is left or restarted, ended or not: counts one that has not."""
        if attempt.outcome == "running" and attempt.simulation.tick:
            # A restart must not wait for the disk.
            self.player.store.defer(count_of(self.player, self.entry, attempt))

    def restart(self) -> bool:
        """Called when the level restarts; whether it is another one, since its file has changed.

        Raises NinjaGameError or OSError for a changed file that cannot be played; the level stays as it was.
        """
        return False

    def advance(self) -> Navigation:
        """Leave this level, passed or (in practice) skipped; NEXT_LEVEL: this playthrough is at another one now."""
        return Navigation.SAME_LEVEL

    @property
    def next_screen(self) -> Navigation:
        """The target of leaving: BACK or EPISODE_END."""
        return Navigation.BACK


class LevelPlaythrough(Playthrough):
    """A level by itself (single level, time trial): every attempt starts with the full lifetime.

    Its file is read again if it has changed at a restart. ``following``: the levels after it in the list that it was
    chosen from; locked ones are skipped.
    """

    def __init__(
        self,
        player: PlayerData,
        entry: Entry,
        *,
        body: Body = "circle",
        practice_mode: bool = False,
        following: Sequence[Entry] = (),
    ) -> None:
        super().__init__(player, entry, body=body, practice_mode=practice_mode)
        self._following = following
        self._levels: Sequence[NamedLevel] = [entry.named]
        self._stamp = file_stamp(Path(entry.named.file))

    def restart(self) -> bool:
        """Read the level's file again if it has changed; whether the level is another one now."""
        stamp, before = file_stamp(Path(self.entry.named.file)), self.level
        if stamp == self._stamp:
            return False
        self._stamp = stamp
        levels = load_levels(self.entry.named.file)
        named = next((level for level in levels if level.record == self.entry.named.record), levels[0])
        Simulation(named.level, body=self.body)
        changed = named.level != before
        pars = None if changed else self.entry.pars
        self._levels, self.entry = levels, replace(self.entry, named=named, pars=pars)
        return changed

    @property
    def has_next(self) -> bool:
        return bool(self._ahead())

    def _ahead(self) -> list[Entry]:
        return [entry for entry in self._following if not self.player.lock_of(entry)]

    def advance(self) -> Navigation:
        """The next level of the list that can be played."""
        for number, entry in enumerate(ahead := self._ahead(), 1):
            # Files may hold levels without a ninja.
            with suppress(LevelError):
                Simulation(entry.named.level, body=self.body)
                self.entry, self._following = entry, ahead[number:]
                self._stamp = file_stamp(Path(entry.named.file))
                return Navigation.NEXT_LEVEL
        return Navigation.SAME_LEVEL

    def passed(self, attempt: Attempt) -> list[str]:
        """Save the results of a passed attempt; notices about them."""
        count = count_of(self.player, self.entry, attempt, passed=True)
        entry = self.entry
        replay = None if attempt.assisted else replay_of(self.player, entry, attempt)

        def work() -> list[str]:
            count()
            notices = save_best(self.player, entry, replay) if replay else []
            if not self.practice_mode:
                self._open_following(entry)
            return notices

        return save_work(self.player, work)

    def _open_following(self, entry: Entry) -> None:
        """If the episode is at this level, move on to the next level that is not passed."""
        player, episode = self.player, self.player.catalogue.episode_of(entry)
        if episode is None or entry.position is None or player.episode_state(episode) != UNLOCKED:
            return
        if player.beaten_in(episode) != entry.position:
            return
        position = entry.position[1]
        while True:
            note_progress(player, episode, position, kept=load_unfinished(player.store)[0] in {"", episode.key})
            position += 1
            if position == len(episode.levels) or not player.marks.is_passed(episode.levels[position].digest):
                return


class FilePlaythrough(LevelPlaythrough):
    """The levels of a file, one after the other; after the last one the first again."""

    def __init__(
        self, player: PlayerData, levels: Sequence[NamedLevel], *, body: Body = "circle", practice_mode: bool = False
    ) -> None:
        super().__init__(player, Entry(levels[0], YOURS), body=body, practice_mode=practice_mode)
        self._levels = levels

    @property
    def has_next(self) -> bool:
        return len(self._levels) > 1

    def advance(self) -> Navigation:
        """The next level of the file that can be played."""
        place = [level.record for level in self._levels].index(self.entry.named.record)
        self._following = [Entry(named, YOURS) for named in (*self._levels[place + 1 :], *self._levels[:place])]
        return super().advance()


class EpisodePlaythrough(Playthrough):
    """An episode from its first level on. ``position``: of the present one, from 0.

    ``legitimate``: neither practice nor a "cheated" episode; else nothing is a best and only "reached" moves on.
    ``replays``: of the levels passed so far, if it is legitimate. ``whole``: no level was skipped or passed with
    assistance, so that the score of the episode counts.
    """

    def __init__(self, player: PlayerData, episode: Episode, *, practice_mode: bool = False) -> None:
        super().__init__(player, episode.levels[0], practice_mode=practice_mode)
        self.episode = episode
        self.position = 0
        self.legitimate = not practice_mode and player.episode_state(episode) == UNLOCKED
        self.score = 0
        self.whole = True
        self.replays: list[Replay] = []
        self._passed: Attempt | None = None

    def resume(self, replays: Sequence[Replay]) -> None:
        """Continue after the first levels of the episode, which these runs have passed."""
        self.replays = list(replays)
        self.position = len(replays)
        self.entry = self.episode.levels[self.position]
        self.lifetime = lifetimes(replays)[-1]
        self.score = self.lifetime

    def skip_to_furthest(self) -> None:
        """Go to the farthest level that was reached by skipping, if it is in this episode."""
        beaten = self.player.beaten_in(self.episode)
        if beaten[0] == self.episode.number and 0 < beaten[1] < len(self.episode.levels) and not self.practice_mode:
            self.whole, self.position = False, beaten[1]
            self.entry = self.episode.levels[self.position]

    @property
    def title(self) -> str:
        return self.episode.title(self.position)

    @property
    def carries_clock(self) -> bool:
        return not self.is_last and not self.practice_mode

    @property
    def is_last(self) -> bool:
        return self.position == len(self.episode.levels) - 1

    def passed(self, attempt: Attempt) -> list[str]:
        """Save the results of a passed attempt, for its level and for the episode; notices about them.

        An assisted one is no record, but it unlocks the next level.
        """
        counts = self.legitimate and not attempt.assisted
        self.whole = self.whole and counts
        self.score = attempt.lifetime
        self._passed = attempt
        if counts:
            self.replays = [*self.replays[: self.position], replay_of(self.player, self.entry, attempt)]
        count = count_of(self.player, self.entry, attempt, passed=True)
        replays = tuple(self.replays) if counts else ()
        # A copy of the present state: the work may be done later, when the run has gone on.
        work = partial(
            self._save, count, self.position, self.score, replays, legitimate=self.legitimate, whole=self.whole
        )
        self.notices = save_work(self.player, work)
        return self.notices

    def _save(
        self, count: StoreWork, position: int, score: int, replays: Sequence[Replay], *, legitimate: bool, whole: bool
    ) -> list[str]:
        count()
        levels = len(self.episode.levels)
        note_progress(self.player, self.episode, position, replays if whole else (), legitimate=legitimate)
        if not replays:
            return []
        notices = save_best(self.player, self.episode.levels[position], replays[-1])
        if position == levels - 1:
            before = self.player.records.episode_best(self.episode.key)
            if whole and self.player.records.episode_passed(self.episode.key, score, replays) and before:
                notices.append(EPISODE_BEST)
            if not self.episode.pack:
                notices += new_unlocks(self.player.store, self.player.columns_complete, self.player.columns_present)
        return notices

    def restart(self) -> bool:
        self._passed = None
        return False

    def advance(self) -> Navigation:
        """To the next level with the lifetime at the exit; or, skipping this one, with that at its start."""
        if self._passed is None:
            self._leave_out()
        else:
            self.lifetime = self._passed.lifetime
        if self.is_last:
            return self.next_screen
        self.position += 1
        self.entry = self.episode.levels[self.position]
        self._passed = None
        return Navigation.NEXT_LEVEL

    @property
    def next_screen(self) -> Navigation:
        """After the last level the episode's results, else back."""
        return Navigation.EPISODE_END if self._passed is not None and self.is_last else Navigation.BACK

    def _leave_out(self) -> None:
        """Unlock the level after the present one; nothing of the episode counts as a best any more."""
        self.whole = False
        position, legitimate = self.position, self.legitimate

        def work() -> list[str]:
            note_progress(self.player, self.episode, position, legitimate=legitimate)
            return []

        self.notices = save_work(self.player, work)


def note_progress(
    player: PlayerData,
    episode: Episode,
    position: int,
    replays: Sequence[Replay] = (),
    *,
    legitimate: bool = True,
    kept: bool = True,
) -> None:
    """A level of an episode was passed or skipped: unlock the next one, and save it as the place to continue.

    ``replays``: those of the episode up to it, if no level was skipped. Raises sqlite3.Error.
    """
    following = player.catalogue.following(episode)
    levels = len(episode.levels)
    progress, goal = player.progress_in(episode.pack), following.number if following else None
    progress.level_passed((episode.number, position), levels=levels, following=goal, legitimate=legitimate)
    if legitimate and kept and position < levels - 1:
        save_unfinished(player.store, episode.key, replays)
    elif legitimate and kept:
        save_unfinished(player.store, following.key if following else "")


def next_run(player: PlayerData, *, practice_mode: bool = False) -> EpisodePlaythrough | None:
    """The playthrough to continue: after the level played last, or else the first episode that has not been passed.

    None without episodes.
    """
    if not practice_mode and (run := unfinished_run(player)):
        return run
    episodes = [player.catalogue.episodes[number] for number in sorted(player.catalogue.episodes)]
    ahead = [episode for episode in episodes if not player.progress.is_beaten(episode.number)]
    opened = [episode for episode in ahead if player.episode_state(episode) != LOCKED]
    chosen = next(iter(opened or ahead or episodes), None)
    if chosen is None:
        return None
    run = EpisodePlaythrough(player, chosen, practice_mode=practice_mode)
    run.skip_to_furthest()
    return run


def unfinished_run(player: PlayerData, chosen: Episode | None = None) -> EpisodePlaythrough | None:
    """The unfinished run of an episode, or of the one played last; None if it has not been begun or is over."""
    key, replays = load_unfinished(player.store)
    if chosen is None:
        episodes = (episode for pack in player.catalogue.packs() for episode in pack.episodes.values())
        chosen = next((episode for episode in episodes if key and episode.key == key), None)
    elif chosen.key != key:
        replays = []
    if chosen is None or len(replays) >= len(chosen.levels):
        return None
    run = EpisodePlaythrough(player, chosen)
    if replays:
        run.resume(replays)
    else:
        run.skip_to_furthest()
    return run if run.position or not player.progress_in(chosen.pack).is_beaten(chosen.number) else None


_PLACE = "episode left half-way"


def save_unfinished(store: Store, key: str, replays: Sequence[Replay] = ()) -> None:
    """Save the episode to continue, "" for none, and its runs. Raises sqlite3.Error."""
    with store.change() as db:
        value = json.dumps([key, *map(write_replay, replays)])
        db.execute("REPLACE INTO fact (name, value) VALUES (?, ?)", (_PLACE, value))


def load_unfinished(store: Store) -> tuple[str, list[Replay]]:
    """The key of the episode to continue, and its runs; ("", []) without one, or for a damaged one."""
    for (value,) in store.rows("SELECT value FROM fact WHERE name = ?", (_PLACE,), [str]):
        try:
            key, *texts = json.loads(value)
            return str(key), [parse_replay(text) for text in texts]
        except DAMAGED:
            break
    return "", []
