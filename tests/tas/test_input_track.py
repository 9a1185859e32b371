"""Takes: what an edit changes of keys, jumps and names of ticks, and what it leaves alone."""

from collections.abc import Callable

import pytest
from hypothesis import given, strategies as st

from ninja_game.errors import ArgumentError, ReplayError
from ninja_game.formats.replay.notations import Marker
from ninja_game.sim.inputs import JUMP_HELD, KEYS_DOWN, MAX_TICKS, with_press_bits
from ninja_game.tas.tracks import InputTrack
from tests.support.strategies import tracks

keyboards = st.lists(st.integers(0, 7), max_size=30).map(with_press_bits)

spans = st.tuples(st.integers(0, 40), st.integers(0, 40)).map(lambda span: (min(span), max(span)))
new_keys = st.lists(st.integers(0, 7), max_size=12)


@given(tracks(keyboards), spans, new_keys)
def test_keys_of_a_keyboard_stay_those_of_a_keyboard(track: InputTrack, span: tuple[int, int], keys: list[int]) -> None:
    first, last = span
    down = [key & KEYS_DOWN for key in track.inputs]
    wanted = (down + [0] * first)[:first] + keys + down[last:]
    assert track.replaced(first, last, keys).inputs == with_press_bits(wanted)


@given(tracks(), spans, new_keys)
def test_ticks_that_are_not_edited_stay_as_they_are(track: InputTrack, span: tuple[int, int], keys: list[int]) -> None:
    first, last = span
    new = track.replaced(first, last, keys)
    assert new.inputs[:first] == track.inputs[:first].ljust(first, b"\0")
    behind = first + len(keys)
    assert new.inputs[behind + 1 :] == track.inputs[last + 1 :]
    assert [key & KEYS_DOWN for key in new.inputs[first:behind]] == keys
    if last < len(track):
        held = bool(last and track.inputs[last - 1] & JUMP_HELD)
        odd = track.inputs[last] != with_press_bits([JUMP_HELD * held, track.inputs[last]])[1]
        held_now = bool(behind and new.inputs[behind - 1] & JUMP_HELD)
        joined = with_press_bits([JUMP_HELD * held_now, track.inputs[last]])[1]
        assert new.inputs[behind] == (track.inputs[last] if odd else joined)


@given(tracks(), spans, new_keys)
def test_names_go_along_with_their_ticks(track: InputTrack, span: tuple[int, int], keys: list[int]) -> None:
    first, last = span
    new = {marker.name: marker.tick for marker in track.replaced(first, last, keys).markers}
    for tick, name in track.markers:
        if tick < first:
            assert new[name] == tick
        elif tick >= last:
            assert new[name] == tick + len(keys) - (last - first)
        else:
            assert new.get(name) == (tick if tick < first + len(keys) else None)


@given(tracks(), spans, st.sampled_from([1, 2, 4]), st.booleans())
def test_a_key_goes_down_or_up_in_a_span(track: InputTrack, span: tuple[int, int], key: int, down: bool) -> None:
    new = track.with_key(*span, key, down=down)
    for tick in range(len(new)):
        inside = span[0] <= tick < span[1]
        before = track.keys_at(tick)
        assert new.keys_at(tick) == (before | key if down else before & ~key if inside else before) or not inside
        if not inside:
            assert new.keys_at(tick) == before


def test_a_run_grows_by_ticks_without_a_key() -> None:
    track = InputTrack(b"\2").replaced(3, 3, [1])
    assert track.inputs == b"\2\0\0\1"
    assert track.with_key(5, 6, 4, down=True).inputs == b"\2\0\0\1\0\x0c"


def test_names_of_ticks_are_such_as_texts_can_hold() -> None:
    track = InputTrack(b"\2\2").named(1, " first jump ")
    assert track.markers == (Marker(1, "first jump"),)
    assert track.named(0, "first jump").markers == (Marker(0, "first jump"),)
    assert track.named(1, 'so "high"').markers == (Marker(1, "so 'high'"),)
    assert track.named(1, "b").markers == (Marker(1, "b"),)
    assert track.named(1, "").markers == ()
    far = track.named(5, "far")
    assert (len(far), far.markers) == (5, (Marker(1, "first jump"), Marker(5, "far")))
    for name in ("a\nb", "a" * 101, "\ud800", "\u202ea"):
        with pytest.raises(ReplayError, match="letters, digits"):
            track.named(0, name)


def test_edits_of_ticks_that_there_cannot_be_are_refused_at_once() -> None:
    track = InputTrack(bytes(10))
    edits: list[Callable[[], InputTrack]] = [
        lambda: track.replaced(-1, 3, []),
        lambda: track.replaced(4, 3, []),
        lambda: track.replaced(10**15, 10**15, [1]),
        lambda: track.replaced(MAX_TICKS - 9, MAX_TICKS - 9, [1] * 10),
        lambda: track.replaced(0, 0, [1] * MAX_TICKS),
        lambda: track.with_key(0, 10**15, 1, down=True),
        lambda: track.named(MAX_TICKS + 1, "a"),
        lambda: track.named(-1, "a"),
    ]
    for edit in edits:
        with pytest.raises(ArgumentError):
            edit()
    assert len(track.replaced(MAX_TICKS - 1, MAX_TICKS - 1, [1])) == MAX_TICKS
