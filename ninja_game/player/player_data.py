"""All data that the game keeps for its player; saving results, and the notices about them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from pathlib import Path

from ninja_game.errors import FileError, reason
from ninja_game.files.shown_text import counted
from ninja_game.files.user_folder import LEVELS, RECORDS, REPLAYS, SETTINGS, make_user_folder, user_folder
from ninja_game.files.writing import remove_leftovers
from ninja_game.formats.replay.text import Replay
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import Entry, Episode
from ninja_game.player import progress
from ninja_game.player.attempt import Attempt
from ninja_game.player.catalogue import Catalogue
from ninja_game.player.progress import (
    LOCKED,
    UNLOCKED,
    LevelMarks,
    Mark,
    PackProgress,
    Place,
    has_all_gold,
    medal_of,
    save_unfinished,
)
from ninja_game.player.records import Records, Statistics
from ninja_game.player.settings import Settings, read_settings, write_changes
from ninja_game.player.store import Store, StoreWork


class PlayerData:
    """The player's data in one folder. Errors in the folder or its files never keep the game from starting.

    ``store``, ``catalogue``: instead of those of the folder, whose records are opened when they are first needed.
    ``settings``: instead of those of the folder's file, which is then neither made nor read. ``messages``: problems of
    settings and, once they are open, records, for the player.
    """

    def __init__(
        self,
        folder: Path | None = None,
        *,
        store: Store | None = None,
        catalogue: Catalogue | None = None,
        settings: Settings | None = None,
    ) -> None:
        self.folder = user_folder() if folder is None else folder
        self._store = store
        self._messages: list[str] = []
        self._reported: set[str] = set()
        self._progress: dict[str, PackProgress] = {}
        self._is_maker = True
        if settings is None:
            try:
                make_user_folder(self.folder)
                remove_leftovers(self.folder)
            except OSError as error:
                self._messages.append(f"{self.folder} cannot be made ({error.strerror}).")
            settings, messages = read_settings(self.folder / SETTINGS)
            self._messages += messages
        self.settings = self._saved_settings = settings
        self.catalogue = catalogue or Catalogue(self.folder / LEVELS)

    @property
    def store(self) -> Store:
        if self._store is None:
            self._store = Store(self.folder / RECORDS)
        return self._store

    def newcomer(self) -> PlayerData:
        """Data of a new player without a name, with the same levels; results are not saved."""
        store = Store(None, "this is a preview")
        settings = self.settings.changed(name="")
        other = PlayerData(self.folder, store=store, catalogue=self.catalogue, settings=settings)
        other._is_maker = False
        return other

    @property
    def messages(self) -> list[str]:
        return self._messages + (self._store.messages if self._store else [])

    def report(self, message: str) -> None:
        self._messages.append(message)

    def new_messages(self) -> str:
        """The new messages since the last call, as one text."""
        new = [message for message in self.messages if message not in self._reported]
        self._reported.update(new)
        return " ".join(new)

    def open_records(self) -> None:
        """Open the database now, so that ``messages`` has its problems before anyone needs it."""
        _ = self.store

    @cached_property
    def records(self) -> Records:
        return Records(self.store)

    @property
    def progress(self) -> PackProgress:
        return self.progress_in("")

    def progress_in(self, pack: str) -> PackProgress:
        """The player's progress in a pack, by its key in the catalogue."""
        if pack not in self._progress:
            self._progress[pack] = PackProgress(self.store, pack)
        return self._progress[pack]

    def beaten_in(self, episode: Episode) -> Place:
        """The farthest place that the player has legitimately reached in an episode's column."""
        return self.progress_in(episode.pack).columns[episode.column].beaten

    def episode_state(self, episode: Episode) -> str:
        """Whether an episode is unlocked, "cheated" or locked; unlocked: first ones, and one's own."""
        state = self.progress_in(episode.pack).state(episode.number)
        is_free = not self.catalogue.preceding(episode) or (self._is_maker and self.catalogue.is_own(episode.levels[0]))
        return UNLOCKED if is_free else state

    def lock_of(self, entry: Entry) -> str:
        """Why a level may not be played by itself yet, as a sentence; "" if it may. Every screen uses this rule."""
        episode = self.catalogue.episode_of(entry)
        return self.lock_of_episode(episode) if episode else ""

    def lock_of_episode(self, episode: Episode) -> str:
        """Why an episode may not be played yet, as a sentence; "" if it may."""
        before = self.catalogue.preceding(episode)
        if before is None or self.episode_state(episode) != LOCKED:
            return ""
        if self.episode_state(before) == LOCKED:
            return f"Finish episode {before.code} first"
        number, level = self.beaten_in(before)
        left = len(before.levels)
        if number == before.number:
            left -= level
        return f"Finish {counted(left, 'more level')} of episode {before.code} first"

    def reached(self, entry: Entry, mark: Mark | None) -> str:
        """The player's results in a level with this mark, as a sentence; the same on every screen."""
        if mark is None and self.marks.is_passed(entry.digest):
            return progress.HELPED
        episode = None if mark else self.catalogue.episode_of(entry)
        if episode and entry.position and self.beaten_in(episode) > entry.position:
            return "Skipped, not passed yet"
        run = None if mark else self.own_certificate(entry)
        certified = f"Certified: {seconds_text(run.end_tick)} s" if run else ""
        return progress.result_sentence(entry, mark) or certified or "Not passed yet"

    def own_certificate(self, entry: Entry) -> Replay | None:
        """The certificate to the exit of a level that the player has made. Lists ask it for every picture."""
        return self.catalogue.author_run(entry) if self._is_maker and self.catalogue.is_own(entry) else None

    @cached_property
    def marks(self) -> LevelMarks:
        return LevelMarks(self.store)

    @cached_property
    def statistics(self) -> Statistics:
        return Statistics(self.store)

    @property
    def replay_folder(self) -> Path:
        return self.folder / REPLAYS

    @property
    def columns_complete(self) -> int:
        return progress.complete_columns(self.progress, self.catalogue.episodes.keys())

    @property
    def columns_present(self) -> int:
        return len({episode.column for episode in self.catalogue.episodes.values()})

    def change_settings(self, settings: Settings) -> str:
        """Set and save settings; a message if saving failed, else ''. The next change then tries again."""
        self.settings = settings
        try:
            write_changes(self._saved_settings, settings, self.folder / SETTINGS)
        except (OSError, FileError) as error:
            return f"The settings could not be saved ({reason(error)})."
        self._saved_settings = settings
        return ""

    def close(self) -> None:
        if self._store:
            self._store.close()


OF_A_LEVEL = NEW_BEST, FIRST_PASS, NEW_MEDAL, NEW_ALL_GOLD = "Your best time", "First pass", "New medal", "All gold"
EPISODE_BEST = "Your best for this episode"


def keep_replay(player: PlayerData, replay: Replay) -> str:
    """Save a replay, even one that is not the best; a notice about it."""

    def work() -> list[str]:
        player.records.keep_replay(replay)
        return ["Replay: saved"]

    return save_work(player, work)[-1]


def forget_replay(player: PlayerData, number: int) -> str:
    """Delete a replay of the records; why that failed, or ''."""

    def work() -> list[str]:
        return [] if player.records.forget_replay(number) else ["This is one of your bests, so it stays"]

    return "".join(save_work(player, work)[-1:])


def save_work(player: PlayerData, work: StoreWork) -> list[str]:
    """Save ``work``; gives its notices, then the reason if it could not be written to the disk."""
    notices, problem = player.store.save(work)
    return [*notices, *([f"Not saved yet: {problem}"] if problem else [])]


def replay_of(player: PlayerData, entry: Entry, attempt: Attempt) -> Replay:
    return attempt.replay(entry.title, player.settings.name)


def save_best(player: PlayerData, entry: Entry, replay: Replay) -> list[str]:
    """Save a level's best and its mark; notices of a better time or medal, and the first pass with all gold."""
    level, body = replay.level_digest, replay.body
    player.records.level_passed(replay)
    before = player.marks.of(level, body)
    now = player.marks.passed(level, replay.final_tick, replay.gold, body)
    notices = [FIRST_PASS] if before is None else [NEW_BEST] if now.fastest < before.fastest else []
    if body != "circle":
        return notices
    medal = medal_of(entry, now)
    if medal and medal != medal_of(entry, before):
        notices.append(NEW_MEDAL)
    return [*notices, NEW_ALL_GOLD] if has_all_gold(entry, now) and not has_all_gold(entry, before) else notices


def count_of(
    player: PlayerData, entry: Entry, attempt: Attempt, *, killer: str | None = None, passed: bool = False
) -> StoreWork:
    """The change of the counts by an attempt as it is now: passed, killed or ended; an assisted pass gets its mark."""
    level, gold = entry.digest, attempt.gold
    helped = passed and attempt.assisted and not attempt.practice_mode
    ticks = attempt.simulation.tick if attempt.outcome == "running" else max(attempt.ended_tick, 0)

    def work() -> list[str]:
        player.statistics.attempt_ended(level, killer=killer, passed=passed, ticks=ticks, gold=gold)
        if helped:
            player.marks.passed(level, ticks, gold, progress.WITH_HELP)
        return []

    return work


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
    goal = following.number if following else None
    levels = len(episode.levels)
    player.progress_in(episode.pack).level_passed(
        (episode.number, position), levels=levels, following=goal, legitimate=legitimate
    )
    if legitimate and kept and position < levels - 1:
        save_unfinished(player.store, episode.key, replays)
    elif legitimate and kept:
        save_unfinished(player.store, following.key if following else "")
