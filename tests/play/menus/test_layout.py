"""Nothing spills out of its panel, lies over its neighbour, or promises what is not there."""

from itertools import combinations

import pytest

from ninja_game.play.main_menu import PANEL, MainMenu
from ninja_game.play.menu_screen import FormPanel, MenuScreen
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.episodes import Cells, EpisodeGrid
from ninja_game.play.panels.replays import RecordsScreen, ReplaysScreen
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import HEIGHT, WIDTH
from ninja_game.ui.list_view import ListView
from ninja_game.ui.theme import TEXT_SIZES, Area
from ninja_game.ui.widgets import Slider, Widget
from tests.support.layout import Layout, noted
from tests.support.menu_driver import MenuDriver
from tests.support.own_pack import PACK


def lies_in(inner: Area, outer: Area) -> bool:
    return (
        inner[0] >= outer[0]
        and inner[1] >= outer[1]
        and inner[0] + inner[2] <= outer[0] + outer[2]
        and inner[1] + inner[3] <= outer[1] + outer[3]
    )


def overlap(a: Widget, b: Widget) -> bool:
    (ax, ay, aw, ah), (bx, by, bw, bh) = a.area, b.area
    return ax < bx + bw and bx < ax + aw and ay < by + bh and by < ay + ah


@pytest.mark.parametrize("entry", ["Episodes", "Levels", "Records", "Replays", "Settings", "Help", "Quit"])
def test_widgets_lie_in_the_stage_and_not_over_each_other(driver: MenuDriver, entry: str) -> None:
    screen = driver.open(entry)
    assert isinstance(screen, MenuScreen)
    able = [widget for widget in screen.widgets if widget.focusable]
    assert able
    for widget in able:
        assert lies_in(widget.area, (24, 52, WIDTH - 48, HEIGHT - 88))
    assert not any(overlap(a, b) for a, b in combinations(able, 2))


def test_panel_of_the_main_menu_holds_its_entries(driver: MenuDriver) -> None:
    menu = driver.shown(MainMenu)
    assert lies_in(PANEL, (0, 0, WIDTH, HEIGHT - 24))
    assert len(menu.widgets) == len(menu.entries())
    for widget in menu.widgets:
        assert lies_in(widget.area, PANEL)
        assert widget.area[3] >= 18
    assert not any(overlap(a, b) for a, b in combinations(menu.widgets, 2))


def test_grid_shows_only_the_episodes_that_there_are(driver: MenuDriver) -> None:
    grid = driver.opened("Episodes", EpisodeGrid)
    episodes = driver.player.catalogue.episodes
    assert sorted(number for number in grid.grid.numbers if number >= 0) == sorted(episodes)
    for _ in range(3 * len(grid.grid.numbers)):
        driver.press("down")
        assert grid.episode is not None


def test_grid_with_gaps_never_selects_a_gap() -> None:
    cells = Cells((0, 0, 1, 1), 10, lambda *_: None, lambda _: None)
    cells.arrange([0, 1, 2, 10, 30, 31])
    assert cells.columns == 3
    assert cells.numbers == [0, 10, 30, 1, -1, 31, 2, -1, -1]
    assert cells.nudge("right")
    assert not cells.nudge("down")
    assert cells.numbers[cells.index] == 10
    assert not cells.click(*(value + 1 for value in cells.row_area(4)[:2]))
    assert cells.numbers[cells.index] == 10


@pytest.mark.parametrize(
    "key, index, goal",
    [
        ("first", 4, 0), ("last", 4, 9), ("up", 4, 3), ("down", 4, 5), ("page_up", 4, 1), ("page_down", 4, 7),
        ("page_up", 1, 0), ("page_down", 8, 9), ("up", 0, None), ("down", 9, None), ("left", 4, None),
    ],
)  # fmt: skip
def test_keys_select_in_a_list_or_move_the_focus_on(key: str, index: int, goal: int | None) -> None:
    rows = ListView((0, 0, 100, 60), 20, lambda *_: None, lambda _: None)
    rows.fill(range(10))
    rows.select(index)
    assert (rows.nudge(key), rows.index) == (goal is not None, index if goal is None else goal)


@pytest.mark.parametrize(
    "key, value, goal",
    [("left", 5, 0), ("left", 0, None), ("right", 0, 5), ("right", 18, 20), ("right", 20, 20), ("up", 5, None)],
)
def test_keys_step_a_number_or_move_the_focus_on(key: str, value: float, goal: float | None) -> None:
    put: list[float] = []
    slider = Slider((0, 0, 100, 20), "Number", (0, 20, 5), lambda: value, put.append)
    assert (slider.nudge(key), put) == (goal is not None, [] if goal is None else [goal])


def test_a_screen_is_drawn_again_when_another_widget_has_the_focus(driver: MenuDriver) -> None:
    browser = driver.opened("Levels", Browser)
    driver.frames(2)
    assert not browser.redraw
    browser.focus_on(browser.practice)
    assert browser.redraw


def test_only_what_was_passed_can_be_watched(driver: MenuDriver) -> None:
    records = driver.opened("Records", RecordsScreen)
    assert records.list.hint == "Not yet passed in one go"
    driver.press("return")
    assert isinstance(driver.top(), RecordsScreen)
    driver.press("escape")
    browser = driver.opened("Levels", Browser)
    assert browser.watch_best.enabled is False
    level = driver.open_level()
    level.begin()
    driver.play_replay(1)
    driver.press("q")
    enabled: bool = browser.watch_best.enabled
    assert enabled
    driver.press("escape")
    again = driver.opened("Records", RecordsScreen)
    driver.press("down")
    assert again.list.hint == "Enter to watch, E to save as a text file"


def test_file_that_cannot_be_read_is_named(driver: MenuDriver) -> None:
    (driver.player.folder / "levels" / "broken.txt").write_text("ninja-game level 1\nnonsense")
    (driver.player.replay_folder / "torn.replay.txt").write_text("ninja-game replay 1\nnonsense")
    browser = driver.opened("Levels", Browser)
    assert "broken.txt" in browser.problems[0].text
    driver.press("escape")
    replays = driver.opened("Replays", ReplaysScreen)
    assert replays.problems == ["torn.replay.txt"]


@pytest.mark.parametrize("name", ["x" * 8000, "nul \x00 here", "日本語 with ascii", "\u202e turned \x1b[31m"])
def test_any_name_of_a_level_is_shown(driver: MenuDriver, name: str) -> None:
    text = (PACK / "00-0-run-and-hop.txt").read_text("utf-8")
    named = text.replace("name: Run and Hop", f"name: {name}", 1)
    assert named != text
    (driver.player.folder / "levels" / "odd.txt").write_text(named, "utf-8")
    browser = driver.opened("Levels", Browser)
    driver.press("end")
    driver.frames(3)
    driver.press("return")
    driver.frames(3)
    assert driver.app.running
    assert Simulation(browser.shown[0].named.level)


def test_a_click_below_the_last_whole_line_chooses_nothing(driver: MenuDriver) -> None:
    chosen: list[int] = []
    rows = ListView((0, 0, 100, 84), 19, lambda *_: None, chosen.append)
    rows.fill(range(9))
    assert rows.click(10, 70)
    assert not rows.click(10, 80)
    assert chosen == [3]
    rows.fill(range(rows.visible_lines))
    assert not rows.drag(99, 40), "no bar"


def test_all_of_a_cell_is_clicked_and_only_a_drag_at_the_bar_scrolls() -> None:
    cells = ListView((0, 0, 700, 60), 20, lambda *_: None, list[int]().append)
    cells.columns = 6
    cells.fill(range(30))
    x, _, width, _ = cells.row_area(4)
    for place in (x + 0.1, x + width - 0.1):
        cells.click(300, 30)
        assert cells.click(place, 10)
        assert cells.index == 4
    assert not cells.drag(300, 60)
    assert cells.drag(699, 60)
    assert cells.first == 2


def test_a_second_click_counts_while_more_rows_come_and_not_where_another_row_is() -> None:
    one, other, chosen = object(), object(), list[int]()
    shown = ListView((0, 0, 100, 80), 20, lambda *_: None, chosen.append, opens=True)
    shown.fill([one])
    shown.click(10, 10)
    shown.fill([one, other])
    shown.click(10, 10)
    assert chosen == [0]
    shown.fill([other])
    shown.click(10, 10)
    assert chosen == [0], "only selected"


@pytest.mark.parametrize("percent", TEXT_SIZES.values())
def test_a_filled_field_of_a_form_still_says_what_it_is(driver: MenuDriver, percent: int) -> None:
    driver.app.change_settings(text_size=percent)
    fields = [("Name", "Laundry", 40), ("What it teaches", "To fold", 40), ("Version", "1", 40)]
    driver.app.push(FormPanel(driver.app, "What players see", fields, "OK", print))
    driver.frames(2)
    with noted() as layouts:
        layouts.append(Layout())
        driver.app.lay_out()
        driver.app.draw()
        layout = layouts.pop()
    assert not list(layout.problems(driver.app))
    assert {prompt for prompt, _, _ in fields} <= {each.text for each in layout.texts}
    form = driver.shown(FormPanel)
    driver.mouse(*form.widgets[-1].centre)
    assert form.focus is form.widgets[0], "a label is nothing to choose"
    assert not any(overlap(a, b) for a, b in combinations(form.widgets, 2))
    driver.fill("Dry", "OK")
