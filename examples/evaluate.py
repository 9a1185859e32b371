"""Measure how often an agent passes levels.

    python3 -m examples.evaluate random --levels 00-0-first-steps
    python3 -m examples.evaluate learned --levels test --episodes 100 --json -o learned.json

AGENT is random, search, learned, or a file that examples/ppo.py or imitate.py wrote. A policy is tried in many
episodes that differ: actions are repeated by chance, and an episode begins with some steps of waiting. The search agent
plays the run that it found, once in each level.
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Sequence
from dataclasses import asdict, astuple, fields
from math import isnan
from pathlib import Path

import click

from examples.agents import load_agent, tell_compiling
from ninja_game.errors import NinjaGameError
from ninja_game.files.shown_text import shown_text
from ninja_game.files.writing import write_atomically
from ninja_game.learn.evaluation import Evaluation, LevelResult, evaluate


def as_text(table: Evaluation) -> str:
    """The table for people, one line per level, and a last one over all."""
    lines = [f"{'level':<26} {'passed':>11} {'dead':>6} {'late':>6} {'ticks':>7} {'gold':>6} {'reward':>8}"]
    for each in table.results:
        ticks = "-" if isnan(each.ticks) else f"{each.ticks:.0f}"
        passed = f"{each.passed}/{each.episodes}"
        ends = f"{passed:>11} {each.dead:>6} {each.late:>6}"
        lines.append(f"{shown_text(each.level):<26.26} {ends} {ticks:>7} {each.gold:>6.1f} {each.reward:>8.2f}")
    passed, episodes = (sum(getattr(each, name) for each in table.results) for name in ("passed", "episodes"))
    often = f"{table.count_passed()} of {len(table.results)} levels in 90 % of their episodes or more"
    who, rate = shown_text(table.agent), passed / episodes
    lines.append(f"{who}: {passed} of {episodes} episodes passed ({rate:.1%}), {often}")
    return "\n".join(lines)


def as_json(table: Evaluation) -> str:
    """Everything as one JSON object; what is not a number is null."""
    rows = [{**asdict(each), "rate": each.rate} for each in table.results]
    for row in rows:
        row["ticks"] = None if isnan(row["ticks"]) else row["ticks"]
    return json.dumps({**asdict(table), "results": rows, "count_passed": table.count_passed()}, indent=1)


def as_csv(table: Evaluation) -> str:
    """The table for spreadsheets, one row per level."""
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(["agent", *(field.name for field in fields(LevelResult)), "rate"])
    for each in table.results:
        row = [table.agent, *astuple(each), each.rate]
        rows.writerow(["" if isinstance(value, float) and isnan(value) else value for value in row])
    return text.getvalue()


FORMS = {"text": as_text, "json": as_json, "csv": as_csv}


@click.command(help=__doc__.replace("\n    python3", "\n\b\n    python3", 1))
@click.argument("agent_name", metavar="AGENT")
@click.option(
    "--levels", metavar="LEVELS", multiple=True, default=("test",), show_default=True,
    help="test, set, bench:val:easy, a level of the game, a file, generated:3:1-8. May be given several times.",
)  # fmt: skip
@click.option("--episodes", type=click.IntRange(1, 100_000), default=20, show_default=True, help="Tries in each level.")
@click.option(
    "--seed", type=click.IntRange(0), default=1_000_000, show_default=True, help="The same seed gives the same table."
)
@click.option(
    "--repeat", type=click.FloatRange(0, 0.99), default=0.25, show_default=True,
    help="Probability that an action is played once more in place of the next one.",
)  # fmt: skip
@click.option(
    "--wait", type=click.IntRange(0, 100), default=7, show_default=True, help="Most steps of waiting at the start."
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
@click.option(
    "--memory", type=click.Choice(["auto", "plain", "compiled"]), default="auto", show_default=True,
    help="Plain Python, or compiled by Numba; both give the same bits.",
)  # fmt: skip
def main(
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
    tell_compiling()
    try:
        table = evaluate(
            load_agent(agent_name), list(levels), name=agent_name, episodes=episodes, seed=seed, repeat=repeat,
            longest_wait=wait, time_limit=time_limit, memory=memory,
        )  # fmt: skip
        text = FORMS[form or "text"](table).rstrip("\n")
        if output is not None:
            write_atomically(output, text + "\n")
    except (NinjaGameError, OSError) as error:
        raise click.ClickException(str(error)) from error
    click.echo(f"{output}: {len(table.results)} levels" if output else text)


if __name__ == "__main__":
    main()
