"""`ninja-game film`: a film of a recording."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import click

from ninja_game.cli.options import InputPath, PixelSize, choose, level_option, load_level_option, record_option
from ninja_game.cli.progress import heartbeat
from ninja_game.cli.terminal import size_note, use_dummy_video
from ninja_game.errors import NinjaGameError
from ninja_game.files.shown_text import shown_text
from ninja_game.files.user_folder import free_path
from ninja_game.formats.links import is_link
from ninja_game.formats.recording import Recording
from ninja_game.sim.level import Level

MAX_BESIDE = 3

_runs_option = partial(click.option, multiple=True, metavar="FILE", type=InputPath(dir_okay=False))


@click.command()
@click.argument("replay", type=InputPath(dir_okay=False))
@click.option(
    "-o",
    "--output",
    type=click.Path(path_type=Path),
    help="The film: NAME.gif, NAME.webm, NAME.mp4, or a folder for one PNG picture per tick. [default: a new file with "
    "the replay's name and .gif]",
)
@record_option
@click.option("--size", type=PixelSize(), default="528x400", show_default=True, help="Size of the pictures in px.")
@click.option("--speed", type=click.FloatRange(0.05, 16), default=1.0, show_default=True, help="1 is the game's speed.")
@click.option("--from", "first", type=click.IntRange(min=0), default=0, help="First picture: after this many ticks.")
@click.option(
    "--to", "last", type=click.IntRange(min=0), help="Last picture. [default: a second after the end; 20,000 at most]"
)
@_runs_option(
    "--ghost", "ghosts", help="Show the runs of this file on the same level as ghosts; may be given several times."
)
@_runs_option("--beside", help="Show the runs of this file, three at most, in pictures of their own beside the first.")
@click.option("--keys", is_flag=True, help="Show the keys that are down.")
@click.option("--splits", is_flag=True, help="Show time and last splits, and how far others are behind (+).")
@click.option("--gold", is_flag=True, help="With --splits: a split for each piece of gold, too.")
@level_option
def film(
    replay: Path, output: Path | None, record: int | None, size: tuple[int, int], speed: float, first: int,
    last: int | None, ghosts: Sequence[Path], beside: Sequence[Path], keys: bool, splits: bool, gold: bool,
    level_path: Path | None,
) -> None:  # fmt: skip
    """Write a film of a recording: a GIF, a WebM, an MP4, or a folder of pictures.

    REPLAY is a replay of ours, a level file with demos, or a link; all levels of an episode are shown, one after the
    other. A GIF of more than 600 ticks shows every second one; a WebM or MP4, which need the extra `film`, show 60
    pictures a second at most.

    \b
    Examples:
      ninja-game film run.replay.txt
      ninja-game film run.replay.txt -o slow.webm --speed 0.5 --size 792x600 --keys
      ninja-game film run.replay.txt --from 120 --to 200 --ghost best.replay.txt
      ninja-game film ann.replay.txt --beside bob.replay.txt --keys --splits -o race.mp4
      ninja-game film userlevels.txt --record 17 -o pictures
    """
    from ninja_game.formats.load import load_replays

    level = load_level_option(level_path)
    replays = load_replays(replay, level=level)
    parts = replays if replays[0].episode and record is None else [choose(replays, "recordings", replay, record)]
    path = output or free_path(Path(), "replay" if is_link(replay) else replay.name.partition(".")[0], ".gif")
    if path.exists() and any(not is_link(file) and path.samefile(file) for file in (replay, *ghosts, *beside)):
        raise click.UsageError("the film would replace the replay")
    ghosts_of, beside_of = _by_part(parts, ghosts, level), _by_part(parts, beside, level)
    most = max(map(len, beside_of))
    if most > MAX_BESIDE:
        raise click.UsageError(f"--beside: {most} runs; at most {MAX_BESIDE}")
    if any(len(runs) != most for runs in beside_of):
        raise click.UsageError("--beside: as many runs for each level of the episode; another whole episode has them")
    use_dummy_video()
    from ninja_game.play.replay.film import Film, length_of, section_of, write_film

    alone = len(parts) == 1
    films = [
        Film(
            part, size, speed, ghosts=its_ghosts, beside=its_neighbours, keys=keys, splits=splits, gold=gold,
            first=first if alone else 0, last=last if alone else None,
        )
        for part, its_ghosts, its_neighbours in zip(parts, ghosts_of, beside_of, strict=True)
    ]  # fmt: skip
    if not alone and (first or last is not None):
        films = section_of(films, first, last)
    progress = "looking for the end of the run"

    def report(made: int, count: int) -> bool:
        nonlocal progress
        progress = f"{made:,} of {count:,} pictures"
        return True

    try:
        with heartbeat(lambda: progress):
            write_film(films, path, report)
    except OSError as error:
        raise NinjaGameError(f"{path}: the film cannot be written: {error.strerror}") from None
    click.echo(f"{shown_text(str(path))}: {length_of(films)} ticks{size_note(path)}")


def _by_part(parts: Sequence[Recording], files: Sequence[Path], level: Level | None) -> list[tuple[Recording, ...]]:
    """The runs of files that a film shows with each of its parts. Raises UsageError for a run of another level."""
    from ninja_game.formats.load import load_replays

    runs = [run for file in files for run in load_replays(file, level=level)]
    levels = [part.level for part in parts]
    if any(run.level not in levels for run in runs):
        raise click.UsageError("--ghost, --beside: a run of another level")
    return [tuple(run for run in runs if run.level == level) for level in levels]
