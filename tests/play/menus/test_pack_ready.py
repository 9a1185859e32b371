"""A pack is made ready in the background; its zip and link are what is sent."""

import re
from dataclasses import replace
from pathlib import Path
from threading import Event
from unittest.mock import patch
from zipfile import ZipFile

import pytest

from ninja_game.editor import packs, ready_pack
from ninja_game.editor.ready_pack import Obstacles, ReadyPack, Say
from ninja_game.files.user_folder import short_path
from ninja_game.formats.pack.pack import Pack
from ninja_game.levels.findings import PackFinding, level_finding, pack_finding
from ninja_game.play.menu_screen import FormPanel, MenuScreen
from ninja_game.play.menus import pack_sharing
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.episodes import EpisodeGrid
from ninja_game.play.menus.packs import PackScreen
from ninja_game.play.menus.problems import ProblemsScreen
from tests.support.draw_log import drawn, notice_box
from tests.support.own_pack import rewrite
from tests.support.pack_desk import Desk
from tests.support.waiting import LONGEST


def test_the_page_of_a_pack_without_problems_offers_what_comes_next(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    pack = Pack(desk.path)
    for file in pack.levels:
        packs.accept(desk.path, file, "no-gold-run", "none is meant")
    ready = desk.made()
    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", lambda *_, **__: ready)
    screen = desk.open_packs()
    desk.choose("Problems")
    page = desk.problem_page()
    desk.press("end")
    assert page.selected.text == "Nothing is wrong"
    assert not page.buttons["accept"].enabled
    desk.choose("Make ready")
    assert desk.top() is screen
    desk.wait(lambda: screen.zipped, "it is made ready")
    assert "Send the zip or the link" in drawn(desk.app)
    desk.choose("Problems")
    desk.problem_page()
    desk.press("end")
    assert len(desk.copied_links()) == 1
    assert desk.top() is screen


def test_a_pack_is_made_ready_in_the_background(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    ready = desk.made([pack_finding("no-author", "pack.toml")], "No par times")
    begun = []
    go_on = Event()

    def made(folder: Path, *, seconds: float, jobs: int, say: Say, obstacles: object) -> ReadyPack:
        begun.append(folder)
        say("Making the solver ready", None)
        assert go_on.wait(LONGEST)
        return replace(ready)

    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", made)
    screen = desk.open_packs()
    desk.choose("Make ready")
    desk.wait(lambda: re.fullmatch(r"Making the solver ready: \d+ s", screen.packer.text))
    desk.wait(lambda: "Making the solver ready" in drawn(desk.app))
    assert "fill accent 36,546" not in drawn(desk.app), "no bar where nobody knows how long it takes"
    go_on.set()
    desk.wait(lambda: desk.top() is not screen, "it asks what to do about open problems")
    desk.press("return")
    assert desk.shown(MenuScreen).title == "Laundry: 1 open problem", "it takes no key that was meant for the desk"
    assert screen.zipped is None
    desk.frames(ms=500)
    desk.choose("Show the problems")
    desk.shown(ProblemsScreen)
    desk.press("escape")
    assert desk.top() is screen, "it asks once"
    desk.choose("Make ready")
    desk.wait(lambda: desk.top() is not screen)
    desk.frames(ms=500)
    desk.choose("Zip and link all the same")
    assert "the link is in the clipboard" in desk.app.notice
    zipped = desk.player.folder / "exports" / "laundry.zip"
    assert begun == [desk.path, desk.path]
    assert ZipFile(zipped).namelist()[0] == "laundry/pack.toml"
    saved, rest = f"Saved: {short_path(zipped)}", "the link is in the clipboard"
    assert desk.app.notice == f"{saved}; {rest}"
    notice = notice_box(desk.app)
    assert 0 <= notice.top < notice.bottom <= 96, "the state of the pack, and hints, are read meanwhile"
    assert screen.packer.text == f"{saved}, with 1 open problem (no author); {rest}; No par times"


def test_the_page_of_problems_and_the_desk_go_on_from_a_zip(desk: Desk, zipped: PackScreen) -> None:
    screen = zipped
    assert desk.app.notice
    desk.choose("Problems")
    assert desk.app.notice == "", "its notice goes with the screen"
    assert [problem.step for problem in desk.problem_page().problems] == ["Make ready"]
    assert "0 problems" in drawn(desk.app)
    desk.press("escape")
    assert screen.status.counts() == "8 levels in 2 episodes. Make ready will look for all gold in 8 levels. 0 problems"
    assert screen.status.counts()[:30] in drawn(desk.app)
    assert "laundry.zip" in drawn(desk.app), "it stays"
    assert "clipboard" not in screen.packer.text, "it may hold something else by now"


def test_a_zip_is_sent_until_its_pack_changes(desk: Desk, zipped: PackScreen, monkeypatch: pytest.MonkeyPatch) -> None:
    screen, file = zipped, desk.player.folder / "exports" / "laundry.zip"
    link = Pack(desk.path).files.link()
    assert screen.packer.text.startswith("Saved: ")
    assert "Send the zip or the link" in drawn(desk.app)
    assert desk.button("Make ready")
    opened_folders: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened_folders.append)
    desk.choose("Open the folder")  # a button that comes with the zip
    assert opened_folders == [file.parent.as_uri()]
    desk.carry(desk.place(2), desk.half(8))
    assert "Changed since laundry.zip" in drawn(desk.app)
    assert "Send the zip or the link" not in drawn(desk.app)
    desk.choose("Undo")
    assert f"text 'Saved: {short_path(file)}"[:30] in drawn(desk.app)
    copied = desk.copied_links()
    assert copied[0].endswith(link)


def test_making_ready_goes_on_elsewhere_and_what_is_done_is_seen_at_once(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    go_on = Event()
    certificate = desk.path / "certificates" / "00-0-run-and-hop.exit.replay.txt"
    run = certificate.read_text("utf-8")
    certificate.unlink()

    def made(folder: Path, *, seconds: float, jobs: int, say: Say, obstacles: object) -> ReadyPack:
        say("Certifying, 0 of 1 levels done", 0.0)
        assert go_on.wait(LONGEST)
        go_on.clear()
        certificate.write_text(run, "utf-8")
        say("Certifying, 1 of 1 levels done", 1.0)
        assert go_on.wait(LONGEST)
        return desk.made()

    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", made)
    first = desk.open_packs()
    desk.choose("Make ready")
    desk.choose("More...")
    assert not desk.button("Delete the pack...").enabled
    desk.press("escape", "escape")
    desk.shown(Browser)
    desk.choose("Packs")
    screen = desk.shown(PackScreen)
    assert screen is not first
    desk.wait(lambda: screen.packer.text == "Certifying, 0 of 1 levels done")
    assert "fill accent 36,546" in drawn(desk.app)
    assert desk.button("Stop")

    def state() -> str:
        [entry] = [cell.level for cell in screen.shelves.cells if cell.level and cell.level.title == "Run and Hop"]
        return screen.status.state(entry)

    assert state() == "no run yet", "though its time is measured"
    desk.choose("Problems")
    [to_do] = [problem.text.removeprefix("Nothing is wrong. ") for problem in desk.problem_page().problems]
    assert to_do.startswith("Make ready is at work, and will certify 1 level"), "it has begun"
    desk.press("escape")
    assert to_do in screen.status.counts()
    go_on.set()
    desk.wait(lambda: state() != "no run yet", "the card says so before all is done")
    assert screen.packer.is_busy
    desk.app.push(grid := EpisodeGrid(desk.app, "Laundry"))
    grid.grid.index = 1
    packs.rename_episode(desk.path, 1, "Wash day")
    go_on.set()
    desk.wait(lambda: desk.app.notice == "Laundry is ready to share", "it is shown elsewhere")
    assert (grid.episode and grid.episode.name) == "Wash day", "what is shown there is as new"
    desk.press("escape")
    assert desk.shown(PackScreen).packer.text == (
        f"Saved: {short_path(desk.player.folder / 'exports' / 'laundry.zip')}"
    )
    assert desk.button("Make ready")


def test_what_is_wrong_is_asked_about_before_the_work_and_once(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    packs.describe(desk.path, {"version": "1.1"})
    packs.place(desk.path, [packs.new_level(desk.path, "Brick", "me")], 1)
    later = [pack_finding("same-name", "00-0-run-and-hop.txt", other="x")]
    begun = list[list[PackFinding]]()

    def made(folder: Path, **_: object) -> ReadyPack:
        pack = Pack(folder)
        problems = [*ready_pack.problems_of_pack(pack, {}), *(later if len(begun) == 1 else [])]
        begun.append(problems)
        left = [each for each in problems if each.code == "no-ninja" or each in later]
        return ReadyPack(pack, left, pack.files.zipped(), "", [])

    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", made)
    screen = desk.open_packs()

    def asked(text: str) -> None:
        desk.wait(lambda: desk.top() is not screen, "it asks")
        assert desk.shown(MenuScreen).title == "Laundry: " + text
        desk.frames(ms=500)

    desk.choose("Make ready")
    asked("1 open problem")
    assert not begun, "before the work"
    desk.choose("Show the problems")
    assert [each.text for each in desk.problem_page().problems][:1] == [
        "Brick: there is no ninja: the level cannot be played"
    ]
    desk.press("escape")
    for number in range(3):
        desk.choose("Make ready")
        if number == 0:
            asked("1 open problem")
            desk.choose("Make ready all the same")
        if number == 1:
            asked("1 new problem, 2 open")
            desk.choose("Zip and link all the same")
        desk.wait(lambda: not screen.packer.is_busy)
        assert desk.top() is screen
        assert screen.is_fresh, "what is known is not asked about again, what is new is"
        packs.place(desk.path, ["00-0-run-and-hop.txt"], 1)
    assert len(begun) == 3


def test_what_was_made_ready_asks_only_at_its_own_desk(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    ready = ReadyPack(Pack(desk.path), [pack_finding("no-author", "pack.toml")], b"", "", [])
    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", lambda *_, **__: ready)
    other = packs.new_pack(desk.path.parent, "Other", "me")
    screen = desk.open_packs()
    screen.read_packs(desk.path)
    pack_sharing.prepare_shown(screen)
    screen.read_packs(other)
    desk.wait(lambda: not screen.packer.is_busy)
    desk.frames(3)
    assert desk.top() is screen
    assert desk.app.notice == "Laundry: Neither zip nor link yet: 1 open problem"
    screen.read_packs(desk.path)
    desk.frames(2)
    assert desk.shown(MenuScreen).title == "Laundry: 1 open problem"


def test_a_link_of_levels_without_certificate_is_asked_about(desk: Desk) -> None:
    level = desk.path / "00-1-stone-to-stone.txt"
    rewrite(level, "@", ".", 1)
    screen, copied = desk.open_packs(), list[str]()
    with patch("pygame.scrap.put_text", copied.append):
        desk.choose("Copy the link")
        assert desk.shown(MenuScreen).title == "The link has 1 level without certificate"
        assert not copied
        desk.choose("Copy all the same")
    assert (desk.top(), desk.app.notice, len(copied)) == (screen, "Link copied", 1)
    (desk.path / "received").touch()
    screen.read_packs()
    with patch("pygame.scrap.put_text", copied.append):
        desk.choose("Copy the link")
    assert len(copied) == 2, "it is not for who received it to mend"


def test_what_was_searched_in_vain_is_said_at_once_and_searched_longer_from_its_row(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    pack, go_on, seconds_each, known_each = Pack(desk.path), Event(), list[float](), list[int]()
    (desk.path / "certificates" / "00-0-run-and-hop.exit.replay.txt").unlink()
    level = pack.levels["00-0-run-and-hop.txt"].level

    def made(folder: Path, *, seconds: float, jobs: int, say: Say, obstacles: Obstacles) -> ReadyPack:
        seconds_each.append(seconds)
        known_each.append(len(obstacles))
        obstacles[level, "exit"] = level_finding("unreached-exit")
        say("Certifying, 1 of 1 levels done", 1.0)
        assert go_on.wait(LONGEST)
        return desk.made()

    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", made)
    screen = desk.open_packs()
    path_of_level = str(desk.first)
    desk.wait_for_check()
    assert screen.status.checked
    assert path_of_level not in screen.status.checked.places, "nobody has looked for a run yet"
    desk.choose("Make ready")
    desk.wait(lambda: "no run found" in drawn(desk.app), "the card says so before all is done")
    assert screen.packer.is_busy
    assert all(each.search is None for each in desk.problems())
    go_on.set()
    desk.wait(lambda: not screen.packer.is_busy)
    desk.choose("Problems")
    desk.problem_page()
    assert "the solver never reached it, although it was open" in drawn(desk.app)
    desk.choose("Search for 5 minutes")
    desk.shown(PackScreen)
    desk.wait(lambda: len(seconds_each) == 2)
    assert (seconds_each, known_each) == ([20.0, 300.0], [0, 0]), "this run alone is looked for again"
    desk.wait(lambda: not screen.packer.is_busy)


def test_making_ready_is_stopped(desk: Desk, monkeypatch: pytest.MonkeyPatch) -> None:
    def endless(folder: Path, *, seconds: float, jobs: int, say: Say, obstacles: object) -> ReadyPack:
        while True:
            say("Certifying", 0.5)

    monkeypatch.setattr("ninja_game.play.menus.packer.prepare_pack", endless)
    (desk.path / "certificates" / "00-0-run-and-hop.exit.replay.txt").unlink()
    screen = desk.open_packs()
    assert "text 'no run yet' at" in drawn(desk.app)
    desk.choose("Make ready")
    desk.wait(lambda: screen.packer.text == "Certifying")
    desk.choose("Stop")
    desk.wait(lambda: "Stopped" in screen.packer.text)
    assert drawn(desk.app).count("text 'stopped' at") == 1, "the others are certified"
    desk.choose("Make ready")
    desk.app.run(1)
    desk.wait(lambda: screen.packer.job.is_idle, "it ends with the program")
    screen.packer.update()
    with patch("ninja_game.play.menus.packer.Pack") as read:
        desk.app.run(1)
    assert not read.called, "where nothing is at work, no pack is read at the end"


def test_a_pack_needs_no_author_but_is_asked_for_one(
    empty_desk: Desk, monkeypatch: pytest.MonkeyPatch, screen: PackScreen
) -> None:
    empty_desk.choose("New pack...")
    assert "'Author'" in drawn(empty_desk.app), "an empty one is a problem of the pack: nothing says it may be"
    empty_desk.fill("Walls", "OK")
    assert Pack(screen.path).index.author == ""
    assert empty_desk.player.settings.name == ""
    begun: list[Path] = []
    monkeypatch.setattr(screen.packer, "start", begun.append)
    (screen.path / "pars.toml").touch()
    for author, asked in (("", True), ("ida", True), ("ida", False)):
        empty_desk.choose("Make ready")
        if asked:
            form = empty_desk.shown(FormPanel)
            assert (form.title, form.focus) == ("What players see", form.widgets[1])
            form.texts[1] = author
            empty_desk.choose("Make ready")
        assert Pack(screen.path).index.author == author
    assert empty_desk.player.settings.name == "ida"
    (screen.path / "pars.toml").unlink()
    empty_desk.choose("Make ready")
    form = empty_desk.shown(FormPanel)
    assert form.focus is form.widgets[3], "once for what it is about, too"
    form.texts[3] = "About walls"
    empty_desk.choose("Make ready")
    assert Pack(screen.path).index.comment == "About walls"
    empty_desk.choose("Make ready")
    assert begun == [screen.path] * 5


def test_the_next_version_is_proposed_once_the_pack_differs_from_its_zip(
    desk: Desk, screen: PackScreen, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: list[Path] = []
    monkeypatch.setattr(screen.packer, "start", begun.append)
    packs.describe(desk.path, {"author": "", "comment": "Dry by noon"})

    def make_ready(version: str) -> int:
        """The number of the field with the focus."""
        desk.choose("Make ready")
        form = desk.shown(FormPanel)
        assert form.texts[2] == version
        place = [widget is form.focus for widget in form.widgets].index(True)
        form.texts[1] = "ida"
        desk.choose("Make ready")
        assert Pack(desk.path).index.version == version
        pack = Pack(desk.path)
        screen.packer.publish(ReadyPack(pack, [], pack.files.zipped(), "", []))
        return place

    assert make_ready("1") == 1
    desk.choose("Make ready")
    assert (desk.top(), begun) == (screen, [desk.path] * 2), "nothing has changed"
    packs.rename_level(desk.first, "Steps")
    assert make_ready("2") == 2
    desk.choose("Make ready")
    assert (desk.top(), begun) == (screen, [desk.path] * 4)


def test_a_new_pack_asks_for_its_author_once(empty_desk: Desk, screen: PackScreen) -> None:
    empty_desk.choose("New pack...")
    empty_desk.shown(FormPanel).texts[1] = "ida"
    empty_desk.fill("Walls", "OK")
    assert Pack(screen.path).index.title == "Walls by ida"
    assert empty_desk.player.settings.name == "ida"
    empty_desk.choose("New pack...")
    assert len(empty_desk.shown(FormPanel).texts) == 1
    empty_desk.fill("Roofs", "OK")
    assert Pack(screen.folder / "roofs").index.author == "ida"


def test_there_is_one_zip_of_each_version(desk: Desk) -> None:
    screen = desk.open_packs()
    exports = desk.player.folder / "exports"

    def publish(version: str) -> str:
        packs.describe(desk.path, {"version": version})
        pack = Pack(desk.path)
        screen.packer.publish(ReadyPack(pack, [], pack.files.zipped(), "", []))
        assert screen.zipped
        return screen.zipped.name

    names = ["laundry.zip", "laundry.zip", "laundry-2.zip", "laundry-2.zip", "laundry.zip"]
    assert [publish(version) for version in ("", "", "2", "2", "")] == names
    assert Pack(exports / "laundry-2.zip").index.version == "2"
    packs.describe(desk.path, {"author": "Somebody else"})
    assert publish("") == "laundry-3.zip", "another author's pack is not replaced"


def test_after_a_restart_the_desk_knows_what_the_last_zip_held(desk: Desk, zipped: PackScreen, tmp_path: Path) -> None:
    exports = desk.player.folder / "exports"
    (exports / "laundry-9.zip").write_bytes(b"no zip")
    desk.close()

    def after_a_restart() -> str:
        again = Desk(tmp_path)
        again.open_packs()
        again.wait_for_check()
        has_button = any(getattr(widget, "text", "") == "Open the folder" for widget in again.screen.widgets)
        text = drawn(again.app)
        again.close()
        assert has_button == ("laundry.zip" in text)
        return text

    assert "Send the zip or the link" in after_a_restart()
    rewrite(desk.first, "\ncomment: ", "\ncomment: Well: ", 1)
    text = after_a_restart()
    assert "Changed since laundry.zip" in text
    assert "Nothing is wrong" not in text
    assert "Send the zip" not in text
    (exports / "laundry.zip").unlink()
    assert "laundry.zip" not in after_a_restart()
