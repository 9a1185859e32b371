"""Twenty scenes of the game, drawn here and in a page alike: Pyodide reads this file too, after busy.py."""

import random
from collections.abc import Callable
from dataclasses import replace
from random import Random
from typing import Any

from ninja_game.editor.files import draft_of, new_source
from ninja_game.files.bundled import bundled_levels, bundled_replays
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.named_level import NamedLevel
from ninja_game.levels.episodes import Entry
from ninja_game.play.app import App
from ninja_game.play.boss import BossScreen
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.lab.screen import LabScreen
from ninja_game.play.level import level_play
from ninja_game.play.level.screen import LevelScreen, PausePanel
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.episodes import EpisodeGrid
from ninja_game.play.panels.help import HelpScreen
from ninja_game.play.panels.replays import RecordsScreen
from ninja_game.play.panels.settings import SettingsScreen
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.play.screen import BaseScreen
from ninja_game.view.overlays import OVERLAY_ACTIONS

Scene = tuple[str, str, Callable[[App], object]]  # name, palette, what is shown


def frames(app: App, count: int, ms: int = 25) -> None:
    """Let pictures pass."""
    for _ in range(count):
        app.frame(ms)


def busy(ticks: int, make: Any) -> Callable[[App], object]:
    """The busy level after some ticks, its ghost beside it. ``make``: the level, the run, the keys of busy.py."""
    busy_level, busy_run, restless = make

    def show(app: App) -> None:
        app.controls.poll = restless().poll  # type: ignore[method-assign]
        screen = LevelScreen(app, busy_run(app.player, Entry(NamedLevel("busy", "", "", busy_level(), ""), "yours")))
        app.push(screen)
        frames(app, 1)
        screen.begin()
        frames(app, ticks)

    return show


def settle(app: App, screen: ReplayScreen) -> None:
    """Let turns pass until the end of the run is known and the moment sought is reached."""
    while not screen.is_settled:
        frames(app, 1, 0)


def replay(number: int, tick: int, *overlays: str) -> Callable[[App], object]:
    """A moment of a certificate."""

    def show(app: App) -> None:
        screen = ReplayScreen(app, load_replays(bundled_replays()[number]))
        app.push(screen)
        for overlay in overlays:
            screen.overlays.toggle(overlay)
        settle(app, screen)
        screen.seek(tick)
        settle(app, screen)
        screen.toggle_pause()
        frames(app, 2)

    return show


def paused(ticks: int, make: Any) -> Callable[[App], object]:
    """The busy level under a panel."""

    def show(app: App) -> None:
        busy(ticks, make)(app)
        assert isinstance(app.top, LevelScreen)
        app.push(PausePanel(app, app.top))
        frames(app, 2)

    return show


def screen(make: Callable[[App], BaseScreen]) -> Callable[[App], object]:
    """A screen by itself."""

    def show(app: App) -> None:
        app.push(make(app))
        frames(app, 12)

    return show


def edited(app: App) -> EditorScreen:
    """The editor with a level of ours."""
    return EditorScreen(app, replace(new_source(), draft=draft_of(load_levels(bundled_levels()[40])[0])))


def scenes(*make: Any) -> list[Scene]:
    """All of them. ``make``: of busy.py."""
    return [
        ("busy 40", "classic", busy(40, make)), ("replay", "morning", replay(0, 90)),
        ("settings", "classic", screen(SettingsScreen)), ("editor", "noon", screen(edited)),
        ("busy 60", "dark", busy(60, make)), ("replay dark", "afternoon", replay(77, 150, *OVERLAY_ACTIONS[::3])),
        ("help", "dark", screen(HelpScreen)), ("lab", "dusk", screen(LabScreen)),
        ("busy 90", "contrast", busy(90, make)), ("replay end", "night", replay(120, 60, *OVERLAY_ACTIONS)),
        ("episodes", "morning", screen(EpisodeGrid)), ("paused", "contrast", paused(30, make)),
        ("busy 120", "safe", busy(120, make)), ("replay safe", "noon", replay(150, 200)),
        ("records", "dusk", screen(RecordsScreen)), ("boss", "safe", screen(BossScreen)),
        ("busy 150", "safe-dark", busy(150, make)), ("replay late", "night", replay(190, 250)),
        ("levels", "afternoon", screen(Browser)), ("editor late", "safe-dark", screen(edited)),
    ]  # fmt: skip


def show_scene(app: App, scene: Scene) -> None:
    """Show one, by itself, without chance."""
    _, palette, show = scene
    random.seed(1)
    kept, level_play.Random = level_play.Random, lambda seed=None: Random(seed or 1)  # type: ignore[assignment,attr-defined]
    poll = app.controls.poll
    try:
        app.stack.clear()
        app.notice = ""
        app.change_settings(palette=palette)
        show(app)
    finally:
        level_play.Random, app.controls.poll = kept, poll  # type: ignore[attr-defined,method-assign]
