"""`ninja-game demonstrations`: recordings as observations, actions and rewards."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from ninja_game.budget import DATASET_MIB
from ninja_game.cli.options import OLD_PATH, level_option, load_level_option, memory_option, output_option
from ninja_game.cli.progress import with_progress
from ninja_game.cli.terminal import print_error
from ninja_game.sim.rules import LIFETIME


@click.command(name="demonstrations")
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=OLD_PATH)
@output_option("Write arrays to this .npz file.")
@click.option("--minari", "dataset", metavar="NAME", help="Write a Minari data set of this name, such as ninja/set-v0.")
@click.option(
    "--observation",
    "parts",
    metavar="PART",
    multiple=True,
    default=("state",),
    show_default=True,
    help="What is observed, as `Ninja-v0` has it; may be given several times.",
)
@click.option("--flat", is_flag=True, help="Put all parts into one row of numbers.")
@click.option(
    "--actions",
    type=click.Choice(["discrete", "buttons"]),
    default="discrete",
    show_default=True,
    help="An action as a number from 0 to 5, or as three keys, each up or down.",
)
@click.option(
    "--megabytes",
    type=click.IntRange(1, 10**6),
    default=DATASET_MIB,
    show_default=True,
    help="The most that all observations may take; making arrays of them takes four times as much memory.",
)
@level_option
@memory_option
def demonstrations(
    files: Sequence[Path],
    output: Path | None,
    dataset: str | None,
    parts: Sequence[str],
    flat: bool,
    actions: str,
    megabytes: int,
    level_path: Path | None,
    memory: str,
) -> None:
    """Make demonstrations for learning agents of recordings.

    A demonstration has the observation, the action and the reward of each tick. It needs Gymnasium, the extra 'learn'.

    FILE is a replay of ours, a file of $name#author#comment#level#demo# records, or a folder of them. Recordings that
    no agent could have made, since they press jump again while it is held, are left out and named.

    \b
    Examples:
      ninja-game demonstrations levels/certificates -o demos.npz
      ninja-game demonstrations levels/certificates --minari ninja/set-v0
    """
    if (output is None) == (dataset is None):
        raise click.UsageError("no output given; add --output FILE.npz or --minari NAME")
    if output is not None and output.suffix != ".npz":
        raise click.UsageError(f"{output}: expected a name that ends in .npz")
    from ninja_game.errors import ArgumentError
    from ninja_game.files.writing import check_output
    from ninja_game.formats.load import load_replays
    from ninja_game.learn import demonstrations as learn

    if output is not None:
        check_output(output, keep=files)
    else:
        learn.require_minari()
    level = load_level_option(level_path)
    recordings = [recording for file in files for recording in load_replays(file, level=level)]
    observation = parts[0] if len(parts) == 1 else list(parts)
    limit = max([LIFETIME, *(len(recording.inputs) for recording in recordings)])
    settings: dict[str, Any] = {"observation": observation, "flat": flat, "actions": actions, "time_limit": limit}
    episodes = []
    left_bytes = megabytes * 2**20
    for recording in with_progress(recordings, "recording"):
        try:
            episodes.append(learn.demonstration(recording, memory=memory, most_bytes=left_bytes, **settings))
            left_bytes -= learn.observation_size(episodes[-1].observations)
        except learn.UnplayableRecordingError as error:
            print_error(f"left out: {error}")
    if not episodes:
        raise ArgumentError("none of these recordings can be a demonstration")
    if output is not None:
        learn.write_npz(output, episodes)
    else:
        learn.write_minari(str(dataset), episodes, **settings)
    steps = sum(len(run.rewards) for run in episodes)
    passed = sum(run.outcome == "exit" for run in episodes)
    left_out = len(recordings) - len(episodes)
    text = f"{output or dataset}: {len(episodes)} demonstrations, {steps:,} steps, {passed} to the exit"
    click.echo(f"{text}, {left_out} left out" if left_out else text)
