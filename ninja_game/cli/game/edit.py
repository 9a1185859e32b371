"""`ninja-game edit`: the editor of levels."""

from __future__ import annotations

import os
from pathlib import Path

import click

from ninja_game.cli.run_options import LevelPath, window_options


@click.command()
@click.argument("level", required=False, type=LevelPath())
@click.option("--record", type=click.IntRange(0, 10**6), default=0, help="This level of the file, counted from 0.")
@window_options
@click.pass_context
def command(
    ctx: click.Context, level: Path | None, record: int, size: str | None, frames: int | None, screenshot: str | None
) -> None:
    """Make a level, or change one, in a window.

    LEVEL is a file of levels, or the name of one of the game's own; without it an empty level. A readable level is
    saved into its file, with its comments; a level of N or of the game becomes a new file among yours.

    \b
    Examples:
      ninja-game edit
      ninja-game edit my-level.txt
      ninja-game edit userlevels.txt --record 17
    """
    from ninja_game.cli.game.play import pixels
    from ninja_game.editor.files import Source, open_source
    from ninja_game.files.user_folder import data_folder

    window = pixels(size) if size else None
    source = open_source(level, record) if level is not None else None
    if source is not None and level is not None and level.is_relative_to(data_folder("levels")):
        source = Source(source.draft)
    os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
    from ninja_game.play.editor.screen import EditorScreen
    from ninja_game.play.main import run_app

    ctx.exit(run_app(lambda app: EditorScreen(app, source), size=window, frames=frames, screenshot=screenshot))
