"""Traces in files: CSV for people and spreadsheets, NumPy's .npz for programs. Both keep every bit."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator
from itertools import groupby
from pathlib import Path
from typing import IO, Any, NamedTuple

import numpy as np

from ninja_game.errors import FormatError
from ninja_game.runs.run import NINJA_RECORD, OBJECT_RECORD, RunTrace
from ninja_game.runs.trace import NINJA_NAME, rows

COLUMNS = ("record", "name", "tick", "id", "kind", "x", "y", "s", "prev_x", "prev_y", "vx", "vy", "gold", "events")
"""Of the CSV. The ninja has no id; objects have neither previous position, velocity, gold nor events."""


class FiledTrace(NamedTuple):
    """A trace, and which record of which name it was made from."""

    record: int
    name: str
    run: RunTrace


def write_csv(traces: Iterable[FiledTrace], out: IO[str]) -> None:
    """Write traces; numbers are the shortest decimals that read back as the same double."""
    table = csv.DictWriter(out, COLUMNS, restval="", lineterminator="\n")
    table.writeheader()
    for record, name, run in traces:
        table.writerows({"record": record, "name": name, **row} for row in rows(run))


def read_csv(text: Iterable[str], *, file: str = "") -> Iterator[FiledTrace]:
    """The traces of a CSV that ``write_csv`` wrote. Raises FormatError where it is something else."""
    table = csv.DictReader(text)
    if tuple(table.fieldnames or ()) != COLUMNS:
        raise FormatError(
            "this is no trace", file=file, line=1, found=",".join(table.fieldnames or ())[:80] or "nothing",
            expected=f"the header {','.join(COLUMNS)}",
        )  # fmt: skip
    try:
        for record, group in groupby(table, key=lambda row: int(row["record"])):
            table_of_run = list(group)
            yield FiledTrace(record, table_of_run[0]["name"], _trace_of(table_of_run))
    except (ValueError, TypeError, KeyError, csv.Error) as error:
        raise FormatError(f"a row that cannot be read ({error})", file=file, line=table.line_num) from None


def _trace_of(table: list[dict[str, str]]) -> RunTrace:
    """One record's rows as a trace. Raises ValueError, KeyError where a row is missing or is no number."""
    ninjas = [row for row in table if row["kind"] == NINJA_NAME]
    others = [row for row in table if row["kind"] != NINJA_NAME]
    first = [row for row in others if row["tick"] == "0"]
    ninja = np.array([tuple(float(row[name]) for name in NINJA_RECORD.names or ()) for row in ninjas], NINJA_RECORD)
    objects = np.empty((len(ninjas), 0), OBJECT_RECORD)
    if others:
        if len(others) != len(first) * len(ninjas):
            raise ValueError("objects are missing in some ticks")
        flat = np.array([(float(row["x"]), float(row["y"]), int(row["s"])) for row in others], OBJECT_RECORD)
        objects = flat.reshape(len(ninjas), len(first))
    return RunTrace(
        ninja=ninja,
        objects=objects,
        ids=tuple(int(row["id"]) for row in first),
        kinds=tuple(row["kind"] for row in first),
        events=tuple(row["events"] for row in ninjas),
    )


def write_npz(traces: Iterable[FiledTrace], out: IO[bytes]) -> None:
    """Write traces as arrays: ``ninja_0``, ``things_0``, ``ids_0``, ``kinds_0``, ``events_0``, ``name_0`` and so on."""
    arrays: dict[str, Any] = {}
    for record, name, run in traces:
        arrays |= {
            f"ninja_{record}": run.ninja,
            f"things_{record}": run.objects,
            f"ids_{record}": np.array(run.ids, np.int32),
            f"kinds_{record}": np.array(run.kinds, np.str_),
            f"events_{record}": np.array(run.events, np.str_),
            f"name_{record}": np.array(name),
        }
    np.savez_compressed(out, **arrays)


def read_npz(path: Path) -> Iterator[FiledTrace]:
    """The traces of a file that ``write_npz`` wrote. Raises FormatError where it is something else."""
    try:
        with np.load(path, allow_pickle=False) as arrays:
            records = sorted(int(name.removeprefix("ninja_")) for name in arrays.files if name.startswith("ninja_"))
            for record in records:
                run = RunTrace(
                    ninja=arrays[f"ninja_{record}"].astype(NINJA_RECORD),
                    objects=arrays[f"things_{record}"].astype(OBJECT_RECORD),
                    ids=tuple(arrays[f"ids_{record}"].tolist()),
                    kinds=tuple(arrays[f"kinds_{record}"].tolist()),
                    events=tuple(arrays[f"events_{record}"].tolist()),
                )
                yield FiledTrace(record, str(arrays[f"name_{record}"]), run)
    except (ValueError, KeyError, EOFError, AttributeError, TypeError) as error:
        raise FormatError(f"this is no trace ({error})", file=str(path)) from None


def read_traces(path: Path) -> Iterator[FiledTrace]:
    """The traces of a CSV or .npz file, by what the file begins with."""
    with path.open("rb") as file:
        zipped = file.read(2) == b"PK"
    if zipped:
        yield from read_npz(path)
        return
    try:
        with path.open(encoding="utf-8", newline="") as text:
            yield from read_csv(text, file=str(path))
    except UnicodeDecodeError:
        raise FormatError("this is no trace", file=str(path), expected="CSV or .npz of `ninja-game trace`") from None
