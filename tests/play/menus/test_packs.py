"""Packs and medals on the screens: the grid shows the pack that is chosen, cards show pars and what was reached."""

import shutil
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest

from ninja_game.editor.packs import same_pack
from ninja_game.errors import NinjaGameError
from ninja_game.files.user_folder import LEVELS
from ninja_game.formats.pack.pack import Pack, is_pack
from ninja_game.formats.run_time import seconds_text
from ninja_game.generator.daily import daily_file
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.main import first_screen
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.menus.browser import Browser, LevelChoice
from ninja_game.play.menus.episodes import NAMED_CELL, Cells, EpisodeGrid
from ninja_game.play.menus.packs import PackScreen
from ninja_game.play.menus.problems import ProblemsScreen
from ninja_game.player.progress import Mark, next_par, result_sentence
from tests.support.draw_log import drawn
from tests.support.menu_driver import MenuDriver
from tests.support.own_pack import PACK


def other_pack(folder: Path, numbers: tuple[int, ...] = (2, 17)) -> Path:
    """The tests' pack by another name, with its first episode in other places."""
    shutil.copytree(PACK, folder)
    episodes = "".join(f'[[episode]]\nnumber = {n}\nlevels = ["00-0-run-and-hop.txt"]\n' for n in numbers)
    (folder / "pack.toml").write_text(f'name = "Other"\ncolumns = ["Left", "Right"]\n{episodes}')
    return folder


def test_a_zip_that_is_only_played_can_be_kept(driver: MenuDriver, tmp_path: Path) -> None:
    zipped = tmp_path / "washing.zip"
    zipped.write_bytes(Pack(PACK).files.zipped())
    for _ in range(2):
        driver.app.push(first_screen(str(zipped), None, body="circle", practice=False)(driver.app))
        driver.frames()
        assert "Keep it" in drawn(driver.app)
        driver.choose("Keep it")
        driver.frames(2)
        driver.choose("Play it")
        grid = driver.shown(EpisodeGrid)
        kept = driver.player.folder / LEVELS / "test-pack"
        assert (grid.pack.path, grid.pack.received) == (kept, True)
        assert "Keep it" not in drawn(driver.app)
        driver.press("escape", "escape", "escape")
        driver.shown(MainMenu)
    assert [path.name for path in kept.parent.iterdir()] == ["test-pack"], "it was there already"
    assert same_pack(Pack(kept), Pack(zipped))
    driver.app.push(first_screen(str(PACK), None, body="circle", practice=False)(driver.app))
    assert "Keep it" not in drawn(driver.app), "a folder is somebody's own"


def test_a_zip_that_is_dropped_on_the_first_screen_is_received(driver: MenuDriver, tmp_path: Path) -> None:
    zipped = tmp_path / "washing.zip"
    zipped.write_bytes(Pack(PACK).files.zipped())
    driver.drop_file(zipped)
    assert driver.shown(PackScreen).is_received
    assert "text 'test pack' at" in drawn(driver.app)
    driver.press("escape")
    driver.shown(Browser)


def test_pack_in_the_folder_can_be_chosen_and_played(driver: MenuDriver) -> None:
    other_pack(driver.player.folder / "levels" / "other")
    grid = driver.opened("Episodes", EpisodeGrid)
    assert [pack.key for pack in grid.packs] == ["", "Other"]
    driver.press("up", "right")
    assert grid.pack.key == "Other"
    assert grid.grid.heads == [0, 1]
    assert grid.number == 2, "the first episode that there is, though it is not the first of its column"
    driver.frames(3)
    assert "'Left'" in drawn(driver.app)
    driver.press("down", "return")
    level = driver.shown(LevelScreen)
    assert "Pass it for bronze" not in drawn(driver.app), "medals are for who has passed it once"
    level.begin()
    level.retry()
    level.begin()
    driver.play_replay(1)
    driver.press("space", "escape")
    assert driver.player.progress_in("Other").is_beaten(2)
    assert not driver.player.progress.is_beaten(0)
    assert grid.pack.key == "Other"


def test_pack_that_goes_while_it_is_shown_makes_room_for_ours(driver: MenuDriver) -> None:
    folder = other_pack(driver.player.folder / "levels" / "other")
    grid = driver.opened("Episodes", EpisodeGrid)
    driver.press("up", "right")
    shutil.rmtree(folder)
    grid.enter()
    assert grid.pack.key == ""
    driver.frames(2)


@pytest.mark.parametrize("zipped", [False, True])
def test_pack_named_on_the_command_line_begins_at_its_grid(driver: MenuDriver, tmp_path: Path, *, zipped: bool) -> None:
    path = other_pack(tmp_path / "elsewhere" / "other")
    if zipped:
        path = Path(shutil.make_archive(str(tmp_path / "other"), "zip", path))
    assert is_pack(path)
    grid = first_screen(str(path), None, body="circle", practice=False)(driver.app)
    driver.app.push(grid)
    driver.frames(3)
    assert isinstance(grid, EpisodeGrid)
    assert grid.pack.name == "Other"
    driver.press("escape")
    assert isinstance(driver.top(), MainMenu)


def test_our_own_pack_named_on_the_command_line_is_ours(driver: MenuDriver) -> None:
    grid = first_screen(str(PACK), None, body="circle", practice=False)(driver.app)
    assert isinstance(grid, EpisodeGrid)
    assert grid.pack.key == ""


def test_pack_without_episodes_is_refused_before_a_window_opens(tmp_path: Path) -> None:
    (tmp_path / "pack.toml").write_text('name = "Empty"')
    with pytest.raises(NinjaGameError, match="no episodes in this pack"):
        first_screen(str(tmp_path), None, body="circle", practice=False)


def test_zip_dropped_on_the_list_of_levels_is_received_as_a_pack(driver: MenuDriver, tmp_path: Path) -> None:
    path = other_pack(tmp_path / "elsewhere")
    zipped = shutil.make_archive(str(tmp_path / "dropped"), "zip", path)
    browser = driver.opened("Levels", Browser)
    driver.drop_file(Path(zipped))
    assert [(pack.name, pack.received) for pack in driver.shown(PackScreen).own_packs] == [("Other", True)]
    driver.press("escape")
    assert browser.message == ""
    assert {entry.source for entry in browser.entries} == {"game", "Other"}


def test_browser_sorts_by_difficulty(driver: MenuDriver) -> None:
    browser = driver.opened("Levels", Browser)
    browser.sort_by("difficulty")
    hard = [entry.pars.difficulty for entry in browser.shown if entry.pars and entry.pars.difficulty is not None]
    assert len(hard) == 8
    assert hard == sorted(hard)
    driver.frames(2)
    assert "easy" in drawn(driver.app)
    assert "difficulty" not in drawn(driver.app)


def test_a_pack_says_who_made_it_and_where_more_come_from(driver: MenuDriver) -> None:
    index = other_pack(driver.player.folder / "levels" / "other", tuple(range(7))) / "pack.toml"
    index.write_text('author = "Ida"\ncomment = "Small rooms, one idea each."\n' + index.read_text("utf-8"), "utf-8")
    driver.open("Episodes")
    assert "Ida" not in drawn(driver.app)
    driver.press("up", "right")
    assert "'Other by Ida. Small rooms, one idea each.'" in drawn(driver.app)
    assert "Open a pack takes in more" in drawn(driver.app)
    assert "levels passed by" not in drawn(driver.app)
    driver.app.change_settings(name="Bob")
    assert "levels passed by Bob" in drawn(driver.app), "it says whose records these are"


def test_levels_of_days_are_not_counted_among_those_of_the_game(driver: MenuDriver) -> None:
    browser = driver.opened("Levels", Browser)
    count = f"{len(browser.entries)} of {len(browser.entries)} levels"
    assert count in drawn(driver.app)
    driver.press("escape")
    shutil.copytree(PACK, daily_file(driver.player.folder / LEVELS, date(2026, 11, 27)).parent)
    browser = driver.opened("Levels", Browser)
    assert f"{len(browser.entries)} levels" not in drawn(driver.app)
    assert count in drawn(driver.app)


def test_card_says_time_and_gold_and_the_next_par(driver: MenuDriver) -> None:
    entry = driver.player.catalogue.episodes[0].levels[0]
    assert entry.pars is not None
    assert driver.player.reached(entry, None) == "Not passed yet"
    assert result_sentence(entry, Mark(197, 3)) == f"Time 4.925 s, gold 3 of {entry.all_gold}"
    bare = replace(entry, named=replace(entry.named, level=replace(entry.named.level, objects=())))
    assert result_sentence(bare, Mark(197, 0)) == "Time 4.925 s"
    assert next_par(entry.pars, Mark(200, 0)) == f"Gold medal: {seconds_text(196)} s, 0.100 s to go"
    author = entry.pars.par("author")
    following = next_par(entry.pars, Mark(author + 4, 0))
    assert following == f"Author medal: {seconds_text(author)} s, 0.100 s to go"
    assert next_par(entry.pars, Mark(156, 0)) == ""


@pytest.mark.parametrize("numbers", [range(100), range(10), (5, 55), [10 * c + r for c in range(5) for r in range(4)]])
def test_grids_of_every_size_keep_inside_their_place(numbers: list[int]) -> None:
    cells = Cells((0, 0, 1, 1), 10, lambda *_: None, lambda _: None)
    cells.arrange(numbers)
    _, _, w, h = cells.area
    assert w <= 330
    assert h <= 287
    assert sorted(number for number in cells.numbers if number >= 0) == sorted(numbers)
    assert cells.numbers[cells.index] >= 0
    assert (cells.cell_height >= NAMED_CELL) == (len(numbers) == 20), "names stand where there is room"


def test_all_problems_of_files_are_shown_whole(driver: MenuDriver) -> None:
    for name in ("broken", "worse"):
        (driver.player.folder / "levels" / f"{name}.txt").write_text("ninja-game level 1\nnonsense")
    (driver.player.folder / "levels" / "torn").mkdir()
    (driver.player.folder / "levels" / "torn" / "pack.toml").write_text("name = My pack")
    driver.open("Levels")
    driver.choose("3 problems: show them")
    text = drawn(driver.app)
    for place in ("broken.txt:2:1: not a header line", "worse.txt:2:1:", "torn/pack.toml:1:8: no TOML"):
        assert place in text
    assert str(driver.player.folder) not in text
    driver.press("down", "down")
    assert "Mend the file as the message says" in drawn(driver.app)
    driver.press("escape", "escape")
    driver.open("Episodes")
    driver.choose("1 problem: show it")
    driver.shown(ProblemsScreen)


def test_what_is_typed_is_searched_for_without_a_click_on_the_field(driver: MenuDriver) -> None:
    browser = driver.opened("Levels", Browser)
    driver.press("down")
    driver.type("stone")
    assert [entry.title for entry in browser.shown] == ["Stone to Stone"]


def test_nothing_can_be_done_with_no_level(driver: MenuDriver) -> None:
    browser = driver.opened("Levels", Browser)
    live = [browser.play_button, browser.practice, browser.change, browser.link]
    assert all(button.enabled for button in live)
    driver.type("zzz")
    assert "No level matches" in drawn(driver.app)
    assert not any(button.enabled for button in (*live, browser.watch_best, browser.watch_author))
    assert {button.hint for button in live} == {"No level"}
    assert "Author's run:" not in drawn(driver.app)
    driver.press("backspace", "backspace", "backspace")
    assert all(button.enabled for button in live)
    driver.press("escape", "escape")
    driver.app.push(choice := LevelChoice(driver.app, lambda _: None))
    driver.type("zzz")
    assert not choice.change.enabled
