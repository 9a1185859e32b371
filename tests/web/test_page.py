"""The page from start to record, as players meet it: Chromium, real keys and touches, a visit without network."""

import json
import re
import shutil
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import pytest
from click.testing import CliRunner

from ninja_game.cli.main import cli
from ninja_game.formats.links import level_link, replay_link
from ninja_game.formats.n14.level_string import level_digest, parse_level_string
from ninja_game.runs.run import record_replay
from ninja_game.web.services import PHONE_TEXT
from tests.support.visitor import eventually
from tests.support.web_page import served

TEXT = "0" * 713 + "|5^100,566!11^160,564,130,564"
LEVEL = parse_level_string(TEXT)  # who runs right passes

CERTIFICATE = Path(__file__).parents[2] / "levels" / "certificates" / "00-0-first-steps.exit.replay.txt"

NewVisitor = Callable[..., Any]

DROP = """
text => {
  const files = new DataTransfer();
  files.items.add(new File([text], "short.txt"));
  document.getElementById("stage").dispatchEvent(new DragEvent("drop", { dataTransfer: files, bubbles: true }));
}
"""


def bests(player: Path) -> dict[str, int]:
    """Level digests and last ticks of the bests in a zip of a player's data."""
    with ZipFile(player) as files:
        records = files.extract("records.sqlite", player.parent / "records")
    with closing(sqlite3.connect(records)) as db:
        return dict(db.execute("SELECT level, final_tick FROM replay WHERE id IN (SELECT replay FROM level_best)"))


def pass_short_level(visitor: Any) -> None:
    """Run right in the level that is shown."""
    visitor.until("ready")
    visitor.press("Space")
    visitor.page.keyboard.down("ArrowRight")
    visitor.until("passed")
    visitor.page.keyboard.up("ArrowRight")


def test_a_level_is_passed_with_keys_and_the_record_is_there_offline(new_visitor: NewVisitor, tmp_path: Path) -> None:
    visitor = new_visitor()
    waiting = []

    def answer_later(request: Any) -> None:
        waiting.append(request)

    visitor.page.route("**/python_stdlib.zip", answer_later)
    visitor.page.goto(visitor.address + "play.html", wait_until="commit")
    visitor.page.locator("progress").wait_for()
    visitor.page.get_by_text("Loading the game: ").wait_for()
    eventually(visitor.page, lambda: waiting, "no download of the library")
    waiting.pop().continue_()
    visitor.until("menu")
    visitor.press("ArrowDown", "ArrowRight", "Enter")
    visitor.eventually("type(app.top).__name__ == 'Browser'")
    visitor.page.evaluate(DROP, TEXT)
    visitor.eventually("any(entry.source == 'yours' for entry in app.top.shown)")
    own = visitor.python("[entry.source for entry in app.top.shown].index('yours')")
    visitor.press("Home", *["ArrowDown"] * own, "Enter")
    pass_short_level(visitor)
    # The page keeps itself and its memory once the game runs.
    visitor.page.evaluate("() => navigator.serviceWorker.ready.then(() => ninjaGame.kept)")
    visitor.context.set_offline(True)
    visitor.visit()
    assert visitor.page.evaluate("ninjaGame.fromMemory"), "the second visit is no faster than a first one"
    with visitor.page.expect_download() as download:
        visitor.menu("Save all to a file")
    download.value.save_as(tmp_path / "player.zip")
    assert list(bests(tmp_path / "player.zip")) == [level_digest(LEVEL)]
    assert visitor.problems == []


def test_a_link_of_a_level_is_played_at_once_and_the_data_move_to_another_browser(
    new_visitor: NewVisitor, tmp_path: Path
) -> None:
    visitor = new_visitor()
    visitor.visit(level_link(LEVEL, name="<b>Short</b>"))
    pass_short_level(visitor)
    with visitor.page.expect_download() as download:
        visitor.menu("Save all to a file")
    download.value.save_as(tmp_path / "player.zip")
    other = new_visitor()
    other.visit("#level=1.nonsense")
    assert "This link cannot be opened" in other.page.locator("#panel").inner_text()
    other.page.get_by_role("button", name="Back to the game").click()
    other.page.click("#panel-open")
    other.page.set_input_files("#panel input[accept='.zip']", CERTIFICATE)
    other.page.get_by_text("not a backup of a player's data").wait_for()
    other.page.get_by_role("button", name="Back to the game").click()
    other.page.click("#panel-open")
    other.page.set_input_files("#panel input[accept='.zip']", tmp_path / "player.zip")
    other.page.get_by_text("1 new replays in the records").wait_for()
    with other.loading_again():
        other.page.get_by_role("button", name="Back to the game").click()
    other.until("menu")
    assert other.python("len(app.player.records.level_bests())") == 1
    assert visitor.problems == other.problems == []


def test_a_link_of_replays_is_watched_with_a_ghost(new_visitor: NewVisitor) -> None:
    visitor = new_visitor()
    fast, slow = (record_replay(LEVEL, bytes([0] * wait + [2] * 40)) for wait in (0, 9))
    visitor.visit(replay_link([fast, slow]))
    visitor.until("replay")
    assert visitor.python("len(app.top.runs)") == 2
    # Another link in the same tab.
    visitor.page.evaluate("fragment => (location.hash = fragment)", level_link(LEVEL))
    visitor.until("ready")
    assert visitor.problems == []


@pytest.mark.slow
def test_touch_passes_a_level(new_visitor: NewVisitor) -> None:
    visitor = new_visitor(viewport={"width": 844, "height": 390}, has_touch=True, is_mobile=True, device_scale_factor=2)
    visitor.visit(level_link(LEVEL))
    visitor.until("ready")
    buttons = visitor.page.locator("#touch button:visible")
    for k in range(buttons.count()):
        box = buttons.nth(k).bounding_box()
        assert min(box["width"], box["height"]) >= 44, buttons.nth(k).inner_text()
    assert visitor.python("app.controls.name('left') + ' ' + app.controls.name('confirm')") == "Left Jump"
    assert visitor.python("app.settings.text_size") == PHONE_TEXT
    visitor.page.get_by_role("button", name="Jump").tap()
    visitor.until("play")
    session = visitor.context.new_cdp_session(visitor.page)
    box = visitor.page.get_by_role("button", name="Run left").bounding_box()
    place = {"x": box["x"] + 10, "y": box["y"] + 10}
    session.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [place]})
    visitor.page.wait_for_timeout(200)
    # The finger slides into the other zone.
    box = visitor.page.get_by_role("button", name="Run right").bounding_box()
    session.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [place | {"x": box["x"] + 10}]})
    visitor.until("passed")
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    # One press begins the level and passes it: the finger that began it holds on.
    visitor.page.get_by_role("button", name="Retry").tap()
    visitor.until("ready")
    session.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [place | {"x": box["x"] + 10}]})
    visitor.until("passed")
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    # For who jumps with the left hand.
    right = visitor.page.get_by_role("button", name="Jump").bounding_box()
    visitor.page.locator("#panel-open").tap()
    visitor.page.get_by_label("Size").fill("80")
    visitor.page.get_by_role("button", name="Jump with the left hand").tap()
    visitor.page.get_by_role("button", name="Back to the game").tap()
    for again in (False, True):
        if again:
            with visitor.loading_again():
                visitor.page.reload()
            visitor.until("ready")
        left = visitor.page.get_by_role("button", name="Jump").bounding_box()
        assert (left["x"] < 20, right["x"] > 400) == (True, True)
        assert left["height"] == pytest.approx(0.8 * right["height"], abs=1)
        assert visitor.page.get_by_role("button", name="Run left").bounding_box()["x"] > 500
    assert visitor.problems == []


def test_what_throws_in_a_turn_is_reported_and_nothing_foreign_runs(new_visitor: NewVisitor) -> None:
    visitor = new_visitor()
    visitor.visit()
    assert visitor.problems == []
    assert visitor.page.evaluate(
        "() => { const s = document.createElement('script'); s.textContent = 'window.ran = 1';"
        " document.body.append(s); return typeof window.ran; }"
    ) == "undefined"  # fmt: skip
    assert visitor.page.evaluate("() => fetch('http://localhost:9/').then(() => 1, error => String(error))")
    eventually(visitor.page, lambda: any("Content Security Policy" in each for each in visitor.problems), "no refusal")
    visitor.python("setattr(app, 'advance', lambda ms: 1 // 0)")
    trouble = visitor.page.locator("#trouble[open]")
    trouble.wait_for()
    assert "ZeroDivisionError" in trouble.inner_text()
    visitor.context.grant_permissions(["clipboard-read", "clipboard-write"])
    trouble.get_by_role("button", name="Copy the text").click()
    trouble.get_by_text("Copied").wait_for()
    assert "ZeroDivisionError" in visitor.page.evaluate("navigator.clipboard.readText()")
    with visitor.loading_again():
        trouble.get_by_role("button", name="Load the page again").click()
    visitor.until("menu")


@pytest.mark.slow
def test_a_memory_that_cannot_be_used_is_deleted_and_a_game_that_ends_says_so(new_visitor: NewVisitor) -> None:
    visitor = new_visitor()
    visitor.visit()
    visitor.page.evaluate("() => ninjaGame.kept")
    visitor.page.evaluate(
        "async () => { const cache = await caches.open((await caches.keys())[0]);"
        " const kept = (await cache.keys()).find(request => request.url.includes('memory.bin'));"
        " await cache.put(kept, new Response('0123456789abcdef'.repeat(99))); }"
    )
    visitor.page.reload()
    visitor.until("menu")
    assert not visitor.page.evaluate("ninjaGame.fromMemory")
    # What the game keeps for its next save is there when the page is left.
    ended = "app.player.statistics.attempt_ended('x', killer=None, passed=True, ticks=1, gold=0)"
    visitor.python(f"app.player.store.defer(lambda: {ended} or ())")
    visitor.page.evaluate("() => { ninjaGame.pause(true); return ninjaGame.folder.saving; }")
    visitor.page.reload()
    visitor.until("menu")
    assert visitor.python("app.player.store.connection.execute('SELECT count(*) FROM played').fetchone()[0]") == 1
    visitor.python("app.quit()")
    visitor.page.get_by_text("The game has ended").wait_for()
    assert visitor.problems == []


@pytest.mark.slow
def test_one_tab_at_a_time_writes_the_records(new_visitor: NewVisitor) -> None:
    visitor = new_visitor()
    visitor.visit()
    second = visitor.new_page()
    second.goto(visitor.address + "play.html")
    second.get_by_role("button", name="Play here instead").click()
    second.locator("body[data-state=menu]").wait_for(state="attached")
    assert "opened in another tab" in visitor.page.locator("#trouble[open]").inner_text()


def test_verdicts_in_the_page_are_those_of_the_command(new_visitor: NewVisitor, tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.replay.txt"
    wrong.write_text(re.sub(r"gold: \d+", "gold: 60", CERTIFICATE.read_text("utf-8")), "utf-8")
    visitor = new_visitor()
    visitor.visit()
    visitor.menu("Verify a recording")
    for file in (CERTIFICATE, wrong):
        visitor.page.set_input_files("#panel input[type=file]", file)
        visitor.page.locator("#verdicts", has_text=file.name).locator("table").wait_for()
        shown = json.loads(visitor.page.locator("#verdicts pre").text_content())
        verdict = json.loads(CliRunner().invoke(cli, ["verify", "--json", str(file)]).stdout)
        assert shown | {"file": str(file)} == verdict
        assert all(problem in visitor.page.locator("#verdicts").inner_text() for problem in verdict.get("problems", ()))
    assert "first difference" in visitor.page.locator("#verdicts").inner_text()
    visitor.page.set_input_files("#panel input[type=file]", [{"name": "x", "mimeType": "", "buffer": b"\0\1"}])
    visitor.page.get_by_text("not a text file").wait_for()
    assert visitor.problems == []


@pytest.mark.slow
def test_a_new_version_takes_over_on_the_next_visit(new_visitor: NewVisitor, site: Path, tmp_path: Path) -> None:
    folder = tmp_path / "site"
    shutil.copytree(site, folder)
    with served(folder) as address:
        visitor = new_visitor()
        visitor.address = address
        visitor.visit()
        visitor.page.evaluate("() => navigator.serviceWorker.ready.then(() => ninjaGame.kept)")
        (app,) = folder.glob("app-*")
        before = app.name.removeprefix("app-")
        app.rename(folder / "app-a-new-version")
        for name in ("play.html", "sw.js", "app-a-new-version/build.js"):
            (folder / name).write_text((folder / name).read_text("utf-8").replace(before, "a-new-version"), "utf-8")
        # The page that is open stays as it is, while the new version is fetched.
        visitor.page.evaluate(
            "async () => { const about = await navigator.serviceWorker.ready; const before = about.active;"
            " await about.update(); while (about.active === before || about.active.state !== 'activated')"
            " await new Promise(done => setTimeout(done, 50)); }"
        )
        visitor.visit()
        assert "a-new-version" in visitor.page.locator("script[src$='start.js']").get_attribute("src")
        assert visitor.page.evaluate("caches.keys().then(names => names.length)") == 1
        assert visitor.problems == []
