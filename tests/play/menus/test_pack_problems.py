"""The problems of a pack: each leads to its place, and is accepted with a reason."""

import re
from threading import Event, Thread, current_thread, main_thread
from unittest.mock import patch

import pytest

from ninja_game.editor import packs
from ninja_game.editor.message_rows import MessageField
from ninja_game.formats.pack.pack import Pack
from ninja_game.levels.findings import PackFinding, pack_finding
from ninja_game.play.editor.messages_screen import MessagesScreen
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.menu_screen import BACK, FormPanel
from ninja_game.play.menus import pack_menus
from ninja_game.play.menus.episodes import EpisodeGrid
from ninja_game.play.menus.packs import PackScreen
from ninja_game.play.menus.problems import ProblemsScreen
from ninja_game.runs.packs import lint
from tests.support.draw_log import drawn
from tests.support.own_pack import rewrite
from tests.support.pack_desk import Desk
from tests.support.waiting import LONGEST


def test_a_problem_leads_to_its_place_and_is_accepted_with_a_reason(desk: Desk) -> None:
    level = desk.first
    rewrite(level, "name: Run and Hop\n", "")
    desk.open_packs()
    desk.choose("Problems")
    screen = desk.problem_page()
    assert [problem.text for problem in screen.problems] == [
        "00-0-run-and-hop: no name",
        "Make ready will look for all gold in 8 levels",
    ]
    count = len(screen.problems)
    desk.press("return")
    assert desk.shown(EditorScreen).session.edited.source.path == level
    desk.leave_editor()
    desk.choose("Accept it...")
    before = (desk.path / "pack.toml").read_bytes()
    for empty in ("", "  "):
        desk.type(empty)
        desk.press("return")
        assert (desk.app.notice, (desk.path / "pack.toml").read_bytes()) == ("Write why", before)
        desk.shown(FormPanel)
    desk.fill("found on the street", "OK")
    assert desk.problem_page() is screen
    assert screen.problems[0].text == "00-0-run-and-hop: no name. Accepted: found on the street"
    assert (screen.list.index, screen.focus) == (0, screen.list), "the choice stays at its row"
    assert Pack(desk.path).index.accepted[0].reason == "found on the street"
    desk.choose("Take it back")
    desk.problem_page()
    assert (len(screen.problems), Pack(desk.path).index.accepted) == (count, ())
    desk.choose("Accept it...")
    desk.fill("found on the street", "OK")
    packs.rename_level(level, "Run and Hop")
    desk.app.push(EpisodeGrid(desk.app, "Laundry"))
    desk.press("escape")
    desk.problem_page()
    assert [problem.step for problem in screen.problems] == ["Make ready"], "what is mended meanwhile is gone"
    assert Pack(desk.path).index.accepted
    desk.mouse(BACK[0] + 10, BACK[1] + 10)
    desk.shown(PackScreen)


def test_a_problem_of_a_message_leads_to_the_message(desk: Desk) -> None:
    level = desk.first
    says = re.sub("\nsays: .*", "\nsays: start: Go | start: On | trap: Never", level.read_text("utf-8"))
    level.write_text(says, "utf-8")
    desk.open_packs()
    desk.choose("Problems")
    page = desk.problem_page()
    row = next(k for k, problem in enumerate(page.problems) if "'Never' is never shown" in problem.text)
    desk.click(page.list.row_area(row))
    desk.choose("Go there")
    screen = desk.shown(MessagesScreen)
    assert (screen.list.index, screen.edited.rows[2].text) == (2, "Never")
    assert screen.focus is screen.form.fields[MessageField.TEXT]
    desk.choose("Cancel")
    assert desk.shown(EditorScreen).session.edited.source.path == level
    desk.leave_editor()


def test_problems_begin_with_the_first_open_one_whose_lines_lie_within_its_frame(desk: Desk) -> None:
    for file in ("00-0-run-and-hop.txt", "00-1-stone-to-stone.txt"):
        level = desk.path / file
        level.write_text(re.sub("name: .*\n", "", level.read_text("utf-8"), count=1), "utf-8")
    packs.accept(desk.path, "00-0-run-and-hop.txt", "no-name", "found on the street, " * 8)
    desk.open_packs()
    desk.choose("Problems")
    page = desk.problem_page()
    assert [problem.accepted for problem in page.problems] == [True, False, False]
    assert (page.list.index, page.selected.text) == (1, "00-1-stone-to-stone: no name")
    _, y, _, h = page.list.row_area(0)
    first, second = (float(top) for top in re.findall(r"street.* at 54,(\S+) size 10", drawn(desk.app)))
    assert (first - y, y + h - second - 13) == (6, 6), "as far from the upper edge as from the lower one"


def test_problems_are_looked_for_in_the_background(
    desk: Desk, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    go_on = Event()
    request.addfinalizer(go_on.set)
    threads: list[Thread] = []

    def found(*_: object) -> list[PackFinding]:
        threads.append(current_thread())
        assert go_on.wait(LONGEST)
        return [pack_finding("no-author", "pack.toml")]

    monkeypatch.setattr("ninja_game.play.menus.packer.problems_of_pack", found)
    desk.open_packs()
    desk.choose("Problems")
    assert "text 'Looking for problems: 0 s'" in drawn(desk.app)
    with patch.object(ProblemsScreen, "draw_frame", autospec=True, side_effect=ProblemsScreen.draw_frame) as draw:
        desk.frames(40, 50)
    assert draw.call_count == 2, "once a second"
    assert "text 'Looking for problems: 2 s'" in drawn(desk.app)
    go_on.set()
    with patch.object(ProblemsScreen, "draw_frame", autospec=True, side_effect=ProblemsScreen.draw_frame) as draw:
        assert desk.problem_page().problems[0].text == "The pack has no author"
        desk.frames()
    assert draw.called, "and what was found at once"
    assert main_thread() not in threads
    assert "1 problem'" in drawn(desk.app)


def test_a_check_that_fails_ends_the_wait_for_it(
    desk: Desk, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    go_on = Event()
    request.addfinalizer(go_on.set)

    def fail(*_: object) -> list[PackFinding]:
        assert go_on.wait(LONGEST)
        raise OSError(5, "the disk cannot be read")

    monkeypatch.setattr("ninja_game.play.menus.packer.problems_of_pack", fail)
    screen = desk.open_packs()
    desk.choose("Problems")
    assert "text 'Looking for problems: 0 s'" in drawn(desk.app)
    go_on.set()
    assert [problem.text for problem in desk.problem_page().problems] == ["the disk cannot be read"]
    assert "text '1 problem'" in drawn(desk.app)
    desk.press("escape")
    assert "the disk cannot be read" in screen.status.counts()
    monkeypatch.setattr("ninja_game.play.menus.packer.problems_of_pack", lambda *_: [])
    index = desk.path / "pack.toml"
    index.write_text(index.read_text("utf-8") + "\n", "utf-8")
    assert [problem.text for problem in desk.problems()] != ["the disk cannot be read"]


def test_problems_speak_of_what_is_seen_not_of_files(desk: Desk) -> None:
    (desk.path / "pars.toml").unlink()
    packs.describe(desk.path, {"author": ""})
    packs.new_episode(desk.path, "", 0)
    screen = desk.open_packs()
    texts = [problem.text for problem in desk.problems() if not problem.step]
    assert texts == ["The pack has no author", "Episode 3 has no name", "Episode 3 has no levels"]
    assert "medal times" in screen.status.to_do()


def test_a_remark_about_the_order_names_levels_and_can_be_accepted(desk: Desk) -> None:
    rewrite(desk.path / "pars.toml", "difficulty = 0.39", "difficulty = 5.00")
    desk.open_packs()
    remarks = [problem for problem in desk.problems() if problem.accept]
    assert [problem.text for problem in remarks] == [
        "Run and Hop: hard, harder than Stone to Stone (easy), but comes right before it",
        "Run and Hop: hard: the first level is the hardest of the pack",
    ]


def test_what_changed_is_marked(desk: Desk) -> None:
    level = desk.path / "00-1-stone-to-stone.txt"
    rewrite(level, "@", ".", 1)
    screen = desk.open_packs()
    stale = [cell.level.title for cell in screen.shelves.cells if cell.level and cell.level.pars is None]
    assert stale == ["Stone to Stone"]
    assert screen.status.counts().startswith("8 levels in 2 episodes. Make ready will certify 1 level")
    desk.wait_for_check()
    assert [screen.status.state(cell.level) for cell in screen.shelves.cells if cell.level][1] == "changed"
    packs.place(desk.path, [packs.new_level(desk.path, "Empty", "me")], 1)
    screen.enter()
    desk.wait_for_check()
    assert screen.status.counts().startswith("9 levels in 2 episodes. Make ready will certify 2 levels")
    [entry] = [each.level for each in screen.shelves.cells if each.level and each.level.title == "Empty"]
    assert screen.status.state(entry) == "no run yet"
    no_ninja = [problem for problem in desk.problems() if "there is no ninja" in problem.text]
    assert [(problem.text[:5], problem.accept) for problem in no_ninja] == [("Stone", None), ("Empty", None)]


def test_each_of_two_problems_of_a_kind_leads_to_its_own_place(desk: Desk) -> None:
    level, shown = desk.first, list[tuple[int, ...]]()
    level.write_text(level.read_text("utf-8") + "mine 5,21\ngauss turret 7,21\n", "utf-8")
    screen = desk.screen = PackScreen(desk.app, lambda _, finding: shown.append(finding.records if finding else ()))
    desk.app.push(screen)
    inside = [problem for problem in desk.problems() if "inside a tile" in problem.text]
    for problem in inside:
        assert problem.go
        problem.go()
    assert len(set(shown)) == len(shown) == len(inside) > 1
    assert inside[0].accept
    inside[0].accept()
    desk.fill("meant", "OK")
    accepted = [problem for problem in desk.problems() if problem.accepted]
    assert [each.text for each in accepted] == [f"{each.text}. Accepted: meant" for each in inside]
    assert accepted[1].go
    accepted[1].go()
    assert shown[-1] == shown[1]
    desk.app.push(editor := EditorScreen(desk.app, offers_recovered=False))
    assert screen.shelves.cells[1].level
    packs.accept(desk.path, level.name, "no-ninja", "a joke")
    editor.commands.edit_entry(screen.shelves.cells[1].level)
    assert "no-ninja" not in editor.session.edited.accepted, "the pack's check does not accept it either"
    editor.session.examine()
    desk.frames(2)
    text = drawn(desk.app)
    assert "Accepted: meant" in text
    assert "text '!'" not in text
    editor.session.close()
    desk.app.pop()
    packs.take_back(desk.path, level.name, Pack(desk.path).index.accepted[0].code)
    packs.accept(desk.path, level.name, "no-gold-run", "a joke")
    screen.read_packs()
    assert not [problem for problem in desk.problems() if problem.accepted], "it is not certified since"


def test_an_author_is_asked_for_once(desk: Desk) -> None:
    index, level = desk.path / "pack.toml", desk.first
    for file in (index, level):
        lines = file.read_text("utf-8").splitlines(keepends=True)
        file.write_text("".join(line for line in lines if not line.startswith("author")), "utf-8")
    screen = desk.open_packs()
    assert [finding.code for finding in lint(Pack(desk.path)) if finding.code == "no-author"] == ["no-author"], (
        "the pack's is that of all"
    )
    desk.choose("Problems")
    desk.problem_page()
    desk.choose("Go there")
    form = desk.shown(FormPanel)
    assert form.widgets.index(form.focus) == 1  # type: ignore[arg-type]
    desk.type("ida")
    desk.choose("OK")
    desk.press("escape")
    assert Pack(desk.path).index.author == "ida"
    assert not [finding for finding in lint(Pack(desk.path)) if finding.code == "no-author"]
    assert desk.player.settings.name == "ida"
    shown = {entry.named.author for entry in (screen.pack.levels if screen.pack else ())}
    assert "ida" in shown
    assert "" not in shown
    pack_menus.pack_form(screen, Pack(desk.path))
    desk.shown(FormPanel).texts[1] = "bob"
    desk.choose("OK")
    assert desk.player.settings.name == "ida", "a name that is set stays"
