"""Traces in files: CSV for people and spreadsheets, NumPy's .npz for programs. Both keep every bit."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator
from itertools import groupby
from pathlib import Path
from typing import IO, Any

import numpy as np

from ninja_game.errors import FormatError
from ninja_game.session.trace import NINJA, NINJA_NAME, THING, Trace, canonical, empty_things, rows

COLUMNS = ("record", "name", "tick", "id", "kind", "x", "y", "s", "px", "py", "vx", "vy", "gold", "events")
"""Of the CSV. The ninja has no id; objects have neither previous position, velocity, gold nor events."""


def write_csv(traces: Iterable[tuple[int, Trace]], out: IO[str]) -> None:
    """Write traces with their record numbers; numbers are the shortest decimals that read back as the same double."""
    table = csv.DictWriter(out, COLUMNS, restval="", lineterminator="\n")
    table.writeheader()
    for record, trace in traces:
        table.writerows({"record": record, "name": trace.name, **row} for row in rows(trace))


def read_csv(text: Iterable[str], *, file: str = "") -> Iterator[tuple[int, Trace]]:
    """The traces of a CSV that ``write_csv`` wrote. Raises FormatError where it is something else."""
    table = csv.DictReader(text)
    if tuple(table.fieldnames or ()) != COLUMNS:
        raise FormatError(
            "this is no trace", file=file, line=1, found=",".join(table.fieldnames or ())[:80] or "nothing",
            expected=f"the header {','.join(COLUMNS)}",
        )  # fmt: skip
    try:
        for record, group in groupby(table, key=lambda row: int(row["record"])):
            yield record, _trace_of(list(group))
    except (ValueError, TypeError, KeyError, csv.Error) as error:
        raise FormatError(f"a row that cannot be read ({error})", file=file, line=table.line_num) from None


def _trace_of(table: list[dict[str, str]]) -> Trace:
    """One record's rows as a trace. Raises ValueError, KeyError where a row is missing or is no number."""
    ninjas = [row for row in table if row["kind"] == NINJA_NAME]
    objects = [row for row in table if row["kind"] != NINJA_NAME]
    first = [row for row in objects if row["tick"] == "0"]
    ninja = np.array([tuple(float(row[name]) for name in NINJA.names or ()) for row in ninjas], NINJA)
    things = empty_things(len(ninjas))
    if objects:
        if len(objects) != len(first) * len(ninjas):
            raise ValueError("objects are missing in some ticks")
        flat = np.array([(float(row["x"]), float(row["y"]), int(row["s"])) for row in objects], THING)
        things = flat.reshape(len(ninjas), len(first))
    return Trace(
        ninja=ninja,
        things=things,
        ids=tuple(int(row["id"]) for row in first),
        kinds=tuple(row["kind"] for row in first),
        events=tuple(row["events"] for row in ninjas),
        name=table[0]["name"],
    )


def write_npz(traces: Iterable[tuple[int, Trace]], out: IO[bytes]) -> None:
    """Write traces as arrays: ``ninja_0``, ``things_0``, ``ids_0``, ``kinds_0``, ``events_0``, ``name_0`` and so on."""
    arrays: dict[str, Any] = {}
    for record, trace in traces:
        arrays |= {
            f"ninja_{record}": canonical(trace.ninja),
            f"things_{record}": canonical(trace.things),
            f"ids_{record}": np.array(trace.ids, np.int32),
            f"kinds_{record}": np.array(trace.kinds, np.str_),
            f"events_{record}": np.array(trace.events, np.str_),
            f"name_{record}": np.array(trace.name),
        }
    np.savez_compressed(out, **arrays)


def read_npz(path: Path) -> Iterator[tuple[int, Trace]]:
    """The traces of a file that ``write_npz`` wrote. Raises FormatError where it is something else."""
    try:
        with np.load(path, allow_pickle=False) as arrays:
            records = sorted(int(name.removeprefix("ninja_")) for name in arrays.files if name.startswith("ninja_"))
            for record in records:
                yield (
                    record,
                    Trace(
                        ninja=arrays[f"ninja_{record}"].astype(NINJA),
                        things=arrays[f"things_{record}"].astype(THING),
                        ids=tuple(arrays[f"ids_{record}"].tolist()),
                        kinds=tuple(arrays[f"kinds_{record}"].tolist()),
                        events=tuple(arrays[f"events_{record}"].tolist()),
                        name=str(arrays[f"name_{record}"]),
                    ),
                )
    except (ValueError, KeyError, EOFError, AttributeError, TypeError) as error:
        raise FormatError(f"this is no trace ({error})", file=str(path)) from None


def read_traces(path: Path) -> Iterator[tuple[int, Trace]]:
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
