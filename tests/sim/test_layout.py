"""The compiled memory: kinds overlap without harm, worlds are packed, indices stay in range."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from ninja_game.compile_cache import compiled_available
from ninja_game.sim.memory.compiled import Compiler, load_compiled
from ninja_game.sim.memory.declare import ENTRY_POINTS, REGISTERED, f8, fields_of, part
from ninja_game.sim.memory.layout import (
    OBJECT,
    STATE_START,
    TILE_MAP,
    WORLD,
    dtype_of,
    new_worlds,
    state_view,
    used_bytes,
)
from ninja_game.sim.memory.schema import CAPACITY, Header, Object
from tests.support.crowded import crowded_inputs, crowded_level

needs_numba = pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")


def span(name: str) -> range:
    """The bytes of a field of a thing."""
    assert OBJECT.fields is not None
    dtype, offset = OBJECT.fields[name][:2]
    return range(offset, offset + dtype.itemsize)


@pytest.mark.parametrize("kind", Object.__bases__, ids=lambda kind: str(kind.__name__))
def test_fields_of_one_kind_never_overlap(kind: type) -> None:
    for one, other in combinations(fields_of(kind), 2):
        assert not set(span(one.name)) & set(span(other.name)), (one.name, other.name)


def test_the_header_lies_alike_in_every_thing_and_kinds_share_what_is_behind_it() -> None:
    header = {byte for field in fields_of(Header) for byte in span(field.name)}
    assert header == set(range(len(header)))
    assert OBJECT.itemsize < sum(len(span(field.name)) for field in fields_of(Object))


def test_every_field_is_aligned() -> None:
    for dtype in (WORLD, OBJECT, TILE_MAP):
        assert dtype.fields is not None
        for name, (field, offset, *_) in dtype.fields.items():
            assert offset % min(8, field.base.itemsize if field.base.fields is None else 8) == 0, name


def test_a_field_that_numpy_would_hide_is_refused() -> None:
    @part
    class Bad:
        shape: f8

    with pytest.raises(TypeError, match=r"Bad\.shape"):
        dtype_of(Bad)


def test_worlds_are_packed_by_what_they_use() -> None:
    worlds = new_worlds(3, 70)
    assert used_bytes(70) <= worlds.strides[0] < used_bytes(70) + 64
    assert WORLD.itemsize == used_bytes(CAPACITY)
    worlds["slots_used"] = 70
    worlds[1]["ninja"]["x"] = 5.0
    assert not state_view(worlds, 0).any() or worlds[0]["ninja"]["x"] == 0.0
    assert len(state_view(worlds, 1)) == used_bytes(70) - STATE_START
    state_view(worlds, 2)[:] = state_view(worlds, 1)
    assert worlds[2]["ninja"]["x"] == 5.0
    assert worlds[0]["ninja"]["x"] == 0.0


def test_a_median_level_fits_in_64_kib() -> None:
    assert used_bytes(65 + 2) <= 64 * 1024


@needs_numba
def test_no_index_is_ever_out_of_range() -> None:
    kernels = Compiler(boundscheck=True).kernels()
    for seed in range(60):
        levels, worlds = load_compiled(kernels, crowded_level(seed), seed % 2 == 1)
        slots = np.arange(1, int(worlds["id_count"][0]) + 1)
        inputs = np.frombuffer(crowded_inputs(seed, 150), np.uint8)
        objects = np.empty((150, len(slots)), [("x", "<f8"), ("y", "<f8"), ("s", "<i4")])
        ninja = np.empty(
            150, [(name, "<f8") for name in ("x", "y", "prev_x", "prev_y")] + [("s", "<i4"), ("gold", "<i4")]
        )
        kernels["trace_world"](levels, worlds, 0, inputs, slots, ninja, objects)


def test_entry_points_are_registered_rules() -> None:
    assert set(ENTRY_POINTS) <= set(REGISTERED)
    assert len({entry.__name__ for entry in ENTRY_POINTS}) == len(ENTRY_POINTS)
