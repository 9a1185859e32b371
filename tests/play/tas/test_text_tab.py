"""The run as text: in step with the roll, edited on either side, in two notations; markers stay."""

from itertools import pairwise

import pygame
import pytest

from ninja_game.formats.replay.notations import Marker
from ninja_game.player.settings import Settings
from ninja_game.sim.inputs import KEY_LEFT
from ninja_game.tas.files import inputs_of_text, open_run
from ninja_game.tas.tracks import InputTrack
from ninja_game.tas_editor.editor import USUAL_TABS, tas_layout
from ninja_game.tas_editor.tabs.text_tab import TextTab, starts_of, text_of
from tests.support.tas_driver import TasDriver

RUN = InputTrack(bytes([2] * 5 + [14, 6, 6] + [0] * 4), (Marker(2, "hop"), Marker(8, "land")))


@pytest.fixture(name="tab")
def text_tab(at: TasDriver) -> TextTab:
    at.session.change(RUN)
    at.choose("Text")
    tab = at.screen.tab
    assert isinstance(tab, TextTab)
    return tab


def typed(at: TasDriver, tab: TextTab, text: str) -> None:
    """Click into the field, type over what is there, press Enter."""
    x, y, _, h = tab.field.area
    at.mouse(x + 30, y + h / 2)
    tab.field.edited.select_all()
    at.write(text)
    at.press("return")
    at.frames()


def texts(tab: TextTab) -> list[str]:
    return [tab.text(index) for index in range(tab.list.count)]


def test_text_follows_the_roll(at: TasDriver, tab: TextTab) -> None:
    assert texts(tab) == ["R*2", "#hop R*3", "RJ*3", "#land .*4", ""]
    at.editor.edit(lambda track: track.with_key(3, 4, KEY_LEFT, down=True))
    at.editor.go(3)
    at.frames()
    assert texts(tab) == ["R*2", "#hop R*1", "LR*1", "R*1", "RJ*3", "#land .*4", ""]
    assert tab.field.text == "LR*1"
    at.session.undo()
    at.frames()
    assert texts(tab)[1] == "#hop R*3"


def test_the_other_notation(at: TasDriver, tab: TextTab) -> None:
    at.choose("R*30")
    at.frames()
    assert texts(tab) == ["2,R", "#hop 3,R", "3,R,J", "#land 4", ""]


@pytest.mark.parametrize(
    "text, inputs",
    [
        ("#hop R*4", "R*2|#hop R*4 RJ*3|#land .*4"),
        ("#hop 4,R", "R*2|#hop R*4 RJ*3|#land .*4"),
        ("L*2 J", "R*2|#hop L*2 J RJ*3|#land .*4"),
        ("# wait, it's early!", 'R*2|#"wait, it\'s early!" R*3 RJ*3|#land .*4'),
        ('#"one more" L*2 #two J', 'R*2|#"one more" L*2|#two J RJ*3|#land .*4'),
        ("#", "R*5 RJ*3|#land .*4"),
        ("#hop R*1 turn #3", "refused"),
        ("#one R #two L", "R*2|#one R|#two L RJ*3|#land .*4"),
        ("", "R*2 RJ*3|#land .*4"),
        ("(R L)*2", "R*2|#hop R L R L RJ*3|#land .*4"),
    ],
)
def test_the_roll_follows_what_is_typed(text: str, inputs: str, at: TasDriver, tab: TextTab) -> None:
    at.editor.go(3)
    at.frames()
    typed(at, tab, text)
    if inputs == "refused":
        assert at.editor.track == RUN
        assert tab.field.text == text, "it can be mended"
        return
    found = inputs_of_text(inputs.replace("|", "\n"), "test")
    assert at.editor.track == InputTrack(found.keys, found.markers)
    assert at.editor.cursor == len(found.keys) - 7, "the next line"
    at.editor.session.undo()
    assert at.editor.track == RUN


def test_a_comment_is_kept_through_edits_saving_and_loading(at: TasDriver, tab: TextTab) -> None:
    at.editor.go(3)
    at.frames()
    typed(at, tab, "# jump late (see 1-2); wait")
    comment = "jump late (see 1-2); wait"
    assert texts(tab)[1] == f'#"{comment}" R*3'
    at.editor.edit(lambda track: track.replaced(0, 0, bytes(3)))
    assert Marker(5, comment) in at.editor.track.markers
    at.press("escape")
    at.chord("s", pygame.KMOD_LCTRL)
    assert at.session.file.path is not None
    again = open_run(at.session.file.path)
    assert Marker(5, comment) in again.track.markers
    assert again.file.path == at.session.file.path, "it loses nothing by saving"


def test_an_error_names_the_wrong_word(at: TasDriver, tab: TextTab) -> None:
    typed(at, tab, "R*3 L jr*2")
    assert at.app.notice.startswith("Not changed: word 3: not an input run; found 'jr*2'")
    typed(at, tab, "R*3 L")
    assert at.app.notice == "", "it is done now"
    typed(at, tab, "R*3 L jr*2")
    at.app.notify(at.app.notice)
    typed(at, tab, "R*3 L")
    assert at.app.notice, "news with the words of a refusal stays"


def test_a_name_of_several_words_ends_a_line(at: TasDriver, tab: TextTab) -> None:
    typed(at, tab, "R*2 . #over the edge")
    assert texts(tab)[:3] == ["R*2", '#"over the edge" .*1', "#hop R*3"]


@pytest.mark.parametrize("line", ["#turn L*5", "L*5 #turn", "5,L #turn"])
def test_a_marker_on_either_side_of_keys_names_their_first_tick(at: TasDriver, tab: TextTab, line: str) -> None:
    typed(at, tab, line)
    assert texts(tab)[:2] == ["#turn L*5", "#hop R*3"]


def test_a_comment_behind_a_marker_stays_with_it_as_written(at: TasDriver, tab: TextTab) -> None:
    typed(at, tab, "10,R,J #hop2 # test note, #2")
    assert texts(tab)[:2] == ['#"hop2 # test note, #2" RJ*10', "#hop R*3"]
    typed(at, tab, "5,R #two #three")
    assert "#three" in " ".join(texts(tab)), "two names are two"


def test_a_marker_between_keys_or_behind_named_ones_names_what_comes_next(at: TasDriver, tab: TextTab) -> None:
    typed(at, tab, "#one L*2 #two J")
    assert texts(tab)[:3] == ["#one L*2", "#two J*1", "#hop R*3"]
    at.editor.go(0)
    at.frames(2)
    typed(at, tab, "#one L*5 #next")
    assert texts(tab)[:2] == ["#one L*5", "#next J*1"], "those keys have a name"


def test_enter_and_arrows_lead_from_line_to_line_while_one_types(at: TasDriver, tab: TextTab) -> None:
    typed(at, tab, "R*4")
    assert tab.field.text == "#hop R*3"
    at.press("down")
    at.frames()
    assert tab.field.text == "RJ*3"
    at.write(" L")
    at.press("up")
    at.frames()
    assert (tab.field.text, texts(tab)[2:4]) == ("#hop R*3", ["RJ*3", "L*1"])
    at.editor.go(len(at.editor.track))
    at.frames()
    typed(at, tab, "L*5")
    typed(at, tab, "R*6")
    assert texts(tab)[-3:] == ["L*5", "R*6", ""]


def test_what_is_typed_line_after_line_stays_also_where_its_keys_are_those_that_follow(
    at: TasDriver, tab: TextTab
) -> None:
    at.session.change(InputTrack(bytes([0] * 6 + [2] * 8)))
    at.editor.go(0)
    at.frames()
    typed(at, tab, ".*6 R*3")
    assert tab.field.text == "R*8", "not those just typed"
    typed(at, tab, "RJ*4")
    assert texts(tab) == [".*6", "R*3", "RJ*4", ""]
    at.editor.go(0)
    at.frames()
    typed(at, tab, ".*6 R*3")
    at.press("up")
    at.frames()
    at.editor.go(9)
    at.frames()
    assert texts(tab)[1:3] == ["R*6", "RJ*4"], "elsewhere equal keys are one line"


def test_lines_that_come_faster_than_pictures_are_all_put_in(at: TasDriver, tab: TextTab) -> None:
    at.editor.go(0)
    at.frames()
    for line in ("L*2", "J*3"):
        tab.field.edited.select_all()
        tab.field.edited.put(line)
        tab.put()
    assert at.editor.track.inputs[:5] == bytes([1, 1, 12, 4, 4])


def test_lines_are_added_at_the_end(at: TasDriver, tab: TextTab) -> None:
    at.editor.go(len(RUN))
    at.frames()
    assert tab.field.text == ""
    typed(at, tab, "#far 5,L")
    assert texts(tab)[-3:] == ["#land .*4", "#far L*5", ""]


def test_the_line_of_the_cursor_stays_in_the_middle_third_but_under_the_mouse(at: TasDriver, tab: TextTab) -> None:
    at.session.change(InputTrack(bytes([2, 1] * 40)))
    lines, places = tab.list.visible_lines, []
    for tick in [*range(0, 60, 7), *range(60, 20, -7)]:
        at.editor.go(tick)
        at.frames()
        places.append(tab.list.index - tab.list.first)
    assert places[0] == 0, "nothing is above the first line"
    assert all(lines // 3 <= place <= 2 * (lines // 3) for place in places[1:]), places
    first = tab.list.first
    x, y, w, h = tab.list.row_area(first + lines - 1)
    at.mouse(x + w / 2, y + h / 2)
    at.frames()
    assert (tab.list.index, tab.list.first) == (first + lines - 1, first), "a click does not scroll"
    at.mouse(x + w / 2, y + h / 2)
    at.frames()
    at.editor.go(40)
    at.frames()
    assert tab.list.index - tab.list.first <= 2 * (lines // 3), "a click on the cursor's line is over with its picture"


def test_a_taller_window_shows_more_lines() -> None:
    heights = [tas_layout(size, Settings()).tabs[3] for size in ((792, 600), (1433, 806), (1651, 929))]
    assert heights == [pytest.approx(USUAL_TABS), pytest.approx(731 / 3, abs=1), pytest.approx(854 / 3, abs=1)]


def test_a_click_selects_the_ticks_of_a_line(at: TasDriver, tab: TextTab) -> None:
    x, y, _, h = tab.list.row_area(2)
    at.mouse(x + 60, y + h / 2)
    assert at.editor.selection == (5, 8)


def test_lines_up_to_a_click_with_shift_are_typed_over_and_deleted(
    at: TasDriver, tab: TextTab, monkeypatch: pytest.MonkeyPatch
) -> None:
    def click(index: int, mods: int = 0) -> None:
        monkeypatch.setattr(pygame.key, "get_mods", lambda: mods)
        x, y, _, h = tab.list.row_area(index)
        at.mouse(x + 60, y + h / 2)
        monkeypatch.undo()
        at.frames(2)

    for first, second in ((1, 2), (2, 1)):
        click(first)
        click(second, pygame.KMOD_LSHIFT)
        assert (at.editor.selection, tab.field.text) == ((2, 8), "#hop R*3 RJ*3")
    click(3, pygame.KMOD_LSHIFT)
    assert at.editor.selection == (5, 12), "from where it began"
    click(1, pygame.KMOD_LSHIFT)
    typed(at, tab, "L*4")
    assert texts(tab) == ["R*2", "#hop L*4", "#land .*4", ""]
    assert at.editor.cursor == 6, "the next line"
    at.press("escape")
    click(0)
    click(1, pygame.KMOD_LSHIFT)
    x, y, _, h = tab.field.area
    at.mouse(x + 30, y + h / 2)
    tab.field.edited.select_all()
    at.press("delete")
    at.press("return")
    assert texts(tab) == ["#land .*4", ""]


def test_what_was_refused_is_gone_after_escape(at: TasDriver, tab: TextTab) -> None:
    typed(at, tab, "30,L,X")
    assert tab.field.text == "30,L,X"
    at.press("escape")
    at.frames(2)
    assert tab.field.text == "R*2"


def test_a_jump_that_no_keyboard_makes_is_in_our_notation() -> None:
    odd = InputTrack(bytes([8, 4, 12, 14, 6, 2]))
    starts = starts_of(odd).tolist()
    lines = [text_of(odd, first, last, celeste=True) for first, last in pairwise(starts)]
    assert lines == [".!*1", "J-*1", "J!*1", "RJ!*1", "1,R,J", "1,R"]


def test_lines_between_markers_are_folded_but_those_about_the_cursor(at: TasDriver, tab: TextTab) -> None:
    at.editor.go(6)
    at.frames()
    at.choose("Fold")
    at.frames()
    assert texts(tab) == ["the start: 2 ticks", "#hop R*3", "RJ*3", "#land: 4 ticks", ""]
    assert tab.field.text == "RJ*3"
    x, y, _, h = tab.list.row_area(3)
    at.mouse(x + 60, y + h / 2)
    at.frames()
    assert at.editor.cursor == 8
    assert texts(tab) == ["the start: 2 ticks", "#hop: 6 ticks", "#land .*4", ""]
    typed(at, tab, "#land .*4 L*2")
    assert texts(tab)[-3:] == ["#land .*4", "L*2", ""]
    at.choose("Unfold")
    at.frames()
    assert texts(tab) == ["R*2", "#hop R*3", "RJ*3", "#land .*4", "L*2", ""]
