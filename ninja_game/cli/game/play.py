"""`ninja-game play`: the game in a window."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Literal

import click

from ninja_game.cli.run_options import InputPath, LevelPath, level_option, window_options


@click.command()
@click.argument("level", required=False, type=LevelPath())
@click.option(
    "--record", type=click.IntRange(0, 10**6), default=0, help="Begin with this level of the file, counted from 0."
)
@click.option(
    "--body", type=click.Choice(["circle", "box"]), default="circle", show_default=True,
    help="The ninja's body: the circle of the classic rules, or a box of the same size.",
)  # fmt: skip
@click.option("--practice", is_flag=True, help="No time limit, nothing counts.")
@click.option("--replay", type=InputPath(dir_okay=False), help="Watch the recordings of this file or link.")
@level_option
@window_options
@click.pass_context
def command(
    ctx: click.Context,
    level: Path | None,
    record: int,
    body: Literal["circle", "box"],
    practice: bool,
    replay: Path | None,
    level_path: Path | None,
    size: str | None,
    frames: int | None,
    screenshot: str | None,
) -> None:
    """Play a level in a window.

    LEVEL is a file of levels, the name of one of the game's own, or a link; without it the game begins at its menu.
    Links hold everything that they need: no network is asked. A pack, a
    folder or zip with pack.toml, offers its episodes; with --practice, --body or --record its levels are played one
    after the other. The menus offer your own files and packs too: those in the folder `levels` of your folder for this
    game, which NINJA_GAME_HOME moves; a file that is dropped on the menu Levels is copied there.

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
    path = next((str(each) for each in (level, level_path) if each is not None), None)
    window = pixels(size) if size else None

    os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
    from ninja_game.play.main import main

    code = main(
        path,
        body=body,
        size=window,
        replay_path=str(replay) if replay is not None else None,
        practice=practice,
        frames=frames,
        screenshot=screenshot,
        record=record,
    )
    ctx.exit(code)


def pixels(size: str) -> tuple[int, int]:
    """Width and height from ``WIDTHxHEIGHT``."""
    width, _, height = size.lower().partition("x")
    digits = re.compile("[1-9][0-9]{1,4}")
    if not all(digits.fullmatch(part) and int(part) <= 16384 for part in (width, height)):
        raise click.UsageError(f"--size is {size!r}; expected WIDTHxHEIGHT in px, e.g. 1584x1200")
    return int(width), int(height)
