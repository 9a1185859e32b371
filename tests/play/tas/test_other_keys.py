"""The keys of another run beside those of the one on the TAS editor."""

from pathlib import Path

import pygame

from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.level_string import write_level_string
from ninja_game.play.menu_screen import Menu
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT, with_press_bits
from ninja_game.tas.tracks import InputTrack
from ninja_game.tas_editor.level.other_runs import OtherRunScreen
from ninja_game.tas_editor.roll.facts import compared_run, different_rows, row_facts
from tests.support.samples import running, write_records
from tests.support.tas_driver import TasDriver

OURS = InputTrack(with_press_bits([KEY_RIGHT] * 60))
THEIRS = InputTrack(with_press_bits([KEY_RIGHT] * 20 + [KEY_LEFT] * 5 + [KEY_RIGHT | JUMP_HELD] * 5 + [KEY_RIGHT] * 34))
SHIFT = pygame.KMOD_LSHIFT


def beside(at: TasDriver, *others: InputTrack) -> None:
    """Runs with few keys on the TAS editor and beside it."""
    at.editor.edit(lambda track: OURS)
    at.screen.level.others.open([at.session.recording(other, f"run {n}") for n, other in enumerate(others)])
    at.frames()


def differing(at: TasDriver) -> dict[int, int]:
    return {row.tick: row.differs for row in row_facts(at.editor, 0, 100) if row.differs}


def test_keys_that_only_one_run_has_are_marked(at: TasDriver) -> None:
    beside(at, THEIRS)
    turned, jumped = dict.fromkeys(range(20, 25), KEY_LEFT | KEY_RIGHT), dict.fromkeys(range(25, 30), JUMP_HELD)
    assert differing(at) == turned | jumped | dict.fromkeys(range(60, 64), KEY_RIGHT)
    at.event(pygame.MOUSEMOTION, *at.cell(22, "left"))
    assert at.editor.hint == "22: R; run 0: L"
    at.press("g")
    assert differing(at) == {}
    at.press("k")
    assert at.app.notice == "Other runs are not shown: G shows them"


def test_a_mark_stands_at_the_right_of_the_cell_in_the_colour_of_the_ghost(at: TasDriver) -> None:
    beside(at, THEIRS)
    at.editor.go(40)
    at.frames()
    other = compared_run(at.editor)
    assert other is not None
    place = next(each for each in at.screen.roll.layout.places if each.column.name == "left")
    right = place.left + place.width - 1

    def colour(tick: int) -> pygame.Color:
        return at.app.surface.get_at((right, at.app.canvas.point(*at.cell(tick, "left"))[1]))

    assert colour(22) == other.colour(at.app.theme.palette)
    assert colour(26) != colour(22)


def test_a_key_goes_from_difference_to_difference(at: TasDriver) -> None:
    beside(at, THEIRS)
    places = []
    for _ in range(4):
        at.press("k")
        places.append(at.editor.cursor)
    assert places == [20, 25, 60, 60]
    assert at.app.notice == "There are no more ticks with other keys than run 0"
    for _ in range(3):
        at.chord("k", SHIFT)
    assert at.editor.cursor == 20
    at.chord("k", SHIFT)
    assert at.app.notice == "There are no earlier ticks with other keys than run 0"


def test_the_chosen_run_is_compared_else_the_run_before_the_edit(at: TasDriver) -> None:
    at.editor.edit(lambda track: OURS)
    at.editor.edit(lambda track: track.with_key(7, 9, JUMP_HELD, down=True))
    assert differing(at) == {7: JUMP_HELD, 8: JUMP_HELD}
    at.chord("z", pygame.KMOD_LCTRL)
    assert differing(at) == {7: JUMP_HELD, 8: JUMP_HELD}
    beside(at, THEIRS, OURS)
    assert 22 in differing(at), "the first one is chosen"
    at.press("o")
    assert differing(at) == {}
    assert at.app.notice == "Compared, and parts are taken from: run 1"
    at.press("k")
    assert at.app.notice == "There are no ticks with other keys than run 1"


def test_the_bar_shows_where_keys_differ() -> None:
    assert different_rows(OURS.inputs, THEIRS.inputs, 100, 10) == [2, 6]
    assert different_rows(OURS.inputs, OURS.inputs, 100, 10) == []
    assert different_rows(b"", b"", 40, 10) == []


def test_undo_selects_again_what_a_key_has_changed(at: TasDriver) -> None:
    at.editor.edit(lambda track: OURS)
    at.editor.select(30, 35)
    at.press("insert")
    assert at.editor.selection == (30, 35)
    at.editor.go(33)
    at.app.notify("something")
    at.chord("z", pygame.KMOD_LCTRL)
    assert (at.editor.selection, at.editor.track.inputs) == ((30, 35), OURS.inputs)
    assert at.app.notice == "Undone: keys from tick 30 on, 5 ticks fewer", "the notice before it is gone"
    at.press("backspace")
    assert (at.editor.selection, len(at.editor.track)) == ((30, 31), 55)
    at.chord("z", pygame.KMOD_LCTRL)
    assert at.editor.selection == (30, 35)
    at.screen.level.others.open([at.session.recording(THEIRS, "theirs")])
    at.editor.select(20, 30)
    at.chord("p", pygame.KMOD_LCTRL)
    at.editor.go(3)
    at.chord("z", pygame.KMOD_LCTRL)
    assert at.editor.selection == (20, 30)


def test_runs_of_one_file_of_n_are_told_apart(at: TasDriver, tmp_path: Path) -> None:
    """The author in a record of N is that of its level."""
    level, ticks = at.session.origin.level, (30, 10, 20)
    text = write_level_string(level, exact=True)
    records = [(f"a level {count}", text, running(count)) for count in ticks]
    file = write_records(tmp_path / "many.txt", *records)
    at.screen.level.others.open(load_replays(file))
    assert [other.name for other in at.editor.others] == ["many.txt", "many.txt 1", "many.txt 2"]
    at.chord("o", pygame.KMOD_LCTRL)
    screen = at.shown(OtherRunScreen)
    rows = [row for row in screen.rows if row.text.startswith("many.txt")]
    assert [(row.text, row.player) for row in rows] == [
        ("many.txt 1   test", ""), ("many.txt 2   test", ""), ("many.txt   test", "")
    ]  # fmt: skip
    assert [row for row in screen.rows if not row.good][:3] == rows, "the fastest first, after those with an exit"


def test_a_press_that_opens_a_dialog_holds_nothing(at: TasDriver) -> None:
    cursor = at.editor.cursor
    x, _ = at.cell(5, "x")
    heads = at.screen.theme.canvas.logical((0, at.screen.roll.layout.heads.centery))
    at.event(pygame.MOUSEBUTTONDOWN, x, heads[1], button=1)
    assert isinstance(at.top(), Menu)
    at.event(pygame.MOUSEBUTTONUP, x, heads[1], button=1)
    at.choose_in_menu("Branches")
    assert (at.editor.tab, at.editor.cursor) == ("Branches", cursor)
