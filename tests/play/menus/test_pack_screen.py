"""The player's packs in the window: with mouse, keys and pad levels are moved, packs made, made ready and mended."""

from __future__ import annotations

import json
import os
import re
import shutil
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from threading import Event, Thread, current_thread, main_thread
from unittest.mock import patch
from zipfile import ZipFile

import pygame
import pytest

from ninja_game.editor import packs, ready_pack
from ninja_game.editor.files import ascii_text
from ninja_game.editor.pack_steps import write_file
from ninja_game.editor.ready_pack import Obstacles, ReadyPack, Say
from ninja_game.files.user_folder import DAILY, short_path
from ninja_game.formats.links import write_link
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.replay.text import Replay
from ninja_game.levels.findings import PackFinding, level_finding, pack_finding
from ninja_game.play.editor.messages import MessagesScreen
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.menu_screen import BACK, FormPanel, MenuScreen
from ninja_game.play.menus import pack_menus, pack_sharing
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.episodes import EpisodeGrid
from ninja_game.play.menus.pack_card import PackCard
from ninja_game.play.menus.pack_list import PackList
from ninja_game.play.menus.pack_shelves import _GAP, PackCell, Rack
from ninja_game.play.menus.packer import Packer
from ninja_game.play.menus.packs import PackScreen
from ninja_game.play.menus.problems import Problem, ProblemsScreen
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.player.player_data import save_work
from ninja_game.runs.packs import lint
from ninja_game.search.certificate import verified_run
from ninja_game.search.task import Task
from ninja_game.sim.inputs import with_press_bits
from ninja_game.sim.level import Level
from ninja_game.ui.input.gamepad import BUTTONS
from ninja_game.ui.theme import Area
from tests.support.draw_log import drawn, px
from tests.support.level_maker import ROOM
from tests.support.menu_driver import MenuDriver
from tests.support.own_pack import PACK
from tests.support.waiting import LONGEST


@pytest.fixture(name="path")
def pack_of_the_player(driver: MenuDriver) -> Path:
    path = driver.player.folder / "levels" / "laundry"
    shutil.copytree(PACK, path, ignore=shutil.ignore_patterns("gallery", "README.md"))
    index = path / "pack.toml"
    index.write_text(index.read_text("utf-8").replace("test pack", "Laundry"), "utf-8")
    return path


@pytest.fixture(name="screen")
def desk(driver: MenuDriver, request: pytest.FixtureRequest) -> PackScreen:
    """The desk; with the player's pack, where a test asks for that too."""
    if "path" in request.fixturenames:
        request.getfixturevalue("path")
    return opened(driver)


@pytest.fixture
def own(path: Path, screen: PackScreen) -> Path:
    """A level of the player's folder, which the tray shows."""
    file = path.with_name("mine.txt")
    file.write_text((path / "00-0-first-steps.txt").read_text("utf-8").replace("First Steps", "Mine"), "utf-8")
    screen.choose_tray("yours")
    screen.app.draw()
    return file


def opened(driver: MenuDriver) -> PackScreen:
    driver.open("Levels")
    driver.choose("Packs")
    driver.frames(2)
    return driver.shown(PackScreen)


def problems_of(driver: MenuDriver, screen: PackScreen) -> Sequence[Problem]:
    """The problems of the shown pack, once they are known."""
    driver.wait(lambda: pack_sharing.problems(screen) is not None and screen.status.present, "the problems are known")
    return pack_sharing.problems(screen) or []


def problem_page(driver: MenuDriver) -> ProblemsScreen:
    """The page of problems on top, once they are known."""
    page = driver.shown(ProblemsScreen)
    driver.wait(lambda: not page._waited_ms, "the problems are known")
    return page


def layout(path: Path) -> dict[int, list[str]]:
    pack = Pack(path)
    return {each.number: [file[:4] for file in each.files(pack.files.levels)] for each in pack.index.episodes}


def typed(driver: MenuDriver, text: str) -> None:
    """Put a text into the form on top, and accept it."""
    driver.fill(text, "OK")


def titles(rack: Rack) -> list[str]:
    return [cell.level.title for cell in rack.cells if cell.level]


def pasted(driver: MenuDriver, link: str) -> None:
    with patch("pygame.scrap.get_text", lambda: link):
        driver.choose("Paste link")


def copied_links(driver: MenuDriver) -> list[str]:
    """The links that a click on the button puts into the clipboard."""
    links: list[str] = []
    with patch("pygame.scrap.put_text", links.append):
        driver.choose("Copy the link")
    return links


def half(screen: PackScreen, index: int, *, right: bool = False) -> Area:
    """A half of a cell on the shelves."""
    x, y, w, h = screen.shelves.row_area(index)
    return x + right * w / 2, y, w / 2, h


def test_a_level_lands_on_the_side_of_a_card_where_it_is_let_go(
    driver: MenuDriver, path: Path, screen: PackScreen
) -> None:
    shelves = screen.shelves
    driver.carry(shelves.row_area(1), half(screen, 5, right=True), drop=False)
    x, y, w, _ = shelves.row_area(5)
    assert screen._landing() == (5, True)
    assert "The colours of a level go by its place" in drawn(driver.app)
    seen, mark = drawn(driver.app), f"fill accent {px(x + w - 2, y + 4)} 4 x"
    assert seen.index(mark) > seen.index("First Steps' at 577,"), "not behind what is held"
    driver.mouse_up(half(screen, 5, right=True))
    assert layout(path)[0] == ["00-1", "00-2", "00-3", "00-4", "00-0"]
    driver.carry(shelves.row_area(5), half(screen, 2, right=True))
    assert layout(path)[0] == ["00-1", "00-2", "00-0", "00-3", "00-4"]
    for right in (False, True):
        driver.carry(shelves.row_area(3), half(screen, 3, right=right))
        driver.carry(shelves.row_area(3), half(screen, 2, right=True))
        assert layout(path)[0] == ["00-1", "00-2", "00-0", "00-3", "00-4"], "it stays where it was"
    driver.carry(shelves.row_area(3), half(screen, 11), drop=False)
    assert screen._landing() == (10, False)
    driver.mouse_up(half(screen, 11))
    assert layout(path)[1] == ["01-0", "01-1", "01-2", "00-0"]


def test_cards_make_room_where_a_level_would_land(driver: MenuDriver, path: Path, screen: PackScreen) -> None:
    shelves = screen.shelves

    def pictures() -> list[tuple[float, float]]:
        with patch.object(screen.thumbnails, "draw") as draw:
            drawn(driver.app)
        return sorted((each.args[3], each.args[2]) for each in draw.call_args_list)

    before = pictures()
    driver.carry(shelves.row_area(1), half(screen, 3, right=True), drop=False)
    [_, *now] = sorted(set(pictures()) - set(before), reverse=True)
    assert len(before) - len(set(before) & {*pictures()}) == 3, "what is held leaves its place, two make room"
    assert [x for _, x in now] == [x + _GAP for _, x in reversed(before[3:5])]
    driver.mouse_up((300, 530, 2, 2))
    assert pictures() == before


def let_go(driver: MenuDriver, area: Area, mods: int = 0) -> None:
    pygame.key.set_mods(mods)
    driver.mouse_up(area)
    pygame.key.set_mods(0)


def click(driver: MenuDriver, area: Area, mods: int = 0) -> None:
    x, y, w, h = area
    pygame.key.set_mods(mods)
    driver.mouse(x + w / 2, y + h / 2)
    let_go(driver, area, mods)


def test_several_levels_are_marked_and_moved_copied_taken_out_and_deleted_at_once(
    driver: MenuDriver, path: Path, screen: PackScreen
) -> None:
    shelves, steps = screen.shelves, screen.packer.steps
    place = shelves.row_area
    click(driver, place(1))
    click(driver, place(3), pygame.KMOD_CTRL)
    assert {Path(file).name[:4] for file in screen.marked} == {"00-0", "00-2"}, "with the one that was clicked before"
    driver.press("escape", "right")
    click(driver, place(5), pygame.KMOD_CTRL)
    assert {Path(file).name[:4] for file in screen.marked} == {"00-4"}, "without one that keys or the beginning chose"
    driver.press("escape")
    click(driver, place(1))
    click(driver, place(3), pygame.KMOD_CTRL)
    click(driver, place(3), pygame.KMOD_CTRL)
    click(driver, place(4), pygame.KMOD_CTRL)
    driver.carry(place(4), half(screen, 7, right=True), drop=False)
    assert "2 levels" in drawn(driver.app)
    driver.mouse_up(half(screen, 7, right=True))
    assert layout(path) == {0: ["00-1", "00-2", "00-4"], 1: ["01-0", "00-0", "00-3", "01-1", "01-2"]}
    assert [step.name for step in steps] == ["Move 2 levels"]
    driver.carry(place(8), half(screen, 1), drop=False)
    driver.mouse_up(half(screen, 1))
    assert layout(path)[0] == ["00-0", "00-3", "00-1", "00-2", "00-4"], "they stay marked"
    click(driver, place(3))
    assert not screen.marked
    screen.enter()
    click(driver, place(3))
    assert driver.shown(MenuScreen).title == "Mind the Gap", "a second click opens its menu, however late it comes"
    driver.choose("Cancel")
    click(driver, place(5), pygame.KMOD_SHIFT)
    driver.carry(place(4), half(screen, 7))
    assert layout(path)[0] == ["00-0", "00-3", "00-1", "00-2", "00-4"], "no room for three: all stay"
    assert "episode 2 is full" in driver.app.notice
    shelves.index = 3
    driver.press("return")
    assert driver.shown(MenuScreen).title == "3 levels"
    assert [each.text for each in driver.shown(MenuScreen).widgets] == ["Move...", "Copy", "Take out", "Cancel"]  # type: ignore[attr-defined]
    driver.choose("Take out")
    assert layout(path)[0] == ["00-0", "00-3"]
    screen.marked.clear()
    screen.focus = screen.tray
    driver.chord("a", pygame.KMOD_CTRL)
    assert len(screen.marked) == 3
    driver.press("delete")
    deleted = driver.player.folder / "deleted"
    assert len(list(deleted.glob("*.txt"))) == 3
    assert list((deleted / "certificates").iterdir())
    assert len(Pack(path).levels) == 5
    for _ in range(2):
        driver.chord("z", pygame.KMOD_CTRL)
    assert layout(path)[0] == ["00-0", "00-3", "00-1", "00-2", "00-4"]
    screen.focus, shelves.index = shelves, 3
    driver.press("delete")
    assert layout(path)[0] == ["00-0", "00-3", "00-2", "00-4"], "in an episode it is taken out"
    click(driver, place(1), pygame.KMOD_CTRL)
    driver.press("escape")
    assert (driver.top(), screen.marked) == (screen, set())


def test_a_level_is_a_calm_frame_above_its_name_until_its_picture_is_made(
    driver: MenuDriver, path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    frame = r"fill panel \S+ 81 x 61\.4 radius 0"
    with monkeypatch.context() as waiting:
        waiting.setattr("ninja_game.play.thumbnails.Thumbnails.work", lambda _: False)
        opened(driver)
        seen = drawn(driver.app)
        assert len(re.findall(frame, seen)) == 8
        assert "text 'First Steps'" in seen
    driver.wait(lambda: not re.search(frame, drawn(driver.app)))


def test_levels_and_episodes_are_dragged(driver: MenuDriver, path: Path, screen: PackScreen) -> None:
    shelves = screen.shelves
    driver.carry(shelves.row_area(2), half(screen, 8))
    assert layout(path) == {0: ["00-0", "00-2", "00-3", "00-4"], 1: ["01-0", "00-1", "01-1", "01-2"]}
    assert (
        driver.app.notice == "Moved Mind the Gap to episode 2; colours follow the place. Undo, or Ctrl+Z, takes it back"
    )
    driver.carry(shelves.row_area(1), screen.tray.area)
    assert layout(path)[0] == ["00-2", "00-3", "00-4"]
    assert titles(screen.tray) == ["First Steps"]
    assert (
        driver.app.notice
        == "Moved First Steps out of its episode; colours follow the place. Undo, or Ctrl+Z, takes it back"
    )
    driver.carry(screen.tray.row_area(0), shelves.row_area(13))
    assert layout(path)[2] == ["00-0"], "a row below the others is a new episode"
    assert [each.name for each in Pack(path).index.episodes][2] == "Episode 3"
    driver.carry(shelves.row_area(12), shelves.row_area(0))
    assert layout(path) == {0: ["00-0"], 1: ["00-2", "00-3", "00-4"], 2: ["01-0", "00-1", "01-1", "01-2"]}
    assert (
        driver.app.notice
        == "Moved episode 3 to the place of 1; colours follow the place. Undo, or Ctrl+Z, takes it back"
    )
    driver.carry(shelves.row_area(1), (300, 530, 2, 2))
    assert layout(path)[0] == ["00-0"], "let go over nothing it stays"
    assert driver.top() is screen


def test_the_authors_run_of_ones_own_level_needs_no_medal(driver: MenuDriver, path: Path) -> None:
    driver.app.change_settings(name="the ninja-game team")
    (path / "certificates" / "00-1-mind-the-gap.exit.replay.txt").unlink()
    driver.open("Levels")
    browser = driver.shown(Browser)
    seen = []
    for name in ("the ninja-game team", "Ida"):
        driver.app.change_settings(name=name)
        for index in (0, 1):
            browser.list.index = index
            browser._select(index)
            seen.append(browser.watch_author.hint or browser.watch_author.enabled)
    certify = "none is known: Certify, in the editor, finds one"
    assert seen == [True, certify, "earn a gold medal to watch it", "none is known"]


def test_ones_own_level_with_its_certificate_is_certified(driver: MenuDriver, path: Path) -> None:
    assert driver.player.settings.name == "", "whoever has no name has levels too"
    gap = path / "00-1-mind-the-gap.txt"
    gap.write_text(gap.read_text("utf-8").replace("@", ".", 1), "utf-8")
    driver.open("Levels")
    for index, wanted_text in enumerate(("Certified: 3.900 s", "Not passed yet")):
        driver.shown(Browser).list.index = index
        assert wanted_text in re.findall("text '(.*?)' at 436,408", drawn(driver.app))
    assert drawn(driver.app).count("text 'certified' at") == 7, "of the eight rows"
    (path / "received").touch()
    for _ in ("received", "of days"):
        driver.shown(Browser).enter()
        assert driver.player.reached(driver.shown(Browser).shown[0], None) == "Not passed yet"
        assert "text 'certified' at" not in drawn(driver.app)
        path = path.rename(path.with_name(DAILY))
        (path / "received").unlink(missing_ok=True)


def test_a_full_episode_says_so(driver: MenuDriver, path: Path, screen: PackScreen) -> None:
    driver.carry(screen.shelves.row_area(7), screen.shelves.row_area(2))
    assert "episode 1 is full" in driver.app.notice
    assert layout(path)[1] == ["01-0", "01-1", "01-2"]


def test_keys_alone_move_a_level(driver: MenuDriver, path: Path, screen: PackScreen) -> None:
    driver.press("right", "return")
    driver.choose("Move...")
    driver.press("down", "return")
    assert layout(path) == {0: ["00-1", "00-2", "00-3", "00-4"], 1: ["00-0", "01-0", "01-1", "01-2"]}
    driver.press("return")
    driver.choose("Move...")
    driver.press("escape")
    driver.shown(PackScreen)
    driver.press("escape")
    driver.shown(Browser)


def test_a_pad_alone_makes_a_pack_with_a_level_and_edits_it(driver: MenuDriver) -> None:
    def button(name: str) -> None:
        driver.pad(BUTTONS.index(name))

    opened(driver)
    button("a")
    button("dpad-down")
    button("a")
    screen = driver.shown(PackScreen)
    assert [pack.name for pack in screen.own_packs] == ["My pack"]
    button("a")
    assert driver.shown(MenuScreen).title == "Episode 1"
    button("a")
    button("dpad-down")
    button("a")
    assert titles(screen.shelves) == ["New level"]
    assert driver.shown(EditorScreen).session.source.path == screen.path / "new-level.txt"
    driver.shown(EditorScreen).session.close()


def test_a_level_of_the_players_folder_goes_into_the_pack_and_one_of_the_game_is_copied(
    driver: MenuDriver, path: Path, own: Path, screen: PackScreen
) -> None:
    driver.carry(screen.tray.row_area(0), screen.shelves.row_area(11))
    assert not own.exists()
    assert (path / "mine.txt").exists()
    screen.choose_tray("")
    driver.carry(screen.tray.row_area(0), screen.shelves.row_area(11))
    assert layout(path)[1][3:] == ["mine", "00-0"]
    driver.carry(screen.shelves.row_area(10), screen.tray.row_area(0))
    assert "cannot be changed: it is the game's own" in driver.app.notice


def test_everything_about_a_pack_is_named_again(driver: MenuDriver, path: Path, screen: PackScreen) -> None:
    for index, entry, text in ((1, "Rename...", "Early steps"), (0, "Rename...", "Falls"), (0, "New level...", "New")):
        driver.mouse(*(value + 20 for value in screen.shelves.row_area(index)[:2]))
        driver.mouse(*(value + 20 for value in screen.shelves.row_area(index)[:2]))
        driver.choose(entry)
        if entry == "New level...":
            typed(driver, text)
            assert "episode 1 is full" in driver.app.notice
        else:
            typed(driver, text)
    driver.choose("More...")
    driver.choose("Name, author, version...")
    driver.shown(FormPanel).texts[2] = "2"
    driver.choose("OK")
    pack = Pack(path)
    assert (pack.index.version, pack.index.episodes[0].name) == ("2", "Falls")
    assert pack.levels["00-0-first-steps.txt"].name == "Early steps"
    driver.choose("More...")
    driver.choose("Copy of the pack")
    assert [each.name for each in screen.own_packs] == ["Laundry", "Laundry copy"]


def test_a_problem_leads_to_its_place_and_is_accepted_with_a_reason(driver: MenuDriver, path: Path) -> None:
    level = path / "00-0-first-steps.txt"
    level.write_text(level.read_text("utf-8").replace("name: First Steps\n", ""), "utf-8")
    opened(driver)
    driver.choose("Problems")
    screen = problem_page(driver)
    assert [problem.text for problem in screen.problems] == [
        "00-0-first-steps: no name",
        "Make ready will look for all gold in 8 levels",
    ]
    count = len(screen.problems)
    driver.press("return")
    assert driver.shown(EditorScreen).session.source.path == level
    driver.shown(EditorScreen).session.close()
    driver.app.pop()
    driver.choose("Accept it...")
    before = (path / "pack.toml").read_bytes()
    for empty in ("", "  "):
        driver.type(empty)
        driver.press("return")
        assert (driver.app.notice, (path / "pack.toml").read_bytes()) == ("Write why", before)
        driver.shown(FormPanel)
    typed(driver, "found on the street")
    assert problem_page(driver) is screen
    assert screen.problems[0].text == "00-0-first-steps: no name. Accepted: found on the street"
    assert (screen.list.index, screen.focus) == (0, screen.list), "the choice stays at its row"
    assert Pack(path).index.accepted[0].reason == "found on the street"
    driver.choose("Take it back")
    problem_page(driver)
    assert (len(screen.problems), Pack(path).index.accepted) == (count, ())
    driver.choose("Accept it...")
    typed(driver, "found on the street")
    packs.rename_level(level, "First Steps")
    driver.app.push(EpisodeGrid(driver.app, "Laundry"))
    driver.press("escape")
    problem_page(driver)
    assert [problem.step for problem in screen.problems] == ["Make ready"], "what is mended meanwhile is gone"
    assert Pack(path).index.accepted
    driver.mouse(BACK[0] + 10, BACK[1] + 10)
    driver.shown(PackScreen)


def test_a_problem_of_a_message_leads_to_the_message(driver: MenuDriver, path: Path) -> None:
    level = path / "00-0-first-steps.txt"
    says = re.sub("\nsays: .*", "\nsays: start: Go | start: On | trap: Never", level.read_text("utf-8"))
    level.write_text(says, "utf-8")
    opened(driver)
    driver.choose("Problems")
    page = problem_page(driver)
    row = next(k for k, problem in enumerate(page.problems) if "'Never' is never shown" in problem.text)
    x, y, w, h = page.list.row_area(row)
    driver.mouse(x + w / 2, y + h / 2)
    driver.choose("Go there")
    screen = driver.shown(MessagesScreen)
    assert (screen.list.index, screen.messages[2].text, screen.focus) == (2, "Never", screen.fields[-1])
    driver.choose("Cancel")
    assert driver.shown(EditorScreen).session.source.path == level
    driver.shown(EditorScreen).session.close()


def test_problems_begin_with_the_first_open_one_whose_lines_lie_within_its_frame(
    driver: MenuDriver, path: Path
) -> None:
    for file in ("00-0-first-steps.txt", "00-1-mind-the-gap.txt"):
        level = path / file
        level.write_text(re.sub("name: .*\n", "", level.read_text("utf-8"), count=1), "utf-8")
    packs.accept(path, "00-0-first-steps.txt", "no-name", "found on the street, " * 8)
    opened(driver)
    driver.choose("Problems")
    page = problem_page(driver)
    assert [problem.accepted for problem in page.problems] == [True, False, False]
    assert (page.list.index, page.selected.text) == (1, "00-1-mind-the-gap: no name")
    _, y, _, h = page.list.row_area(0)
    first, second = (float(top) for top in re.findall(r"street.* at 54,(\S+) size 10", drawn(driver.app)))
    assert (first - y, y + h - second - 13) == (6, 6), "as far from the upper edge as from the lower one"


def test_the_page_of_a_pack_without_problems_offers_what_comes_next(
    driver: MenuDriver, path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pack = Pack(path)
    for file in pack.levels:
        packs.accept(path, file, "no-gold-run", "none is meant")
    ready = ReadyPack(pack, [], Pack(path).files.zipped(), pack.files.link(), [])
    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", lambda *_, **__: ready)
    screen = opened(driver)
    driver.choose("Problems")
    page = problem_page(driver)
    page.list.index = len(page.problems) - 1
    page._offer()
    assert page.selected.text == "Nothing is wrong"
    assert not page.buttons["accept"].enabled
    driver.choose("Make ready")
    assert driver.top() is screen
    driver.wait(lambda: screen.packer.saved, "it is made ready")
    assert "Send the zip or the link" in drawn(driver.app)
    driver.choose("Problems")
    page.problems = problem_page(driver).problems
    driver.shown(ProblemsScreen).list.index = len(page.problems) - 1
    driver.shown(ProblemsScreen)._offer()
    copied = copied_links(driver)
    assert len(copied) == 1
    assert driver.top() is screen


def test_problems_are_looked_for_in_the_background(
    driver: MenuDriver, path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    go_on = Event()
    request.addfinalizer(go_on.set)
    threads: list[Thread] = []

    def found(*_: object) -> list[PackFinding]:
        threads.append(current_thread())
        assert go_on.wait(LONGEST)
        return [pack_finding("no-author", "pack.toml")]

    monkeypatch.setattr("ninja_game.play.menus.packer.problems_of", found)
    opened(driver)
    driver.choose("Problems")
    assert "text 'Looking for problems: 0 s'" in drawn(driver.app)
    with patch.object(ProblemsScreen, "draw_frame", autospec=True, side_effect=ProblemsScreen.draw_frame) as draw:
        driver.frames(40, 50)
    assert draw.call_count == 2, "once a second"
    assert "text 'Looking for problems: 2 s'" in drawn(driver.app)
    go_on.set()
    with patch.object(ProblemsScreen, "draw_frame", autospec=True, side_effect=ProblemsScreen.draw_frame) as draw:
        assert problem_page(driver).problems[0].text == "The pack has no author"
        driver.frames()
    assert draw.called, "and what was found at once"
    assert main_thread() not in threads
    assert "1 problem'" in drawn(driver.app)


def test_a_check_that_fails_ends_the_wait_for_it(
    driver: MenuDriver, path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    go_on = Event()
    request.addfinalizer(go_on.set)

    def fail(*_: object) -> list[PackFinding]:
        assert go_on.wait(LONGEST)
        raise OSError(5, "the disk cannot be read")

    monkeypatch.setattr("ninja_game.play.menus.packer.problems_of", fail)
    screen = opened(driver)
    driver.choose("Problems")
    assert "text 'Looking for problems: 0 s'" in drawn(driver.app)
    go_on.set()
    assert [problem.text for problem in problem_page(driver).problems] == ["the disk cannot be read"]
    assert "text '1 problem'" in drawn(driver.app)
    driver.press("escape")
    assert "the disk cannot be read" in screen.status.counts()
    monkeypatch.setattr("ninja_game.play.menus.packer.problems_of", lambda *_: [])
    index = path / "pack.toml"
    index.write_text(index.read_text("utf-8") + "\n", "utf-8")
    assert [problem.text for problem in problems_of(driver, screen)] != ["the disk cannot be read"]


def test_an_empty_pack_says_how_it_is_begun_and_a_free_place_makes_a_level(
    driver: MenuDriver, screen: PackScreen
) -> None:
    assert "a zip to open or drop here" in drawn(driver.app)
    driver.choose("New pack...")
    typed(driver, "Walls")
    assert "drag them into the places" in drawn(driver.app)
    driver.choose("New level...")
    typed(driver, "Brick")
    driver.shown(EditorScreen).session.close()
    driver.app.pop()
    assert not [each for each in screen.widgets if getattr(each, "text", "") == "New level..."]
    driver.wait(lambda: screen.status.present, "the problems are known")
    assert "to mend: Problems, above" in drawn(driver.app)
    screen.choose(screen.shelves.cells[-1])
    assert driver.shown(FormPanel).title == "New episode: name"
    driver.press("escape")
    screen.choose(screen.shelves.cells[2])
    assert driver.shown(FormPanel).title == "New level: its name"
    typed(driver, "Mortar")
    assert layout(screen.path) == {0: ["bric", "mort"]}


def test_levels_of_days_are_no_pack_of_ones_own(driver: MenuDriver, path: Path) -> None:
    shutil.copytree(path, path.with_name(DAILY))
    assert [pack.path for pack in opened(driver).own_packs] == [path]


def with_an_open_problem(path: Path) -> ReadyPack:
    pack, left = Pack(path), [pack_finding("no-author", "pack.toml")]
    return ReadyPack(pack, left, pack.files.zipped(), pack.files.link(), ["No par times"])


def test_a_pack_is_made_ready_in_the_background(
    driver: MenuDriver, path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ready = with_an_open_problem(path)
    begun = []
    go_on = Event()

    def made(folder: Path, *, seconds: float, jobs: int, say: Say, obstacles: object) -> ReadyPack:
        begun.append(folder)
        say("Making the solver ready", None)
        assert go_on.wait(LONGEST)
        return replace(ready)

    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", made)
    screen = opened(driver)
    driver.choose("Make ready")
    driver.wait(lambda: re.fullmatch(r"Making the solver ready: \d+ s", screen.packer.text))
    driver.wait(lambda: "Making the solver ready" in drawn(driver.app))
    assert "fill accent 36,546" not in drawn(driver.app), "no bar where nobody knows how long it takes"
    go_on.set()
    driver.wait(lambda: driver.top() is not screen, "it asks what to do about open problems")
    driver.press("return")
    assert driver.shown(MenuScreen).title == "Laundry: 1 open problem", "it takes no key that was meant for the desk"
    assert screen.packer.saved is None
    driver.frames(ms=500)
    driver.choose("Show the problems")
    driver.shown(ProblemsScreen)
    driver.press("escape")
    assert driver.top() is screen, "it asks once"
    driver.choose("Make ready")
    driver.wait(lambda: driver.top() is not screen)
    driver.frames(ms=500)
    driver.choose("Zip and link all the same")
    assert "the link is in the clipboard" in driver.app.notice
    zipped = driver.player.folder / "exports" / "laundry.zip"
    assert begun == [path, path]
    assert ZipFile(zipped).namelist()[0] == "laundry/pack.toml"
    saved, rest = f"Saved: {short_path(zipped)}", "the link is in the clipboard"
    assert driver.app.notice == f"{saved}; {rest}"
    notice = driver.app._draw_notice(driver.app.theme)
    assert 0 <= notice.top < notice.bottom <= 96, "the state of the pack, and hints, are read meanwhile"
    assert screen.packer.text == f"{saved}, with 1 open problem (no author); {rest}; No par times"


@pytest.fixture(name="zipped")
def desk_with_a_zip(driver: MenuDriver, path: Path, monkeypatch: pytest.MonkeyPatch) -> PackScreen:
    """The desk after the player's pack was zipped in spite of a problem."""
    ready = with_an_open_problem(path)
    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", lambda *_, **__: ready)
    screen = opened(driver)
    driver.choose("Make ready")
    driver.wait(lambda: driver.top() is not screen)
    driver.frames(ms=500)
    driver.choose("Zip and link all the same")
    driver.frames(2)
    driver.wait(lambda: screen.status.present, "the problems are known")
    return screen


def test_the_page_of_problems_and_the_desk_go_on_from_a_zip(driver: MenuDriver, zipped: PackScreen) -> None:
    screen = zipped
    assert driver.app.notice
    driver.choose("Problems")
    assert driver.app.notice == "", "what is said there goes with the screen"
    assert [problem.step for problem in problem_page(driver).problems] == ["Make ready"]
    assert "0 problems" in drawn(driver.app)
    driver.press("escape")
    assert screen.status.counts() == "8 levels in 2 episodes. Make ready will look for all gold in 8 levels. 0 problems"
    assert screen.status.counts()[:30] in drawn(driver.app)
    assert "laundry.zip" in drawn(driver.app), "it stays"
    assert "clipboard" not in screen.packer.text, "it may hold something else by now"


def test_a_zip_is_sent_until_its_pack_changes(
    driver: MenuDriver, path: Path, zipped: PackScreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    screen, file = zipped, driver.player.folder / "exports" / "laundry.zip"
    link, saved = Pack(path).files.link(), screen.packer.text
    assert saved.startswith("Saved: ")
    assert "Send the zip or the link" in drawn(driver.app)
    assert driver.button("Make ready")
    opened_folders: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened_folders.append)
    driver.choose("Open the folder")  # a button that comes with the zip
    assert opened_folders == [file.parent.as_uri()]
    driver.carry(screen.shelves.row_area(2), half(screen, 8))
    assert screen.packer.text == "Changed since laundry.zip"
    assert "Send the zip or the link" not in drawn(driver.app)
    driver.choose("Undo")
    assert screen.packer.text == saved
    copied = copied_links(driver)
    assert copied[0].endswith(link)


def test_making_ready_goes_on_elsewhere_and_what_is_done_is_seen_at_once(
    driver: MenuDriver, path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pack, go_on = Pack(path), Event()
    certificate = path / "certificates" / "00-0-first-steps.exit.replay.txt"
    run = certificate.read_text("utf-8")
    certificate.unlink()

    def made(folder: Path, *, seconds: float, jobs: int, say: Say, obstacles: object) -> ReadyPack:
        say("Certifying, 0 of 1 levels done", 0.0)
        assert go_on.wait(LONGEST)
        go_on.clear()
        certificate.write_text(run, "utf-8")
        say("Certifying, 1 of 1 levels done", 1.0)
        assert go_on.wait(LONGEST)
        return ReadyPack(pack, [], pack.files.zipped(), pack.files.link(), [])

    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", made)
    first = opened(driver)
    driver.choose("Make ready")
    driver.choose("More...")
    assert not driver.button("Delete the pack...").enabled
    driver.press("escape", "escape")
    driver.shown(Browser)
    driver.choose("Packs")
    screen = driver.shown(PackScreen)
    assert screen is not first
    driver.wait(lambda: screen.packer.text == "Certifying, 0 of 1 levels done")
    assert "fill accent 36,546" in drawn(driver.app)
    assert driver.button("Stop")

    def state() -> str:
        [entry] = [cell.level for cell in screen.shelves.cells if cell.level and cell.level.title == "First Steps"]
        return screen.status.state(entry)

    assert state() == "no run yet", "though its time is measured"
    driver.choose("Problems")
    [to_do] = [problem.text.removeprefix("Nothing is wrong. ") for problem in problem_page(driver).problems]
    assert to_do.startswith("Make ready is at work, and will certify 1 level"), "it has begun"
    driver.press("escape")
    assert to_do in screen.status.counts()
    go_on.set()
    driver.wait(lambda: state() != "no run yet", "the card says so before all is done")
    assert screen.packer.is_busy
    driver.app.push(grid := EpisodeGrid(driver.app, "Laundry"))
    grid.grid.index = 1
    packs.rename_episode(path, 1, "Wash day")
    go_on.set()
    driver.wait(lambda: driver.app.notice == "Laundry is ready to share", "it is said elsewhere")
    assert (grid.episode and grid.episode.name) == "Wash day", "what is shown there is as new"
    driver.press("escape")
    assert driver.shown(PackScreen).packer.text == (
        f"Saved: {short_path(driver.player.folder / 'exports' / 'laundry.zip')}"
    )
    assert driver.button("Make ready")


def test_what_is_wrong_is_asked_about_before_the_work_and_once(
    driver: MenuDriver, path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    packs.describe(path, {"version": "1.1"})
    packs.place(path, [packs.new_level(path, "Brick", "me")], 1)
    later = [pack_finding("same-name", "00-0-first-steps.txt", other="x")]
    begun = list[list[PackFinding]]()

    def made(folder: Path, **_: object) -> ReadyPack:
        pack = Pack(folder)
        problems = [*ready_pack.problems_of(pack, {}), *(later if len(begun) == 1 else [])]
        begun.append(problems)
        return ReadyPack(pack, [each for each in problems if each.code == "no-ninja" or each in later], b"zip", "", [])

    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", made)
    screen = opened(driver)

    def asked(text: str) -> None:
        driver.wait(lambda: driver.top() is not screen, "it asks")
        assert driver.shown(MenuScreen).title == "Laundry: " + text
        driver.frames(ms=500)

    driver.choose("Make ready")
    asked("1 open problem")
    assert not begun, "before the work"
    driver.choose("Show the problems")
    assert [each.text for each in problem_page(driver).problems][:1] == [
        "Brick: there is no ninja: the level cannot be played"
    ]
    driver.press("escape")
    for number, saved in enumerate(("laundry-1.1.zip", "laundry-1.1-2.zip", "laundry-1.1-3.zip")):
        driver.choose("Make ready")
        if number == 0:
            asked("1 open problem")
            driver.choose("Make ready all the same")
        if number == 1:
            asked("1 new problem, 2 open")
            driver.choose("Zip and link all the same")
        driver.wait(lambda: not screen.packer.is_busy)
        assert driver.top() is screen
        assert screen.packer.saved
        assert screen.packer.saved.name == saved, "what is known is not asked about again, what is new is"
        packs.place(path, ["00-0-first-steps.txt"], 1)
    assert len(begun) == 3


def test_what_was_made_ready_asks_only_at_its_own_desk(
    driver: MenuDriver, path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    ready = ReadyPack(Pack(path), [pack_finding("no-author", "pack.toml")], b"", "", [])
    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", lambda *_, **__: ready)
    other = packs.new_pack(path.parent, "Other", "me")
    screen = opened(driver)
    screen.read_packs(path)
    pack_sharing.prepare_shown(screen)
    screen.read_packs(other)
    driver.wait(lambda: not screen.packer.is_busy)
    driver.frames(3)
    assert driver.top() is screen
    assert driver.app.notice == "Laundry: Neither zip nor link yet: 1 open problem"
    screen.read_packs(path)
    driver.frames(2)
    assert driver.shown(MenuScreen).title == "Laundry: 1 open problem"


def test_a_link_of_levels_without_certificate_is_asked_about(driver: MenuDriver, path: Path) -> None:
    level = path / "00-1-mind-the-gap.txt"
    level.write_text(level.read_text("utf-8").replace("@", ".", 1), "utf-8")
    screen, copied = opened(driver), list[str]()
    with patch("pygame.scrap.put_text", copied.append):
        driver.choose("Copy the link")
        assert driver.shown(MenuScreen).title == "The link has 1 level without certificate"
        assert not copied
        driver.choose("Copy all the same")
    assert (driver.top(), driver.app.notice, len(copied)) == (screen, "Link copied", 1)
    (path / "received").touch()
    screen.read_packs()
    with patch("pygame.scrap.put_text", copied.append):
        driver.choose("Copy the link")
    assert len(copied) == 2, "it is not for who received it to mend"


def test_what_was_searched_in_vain_is_said_at_once_and_searched_longer_from_its_row(
    driver: MenuDriver, path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pack, go_on, seconds_each, known_each = Pack(path), Event(), list[float](), list[int]()
    (path / "certificates" / "00-0-first-steps.exit.replay.txt").unlink()
    level = pack.levels["00-0-first-steps.txt"].level

    def made(folder: Path, *, seconds: float, jobs: int, say: Say, obstacles: Obstacles) -> ReadyPack:
        seconds_each.append(seconds)
        known_each.append(len(obstacles))
        obstacles[level, "exit"] = level_finding("unreached-exit")
        say("Certifying, 1 of 1 levels done", 1.0)
        assert go_on.wait(LONGEST)
        return ReadyPack(pack, [], pack.files.zipped(), pack.files.link(), [])

    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", made)
    screen = opened(driver)
    path_of_level = str(path / "00-0-first-steps.txt")
    driver.wait(lambda: screen.status.present, "the problems are known")
    assert screen.status.checked
    assert path_of_level not in screen.status.checked.places, "nobody has looked for a run yet"
    driver.choose("Make ready")
    driver.wait(lambda: "no run found" in drawn(driver.app), "the card says so before all is done")
    assert screen.packer.is_busy
    assert all(each.search is None for each in problems_of(driver, screen))
    go_on.set()
    driver.wait(lambda: not screen.packer.is_busy)
    driver.choose("Problems")
    problem_page(driver)
    assert "the solver never reached it, although it was open" in drawn(driver.app)
    driver.choose("Search for 5 minutes")
    driver.shown(PackScreen)
    driver.wait(lambda: len(seconds_each) == 2)
    assert (seconds_each, known_each) == ([20.0, 300.0], [0, 0]), "this run alone is looked for again"
    driver.wait(lambda: not screen.packer.is_busy)


def test_problems_speak_of_what_is_seen_not_of_files(driver: MenuDriver, path: Path) -> None:
    (path / "pars.toml").unlink()
    packs.describe(path, {"author": ""})
    packs.new_episode(path, "", 0)
    screen = opened(driver)
    texts = [problem.text for problem in problems_of(driver, screen) if not problem.step]
    assert texts == ["The pack has no author", "Episode 3 has no name", "Episode 3 has no levels"]
    assert "medal times" in screen.status.to_do()


def test_a_remark_about_the_order_names_levels_and_can_be_accepted(driver: MenuDriver, path: Path) -> None:
    table = path / "pars.toml"
    table.write_text(table.read_text("utf-8").replace("difficulty = 0.39", "difficulty = 5.00"), "utf-8")
    screen = opened(driver)
    remarks = [problem for problem in problems_of(driver, screen) if problem.accept]
    assert [problem.text for problem in remarks] == [
        "First Steps: hard, harder than Mind the Gap (easy), but comes right before it",
        "First Steps: hard: the first level is the hardest of the pack",
    ]


def test_making_ready_is_stopped(driver: MenuDriver, path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def endless(folder: Path, *, seconds: float, jobs: int, say: Say, obstacles: object) -> ReadyPack:
        while True:
            say("Certifying", 0.5)

    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", endless)
    (path / "certificates" / "00-0-first-steps.exit.replay.txt").unlink()
    screen = opened(driver)
    assert "text 'no run yet' at" in drawn(driver.app)
    driver.choose("Make ready")
    driver.wait(lambda: screen.packer.text == "Certifying")
    driver.choose("Stop")
    driver.wait(lambda: "Stopped" in screen.packer.text)
    assert drawn(driver.app).count("text 'stopped' at") == 1, "the others are certified"
    driver.choose("Make ready")
    driver.app.run(1)
    driver.wait(lambda: screen.packer._job.is_idle, "it ends with the program")
    screen.packer.update()
    with patch("ninja_game.play.menus.packer.Pack") as read:
        driver.app.run(1)
    assert not read.called, "where nothing is at work, no pack is read at the end"


def test_what_changed_is_marked(driver: MenuDriver, path: Path) -> None:
    level = path / "00-1-mind-the-gap.txt"
    level.write_text(level.read_text("utf-8").replace("@", ".", 1), "utf-8")
    screen = opened(driver)
    stale = [cell.level.title for cell in screen.shelves.cells if cell.level and cell.level.pars is None]
    assert stale == ["Mind the Gap"]
    assert screen.status.counts().startswith("8 levels in 2 episodes. Make ready will certify 1 level")
    driver.wait(lambda: screen.status.present, "the problems are known")
    assert [screen.status.state(cell.level) for cell in screen.shelves.cells if cell.level][1] == "changed"
    packs.place(path, [packs.new_level(path, "Empty", "me")], 1)
    screen.enter()
    driver.wait(lambda: screen.status.present, "the problems are known")
    assert screen.status.counts().startswith("9 levels in 2 episodes. Make ready will certify 2 levels")
    [entry] = [each.level for each in screen.shelves.cells if each.level and each.level.title == "Empty"]
    assert screen.status.state(entry) == "no run yet"
    no_ninja = [problem for problem in problems_of(driver, screen) if "there is no ninja" in problem.text]
    assert [(problem.text[:5], problem.accept) for problem in no_ninja] == [("Mind ", None), ("Empty", None)]


def test_what_the_editor_certified_is_certified_in_the_folder_too(driver: MenuDriver, path: Path) -> None:
    levels, name = path.parent, "00-0-first-steps"
    shutil.copy(path / f"{name}.txt", levels)
    screen = opened(driver)
    screen.choose_tray("yours")
    entry = screen.tray.cells[0].level
    assert entry
    assert screen.status.state(entry) == "no run yet"
    (levels / "certificates").mkdir()
    shutil.copy(path / "certificates" / f"{name}.exit.replay.txt", levels / "certificates")
    screen.read_packs()
    assert screen.status.state(entry) == "certified"
    pack_menus.level_menu(screen, screen.tray.cells[0])
    driver.choose("Watch the run")
    driver.shown(ReplayScreen)
    driver.app.pop()
    pack_menus.level_menu(screen, screen.tray.cells[0])
    driver.choose("Play")
    driver.shown(LevelScreen)


def test_a_run_follows_its_level_into_a_pack_and_a_lost_one_is_told_of(
    driver: MenuDriver, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    levels, go_on, reports = driver.player.folder / "levels", Event(), list[str]()
    request.addfinalizer(go_on.set)
    walk = ROOM
    for name, draft in (("Gap", walk.with_tiles({(30, 1): 1})), ("Walk", walk)):
        (levels / f"{name}.txt").write_text(ascii_text(replace(draft, name=name)), "utf-8")
    packs.new_pack(levels, "Mine", "me")

    def solve(task: Task, *, on_better: Callable[[Replay], object], **_: object) -> Replay:
        assert go_on.wait(LONGEST)
        run = verified_run(task.level, with_press_bits(bytes([2]) * 100))
        on_better(run)
        return run

    monkeypatch.setattr("ninja_game.search.solve.solve", solve)
    monkeypatch.setattr("ninja_game.editor.solver.compiled_available", lambda: True)
    screen = opened(driver)
    screen.choose_tray("yours")
    for index in (0, 1):
        for _ in "12":
            driver.mouse(*(value + 30 for value in screen.tray.row_area(index)[:2]))
        driver.choose("Edit")
        driver.press("f7")
        driver.choose_in_menu("Leave the editor")
        driver.shown(PackScreen)
    driver.carry(screen.tray.row_area(1), screen.shelves.row_area(1))

    def states() -> list[str]:
        return [f"{cell.level.title}: {screen.status.state(cell.level)}" for cell in screen.shelves.cells if cell.level]

    assert states() == ["Walk: no run yet"]
    (levels / "Gap.txt").unlink()
    notify = driver.app.notify

    def note(text: str, **_: object) -> None:
        reports.append(text)
        notify(text)

    monkeypatch.setattr(driver.app, "notify", note)
    go_on.set()
    driver.wait(lambda: len(reports) == 2)
    assert sorted(reports) == [
        "Gap: no certificate, as no file has the level any more. Open it, and press F7",
        "Walk: certified, 0.975 s, kept with the level",
    ]
    assert (screen.path / "certificates" / "Walk.exit.replay.txt").exists()
    driver.wait(lambda: states() == ["Walk: certified"], "its card says so")


def test_a_pack_that_is_deleted_can_be_found_again(driver: MenuDriver, path: Path, screen: PackScreen) -> None:
    screen.packer.path, screen.packer.saved, screen.packer.text = path, path.with_suffix(".zip"), "Saved: laundry.zip"
    for answer, there in (("Cancel", True), ("Delete it", False)):
        driver.choose("More...")
        driver.choose("Delete the pack...")
        driver.choose(answer)
        assert (path.exists(), bool(screen.own_packs)) == (there, there)
    assert Pack(driver.player.folder / "deleted" / "laundry").name == "Laundry"
    assert not any((screen.packer.text, screen.packer.saved)), "nothing is said of what is gone"
    assert "in the folder deleted/laundry now" in driver.app.notice.replace("\\", "/")


def folder_texts(folder: Path) -> dict[str, bytes]:
    return {str(each.relative_to(folder)): each.read_bytes() for each in folder.rglob("*") if each.is_file()}


def test_what_is_done_at_the_desk_is_undone_step_by_step(driver: MenuDriver, path: Path) -> None:
    levels = path.parent
    (levels / "mine.txt").write_text((path / "00-0-first-steps.txt").read_text("utf-8"), "utf-8")
    screen = opened(driver)
    states = [folder_texts(levels)]
    assert not driver.button("Undo").enabled

    def done() -> None:
        driver.frames(2)
        states.append(folder_texts(levels))
        assert states[-1] != states[-2]

    driver.carry(screen.shelves.row_area(2), half(screen, 8))
    done()
    screen.choose_tray("yours")
    driver.carry(screen.tray.row_area(0), screen.shelves.row_area(11))
    done()
    pack_menus.level_menu(screen, screen.shelves.cells[1])
    driver.choose("Rename...")
    typed(driver, "Early steps")
    done()
    screen.choose(screen.shelves.cells[6])
    driver.choose("Remove the episode")
    done()
    driver.choose("New pack...")
    typed(driver, "Other")
    done()
    driver.press("escape")
    driver.choose("Packs")
    screen = driver.shown(PackScreen)
    screen.read_packs(path)
    driver.choose("More...")
    driver.choose("Delete the pack...")
    assert driver.shown(MenuScreen).title == "Delete Laundry with its 9 levels?"
    assert "All goes to the folder deleted; Undo brings it back" in drawn(driver.app)
    driver.choose("Delete it")
    assert Packer(driver.app).steps == screen.packer.steps, "so it is when the program runs again"
    commands = ["Delete Laundry", "New pack", "Take out Things that hum", "Rename First Steps", "Move First Steps"]
    for what in [*commands, "Move Mind the Gap"]:
        assert driver.button("Undo").hint == f"Ctrl+Z: {what}"
        driver.chord("z", pygame.KMOD_LCTRL)
        assert driver.app.notice == f"Undone: {what}"
        assert folder_texts(levels) == states.pop()
    assert not (levels / "other").exists()
    driver.chord("z", pygame.KMOD_LCTRL)
    assert driver.app.notice == "there is nothing to undo"
    screen.choose(screen.shelves.cells[0])
    driver.choose("Remove the episode")
    packs.describe(path, {"version": "3"})
    driver.choose("Undo")
    assert driver.app.notice == "Take out Learning to fall: not undone, as pack.toml was changed since"
    assert list(layout(path)) == [1]


def test_a_pack_comes_by_its_link_and_by_ctrl_v(driver: MenuDriver, path: Path, screen: PackScreen) -> None:
    clipboard = [""]
    with patch("pygame.scrap.put_text", clipboard.append), patch("pygame.scrap.get_text", lambda: clipboard[-1]):
        driver.choose("Copy the link")
        assert driver.app.notice == "Link copied"
        notice = driver.app._draw_notice(driver.app.theme)
        assert not any(notice.colliderect(driver.app.canvas.rect(*each.area)) for each in screen.widgets)
        clipboard.append(f"https://example.org/game/ {clipboard[-1]}\n")
        shutil.rmtree(path)
        screen.enter()
        assert not screen.own_packs
        driver.choose("Paste link")
        assert "Laundry: kept among your packs, in " in driver.app.notice
        driver.choose("Not now")
        driver.wait(lambda: screen.status.present, "the problems are known")
        work = "Make ready will look for all gold in 8 levels"
        assert screen.status.counts() == f"8 levels in 2 episodes. {work}. 0 problems"
        assert screen.status.checked
        assert {finding.code for finding in screen.status.checked.to_do} == {"no-gold-run"}
        assert [pack.name for pack in screen.own_packs] == ["Laundry"]
        first = layout(screen.path)
        driver.chord("v", pygame.KMOD_LCTRL)
        assert len(screen.own_packs) == 1
        assert driver.shown(MenuScreen).title == "Laundry is among your packs already"
        driver.choose("Play it")
        assert driver.shown(EpisodeGrid).player is driver.player
        driver.press("escape")
        packs.rename_episode(screen.path, 0, "Other")
        first = layout(screen.path)
        driver.chord("v", pygame.KMOD_LCTRL)
        driver.choose("Keep both")
        driver.choose("Not now")
        assert len(screen.own_packs) == 2, "it never goes over what is there unasked"
    assert layout(screen.path) == first


def test_another_version_of_a_received_pack_updates_it(driver: MenuDriver, path: Path, tmp_path: Path) -> None:
    screen, made = opened(driver), tmp_path / "made"
    shutil.move(path, made)
    screen.enter()
    zipped = tmp_path / "laundry.zip"

    def drop() -> None:
        zipped.write_bytes(Pack(made).files.zipped())
        driver.drop_file(zipped)

    drop()
    assert driver.app.notice.startswith("Laundry: kept among your packs, in ")
    driver.choose("Not now")
    assert [(each.name, each.received) for each in screen.own_packs] == [("Laundry", True)]
    before = {file: file.read_bytes() for file in path.rglob("*") if file.is_file()}
    (made / "00-0-first-steps.txt").unlink()
    (made / "00-1-mind-the-gap.txt").write_text((made / "01-0-springtime.txt").read_text("utf-8"), "utf-8")
    packs.new_level(made, "Fresh", "me")
    for file in ("00-2", "00-3", "00-4"):
        (level,) = made.glob(f"{file}-*.txt")
        level.write_text(level.read_text("utf-8").replace("\ncomment: ", "\ncomment: Well: ", 1), "utf-8")
    packs.describe(made, {"version": "1.1"})
    drop()
    assert driver.shown(MenuScreen).title == "You have Laundry in another version"
    news = "1 level new: Fresh; 4 levels changed; 1 level gone: First Steps"
    assert news in drawn(driver.app), "the texts of a level count too"
    driver.choose("Update it")
    driver.choose("Not now")
    assert driver.app.notice == f"Laundry: {news}"
    assert [(each.name, each.received) for each in screen.own_packs] == [("Laundry", True)]
    assert Pack(path).index.version == "1.1"
    assert packs.same_pack(Pack(path), Pack(made))
    driver.chord("z", pygame.KMOD_CTRL)
    assert {file: file.read_bytes() for file in path.rglob("*") if file.is_file()} == before
    drop()
    driver.choose("Keep both")
    assert [each.name for each in screen.own_packs] == ["Laundry", "Laundry, 1.1"]


def test_an_update_that_fails_half_way_shows_no_card_and_is_undone(
    driver: MenuDriver, path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, screen: PackScreen
) -> None:
    (path / "received").touch()
    screen.enter()
    made, zipped = tmp_path / "made", tmp_path / "laundry.zip"
    shutil.copytree(PACK, made)
    packs.describe(made, {"name": "Laundry", "version": "2"})
    packs.new_level(made, "Fresh", "me")
    zipped.write_bytes(Pack(made).files.zipped())
    before = folder_texts(path)

    def full(folder: Path, name: str, content: str | bytes | None) -> None:
        if name == "received":
            raise OSError(28, "No space left on device")
        write_file(folder, name, content)

    with monkeypatch.context() as patched:
        patched.setattr(packs, "write_file", full)
        driver.drop_file(zipped)
        driver.choose("Update it")
    assert "No space left" in driver.app.notice
    assert driver.top() is screen
    driver.choose("Undo")
    assert folder_texts(path) == before


def test_what_is_received_is_shown_on_a_card_before_the_desk(driver: MenuDriver, path: Path, tmp_path: Path) -> None:
    packs.describe(path, {"version": "1.2", "comment": "Dry by noon"})
    zipped = tmp_path / "laundry.zip"
    zipped.write_bytes(Pack(path).files.zipped())
    shutil.rmtree(path)
    driver.drop_file(zipped)
    card = driver.shown(PackCard)
    assert card.focus is driver.button("Play")
    text = drawn(driver.app)
    for wanted_text in ("Laundry", "by the ninja-game developers, 1.2", "8 levels in 2 episodes", "Dry by noon"):
        assert f"text '{wanted_text}' at" in text
    with patch.object(card._thumbnails, "draw") as draw:
        drawn(driver.app)
    assert draw.call_count == 4, "its picture"
    driver.press("return")
    assert driver.shown(EpisodeGrid).pack.name == "Laundry"
    driver.press("escape")
    screen = driver.shown(PackScreen)
    driver.choose("Undo")
    driver.drop_file(zipped)
    driver.choose("Edit a copy")
    assert [(pack.name, pack.received) for pack in screen.own_packs] == [("Laundry", True), ("Laundry copy", False)]
    assert (screen.pack and screen.pack.name) == "Laundry copy"


def test_a_level_that_comes_from_elsewhere_is_moved_or_with_ctrl_copied_and_that_is_said(
    driver: MenuDriver, path: Path, own: Path, screen: PackScreen
) -> None:
    free = screen.shelves.row_area(11)
    for mods, done in ((pygame.KMOD_LCTRL, "Copied"), (0, "Moved")):
        driver.carry(screen.tray.row_area(0), free, drop=False)
        assert "with Ctrl, a copy" in drawn(driver.app)
        let_go(driver, free, mods)
        assert driver.app.notice == f"{done} Mine from your folder. Undo, or Ctrl+Z, takes it back"
        assert (own.exists(), (path / "mine.txt").exists()) == (bool(mods), True)
        driver.choose("Undo")
        assert (own.exists(), (path / "mine.txt").exists()) == (True, False)
    driver.app.notify("")
    driver.carry(screen.shelves.row_area(1), free, drop=False)
    let_go(driver, free, pygame.KMOD_LCTRL)
    assert driver.app.notice.startswith("Copied First Steps from Laundry")
    assert layout(path)[1][3:] == ["firs"]
    assert layout(path)[0][0] == "00-0"
    driver.app.notify("")
    driver.carry(screen.shelves.row_area(1), half(screen, 4))
    assert (
        driver.app.notice == "Moved First Steps to episode 1; colours follow the place. Undo, or Ctrl+Z, takes it back"
    )


def test_the_disk_is_read_again_only_when_it_changed(driver: MenuDriver, path: Path, screen: PackScreen) -> None:
    with patch.object(screen, "read_packs", wraps=screen.read_packs) as read:
        screen.choose(screen.shelves.cells[1])
        read.reset_mock()
        driver.choose("Edit")
        assert read.call_count == 1, "when its menu closes"
        driver.shown(EditorScreen).session.close()
        driver.app.pop()
        assert driver.top() is screen
        read.reset_mock()
        screen.change_pack(lambda: packs.rename_episode(path, 0, "Other"), "Rename")
        assert read.call_count == 1
        read.reset_mock()
        with patch("pygame.scrap.get_text", Pack(PACK).files.link):
            pack_sharing.paste(screen)
        assert [read.call_count, screen.path.name] == [1, "test-pack"]


def test_an_episode_is_sorted_by_difficulty(driver: MenuDriver, path: Path, screen: PackScreen) -> None:
    driver.mouse(*(value + 20 for value in screen.shelves.row_area(0)[:2]))
    driver.press("return")
    driver.choose("Sort by difficulty")
    known = [cell.level.pars.difficulty or 0 for cell in screen.shelves.cells[1:6] if cell.level and cell.level.pars]
    assert known == sorted(known)
    assert layout(path)[0] != ["00-0", "00-1", "00-2", "00-3", "00-4"]


def test_the_link_of_ones_own_pack_can_be_received(driver: MenuDriver, path: Path, screen: PackScreen) -> None:
    with patch("pygame.scrap.get_text", Pack(path).files.link):
        driver.choose("Paste link")
        driver.choose("Show it as received")
        assert driver.shown(EpisodeGrid).previews
        driver.press("escape")
        driver.choose("Paste link")
        driver.choose("Receive it once more")
        driver.choose("Not now")
    assert [bool(pack.received) for pack in screen.own_packs] == [False, True]
    assert (screen.pack and screen.pack.received, screen.focus) == (True, screen.play_button)


def test_a_menu_opens_at_the_name_of_the_pack_and_at_a_card(driver: MenuDriver, path: Path) -> None:
    shutil.copytree(path, path.with_name("soap"))
    packs.describe(path.with_name("soap"), {"name": "Soap"})
    screen = opened(driver)
    assert screen.pack_choice

    def right_click(area: Area) -> MenuScreen:
        place = screen.theme.canvas.point(area[0] + area[2] / 2, area[1] + area[3] / 2)
        pygame.event.post(pygame.Event(pygame.MOUSEBUTTONDOWN, pos=place, button=3, touch=False))
        driver.frames()
        return driver.shown(MenuScreen)

    assert right_click(screen.pack_choice.area).title == "Laundry"
    driver.choose("Cancel")
    x, y, w, _ = screen.pack_choice.area
    driver.mouse(x + w - 9, y + 9)
    assert (screen.pack and screen.pack.name) == "Soap", "an arrow shows the next one"
    seen = drawn(driver.app)
    assert "text 'Soap'" in seen
    assert "in the folder soap." in seen
    driver.mouse(x + w / 2, y + 9)
    listed = driver.shown(PackList)
    with patch.object(listed.thumbnails, "draw") as draw:
        assert "8 levels in 2 episodes" in drawn(driver.app)
    titles = [each.args[1].title for each in draw.call_args_list]
    assert titles[:4] == ["First Steps", "The Chimney", "Locksmith", "Night Shift"], "four of the eight"
    driver.press("down")
    driver.type("developers")
    assert (len(listed.shown), listed.list.index) == (2, 0), "Enter takes the row that is marked"
    driver.type(" laun")
    assert [each.name for each in listed.shown] == ["Laundry"]
    driver.press("return")
    assert driver.top() is screen
    assert (screen.pack and screen.pack.name) == "Laundry"
    assert "text 'Laundry'" in drawn(driver.app)
    assert right_click(screen.shelves.row_area(1)).title == "First Steps"
    driver.choose("Cancel")
    assert right_click(screen.shelves.row_area(0)).title == "Learning to fall"
    driver.choose("Cancel")
    right_click((400, 20, 2, 2))
    assert driver.top() is not screen, "elsewhere it leads back"


def linked(*names: str) -> str:
    return write_link("pack", [json.dumps({"pack.toml": 'name = "Odd"\n'} | dict.fromkeys(names, "x"))])


@pytest.mark.parametrize(
    "text, wanted_text",
    [
        ("", "no text in the clipboard"),
        ("a poem", "no link of a pack"),
        ("#level=1.qWQqg0tUKEmtKAEA", "no link of a pack"),
        ("#pack=1.abc", "not whole"),
        (linked("../a.txt"), "a name that no file of a pack has"),
        (linked("aux.txt"), "a name that Windows reserves"),
        (linked(*(f"{number}.txt" for number in range(4097))), "too many files"),
        (write_link("pack", ['{"a.txt": "x"}']), "pack.toml"),
    ],
)
def test_what_is_not_a_link_of_a_pack_changes_nothing(
    driver: MenuDriver, path: Path, text: str, wanted_text: str, screen: PackScreen
) -> None:
    before = sorted(path.parent.rglob("*"))
    pasted(driver, text)
    assert wanted_text in driver.app.notice
    assert sorted(path.parent.rglob("*")) == before


def test_what_is_taken_out_is_seen_beside_the_shelves(driver: MenuDriver, path: Path, screen: PackScreen) -> None:
    screen.choose_tray("yours")
    pack_menus.level_menu(screen, screen.shelves.cells[1])
    driver.choose("Take out")
    assert titles(screen.tray) == ["First Steps"]
    screen.choose_tray("yours")
    screen.choose(screen.shelves.cells[0])
    driver.choose("Remove the episode")
    assert len(screen.tray.cells) == 5
    driver.carry(screen.tray.row_area(0), half(screen, 4))
    assert layout(path)[1] == ["01-0", "01-1", "01-2", "00-0"]


def test_a_pack_is_played_from_the_desk(driver: MenuDriver, path: Path, screen: PackScreen) -> None:
    driver.choose("More...")
    driver.choose("Play it")
    assert driver.shown(EpisodeGrid).pack.key == "Laundry"
    driver.press("escape")
    assert driver.top() is screen
    packs.new_pack(path.parent, "Empty", "me")
    screen.read_packs(path.parent / "empty")
    driver.choose("More...")
    assert not driver.button("Play it").enabled


def test_a_pack_is_previewed_as_somebody_who_has_played_nothing(driver: MenuDriver, path: Path) -> None:
    driver.app.change_settings(name="the ninja-game developers")
    packs.describe(path, {"comment": "Dry by noon"})
    for name, level in Pack(path).levels.items():
        if name.startswith("00"):
            driver.player.marks.passed(level_digest(level.level), 1, 0)
    screen = opened(driver)
    driver.choose("Preview")
    grid = driver.shown(EpisodeGrid)
    text = drawn(driver.app)
    assert "text 'Laundry' at 44,58 size 20 bold" in text
    for wanted_text in ("by the ninja-game developers", "Dry by noon"):
        assert f"text '{wanted_text}' at" in text
    assert "text 'seen in practice'" not in text
    assert "text 'Preview as player'" in text
    assert "0 of 8 levels passed" in text
    assert "text '9.200 s'" not in text, "nothing is unlocked, nor raced"
    assert "Not passed yet" in text
    assert grid._look_of(1) == "locked"
    driver.choose("Play")
    run = driver.shown(LevelScreen).playthrough
    assert run.data is grid.player is not driver.player
    assert save_work(run.data, lambda: ["New best"]) == ["New best", "Not saved yet: this is a preview"]
    driver.shown(LevelScreen).attempt.tick(0)
    driver.shown(LevelScreen).keep_replay()
    assert driver.app.notice == "Not saved yet: this is a preview"
    assert not driver.player.records.replays()
    driver.app.pop()
    driver.press("escape")
    assert driver.top() is screen


def test_a_pack_that_was_received_is_changed_only_if_that_is_meant(driver: MenuDriver, path: Path) -> None:
    link = Pack(path).files.link()
    shutil.rmtree(path)
    screen = opened(driver)
    pasted(driver, link)
    text = drawn(driver.app)
    assert "Laundry by the ninja-game developers" in text
    received = screen.path
    before = folder_texts(received)

    def drag() -> None:
        driver.carry(screen.shelves.row_area(2), half(screen, 8))

    driver.press("return")
    assert driver.shown(EpisodeGrid).player is driver.player
    driver.press("escape")
    drag()
    assert driver.shown(MenuScreen).title == "Received: Laundry by the ninja-game developers"
    driver.choose("Cancel")
    assert folder_texts(received) == before
    screen.choose_tray("yours")
    driver.carry(screen.shelves.row_area(1), screen.tray.area)
    assert folder_texts(received) == before, "taken from it, a level is copied"
    assert (screen.folder / "00-0-first-steps.txt").is_file()
    drag()
    driver.choose("Copy it, to change that")
    assert (screen.pack and screen.pack.name, folder_texts(received)) == ("Laundry copy", before)
    drag()
    assert layout(screen.path)[1] == ["01-0", "00-1", "01-1", "01-2"], "the copy asks nothing"
    screen.read_packs(received)
    drag()
    driver.choose("Change it all the same")
    assert layout(received)[1] == ["01-0", "00-1", "01-1", "01-2"]
    assert not (received / "received").exists()
    driver.choose("Undo")
    assert folder_texts(received) == before


def test_a_level_that_was_received_is_edited_only_if_that_is_meant(driver: MenuDriver, path: Path) -> None:
    (path / "received").touch()
    before = folder_texts(path)
    driver.open("Levels")
    browser = driver.shown(Browser)
    driver.choose("Edit")
    with patch("ninja_game.play.menus.browser.Tree.remove", side_effect=PermissionError(13, "Permission denied")):
        driver.choose("Change it all the same")
    assert (driver.top(), "ermission denied" in driver.app.notice) == (browser, True)
    for answer, file in ("Copy it, to change that", None), ("Change it all the same", path / "00-0-first-steps.txt"):
        driver.choose("Edit")
        assert driver.shown(MenuScreen).title == "Received: Laundry"
        assert folder_texts(path) == before
        driver.choose(answer)
        assert driver.shown(EditorScreen).session.source.path == file
        driver.shown(EditorScreen).session.close()
        driver.app.pop()
        assert driver.top() is browser
    assert not (path / "received").exists()


def test_an_empty_place_says_what_it_is_for(driver: MenuDriver, path: Path) -> None:
    packs.new_episode(path, "Empty", 0)
    screen = opened(driver)
    seen = drawn(driver.app)
    assert seen.count("text 'Drag a level' at") + seen.count("text 'Drag a level here' at") >= 2
    assert "of its episode" in screen.tray.empty
    screen.choose_tray("yours")
    assert "into your folder" in screen.tray.empty


def test_a_card_says_how_hard_its_level_is(driver: MenuDriver, path: Path) -> None:
    table = path / "pars.toml"
    table.write_text(table.read_text("utf-8").replace("difficulty = 0.39", "difficulty = 9.00"), "utf-8")
    opened(driver)
    seen = drawn(driver.app)
    assert [seen.count(f"text '{grade}' at") for grade in ("very hard", "medium", "easy")] == [1, 1, 6]


def test_a_card_has_room_for_a_long_name_and_no_gold_where_there_is_none(driver: MenuDriver, path: Path) -> None:
    packs.rename_level(path / "00-0-first-steps.txt", "The Locked Door of Noon")
    packs.rename_episode(path, 1, "Episode 2")
    screen = opened(driver)
    seen = drawn(driver.app)
    assert "text 'The Locked' at" in seen
    assert "text 'Door of Noon' at" in seen
    assert seen.count("text 'Episode 2' at") == 1
    assert seen.count("text 'Episode 1' at") == 1, "beside its name"
    level = screen.shelves.cells[1].level
    assert level
    assert level.pars
    rich = replace(level, pars=replace(level.pars, gold=level.pars.exit))
    screen.shelves.show(
        [PackCell(None, each) for each in (rich, replace(rich, named=replace(rich.named, level=Level())))]
    )
    with patch("ninja_game.play.menus.pack_shelves.draw_all_gold") as mark:
        drawn(driver.app)
    assert mark.call_count == 1


def test_a_pack_needs_no_author_but_is_asked_for_one(
    driver: MenuDriver, monkeypatch: pytest.MonkeyPatch, screen: PackScreen
) -> None:
    driver.choose("New pack...")
    assert "'Author'" in drawn(driver.app), "an empty one is a problem of the pack: nothing says it may be"
    typed(driver, "Walls")
    assert Pack(screen.path).index.author == ""
    assert driver.player.settings.name == ""
    begun: list[Path] = []
    monkeypatch.setattr(screen.packer, "start", begun.append)
    (screen.path / "pars.toml").touch()
    for author, asked in (("", True), ("ida", True), ("ida", False)):
        driver.choose("Make ready")
        if asked:
            form = driver.shown(FormPanel)
            assert (form.title, form.focus) == ("What players see", form.widgets[1])
            form.texts[1] = author
            driver.choose("Make ready")
        assert Pack(screen.path).index.author == author
    assert driver.player.settings.name == "ida"
    (screen.path / "pars.toml").unlink()
    driver.choose("Make ready")
    form = driver.shown(FormPanel)
    assert form.focus is form.widgets[3], "once for what it is about, too"
    form.texts[3] = "About walls"
    driver.choose("Make ready")
    assert Pack(screen.path).index.comment == "About walls"
    driver.choose("Make ready")
    assert begun == [screen.path] * 5


def test_the_next_version_is_proposed_once_the_pack_differs_from_its_zip(
    driver: MenuDriver, path: Path, screen: PackScreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: list[Path] = []
    monkeypatch.setattr(screen.packer, "start", begun.append)
    packs.describe(path, {"author": "", "comment": "Dry by noon"})

    def make_ready(version: str) -> int:
        """The number of the field with the focus."""
        driver.choose("Make ready")
        form = driver.shown(FormPanel)
        assert form.texts[2] == version
        place = [widget is form.focus for widget in form.widgets].index(True)
        form.texts[1] = "ida"
        driver.choose("Make ready")
        assert Pack(path).index.version == version
        pack = Pack(path)
        screen.packer.publish(ReadyPack(pack, [], pack.files.zipped(), "", []))
        return place

    assert make_ready("1") == 1
    driver.choose("Make ready")
    assert (driver.top(), begun) == (screen, [path] * 2), "nothing has changed"
    packs.rename_level(path / "00-0-first-steps.txt", "Steps")
    assert make_ready("2") == 2
    driver.choose("Make ready")
    assert (driver.top(), begun) == (screen, [path] * 4)


def test_a_new_pack_asks_for_its_author_once(driver: MenuDriver, screen: PackScreen) -> None:
    driver.choose("New pack...")
    driver.shown(FormPanel).texts[1] = "ida"
    typed(driver, "Walls")
    assert Pack(screen.path).index.title == "Walls by ida"
    assert driver.player.settings.name == "ida"
    driver.choose("New pack...")
    assert len(driver.shown(FormPanel).texts) == 1
    typed(driver, "Roofs")
    assert Pack(screen.folder / "roofs").index.author == "ida"


def test_each_of_two_problems_of_a_kind_leads_to_its_own_place(driver: MenuDriver, path: Path) -> None:
    level, shown = path / "00-0-first-steps.txt", list[tuple[int, ...]]()
    level.write_text(level.read_text("utf-8") + "mine 5,21\ngauss turret 7,21\n", "utf-8")
    screen = PackScreen(driver.app, lambda _, finding: shown.append(finding.records if finding else ()))
    driver.app.push(screen)
    inside = [problem for problem in problems_of(driver, screen) if "inside a tile" in problem.text]
    for problem in inside:
        assert problem.go
        problem.go()
    assert len(set(shown)) == len(shown) == len(inside) > 1
    assert inside[0].accept
    inside[0].accept()
    typed(driver, "meant")
    accepted = [problem for problem in problems_of(driver, screen) if problem.accepted]
    assert [each.text for each in accepted] == [f"{each.text}. Accepted: meant" for each in inside]
    assert accepted[1].go
    accepted[1].go()
    assert shown[-1] == shown[1]
    driver.app.push(editor := EditorScreen(driver.app, offers_recovered=False))
    assert screen.shelves.cells[1].level
    packs.accept(path, level.name, "no-ninja", "a joke")
    editor.commands.edit_entry(screen.shelves.cells[1].level)
    assert "no-ninja" not in editor.session.accepted, "the pack's check does not accept it either"
    editor.session.examine()
    driver.frames(2)
    text = drawn(driver.app)
    assert "Accepted: meant" in text
    assert "text '!'" not in text
    editor.session.close()
    driver.app.pop()
    packs.take_back(path, level.name, Pack(path).index.accepted[0].code)
    packs.accept(path, level.name, "no-gold-run", "a joke")
    screen.read_packs()
    assert not [problem for problem in problems_of(driver, screen) if problem.accepted], "it is not certified since"


def test_a_new_pack_shows_the_levels_that_are_there(driver: MenuDriver, path: Path, screen: PackScreen) -> None:
    driver.choose("New pack...")
    typed(driver, "Empty")
    assert screen.tray_key == "none", "the folder has none"
    own = driver.player.folder / "levels" / "mine.txt"
    own.write_text((path / "00-0-first-steps.txt").read_text("utf-8"), "utf-8")
    driver.choose("New pack...")
    typed(driver, "Next")
    driver.frames()
    assert (screen.pack and screen.pack.name, screen.tray_key) == ("Next", "yours")
    assert len(screen.tray.cells) == 1


def test_an_author_is_asked_for_once(driver: MenuDriver, path: Path) -> None:
    index, level = path / "pack.toml", path / "00-0-first-steps.txt"
    for file in (index, level):
        lines = file.read_text("utf-8").splitlines(keepends=True)
        file.write_text("".join(line for line in lines if not line.startswith("author")), "utf-8")
    screen = opened(driver)
    assert [finding.code for finding in lint(Pack(path)) if finding.code == "no-author"] == ["no-author"], (
        "the pack's is that of all"
    )
    driver.choose("Problems")
    problem_page(driver)
    driver.choose("Go there")
    form = driver.shown(FormPanel)
    assert form.widgets.index(form.focus) == 1  # type: ignore[arg-type]
    driver.type("ida")
    driver.choose("OK")
    driver.press("escape")
    assert Pack(path).index.author == "ida"
    assert not [finding for finding in lint(Pack(path)) if finding.code == "no-author"]
    assert driver.player.settings.name == "ida"
    shown = {entry.named.author for entry in (screen.pack.levels if screen.pack else ())}
    assert "ida" in shown
    assert "" not in shown
    pack_menus.pack_form(screen, Pack(path))
    driver.shown(FormPanel).texts[1] = "bob"
    driver.choose("OK")
    assert driver.player.settings.name == "ida", "a name that is set stays"


def test_mine_first_counts_packs_and_a_name_is_found_before_a_comment(driver: MenuDriver, path: Path) -> None:
    text = (path / "00-0-first-steps.txt").read_text("utf-8").replace("First Steps", "Zz")
    text = re.sub(r"^comment: .*", "comment: as in Rolling Hills", text, flags=re.MULTILINE)
    (path.parent / "z.txt").write_text(text, "utf-8")
    driver.open("Levels")
    browser = driver.shown(Browser)
    sources = [entry.source for entry in browser.shown]
    assert sources[0] == "yours"
    assert set(sources[1:9]) == {"Laundry"}
    driver.type("rolling")
    assert [entry.title for entry in browser.shown][-1] == "Zz"
    assert len(browser.shown) > 1
    browser.sort_by("name")
    assert [entry.title for entry in browser.shown][-1] == "Zz"
    browser.sort_by("author")
    assert browser.shown[0].title == "Rolling Hills"


def test_a_certificate_that_comes_while_a_list_is_shown_is_seen(driver: MenuDriver, path: Path) -> None:
    certificate = path / "certificates" / "00-1-mind-the-gap.exit.replay.txt"
    text = certificate.read_bytes()
    certificate.unlink()
    driver.open("Levels")
    shown = driver.shown(Browser).shown
    entry = next(each for each in shown if each.named.file == str(path / "00-1-mind-the-gap.txt"))
    assert driver.player.reached(entry, None) == "Not passed yet"
    assert driver.player.own_certificate(entry) is None
    certificate.write_bytes(text)
    assert driver.player.own_certificate(entry)
    assert driver.player.reached(entry, None).startswith("Certified: "), "the pack was read before"


@pytest.mark.parametrize("button", ["Copy the link", "More..."])
def test_a_pack_that_is_gone_or_changed_is_seen_at_once(driver: MenuDriver, path: Path, button: str) -> None:
    shutil.copytree(path, path.with_name("soap"))
    screen = opened(driver)
    packs.describe(path, {"name": "Washing"})
    driver.choose(button)
    assert (screen.pack and screen.pack.name) == "Washing"
    if driver.top() is not screen:
        driver.choose("Cancel")
    path.rename(driver.player.folder / "elsewhere")
    driver.app.notify("")
    driver.choose(button)
    assert driver.top() is screen
    assert (screen.path.name, driver.app.notice) == ("soap", ""), "nothing is done with the other pack"


@pytest.mark.parametrize(
    "buttons", [("Copy of the pack",), ("Name, author, version...", "OK"), ("Delete the pack...", "Delete it")]
)
def test_a_pack_whose_folder_has_gone_meanwhile_ends_nothing(
    driver: MenuDriver, path: Path, buttons: tuple[str, ...], screen: PackScreen
) -> None:
    driver.choose("More...")
    path.rename(driver.player.folder / "elsewhere")
    for button in buttons:
        driver.choose(button)
    assert driver.top() is screen
    assert "No such file" in driver.app.notice


def test_a_zip_is_chosen_from_the_folder_of_downloads_and_kept(
    driver: MenuDriver, screen: PackScreen, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (loaded := tmp_path / "home" / "Downloads" / "new").mkdir(parents=True)
    (loaded / "test.zip").write_bytes(Pack(PACK).files.zipped())
    (loaded / "old.zip").write_bytes(b"")
    os.utime(loaded / "old.zip", (0, 0))
    (loaded / "zz.zip").mkdir()
    (loaded / "notes.txt").write_text("no pack", "utf-8")
    monkeypatch.setattr(Path, "home", lambda: tmp_path / "home")
    driver.choose("Open a zip...")
    files = driver.shown(pack_sharing.ZipsScreen)
    assert files.paths == [tmp_path / "home", loaded], "it begins where browsers put what they load"
    driver.press("down", "return")
    assert [path.name for path in files.paths[1:]] == ["zz.zip", "old.zip", "test.zip"]
    driver.press("return")
    assert driver.shown(PackCard), "the newest zip was chosen already"
    assert [pack.name for pack in screen.own_packs] == ["test pack"]
    assert driver.app.notice == f"test pack: kept among your packs, in {short_path(screen.path)}"


def test_a_file_that_is_not_a_pack_is_refused_where_it_was_chosen(
    driver: MenuDriver, screen: PackScreen, tmp_path: Path
) -> None:
    (bad := tmp_path / "bad.zip").write_bytes(b"no zip")
    driver.choose("Open a zip...")
    driver.shown(pack_sharing.ZipsScreen).open_file(bad)
    assert driver.shown(PackScreen) is screen
    assert "neither a folder nor a zip that can be a pack" in driver.app.notice


def test_a_notice_leaves_the_line_of_hints_free(driver: MenuDriver, path: Path) -> None:
    opened(driver)
    for text in ("Saved", "word " * 40, "word " * 80):
        driver.app.notify(text)
        driver.frames(2)
        rect = driver.app._draw_notice(driver.app.top.theme)
        assert rect.top >= 0
        assert rect.bottom < 200


def test_there_is_one_zip_of_each_version(driver: MenuDriver, path: Path) -> None:
    screen = opened(driver)
    exports = driver.player.folder / "exports"

    def publish(version: str) -> str:
        packs.describe(path, {"version": version})
        pack = Pack(path)
        screen.packer.publish(ReadyPack(pack, [], pack.files.zipped(), "", []))
        assert screen.packer.saved
        return screen.packer.saved.name

    names = ["laundry.zip", "laundry.zip", "laundry-2.zip", "laundry-2.zip", "laundry.zip"]
    assert [publish(version) for version in ("", "", "2", "2", "")] == names
    assert Pack(exports / "laundry-2.zip").index.version == "2"
    packs.describe(path, {"author": "Somebody else"})
    assert publish("") == "laundry-3.zip", "another author's pack is not replaced"
