"""What must hold in any level: save-states, both memories, digests, the ninja stays inside."""

import math
import os

import pytest
from hypothesis import given, settings, strategies as st

from ninja_game.backend.memories import compiled_available
from ninja_game.errors import LevelError
from ninja_game.sim.digest import OVERWRITTEN, differences, state_digest
from ninja_game.sim.kinds import DRONE, GOLD, LAUNCH_PAD, NINJA, VALUE_COUNTS
from ninja_game.sim.level import BODIES, Body, Level, ObjectSpec
from ninja_game.sim.schema.declare import fields_of
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.states import JUMPING, PSEUDO_RANDOM
from ninja_game.simulation import Simulation
from tests.support.crowded import crowded_inputs, crowded_level
from tests.support.memories import BOTH

seeds = st.integers(0, 2**32)
bodies = st.sampled_from(BODIES)


@pytest.mark.parametrize("memory", BOTH)
@settings(max_examples=40)
@given(seed=seeds, body=bodies, start=st.integers(0, 120), span=st.integers(1, 120))
def test_a_restored_run_goes_on_as_if_nothing_had_been(
    memory: str, seed: int, body: Body, start: int, span: int
) -> None:
    inputs = crowded_inputs(seed, start + span)
    run = Simulation(crowded_level(seed), body=body, memory=memory)
    for keys in inputs[:start]:
        run.step_keys(keys)
    state = run.save()
    before = run.digest()
    for keys in inputs[start:]:
        run.step_keys(keys)
    straight = run.digest()
    run.restore(state)
    assert run.digest() == before
    for keys in inputs[start:]:
        run.step_keys(keys)
    assert run.digest() == straight


@settings(max_examples=60)
@given(seed=seeds, body=bodies, start=st.integers(0, 100), garbage=st.sampled_from([-1, 0, 1, 7]))
def test_what_the_state_digest_leaves_out_decides_nothing(seed: int, body: Body, start: int, garbage: int) -> None:
    run, changed = (Simulation(crowded_level(seed), body=body, memory="plain") for _ in range(2))
    for tick, keys in enumerate(crowded_inputs(seed, start + 60)):
        if tick == start:
            ninja = changed.world.ninja
            for name in OVERWRITTEN | ({"jump_timer"} if ninja.state != JUMPING else set()):
                setattr(ninja, name, garbage)
            for o in changed.world.objects:
                if o.kind == DRONE:
                    o.move_ticks += 2 if o.movement == PSEUDO_RANDOM else 7
        run.step_keys(keys)
        changed.step_keys(keys)
        assert state_digest(run.world) == state_digest(changed.world), run.first_difference(changed)
        assert run.replay_digest() == changed.replay_digest()


@given(seed=seeds)
def test_the_state_digest_tells_all_else_that_moves(seed: int) -> None:
    run, later = (Simulation(crowded_level(seed), memory="plain") for _ in range(2))
    later.step_keys(0)
    later.world.tick = 0
    left_out = {*OVERWRITTEN, "jump_timer", "move_ticks"}
    differs = [name for name, *_ in differences(run.world, later.world) if name.split(": ")[-1] not in left_out]
    assert (state_digest(run.world) == state_digest(later.world)) == (not differs)
    before = state_digest(run.world)
    run.world.tick += 1
    assert state_digest(run.world) == before


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
@settings(max_examples=int(os.environ.get("EXAMPLES", "60")))
@given(seed=seeds, body=bodies)
def test_plain_and_compiled_worlds_are_equal_in_every_field_and_event(seed: int, body: Body) -> None:
    plain, compiled = (Simulation(crowded_level(seed), body=body, memory=memory) for memory in ("plain", "compiled"))
    for tick, keys in enumerate(crowded_inputs(seed, 150)):
        plain.step_keys(keys)
        compiled.step_keys(keys)
        if tick % 10 == 0:
            assert plain.digest() == compiled.digest(), plain.first_difference(compiled)
            # repr, so that NaN equals NaN
            assert repr(plain.events) == repr(compiled.events)
    assert plain.digest() == compiled.digest(), plain.first_difference(compiled)


odd_numbers = st.one_of(
    st.floats(),
    st.sampled_from([0.0, -0.0, 1.0, -1.0, 2.0, 3.0, 0.5, 12.0, 36.0, 300.0, -5.0, 1e308, 1e-310, math.nan, math.inf]),
)
odd_records = st.builds(ObjectSpec, st.integers(0, 12), st.lists(odd_numbers, max_size=10).map(tuple))
near_records = st.integers(0, 12).flatmap(
    lambda kind: st.builds(
        ObjectSpec,
        st.just(kind),
        st.lists(odd_numbers, min_size=VALUE_COUNTS[kind], max_size=VALUE_COUNTS[kind]).map(tuple),
    )
)
odd_levels = st.builds(
    Level,
    st.lists(st.sampled_from([0, 0, 0, 0, 1, 2, 9, 14, 25, 33, 40, -1]), min_size=713, max_size=713).map(tuple),
    st.lists(st.one_of(odd_records, near_records), max_size=12).map(
        lambda records: (ObjectSpec(NINJA, (60.0, 60.0)), *records)
    ),
)


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
@settings(max_examples=60)
@given(level=odd_levels, seed=seeds)
def test_odd_numbers_neither_stop_the_world_nor_part_the_memories(level: Level, seed: int) -> None:
    plain, compiled = (Simulation(level, memory=memory) for memory in ("plain", "compiled"))
    for keys in crowded_inputs(seed, 60):
        plain.step_keys(keys)
        compiled.step_keys(keys)
    assert plain.digest() == compiled.digest(), plain.first_difference(compiled)


@settings(max_examples=60)
@given(seed=seeds, body=bodies)
def test_the_ninja_never_leaves_the_interior(seed: int, body: Body) -> None:
    level = crowded_level(seed)
    records = tuple(record for record in level.objects if record.kind != LAUNCH_PAD)
    run = Simulation(Level(level.tiles, records), body=body)
    for keys in crowded_inputs(seed):
        run.step_keys(keys)
        assert 24.0 <= run.ninja.x <= 768.0
        assert 24.0 <= run.ninja.y <= 576.0


@pytest.mark.parametrize("memory", BOTH)
def test_reset_starts_afresh(memory: str) -> None:
    run = Simulation(crowded_level(5), memory=memory)
    fresh = run.digest()
    for keys in crowded_inputs(5):
        run.step_keys(keys)
    assert run.digest() != fresh
    run.reset()
    assert (run.tick, run.digest()) == (0, fresh)


def test_a_save_state_of_another_level_is_refused() -> None:
    one, other = Simulation(crowded_level(1)), Simulation(crowded_level(2))
    with pytest.raises(ValueError, match="another level"):
        other.restore(one.save())


@pytest.mark.parametrize("memory", BOTH)
def test_a_jump_key_triggers_once_until_it_is_released(memory: str) -> None:
    run = Simulation(Level(objects=(ObjectSpec(NINJA, (100.0, 566.0)),)), memory=memory)
    run.step()
    run.step(jump=True)
    assert [event.name for event in run.events] == ["jumped"]
    run.step(jump=True)
    assert run.events == []
    assert run.ninja.state == "jumping"


def test_a_level_without_a_ninja_cannot_be_played() -> None:
    with pytest.raises(LevelError, match="no ninja"):
        Simulation(Level())


def test_too_many_objects_are_refused_with_their_number() -> None:
    records = (ObjectSpec(NINJA, (100.0, 100.0)), *[ObjectSpec(GOLD, (200.0, 200.0))] * 20_000)
    with pytest.raises(LevelError, match="20001"):
        Simulation(Level(objects=records))


@pytest.mark.parametrize("memory", BOTH)
def test_two_thousand_objects_load_and_run(memory: str) -> None:
    gold = [ObjectSpec(GOLD, (30.0 + 7 * (k % 100), 30.0 + 25 * (k // 100))) for k in range(2000)]
    run = Simulation(Level(objects=(ObjectSpec(NINJA, (300.0, 300.0)), *gold)), memory=memory)
    for _ in range(50):
        run.step(right=True)
    assert run.gold > 0
    assert len(run.objects) == 2000


def test_a_wrong_body_or_memory_is_named() -> None:
    level = Level(objects=(ObjectSpec(NINJA, (100.0, 100.0)),))
    with pytest.raises(ValueError, match="triangle"):
        Simulation(level, body="triangle")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="cloud"):
        Simulation(level, memory="cloud")


def test_the_digest_of_replays_covers_what_the_world_shows_and_nothing_inside_it() -> None:
    run = Simulation(Level(objects=(ObjectSpec(NINJA, (100.0, 566.0)), ObjectSpec(GOLD, (160.0, 566.0)))))
    whole, shown = run.digest(), run.replay_digest()
    run.world.think_counter += 1
    assert (run.digest() != whole, run.replay_digest()) == (True, shown)
    run.world.objects[2].taken = 1
    assert run.replay_digest() != shown


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
@settings(max_examples=20)
@given(seed=seeds, ticks=st.integers(0, 120))
def test_a_copied_world_has_nothing_in_fields_of_other_kinds(seed: int, ticks: int) -> None:
    """Compiled, those have the bytes of own fields."""
    fields = [vars(Object)[field.name] for field in fields_of(Object)]
    plain, compiled = (Simulation(crowded_level(seed), memory=memory) for memory in ("plain", "compiled"))
    for run in (plain, compiled):
        for keys in crowded_inputs(seed, ticks):
            run.step_keys(keys)
    rows = [[[field.__get__(o) for field in fields] for o in run.world.objects[1:]] for run in (plain, compiled)]
    assert rows[0] == rows[1]
