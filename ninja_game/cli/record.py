"""`ninja-game record`: run inputs that a person wrote, and write the result."""

from __future__ import annotations

from pathlib import Path

import click

from ninja_game.cli.convert import Output
from ninja_game.cli.run_options import budget_option, choose, heartbeat, level_given, other_level_option
from ninja_game.files.shown_text import shown_text
from ninja_game.files.user_folder import free_path
from ninja_game.formats.run_time import seconds_text


@click.command()
@click.argument("inputs", metavar="FILE", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option(
    "-o", "--output", type=click.Path(dir_okay=False, path_type=Path),
    help="The replay. [default: FILE's name and .replay.txt, in the current folder]",
)  # fmt: skip
@click.option("--record", type=click.IntRange(min=0), help="Which recording of the file, counted from 0.")
@other_level_option
@budget_option
@click.option("--force", is_flag=True, help="Replace a file that exists. FILE is never replaced.")
def record(
    inputs: Path, output: Path | None, record: int | None, level_path: Path | None, budget: int, force: bool
) -> None:
    """Run inputs that a person wrote, and write the result.

    FILE is a replay text with or without claims (docs/replay-format.md), or any other recording. Its inputs run until
    the exit, death or their end; outcome, gold, digest and waypoints of that run are written with them. Comments,
    blocks and files that are included become plain inputs; markers, names and authors stay. So does a replay whose
    level was changed after the recording: its inputs run on the level as it is now.

    \b
    Examples:
      ninja-game record idea.inputs.txt
      ninja-game record idea.inputs.txt -o best.replay.txt --force
      ninja-game record celeste.tas --level level.txt
      ninja-game record old.replay.txt --level changed.txt
    """
    from ninja_game.formats.load import load_replays
    from ninja_game.formats.replay.text import parse_replay
    from ninja_game.runs.conversion import on_level, replay_texts

    level = level_given(level_path)
    recording = choose(load_replays(inputs, level=level, changed=True), "recordings", inputs, record)
    with heartbeat(lambda: "running the inputs"):
        (text,) = replay_texts([on_level(recording, level)], budget)
    path = output or free_path(Path(), inputs.name.partition(".")[0], ".replay.txt")
    Output(str(path), [inputs], force=force).write(text)
    new = parse_replay(text)
    length = new.length
    when = f"{'in tick' if new.end_tick >= 0 else 'after ticks:'} {length} ({seconds_text(length)} s)"
    click.echo(f"{shown_text(str(path))}: {new.outcome} {when}, {new.gold} gold")
