"""An episode as it is played, level by level with one lifetime, and the run of it to continue (game.md §2)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from ninja_game.formats.replay.text import Replay, lifetimes
from ninja_game.levels.episodes import Episode
from ninja_game.player.attempt import Attempt
from ninja_game.player.player_data import (
    EPISODE_BEST,
    PlayerData,
    count_of,
    note_progress,
    replay_of,
    save_best,
    save_work,
)
from ninja_game.player.playthrough import Navigation, Playthrough
from ninja_game.player.progress import LOCKED, UNLOCKED, load_unfinished, new_unlocks
from ninja_game.player.store import StoreWork


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
        """Continue after the levels that these runs, in the episode's order, have passed."""
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
        """Go to the next level with the lifetime at the exit; if this one is skipped, with that at its start."""
        if self._passed is None:
            self._leave_out()
        else:
            self.lifetime = self._passed.lifetime
        if self.is_last:
            return self.on_leaving
        self.position += 1
        self.entry = self.episode.levels[self.position]
        self._passed = None
        return Navigation.NEXT_LEVEL

    @property
    def on_leaving(self) -> Navigation:
        """After the last level the episode's results, else back."""
        return Navigation.EPISODE_END if self._passed is not None and self.is_last else Navigation.BACK

    def _leave_out(self) -> None:
        """Unlock the level after the present one; nothing of the episode counts as a best any more."""
        self.whole = False
        # No attempt is counted here, and no replay is kept.
        work = partial(self._save, list, self.position, self.score, (), legitimate=self.legitimate, whole=False)
        self.notices = save_work(self.player, work)


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
