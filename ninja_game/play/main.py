"""The program `ninja-game play`: its first screen, and the loop until it ends."""

from __future__ import annotations

import gc
from collections.abc import Callable, Sequence
from pathlib import Path

import pygame

from ninja_game.backend.memories import compile_missing
from ninja_game.errors import LevelError, NinjaGameError
from ninja_game.files.bundled import data_folder
from ninja_game.formats.links import is_link, read_link, recordings_in_links
from ninja_game.formats.load import load_level, load_levels, load_replays
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.pack import Pack, is_pack
from ninja_game.formats.recording import Recording
from ninja_game.play.app import App, Screen, TasEditorOpener, build_app
from ninja_game.play.window import Window, save_picture
from ninja_game.player.playthrough import FilePlaythrough
from ninja_game.runtime import run_in_background
from ninja_game.sim.level import Body, Level
from ninja_game.simulation import Simulation


def main(
    level_path: str | None = None,
    *,
    body: Body = "circle",
    frames: int | None = None,
    screenshot: str | None = None,
    size: tuple[int, int] | None = None,
    replay_path: str | None = None,
    practice: bool = False,
    record: int = 0,
    tas_editor: TasEditorOpener | None = None,
    window: Window | None = None,
) -> int:
    """Run the program `ninja-game play`; its exit code.

    ``level_path``: a pack, whose episodes are offered, or a file of levels, played from number ``record`` on, or a link
    to a level or to replays; by default the main menu. ``replay_path``: watch the recordings of a file or link;
    ``level_path`` is then the level of those without one. ``frames``: end after this many pictures. ``screenshot``:
    write the last picture to this PNG file. ``tas_editor``, ``window``: as in ``App``.

    Raises NinjaGameError for a file that cannot be read or written, and where there is no display.
    """
    # Read before a window opens: errors in a file appear in the terminal.
    first = first_screen(level_path, replay_path, body=body, practice=practice, record=record)
    return run_app(first, size=size, frames=frames, screenshot=screenshot, tas_editor=tas_editor, window=window)


def run_app(
    first: Callable[[App], Screen],
    *,
    size: tuple[int, int] | None = None,
    frames: int | None = None,
    screenshot: str | None = None,
    tas_editor: TasEditorOpener | None = None,
    window: Window | None = None,
) -> int:
    """Open a window with a first screen and run until it ends; the exit code. The rest is as in ``main``.

    Raises NinjaGameError where there is no display.
    """
    try:
        app = build_app(size=size, tas_editor=tas_editor, window=window)
        try:
            app.push(first(app))
            # So that a later search does not wait for the compiler.
            run_in_background(compile_missing, lambda _: None)
            # Freeze loaded objects: collecting garbage among them took 9 ms during play.
            gc.freeze()
            app.run(frames)
            if screenshot:
                _save(app, Path(screenshot))
        finally:
            app.player.close()
            pygame.quit()
    except pygame.error as error:
        raise NinjaGameError(f"the window cannot be opened: {error}") from None
    return 0


def _save(app: App, path: Path) -> None:
    try:
        save_picture(app.surface, path)
    except OSError as error:
        raise NinjaGameError(f"{path}: the picture cannot be written: {error.strerror}") from None


def first_screen(
    level_path: str | None, replay_path: str | None, *, body: Body, practice: bool, record: int = 0
) -> Callable[[App], Screen]:
    """The function that makes the first screen; under a screen that a link opens lies the main menu.

    Files and links are read here, before a window opens; screens are imported when needed.

    Raises NinjaGameError for a file that cannot be read or a level that cannot be played.
    """
    if replay_path:
        return _replays(replay_path, load_level(level_path, record) if level_path else None)
    if level_path is None:
        return _main_menu
    if is_link(level_path) and read_link(level_path).kind == "replay":
        return _replays(level_path, None)
    if is_pack(Path(level_path)) and (body, practice, record) == ("circle", False, 0):
        return _episodes(Path(level_path))
    levels = load_levels(level_path)[record:]
    if not levels:
        raise LevelError(f"there is no record {record}", level_path)
    _check(levels[0], body)

    def play(app: App) -> Screen:
        from ninja_game.play.level.screen import LevelScreen

        if is_link(level_path):
            app.push(_main_menu(app))
        practice_mode = practice or app.settings.practice
        return LevelScreen(app, FilePlaythrough(app.player, levels, body=body, practice_mode=practice_mode))

    return play


def _check(named: NamedLevel, body: Body) -> None:
    """Raise LevelError, naming the place, for a level that cannot be played."""
    try:
        Simulation(named.level, body=body)
    except LevelError as error:
        error.file, error.line = named.file, named.line
        raise


def _replays(path: str, level: Level | None) -> Callable[[App], Screen]:
    return _watch(load_replays(path, level=level), over_menu=is_link(path))


def watch_screen(texts: Sequence[str], colours: Sequence[int] = ()) -> Callable[[App], Screen]:
    """A function that makes the viewer, over the main menu: the first replay is watched, others run as ghosts.

    ``colours``: as in ReplayScreen. Raises NinjaGameError for a replay that cannot be read.
    """
    return _watch(recordings_in_links(texts), colours, over_menu=True)


def _watch(recordings: Sequence[Recording], colours: Sequence[int] = (), *, over_menu: bool) -> Callable[[App], Screen]:
    def watch(app: App) -> Screen:
        from ninja_game.play.replay.screen import ReplayScreen

        if over_menu:
            app.push(_main_menu(app))
        return ReplayScreen(app, recordings, colours)

    return watch


def _episodes(path: Path) -> Callable[[App], Screen]:
    """The grid of a pack's episodes, over the main menu. Raises NinjaGameError for a pack that cannot be played."""
    pack = Pack(path)
    if not pack.episodes:
        raise LevelError("no episodes in this pack", str(path), hint="`ninja-game levels lint` says what is odd")
    own = not is_link(path) and path.resolve() == data_folder("levels").resolve()

    def choose(app: App) -> Screen:
        from ninja_game.play.menus.episodes import EpisodeGrid

        if not own:
            app.player.catalogue.more.append(path)
        app.push(_main_menu(app))
        return EpisodeGrid(app, "" if own else pack.name)

    return choose


def _main_menu(app: App) -> Screen:
    from ninja_game.play.main_menu import MainMenu

    return MainMenu(app)
