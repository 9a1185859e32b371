"""A player's own levels in the list of all levels: certificates, and the authors' runs."""

import re
from unittest.mock import patch

from ninja_game.files.user_folder import DAILY
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.play.menu_screen import MenuScreen
from ninja_game.play.menus.browser import Browser
from tests.support.draw_log import drawn
from tests.support.own_pack import rewrite
from tests.support.pack_desk import Desk, texts_of


def test_the_authors_run_of_ones_own_level_needs_no_medal(desk: Desk) -> None:
    desk.app.change_settings(name="the ninja-game team")
    (desk.path / "certificates" / "00-1-stone-to-stone.exit.replay.txt").unlink()
    browser = desk.opened("Levels", Browser)
    seen = []
    for name in ("the ninja-game team", "Ida"):
        desk.app.change_settings(name=name)
        for index in (0, 1):
            desk.press("home", *["down"] * index)
            seen.append(browser.watch_author.hint or browser.watch_author.enabled)
    certify = "none is known: Certify, in the editor, finds one"
    assert seen == [True, certify, "earn a gold medal to watch it", "none is known"]


def test_ones_own_level_with_its_certificate_is_certified(desk: Desk) -> None:
    assert desk.player.settings.name == "", "whoever has no name has levels too"
    path = desk.path
    rewrite(path / "00-1-stone-to-stone.txt", "@", ".", 1)
    desk.open("Levels")
    for index, wanted_text in enumerate(("Certified: 3.900 s", "Not passed yet")):
        desk.shown(Browser).list.index = index
        assert wanted_text in re.findall("text '(.*?)' at 436,408", drawn(desk.app))
    assert drawn(desk.app).count("text 'certified' at") == 7, "of the eight rows"
    (path / "received").touch()
    for _ in ("received", "of days"):
        desk.shown(Browser).enter()
        assert desk.player.reached(desk.shown(Browser).shown[0], None) == "Not passed yet"
        assert "text 'certified' at" not in drawn(desk.app)
        path = path.rename(path.with_name(DAILY))
        (path / "received").unlink(missing_ok=True)


def test_a_level_that_was_received_is_edited_only_if_that_is_meant(desk: Desk) -> None:
    (desk.path / "received").touch()
    before = texts_of(desk.path)
    browser = desk.opened("Levels", Browser)
    desk.choose("Edit")
    with patch("ninja_game.play.menus.browser.Tree.remove", side_effect=PermissionError(13, "Permission denied")):
        desk.choose("Change it all the same")
    assert (desk.top(), "ermission denied" in desk.app.notice) == (browser, True)
    for answer, file in ("Copy it, to change that", None), ("Change it all the same", desk.first):
        desk.choose("Edit")
        assert desk.shown(MenuScreen).title == "Received: Laundry"
        assert texts_of(desk.path) == before
        desk.choose(answer)
        assert desk.shown(EditorScreen).session.edited.source.path == file
        desk.leave_editor()
        assert desk.top() is browser
    assert not (desk.path / "received").exists()


def test_mine_first_counts_packs_and_a_name_is_found_before_a_comment(desk: Desk) -> None:
    text = (desk.first).read_text("utf-8").replace("Run and Hop", "Zz")
    text = re.sub(r"^comment: .*", "comment: as in Long Slope", text, flags=re.MULTILINE)
    (desk.path.parent / "z.txt").write_text(text, "utf-8")
    browser = desk.opened("Levels", Browser)
    sources = [entry.source for entry in browser.shown]
    assert sources[0] == "yours"
    assert set(sources[1:9]) == {"Laundry"}
    desk.type("slope")
    assert [entry.title for entry in browser.shown][-1] == "Zz"
    assert len(browser.shown) > 1
    browser.sort_by("name")
    assert [entry.title for entry in browser.shown][-1] == "Zz"
    browser.sort_by("author")
    assert browser.shown[0].title == "Long Slope"


def test_a_certificate_that_comes_while_a_list_is_shown_is_seen(desk: Desk) -> None:
    certificate = desk.path / "certificates" / "00-1-stone-to-stone.exit.replay.txt"
    text = certificate.read_bytes()
    certificate.unlink()
    desk.open("Levels")
    shown = desk.shown(Browser).shown
    entry = next(each for each in shown if each.named.file == str(desk.path / "00-1-stone-to-stone.txt"))
    assert desk.player.reached(entry, None) == "Not passed yet"
    assert desk.player.own_certificate(entry) is None
    certificate.write_bytes(text)
    assert desk.player.own_certificate(entry)
    assert desk.player.reached(entry, None).startswith("Certified: "), "the pack was read before"
