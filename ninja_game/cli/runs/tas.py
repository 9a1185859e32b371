"""`ninja-game tas`: the TAS editor."""

from __future__ import annotations

import os
from pathlib import Path

import click

from ninja_game.cli.run_options import level_given, other_level_option, window_options
from ninja_game.play.app import App, Screen


@click.command()
@click.argument("file", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--record", type=click.IntRange(min=0), help="Which recording of the file, counted from 0.")
@other_level_option
@click.option(
    "--beside", multiple=True, type=click.Path(exists=True, dir_okay=False, path_type=Path),
    help="Another file with runs of the same level, to be shown beside; may be given several times.",
)  # fmt: skip
@click.option("--tick", type=click.IntRange(0, 10**6), default=0, help="Put the cursor on this tick.")
@window_options
@click.pass_context
def command(
    ctx: click.Context, file: Path, record: int | None, level_path: Path | None, beside: tuple[Path, ...],
    tick: int, size: str | None, frames: int | None, screenshot: str | None,
) -> None:  # fmt: skip
    """Edit a run tick by tick, in a window.

    FILE is a recording of any format. On one side the level, on the other a row for each tick: its keys, and what the
    world says after it. Change keys, take over and play on, search for something better, keep branches. A replay text
    of ours is saved into its file; any other recording becomes a new one. Where the level was changed after the
    recording, the run opens on the level as it is now, to be mended.

    \b
    Examples:
      ninja-game tas best.replay.txt
      ninja-game tas demos.txt --record 3
      ninja-game tas best.replay.txt --beside theirs.replay.txt
      ninja-game tas old.replay.txt --level changed.txt
    """
    from ninja_game.cli.game.play import pixels
    from ninja_game.tas.files import open_run, runs_of_level

    window = pixels(size) if size else None
    opened = open_run(file, record=record, level=level_given(level_path))
    others = [run for path in beside for run in runs_of_level(path, opened.recording)]
    os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
    from ninja_game.play.main import run_app
    from ninja_game.play.tas.opening import OpeningScreen
    from ninja_game.play.tas.screen import TasScreen

    def editor(app: App) -> TasScreen:
        screen = TasScreen(app, opened, others)
        screen.editor.go(tick)
        return screen

    def opening(app: App) -> Screen:
        # So many pictures are pictures of the TAS editor.
        return editor(app) if frames is not None else OpeningScreen(app, opened.recording, lambda: editor(app))

    ctx.exit(run_app(opening, size=window, frames=frames, screenshot=screenshot))
