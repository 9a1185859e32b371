"""The compiled memory: kinds overlap without harm, worlds are packed, indices stay in range."""

from itertools import combinations

import pytest

from ninja_game.backend.compiled import CompiledWorlds
from ninja_game.backend.compiler import Compiler
from ninja_game.backend.layout import (
    OBJECT_DTYPE,
    STATE_START,
    TILE_MAP,
    WORLD,
    dtype_of,
    new_worlds,
    used_bytes,
    world_bytes,
)
from ninja_game.backend.memories import compiled_available
from ninja_game.backend.numba_import import import_numba
from ninja_game.sim.events import emit
from ninja_game.sim.schema.declare import KERNELS, REGISTERED, f8, fields_of, kernel, struct_base
from ninja_game.sim.schema.object_fields import Header, Object
from ninja_game.sim.schema.world_fields import CAPACITY
from tests.support.crowded import crowded_inputs, crowded_level

needs_numba = pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")


def span(name: str) -> range:
    """The bytes of a field of an object."""
    assert OBJECT_DTYPE.fields is not None
    dtype, offset = OBJECT_DTYPE.fields[name][:2]
    return range(offset, offset + dtype.itemsize)


@pytest.mark.parametrize("kind", Object.__bases__, ids=lambda kind: str(kind.__name__))
def test_fields_of_one_kind_never_overlap(kind: type) -> None:
    for one, other in combinations(fields_of(kind), 2):
        assert not set(span(one.name)) & set(span(other.name)), (one.name, other.name)


def test_the_header_lies_alike_in_every_object_and_kinds_share_what_is_behind_it() -> None:
    header = {byte for field in fields_of(Header) for byte in span(field.name)}
    assert header == set(range(len(header)))
    assert OBJECT_DTYPE.itemsize < sum(len(span(field.name)) for field in fields_of(Object))


def test_every_field_is_aligned() -> None:
    for dtype in (WORLD, OBJECT_DTYPE, TILE_MAP):
        assert dtype.fields is not None
        for name, (field, offset, *_) in dtype.fields.items():
            assert offset % min(8, field.base.itemsize if field.base.fields is None else 8) == 0, name


def test_a_field_that_numpy_would_hide_is_refused() -> None:
    @struct_base
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
    states = world_bytes(worlds)
    assert states.shape == (3, worlds.strides[0] - STATE_START)
    assert len(world_bytes(new_worlds(2, CAPACITY))) == 2
    states[2] = states[1]
    assert worlds[2]["ninja"]["x"] == 5.0
    assert worlds[0]["ninja"]["x"] == 0.0


def test_a_median_level_fits_in_64_kib() -> None:
    assert used_bytes(65 + 2) <= 64 * 1024


@pytest.mark.slow
@needs_numba
def test_no_index_is_ever_out_of_range() -> None:
    checked = Compiler(import_numba(), checked=True)
    for seed in range(60):
        memory = CompiledWorlds(checked, [crowded_level(seed)], box=seed % 2 == 1)
        memory.trace(crowded_inputs(seed, 150), range(1, memory.number("id_count") + 1), events=True)


def test_kernels_are_registered_rules_with_names_of_their_own() -> None:
    assert set(KERNELS) <= REGISTERED

    def step_world() -> None:
        """Another function of a known name."""

    with pytest.raises(TypeError, match="another kernel of the name step_world"):
        kernel(step_world)


@pytest.mark.slow
@needs_numba
def test_a_rule_is_compiled_once_whatever_constants_its_callers_write() -> None:
    compiler = Compiler(import_numba())
    CompiledWorlds(compiler, [crowded_level(0)], box=False).kill(0, 0.0, 0.0)
    assert len(compiler._twin(emit).signatures) == 1
    without_the_private_part = object()
    assert compiler._one_for_all_integers(without_the_private_part) is without_the_private_part
