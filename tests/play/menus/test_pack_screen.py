"""The desk of packs: with mouse, keys and pad levels are moved, marked and named, and each step is undone."""

import re
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from threading import Event
from unittest.mock import patch

import pygame
import pytest

from ninja_game.editor import packs
from ninja_game.editor.files import ascii_text
from ninja_game.files.user_folder import DAILY
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.replay.text import Replay
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.menu_screen import FormPanel, MenuScreen
from ninja_game.play.menus import pack_menus, pack_sharing
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.pack_list import PackList
from ninja_game.play.menus.pack_shelves import PackCell
from ninja_game.play.menus.packer import Packer
from ninja_game.play.menus.packs import PackScreen
from ninja_game.play.menus.problems import Problem, ProblemsScreen
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.search.certificate import verified_run
from ninja_game.search.task import Task
from ninja_game.sim.inputs import with_press_bits
from ninja_game.sim.level import Level
from ninja_game.ui.input.gamepad import BUTTONS
from ninja_game.ui.theme import Area
from tests.support.draw_log import drawn, notice_box, px
from tests.support.level_maker import ROOM
from tests.support.own_pack import PACK, rewrite
from tests.support.pack_desk import Desk, texts_of, titles
from tests.support.waiting import LONGEST


def test_a_level_lands_on_the_side_of_a_card_where_it_is_let_go(desk: Desk, screen: PackScreen) -> None:
    desk.carry(desk.place(1), desk.half(5, right=True), drop=False)
    x, y, w, _ = desk.place(5)
    assert "The colours of a level go by its place" in drawn(desk.app)
    seen, mark = drawn(desk.app), f"fill accent {px(x + w - 2, y + 4)} 4 x"
    assert seen.index(mark) > seen.index("Run and Hop' at 577,"), "not behind what is held"
    desk.mouse_up(desk.half(5, right=True))
    assert desk.layout()[0] == ["00-1", "00-2", "00-3", "00-4", "00-0"]
    desk.carry(desk.place(5), desk.half(2, right=True))
    assert desk.layout()[0] == ["00-1", "00-2", "00-0", "00-3", "00-4"]
    for right in (False, True):
        desk.carry(desk.place(3), desk.half(3, right=right))
        desk.carry(desk.place(3), desk.half(2, right=True))
        assert desk.layout()[0] == ["00-1", "00-2", "00-0", "00-3", "00-4"], "it stays where it was"
    desk.carry(desk.place(3), desk.half(11), drop=False)
    desk.mouse_up(desk.half(11))
    assert desk.layout()[1] == ["01-0", "01-1", "01-2", "00-0"]


def test_cards_make_room_where_a_level_would_land(desk: Desk, screen: PackScreen) -> None:
    def pictures() -> list[tuple[float, float]]:
        with patch.object(screen.thumbnails, "draw") as draw:
            drawn(desk.app)
        return sorted((each.args[3], each.args[2]) for each in draw.call_args_list)

    before = pictures()
    desk.carry(desk.place(1), desk.half(3, right=True), drop=False)
    [_, *now] = sorted(set(pictures()) - set(before), reverse=True)
    assert len(before) - len(set(before) & {*pictures()}) == 3, "what is held leaves its place, two make room"
    [gap] = {round(now_x - x, 6) for (_, now_x), (_, x) in zip(now, reversed(before[3:5]), strict=True)}
    assert gap > 0
    desk.mouse_up((300, 530, 2, 2))
    assert pictures() == before


def test_several_levels_are_marked_and_moved_copied_taken_out_and_deleted_at_once(
    desk: Desk, screen: PackScreen
) -> None:
    shelves, steps = screen.shelves, screen.packer.steps
    desk.click(desk.place(1))
    desk.click(desk.place(3), pygame.KMOD_CTRL)
    assert {Path(file).name[:4] for file in screen.marked} == {"00-0", "00-2"}, "with the one that was clicked before"
    desk.press("escape", "right")
    desk.click(desk.place(5), pygame.KMOD_CTRL)
    assert {Path(file).name[:4] for file in screen.marked} == {"00-4"}, "without one that keys or the beginning chose"
    desk.press("escape")
    desk.click(desk.place(1))
    desk.click(desk.place(3), pygame.KMOD_CTRL)
    desk.click(desk.place(3), pygame.KMOD_CTRL)
    desk.click(desk.place(4), pygame.KMOD_CTRL)
    desk.carry(desk.place(4), desk.half(7, right=True), drop=False)
    assert "2 levels" in drawn(desk.app)
    desk.mouse_up(desk.half(7, right=True))
    assert desk.layout() == {0: ["00-1", "00-2", "00-4"], 1: ["01-0", "00-0", "00-3", "01-1", "01-2"]}
    assert [step.name for step in steps] == ["Move 2 levels"]
    desk.carry(desk.place(8), desk.half(1), drop=False)
    desk.mouse_up(desk.half(1))
    assert desk.layout()[0] == ["00-0", "00-3", "00-1", "00-2", "00-4"], "they stay marked"
    desk.click(desk.place(3))
    assert not screen.marked
    screen.enter()
    desk.click(desk.place(3))
    editor = desk.shown(EditorScreen)
    assert editor.session.name == "Stone to Stone", "a second click opens the editor, however late it comes"
    editor.commands.close()
    desk.click(desk.place(3))
    assert desk.top() is screen, "back here it takes two clicks again"
    desk.click(desk.place(5), pygame.KMOD_SHIFT)
    desk.carry(desk.place(4), desk.half(7))
    assert desk.layout()[0] == ["00-0", "00-3", "00-1", "00-2", "00-4"], "no room for three: all stay"
    assert "episode 2 is full" in desk.app.notice
    shelves.index = 3
    desk.click(desk.place(3))
    desk.click(desk.place(3))
    assert desk.shown(MenuScreen).title == "3 levels"
    assert [each.text for each in desk.shown(MenuScreen).widgets] == ["Move...", "Copy", "Take out", "Cancel"]  # type: ignore[attr-defined]
    desk.choose("Take out")
    assert desk.layout()[0] == ["00-0", "00-3"]
    screen.marked.clear()
    screen.focus = screen.tray
    desk.chord("a", pygame.KMOD_CTRL)
    assert len(screen.marked) == 3
    desk.press("delete")
    deleted = desk.player.folder / "deleted"
    assert len(list(deleted.glob("*.txt"))) == 3
    assert list((deleted / "certificates").iterdir())
    assert len(Pack(desk.path).levels) == 5
    for _ in range(2):
        desk.chord("z", pygame.KMOD_CTRL)
    assert desk.layout()[0] == ["00-0", "00-3", "00-1", "00-2", "00-4"]
    screen.focus, shelves.index = shelves, 3
    desk.press("delete")
    assert desk.layout()[0] == ["00-0", "00-3", "00-2", "00-4"], "in an episode it is taken out"
    desk.click(desk.place(1), pygame.KMOD_CTRL)
    desk.press("escape")
    assert (desk.top(), screen.marked) == (screen, set())


def test_a_level_is_a_calm_frame_above_its_name_until_its_picture_is_made(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    frame = r"fill panel \S+ 81 x 61\.4 radius 0"
    with monkeypatch.context() as waiting:
        waiting.setattr("ninja_game.play.thumbnails.Thumbnails.work", lambda _: False)
        desk.open_packs()
        seen = drawn(desk.app)
        assert len(re.findall(frame, seen)) == 8
        assert "text 'Run and Hop'" in seen
    desk.wait(lambda: not re.search(frame, drawn(desk.app)))


def test_levels_and_episodes_are_dragged(desk: Desk, screen: PackScreen) -> None:
    desk.carry(desk.place(2), desk.half(8))
    assert desk.layout() == {0: ["00-0", "00-2", "00-3", "00-4"], 1: ["01-0", "00-1", "01-1", "01-2"]}
    assert (
        desk.app.notice == "Moved Stone to Stone to episode 2; colours follow the place. Undo, or Ctrl+Z, takes it back"
    )
    desk.carry(desk.place(1), screen.tray.area)
    assert desk.layout()[0] == ["00-2", "00-3", "00-4"]
    assert titles(screen.tray) == ["Run and Hop"]
    assert (
        desk.app.notice
        == "Moved Run and Hop out of its episode; colours follow the place. Undo, or Ctrl+Z, takes it back"
    )
    desk.carry(screen.tray.row_area(0), desk.place(13))
    assert desk.layout()[2] == ["00-0"], "a row below the others is a new episode"
    assert [each.name for each in Pack(desk.path).index.episodes][2] == "Episode 3"
    desk.carry(desk.place(12), desk.place(0))
    assert desk.layout() == {0: ["00-0"], 1: ["00-2", "00-3", "00-4"], 2: ["01-0", "00-1", "01-1", "01-2"]}
    assert (
        desk.app.notice == "Moved episode 3 to the place of 1; colours follow the place. Undo, or Ctrl+Z, takes it back"
    )
    desk.carry(desk.place(1), (300, 530, 2, 2))
    assert desk.layout()[0] == ["00-0"], "let go over nothing it stays"
    assert desk.top() is screen


def test_a_full_episode_says_so(desk: Desk, screen: PackScreen) -> None:
    desk.carry(desk.place(7), desk.place(2))
    assert "episode 1 is full" in desk.app.notice
    assert desk.layout()[1] == ["01-0", "01-1", "01-2"]


def test_keys_alone_move_a_level(desk: Desk, screen: PackScreen) -> None:
    desk.press("right", "return")
    desk.choose("Move...")
    desk.press("down", "return")
    assert desk.layout() == {0: ["00-1", "00-2", "00-3", "00-4"], 1: ["00-0", "01-0", "01-1", "01-2"]}
    desk.press("return")
    desk.choose("Move...")
    desk.click(desk.place(1))
    assert desk.layout() == {0: ["00-0", "00-1", "00-2", "00-3", "00-4"], 1: ["01-0", "01-1", "01-2"]}, "or a click"
    desk.press("return")
    desk.choose("Move...")
    desk.press("escape")
    desk.shown(PackScreen)
    desk.press("escape")
    desk.shown(Browser)


def test_a_pad_alone_makes_a_pack_with_a_level_and_edits_it(empty_desk: Desk) -> None:
    def button(name: str) -> None:
        empty_desk.pad(BUTTONS.index(name))

    empty_desk.open_packs()
    button("a")
    button("dpad-down")
    button("a")
    screen = empty_desk.shown(PackScreen)
    assert [pack.name for pack in screen.own_packs] == ["My pack"]
    button("a")
    assert empty_desk.shown(MenuScreen).title == "Episode 1"
    button("a")
    button("dpad-down")
    button("a")
    assert titles(screen.shelves) == ["New level"]
    assert empty_desk.shown(EditorScreen).session.edited.source.path == screen.path / "new-level.txt"
    empty_desk.shown(EditorScreen).session.close()


def test_a_level_of_the_players_folder_goes_into_the_pack_and_one_of_the_game_is_copied(
    desk: Desk, own: Path, screen: PackScreen
) -> None:
    desk.carry(screen.tray.row_area(0), desk.place(11))
    assert not own.exists()
    assert (desk.path / "mine.txt").exists()
    screen.choose_tray("")
    desk.carry(screen.tray.row_area(0), desk.place(11))
    assert desk.layout()[1][3:] == ["mine", "00-0"]
    desk.carry(desk.place(10), screen.tray.row_area(0))
    assert "cannot be changed: it is the game's own" in desk.app.notice


def test_everything_about_a_pack_is_named_again(desk: Desk, screen: PackScreen) -> None:
    for index, entry, text in ((1, "Rename...", "Early steps"), (0, "Rename...", "Falls"), (0, "New level...", "New")):
        desk.mouse(*(value + 20 for value in desk.place(index)[:2]))
        desk.press("return")
        desk.choose(entry)
        if entry == "New level...":
            desk.fill(text, "OK")
            assert "episode 1 is full" in desk.app.notice
        else:
            desk.fill(text, "OK")
    desk.choose("More...")
    desk.choose("Name, author, version...")
    desk.shown(FormPanel).texts[2] = "2"
    desk.choose("OK")
    pack = Pack(desk.path)
    assert (pack.index.version, pack.index.episodes[0].name) == ("2", "Falls")
    assert pack.levels["00-0-run-and-hop.txt"].name == "Early steps"
    desk.choose("More...")
    desk.choose("Copy of the pack")
    assert [each.name for each in screen.own_packs] == ["Laundry", "Laundry copy"]


def test_an_empty_pack_says_how_it_is_begun_and_a_free_place_makes_a_level(
    empty_desk: Desk, screen: PackScreen
) -> None:
    assert "a zip to open or drop here" in drawn(empty_desk.app)
    empty_desk.choose("New pack...")
    empty_desk.fill("Walls", "OK")
    assert "drag them into the places" in drawn(empty_desk.app)
    empty_desk.choose("New level...")
    empty_desk.fill("Brick", "OK")
    empty_desk.leave_editor()
    assert not [each for each in screen.widgets if getattr(each, "text", "") == "New level..."]
    empty_desk.wait_for_check()
    assert "to mend: Problems, above" in drawn(empty_desk.app)
    screen.choose(screen.shelves.cells[-1])
    assert empty_desk.shown(FormPanel).title == "New episode: name"
    empty_desk.press("escape")
    screen.choose(screen.shelves.cells[2])
    assert empty_desk.shown(FormPanel).title == "New level: its name"
    empty_desk.fill("Mortar", "OK")
    assert empty_desk.layout(screen.path) == {0: ["bric", "mort"]}


def test_levels_of_days_are_no_pack_of_ones_own(desk: Desk) -> None:
    shutil.copytree(desk.path, desk.path.with_name(DAILY))
    assert [pack.path for pack in desk.open_packs().own_packs] == [desk.path]


def test_what_the_editor_certified_is_certified_in_the_folder_too(desk: Desk) -> None:
    levels, name = desk.path.parent, "00-0-run-and-hop"
    shutil.copy(desk.path / f"{name}.txt", levels)
    screen = desk.open_packs()
    screen.choose_tray("yours")
    entry = screen.tray.cells[0].level
    assert entry
    assert screen.status.state(entry) == "no run yet"
    (levels / "certificates").mkdir()
    shutil.copy(desk.path / "certificates" / f"{name}.exit.replay.txt", levels / "certificates")
    screen.read_packs()
    assert screen.status.state(entry) == "certified"
    pack_menus.level_menu(screen, screen.tray.cells[0])
    desk.choose("Watch the run")
    desk.shown(ReplayScreen)
    desk.app.pop()
    pack_menus.level_menu(screen, screen.tray.cells[0])
    desk.choose("Play")
    desk.shown(LevelScreen)


def test_a_run_follows_its_level_into_a_pack_and_a_lost_one_is_reported(
    empty_desk: Desk, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    levels, go_on, reports = empty_desk.player.folder / "levels", Event(), list[str]()
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
    notify = empty_desk.app.notify

    def note(text: str, **_: object) -> None:
        reports.append(text)
        notify(text)

    monkeypatch.setattr(empty_desk.app, "notify", note)
    screen = empty_desk.open_packs()
    screen.choose_tray("yours")
    for index in (0, 1):
        for _ in "12":
            empty_desk.mouse(*(value + 30 for value in screen.tray.row_area(index)[:2]))
        empty_desk.press("f7")
        empty_desk.choose_in_menu("Leave the editor")
        empty_desk.shown(PackScreen)
    empty_desk.carry(screen.tray.row_area(1), empty_desk.place(1))

    def states() -> list[str]:
        return [f"{cell.level.title}: {screen.status.state(cell.level)}" for cell in screen.shelves.cells if cell.level]

    assert states() == ["Walk: no run yet"]
    (levels / "Gap.txt").unlink()
    reports.clear()
    go_on.set()
    empty_desk.wait(lambda: len(reports) == 2)
    assert sorted(reports) == [
        "Gap: no certificate, as no file has the level any more. Open it, and press F7",
        "Walk: certified, 0.975 s, kept with the level",
    ]
    assert (screen.path / "certificates" / "Walk.exit.replay.txt").exists()
    empty_desk.wait(lambda: states() == ["Walk: certified"], "its card says so")


def test_a_pack_that_is_deleted_can_be_found_again(desk: Desk, screen: PackScreen) -> None:
    screen.packer.path, screen.packer.text = desk.path, "Saved: laundry.zip"
    for answer, there in (("Cancel", True), ("Delete it", False)):
        desk.choose("More...")
        desk.choose("Delete the pack...")
        desk.choose(answer)
        assert (desk.path.exists(), bool(screen.own_packs)) == (there, there)
    assert Pack(desk.player.folder / "deleted" / "laundry").name == "Laundry"
    assert not screen.packer.text, "no text about what is gone"
    assert "in the folder deleted/laundry now" in desk.app.notice.replace("\\", "/")


def test_what_is_done_at_the_desk_is_undone_step_by_step(desk: Desk) -> None:
    levels = desk.path.parent
    (levels / "mine.txt").write_text((desk.first).read_text("utf-8"), "utf-8")
    screen = desk.open_packs()
    states = [texts_of(levels)]
    assert not desk.button("Undo").enabled

    def done() -> None:
        desk.frames(2)
        states.append(texts_of(levels))
        assert states[-1] != states[-2]

    desk.carry(desk.place(2), desk.half(8))
    done()
    screen.choose_tray("yours")
    desk.carry(screen.tray.row_area(0), desk.place(11))
    done()
    pack_menus.level_menu(screen, screen.shelves.cells[1])
    desk.choose("Rename...")
    desk.fill("Early steps", "OK")
    done()
    screen.choose(screen.shelves.cells[6])
    desk.choose("Remove the episode")
    done()
    desk.choose("New pack...")
    desk.fill("Other", "OK")
    done()
    desk.press("escape")
    desk.choose("Packs")
    screen = desk.shown(PackScreen)
    screen.read_packs(desk.path)
    desk.choose("More...")
    desk.choose("Delete the pack...")
    assert desk.shown(MenuScreen).title == "Delete Laundry with its 9 levels?"
    assert "All goes to the folder deleted; Undo brings it back" in drawn(desk.app)
    desk.choose("Delete it")
    assert Packer(desk.app).steps == screen.packer.steps, "so it is when the program runs again"
    commands = ["Delete Laundry", "New pack", "Take out Things that hum", "Rename Run and Hop", "Move Run and Hop"]
    for what in [*commands, "Move Stone to Stone"]:
        assert desk.button("Undo").hint == f"Ctrl+Z: {what}"
        desk.chord("z", pygame.KMOD_LCTRL)
        assert desk.app.notice == f"Undone: {what}"
        assert texts_of(levels) == states.pop()
    assert not (levels / "other").exists()
    desk.chord("z", pygame.KMOD_LCTRL)
    assert desk.app.notice == "there is nothing to undo"
    screen.choose(screen.shelves.cells[0])
    desk.choose("Remove the episode")
    packs.describe(desk.path, {"version": "3"})
    desk.choose("Undo")
    assert desk.app.notice == "Take out Learning to fall: not undone, as pack.toml was changed since"
    assert list(desk.layout()) == [1]


def test_a_level_that_comes_from_elsewhere_is_moved_or_with_ctrl_copied_and_that_is_said(
    desk: Desk, own: Path, screen: PackScreen
) -> None:
    free = desk.place(11)
    texts = {pygame.KMOD_LCTRL: "Copied Mine from your folder", 0: "Moved Mine from your folder; Ctrl copies instead"}
    for mods, done in texts.items():
        desk.carry(screen.tray.row_area(0), free, drop=False)
        assert "with Ctrl it is copied" in drawn(desk.app)
        desk.let_go(free, mods)
        assert desk.app.notice == f"{done}. Undo, or Ctrl+Z, takes it back"
        assert (own.exists(), (desk.path / "mine.txt").exists()) == (bool(mods), True)
        desk.choose("Undo")
        assert (own.exists(), (desk.path / "mine.txt").exists()) == (True, False)
    desk.app.notify("")
    desk.carry(desk.place(1), free, drop=False)
    desk.let_go(free, pygame.KMOD_LCTRL)
    assert desk.app.notice.startswith("Copied Run and Hop from Laundry")
    assert desk.layout()[1][3:] == ["run-"]
    assert desk.layout()[0][0] == "00-0"
    desk.app.notify("")
    desk.carry(desk.place(1), desk.half(4))
    assert desk.app.notice == "Moved Run and Hop to episode 1; colours follow the place. Undo, or Ctrl+Z, takes it back"


def test_the_disk_is_read_again_only_when_it_changed(desk: Desk, screen: PackScreen) -> None:
    with patch.object(screen, "read_packs", wraps=screen.read_packs) as read:
        screen.choose(screen.shelves.cells[1])
        read.reset_mock()
        desk.choose("Edit")
        assert read.call_count == 1, "when its menu closes"
        desk.leave_editor()
        assert desk.top() is screen
        read.reset_mock()
        screen.run_step(lambda: packs.rename_episode(desk.path, 0, "Other"), "Rename")
        assert read.call_count == 1
        read.reset_mock()
        with patch("pygame.scrap.get_text", Pack(PACK).files.link):
            pack_sharing.paste(screen)
        assert [read.call_count, screen.path.name] == [1, "test-pack"]


def test_an_episode_is_sorted_by_difficulty(desk: Desk, screen: PackScreen) -> None:
    desk.mouse(*(value + 20 for value in desk.place(0)[:2]))
    desk.press("return")
    desk.choose("Sort by difficulty")
    known = [cell.level.pars.difficulty or 0 for cell in screen.shelves.cells[1:6] if cell.level and cell.level.pars]
    assert known == sorted(known)
    assert desk.layout()[0] != ["00-0", "00-1", "00-2", "00-3", "00-4"]


def test_a_menu_opens_at_the_name_of_the_pack_and_at_a_card(desk: Desk) -> None:
    shutil.copytree(desk.path, desk.path.with_name("soap"))
    packs.describe(desk.path.with_name("soap"), {"name": "Soap"})
    screen = desk.open_packs()
    assert screen.pack_choice

    def right_click(area: Area) -> MenuScreen:
        place = screen.theme.canvas.point(area[0] + area[2] / 2, area[1] + area[3] / 2)
        pygame.event.post(pygame.Event(pygame.MOUSEBUTTONDOWN, pos=place, button=3, touch=False))
        desk.frames()
        return desk.shown(MenuScreen)

    assert right_click(screen.pack_choice.area).title == "Laundry"
    desk.choose("Cancel")
    x, y, w, _ = screen.pack_choice.area
    desk.mouse(x + w - 9, y + 9)
    assert (screen.pack and screen.pack.name) == "Soap", "an arrow shows the next one"
    seen = drawn(desk.app)
    assert "text 'Soap'" in seen
    assert "in the folder soap." in seen
    desk.mouse(x + w / 2, y + 9)
    listed = desk.shown(PackList)
    with patch.object(listed.thumbnails, "draw") as draw:
        assert "8 levels in 2 episodes" in drawn(desk.app)
    titles = [each.args[1].title for each in draw.call_args_list]
    assert titles[:4] == ["Run and Hop", "Wall to Wall", "Every Switch", "Watch and Go"], "four of the eight"
    desk.press("down")
    desk.type("developers")
    assert (len(listed.shown), listed.list.index) == (2, 0), "Enter takes the row that is marked"
    desk.type(" laun")
    assert [each.name for each in listed.shown] == ["Laundry"]
    desk.press("return")
    assert desk.top() is screen
    assert (screen.pack and screen.pack.name) == "Laundry"
    assert "text 'Laundry'" in drawn(desk.app)
    assert right_click(desk.place(1)).title == "Run and Hop"
    desk.choose("Cancel")
    assert right_click(desk.place(0)).title == "Learning to fall"
    desk.choose("Cancel")
    right_click((400, 20, 2, 2))
    assert desk.top() is not screen, "elsewhere it leads back"


def test_what_is_taken_out_is_seen_beside_the_shelves(desk: Desk, screen: PackScreen) -> None:
    screen.choose_tray("yours")
    pack_menus.level_menu(screen, screen.shelves.cells[1])
    desk.choose("Take out")
    assert titles(screen.tray) == ["Run and Hop"]
    screen.choose_tray("yours")
    screen.choose(screen.shelves.cells[0])
    desk.choose("Remove the episode")
    assert len(screen.tray.cells) == 5
    desk.carry(screen.tray.row_area(0), desk.half(4))
    assert desk.layout()[1] == ["01-0", "01-1", "01-2", "00-0"]


def test_an_empty_place_says_what_it_is_for(desk: Desk) -> None:
    packs.new_episode(desk.path, "Empty", 0)
    screen = desk.open_packs()
    seen = drawn(desk.app)
    assert seen.count("text 'Drag a level' at") + seen.count("text 'Drag a level here' at") >= 2
    assert "of its episode" in screen.tray.empty
    screen.choose_tray("yours")
    assert "into your folder" in screen.tray.empty


def test_a_card_says_how_hard_its_level_is(desk: Desk) -> None:
    table = desk.path / "pars.toml"
    rewrite(table, "difficulty = 0.39", "difficulty = 9.00")
    desk.open_packs()
    seen = drawn(desk.app)
    assert [seen.count(f"text '{grade}' at") for grade in ("very hard", "medium", "easy")] == [1, 1, 6]


def test_a_card_has_room_for_a_long_name_and_no_gold_where_there_is_none(desk: Desk) -> None:
    packs.rename_level(desk.first, "The Locked Door of Noon")
    packs.rename_episode(desk.path, 1, "Episode 2")
    screen = desk.open_packs()
    seen = drawn(desk.app)
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
        drawn(desk.app)
    assert mark.call_count == 1


def test_a_new_pack_shows_the_levels_that_are_there(desk: Desk, screen: PackScreen) -> None:
    desk.choose("New pack...")
    desk.fill("Empty", "OK")
    assert screen.tray_key == "none", "the folder has none"
    own = desk.player.folder / "levels" / "mine.txt"
    own.write_text((desk.first).read_text("utf-8"), "utf-8")
    desk.choose("New pack...")
    desk.fill("Next", "OK")
    desk.frames()
    assert (screen.pack and screen.pack.name, screen.tray_key) == ("Next", "yours")
    assert len(screen.tray.cells) == 1


@pytest.mark.parametrize("button", ["Copy the link", "More..."])
def test_a_pack_that_is_gone_or_changed_is_seen_at_once(desk: Desk, button: str) -> None:
    shutil.copytree(desk.path, desk.path.with_name("soap"))
    screen = desk.open_packs()
    packs.describe(desk.path, {"name": "Washing"})
    desk.choose(button)
    assert (screen.pack and screen.pack.name) == "Washing"
    if desk.top() is not screen:
        desk.choose("Cancel")
    desk.path.rename(desk.player.folder / "elsewhere")
    desk.app.notify("")
    desk.choose(button)
    assert desk.top() is screen
    assert (screen.path.name, desk.app.notice) == ("soap", ""), "nothing is done with the other pack"


@pytest.mark.parametrize(
    "buttons", [("Copy of the pack",), ("Name, author, version...", "OK"), ("Delete the pack...", "Delete it")]
)
def test_a_pack_whose_folder_has_gone_meanwhile_ends_nothing(
    desk: Desk, buttons: tuple[str, ...], screen: PackScreen
) -> None:
    desk.choose("More...")
    desk.path.rename(desk.player.folder / "elsewhere")
    for button in buttons:
        desk.choose(button)
    assert desk.top() is screen
    assert "No such file" in desk.app.notice


def test_a_notice_leaves_the_line_of_hints_free(desk: Desk) -> None:
    desk.open_packs()
    for text in ("Saved", "word " * 40, "word " * 80):
        desk.app.notify(text)
        desk.frames(2)
        rect = notice_box(desk.app)
        assert rect.top >= 0
        assert rect.bottom < 200


def test_the_editor_leads_to_the_packs_and_edits_what_is_opened_there(
    desk: Desk, own: Path, screen: PackScreen
) -> None:
    def shelves_of_the_editor() -> PackScreen:
        desk.choose_in_menu("Packs...")
        return desk.shown(PackScreen)

    desk.click(screen.tray.row_area(0))
    desk.click(screen.tray.row_area(0))
    editor = desk.shown(EditorScreen)
    shown = shelves_of_the_editor()
    shown.choose_tray("yours")
    desk.carry(shown.tray.row_area(0), shown.shelves.row_area(11))
    assert not own.exists()
    desk.press("escape")
    assert desk.top() is editor
    assert (editor.session.edited.source.path, editor.session.is_saved) == (desk.path / "mine.txt", True), (
        "it follows its file"
    )
    editor.session.tools.history.change(editor.session.draft.with_tiles({(9, 9): 1}))
    for answer, name in (("Cancel", "Mine"), ("Discard changes", "Run and Hop")):
        shown = shelves_of_the_editor()
        for _ in range(2):
            desk.click(shown.shelves.row_area(1))
        desk.choose(answer)
        assert desk.top() is editor
        assert editor.session.name == name
    shelves_of_the_editor()
    desk.choose("Problems")
    page = desk.problem_page()
    page.problems = [Problem("01-0: odd", go=lambda: shown.edit(shown.levels()[5], None))]
    desk.choose("Go there")
    assert desk.top() is editor
    assert not [other for other in desk.app.stack.screens if isinstance(other, ProblemsScreen)]
    editor.session.close()
