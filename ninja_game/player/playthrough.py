"""Levels as they are played, by themselves or of a file: title and ghosts, saving, and the next level.

game.md §1.4, §2, §8.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from enum import Enum
from pathlib import Path
from typing import NamedTuple

from ninja_game.errors import LevelError
from ninja_game.files.reading import file_stamp
from ninja_game.formats.load import load_levels
from ninja_game.formats.messages import LevelMessage, parse_messages
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.pars import Pars
from ninja_game.levels.episodes import YOURS, Entry
from ninja_game.player.attempt import Attempt
from ninja_game.player.player_data import PlayerData, count_of, note_progress, replay_of, save_best, save_work
from ninja_game.player.progress import UNLOCKED, load_unfinished, next_par
from ninja_game.sim.level import Body, Level
from ninja_game.sim.rules import LIFETIME
from ninja_game.simulation import Simulation


class PacedRun(NamedTuple):
    """A run to race against; ``pace``: its ticks for each tick of the clock, at most 1."""

    inputs: bytes
    pace: float = 1.0


class Navigation(Enum):
    """What follows a level."""

    SAME_LEVEL = "the level again"
    NEXT_LEVEL = "the present level of the playthrough, which has moved on"
    EPISODE_END = "the results of the episode"
    BACK = "no other level: back to where this one was chosen"


class Playthrough:
    """The player's way through levels: a base class; each subclass decides which level follows a pass.

    - ``entry``: the level that is played now; ``lifetime``: its time limit, in ticks.
    - ``notices``: sentences about what the last save has won, such as a new best.
    - ``next_label``: the words on the button that goes on after a pass.
    - ``lead``: inputs played before the level waits for the player; ``deaths``: deaths before the first try. Both are
      set only by tests of a level under edit.
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
        """Whether the keys are explained at the level's start: only to a player who has passed no level yet."""
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
        """The medal at whose pace the ghost runs; "" if the ghost is the player's best run."""
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
        """Called when an attempt is left or restarted: counts it as ended by the player, unless it was over already."""
        if attempt.outcome == "running" and attempt.simulation.tick:
            # A restart must not wait for the disk.
            self.player.store.defer(count_of(self.player, self.entry, attempt))

    def restart(self) -> bool:
        """Called when the level restarts; whether the level has changed, as its file did.

        Raises NinjaGameError or OSError for a changed file that cannot be played; the level stays as it was.
        """
        return False

    def advance(self) -> Navigation:
        """Leave this level, passed or (in practice) skipped; NEXT_LEVEL if ``entry`` is another level now."""
        return Navigation.SAME_LEVEL

    @property
    def on_leaving(self) -> Navigation:
        """What follows when the player leaves: BACK or EPISODE_END."""
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
        self._levels = levels
        self.entry = replace(self.entry, named=named, pars=pars)
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
