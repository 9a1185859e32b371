"""Traces: digests as the reference defines them, files that keep every bit, differences that name what differs."""

import contextlib
import io
import random
import struct
from hashlib import sha256
from pathlib import Path
from typing import Any
from zipfile import ZIP_DEFLATED, ZipFile

import numpy as np
import pytest
from numpy.typing import NDArray

from ninja_game.backend import kernels
from ninja_game.backend.memories import open_worlds
from ninja_game.backend.worlds import TRACED_FLOATS, TRACED_INTS
from ninja_game.errors import FormatError
from ninja_game.formats.load import parse_level
from ninja_game.runs.trace import (
    NINJA_RECORD,
    OBJECT_RECORD,
    RunTrace,
    first_difference,
    ninja_columns,
    trace_digests,
    trace_rows,
)
from ninja_game.runs.trace_files import (
    MAX_TRACE_BYTES,
    TRACE_COLUMNS,
    FiledTrace,
    read_csv,
    read_traces,
    write_csv,
    write_trace_arrays,
)
from ninja_game.sim.inputs import MAX_TICKS
from ninja_game.sim.schema.world_fields import TileMap, World
from tests.support.reference import scene_traces, scenes
from tests.support.samples import WALK


def a_trace() -> RunTrace:
    """Three ticks with two objects, and values that are easy to lose on the way: NaN, tiny ones, many digits."""
    ninja = np.array([(0.1 + k, 0.0, 0.1, 1e-300, k, 2 * k) for k in range(3)], NINJA_RECORD)
    objects = np.array([[(1 / 3, float("nan"), 1), (2.0, 3.0, k)] for k in range(3)], OBJECT_RECORD)
    return RunTrace(ninja, objects, (1, 4), ("gold", "drone"), ("jumped", "", "landed died"))


TWICE = [
    FiledTrace(0, "a name", a_trace(), "a.txt", bytes([2, 14, 5])),
    FiledTrace(5, "a name", a_trace(), "a.txt", bytes(3)),
]


def changed(trace: RunTrace, tick: int, column: int, field: str, value: float) -> RunTrace:
    """The same trace with another value; column -1 is the ninja."""
    ninja, objects = trace.ninja.copy(), trace.objects.copy()
    if column < 0:
        ninja[field][tick] = value
    else:
        objects[field][tick, column] = value
    return RunTrace(ninja, objects, trace.ids, trace.kinds, trace.events)


def test_digests_are_over_the_records_in_order() -> None:
    trace = a_trace()
    digests = trace_digests(trace)
    ninja, objects = trace.ninja, trace.objects
    whole = b"".join(ninja[k].tobytes() + objects[k].tobytes() for k in range(3))
    assert digests.ninja_sha256 == sha256(ninja.tobytes()).hexdigest()
    assert digests.run_sha256 == sha256(whole).hexdigest()
    assert digests.objects[4] == sha256(b"".join(objects[k, 1].tobytes() for k in range(3))).hexdigest()[:8]


def test_every_field_stands_under_its_own_name(monkeypatch: pytest.MonkeyPatch) -> None:
    values = {name: number for number, name in enumerate((*TRACED_FLOATS, *TRACED_INTS), 1)}

    def step(_: TileMap, w: World, __: int) -> None:
        for name, value in values.items():
            setattr(w if name in ("gold", "outcome") else w.ninja, name, value)

    monkeypatch.setattr(kernels, "step", step)
    record = open_worlds("plain", parse_level(WALK), box=False).trace(bytes(2), [], events=False)
    assert {name: column.tolist() for name, column in ninja_columns(record).items()} == {
        name: [value] * 2 for name, value in values.items()
    }


def test_digests_of_the_reference_scenes() -> None:
    everything = scene_traces()
    ends = [scene.offset for scene in scenes()[1:]] + [len(everything)]
    for scene, end in list(zip(scenes(), ends, strict=True))[::40]:
        table = np.frombuffer(everything[scene.offset : end], np.uint8).reshape(scene.ticks, -1)
        ninja = table[:, : NINJA_RECORD.itemsize].copy().view(NINJA_RECORD)[:, 0]
        objects = table[:, NINJA_RECORD.itemsize :].copy().view(OBJECT_RECORD)
        count = objects.shape[1]
        digests = trace_digests(RunTrace(ninja, objects, tuple(range(count)), ("",) * count))
        assert (digests.ninja_sha256, digests.run_sha256) == (scene.ninja_sha256, scene.run_sha256), scene.name


@pytest.mark.parametrize("form", ["csv", "npz"])
def test_files_keep_every_bit(form: str, tmp_path: Path) -> None:
    path = tmp_path / "trace"
    if form == "csv":
        with path.open("w", encoding="utf-8") as text:
            write_csv(TWICE, text)
    else:
        with path.open("wb") as file:
            write_trace_arrays(TWICE, file)
    back = list(read_traces(path))
    assert [(trace.record, trace.name, trace.file, trace.inputs) for trace in back] == [
        (trace.record, trace.name, trace.file, trace.inputs) for trace in TWICE
    ]
    assert trace_digests(back[1].run) == trace_digests(a_trace())
    assert (back[1].run.kinds, back[1].run.events) == (a_trace().kinds, a_trace().events)


@pytest.mark.parametrize("text", ["", "tick,x\n1,2\n", "\0"])
def test_other_files_are_refused_by_name(text: str) -> None:
    with pytest.raises(FormatError, match=r"^other\.csv:1"):
        list(read_csv(io.StringIO(text), file="other.csv"))


def test_broken_row_is_refused_with_its_line() -> None:
    out = io.StringIO()
    write_csv(TWICE[:1], out)
    with pytest.raises(FormatError, match=r"^t\.csv:\d+: a row"):
        list(read_csv(io.StringIO(out.getvalue().replace("0.1", "point one")), file="t.csv"))


def test_rows_give_velocity_and_events() -> None:
    row = list(trace_rows(a_trace()))[3]
    assert (row["tick"], row["kind"], row["vx"], row["events"]) == (1, "ninja", 1.0, "")


@pytest.mark.parametrize(
    "tick, column, field, value, message",
    [
        (1, -1, "y", 5.0, "tick 1: ninja: y is 0.0, expected 5.0 (specification: ninja 4)"),
        (2, 0, "y", 5.0, "tick 2: object 1 (gold): y is nan, expected 5.0 (specification: ninja 4)"),
        (0, 1, "s", 7, "tick 0: object 4 (drone): s is 0, expected 7 (specification: ninja 4)"),
    ],
)
def test_difference_names_tick_thing_field_and_values(
    tick: int, column: int, field: str, value: float, message: str
) -> None:
    other = changed(a_trace(), tick, column, field, value)
    assert str(first_difference(a_trace(), other, "ninja 4")) == message


def test_first_difference_is_the_earliest() -> None:
    other = changed(changed(a_trace(), 2, -1, "x", 9.0), 1, 1, "x", 9.0)
    assert str(first_difference(a_trace(), other)) == "tick 1: object 4 (drone): x is 2.0, expected 9.0"


def test_equal_traces_have_no_difference() -> None:
    assert first_difference(a_trace(), changed(a_trace(), 0, -1, "y", 0.0)) is None


def test_length_and_missing_objects_are_differences() -> None:
    whole = a_trace()
    short = RunTrace(whole.ninja[:2], whole.objects[:2], whole.ids, whole.kinds)
    fewer = RunTrace(whole.ninja, whole.objects[:, :1], whole.ids[:1], whole.kinds[:1])
    assert str(first_difference(whole, short)) == "tick 2: run: number of ticks is 3, expected 2"
    assert str(first_difference(whole, fewer)) == "tick 0: object 4: kind is drone, expected missing"


def _zip_of(folder: Path, member: bytes, **about: int) -> Path:
    """A .npz whose ``ninja_0`` has this content."""
    path = folder / "odd.npz"
    with ZipFile(path, "w", ZIP_DEFLATED) as archive:
        archive.writestr("ninja_0.npy", member)
        for name, value in about.items():
            setattr(archive.infolist()[0], name, value)
    return path


def _header(shape: str) -> bytes:
    """A .npy that says it holds this many doubles."""
    text = f"{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}}}".ljust(117) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text.encode()


@pytest.mark.parametrize(
    "member",
    [
        b"",
        b"\x93NUMPY\x09\x00",
        b"\x93NUMPY\x01\x00\xff\xff",
        _header("(10**12,)"),
        _header("(1000000000000,)"),
        _header("()"),
    ],
    ids=["nothing", "a version", "a cut header", "no shape", "a shape of terabytes", "one number"],
)
def test_odd_arrays_are_our_own_errors_and_take_no_memory(member: bytes, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="this is not a trace"):
        list(read_traces(_zip_of(tmp_path, member)))


def test_a_zip_that_unpacks_to_gigabytes_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="more than 256 MiB, unpacked"):
        list(read_traces(_zip_of(tmp_path, bytes(MAX_TRACE_BYTES + 1))))


@pytest.mark.parametrize("name, value", [("compress_type", 99), ("CRC", 1), ("flag_bits", 1)])
def test_a_damaged_zip_is_one_of_our_errors(name: str, value: int, tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="this is not a trace"):
        list(read_traces(_zip_of(tmp_path, _header("(3,)") + bytes(24), **{name: value})))


def test_a_zip_whose_index_leads_before_its_beginning_is_one_of_our_errors(tmp_path: Path) -> None:
    path = tmp_path / "cut.npz"
    write_trace_arrays(TWICE, whole := io.BytesIO())
    path.write_bytes(b"PK" + whole.getvalue()[40:])
    with pytest.raises(FormatError, match="this is not a trace"):
        list(read_traces(path))


@pytest.mark.parametrize(
    "name, array",
    [
        ("ninja", np.zeros(1000, np.uint8)), ("ids", np.zeros(1000, np.int8)), ("ids", np.zeros((2, 2), np.int32)),
        ("ids", np.array([4, 2], np.int32)), ("events", np.zeros(MAX_TICKS + 1, np.str_)), ("keys", np.zeros(3)),
        ("kinds", np.zeros(2, "S1")), ("record", np.array("1")),
        ("kinds", np.full(2, 2**32 - 1, np.uint32).view("<U1")),
    ],
)  # fmt: skip
def test_arrays_of_another_kind_size_or_order_are_refused(name: str, array: NDArray[Any], tmp_path: Path) -> None:
    path = tmp_path / "other.npz"
    with path.open("wb") as file:
        write_trace_arrays(TWICE, file)
    with np.load(path) as arrays:
        np.savez(path, **{**arrays, f"{name}_0": array})
    with pytest.raises(FormatError, match="this is not a trace"):
        list(read_traces(path))


def test_objects_of_a_table_stand_in_the_order_of_their_ids() -> None:
    out = io.StringIO()
    write_csv(TWICE[:1], out)
    header, ninja, *objects = out.getvalue().splitlines(keepends=True)
    assert len(list(read_csv([header, ninja, *objects[:2]]))) == 1
    with pytest.raises(FormatError, match="not in the order of their ids"):
        list(read_csv([header, ninja, *objects[1::-1]]))


def test_damaged_bytes_of_a_trace_never_escape_as_other_errors(tmp_path: Path) -> None:
    whole = io.BytesIO()
    write_trace_arrays(TWICE, whole)
    rng = random.Random(3)
    for _ in range(300):
        data = bytearray(whole.getvalue())
        for _ in range(rng.randint(1, 4)):
            data[rng.randrange(2, len(data))] = rng.randrange(256)
        path = tmp_path / "damaged.npz"
        path.write_bytes(data[: rng.choice([len(data), rng.randrange(2, len(data))])])
        with contextlib.suppress(FormatError):
            list(read_traces(path))


@pytest.mark.parametrize(
    "row",
    [
        "a.txt,0,n,0,R,,ninja,1,2,99999999999,1,2,,,0,", "a.txt,0,n,0,R,,ninja,1,2,3,1,2,,," + "9" * 5000 + ",",
        "a.txt,0,n,0,R,,ninja,1,2,nan,1,2,,,0,", "a.txt,0,n,0", "a.txt,x,n,0,R,,ninja,1,2,3,1,2,,,0,",
        "a.txt,0,n,0,R," + "x" * 200_000 + ",ninja,1,2,3,1,2,,,0,",
    ],
)  # fmt: skip
def test_odd_rows_are_our_own_errors(row: str) -> None:
    with pytest.raises(FormatError, match="a row that cannot be read"):
        list(read_csv([",".join(TRACE_COLUMNS) + "\n", row + "\n"]))
