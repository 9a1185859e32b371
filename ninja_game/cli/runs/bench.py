"""`ninja-game bench`: how fast the world is on this machine."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ninja_game.errors import NinjaGameError

if TYPE_CHECKING:
    from ninja_game.formats.recording import Recording

ROWS = (
    ("plain_ticks_per_s", "plain memory", "ticks/s"),
    ("compiled_ticks_per_s", "compiled memory", "ticks/s"),
    ("load_us", "load a level, plain", "us"),
    ("save_plain_us", "save a state, plain", "us"),
    ("restore_plain_us", "restore a state, plain", "us"),
    ("load_compiled_us", "load a level, compiled", "us"),
    ("save_us", "save a state, compiled", "us"),
    ("restore_us", "restore a state, compiled", "us"),
    ("state_bytes", "size of a state, compiled", "bytes"),
    ("start_plain_s", "first tick of a process, plain", "s"),
    ("start_compiled_s", "first tick of a process, compiled", "s"),
    ("compile_s", "the same, nothing compiled before", "s"),
)
"""The figures that people are shown: name, meaning, unit."""


@click.command()
@click.argument("files", metavar="[FILE...]", nargs=-1, type=click.Path(exists=True, path_type=Path))
@click.option("--quick", is_flag=True, help="Leave the compile time out, which takes half a minute.")
@click.option("--json", "as_json", is_flag=True, help="One JSON object with all figures, for programs.")
@click.option(
    "--scaling", metavar="FOLDER", type=click.Path(file_okay=False, path_type=Path),
    help="Measure how cost grows, as CSV and pictures in this folder; takes minutes, and a checkout.",
)  # fmt: skip
@click.option(
    "--only", metavar="WORD", default="", help="Of the charts of --scaling only those with this in their name."
)
def command(files: Sequence[Path], quick: bool, as_json: bool, scaling: Path | None, only: str) -> None:
    """Measure how fast the world is on this machine.

    Runs the replays that come with the game, or those in FILE, on both memories; the costs of loading and of
    save-states are for the level of median size. Every figure is the median of several rounds on one thread.

    \b
    Examples:
      ninja-game bench
      ninja-game bench demos.txt --quick --json
      ninja-game bench --scaling charts/
    """
    from ninja_game.files.resources import bundled_replays
    from ninja_game.formats.load import load_replays
    from ninja_game.runs.benchmark import run_benchmark

    recordings = [recording for file in files or bundled_replays() for recording in load_replays(file)]
    if not recordings:
        raise NinjaGameError("the game's own replays are not here: name files of recordings")
    if scaling:
        _scale(recordings, scaling, only)
        return
    figures = run_benchmark(recordings, compile_time=not quick)
    if as_json:
        click.echo(json.dumps(figures))
        return
    click.echo(f"{figures['recordings']} recordings, Python {figures['python']}, {figures['machine']}")
    click.echo(f"costs for a level of {figures['objects']} objects")
    for name, meaning, unit in ROWS:
        if figures[name] is not None:
            click.echo(f"  {meaning:<34} {figures[name]:>14,} {unit}")
    click.echo(f"signature of all runs {figures['signature'][:16]}, of what was run {figures['corpus'][:16]}")


def _scale(recordings: Sequence[Recording], folder: Path, only: str) -> None:
    """Run the measurements of benchmarks/, which only a checkout has. Raises NinjaGameError without them."""
    from importlib import import_module

    from ninja_game.backend.memories import choose_memory
    from ninja_game.files.resources import PACKAGE

    choose_memory("compiled")
    if not (PACKAGE.parent / "benchmarks" / "scaling.py").is_file():
        raise NinjaGameError("--scaling needs the folder benchmarks/ of a checkout of ninja-game")
    sys.path.append(str(PACKAGE.parent))
    charts = import_module("benchmarks.scaling").measure(recordings, folder, only)
    drawn = all((folder / f"{chart.name}.png").is_file() for chart in charts)
    click.echo(
        f"{len(charts)} charts in {folder}" + ("" if drawn else "; pictures need the extra 'plots' (matplotlib)")
    )
