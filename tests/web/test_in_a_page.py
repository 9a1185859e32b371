"""What a page lacks (threads, Numba, NumPy, Pillow) is said where it is asked for, and nothing throws."""

import json
from typing import Any

import pytest

from ninja_game.play.editor.session import LEVEL_PICTURE_WIDTH
from ninja_game.runtime import ONLY_ON_A_DESKTOP
from tests.support.web_page import SIZE

START = """
import json, os, sys
os.environ["NINJA_GAME_HOME"] = "/player-of-a-page"
import boot, js
boot.start(js.host)
app = boot.app()
def frames(count=3):
    for _ in range(count):
        app.frame(25)
def told(action):
    import pygame
    pygame.event.get()  # what other tests left in the same page
    app.stack.clear()
    return json.dumps(globals()[action]())
def daily():
    from ninja_game.play.menus.daily import DailyScreen
    app.push(DailyScreen(app))
    frames()
    return app.top.message
def film():
    from ninja_game.files.bundled import bundled_replays
    from ninja_game.formats.load import load_replays
    from ninja_game.play.replay.screen import ReplayScreen
    app.push(ReplayScreen(app, load_replays(bundled_replays()[0])))
    frames()
    app.top.start_export()
    frames()
    return app.notice
def certify():
    from ninja_game.play.editor.screen import EditorScreen
    app.push(EditorScreen(app))
    frames()
    session = app.top.session
    session.certifier.start(session.draft.level)
    return session.certifier.text
def findings():
    from ninja_game.play.editor.screen import EditorScreen
    app.push(EditorScreen(app))
    frames(40)
    return app.top.session.edited.examination.job.result is not None
def picture():
    app.push(__import__("ninja_game.play.boss", fromlist=["BossScreen"]).BossScreen(app))
    frames()
    app.keep_screenshot()
    return head_of(app.notice)
def level_picture():
    from ninja_game.play.editor.screen import EditorScreen
    app.push(EditorScreen(app))
    app.top.session.export_picture()
    return head_of(app.notice)
def head_of(notice):
    with open(__import__("os").path.expanduser(notice.removeprefix("Saved: ")), "rb") as file:
        data = file.read()
    return [data[:8].hex(), int.from_bytes(data[16:20]), int.from_bytes(data[20:24])]
def modules():
    return sorted({name.partition(".")[0] for name in sys.modules})
"""


@pytest.fixture(scope="module")
def report(python: Any) -> Any:
    """What an action of the page above tells."""
    python.evaluate("text => { python.runPython(text); }", START)
    return lambda action: json.loads(python.evaluate("name => python.globals.get('told')(name)", action))


@pytest.mark.parametrize("action", ["daily", "film", "certify"])
def test_what_only_a_desktop_can_do_is_said(action: str, report: Any) -> None:
    assert ONLY_ON_A_DESKTOP in report(action)


def test_pictures_are_saved_as_png(report: Any) -> None:
    png = b"\x89PNG\r\n\x1a\n".hex()
    assert report("picture") == [png, *SIZE]
    assert report("level_picture") == [png, LEVEL_PICTURE_WIDTH, round(LEVEL_PICTURE_WIDTH * 600 / 792)]


def test_the_editor_judges_a_level_without_a_thread(report: Any) -> None:
    assert report("findings") is True


def test_only_what_is_needed_is_loaded(report: Any) -> None:
    loaded = set(report("modules"))
    assert {"ninja_game", "pygame", "sqlite3"} <= loaded
    assert not loaded & {"numpy", "click", "rich", "platformdirs", "PIL", "numba", "multiprocessing", "asyncio.events"}
