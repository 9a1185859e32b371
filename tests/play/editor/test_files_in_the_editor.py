"""Files in the editor: saved, asked about, offered again, taken from the clipboard and the command line."""

import json
import os
import shutil
from dataclasses import replace
from hashlib import sha256
from math import inf
from pathlib import Path
from zipfile import ZipFile

import pygame
import pytest

from ninja_game.cli.main import cli
from ninja_game.editor.files import Autosave, Source, ascii_text, kept_history, lost_drafts, new_source, open_source
from ninja_game.files.bundled import CHECKOUT, bundled_levels
from ninja_game.files.user_folder import EDITING
from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.play.app import App
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.menu_screen import FormPanel, Menu
from ninja_game.play.menus.browser import Browser, LevelChoice
from ninja_game.play.menus.good_levels import GoodLevelsScreen
from ninja_game.player.backup import read_backup, write_backup
from ninja_game.signals import Terminated
from ninja_game.sim.grid import is_inside
from tests.support.draw_log import drawn
from tests.support.level_maker import ROOM, Maker
from tests.support.own_pack import PACK
from tools.draw.screens import written


def test_saved_levels_are_in_the_browser_at_once(room: Maker, tmp_path: Path) -> None:
    room.chord("s", pygame.KMOD_LCTRL)
    path = tmp_path / "levels" / "room.txt"
    assert level_digest(load_levels(path)[0].level) == level_digest(ROOM.level)
    assert room.editor.session.is_saved
    room.choose_in_menu("Leave the editor")
    assert isinstance(room.top(), MainMenu)
    room.open("Levels")
    assert "Room" in [entry.title for entry in room.top().entries]  # type: ignore[attr-defined]
    assert not list((tmp_path / EDITING).glob("*")) if (tmp_path / EDITING).exists() else True


def test_a_level_of_the_browser_is_edited_and_played_as_it_is_then(room: Maker) -> None:
    room.chord("s", pygame.KMOD_LCTRL)
    assert room.app.notice.startswith("Saved, and in the menu Levels: ")
    room.choose_in_menu("Leave the editor")
    browser = room.opened("Levels", Browser)
    assert [entry.source for entry in browser.shown[:2]] == ["yours", "game"]
    change = next(widget for widget in browser.widgets if getattr(widget, "text", "") == "Edit")
    room.mouse(*change.centre)
    assert room.draft == ROOM
    room.drag((300, 300))
    room.chord("s", pygame.KMOD_LCTRL)
    room.choose_in_menu("Leave the editor")
    assert room.top() is browser
    assert browser.entries[0].named.level.tile(12, 12) == 1


def test_a_level_that_is_opened_again_can_be_undone_as_before(room: Maker, tmp_path: Path) -> None:
    room.drag((300, 300))
    drawn = room.draft
    room.chord("s", pygame.KMOD_LCTRL)
    assert kept_history(tmp_path, room.editor.session.edited.source.digest, drawn).steps(9) == ([ROOM], []), "at once"
    path = room.editor.session.edited.source.path
    assert path
    room.drag((400, 300))
    lost = room.draft
    room.choose_in_menu("Leave the editor")
    room.choose("Discard changes")
    room.open("Editor")
    path = path.rename(tmp_path / "elsewhere.txt")
    room.editor.commands.open_file(path)
    assert room.draft == drawn
    for before in (lost, drawn, ROOM, ROOM):
        room.chord("z", pygame.KMOD_LCTRL)
        assert room.draft == before
    room.choose_in_menu("Leave the editor")
    room.choose("Discard changes")
    path.write_text(path.read_text("utf-8") + "; by somebody else\n", "utf-8")
    room.open("Editor")
    room.editor.commands.open_file(path)
    assert not room.editor.session.tools.history.can_undo


def test_a_level_that_is_opened_again_says_what_is_undone_and_what_is_as_saved(room: Maker) -> None:
    room.drag((300, 300))
    room.press("f2")
    room.fill("Pit", "OK")
    room.press("f2")
    room.shown(FormPanel).texts[1] = "ida"
    room.choose("OK")
    room.chord("s", pygame.KMOD_LCTRL)
    path = room.editor.session.edited.source.path
    assert path
    room.choose_in_menu("Leave the editor")
    room.open("Editor")
    room.editor.commands.open_file(path)
    for key, says, state in (
        ("z", "Undone: author", "not saved"), ("z", "Undone: 1 cell", "not saved"),
        ("z", "Nothing to undo", "not saved"), ("y", "Redone: 1 cell", "not saved"),
        ("y", "Redone: author. Now as saved", "saved"), ("y", "Nothing to redo", "saved"),
    ):  # fmt: skip
        room.chord(key, pygame.KMOD_LCTRL)
        picture = drawn(room.app)
        assert f"text '{says}'" in picture, "a name that is in the file is no step of its own"
        assert f"text 'pit.txt: {state}'" in picture


@pytest.mark.parametrize("zipped", [False, True])
def test_a_level_of_the_players_own_pack_is_saved_into_the_pack(maker: Maker, tmp_path: Path, *, zipped: bool) -> None:
    folder = tmp_path / "levels" / "laundry"
    shutil.copytree(PACK, folder)
    index = folder / "pack.toml"
    index.write_text(index.read_text("utf-8").replace("test pack", "Laundry"), "utf-8")
    if zipped:
        shutil.make_archive(str(folder), "zip", folder)
        shutil.rmtree(folder)
    maker.open("Levels")
    maker.press("up")
    maker.type("laundry run")
    maker.choose("Edit")
    maker.drag((300, 300))
    maker.chord("s", pygame.KMOD_LCTRL)
    files = sorted(path.name for path in (tmp_path / "levels").iterdir())
    assert files == (["laundry.zip", "run-and-hop.txt"] if zipped else ["laundry"])
    saved = tmp_path / "levels" / "run-and-hop.txt" if zipped else folder / "00-0-run-and-hop.txt"
    assert load_levels(saved)[0].level == maker.draft.level


def test_a_name_is_asked_for_where_there_is_none(maker: Maker, tmp_path: Path) -> None:
    maker.open("Editor")
    maker.drag((300, 300))
    maker.chord("s", pygame.KMOD_LCTRL)
    assert isinstance(maker.top(), FormPanel)
    for _ in range(8):
        maker.press("backspace")
    maker.type("bd")
    maker.choose("Save")
    assert isinstance(maker.top(), EditorScreen)
    assert (maker.draft.name, maker.editor.session.edited.source.path) == ("bd", tmp_path / "levels" / "bd.txt")
    assert sum(maker.draft.level.tiles) == 1
    (tmp_path / "levels" / "other.txt").write_text("somebody's")
    maker.editor.commands.save_as()
    maker.fill("other")
    assert "already exists" in maker.top().title  # type: ignore[attr-defined]
    maker.choose("Cancel")
    assert maker.draft.name == "bd", "what was not saved is not renamed"


def test_leaving_asks_about_what_is_not_saved(room: Maker, tmp_path: Path) -> None:
    room.drag((300, 300))
    room.choose_in_menu("Leave the editor")
    assert isinstance(room.top(), Menu)
    room.choose("Cancel")
    assert isinstance(room.top(), EditorScreen)
    room.choose_in_menu("Leave the editor")
    room.choose("Discard changes")
    assert isinstance(room.top(), MainMenu)
    assert not list((tmp_path / "levels").iterdir())


@pytest.mark.parametrize("asked", ["Leave the editor", "Open...", "New"])
@pytest.mark.parametrize("named", [True, False])
def test_saving_first_goes_on_with_what_was_asked(maker: Maker, tmp_path: Path, asked: str, *, named: bool) -> None:
    maker.open("Editor")
    maker.editor.session.begin(Source(ROOM if named else replace(ROOM, name="")))
    maker.drag((300, 300))
    drawn = maker.draft
    maker.choose_in_menu(asked)
    maker.choose("Save")
    if not named:
        assert isinstance(maker.top(), FormPanel)
        maker.choose("Save")
    assert len(list((tmp_path / "levels").iterdir())) == 1
    if asked == "New":
        maker.choose("A room")
        assert maker.draft == new_source("", room=True).draft
        maker.press("f5")
        maker.keys.script = [2] * 300
        maker.press("right")
        maker.frames(320)
        assert maker.editor.session.edited.playtests.shown[-1].over, "a room can be passed as it is"
        maker.press("space")
        assert isinstance(maker.top(), EditorScreen)
    else:
        assert isinstance(maker.top(), MainMenu if asked == "Leave the editor" else LevelChoice)
    assert load_levels(next((tmp_path / "levels").iterdir()))[0].level == drawn.level


def unwatched(maker: Maker) -> None:
    """The editor does not see by itself that its file changes."""
    maker.editor.session.edited.looked_at = inf


def watched(maker: Maker) -> None:
    """The editor looks at its file now."""
    maker.editor.session.edited.looked_at = -inf
    maker.frames(2)


def test_a_file_that_changes_on_the_disk_is_shown_at_once(room: Maker, tmp_path: Path) -> None:
    room.chord("s", pygame.KMOD_LCTRL)
    path = tmp_path / "levels" / "room.txt"
    watched(room)
    assert isinstance(room.top(), EditorScreen), "its own save is no change"
    saved = path.read_text("utf-8")
    path.write_text(saved.replace("name: Room", "name: Hall!"), "utf-8")
    watched(room)
    assert (room.draft.name, room.editor.session.is_saved) == ("Hall!", True)
    room.chord("z", pygame.KMOD_LCTRL)
    assert room.draft == ROOM
    path.write_text("ninja-game level 1\nrubbish", "utf-8")
    watched(room)
    assert (room.draft, "rubbish" in room.app.notice) == (ROOM, True)
    path.write_text(saved.replace("name: Room", "name: Gallery"), "utf-8")
    watched(room)
    assert room.top().title == "Another program has changed room.txt"  # type: ignore[attr-defined]
    room.choose("Keep what is here")
    watched(room)
    assert (room.draft, isinstance(room.top(), EditorScreen)) == (ROOM, True), "it asks once"
    path.write_text(saved.replace("name: Room", "name: Corridor"), "utf-8")
    watched(room)
    room.choose("Load the file")
    assert (room.draft.name, room.editor.session.is_saved) == ("Corridor", True)
    path.unlink()
    watched(room)
    assert room.draft.name == "Corridor"


def test_saving_first_stays_where_it_was_not_saved(room: Maker, tmp_path: Path) -> None:
    room.chord("s", pygame.KMOD_LCTRL)
    unwatched(room)
    path = tmp_path / "levels" / "room.txt"
    path.write_text(path.read_text("utf-8") + "; by hand\n", "utf-8")
    room.drag((300, 300))
    room.choose_in_menu("Leave the editor")
    room.choose("Save")
    assert room.top().title == "Another program has changed room.txt"  # type: ignore[attr-defined]
    room.choose("Cancel")
    assert isinstance(room.top(), EditorScreen)
    assert (path.read_text("utf-8")[-10:], room.editor.session.is_saved) == ("; by hand\n", False)
    room.choose_in_menu("Leave the editor")
    room.choose("Save")
    room.choose("Replace it")
    assert isinstance(room.top(), MainMenu)
    assert load_levels(path)[0].level.tile(12, 12) == 1


def test_a_file_that_another_program_changed_is_loaded_again(room: Maker, tmp_path: Path) -> None:
    room.chord("s", pygame.KMOD_LCTRL)
    path = tmp_path / "levels" / "room.txt"
    unwatched(room)
    path.write_text(path.read_text("utf-8").replace("name: Room", "name: Hall"), "utf-8")
    room.drag((300, 300))
    room.chord("s", pygame.KMOD_LCTRL)
    room.choose("Load it again")
    assert (room.draft.name, room.draft.level, room.editor.session.is_saved) == ("Hall", ROOM.level, True)


def test_what_was_not_saved_when_the_program_died_is_offered(room: Maker, tmp_path: Path) -> None:
    room.drag((300, 300))
    session = room.editor.session
    room.wait(lambda: list((tmp_path / EDITING).glob("*.json")), "autosave")
    lost = session.draft
    session.edited.autosave.close(keep=True)
    room.app.stack.clear()
    room.app.push(MainMenu(room.app))
    assert room.button("Editor").hint == "Not saved last time: Room"
    room.open("Levels")
    room.choose("Edit")
    assert isinstance(room.top(), EditorScreen), "nothing lies over a level that was just chosen"
    room.choose_in_menu("Leave the editor")
    room.press("escape")
    room.open("Editor")
    assert isinstance(room.top(), Menu)
    assert "Not saved last time: Room" in room.top().title  # type: ignore[attr-defined]
    room.mouse(*room.button("Keep for later").centre, click=False)
    assert room.shown(Menu).focus is room.button("Recover"), "a mouse that rests where the row appears chooses nothing"
    room.frames(40)
    room.press("return")
    assert room.draft == lost
    assert not room.editor.session.is_saved
    room.chord("z", pygame.KMOD_LCTRL)
    assert room.draft == ROOM
    room.chord("y", pygame.KMOD_LCTRL)
    assert room.draft == lost
    room.chord("s", pygame.KMOD_LCTRL)
    room.wait(lambda: not list((tmp_path / EDITING).glob("*.json")), "end of the autosave")


def test_what_another_window_goes_on_with_is_not_recovered_twice(room: Maker, tmp_path: Path) -> None:
    room.drag((300, 300))
    room.wait(lambda: list((tmp_path / EDITING).glob("*.json")), "autosave")
    room.editor.session.edited.autosave.close(keep=True)
    room.app.stack.clear()
    room.app.push(MainMenu(room.app))
    room.open("Editor")
    present = room.editor.session.draft
    elsewhere = Autosave(tmp_path, next(lost_drafts(tmp_path)).file)
    room.choose("Recover")
    assert "another window continues with this" in room.app.notice
    assert room.draft == present
    elsewhere.close()


@pytest.mark.parametrize("there", [False, True])
def test_what_a_backup_brings_is_never_saved_where_it_says(there: bool, maker: Maker, tmp_path: Path) -> None:
    victim = tmp_path / "profile"
    if there:
        victim.write_text("mine")
    text = ascii_text(replace(ROOM, comment="$(touch marker)"))
    kept = {"path": str(victim), "digest": sha256(b"mine").hexdigest(), "level": text}
    write_backup(maker.app.player, tmp_path / "all.zip")
    with ZipFile(tmp_path / "all.zip", "a") as archive:
        archive.writestr(f"{EDITING}/a.json", json.dumps(kept))
    read_backup(maker.app.player, (tmp_path / "all.zip").read_bytes())
    maker.open("Editor")
    maker.choose("Recover")
    maker.chord("s", pygame.KMOD_LCTRL)
    assert maker.editor.session.edited.source.path == tmp_path / "levels" / "room.txt"
    assert victim.exists() == there
    assert not there or victim.read_text() == "mine"


def test_a_path_that_somebody_put_among_the_autosaves_by_hand_counts_for_nothing(maker: Maker, tmp_path: Path) -> None:
    victim = tmp_path / "profile"
    victim.write_text("mine")
    (tmp_path / EDITING).mkdir()
    kept = {"path": str(victim), "digest": sha256(b"mine").hexdigest(), "level": ascii_text(ROOM)}
    (tmp_path / EDITING / "a.json").write_text(json.dumps(kept))
    maker.open("Editor")
    maker.choose("Recover")
    maker.chord("s", pygame.KMOD_LCTRL)
    assert victim.read_text() == "mine"
    assert (tmp_path / "levels" / "room.txt").is_file()


def test_what_is_drawn_when_a_signal_ends_the_program_is_kept(
    room: Maker, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ninja_game.editor.files._SPACING", 1e9)
    room.drag((300, 300))
    session = room.editor.session

    def end(_: int) -> None:
        raise Terminated

    monkeypatch.setattr(room.app, "frame", end)
    with pytest.raises(Terminated):
        room.app.run()
    session.edited.autosave.close(keep=True)
    assert [found.draft for found in lost_drafts(tmp_path)] == [session.draft]


def test_levels_of_the_game_open_as_new_ones_and_own_ones_in_their_files(room: Maker, tmp_path: Path) -> None:
    own = tmp_path / "levels" / "own.txt"
    own.write_text("; a comment\n" + Path("levels/00-0-first-steps.txt").read_text("utf-8"), "utf-8")
    room.chord("o", pygame.KMOD_LCTRL)
    choice = room.shown(LevelChoice)
    index = next(k for k, entry in enumerate(choice.shown) if entry.source == "yours")
    choice.play(index)
    assert room.editor.session.edited.source.path == own
    room.drag((300, 60))
    room.chord("s", pygame.KMOD_LCTRL)
    assert own.read_text("utf-8").startswith("; a comment\n")
    room.chord("o", pygame.KMOD_LCTRL)
    room.top().play(1)  # type: ignore[attr-defined]
    assert room.editor.session.edited.source.path is None


def test_strings_of_n_travel_by_the_clipboard(room: Maker) -> None:
    session = room.editor.session
    session.copy_string()
    room.drag((300, 300))
    changed = room.draft
    session.paste_string()
    assert level_digest(room.draft.level) == level_digest(ROOM.level)
    room.chord("z", pygame.KMOD_LCTRL)
    assert room.draft == changed
    pygame.scrap.put_text("nothing of the kind")
    session.paste_string()
    assert "no level in the clipboard" in room.app.notice
    assert room.draft == changed


def test_pictures_and_the_solvers_run_can_be_kept(room: Maker, tmp_path: Path) -> None:
    room.choose_in_menu("Export a picture")
    assert list((tmp_path / "exports").glob("room-1.png"))
    room.choose_in_menu("Save the run that was found")
    assert "Certify the level first" in room.app.notice


def test_the_command_edit_opens_a_level(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NINJA_GAME_HOME", str(tmp_path))
    file = tmp_path / "a.txt"
    file.write_bytes(Path("levels/00-0-first-steps.txt").read_bytes())
    picture = tmp_path / "a.png"
    opened = []

    def editor(app: App, source: Source | None = None) -> EditorScreen:
        opened.append(source.path if source else None)
        return EditorScreen(app, source)

    monkeypatch.setattr("ninja_game.play.editor.screen.EditorScreen", editor)
    for level in (["00-0-run-and-hop"], [os.path.relpath(bundled_levels()[0])], [str(file)], []):
        with pytest.raises(SystemExit) as ended:
            cli.main(["edit", *level, "--frames", "3", "--screenshot", str(picture)])
        assert ended.value.code == 0
        assert picture.stat().st_size > 1000
    assert opened == [None, None, file, None], "the game's own levels are not written to"
    with pytest.raises(SystemExit) as ended:
        cli.main(["edit", str(file), "--record", "3"])
    assert ended.value.code == 2
    assert replace(open_source(file).draft) == open_source(file).draft


def test_good_levels_are_shown_with_notes_and_opened_as_copies(
    room: Maker, root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(CHECKOUT, "levels", root / "levels")
    room.choose_in_menu("Ten good levels")
    screen = room.shown(GoodLevelsScreen)
    assert len(screen.levels) == 10
    for level in screen.levels:
        assert (bool(level.about), len(level.notes)) == (True, 4)
        assert all(is_inside((column, row)) for column, row, _ in level.notes)
    page = (root / "docs" / "good-levels.md").read_text("utf-8")
    assert written(page, screen.levels) == page, "`python3 tools/dev.py docs` writes the chapter"
    room.press("down")
    vars(room.app.player.catalogue).pop("ours", None)
    room.editor.session.tools.history.change(new_source().draft)
    room.choose("Edit a copy")
    room.choose("Discard changes")
    assert isinstance(room.top(), EditorScreen)
    assert (room.draft.name, room.editor.session.edited.source.path) == ("Rolling Hills", None)
    room.wait(lambda: room.editor.session.certifier.text.startswith("Certified: "), "an unchanged copy's certificate")


def test_the_level_that_was_changed_last_is_the_first_to_open(room: Maker, tmp_path: Path) -> None:
    text = Path("levels/00-0-first-steps.txt").read_text("utf-8")
    for name, changed in (("a", 1.0), ("b", 3.0), ("c", 2.0)):
        own = tmp_path / "levels" / f"{name}.txt"
        own.write_text(text.replace("First Steps", name), "utf-8")
        os.utime(own, (changed, changed))
    room.chord("o", pygame.KMOD_LCTRL)
    assert [entry.title for entry in room.shown(LevelChoice).shown[:4]] == ["b", "c", "a", "Run and Hop"]
    room.press("return")
    assert room.draft.name == "b"


def test_enter_in_the_search_opens_the_only_level_that_is_found(room: Maker) -> None:
    room.chord("s", pygame.KMOD_LCTRL)
    room.chord("o", pygame.KMOD_LCTRL)
    choice = room.shown(LevelChoice)
    assert [choice.selected and choice.selected.source, choice.watch_author.enabled] == ["yours", False]
    assert "Certify" in choice.watch_author.hint
    room.type("every switch")
    assert len(choice.shown) == 1
    room.press("return")
    assert room.draft.name == "Every Switch"
