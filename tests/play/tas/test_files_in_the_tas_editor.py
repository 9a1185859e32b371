"""Files on the TAS editor: saved, asked about, kept, offered again after a kill; Edit in the replay viewer."""

from dataclasses import replace
from pathlib import Path
from unittest.mock import patch

import pygame
import pytest

from ninja_game.files.bundled import data_folder
from ninja_game.formats.load import load_replays
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.play.menu_screen import FormPanel, Menu
from ninja_game.play.panels.help import HelpPage
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.runs.verify import verify_recording
from ninja_game.sim.inputs import KEY_LEFT
from ninja_game.tas.journal import JOURNAL_FOLDER, lost_runs
from ninja_game.tas_editor.commands import TAS_COMMANDS, RunCommands
from ninja_game.tas_editor.level.other_runs import OtherRunScreen
from ninja_game.tas_editor.opening import open_tas_editor
from ninja_game.tas_editor.screen import TasScreen
from ninja_game.ui.theme import Theme
from tests.play.tas.conftest import RUN
from tests.support.draw_log import notice_box
from tests.support.own_pack import PACK
from tests.support.samples import SPIKED, WALK, running, write_records
from tests.support.scripted import scripted_app, tap
from tests.support.tas_driver import TasDriver

CTRL, SHIFT = pygame.KMOD_LCTRL, pygame.KMOD_LSHIFT


def change(at: TasDriver, tick: int = 20) -> None:
    """Press another key in a tick."""
    at.editor.edit(lambda track: track.with_key(tick, tick + 1, KEY_LEFT, down=not track.keys_at(tick) & KEY_LEFT))


def journals(at: TasDriver) -> list[Path]:
    return list((at.app.player.folder / JOURNAL_FOLDER).glob("*"))


def test_every_command_of_the_table_is_offered_by_some_part(at: TasDriver) -> None:
    assert set(at.screen.commands()) == {command.name for command in TAS_COMMANDS.commands}


def test_keys_of_the_file_menu_work_while_it_is_open(at: TasDriver) -> None:
    change(at)
    at.press("escape")
    at.chord("s", CTRL)
    assert at.session.is_saved
    assert at.top() is at.screen
    at.press("escape")
    at.press("f1")
    assert isinstance(at.top(), HelpPage)


def test_a_run_is_saved_into_its_file(at: TasDriver) -> None:
    path = at.session.file.path
    assert path is not None
    change(at)
    at.chord("s", CTRL)
    assert at.app.notice == f"Saved: {path} and its branches beside it"
    assert notice_box(at.app).right <= at.screen.theme.canvas.rect(*at.screen.roll.area).left
    assert at.session.is_saved
    assert load_replays(path)[0].replay.playback(30) == at.editor.track.inputs[:30]
    assert journals(at) == []


def test_a_run_of_n_is_saved_beside_its_file_under_a_name_that_is_asked_for(tmp_path: Path) -> None:
    file = write_records(tmp_path / "demos.txt", ("a run", WALK, running(30)))
    at = TasDriver(tmp_path / "player", file)
    at.chord("s", CTRL)
    assert at.top().title == f"Save in ...{str(tmp_path)[-38:]}"  # type: ignore[attr-defined]
    at.shown(FormPanel).texts[0] = "  "  # without a name it is the proposed one
    at.choose("Save")
    first = tmp_path / "a-run.replay.txt"
    assert load_replays(first)[0].author == ""
    assert at.app.notice.endswith("; its player is unknown")
    assert at.app.notice.startswith("Saved, without what is behind its exit: ")
    assert at.session.is_saved
    assert at.session.tail_behind(), "here it stays"
    assert verify_recording(load_replays(first)[0]).good
    assert load_replays(first)[0].replay.outcome == "exit"
    at.choose_in_menu("Keep as a replay")
    assert "saved" in at.app.notice
    assert len(at.player.records.replays()) == 1
    at.close()


def test_who_has_no_name_yet_is_asked_for_it_when_an_edited_run_is_saved(tmp_path: Path) -> None:
    at = TasDriver(tmp_path / "player", write_records(tmp_path / "demos.txt", ("a run", WALK, running(30))))
    change(at)
    at.chord("s", CTRL)
    at.shown(FormPanel).texts[1] = "Ann"
    at.choose("Save")
    assert load_replays(tmp_path / "a-run.replay.txt")[0].author == "Ann"
    assert at.app.settings.name == "Ann"
    at.chord("s", CTRL | pygame.KMOD_SHIFT)
    assert len(at.shown(FormPanel).texts) == 1, "once"
    at.close()


def test_keys_behind_a_death_are_saved_without_claims(tmp_path: Path) -> None:
    at = TasDriver(tmp_path / "player", write_records(tmp_path / "demos.txt", ("a run", SPIKED, running(300))))
    assert at.session.timeline.end[1] == "dead"
    at.chord("s", CTRL)
    at.choose("Save")
    assert "Saved, with what is behind its end (Ctrl+E removes it)" in at.app.notice
    path = at.session.file.path
    assert path is not None
    assert load_replays(path)[0].replay.inputs == at.editor.track.inputs
    at.choose_in_menu("Keep as a replay")
    assert "behind the death" in at.app.notice
    at.chord("e", CTRL)
    at.choose_in_menu("Keep as a replay")
    assert "saved" in at.app.notice
    assert len(at.player.records.replays()) == 1
    at.close()


def test_it_is_saved_under_another_name_and_asks_before_it_replaces(at: TasDriver) -> None:
    path = at.session.file.path
    assert path is not None
    taken = path.with_name("taken.replay.txt")
    taken.write_text("somebody's", "utf-8")
    change(at)
    at.chord("s", CTRL, SHIFT)
    at.fill("taken")
    assert at.top().title == "A file named taken.replay.txt already exists"  # type: ignore[attr-defined]
    at.choose("Cancel")
    assert taken.read_text("utf-8") == "somebody's"
    path.write_text(path.read_text("utf-8") + "\n", "utf-8")
    at.chord("s", CTRL)
    assert "nother program has changed" in at.top().title  # type: ignore[attr-defined]
    at.choose("Save under another name")
    for no_folder in ("nowhere", "~nobody there", "long " * 55):
        at.fill(f"{no_folder}/b")
        assert "there is no folder" in at.app.notice
        at.chord("s", CTRL, SHIFT)
    at.fill(str(path.with_name("a:b.replay.txt")))
    assert at.session.file.path == path.with_name("a-b.replay.txt")
    at.chord("s", CTRL)
    assert isinstance(at.top(), TasScreen)


def test_leaving_asks_if_the_run_is_not_saved(at: TasDriver) -> None:
    change(at)
    at.choose_in_menu("Leave")
    assert isinstance(at.top(), Menu)
    at.choose("Cancel")
    assert isinstance(at.top(), TasScreen)
    at.choose_in_menu("Leave")
    at.choose("Discard changes")
    assert not at.app.running
    assert journals(at) == []


def test_save_first_saves_and_leaves(at: TasDriver) -> None:
    change(at)
    wanted = at.editor.track.inputs[:30]
    at.choose_in_menu("Leave")
    at.choose("Save")
    assert not at.app.running
    assert load_replays(at.session.file.path or "")[0].replay.playback(30) == wanted


def test_a_closed_window_keeps_what_is_not_saved_and_it_is_offered(at: TasDriver, tmp_path: Path) -> None:
    change(at)
    at.session.keep_branch("one")
    wanted = at.editor.track
    at.app.stack.clear()
    (found,) = lost_runs(at.app.player.folder)
    assert found.tracks[-1] == wanted
    again = TasDriver(tmp_path / "player", tmp_path / "run.replay.txt")
    assert again.top().title == "Not saved last time: run.replay.txt"  # type: ignore[attr-defined]
    again.choose("Keep for later")
    assert again.editor.track != wanted
    again.app.stack.clear()
    again = TasDriver(tmp_path / "player", tmp_path / "run.replay.txt")
    again.choose("Recover")
    screen = again.shown(TasScreen)
    assert (screen.editor.track, len(screen.session.branches)) == (wanted, 2)
    assert screen.session.file.path == tmp_path / "run.replay.txt"
    again.chord("z", CTRL)
    again.chord("s", CTRL)
    assert screen.editor.track.inputs == load_replays(RUN)[0].replay.playback(10**4)[: len(screen.editor.track)]
    screen.editor.edit(lambda track: track.replaced(0, 0, [1]))
    again.app.stack.clear()
    last = TasDriver(tmp_path / "player", tmp_path / "run.replay.txt")
    last.choose("Discard...")
    last.choose("Keep for later")
    assert len(list(lost_runs(tmp_path / "player"))) == 1
    last.choose_in_menu("Not saved last time...")
    last.choose("run.replay.txt")
    last.choose("Discard...")
    last.choose("Discard")
    assert list(lost_runs(tmp_path / "player")) == []
    last.close()


def test_a_run_of_the_game_is_saved_among_the_players_replays(tmp_path: Path) -> None:
    at = TasDriver(tmp_path / "player", data_folder("levels") / "certificates" / RUN.name)
    at.chord("s", CTRL)
    at.choose("Save")
    assert at.session.file.path is not None
    assert at.session.file.path.parent == tmp_path / "player" / "replays"
    at.close()


def test_what_was_not_saved_of_another_run_is_reported_and_opens_from_the_menu(at: TasDriver, tmp_path: Path) -> None:
    change(at)
    wanted = at.editor.track
    at.app.stack.clear()
    other = write_records(tmp_path / "demos.txt", ("a run", WALK, running(30)))
    again = TasDriver(tmp_path / "player", other)
    assert isinstance(again.top(), TasScreen)
    assert "Not saved last time: run.replay.txt" in again.app.notice
    again.choose_in_menu("Not saved last time...")
    again.choose("run.replay.txt")
    again.choose("Recover")
    screen = again.shown(TasScreen)
    assert screen.editor.track == wanted
    again.close()


def test_a_recovered_run_knows_its_file_and_the_runs_beside_it(tmp_path: Path) -> None:
    file = write_records(tmp_path / "demos.txt", ("a run", WALK, running(30)))
    other = load_replays(write_records(tmp_path / "other.txt", ("other", WALK, running(20))))
    change(at := TasDriver(tmp_path / "player", file))
    at.app.stack.clear()
    again = TasDriver(tmp_path / "player", file)
    again.screen.level.others.open(other)
    again.choose("Recover")
    again.adopt()
    assert again.session.origin.file == str(file)
    assert [each.name for each in again.editor.others] == ["other.txt"]
    again.editor.edit(lambda track: track.replaced(12, 13, [1]))
    again.app.stack.clear()
    again = TasDriver(tmp_path / "player", file)
    again.choose("Recover")
    again.adopt()
    assert ([each.name for each in again.editor.others], again.editor.cursor) == (["other.txt"], 12)
    again.chord("o", CTRL)
    again.wait(lambda: again.shown(OtherRunScreen).rows, "the list")
    assert "other.txt" in [row.text.split()[0] for row in again.shown(OtherRunScreen).rows]
    again.press("escape")
    again.chord("s", CTRL)
    assert again.top().title == f"Save in ...{str(tmp_path)[-38:]}"  # type: ignore[attr-defined]
    again.close()


def test_the_title_is_cut_at_the_names(at: TasDriver) -> None:
    origin = at.session.origin
    replay = replace(origin.replay, co_authors=("somebody with a long name", "another one"), made=Provenance(edits=3))
    at.session.origin = replace(origin, replay=replay)
    with patch.object(Theme, "text", autospec=True, side_effect=Theme.text) as text:
        at.screen.head.paint(pygame.Surface((792, 600)), at.screen.theme)
    title = text.call_args_list[0].args[2]
    assert title.startswith(origin.name)
    assert title.endswith("... (edited)")


def test_the_title_names_the_opened_run_beside_another_whose_keys_it_has(at: TasDriver) -> None:
    origin = at.session.origin
    made = Provenance(edits=3, begun_by="unknown (ann.txt)")
    replay = replace(origin.replay, name="", author="", co_authors=("unknown (mbd.txt)",), made=made)
    at.session.origin = replace(origin, replay=replay)
    with patch.object(Theme, "text", autospec=True, side_effect=Theme.text) as text:
        at.screen.head.paint(pygame.Surface((792, 600)), at.screen.theme)
    assert text.call_args_list[0].args[2].endswith(" - ann.txt, mbd.txt (edited)")


def test_a_closed_window_of_a_saved_run_leaves_nothing(at: TasDriver) -> None:
    change(at)
    at.chord("z", CTRL)
    at.app.stack.clear()
    assert journals(at) == []


def test_a_new_run_of_the_level_opens_over_this_one(at: TasDriver) -> None:
    old, level = at.screen, at.session.origin.level
    at.choose_in_menu("New run on this level")
    at.adopt()
    assert (len(at.editor.track), at.session.origin.level, at.session.file.path) == (0, level, None)
    at.frames(2)
    at.choose_in_menu("Leave")
    assert at.top() is old


def test_help_page_and_viewer_come_from_the_menu(at: TasDriver) -> None:
    at.press("f1")
    assert isinstance(at.top(), HelpPage)
    at.frames(2)
    at.press("escape")
    at.choose_in_menu("Watch")
    viewer = at.shown(ReplayScreen)
    assert viewer.run.inputs == at.editor.track.inputs
    at.press("t")
    assert at.top() is viewer
    at.press("escape")
    at.choose_in_menu("Copy a link")
    assert at.top() is at.screen


def test_edit_in_the_viewer_opens_the_tas_editor(tmp_path: Path) -> None:
    runs = load_replays(write_records(tmp_path / "demos.txt", ("a", WALK, running(23)), ("b", WALK, running(9))))
    other = load_replays(PACK / "certificates" / "00-0-run-and-hop.exit.replay.txt")
    with scripted_app() as (app, _):
        app.tas_editor = open_tas_editor
        viewer = ReplayScreen(app, [*runs, *other])
        app.push(viewer)
        viewer.seek(5)
        tap(app, "edit", pictures=2)
        screen = app.top
        assert isinstance(screen, TasScreen)
        assert (screen.editor.cursor, screen.session.file.path) == (4, None)
        assert screen.editor.track.inputs[:23] == bytes([2] * 23)
        assert [len(each.track) for each in screen.editor.others] == [10]
        screen.files.leave()
        assert app.top is viewer


def test_edit_of_a_file_goes_back_into_it(tmp_path: Path) -> None:
    path = tmp_path / "run.replay.txt"
    path.write_bytes(RUN.read_bytes())
    for changed in (False, True):
        with scripted_app() as (app, _):
            app.tas_editor = open_tas_editor
            app.push(ReplayScreen(app, load_replays(path)))
            if changed:
                path.write_text(path.read_text("utf-8").replace("name:", "; mine\nname:"), "utf-8")
            tap(app, "edit", pictures=2)
            screen = app.top
            assert isinstance(screen, TasScreen)
            assert screen.session.file.path == (None if changed else path)


def test_a_film_is_made_from_the_menu(at: TasDriver) -> None:
    at.choose_in_menu("Film")
    viewer = at.shown(ReplayScreen)
    assert viewer.export is not None
    viewer.export.cancel()


def test_somebody_without_a_name_is_asked_once(at: TasDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(RunCommands, "_asks_name", True)
    at.chord("s", CTRL)
    assert isinstance(at.top(), FormPanel)
    at.press("escape")
    at.chord("s", CTRL)
    assert at.app.notice.startswith("Saved")


def test_a_notice_lies_over_the_floor_of_the_level(at: TasDriver) -> None:
    """Neither the status nor a tab is covered."""
    level = at.screen.theme.canvas.rect(*at.screen.level.area)
    for text in ("one line", "many words " * 15):
        at.app.notify(text)
        assert level.inflate(2, 2).contains(notice_box(at.app)), text
