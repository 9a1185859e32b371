"""Traces: digests as the reference defines them, files that keep every bit, differences that name what differs."""

from __future__ import annotations

import csv
import io
import lzma
from hashlib import sha256
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from ninja_game.errors import FormatError
from ninja_game.session.trace import NINJA, THING, Trace, canonical, first_difference, rows, trace_digests
from ninja_game.session.trace_files import read_csv, read_traces, write_csv, write_npz


def a_trace() -> Trace:
    """Three ticks with two objects, and values that are easy to lose on the way: -0.0, NaN, many digits."""
    ninja = np.array([(0.1 + k, -0.0, 0.1, 1e-300, k, 2 * k) for k in range(3)], NINJA)
    things = np.array([[(1 / 3, float("nan"), 1), (2.0, 3.0, k)] for k in range(3)], THING)
    return Trace(ninja, things, (1, 4), ("gold", "drone"), ("jumped", "", "landed died"), "a name")


def changed(trace: Trace, tick: int, column: int, field: str, value: float) -> Trace:
    """The same trace with another value; column -1 is the ninja."""
    ninja, things = trace.ninja.copy(), trace.things.copy()
    if column < 0:
        ninja[field][tick] = value
    else:
        things[field][tick, column] = value
    return Trace(ninja, things, trace.ids, trace.kinds, trace.events, trace.name)


def test_canonical_form_has_one_zero_and_one_nan() -> None:
    strange = np.array([(-0.0, np.frombuffer(b"\x01\0\0\0\0\0\xf8\xff", "<f8")[0], -7)], THING)
    assert canonical(strange).tobytes() == bytes(8) + b"\0\0\0\0\0\0\xf8\x7f" + b"\xf9\xff\xff\xff"
    assert np.signbit(strange["x"][0]), "the original is left alone"


def test_digests_are_over_the_records_in_order() -> None:
    trace = a_trace()
    digests = trace_digests(trace)
    ninja, things = canonical(trace.ninja), canonical(trace.things)
    whole = b"".join(ninja[k].tobytes() + things[k].tobytes() for k in range(3))
    assert digests.ninja_sha256 == sha256(ninja.tobytes()).hexdigest()
    assert digests.run_sha256 == sha256(whole).hexdigest()
    assert digests.objects[4] == sha256(b"".join(things[k, 1].tobytes() for k in range(3))).hexdigest()[:8]


def test_digests_of_the_reference_scenes(reference: Path) -> None:
    with (reference / "scenes.tsv").open(encoding="utf-8", newline="") as text:
        scenes = list(csv.DictReader(text, delimiter="\t"))
    everything = lzma.decompress((reference / "scenes.bin.xz").read_bytes())
    offsets = [int(scene["offset"]) for scene in scenes] + [len(everything)]
    for scene, (start, end) in list(zip(scenes, pairwise(offsets), strict=True))[::40]:
        ticks = int(scene["ticks"])
        table = np.frombuffer(everything[start:end], np.uint8).reshape(ticks, -1)
        ninja = table[:, :40].copy().view(NINJA)[:, 0]
        things = table[:, 40:].copy().view(THING)
        ids = tuple(range(things.shape[1]))
        digests = trace_digests(Trace(ninja, things, ids, ("",) * len(ids)))
        assert (digests.ninja_sha256, digests.run_sha256) == (scene["ninja_sha256"], scene["run_sha256"])


@pytest.mark.parametrize("form", ["csv", "npz"])
def test_files_keep_every_bit(form: str, tmp_path: Path) -> None:
    path = tmp_path / "trace"
    if form == "csv":
        with path.open("w", encoding="utf-8") as text:
            write_csv([(0, a_trace()), (5, a_trace())], text)
    else:
        with path.open("wb") as file:
            write_npz([(0, a_trace()), (5, a_trace())], file)
    back = dict(read_traces(path))
    assert list(back) == [0, 5]
    assert trace_digests(back[5]) == trace_digests(a_trace())
    assert (back[5].kinds, back[5].events, back[5].name) == (("gold", "drone"), a_trace().events, "a name")


@pytest.mark.parametrize("text", ["", "tick,x\n1,2\n", "\0"])
def test_other_files_are_refused_by_name(text: str) -> None:
    with pytest.raises(FormatError, match=r"^other\.csv:1"):
        list(read_csv(io.StringIO(text), file="other.csv"))


def test_broken_row_is_refused_with_its_line() -> None:
    out = io.StringIO()
    write_csv([(0, a_trace())], out)
    with pytest.raises(FormatError, match=r"^t\.csv:\d+: a row"):
        list(read_csv(io.StringIO(out.getvalue().replace("0.1", "point one")), file="t.csv"))


def test_rows_give_velocity_and_events() -> None:
    row = list(rows(a_trace()))[3]
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
    short = Trace(whole.ninja[:2], whole.things[:2], whole.ids, whole.kinds)
    fewer = Trace(whole.ninja, whole.things[:, :1], whole.ids[:1], whole.kinds[:1])
    assert str(first_difference(whole, short)) == "tick 2: run: number of ticks is 3, expected 2"
    assert str(first_difference(whole, fewer)) == "tick 0: object 4: kind is drone, expected missing"
