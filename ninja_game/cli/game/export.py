"""`ninja-game export`: a film of a recording."""

from __future__ import annotations

import os
from pathlib import Path

import click

from ninja_game.cli.game.play import pixels
from ninja_game.cli.run_options import InputPath, level_given, level_option
from ninja_game.errors import NinjaGameError
from ninja_game.formats.links.fragment import is_link


@click.command()
@click.argument("replay", type=InputPath(dir_okay=False))
@click.option(
    "-o", "--out", type=click.Path(path_type=Path),
    help="The film: NAME.gif, or a folder for one PNG picture a tick. Without it, the replay's name with .gif.",
)  # fmt: skip
@click.option("--record", type=click.IntRange(min=0), default=0, help="Which recording of the file, counted from 0.")
@click.option(
    "--size", metavar="WIDTHxHEIGHT", default="528x400", show_default=True, help="Size of the pictures in px."
)
@click.option("--speed", type=click.FloatRange(0.05, 16), default=1.0, show_default=True, help="1 is the game's speed.")
@level_option
def command(replay: Path, out: Path | None, record: int, size: str, speed: float, level_path: Path | None) -> None:
    """Write a film of a recording: a GIF, or a folder of pictures.

    REPLAY is a replay of ours, a level file with demos, or a link. A GIF of more than 600 ticks shows every second one.

    \b
    Examples:
      ninja-game export run.replay.txt
      ninja-game export run.replay.txt -o slow.gif --speed 0.5 --size 792x600
      ninja-game export userlevels.txt --record 17 -o pictures
    """
    from ninja_game.formats.load import load_replays

    recordings = load_replays(replay, level=level_given(level_path))
    if record >= len(recordings):
        raise NinjaGameError(f"{replay}: there is no record {record}; the last one is {len(recordings) - 1}")
    path = out or Path("replay.gif" if is_link(replay) else f"{replay.name.partition('.')[0]}.gif")
    if path.exists() and not is_link(replay) and path.samefile(replay):
        raise click.UsageError("the film would replace the replay")
    width_and_height = pixels(size)

    os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
    os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
    from ninja_game.play.replay.export import export_film, film_length
    from ninja_game.play.replay.playback import recorded_run

    run = recorded_run(recordings[record])
    try:
        export_film(run, path, size=width_and_height, speed=speed)
    except OSError as error:
        raise NinjaGameError(f"{path}: the film cannot be written: {error.strerror}") from None
    click.echo(f"{path}: {film_length(run)} ticks")
