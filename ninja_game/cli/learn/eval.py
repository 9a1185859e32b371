"""`ninja-game learn eval`: how often an agent passes levels."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from ninja_game.cli.run_options import memory_option, with_progress


@click.command(name="eval")
@click.argument("agent_name", metavar="AGENT")
@click.option(
    "--levels", metavar="LEVELS", multiple=True, default=("test",), show_default=True,
    help="test, train, set, a level of the game, a file or folder, generated:3:1-8. May be given several times.",
)  # fmt: skip
@click.option("--episodes", type=click.IntRange(1, 100_000), default=20, show_default=True, help="Tries in each level.")
@click.option(
    "--seed", type=click.IntRange(0), default=1_000_000, show_default=True, help="The same seed gives the same table."
)
@click.option(
    "--repeat", type=click.FloatRange(0, 0.99), default=0.25, show_default=True,
    help="Chance that an action is played once more in place of the next one.",
)  # fmt: skip
@click.option(
    "--wait",
    type=click.IntRange(0, 100),
    default=7,
    show_default=True,
    help="Most steps of waiting at the start.",
)
@click.option(
    "--time-limit",
    type=click.IntRange(1, 100_000),
    default=2000,
    show_default=True,
    help="Ticks after which an episode is truncated.",
)
@click.option("--json", "form", flag_value="json", help="One JSON object, for programs.")
@click.option("--csv", "form", flag_value="csv", help="One row per level, for spreadsheets.")
@click.option("--output", "-o", type=click.Path(dir_okay=False, path_type=Path), help="Write the table to this file.")
@memory_option
def command(
    agent_name: str,
    levels: Sequence[str],
    episodes: int,
    seed: int,
    repeat: float,
    wait: int,
    time_limit: int,
    form: str | None,
    output: Path | None,
    memory: str,
) -> None:
    """Measure how often an agent passes levels.

    AGENT is random, search, learned, or the file of an agent that `learn train` wrote. A policy is tried in many
    episodes that differ: actions are repeated by chance, and an episode begins with some steps of waiting. The search
    agent plays the run that it found, once in each level.

    \b
    Examples:
      ninja-game learn eval random --levels 00-0-first-steps
      ninja-game learn eval learned --levels test --episodes 100 --json -o learned.json
    """
    from ninja_game.files.writing import check_output, write_atomically
    from ninja_game.learn.agents import load_agent
    from ninja_game.learn.evaluation import Evaluation, level_results
    from ninja_game.learn.levels import level_source

    if output is not None:
        check_output(output)
    agent = load_agent(agent_name)
    source = level_source(list(levels))
    rows = level_results(agent, source, episodes, seed, repeat, wait, time_limit, memory)
    results = list(with_progress(rows, "level"))
    table = Evaluation(agent_name, source.digest, seed, repeat, wait, time_limit, results)
    text = {"json": table.json, "csv": table.csv}.get(form or "", table.text)()
    if output is not None:
        write_atomically(output, text.rstrip("\n") + "\n")
        click.echo(f"{output}: {len(results)} levels")
    else:
        click.echo(text.rstrip("\n"))
