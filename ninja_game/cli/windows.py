"""Commands that open a window: the game, the editor, the TAS editor, the lab."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from ninja_game.cli import options

if TYPE_CHECKING:
    from ninja_game.play.app import App, Screen


@click.command()
@click.argument("level", required=False, type=options.LevelPath())
@click.option("--record", type=click.IntRange(0, 10**6), default=0, help="The first level of the file, from 0.")
@options.body_option
@click.option("--practice", is_flag=True, help="No time limit, nothing counts.")
@click.option("--replay", type=options.InputPath(dir_okay=False), help="Watch the recordings of this file or link.")
@options.level_option
@options.window_options
def play(
    level: Path | None,
    record: int,
    body: Literal["circle", "box"],
    practice: bool,
    replay: Path | None,
    level_path: Path | None,
    **window: Any,
) -> int:
    """Play a level in a window.

    LEVEL is a file of levels, the name of one of the game's own, or a link; without it the game begins at its menu.
    Links hold everything that they need: no network is used. A pack, a folder or zip with pack.toml, offers its
    episodes; with --practice, --body or --record its levels are played one after the other. The menus offer your own
    files and packs too: those in the folder `levels` of your folder for this game, which NINJA_GAME_HOME moves; a file
    that is dropped on the menu Levels is copied there.

    \b
    Examples:
      ninja-game play
      ninja-game play my-level.txt --practice
      ninja-game play userlevels.txt --record 17
      ninja-game play my-pack.zip
      ninja-game play --replay run.replay.txt
      ninja-game play 'https://example.org/game/#level=1.…'
      SDL_VIDEODRIVER=dummy ninja-game play --frames 40 --screenshot picture.png
    """
    if level is not None and replay is not None:
        raise click.UsageError("LEVEL and --replay cannot be used together")
    if level_path is not None and replay is None:
        raise click.UsageError("--level is the level of what --replay names")
    path = next((str(option) for option in (level, level_path) if option is not None), None)
    from ninja_game.play.window import open_at_once

    # Errors in a file appear in the terminal before a window opens.
    opened = open_at_once(window["size"]) if path is None else None
    from ninja_game.play.main import main
    from ninja_game.tas_editor.opening import open_tas_editor

    return main(
        path,
        body=body,
        replay_path=str(replay) if replay is not None else None,
        practice=practice,
        record=record,
        tas_editor=open_tas_editor,
        window=opened,
        **window,
    )


@click.command()
@click.argument("level", required=False, type=options.LevelPath())
@options.record_option
@options.window_options
def edit(level: Path | None, record: int | None, **window: Any) -> int:
    """Make a level, or change one, in a window.

    LEVEL is a file of levels, or the name of one of the game's own; without it an empty room. A readable level
    is saved into its file, with its comments; a level of N or of the game becomes a new file among yours.

    \b
    Examples:
      ninja-game edit
      ninja-game edit my-level.txt
      ninja-game edit userlevels.txt --record 17
    """
    from ninja_game.editor.files import Source, open_source
    from ninja_game.files.bundled import is_bundled

    source = open_source(level, record or 0) if level is not None else None
    if source is not None and source.path is not None and is_bundled(source.path):
        source = Source(source.draft)
    from ninja_game.play.editor.screen import EditorScreen
    from ninja_game.play.main import run_app
    from ninja_game.tas_editor.opening import open_tas_editor

    return run_app(lambda app: EditorScreen(app, source), tas_editor=open_tas_editor, **window)


@click.command()
@click.argument("file", type=options.OLD_FILE)
@options.record_option
@options.play_on_option
@click.option(
    "--against", multiple=True, type=options.OLD_FILE, help="Compare with this file's runs; may be given several times."
)
@click.option("--tick", type=click.IntRange(0, 10**6), default=0, help="Put the cursor on this tick.")
@options.window_options
def tas(
    file: Path, record: int | None, level_path: Path | None, against: tuple[Path, ...], tick: int, **window: Any
) -> int:
    """Edit a run tick by tick, in a window.

    FILE is a recording of any format, or a level, for a new run of it. On one side the level, on the other a row for
    each tick: its keys, and values of the world after it. Change keys, take over and play on, search for something
    better, keep branches. A replay text of ours is saved into its file; any other recording becomes a new one. Where
    the level was changed after the recording, the run opens on the present level, to be mended.

    \b
    Examples:
      ninja-game tas best.replay.txt
      ninja-game tas level.txt
      ninja-game tas demos.txt --record 3
      ninja-game tas best.replay.txt --against theirs.replay.txt
      ninja-game tas old.replay.txt --level changed.txt
    """
    from ninja_game.tas.files import open_run, runs_of_level

    opened = open_run(file, record=record, level=options.load_level_option(level_path))
    others = [run for path in against for run in runs_of_level(path, opened.recording)]
    from ninja_game.play.main import run_app
    from ninja_game.play.window import open_at_once
    from ninja_game.tas_editor.opening import OpeningScreen, open_tas_editor
    from ninja_game.tas_editor.screen import TasScreen

    def editor(app: App) -> TasScreen:
        screen = TasScreen(app, opened, others)
        screen.editor.go(tick)
        return screen

    def opening(app: App) -> Screen:
        # Pictures of the TAS editor are counted.
        return editor(app) if window["frames"] else OpeningScreen(app, opened.recording, lambda: editor(app))

    opened_window = open_at_once(window["size"], wide=True)
    return run_app(opening, tas_editor=open_tas_editor, window=opened_window, **window)


FIGURE_NAMES = (
    "grid", "bodies", "cells", "projection", "edges", "doors", "response", "grids", "nine-cells", "pairs", "bullets",
    "rays", "drones", "tick",
)  # fmt: skip


@click.command(epilog=f"\b\nFigures: {', '.join(FIGURE_NAMES)}.")
@click.argument("figure", metavar="[FIGURE]", required=False, type=click.Choice(FIGURE_NAMES))
@options.window_options
@options.output_option("Open no window: write a .png of it, or a .gif of its demonstration.")
def lab(figure: str | None, output: Path | None, **window: Any) -> int:
    """Drag, paint and watch: figures about how the world works.

    FIGURE is the one that is shown first.

    \b
    Examples:
      ninja-game lab
      ninja-game lab rays
      ninja-game lab edges -o edges.png
    """
    if output is not None and figure is None:
        raise click.UsageError("--output needs a FIGURE")
    if output is not None and figure is not None:
        from ninja_game.play.lab.screen import export_figure

        export_figure(figure, output)
        return 0
    from ninja_game.play.lab.screen import LabScreen
    from ninja_game.play.main import run_app

    return run_app(lambda app: LabScreen(app, figure or ""), **window)
