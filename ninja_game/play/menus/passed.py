"""An episode has been passed: its levels, its score, and what that has brought."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pygame

from ninja_game.formats.run_time import seconds_text
from ninja_game.play.app import App
from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.play.menus.replays import watch
from ninja_game.play.menus.thumbnails import ThumbnailScreen, all_gold_and_medal
from ninja_game.player.catalogue import Episode
from ninja_game.player.playthrough import EpisodeRun
from ninja_game.player.saving import OF_A_LEVEL
from ninja_game.ui.canvas import WIDTH
from ninja_game.ui.widgets import Button, Widget

PICTURE = 132

CLOCK = "Your result: the time left on the clock after the last level"


class EpisodePassed(ThumbnailScreen):
    """Shown after an episode's last level. Space goes on to the next episode, which ``play`` begins."""

    def __init__(self, app: App, run: EpisodeRun, play: Callable[[EpisodeRun], object]) -> None:
        super().__init__(app)
        self.run = run
        self._play = play
        self.title = f"Episode {run.episode.code} passed"

    @property
    def next_episode(self) -> Episode | None:
        return self.player.catalogue.following(self.run.episode)

    def build(self) -> Sequence[Widget]:
        following = self.next_episode
        buttons: list[Widget] = []
        if following is not None:
            buttons.append(Button((236, 440, 320, 36), f"Next: episode {following.code}", self.go_on, size=13))
        watch = Button((236, 482, 156, 30), "Watch the run", self.watch, hint="The best run of this episode")
        watch.enabled = self.player.records.episode_best(self.run.episode.key) is not None
        return [*buttons, watch, Button((400, 482, 156, 30), "Episodes", self._episodes)]

    def _episodes(self) -> None:
        below = self.app.stack.below
        self.back()
        if isinstance(below, MenuScreen):
            below.show_episodes(self.run.episode.pack)

    def go_on(self) -> None:
        if self.next_episode is not None:
            practice_mode = self.player.settings.practice
            self._play(EpisodeRun(self.player, self.next_episode, practice_mode=practice_mode))

    def watch(self) -> None:
        best = self.player.records.episode_best(self.run.episode.key)
        if best is not None:
            watch(self.app, [self.player.records.replay(number) for number in best.replays])

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme, palette = self.app.theme, self.app.theme.palette
        episode = self.run.episode
        theme.text(surface, episode.name, WIDTH / 2, 76, size=20, align="centre", bold=True, width=WIDTH - 96)
        count = len(episode.levels)
        left = (WIDTH - count * (PICTURE + 8) + 8) / 2
        for place, entry in enumerate(episode.levels):
            x = left + place * (PICTURE + 8)
            self.thumbnails.draw(surface, entry, x, 124, PICTURE)
            middle = x + PICTURE / 2
            theme.text(surface, entry.title, middle, 232, size=10, align="centre", width=PICTURE, height=15)
            mark = self.player.marks.of(entry.digest)
            for line, words in enumerate(self.player.reached(entry, mark).split(", ")):
                y = 247 + 14 * line
                theme.text(surface, words, middle, y, size=10, colour=palette.faint, align="centre", width=PICTURE)
            all_gold_and_medal(surface, theme, entry, mark, x + PICTURE - 11, 135)
        score = f"{seconds_text(self.run.score)} s left"
        theme.text(surface, score, WIDTH / 2, 290, size=44, align="centre", bold=True, height=60)
        what = CLOCK if self.run.whole else "Practice or help was used, so it does not count as a record"
        theme.text(surface, what, WIDTH / 2, 340, size=11, colour=palette.faint, align="centre")
        notices = [notice for notice in self.run.notices if notice not in OF_A_LEVEL]
        for line, notice in enumerate(notices[-4:]):
            y = 364 + 17 * line
            theme.text(
                surface, notice, WIDTH / 2, y, size=12, colour=palette.good, align="centre", width=WIDTH - 96, height=17
            )
