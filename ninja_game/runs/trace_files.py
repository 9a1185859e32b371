"""Traces in files: CSV for people and spreadsheets, NumPy's .npz for programs. Both keep every bit.

The columns and arrays are described in docs/replay-format.md, "Traces".
"""

from __future__ import annotations

import csv
import os
import struct
from collections.abc import Iterable, Iterator, Mapping
from io import TextIOWrapper
from itertools import groupby, pairwise
from pathlib import Path
from typing import IO, Any, NamedTuple
from zipfile import ZipFile, ZipInfo

import numpy as np
from numpy.typing import DTypeLike, NDArray

from ninja_game.errors import FileError, FormatError
from ninja_game.files.reading import open_regular
from ninja_game.files.untrusted import MAX_ARRAYS, UNREADABLE, open_zip, read_array
from ninja_game.runs.trace import NINJA_NAME, NINJA_RECORD, OBJECT_RECORD, RunTrace, trace_rows
from ninja_game.sim.inputs import MAX_TICKS, Input

TRACE_COLUMNS = (
    "file", "record", "name", "tick", "keys", "id", "kind", "x", "y", "s", "prev_x", "prev_y", "vx", "vy", "gold",
    "events",
)  # fmt: skip
"""Columns of the CSV. The ninja has no id; objects have neither keys, previous position, velocity, gold nor events."""

MAX_TRACE_BYTES = 2**28  # the largest CSV, or all arrays of a .npz: a million ticks of the ninja are a seventh of it

_KEYS = (("L", Input.LEFT), ("R", Input.RIGHT), ("J", Input.JUMP_HELD), ("!", Input.JUMP_PRESSED))

ZIPPED = b"PK"  # the first bytes of a .npz

_UNREADABLE = (*UNREADABLE, csv.Error)


class FiledTrace(NamedTuple):
    """A trace with the name, file and record of its recording; ``inputs``: one byte per tick.

    ``comment``: of the recording; files of traces do not hold it.
    """

    record: int
    name: str
    run: RunTrace
    file: str = ""
    inputs: bytes = b""
    comment: str = ""


def keys_text(keys: int) -> str:
    """The keys of a tick as letters: L, R, J, and ! where the jump was pressed in this tick.

    >>> keys_text(2 + 4 + 8), keys_text(0)
    ('RJ!', '')
    """
    return "".join(letter for letter, bit in _KEYS if keys & bit)


def write_csv(traces: Iterable[FiledTrace], out: IO[str]) -> None:
    """Write traces; numbers are the shortest decimals that read back as the same double."""
    table = csv.DictWriter(out, TRACE_COLUMNS, restval="", lineterminator="\n")
    table.writeheader()
    for record, name, run, file, inputs, _ in traces:
        place = {"file": file, "record": record, "name": name}
        for row in trace_rows(run):
            keys = {"keys": keys_text(inputs[row["tick"]])} if inputs and row["kind"] == NINJA_NAME else {}
            table.writerow({**place, **keys, **row})


def read_csv(text: Iterable[str], *, file: str = "") -> Iterator[FiledTrace]:
    """The traces of a CSV that ``write_csv`` wrote. Raises FormatError where it is something else."""
    table = csv.DictReader(text)
    try:
        header = tuple(table.fieldnames or ())
    except csv.Error:
        header = ("no table",)
    if header != TRACE_COLUMNS:
        found, expected = repr(",".join(header)[:80]), f"the header {','.join(TRACE_COLUMNS)}"
        hint = "`ninja-game trace -o` writes it"
        raise FormatError("this is not a trace", file=file, line=1, found=found, expected=expected, hint=hint)
    try:
        for (source, record), group in groupby(table, key=lambda row: (row["file"], int(row["record"]))):
            yield _read_run(group, record, source)
    except _UNREADABLE as error:
        raise FormatError(f"a row that cannot be read ({error})", file=file, line=table.line_num) from None


def _read_run(table: Iterable[Mapping[str, str]], record: int, file: str) -> FiledTrace:
    """One record's rows as a trace. Raises an error of ``_UNREADABLE`` where a row is missing or is not a number."""
    ninja, objects, inputs = bytearray(), bytearray(), bytearray()
    columns: list[tuple[int, str]] = []
    events: list[str] = []
    name = ""
    for row in table:
        x, y = float(row["x"]), float(row["y"])
        state = int(row["s"])
        if row["kind"] == NINJA_NAME:
            name = row["name"]
            ninja += struct.pack("<4d2i", x, y, float(row["prev_x"]), float(row["prev_y"]), state, int(row["gold"]))
            inputs.append(sum(bit for letter, bit in _KEYS if letter in row["keys"]))
            events.append(row["events"])
        else:
            objects += struct.pack("<2di", x, y, state)
            if row["tick"] == "0":
                columns.append((int(row["id"]), row["kind"]))
    if len(objects) != len(columns) * len(events) * OBJECT_RECORD.itemsize:
        raise ValueError("objects are missing in some ticks")
    shape = (len(events), len(columns))
    run = _checked(
        ninja=np.frombuffer(bytes(ninja), NINJA_RECORD),
        objects=np.frombuffer(bytes(objects), OBJECT_RECORD).reshape(shape),
        ids=tuple(id_ for id_, _ in columns),
        kinds=tuple(kind for _, kind in columns),
        events=tuple(events),
    )
    return FiledTrace(record, name, run, file, bytes(inputs))


def _checked(**fields: Any) -> RunTrace:
    """The trace of these fields. Raises ValueError if they are not those of one run."""
    run = RunTrace(**fields)
    ticks, columns = len(run.ninja), len(run.ids)
    if run.objects.shape != (ticks, columns) or len(run.kinds) != columns or len(run.events) not in (0, ticks):
        raise ValueError("arrays that do not fit each other")
    if any(first >= second for first, second in pairwise(run.ids)):
        raise ValueError("objects that are not in the order of their ids")
    return run


def write_trace_arrays(traces: Iterable[FiledTrace], out: IO[bytes]) -> None:
    """Write traces as arrays: ``ninja_0``, ``objects_0`` and so on of the first, ``ninja_1`` … of the second."""
    arrays: dict[str, Any] = {}
    for number, (record, name, run, file, inputs, _) in enumerate(traces):
        arrays |= {
            f"ninja_{number}": run.ninja,
            f"objects_{number}": run.objects,
            f"ids_{number}": np.array(run.ids, np.int32),
            f"kinds_{number}": np.array(run.kinds, np.str_),
            f"events_{number}": np.array(run.events, np.str_),
            f"keys_{number}": np.frombuffer(inputs, np.uint8),
            f"record_{number}": np.array(record, np.int64),
            f"name_{number}": np.array(name),
            f"file_{number}": np.array(file),
        }
    np.savez_compressed(out, **arrays)


def read_npz(data: IO[bytes], path: Path) -> Iterator[FiledTrace]:
    """The traces of a file that ``write_trace_arrays`` wrote. Raises FormatError where it is something else."""
    try:
        with open_zip(data, most_files=MAX_ARRAYS, most_bytes=MAX_TRACE_BYTES) as archive:
            arrays = {info.filename.removesuffix(".npy"): info for info in archive.infolist()}
            for number in sorted(int(name.removeprefix("ninja_")) for name in arrays if name.startswith("ninja_")):
                yield _read_arrays(archive, arrays, number)
    except _UNREADABLE as error:
        raise FormatError(f"this is not a trace ({error})", file=str(path)) from None


def _read_arrays(archive: ZipFile, arrays: Mapping[str, ZipInfo], number: int) -> FiledTrace:
    """One run. Raises an error of ``_UNREADABLE`` if its arrays are invalid or do not fit each other."""

    def array(name: str, dtype: DTypeLike = np.str_) -> NDArray[Any]:
        dimensions = 1 + (dtype is OBJECT_RECORD)
        return read_array(archive, arrays[f"{name}_{number}"], np.dtype(dtype), most=MAX_TICKS, dimensions=dimensions)

    run = _checked(
        ninja=array("ninja", NINJA_RECORD),
        objects=array("objects", OBJECT_RECORD),
        ids=tuple(map(int, array("ids", np.int32).tolist())),
        kinds=tuple(map(str, array("kinds").tolist())),
        events=tuple(map(str, array("events").tolist())),
    )
    inputs = array("keys", np.uint8).tobytes()
    return FiledTrace(int(array("record", np.int64)), str(array("name")), run, str(array("file")), inputs)


def is_trace(path: Path) -> bool:
    """Whether a file is a trace, by its first bytes. Raises FileError for anything but a regular file; OSError."""
    with open_regular(path) as file:
        return file.readline(len(TRACE_COLUMNS[0]) + 1).startswith((f"{TRACE_COLUMNS[0]},".encode(), ZIPPED))


def read_traces(path: Path) -> Iterator[FiledTrace]:
    """The traces of a CSV or .npz file, by what the file begins with. Raises FormatError, FileError, OSError."""
    with open_regular(path) as file:
        if os.fstat(file.fileno()).st_size > MAX_TRACE_BYTES:
            expected = f"at most {MAX_TRACE_BYTES >> 20} MiB, unpacked"
            raise FileError("the trace is too large", str(path), expected=expected)
        zipped = file.read(len(ZIPPED)) == ZIPPED
        file.seek(0)
        if zipped:
            yield from read_npz(file, path)
            return
        try:
            with TextIOWrapper(file, "utf-8", newline="") as text:
                yield from read_csv(text, file=str(path))
        except UnicodeDecodeError:
            expected = "CSV or .npz of `ninja-game trace`"
            raise FormatError("this is not a trace", file=str(path), expected=expected) from None
