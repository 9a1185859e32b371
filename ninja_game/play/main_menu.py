"""The main menu, and behind it attract mode: replays that play one after another (game.md §7)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from random import Random

import pygame

from ninja_game.editor.files import lost_drafts
from ninja_game.errors import NinjaGameError
from ninja_game.files.bundled import bundled_replays
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.load import load_replays
from ninja_game.formats.recording import Recording
from ninja_game.levels.episodes import Entry, Mood
from ninja_game.levels.findings import Finding
from ninja_game.play.app import App, Screen
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.menu_screen import Action, MenuScreen, Question
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.daily import DailyScreen
from ninja_game.play.menus.episodes import EpisodeGrid
from ninja_game.play.panels.help import HelpScreen
from ninja_game.play.panels.replays import RecordsScreen, ReplaysScreen
from ninja_game.play.panels.settings import SettingsScreen
from ninja_game.play.replay.playback import Playback, RunClock
from ninja_game.play.window import LOGO
from ninja_game.player.episode_playthrough import EpisodePlaythrough, next_run
from ninja_game.runtime import in_page_or_not
from ninja_game.sim.grid import Point
from ninja_game.simulation import Simulation
from ninja_game.ui.audio.music import MENU
from ninja_game.ui.canvas import HEIGHT, WIDTH
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Button, Widget
from ninja_game.view.level_view import LevelView

PANEL: Area = 14, 96, 232, 390  # the panel's area: at the edge, so that the run behind it is visible

_HEAD, _FIRST, _ROW, _EDGE = 98, 62, 43, 16
"""Heights of the title, of the first button and of a row of two, and the width of the panel's edge, px."""


class MainMenu(MenuScreen):
    """The first screen of the game, to which all others lead back. ``run``: the playthrough that play continues."""

    offers_back = False

    music = MENU

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.attract = Attract(app)
        self.run: EpisodePlaythrough | None = None
        self._lost = ""

    @property
    def mood(self) -> Mood:
        """The mood of the level behind the menu: a preview of other moods."""
        return self.attract.mood

    @property
    def theme(self) -> Theme:
        return self.app.menu_theme

    def enter(self) -> None:
        draft = next(lost_drafts(self.player.folder), None)
        self._lost = f"Not saved last time: {shown_text(draft.draft.name, 40)}" if draft else ""
        self.run = next_run(self.player, practice_mode=self.player.settings.practice)
        super().enter()

    @property
    def has_begun(self) -> bool:
        return self.player.statistics.played().attempts > 0

    def _where(self) -> str:
        if self.run is None:
            return "There are no levels"
        return f"{'Go on with' if self.has_begun else 'Begin with'} {shown_text(self.run.entry.named.name)}"

    def _how_much(self) -> str:
        """The place of the level that comes, or to a new player how much there is to play."""
        if self.has_begun and self.run is not None:
            return self.run.entry.place
        episodes = self.player.catalogue.episodes.values()
        levels = sum(len(episode.levels) for episode in episodes)
        return f"{counted(levels, 'level')} in {counted(len(episodes), 'episode')}"

    def _play(self) -> None:
        if self.run is not None:
            self.app.push(LevelScreen(self.app, self.run))

    def show_episodes(self, pack: str) -> None:
        self.app.push(EpisodeGrid(self.app, pack))

    def entries(self) -> list[tuple[str, Action, str]]:
        """A button per screen: the first as wide as the panel, then two in a row; a last single one is wide again."""
        return [
            ("Play", self._play, self._how_much()),
            ("Episodes", self._opener(EpisodeGrid), "Pick an episode, or any level in it"),
            ("Levels", self._opener(self._browser), "Play any open level on its own, or one of your own"),
            ("Daily", self._opener(DailyScreen), "A new level every day, the same for everyone"),
            ("Records", self._opener(RecordsScreen), "Your best times, and what got you killed"),
            ("Replays", self._opener(ReplaysScreen), "Watch your runs again, and the authors' too"),
            ("Editor", self._opener(EditorScreen), self._lost or "Build levels of your own"),
            ("Help", self._opener(HelpScreen), "How to move, what everything does, how it all works"),
            ("Settings", self._opener(SettingsScreen), "Controls, sound, colours, accessibility"),
            *in_page_or_not([], [("Quit", self.back, "Your progress is saved")]),
        ]

    def _browser(self, app: App) -> Browser:
        def edit(entry: Entry, finding: Finding | None = None) -> None:
            screen = EditorScreen(app, offers_recovered=False)
            app.push(screen)
            screen.commands.edit_entry(entry, finding)

        def packs() -> None:
            from ninja_game.play.menus.packs import PackScreen  # it needs NumPy, which takes a moment

            app.push(PackScreen(app, edit))

        return Browser(app, edit, in_page_or_not(None, packs))

    def _opener(self, screen: Callable[[App], Screen]) -> Callable[[], None]:
        return lambda: self.app.push(screen(self.app))

    def build(self) -> Sequence[Widget]:
        x, y, w = PANEL[0] + _EDGE, PANEL[1] + _HEAD, PANEL[2] - 2 * _EDGE
        (text, action, hint), *others = self.entries()
        half = w / 2 - 4
        return [
            Button((x, y, w, _FIRST - 8), text, action, hint=hint, size=19, detail=self._where()),
            *(
                Button((x + k % 2 * (half + 8), y + _FIRST + _ROW * (k // 2), width, _ROW - 8), text, action, hint=hint)
                for k, (text, action, hint) in enumerate(others)
                for width in [half if k ^ 1 < len(others) else w]
            ),
        ]

    def handle(self, event: InputEvent) -> None:
        if event.raw.type == pygame.DROPFILE:
            self.app.push(self._browser(self.app))
            self.app.top.handle(event)
        else:
            super().handle(event)

    def back(self) -> None:
        self.app.push(Question(self.app, "Quit the game?", "Quit", self.app.quit))

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        self.attract.update(real_ms)

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        changed = self.attract.draw(surface, whole=self.redraw)
        theme = self.theme
        x, y, w, h = PANEL
        rect = theme.window(surface, x, y, w, h)
        self._draw_title(surface)
        self.draw_widgets(surface)
        palette = self.app.theme.palette
        hint = self.focus.hint if self.focus else ""
        bar = theme.canvas.fill_rect(surface, palette.tile, 0, HEIGHT - 24, WIDTH, 24)
        theme.text(
            surface, hint, WIDTH / 2, HEIGHT - 18, size=10.5, colour=palette.on_tile, align="centre", width=WIDTH - 40
        )
        written = [rect.inflate(4, 4), bar]
        if self.attract.view is not None:
            for rect in written:
                self.attract.view.also_covered(rect)
        return None if changed is None else changed + written

    def _draw_title(self, surface: pygame.Surface) -> None:
        theme, (x, y, w, _) = self.theme, PANEL
        for part in BAND:
            corners = [(x + across, y + down) for across, down in part]
            theme.canvas.polygon(surface, theme.palette.band, corners)
        theme.text(surface, LOGO, x + w / 2, y + 18, size=48, align="centre", bold=True, height=52)


BAND: tuple[tuple[Point, ...], ...] = (
    ((16, 74), (180, 72), (180, 80), (16, 78)),
    ((178, 72), (214, 62), (206, 73), (180, 78)),
    ((178, 75), (208, 80), (196, 86), (178, 80)),
)
"""The headband under the name and its two ends: corners, px from the panel's."""

_REST_TICKS = 130  # ticks for which a replay goes on after its end or a death


class Attract:
    """Plays replays forever in random order, silently. ``shown``: number of replays begun; ``mood``: of the level."""

    def __init__(self, app: App) -> None:
        self.app = app
        self.shown, self.mood = 0, Mood()
        self._clock = RunClock()
        self._rng = Random()  # noqa: S311 - the order is no secret
        self._order = self._shuffled()
        self._playback: Playback | None = None
        self._until = 0
        self.view: LevelView | None = None
        self.name = ""

    def _shuffled(self) -> Iterator[Callable[[], Recording]]:
        while True:
            files = bundled_replays()
            self._rng.shuffle(files)
            if not files:
                return
            for file in files:
                yield lambda file=file: load_replays(file)[0]  # type: ignore[misc]

    def _begin_next(self) -> None:
        """Begin the next recording; one that cannot be read is skipped."""
        for read in self._order:
            try:
                recording = read()
                simulation = Simulation(recording.level)
            except (NinjaGameError, OSError):
                continue
            self._playback = Playback(simulation, recording.inputs, spacing=0)
            self._until = len(self._playback.inputs) + _REST_TICKS
            self.mood = self.app.player.catalogue.mood_of(recording.level) or Mood()
            self.app.follow_mood(self.mood)
            self.view = LevelView(self.app, simulation, seed=self.shown, audible=False)
            self.name = recording.name
            self.shown += 1
            return

    def update(self, real_ms: int) -> None:
        """Let time pass. With reduced motion the picture stands still."""
        playback = self._playback
        if playback is None or self.view is None:
            self._begin_next()
            return
        if self.app.settings.reduced_motion:
            return
        for _ in range(self._clock.ticks_due(real_ms)):
            if playback.tick >= self._until:
                self._begin_next()
                return
            if playback.tick < len(playback.inputs) or playback.simulation.outcome != "running":
                playback.step()
                self.view.on_tick()
            else:
                self._until = 0

    def draw(self, surface: pygame.Surface, *, whole: bool = False) -> list[pygame.Rect] | None:
        if self.view is None:
            surface.fill(self.app.theme.palette.background)
            return None
        return self.view.draw(surface, self._clock.fraction, whole=whole)
