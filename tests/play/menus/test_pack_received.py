"""Packs that come from elsewhere, by link or zip: they are played, previewed, updated, and copied to be changed."""

import json
import os
import shutil
from pathlib import Path
from unittest.mock import patch

import pygame
import pytest

from ninja_game.editor import packs
from ninja_game.editor.pack_steps import write_file
from ninja_game.files.user_folder import short_path
from ninja_game.formats.links import write_link
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.pack.pack import Pack
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.menu_screen import MenuScreen
from ninja_game.play.menus.episodes import EpisodeGrid
from ninja_game.play.menus.open_pack import ZipsScreen
from ninja_game.play.menus.packs import PackScreen
from ninja_game.player.player_data import save_work
from tests.support.draw_log import drawn, notice_box
from tests.support.menu_driver import MenuDriver
from tests.support.own_pack import PACK, rewrite
from tests.support.pack_desk import Desk, texts_of


def test_a_pack_comes_by_its_link_and_by_ctrl_v(desk: Desk, screen: PackScreen) -> None:
    clipboard = [""]
    with patch("pygame.scrap.put_text", clipboard.append), patch("pygame.scrap.get_text", lambda: clipboard[-1]):
        desk.choose("Copy the link")
        assert desk.app.notice == "Link copied"
        notice = notice_box(desk.app)
        assert not any(notice.colliderect(desk.app.canvas.rect(*each.area)) for each in screen.widgets)
        clipboard.append(f"https://example.org/game/ {clipboard[-1]}\n")
        shutil.rmtree(desk.path)
        screen.enter()
        assert not screen.own_packs
        desk.choose("Paste link")
        assert "Laundry: kept among your packs, in " in desk.app.notice
        assert [pack.name for pack in screen.own_packs] == ["Laundry"]
        first = desk.layout(screen.path)
        desk.chord("v", pygame.KMOD_LCTRL)
        assert len(screen.own_packs) == 1
        assert desk.shown(MenuScreen).title == "Laundry is among your packs already"
        desk.choose("Play it")
        assert desk.shown(EpisodeGrid).player is desk.player
        desk.press("escape")
        packs.rename_episode(screen.path, 0, "Other")
        first = desk.layout(screen.path)
        desk.chord("v", pygame.KMOD_LCTRL)
        desk.choose("Keep both")
        assert len(screen.own_packs) == 2, "it never goes over what is there unasked"
    assert desk.layout(screen.path) == first


def test_another_version_of_a_received_pack_updates_it(desk: Desk, tmp_path: Path) -> None:
    screen, made = desk.open_packs(), tmp_path / "made"
    shutil.move(desk.path, made)
    screen.enter()
    zipped = tmp_path / "laundry.zip"

    def drop() -> None:
        zipped.write_bytes(Pack(made).files.zipped())
        desk.drop_file(zipped)

    drop()
    assert desk.app.notice.startswith("Laundry: kept among your packs, in ")
    assert [(each.name, each.received) for each in screen.own_packs] == [("Laundry", True)]
    before = texts_of(desk.path)
    (made / "00-0-run-and-hop.txt").unlink()
    (made / "00-1-stone-to-stone.txt").write_text((made / "01-0-up-and-away.txt").read_text("utf-8"), "utf-8")
    packs.new_level(made, "Fresh", "me")
    for file in ("00-2", "00-3", "00-4"):
        (level,) = made.glob(f"{file}-*.txt")
        rewrite(level, "\ncomment: ", "\ncomment: Well: ", 1)
    packs.describe(made, {"version": "1.1"})
    drop()
    assert desk.shown(MenuScreen).title == "You have Laundry in another version"
    news = "1 level new: Fresh; 4 levels changed; 1 level gone: Run and Hop"
    assert news in drawn(desk.app), "the texts of a level count too"
    desk.choose("Update it")
    assert desk.app.notice == f"Laundry: {news}"
    assert [(each.name, each.received) for each in screen.own_packs] == [("Laundry", True)]
    assert Pack(desk.path).index.version == "1.1"
    assert packs.same_pack(Pack(desk.path), Pack(made))
    desk.chord("z", pygame.KMOD_CTRL)
    assert texts_of(desk.path) == before
    drop()
    desk.choose("Keep both")
    assert [each.name for each in screen.own_packs] == ["Laundry", "Laundry, 1.1"]


def test_an_update_that_fails_half_way_shows_no_card_and_is_undone(
    desk: Desk, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, screen: PackScreen
) -> None:
    (desk.path / "received").touch()
    screen.enter()
    made, zipped = tmp_path / "made", tmp_path / "laundry.zip"
    shutil.copytree(PACK, made)
    packs.describe(made, {"name": "Laundry", "version": "2"})
    packs.new_level(made, "Fresh", "me")
    zipped.write_bytes(Pack(made).files.zipped())
    before = texts_of(desk.path)

    def full(folder: Path, name: str, content: str | bytes | None) -> None:
        if name == "received":
            raise OSError(28, "No space left on device")
        write_file(folder, name, content)

    with monkeypatch.context() as patched:
        patched.setattr(packs, "write_file", full)
        desk.drop_file(zipped)
        desk.choose("Update it")
    assert "No space left" in desk.app.notice
    assert desk.top() is screen
    desk.choose("Undo")
    assert texts_of(desk.path) == before


def test_what_is_received_is_shown_on_a_card_before_the_desk(desk: Desk, tmp_path: Path) -> None:
    packs.describe(desk.path, {"version": "1.2", "comment": "Dry by noon"})
    zipped = tmp_path / "laundry.zip"
    zipped.write_bytes(Pack(desk.path).files.zipped())
    shutil.rmtree(desk.path)
    desk.drop_file(zipped)
    screen = desk.shown(PackScreen)
    assert screen.focus is desk.button("Play it")
    text = drawn(desk.app)
    for wanted_text in ("Laundry", "by the ninja-game developers, 1.2", "8 levels in 2 episodes", "Dry by noon"):
        assert f"text '{wanted_text}' at" in text
    with patch.object(screen.thumbnails, "draw") as draw:
        drawn(desk.app)
    assert draw.call_count == 4, "its picture"
    desk.press("return")
    assert desk.shown(EpisodeGrid).pack.name == "Laundry"
    desk.press("escape")
    assert desk.top() is screen
    desk.choose("Undo")
    desk.drop_file(zipped)
    desk.choose("Copy it, to change that")
    assert [(pack.name, pack.received) for pack in screen.own_packs] == [("Laundry", True), ("Laundry copy", False)]
    assert (screen.pack and screen.pack.name) == "Laundry copy"


def test_the_link_of_ones_own_pack_can_be_received(desk: Desk, screen: PackScreen) -> None:
    with patch("pygame.scrap.get_text", Pack(desk.path).files.link):
        desk.choose("Paste link")
        desk.choose("Show it as received")
        assert desk.shown(EpisodeGrid).previews
        desk.press("escape")
        desk.choose("Paste link")
        desk.choose("Receive it once more")
    assert [bool(pack.received) for pack in screen.own_packs] == [False, True]
    assert (screen.pack and screen.pack.received, screen.focus) == (True, screen.play_button)


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
    desk: Desk, text: str, wanted_text: str, screen: PackScreen
) -> None:
    before = sorted(desk.path.parent.rglob("*"))
    desk.paste(text)
    assert wanted_text in desk.app.notice
    assert sorted(desk.path.parent.rglob("*")) == before


def test_a_pack_is_played_from_the_desk(desk: Desk, screen: PackScreen) -> None:
    desk.choose("More...")
    desk.choose("Play it")
    assert desk.shown(EpisodeGrid).pack.key == "Laundry"
    desk.press("escape")
    assert desk.top() is screen
    packs.new_pack(desk.path.parent, "Empty", "me")
    screen.read_packs(desk.path.parent / "empty")
    desk.choose("More...")
    assert not desk.button("Play it").enabled


def test_a_pack_is_previewed_as_somebody_who_has_played_nothing(desk: Desk) -> None:
    desk.app.change_settings(name="the ninja-game developers")
    packs.describe(desk.path, {"comment": "Dry by noon"})
    for name, level in Pack(desk.path).levels.items():
        if name.startswith("00"):
            desk.player.marks.passed(level_digest(level.level), 1, 0)
    screen = desk.open_packs()
    desk.choose("Preview")
    grid = desk.shown(EpisodeGrid)
    text = drawn(desk.app)
    assert "text 'Laundry' at 44,58 size 20 bold" in text
    for wanted_text in ("by the ninja-game developers", "Dry by noon"):
        assert f"text '{wanted_text}' at" in text
    assert "text 'seen in practice'" not in text
    assert "text 'Preview as player'" in text
    assert "0 of 8 levels passed" in text
    assert "text '9.200 s'" not in text, "nothing is unlocked, nor raced"
    assert "Not passed yet" in text
    assert f"text '{grid.pack.episodes[1].code}' at" not in text, "it is locked"
    desk.choose("Play")
    run = desk.shown(LevelScreen).playthrough
    assert run.player is grid.player is not desk.player
    assert save_work(run.player, lambda: ["New best"]) == ["New best", "Not saved yet: this is a preview"]
    desk.shown(LevelScreen).attempt.tick(0)
    desk.shown(LevelScreen).keep_replay()
    assert desk.app.notice == "Not saved yet: this is a preview"
    assert not desk.player.records.replays()
    desk.app.pop()
    desk.press("escape")
    assert desk.top() is screen


def test_who_received_a_pack_sees_how_to_play_it_and_none_of_the_makers_tools(desk: Desk) -> None:
    link = Pack(desk.path).files.link()
    shutil.rmtree(desk.path)
    screen = desk.open_packs()
    desk.paste(link)
    text = drawn(desk.app)
    for wanted_text in ("Laundry", "by the ninja-game developers", "Play it", "Update it...", "Open a pack..."):
        assert f"text '{wanted_text}' at" in text
    tools = "Make ready", "Problems", "Preview", "More...", "In no episode", "New episode", "New level", "Drag a level"
    assert not [tool for tool in tools if tool in text]
    received = screen.path
    before = texts_of(received)
    desk.press("return")
    assert desk.shown(EpisodeGrid).player is desk.player
    desk.press("escape")
    desk.chord("a", pygame.KMOD_CTRL)
    desk.press("delete")
    assert screen.pack_choice
    place = screen.theme.canvas.point(*screen.pack_choice.centre)
    pygame.event.post(pygame.Event(pygame.MOUSEBUTTONDOWN, pos=place, button=pygame.BUTTON_RIGHT, touch=False))
    desk.frames(2)
    assert "Name, author, version" not in drawn(desk.app)
    desk.choose("Cancel")
    desk.carry(desk.place(2), desk.half(8))
    assert texts_of(received) == before
    assert not list((desk.player.folder / "exports").iterdir()), "no zip of somebody else's work"
    desk.choose("Copy it, to change that")
    assert (screen.pack and screen.pack.name, texts_of(received)) == ("Laundry copy", before)
    assert desk.button("Make ready")
    desk.carry(desk.place(2), desk.half(8))
    assert desk.layout(screen.path)[1] == ["01-0", "00-1", "01-1", "01-2"]


def test_a_player_opens_a_pack_where_episodes_are_chosen_and_updates_it(
    driver: MenuDriver, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made, home = tmp_path / "made", tmp_path / "home"
    (loaded := home / "Downloads").mkdir(parents=True)
    shutil.copytree(PACK, made)
    (loaded / "test.zip").write_bytes(Pack(made).files.zipped())
    monkeypatch.setattr(Path, "home", lambda: home)
    driver.opened("Episodes", EpisodeGrid)
    driver.choose("Open a pack...")
    driver.choose("From a zip...")
    driver.press("return")
    driver.frames(2)
    screen = driver.shown(PackScreen)
    assert [(pack.name, pack.received) for pack in screen.own_packs] == [("test pack", True)]
    packs.describe(made, {"version": "2"})
    driver.choose("Update it...")
    with patch("pygame.scrap.get_text", Pack(made).files.link):
        driver.choose("From a link")
    driver.frames(2)
    driver.choose("Update it")
    assert [pack.pack and pack.pack.index.version for pack in screen.own_packs] == ["2"]
    driver.press("escape", "escape")
    driver.opened("Episodes", EpisodeGrid)
    with patch("pygame.scrap.get_text", lambda: "a poem"):
        driver.choose("Open a pack...")
        driver.choose("From a link")
    assert "no link of a pack" in driver.app.notice
    driver.shown(EpisodeGrid)


def test_a_zip_is_chosen_from_the_folder_of_downloads_and_kept(
    empty_desk: Desk, screen: PackScreen, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (loaded := tmp_path / "home" / "Downloads" / "new").mkdir(parents=True)
    (loaded / "test.zip").write_bytes(Pack(PACK).files.zipped())
    (loaded / "old.zip").write_bytes(b"")
    os.utime(loaded / "old.zip", (0, 0))
    (loaded / "zz.zip").mkdir()
    (loaded / "notes.txt").write_text("no pack", "utf-8")
    monkeypatch.setattr(Path, "home", lambda: tmp_path / "home")
    empty_desk.choose("Open a zip...")
    files = empty_desk.shown(ZipsScreen)
    assert files.paths == [tmp_path / "home", loaded], "it begins where browsers put what they load"
    empty_desk.press("down", "return")
    assert [path.name for path in files.paths[1:]] == ["zz.zip", "old.zip", "test.zip"]
    empty_desk.press("return")
    assert screen.is_received, "the newest zip was chosen already"
    assert [pack.name for pack in screen.own_packs] == ["test pack"]
    assert empty_desk.app.notice == f"test pack: kept among your packs, in {short_path(screen.path)}"


def test_a_file_that_is_not_a_pack_is_refused_where_it_was_chosen(
    empty_desk: Desk, screen: PackScreen, tmp_path: Path
) -> None:
    (bad := tmp_path / "bad.zip").write_bytes(b"no zip")
    empty_desk.choose("Open a zip...")
    empty_desk.shown(ZipsScreen).open_file(bad)
    assert empty_desk.shown(PackScreen) is screen
    assert "neither a folder nor a zip that can be a pack" in empty_desk.app.notice
