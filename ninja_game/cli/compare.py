"""`ninja-game compare`: two runs of a level, and which is ahead where."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ninja_game.cli.run_options import budget_option, choose, heartbeat, level_given, level_option
from ninja_game.cli.splits import draw, format_option, picture_option, titles
from ninja_game.cli.terminal import data_output

if TYPE_CHECKING:
    from ninja_game.formats.recording import Recording
    from ninja_game.runs.compare import Comparison, Lead

COLUMNS = ("at", "x", "y", "tick", "other", "ahead")


@click.command()
@click.argument("first", metavar="A", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.argument("second", metavar="B", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--record", type=click.IntRange(min=0), help="Which recording of A, counted from 0.")
@click.option("--against-record", type=click.IntRange(min=0), help="Which recording of B, counted from 0.")
@level_option
@format_option
@picture_option
@budget_option
def compare(
    first: Path, second: Path, record: int | None, against_record: int | None, level_path: Path | None, form: str,
    picture: Path | None, budget: int,
) -> None:  # fmt: skip
    """Compare two runs of a level: where they part, and how far one is ahead.

    The lead is reported at each split that both reach, and at the end of each second of A at the place where it is
    then: how many ticks later B is there. With --format csv or json it is reported for every tick of A at whose place B
    comes within 24 px, in the order in which both go through the level. A and B may be the same file.

    \b
    Examples:
      ninja-game compare mine.replay.txt best.replay.txt
      ninja-game compare demos.txt demos.txt --record 3 --against-record 5 --picture both.png
    """
    from ninja_game.formats.load import load_replays
    from ninja_game.runs.compare import compare_runs

    level = level_given(level_path)
    ours = choose(load_replays(first, level=level), "recordings", first, record)
    theirs = choose(load_replays(second, level=level), "recordings", second, against_record)
    with heartbeat(lambda: "running both"):
        found = compare_runs(ours, theirs, budget)
    if form == "json":
        parts = {"first_keys": found.first_keys, "first_place": found.first_place}
        leads = {"splits": list(map(_cells, found.splits)), "places": list(map(_cells, found.places))}
        click.echo(json.dumps({**parts, "columns": COLUMNS, **leads}))
    elif form == "csv":
        writer = csv.writer(data_output(), lineterminator="\n")
        writer.writerows([COLUMNS, *map(_cells, [*found.splits, *found.places])])
    else:
        _show(found, ours, theirs)
    if picture:
        paths = list(zip(titles([ours, theirs]), found.positions, strict=True))
        draw(picture, ours.level, paths, [first, second, *filter(None, [level_path])])


def _cells(lead: Lead) -> tuple[str, float, float, int, int, int]:
    return *lead, lead.ahead


def _show(found: Comparison, ours: Recording, theirs: Recording) -> None:
    from ninja_game.runs.compare import each_second

    for letter, name, positions in zip("AB", titles([ours, theirs]), found.positions, strict=True):
        click.echo(f"{letter}: {name}, {len(positions)} ticks")
    if found.first_keys is None and found.first_place is None:
        click.echo("the runs are equal")
        return
    for what, tick in (("keys", found.first_keys), ("place", found.first_place)):
        click.echo(f"first other {what}: {'never' if tick is None else f'tick {tick}'}")
    _show_leads("at the splits of both", found.splits)
    _show_leads("at the place where A is, each second", each_second(found.places))


def _show_leads(heading: str, leads: Sequence[Lead]) -> None:
    click.echo(f"\n{heading}:\n{'':<20} {'x':>5} {'y':>5} {'A':>6} {'B':>6}  A ahead by")
    for lead in leads:
        click.echo(f"{lead.at:<20} {lead.x:>5.0f} {lead.y:>5.0f} {lead.tick:>6} {lead.other:>6}  {lead.ahead:+d}")
