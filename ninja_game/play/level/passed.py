"""The screen after a passed episode: its levels, its score, and what it unlocked."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import cos, sin
from random import Random

import pygame

from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import Episode
from ninja_game.play.app import App
from ninja_game.play.level.hud_view import SHINE_TICKS
from ninja_game.play.level.level_play import STAMP_TICKS
from ninja_game.play.menu_screen import MenuScreen
from ninja_game.play.panels.replays import watch_replays
from ninja_game.play.thumbnails import ThumbnailScreen, all_gold_and_medal
from ninja_game.player.episode_playthrough import EpisodePlaythrough
from ninja_game.player.player_data import EPISODE_BEST, OF_A_LEVEL
from ninja_game.player.progress import Mark, worst_medal
from ninja_game.player.records import EpisodeBest
from ninja_game.sim.rules import TICK_MS
from ninja_game.ui.canvas import WIDTH
from ninja_game.ui.medals import draw_stamp
from ninja_game.ui.widgets import Button, Widget
from ninja_game.view.effects.particles import Particle, Particles
from ninja_game.view.sprites.drawing import DrawTarget, shared_book
from ninja_game.view.sprites.light import LightStyle, light_picture

_PICTURE = 132

LEVEL_TICKS, FEAST_TICKS = 8, 130
"""Ticks between the marks of two levels; ticks of the show after them: the medal is stamped, papers fly, light moves.
"""

_PAPERS, _PRIZE, _MIDDLE = 70, 64.0, 318.0
"""Number of papers; size of the medal of all levels; height of the medal and the score, px."""

GLOW = LightStyle("gold_light", 230, 110)  # the light behind the score

CLOCK = "What was left on the clock after the last level"


class EpisodePassed(ThumbnailScreen):
    """Shown after an episode's last level. Space goes on to the next episode, which ``play`` begins.

    ``medal``: the worst medal of its levels; "" where one has none.
    """

    def __init__(self, app: App, run: EpisodePlaythrough, play: Callable[[EpisodePlaythrough], object]) -> None:
        super().__init__(app)
        self.run, self.player = run, run.player
        self._play = play
        self.title = f"Episode {run.episode.code} passed"
        self.particles = Particles()
        self.ticks = 0.0
        self.medal, self._marks = "", dict[str, Mark]()
        self._best: EpisodeBest | None = None

    @property
    def _marks_end(self) -> int:
        return LEVEL_TICKS * len(self.run.episode.levels)

    def update(self, real_ms: int) -> None:
        """Continue the show: a note for each level, the medal's stamp, papers; all at once with reduced motion."""
        super().update(real_ms)
        before, settings = self.ticks, self.app.settings
        if before >= FEAST_TICKS:
            return
        self.redraw = True
        self.ticks = before + real_ms / TICK_MS
        if settings.reduced_motion:
            self.ticks = float(FEAST_TICKS)
            self.chime("medal")
            return
        for place in range(len(self.run.episode.levels)):
            if before < LEVEL_TICKS * (place + 1) <= self.ticks:
                self.chime(f"gold-{place + 1}")
        if before < self._marks_end + STAMP_TICKS <= self.ticks:
            self.chime("medal")
            self.particles.share_shown = settings.particles / 100
            rng = Random(self.run.score)  # noqa: S311 - presentation
            for variant in range(_PAPERS):
                angle, far = rng.uniform(-3.6, 0.5), rng.uniform(120, 380)
                flight = far * cos(angle), 0.55 * far * sin(angle)
                born, life = self.ticks + rng.uniform(0, 12), rng.uniform(50, 75)
                paper = Particle("confetti", WIDTH / 2, _MIDDLE, *flight, life, 1.3, variant, born, 190.0)
                self.particles.add(paper)

    @property
    def next_episode(self) -> Episode | None:
        return self.player.catalogue.following(self.run.episode)

    def build(self) -> Sequence[Widget]:
        self._best = self.player.records.episode_best(self.run.episode.key)
        self._marks = self.player.marks.all()
        self.medal = worst_medal(self.run.episode.levels, self._marks)
        following = self.next_episode
        buttons: list[Widget] = []
        if following is not None:
            text = f"Next: {following.code} {following.name}"
            buttons.append(Button((236, 440, 320, 36), text, self.go_on, size=13, hint="The next episode"))
        watch = Button((236, 482, 156, 30), "Watch the run", self.watch, hint="The best run of this episode")
        watch.enabled = self._best is not None
        return [*buttons, watch, Button((400, 482, 156, 30), "Episodes", self._episodes)]

    def _episodes(self) -> None:
        below = self.app.stack.below
        self.back()
        if isinstance(below, MenuScreen):
            below.show_episodes(self.run.episode.pack)

    def go_on(self) -> None:
        if self.next_episode is not None:
            practice_mode = self.player.settings.practice
            self._play(EpisodePlaythrough(self.player, self.next_episode, practice_mode=practice_mode))

    def watch(self) -> None:
        if self._best is not None:
            watch_replays(self.app, [self.player.records.replay(number) for number in self._best.replays])

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme, palette = self.app.theme, self.app.theme.palette
        episode = self.run.episode
        if self.ticks >= self._marks_end + STAMP_TICKS:
            light = light_picture(GLOW, theme.canvas.scale, palette)
            px, py = theme.canvas.point(WIDTH / 2, _MIDDLE)
            surface.blit(light, (px - light.width // 2, py - light.height // 2))
        theme.text(surface, episode.name, WIDTH / 2, 76, size=20, align="centre", bold=True, width=WIDTH - 96)
        count = len(episode.levels)
        left = (WIDTH - count * (_PICTURE + 8) + 8) / 2
        for place, entry in enumerate(episode.levels):
            x = left + place * (_PICTURE + 8)
            self.thumbnails.draw(surface, entry, x, 124, _PICTURE)
            middle = x + _PICTURE / 2
            theme.text(surface, entry.title, middle, 232, size=10, align="centre", width=_PICTURE, height=15)
            if self.ticks < LEVEL_TICKS * (place + 1):
                continue
            mark = self._marks.get(entry.digest)
            for line, words in enumerate(self.player.reached(entry, mark).split(", ")):
                y = 247 + 14 * line
                theme.text(surface, words, middle, y, size=10, colour=palette.faint, align="centre", width=_PICTURE)
            all_gold_and_medal(surface, theme, entry, mark, x + _PICTURE - 11, 135)
        target = DrawTarget(theme.canvas, palette.base, shared_book(theme.canvas.scale, palette.base))
        target.begin(surface)
        Particles.draw(self.particles.front, target, self.ticks)
        self._draw_score(surface)
        if following := self.next_episode:
            self.thumbnails.draw(surface, following.levels[0], 170, 435, 58)

    def _draw_score(self, surface: pygame.Surface) -> None:
        theme, palette, run = self.app.theme, self.app.theme.palette, self.run
        score = f"{seconds_text(run.score)} s left"
        half = theme.width(score, 44, bold=True) / 2
        stamp = min(1.0, max(0.0, (self.ticks - self._marks_end) / STAMP_TICKS))
        theme.text(surface, score, WIDTH / 2, 290, size=44, align="centre", bold=True, height=60)
        if self.medal:
            shine = (self.ticks - self._marks_end - STAMP_TICKS) / SHINE_TICKS
            draw_stamp(surface, theme, self.medal, WIDTH / 2 - half - 52, _MIDDLE, _PRIZE, stamp, shine)
        best = self._best
        note = ""
        news = [notice for notice in run.notices if notice not in OF_A_LEVEL and notice != EPISODE_BEST]
        if not run.whole:
            note = "A level was skipped or passed with help: this does not count as a record"
            note = "Practice counts for no record" if run.practice_mode else note
        elif best is None or best.score <= run.score:
            theme.text(surface, "Your best", WIDTH / 2 + half + 16, 310, size=13, colour=palette.good, bold=True)
        else:
            note = f"Your best: {seconds_text(best.score)} s left"
        theme.text(surface, CLOCK, WIDTH / 2, 350, size=11, colour=palette.faint, align="centre")
        if self.medal:
            news.insert(0, f"{self.medal.capitalize()} medal: every level has it, or a better one")
        for line, notice in enumerate([*filter(None, [note]), *news][:4]):
            y = 370 + 17 * line
            theme.text(
                surface, notice, WIDTH / 2, y, size=12, colour=palette.good, align="centre", width=WIDTH - 96, height=17
            )
