"""`ninja-game splits` and `compare`: when runs take gold, touch switches and doors, and end; who is ahead where."""

from __future__ import annotations

import csv
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ninja_game.cli import options
from ninja_game.cli.commands import BAD_INPUT
from ninja_game.cli.terminal import data_output, use_dummy_video
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.files.user_folder import REPLAY_SUFFIX
from ninja_game.formats.run_time import seconds_text

if TYPE_CHECKING:
    from ninja_game.formats.recording import Recording
    from ninja_game.runs.compare import Comparison, Lead, RunSplits, SplitRow
    from ninja_game.sim.level import Level

WIDTH = 160  # width of a table in a pipe, characters

COLUMNS = (
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
    files: Sequence[Path], against: Path | None, gold: bool, level_path: Path | None, form: str,
    picture: Path | None, budget: int,
) -> int:  # fmt: skip
    """Show when runs take gold, open doors and the exit, and end.

    FILE is a replay of ours, a file of $name#author#comment#level#demo# records, or a folder of them. Each level has a
    table: a row a split, the tick of the best run, and how many ticks later (+) or earlier (-) each other run is
    there. The column "segment" has the fewest ticks from the row above that any of the runs needs; their sum is the
    "sum of best". Ticks count from 0; 40 are a second.

    Exit code 0: all is well; 2: something cannot be read.

    \b
    Examples:
      ninja-game splits first.replay.txt second.replay.txt
      ninja-game splits my-runs/ --against best.replay.txt --no-gold
      ninja-game splits demos.txt --format csv > splits.csv
    """
    from ninja_game.runs.compare import SPLIT_EVENTS, run_splits
    from ninja_game.runs.recording_reader import recordings_in

    level, events = (
        options.load_level_option(level_path),
        [name for name in SPLIT_EVENTS if gold or name != "gold-taken"],
    )
    read = options.Readable(recordings_in(files, level))
    found = list(read)
    best = list(options.Readable(recordings_in([against], level)))[:1] if against else []
    # A run that costs too much ends the command: a table without it would be wrong.
    all_runs = list(options.with_progress((run_splits(run, events, budget) for run in [*best, *found]), "run"))
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


Table = tuple["list[RunSplits]", "list[SplitRow]"]  # the runs of a level, the best first, and the rows of their splits


def table_of(group: Sequence[RunSplits], given: Sequence[RunSplits]) -> Table:
    """The table of runs of a level, against the given one of it or else the fastest."""
    from ninja_game.runs.compare import best_run, split_table

    best = next((run for run in given if run.level_digest == group[0].level_digest), None) or best_run(group)
    runs = [best, *(run for run in group if run is not best)]
    return runs, split_table(runs, best)


def titles(recordings: Sequence[Recording]) -> list[str]:
    """What tells recordings apart: their names, or file and record where there is no name or two are the same."""
    names = [shown_text(recording.name) for recording in recordings]
    return [
        name
        if name and names.count(name) == 1
        else f"{shown_text(Path(recording.file).name.removesuffix(REPLAY_SUFFIX))}:{recording.record}"
        for name, recording in zip(names, recordings, strict=True)
    ]


def show(tables: Sequence[Table]) -> None:
    from rich.console import Console
    from rich.table import Table as RichTable

    from ninja_game.runs.compare import sum_of_best
    from ninja_game.runs.deaths import ending_text

    console = Console(highlight=False, markup=False, width=None if sys.stdout.isatty() else WIDTH)
    for runs, rows in tables:
        best, (name, *others) = runs[0], titles([run.recording for run in runs])
        end = best.ticks - (best.outcome != "running")
        ends = ending_text(best.outcome, end, best.death)
        console.print(f"{name}: {ends}, {seconds_text(end)} s, {best.gold} gold")
        table = RichTable(box=None, pad_edge=False, header_style="bold")
        table.add_column("split")
        for name in ("x", "y", "tick", "segment", *others):
            table.add_column(name, justify="right")
        for row in rows:
            first = row.ticks[0]
            cells = [_behind(tick, first) for tick in row.ticks[1:]]
            place = f"{row.split.x:.0f}", f"{row.split.y:.0f}"
            table.add_row(row.split.name, *place, _number(first), _number(row.best_segment), *cells)
        console.print(table)
        last = sum_of_best(rows)
        console.print(f"sum of best: tick {last}, {seconds_text(last)} s\n")


def _number(count: int | None) -> str:
    return "" if count is None else str(count)


def _behind(tick: int | None, best: int | None) -> str:
    if tick is None:
        return "-"
    return f"{tick - best:+d}" if best is not None else str(tick)


def as_json(runs: Sequence[RunSplits], rows: Sequence[SplitRow]) -> dict[str, Any]:
    from ninja_game.runs.compare import sum_of_best

    return {
        "level_digest": runs[0].level_digest,
        "runs": [
            {"file": run.recording.file, "record": run.recording.record, "name": run.recording.name,
             "outcome": run.outcome, "ticks": run.ticks, "gold": run.gold}
            for run in runs
        ],
        "splits": [
            {"event": row.split.event, "object": row.split.object_id, "number": row.split.number, "x": row.split.x,
             "y": row.split.y, "ticks": row.ticks, "best_segment": row.best_segment}
            for row in rows
        ],
        "sum_of_best_tick": sum_of_best(rows),
    }  # fmt: skip


def _write_csv(tables: Sequence[Table]) -> None:
    """All tables as one, a line for each split of each run."""
    writer = csv.writer(data_output(), lineterminator="\n")
    writer.writerow(COLUMNS)
    for runs, rows in tables:
        for row in rows:
            for run, tick in zip(runs, row.ticks, strict=True):
                if tick is not None:
                    made, split = run.recording, row.split
                    behind = "" if row.ticks[0] is None else tick - row.ticks[0]
                    who = run.level_digest, made.file, made.record, made.name
                    where = split.event, split.object_id, split.number, split.x, split.y
                    writer.writerow([*who, *where, tick, behind, row.best_segment])


def draw(picture: Path, level: Level, paths: Sequence[tuple[str, Any]], keep: Sequence[Path]) -> None:
    """Write the picture of runs of one level. Raises ArgumentError where it would replace one of ``keep``, OSError."""
    use_dummy_video()
    from ninja_game.files.writing import write_atomically
    from ninja_game.play.replay.paths import paths_picture
    from ninja_game.play.window import png_of
    from ninja_game.ui.theme import PALETTES

    surface = paths_picture(level, paths, PALETTES["classic"], 1584)
    write_atomically(picture, png_of(surface), keep=keep)
    click.echo(f"{picture}: {counted(len(paths), 'run')}", err=True)


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

    level = options.load_level_option(level_path)
    ours = options.choose(load_replays(first, level=level), "recordings", first, record)
    theirs = options.choose(load_replays(second, level=level), "recordings", second, against_record)
    with options.heartbeat(lambda: "running both"):
        found = compare_runs(ours, theirs, budget)
    if form == "json":
        parts = {"first_keys": found.first_keys, "first_place": found.first_place}
        leads = {"splits": list(map(_cells, found.splits)), "places": list(map(_cells, found.places))}
        click.echo(json.dumps({**parts, "columns": COMPARED, **leads}))
    elif form == "csv":
        writer = csv.writer(data_output(), lineterminator="\n")
        writer.writerows([COMPARED, *map(_cells, [*found.splits, *found.places])])
    else:
        _show_comparison(found, ours, theirs)
    if picture:
        paths = list(zip(titles([ours, theirs]), found.positions, strict=True))
        draw(picture, ours.level, paths, [first, second, *filter(None, [level_path])])


def _cells(lead: Lead) -> tuple[str, float, float, int, int, int]:
    return *lead, lead.ahead


def _show_comparison(found: Comparison, ours: Recording, theirs: Recording) -> None:
    from ninja_game.runs.compare import each_second

    both = zip("AB", titles([ours, theirs]), found.positions, found.deaths, strict=True)
    for letter, name, positions, death in both:
        click.echo(f"{letter}: {name}, {len(positions)} ticks{f', dead: {death}' if death else ''}")
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
