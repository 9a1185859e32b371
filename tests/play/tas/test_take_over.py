"""The player's keys play the run on: recorded as pressed, one edit, tick by tick, paused, ended."""

from random import Random
from time import thread_time

import pygame
import pytest

from ninja_game.sim.inputs import with_press_bits
from ninja_game.tas.timeline import TICKS_BEHIND_END
from ninja_game.tas.tracks import InputTrack
from ninja_game.tas_editor.level.playing import TakeOver
from ninja_game.ui.input.keys import SCANCODES
from tests.support.tas_driver import TasDriver

START = 60


def take_over(at: TasDriver, tick: int = START) -> TakeOver:
    """Taken over behind a tick, before the first key."""
    at.editor.go(tick)
    at.press("return")
    taken = at.screen.level.take_over
    assert taken.on
    return taken


def random_keys(count: int) -> list[int]:
    """Keys of a player who lets none of them be down all the time; the first one is down at once."""
    rng = Random(count)
    return [2, *(rng.choice([0, 1, 2, 2, 6, 4]) for _ in range(count - 1))]


def test_what_is_pressed_is_what_is_recorded_and_it_is_one_edit(at: TasDriver) -> None:
    before, edits = at.editor.track, len(at.session.history.done)
    taken = take_over(at)
    at.frames(5)
    assert at.editor.cursor == START, "it waits for the first key"
    at.keys.script = [2, *random_keys(50)]
    at.frames(51)
    assert at.editor.cursor == START + 50
    assert at.editor.track.inputs[: START + 1] == before.inputs[: START + 1]
    keys = [at.editor.track.keys_at(START + 1 + k) for k in range(50)]
    assert keys == random_keys(50)
    assert at.shown_digest() == at.straight_digest(at.editor.cursor)
    at.press("escape")
    assert not taken.on
    assert at.top() is at.screen
    inputs = with_press_bits(k & 7 for k in at.editor.track.inputs[: START + 51])
    assert at.editor.track.inputs[START + 1 : START + 51] == inputs[START + 1 :]
    assert len(at.session.history.done) == edits + 1
    assert at.session.timeline.is_complete
    at.chord("z", pygame.KMOD_LCTRL)
    assert at.editor.track == before


def test_keys_that_are_down_already_begin_when_pressed_again(at: TasDriver) -> None:
    at.keys.script = [2] * 10
    take_over(at)
    at.frames(4)
    assert at.editor.cursor == START
    at.keys.script = [0, 2, 2, 2]
    at.frames(3)
    assert at.editor.cursor == START + 1


def test_space_that_also_jumps_begins_nothing(at: TasDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    before, taken = at.editor.track, take_over(at)
    monkeypatch.setattr(at.keys, "choosing", lambda **_: 4)
    at.keys.script = [0, 4, 4]
    at.frames(4)
    assert (at.editor.cursor, at.editor.track, taken.waiting) == (START, before, True)


def test_before_the_first_key_space_begins_nothing(at: TasDriver) -> None:
    before, taken = at.editor.track, take_over(at)
    at.press("space")
    at.frames(5)
    assert (at.editor.cursor, at.editor.track, taken.waiting) == (START, before, True)
    at.keys.script = [2] * 3
    at.frames(3)
    assert at.editor.cursor == START + 2
    at.press("space")
    assert taken.still


def test_frame_advance_takes_the_keys_that_are_held(at: TasDriver) -> None:
    taken = take_over(at)
    for keys in (1, 5, 0, 2):
        at.keys.script = [keys]
        at.press("period")
        at.frames(3)
    assert at.editor.cursor == START + 4
    assert [at.editor.track.keys_at(START + 1 + k) for k in range(4)] == [1, 5, 0, 2]
    at.press("comma", "comma")
    assert at.editor.cursor == START + 2
    assert at.shown_digest() == at.straight_digest(START + 2)
    at.keys.script = [4]
    # Shift is a key that jumps: the command is meant all the same.
    at.chord("period", pygame.KMOD_LSHIFT)
    assert [at.editor.track.keys_at(START + 1 + k) for k in range(4)] == [1, 5, 4, 2]
    assert taken.still
    at.keys.script = [1] * 3
    at.press("space")
    at.frames(2)
    assert at.editor.cursor == START + 6
    at.press("space")
    at.frames(5)
    assert at.editor.cursor == START + 6
    at.press("return")
    assert not taken.on


def test_nothing_else_edits_meanwhile(at: TasDriver) -> None:
    taken = take_over(at)
    before = at.editor.track
    at.press("delete", "i", "backspace", "left", "right", "z", "b", "m", "f")
    at.chord("z", pygame.KMOD_LCTRL)
    at.chord("s", pygame.KMOD_LCTRL)
    at.mouse(*at.cell(START + 3, "left"))
    at.mouse(200, 200)
    assert at.editor.track == before
    assert at.top() is at.screen
    assert (taken.on, at.editor.cursor) == (True, START)


def test_a_key_with_ctrl_is_not_the_bare_key(at: TasDriver) -> None:
    taken, speed = take_over(at), at.screen.level.playing.speed
    for key in ("g", "period", "minus", "return", "1"):
        at.chord(key, pygame.KMOD_LCTRL)
    assert (at.editor.ghosts, at.editor.cursor, at.screen.level.playing.speed, taken.on) == (True, START, speed, True)
    assert not at.screen.level.picture.overlays.on
    at.press("g")
    assert not at.editor.ghosts


def test_when_the_window_loses_the_keys_it_stands_still(at: TasDriver) -> None:
    taken = take_over(at)
    at.keys.script = [2] * 100
    at.frames(5)
    pygame.event.post(pygame.Event(pygame.WINDOWFOCUSLOST))
    at.frames()
    there = at.editor.cursor
    at.frames(10)
    assert (taken.on, taken.still, at.editor.cursor) == (True, True, there)


def test_speed(at: TasDriver) -> None:
    take_over(at)
    at.press("minus", "minus")
    at.keys.script = [2] * 30
    at.frames(21)
    assert at.editor.cursor == START + 5


def test_it_goes_on_behind_the_last_tick_and_the_run_grows(at: TasDriver) -> None:
    at.editor.edit(lambda _: InputTrack(bytes(30)))
    take_over(at, 60)
    at.keys.script = [1] + [1] * 10
    at.frames(11)
    assert len(at.editor.track) == 71
    assert at.editor.cursor == 70
    assert at.shown_digest() == at.straight_digest(70)


def test_after_the_end_it_shows_what_follows_and_ends(at: TasDriver) -> None:
    end = at.session.timeline.end[0]
    taken = take_over(at, end - 2)
    before = at.editor.track
    at.keys.script = [before.keys_at(end - 1), *(before.keys_at(end - 1 + k) for k in range(2)), *[1] * 100]
    at.frames(TICKS_BEHIND_END + 10)
    assert not taken.on
    assert at.editor.cursor in (end + TICKS_BEHIND_END, at.editor.last_tick)
    assert at.editor.track.inputs == before.inputs, "behind the end nothing is recorded"
    at.press("return")
    assert not taken.on
    assert f"tick {end}" in at.app.notice


def test_leaving_the_tas_editor_ends_it_and_keeps_what_was_played(at: TasDriver) -> None:
    taken = take_over(at)
    at.keys.script = [2, *random_keys(10)]
    at.frames(11)
    at.press("tab")
    assert not taken.on
    assert not at.session.history.in_stroke
    assert [at.editor.track.keys_at(START + 1 + k) for k in range(10)] == random_keys(10)


def test_what_is_played_is_in_the_journal_before_it_ends(at: TasDriver) -> None:
    noted = at.session._journaled
    take_over(at)
    at.keys.script = [2, *random_keys(60)]
    at.frames(61)
    assert at.session._journaled != noted
    assert at.session.history.in_stroke


@pytest.mark.parametrize("length", [4000, 100_000])
def test_a_tick_is_quick_in_a_run_of_any_length(at: TasDriver, length: int) -> None:
    if at.session.timeline.memory != "compiled":
        pytest.skip("of the compiled memory")
    at.editor.edit(lambda track: track.replaced(len(track), len(track), [0] * length))
    at.session.timeline.simulate(length * 2)
    taken = take_over(at)
    costs = []
    for _ in range(30):
        started = thread_time()
        taken.step()
        costs.append(1000 * (thread_time() - started))
    assert sorted(costs)[15] < 4, "ms"


def test_the_real_bindings_know_what_is_held(at: TasDriver) -> None:
    """A key of the game is neither a command nor typed, down or up."""
    taken = take_over(at)
    before = at.editor.track
    for kind in (pygame.KEYDOWN, pygame.KEYUP):
        for name in ("left", "up", "w", "lshift"):
            pygame.event.post(pygame.Event(kind, key=0, scancode=SCANCODES[name], mod=0, unicode=""))
    at.frames()
    assert (taken.on, at.editor.track) == (True, before)


def test_undo_goes_back_to_where_it_began(at: TasDriver) -> None:
    at.editor.select(20, 21)
    at.press("z")
    at.press("z")
    take_over(at)
    at.keys.script = [1, 1, 5, 5]
    at.frames(4)
    at.press("return")
    at.editor.go(30)
    at.chord("z", pygame.KMOD_LCTRL)
    assert at.editor.cursor == START
