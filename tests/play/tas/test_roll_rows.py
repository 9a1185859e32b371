"""The rows of the roll: what they say, runs of no tick and of very many, how they are drawn."""

from pathlib import Path

import numpy as np
import pygame
import pytest

from ninja_game.player.settings import Settings
from ninja_game.sim.inputs import KEY_LEFT, KEY_RIGHT
from ninja_game.tas.tracks import InputTrack
from ninja_game.tas_editor.editor import tas_canvas, tas_layout
from ninja_game.tas_editor.roll.facts import RowFacts, changed_ticks, row_facts, row_text
from ninja_game.tas_editor.roll.rows import ROLL_COLUMNS, RowSheet, layout_of, short_number
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import CLASSIC, Area, Theme
from tests.support.tas_driver import TasDriver

CTRL, SHIFT = pygame.KMOD_LCTRL, pygame.KMOD_LSHIFT


def test_runs_of_no_tick_and_of_one(at: TasDriver) -> None:
    at.editor.edit(lambda track: InputTrack(b""))
    at.press("end", "end", "down", "home", "delete", "backspace", "m", "escape", "n")
    at.chord("c", CTRL)
    at.chord("a", CTRL)
    assert at.editor.selection == (0, 1)
    at.press("d")
    assert at.editor.track.inputs == bytes([KEY_RIGHT])
    at.press("end", "backspace", "home", "backspace")
    assert at.editor.track == InputTrack(b"")


def test_a_very_long_run_scrolls_by_drawing_new_rows_only(at: TasDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    at.editor.edit(lambda track: InputTrack(bytes([1, 2] * 50_000)))
    at.editor.edit(lambda track: track.named(60_000, "there"))
    at.session.timeline.simulate(200_000)
    at.editor.go(70_000)
    at.frames()
    drawn: list[int] = []
    draw = RowSheet.draw
    monkeypatch.setattr(RowSheet, "draw", lambda *args: drawn.append(draw(*args)))
    roll = at.screen.roll
    top = roll.top
    for step in (4, 4, -4):
        roll.scroll(roll.top + step)
        at.frames()
    assert roll.top == top + 4
    at.press("down")
    at.editor.edit(lambda track: track.named(70_003, "here"))
    at.frames()
    assert drawn == [4, 4, 4, 2, 1]
    at.press("end", "end")
    assert roll.top == at.editor.last_tick + 1 - roll.layout.rows


def test_numbers_fit_their_columns() -> None:
    numbers = {(-0.5, 3): "-0.500", (-10.6743, 3): "-10.67", (791.999, 2): "792.00", (-123.456, 2): "-123.5"}
    assert {each: short_number(*each) for each in numbers} == numbers
    assert short_number(float("inf"), 1) == "-", "a level without an exit"
    assert short_number(-1234567.0, 2) == "-"


def test_rows_that_differ_from_the_saved_ones_are_marked(at: TasDriver) -> None:
    at.editor.edit(lambda track: track.with_key(20, 22, KEY_LEFT, down=not track.keys_at(20) & KEY_LEFT))
    marked = [row.tick for row in row_facts(at.editor, 0, 60) if row.changed]
    assert 20 in marked
    assert set(marked) <= {20, 21}
    taken = InputTrack(bytes([1, 2, 1, 2, 2]))
    assert sum(changed_ticks(taken, InputTrack(bytes([1, 2, 2])))) == 2
    begun = InputTrack(bytes([2] * 9 + [1] * 20 + [2] * 5 + [0] * 7))
    shorter = InputTrack(bytes([2] * 6 + [1] * 20 + [2] * 2 + [1] + [2] * 2 + [0] * 7))
    assert np.flatnonzero(np.frombuffer(changed_ticks(shorter, begun), np.uint8)).tolist() == [28]
    assert changed_ticks(taken, taken) == bytes(5)


def test_rows_know_what_is_simulated_and_where_the_run_ends(at: TasDriver) -> None:
    timeline = at.session.timeline
    end, count = timeline.end[0], len(at.editor.track)
    rows = row_facts(at.editor, 0, len(timeline))
    assert [row.tick for row in rows if row.over] == list(range(end + 1, len(timeline)))
    assert [row.tick for row in rows if row.beyond] == list(range(count, len(timeline)))
    row = rows[end - 5]
    assert row.values is not None
    assert row.values.vx == float(timeline.column("x")[end - 5] - timeline.column("prev_x")[end - 5])
    timeline.simulated_until = 30
    rows = row_facts(at.editor, 25, 35)
    assert [row.values is None for row in rows] == [False] * 5 + [True] * 5
    assert "not simulated" in row_text(rows[-1], numbers=True)


def roll_of(size: tuple[int, int]) -> tuple[Canvas, Area]:
    canvas = tas_canvas(size)
    return canvas, tas_layout((size[0] / canvas.scale, size[1] / canvas.scale), Settings()).roll


@pytest.mark.parametrize("size", [(600, 450), (1000, 1000)])
def test_a_killers_name_takes_the_room_of_its_column(size: tuple[int, int]) -> None:
    canvas, area = roll_of(size)
    layout, surface = layout_of(canvas, area, ()), pygame.Surface(size)
    row = RowFacts(0, 0, 0, 0, None, "died", "homing launcher 12", None, "", *[False] * 5)
    RowSheet(Theme(CLASSIC, canvas), layout, CLASSIC.accent).draw(surface, [row])
    column, y = layout.places[-1], layout.body.top + 1
    chip = [x for x in range(column.left, column.left + column.width) if surface.get_at((x, y)) == CLASSIC.bad]
    assert chip[-1] - chip[0] > 0.85 * column.width


@pytest.mark.parametrize("size", [(792, 600), (1188, 900), (1584, 1200), (1000, 1000), (3000, 700), (200, 150)])
def test_columns_lie_side_by_side_in_any_window(size: tuple[int, int]) -> None:
    layout = layout_of(*roll_of(size), ())
    assert [place.column.name for place in layout.places] == [column.name for column in ROLL_COLUMNS]
    edges = np.array([[place.left, place.left + place.width] for place in layout.places])
    assert (edges[1:, 0] == edges[:-1, 1]).all()
    assert edges[0, 0] == layout.body.left
    assert edges[-1, 1] <= layout.body.right
    assert (edges[:, 1] > edges[:, 0]).all()
    assert layout.rows >= 20


def test_the_picture_of_rows_is_the_same_however_one_got_there(at: TasDriver, tmp_path: Path) -> None:
    """Rows that are kept while scrolling look as rows that are drawn at once."""
    roll, area = at.screen.roll, at.screen.theme.canvas.rect(*at.screen.roll.area)
    for tick in (30, 90, 70, 75, 200, 60):
        at.editor.go(tick)
        at.frames()
    scrolled = at.app.surface.subsurface(area).copy()
    roll._sheet = None
    at.app.stack.redraw_all()
    at.frames()
    assert pygame.image.tobytes(scrolled, "RGB") == pygame.image.tobytes(at.app.surface.subsurface(area), "RGB")


@pytest.mark.parametrize(
    "saved, now, marked",
    [
        ("112200", "1102200", [2]),
        ("112200", "0112200", [0]),
        ("112200", "1122001", [6]),
        ("1102200", "112200", []),
        ("112200", "110000", [2, 3]),
        ("112200", "2211220", [0, 1]),
    ],
)
def test_only_ticks_with_other_keys_are_marked_wherever_they_moved(saved: str, now: str, marked: list[int]) -> None:
    before, after = (InputTrack(bytes(map(int, keys))) for keys in (saved, now))
    assert [tick for tick, changed in enumerate(changed_ticks(after, before)) if changed] == marked
