"""`ninja-game trace`: everything a run shows, tick by tick, as a table or as digests; compared with another trace."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import chain
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import click

from ninja_game.cli import options
from ninja_game.cli.commands import BAD_INPUT, FAILED
from ninja_game.cli.progress import Readable, with_progress
from ninja_game.cli.terminal import data_output, say
from ninja_game.files.shown_text import shown_text

if TYPE_CHECKING:
    from ninja_game.runs.trace import RunTrace
    from ninja_game.runs.trace_files import FiledTrace

MAX_TRACE_TICKS = 1_000_000  # longest trace that can be asked for: almost seven hours

SECTION = re.compile(r"(world|objects|ninja|game) [0-9.]+")
"""A comment like this names the section of the specification that a recording is about."""
HOW_TO_KEEP = "To keep this table: -o run.csv; instead of it a line for each recording: --digests"


@click.command()
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=options.InputPath())
@options.record_option
@click.option("--ticks", type=click.IntRange(1, MAX_TRACE_TICKS), help="Run exactly this many ticks, whatever happens.")
@click.option("--after", type=click.IntRange(0, MAX_TRACE_TICKS), help="Run this many ticks more than `verify` does.")
@click.option("--objects", is_flag=True, help="Rows for the objects too, not only for the ninja.")
@click.option("--digests", is_flag=True, help="One JSON object per recording with digests of everything, instead.")
@click.option("--against", type=options.OLD_FILE, help="Compare with this trace, or with this file of recordings.")
@click.option("--against-record", type=click.IntRange(min=0), help="Compare every run with this record of --against.")
@options.level_option
@options.output_option("Write to this .csv or .npz file.")
@options.memory_option
@options.jobs_option
@options.budget_option
def trace(
    files: Sequence[Path], record: int | None, ticks: int | None, after: int | None, objects: bool, digests: bool,
    against: Path | None, against_record: int | None, level_path: Path | None, output: Path | None, **workers: Any,
) -> int:  # fmt: skip
    """Show every tick of recordings: position, velocity, state, events.

    FILE is a replay of ours, a file of $name#author#comment#level#demo# records, or a folder of them. Each runs as
    `verify` runs it, unless --ticks or --after say otherwise. Lengths are px, velocities px/tick; numbers keep every
    bit.

    Exit code 0: all is well; 1: --against found a difference; 2: something cannot be read.

    \b
    Examples:
      ninja-game trace run.replay.txt > run.csv
      ninja-game trace run.replay.txt --objects -o run.npz
      ninja-game trace run.replay.txt --against run.csv
      ninja-game trace demos.txt --record 3 --against demos.txt --against-record 5
      ninja-game trace demos.txt --digests --after 150
    """
    if ticks is not None and after is not None:
        raise click.UsageError("--ticks and --after cannot be used together")
    if against_record is not None and not against:
        raise click.UsageError("--against-record needs --against")
    if sum(map(bool, (digests, against, output))) > 1:
        raise click.UsageError("--digests, --against and --output cannot be used together")
    how = workers | {
        "level": options.load_level_option(level_path),
        "ticks": ticks,
        "after": after or 0,
        "objects": objects or digests or against is not None,
        "events": not digests and not against,
    }
    traces = _traces(files, record=record, **how)
    different = 0
    if digests:
        for run in traces:
            click.echo(json.dumps(_digests(run)))
    elif against:
        different = _compare(traces, _expected(against, against_record, how), against, against_record)
    else:
        _write(traces, output, [*files, level_path] if level_path else files)
    if not traces.count and not traces.unreadable:
        there_is_no = "recordings here" if record is None else f"record {record}"
        raise click.UsageError(f"{', '.join(map(str, files))}: no {there_is_no}")
    return BAD_INPUT if traces.unreadable else FAILED if different else 0


def _traces(files: Sequence[Path], **how: Any) -> Readable[FiledTrace]:
    from ninja_game.runs.archive import trace_all

    return Readable(with_progress(trace_all(files, **how), "trace"))


def _digests(traced: FiledTrace) -> dict[str, Any]:
    from ninja_game.runs.trace import trace_digests

    digests = trace_digests(traced.run)
    return {
        "file": traced.file, "record": traced.record, "name": traced.name, "ticks": digests.ticks,
        "ninja_sha256": digests.ninja_sha256, "run_sha256": digests.run_sha256,
        "objects": {str(id_): text for id_, text in digests.objects.items()},
    }  # fmt: skip


def _expected(against: Path, record: int | None, how: dict[str, Any]) -> Iterator[FiledTrace]:
    """The traces of a file, or of the recordings in it. Raises NinjaGameError, OSError."""
    from ninja_game.runs.trace_files import is_trace, read_traces

    if is_trace(against):
        return (traced for traced in read_traces(against) if record is None or traced.record == record)
    return iter(_traces([against], record=record, **how))


def _compare(traces: Readable[FiledTrace], expected: Iterator[FiledTrace], against: Path, record: int | None) -> int:
    """The number of runs that differ from the expected ones; each is reported with its first difference.

    Runs are paired by file and record, else by record alone; with ``record`` each is compared with that one.
    """
    from ninja_game.runs.trace import first_difference

    pairs: dict[Any, RunTrace] = {}
    for traced in expected:
        pairs[traced.file, traced.record] = pairs[traced.record] = traced.run
    if record is not None and record not in pairs:
        raise click.UsageError(f"{against}: no record {record}")
    different = 0
    for traced in traces:
        section = traced.comment if SECTION.fullmatch(traced.comment) else ""
        number = traced.record if record is None else record
        there = pairs.get((traced.file, number), pairs.get(number))
        difference = first_difference(traced.run, there, section) if there else f"record {number} is not in {against}"
        if difference:
            different += 1
            click.echo(f"{shown_text(traced.file)}:{traced.record} {shown_text(traced.name)}: {difference}")
    click.echo(f"{traces.count - different} of {traces.count} equal to {shown_text(str(against))}")
    return different


def _write(traces: Readable[FiledTrace], output: Path | None, files: Sequence[Path]) -> None:
    """Write the table: to the terminal, to a .npz file, or as CSV to any other file."""
    from ninja_game.files.writing import write_atomically
    from ninja_game.runs.trace_files import write_csv, write_trace_arrays

    first = next(iter(traces), None)
    if first is None:
        return  # no column heads are written before an error
    runs = chain([first], traces)
    if output is None:
        shown = data_output()
        write_csv(runs, shown)
        if shown.isatty():
            say(HOW_TO_KEEP)
    elif output.suffix == ".npz":
        write_atomically(output, partial(write_trace_arrays, runs), keep=files)
    else:
        write_atomically(output, partial(_fill_csv, runs), keep=files)


def _fill_csv(runs: Iterator[FiledTrace], file: IO[bytes]) -> None:
    from ninja_game.runs.trace_files import write_csv

    text = io.TextIOWrapper(file, "utf-8", "replace", newline="")
    write_csv(runs, text)
    text.detach()
