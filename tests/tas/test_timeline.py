"""Timelines: after any edits every row is that of a straight run; watched values are those of a search."""

from random import Random

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from ninja_game.batch.batch import Batch
from ninja_game.errors import ArgumentError
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.runs import save_states
from ninja_game.runs.save_states import SaveStates
from ninja_game.runs.trace import trace_level
from ninja_game.search.formula.names import FLAGS, NAMES, view_of
from ninja_game.sim.inputs import MAX_TICKS, fit_inputs, with_press_bits
from ninja_game.simulation import Simulation
from ninja_game.tas.timeline import TICKS_BEHIND_END, Timeline, exit_distance, parse_watch
from ninja_game.tas.tracks import InputTrack
from tests.support.memories import BOTH
from tests.support.own_pack import PACK
from tests.support.samples import WALK
from tests.support.slow import the_rest_is_slow

WALKED = parse_level_string(WALK)
RUNS = {
    name: load_replays(PACK / "certificates" / f"{name}.exit.replay.txt")[0]
    for name in ("00-4-every-switch", "01-0-up-and-away", "01-1-watch-and-go", "01-2-no-hurry")
}


FALL = parse_level_string("0" * 713 + "|5^100,40!11^700,584,700,560")


@pytest.mark.parametrize("memory", BOTH)
def test_a_death_is_shown_with_what_killed(memory: str) -> None:
    timeline = Timeline(FALL, bytes([2] * 100), memory=memory)
    assert (timeline.death(), timeline.ending()) == ("", ""), "nothing is simulated yet"
    timeline.simulate(300)
    end = timeline.end[0]
    assert timeline.ending() == f"dead in tick {end}: {timeline.death()}"
    speed, over = (float(word) for word in timeline.death().replace(",", "").split()[2::3])
    y = timeline.column("y")
    assert (y[end - 1] - y[end - 2] < speed < y[end - 1] - y[end - 2] + 1, over) == (True, 7.0)
    timeline.set_inputs(bytes(100))
    timeline.simulate(300)
    check(timeline)
    assert timeline.death().startswith("floor at"), "of the new run"


def check(timeline: Timeline) -> None:
    """Compare every row with a straight run."""
    straight = trace_level(timeline.level, fit_inputs(timeline.inputs, len(timeline)), memory="plain", events=True)
    valid = timeline.simulated_until
    for name in ("x", "y", "prev_x", "prev_y", "gold"):
        assert timeline.column(name).tobytes() == straight.ninja[name][:valid].tobytes(), name
    assert timeline.column("state").tolist() == straight.ninja["s"][:valid].tolist()
    assert [timeline.events(tick) for tick in range(valid)] == list(straight.events[:valid])
    for id_ in timeline.watched:
        place = straight.ids.index(id_)
        for name in ("x", "y", "s"):
            wanted = straight.objects[name][:valid, place]
            assert timeline.object_column(id_, name).tobytes() == wanted.astype(float).tobytes(), (id_, name)


@pytest.mark.parametrize("memory", BOTH)
@settings(max_examples=40)
@given(st.data())
def test_after_any_edits_every_row_is_that_of_a_straight_run(memory: str, data: st.DataObject) -> None:
    most, save_states.MAX_STATES = save_states.MAX_STATES, data.draw(st.sampled_from([2, 3, 300]))
    try:
        track = InputTrack(
            with_press_bits(data.draw(st.lists(st.integers(0, 7), max_size=20))) * data.draw(st.integers(1, 12))
        )
        timeline = Timeline(RUNS["01-2-no-hurry"].level, track.inputs, memory=memory)
        ids = [id_ for id_, seen in enumerate(timeline.initial) if seen[0] in {0, 9, 11}][:3]
        for _ in range(data.draw(st.integers(1, 6))):
            what = data.draw(st.sampled_from(["edit", "edit", "work", "need", "watch"]))
            if what == "edit":
                first = data.draw(st.integers(0, len(track) + 5))
                last = data.draw(st.integers(first, first + 30))
                track = track.replaced(first, last, data.draw(st.lists(st.integers(0, 7), max_size=9)))
                timeline.set_inputs(track.inputs)
            elif what == "work":
                timeline.simulate(data.draw(st.integers(1, 130)))
            elif what == "need":
                tick = data.draw(st.integers(0, len(timeline) + 10))
                timeline.ensure(tick)
                assert timeline.simulated_until > min(tick, len(timeline) - 1)
            else:
                timeline.watch(data.draw(st.lists(st.sampled_from(ids), max_size=3)))
            assert timeline.simulated_until <= len(timeline)
        check(timeline)
        while not timeline.simulate(data.draw(st.integers(1, 70))):
            pass
        assert timeline.simulated_until == len(timeline) == len(track) + TICKS_BEHIND_END
        check(timeline)
    finally:
        save_states.MAX_STATES = most


def test_an_edit_keeps_what_comes_before_it() -> None:
    timeline = Timeline(WALKED, bytes([2] * 20), memory="plain")
    timeline.simulate(1000)
    assert timeline.end == (24, "exit")
    assert timeline.set_inputs(bytes([2] * 10 + [0] + [2] * 9)) == 10
    assert timeline.simulated_until == 10
    timeline.simulate(1000)
    # Behind the last input no key is down: such ticks more or less change nothing.
    assert timeline.set_inputs(bytes([2] * 10 + [0] + [2] * 9 + [0] * 30)) == 50
    assert timeline.simulated_until >= 50


def test_states_of_a_timeline_begin_simulations() -> None:
    recording = RUNS["01-0-up-and-away"]
    timeline = Timeline(recording.level, recording.inputs, memory="plain")
    timeline.simulate(10**6)
    for tick in (0, 59, 60, 61, recording.ticks, 10**9):
        state = timeline.save_state(tick)
        assert state.tick <= tick
        world = Simulation(recording.level, memory="plain")
        world.restore(state)
        straight = Simulation(recording.level, memory="plain")
        for keys in fit_inputs(timeline.inputs, state.tick):
            straight.step_keys(keys)
        assert world.digest() == straight.digest()


def test_the_longest_run_has_states_too() -> None:
    timeline = Timeline(WALKED, bytes(MAX_TICKS), memory="plain")
    timeline.simulated_until = len(timeline)
    timeline._states.keep(MAX_TICKS + 20, timeline._worlds.save())
    assert timeline.save_state(10**9).tick <= MAX_TICKS


def test_save_states_are_thinned_and_never_far_apart() -> None:
    rng = Random(1)
    states: SaveStates[int] = SaveStates(0, 0, spacing=4)
    tick = 0
    for _ in range(3000):
        tick += 1
        if states.wants(tick):
            states.keep(tick, tick)
        if rng.random() < 0.003:
            tick = rng.randrange(tick)
            states.forget_after(tick)
        at, state = states.nearest(tick)
        assert at == state <= tick
        assert tick - at <= states.spacing
    assert len(states) <= save_states.MAX_STATES


@pytest.mark.parametrize("name", the_rest_is_slow([*RUNS], 1))
@pytest.mark.parametrize("memory", BOTH)
def test_watched_values_are_those_of_a_search(name: str, memory: str) -> None:
    recording = RUNS[name]
    inputs = recording.inputs
    timeline = Timeline(recording.level, inputs, memory=memory)
    timeline.simulate(10**6)
    formulas = [each for each, count in NAMES.items() if not count] + ["distance(100, 200)", "hypot(vx, vy) * 2"]
    for id_, (kind, *_) in enumerate(timeline.initial):
        try:
            timeline.at_start(id_)
        except ArgumentError:
            continue
        formulas += [f"object_x({id_}) + object_y({id_})"]
        formulas += [f"{what}({id_})" for what in FLAGS if kind in FLAGS[what]]
    watches = {text: parse_watch(text) for text in formulas}
    watched = {text: watch.values(timeline) for text, watch in watches.items()}
    batch = Batch(recording.level, 1, memory="plain")
    for tick, keys in enumerate(fit_inputs(inputs, len(timeline))):
        batch.run([[keys]])
        view = view_of(batch)
        for text, watch in watches.items():
            assert np.array_equal(watched[text][tick], watch.formula.value(view)[0], equal_nan=True), (text, tick)
    changed = [text for text in formulas if text.startswith(("opened", "taken")) and len(set(watched[text])) > 1]
    assert any(text.startswith("opened") for text in changed), "the exit's door opens"


def test_watched_doors_are_open_as_long_as_they_are() -> None:
    # An automatic door in the way: it opens, and closes behind the ninja; its status is another one than at first.
    level = parse_level_string("0" * 713 + "|5^100,566!9^200,564,0,0,8,23,0,0,0!0^400,100")
    timeline = Timeline(level, bytes([2] * 80), memory="plain")
    timeline.simulate(1000)
    door = next(id_ for id_, seen in enumerate(timeline.initial) if seen[0] == 9)
    opened = parse_watch(f"opened({door})").values(timeline)
    assert (opened[0], opened.max(), opened[-1]) == (0.0, 1.0, 0.0)
    assert parse_watch(f"status({door})").values(timeline)[-1] != parse_watch(f"status({door})").values(timeline)[0]


def test_watched_values_follow_edits_and_say_what_is_wrong() -> None:
    level = parse_level_string("0" * 713 + "|5^100,566!11^200,564,170,564!0^140,566")
    timeline = Timeline(level, bytes([2] * 30), memory="plain")
    watch = parse_watch("exit_distance")
    assert len(watch.values(timeline)) == 0
    timeline.simulate(1000)
    assert (watch.values(timeline) <= 0).any()
    assert (exit_distance(timeline) == watch.values(timeline)).all()
    gone = parse_watch("taken(2)")
    assert gone.values(timeline).max() == 1.0
    timeline.set_inputs(bytes(30))
    timeline.simulate(1000)
    assert gone.values(timeline).max() == 0.0
    for text in ("taken(99)", "object_x(0.5)", "opened(2)", "object_x(1 / 0)", "object_x(x)"):
        with pytest.raises(ArgumentError):
            parse_watch(text).values(timeline)
