"""`ninja-game splits` and `compare`: when runs take gold, touch switches and doors, and end; who is ahead where."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ninja_game.cli import options
from ninja_game.cli.commands import BAD_INPUT
from ninja_game.cli.progress import Readable, heartbeat, with_progress
from ninja_game.cli.tables import Table, as_json, draw, show, table_of, titles
from ninja_game.cli.terminal import data_output

if TYPE_CHECKING:
    from ninja_game.formats.recording import Recording
    from ninja_game.runs.compare import Comparison, Lead
    from ninja_game.runs.splits import RunSplits

SPLIT_COLUMNS = (
    "level_digest", "file", "record", "name", "event", "object", "number", "x", "y", "tick", "behind", "best_segment",
)  # fmt: skip

format_option = click.option(
    "--format", "form", type=click.Choice(["text", "json", "csv"]), default="text", show_default=True, help="Output."
)

picture_option = click.option(
    "--picture", metavar="OUT.png", type=options.NEW_FILE, help="Draw paths over the level, and speeds, into this file."
)


@click.command()
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=options.OLD_PATH)
@click.option(
    "--against",
    metavar="BEST",
    type=options.OLD_FILE,
    help="The run to compare with. [default: the fastest to the exit]",
)
@click.option("--gold/--no-gold", default=True, help="A split for each piece of gold, or for none.")
@options.level_option
@format_option
@picture_option
@options.budget_option
def splits(
    files: Sequence[Path],
    against: Path | None,
    gold: bool,
    level_path: Path | None,
    form: str,
    picture: Path | None,
    budget: int,
) -> int:
    """Show when runs take gold, open doors and the exit, and end.

    FILE is a replay of ours, a file of $name#author#comment#level#demo# records, or a folder of them. Each level has a
    table: a row per split, the tick of the best run, and how many ticks later (+) or earlier (-) each other run is
    there. The column "segment" has the fewest ticks from the row above that any of the runs needs; their sum is the
    "sum of best". Ticks count from 0; 40 are a second.

    Exit code 0: all is well; 2: something cannot be read.

    \b
    Examples:
      ninja-game splits first.replay.txt second.replay.txt
      ninja-game splits my-runs/ --against best.replay.txt --no-gold
      ninja-game splits demos.txt --format csv > splits.csv
    """
    from ninja_game.runs.recording_reader import recordings_in
    from ninja_game.runs.splits import SPLIT_EVENTS, run_splits

    level = options.load_level_option(level_path)
    events = [name for name in SPLIT_EVENTS if gold or name != "gold-taken"]
    read = Readable(recordings_in(files, level))
    recordings = list(read)
    best = list(Readable(recordings_in([against], level)))[:1] if against else []
    # A run that costs too much ends the command: a table without it would be wrong.
    all_runs = list(with_progress((run_splits(run, events, budget) for run in [*best, *recordings]), "run"))
    bests, runs = all_runs[: len(best)], all_runs[len(best) :]
    groups: dict[str, list[RunSplits]] = {}
    for run in runs:
        groups.setdefault(run.level_digest, []).append(run)
    if not groups:
        raise click.UsageError(f"{', '.join(map(str, files))}: no recordings here")
    if bests and bests[0].level_digest not in groups:
        raise click.UsageError(f"{against} is a run of another level")
    tables = [table_of(group, bests) for group in groups.values()]
    if form == "json":
        click.echo(json.dumps([as_json(*table) for table in tables]))
    elif form == "csv":
        _write_csv(tables)
    else:
        show(tables)
    if picture:
        drawn = tables[0][0]
        paths = list(zip(titles([run.recording for run in drawn]), (run.positions for run in drawn), strict=True))
        draw(picture, drawn[0].recording.level, paths, [*files, *filter(None, [level_path, against])])
    return BAD_INPUT if read.unreadable else 0


def _write_csv(tables: Sequence[Table]) -> None:
    """All tables as one, a line for each split of each run."""
    writer = csv.writer(data_output(), lineterminator="\n")
    writer.writerow(SPLIT_COLUMNS)
    for runs, rows in tables:
        for row in rows:
            for run, tick in zip(runs, row.ticks, strict=True):
                if tick is not None:
                    made, split = run.recording, row.split
                    behind = "" if row.ticks[0] is None else tick - row.ticks[0]
                    who = run.level_digest, made.file, made.record, made.name
                    where = split.event, split.object_id, split.number, split.x, split.y
                    writer.writerow([*who, *where, tick, behind, row.best_segment])


COMPARED = ("at", "x", "y", "tick", "other", "ahead")


@click.command()
@click.argument("first", metavar="A", type=options.OLD_FILE)
@click.argument("second", metavar="B", type=options.OLD_FILE)
@click.option("--record", type=click.IntRange(min=0), help="Which recording of A, counted from 0.")
@click.option("--against-record", type=click.IntRange(min=0), help="Which recording of B, counted from 0.")
@options.level_option
@format_option
@picture_option
@options.budget_option
def compare(
    first: Path,
    second: Path,
    record: int | None,
    against_record: int | None,
    level_path: Path | None,
    form: str,
    picture: Path | None,
    budget: int,
) -> None:
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

    level = options.load_level_option(level_path)
    ours = options.choose(load_replays(first, level=level), "recordings", first, record)
    theirs = options.choose(load_replays(second, level=level), "recordings", second, against_record)
    with heartbeat(lambda: "running both"):
        comparison = compare_runs(ours, theirs, budget)
    if form == "json":
        parts = {"first_keys": comparison.first_keys, "first_place": comparison.first_place}
        leads = {"splits": list(map(_cells, comparison.splits)), "places": list(map(_cells, comparison.places))}
        click.echo(json.dumps({**parts, "columns": COMPARED, **leads}))
    elif form == "csv":
        writer = csv.writer(data_output(), lineterminator="\n")
        writer.writerows([COMPARED, *map(_cells, [*comparison.splits, *comparison.places])])
    else:
        _show_comparison(comparison, ours, theirs)
    if picture:
        paths = list(zip(titles([ours, theirs]), comparison.positions, strict=True))
        draw(picture, ours.level, paths, [first, second, *filter(None, [level_path])])


def _cells(lead: Lead) -> tuple[str, float, float, int, int, int]:
    return *lead, lead.ahead


def _show_comparison(comparison: Comparison, ours: Recording, theirs: Recording) -> None:
    from ninja_game.runs.compare import each_second

    both = zip("AB", titles([ours, theirs]), comparison.positions, comparison.deaths, strict=True)
    for letter, name, positions, death in both:
        click.echo(f"{letter}: {name}, {len(positions)} ticks" + (f", dead: {death}" if death else ""))
    if comparison.first_keys is None and comparison.first_place is None:
        click.echo("the runs are equal")
        return
    for what, tick in (("keys", comparison.first_keys), ("place", comparison.first_place)):
        click.echo(f"first other {what}: " + ("never" if tick is None else f"tick {tick}"))
    _show_leads("at the splits of both", comparison.splits)
    _show_leads("at the place where A is, each second", each_second(comparison.places))


def _show_leads(heading: str, leads: Sequence[Lead]) -> None:
    click.echo(f"\n{heading}:\n{'':<20} {'x':>5} {'y':>5} {'A':>6} {'B':>6}  A ahead by")
    for lead in leads:
        click.echo(f"{lead.at:<20} {lead.x:>5.0f} {lead.y:>5.0f} {lead.tick:>6} {lead.other:>6}  {lead.ahead:+d}")
