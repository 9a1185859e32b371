"""Every screen of the game, in all its states, against a recorded list of its texts and draw calls in
`tests/play/golden/`: `screens`, and `tas-screens` of the TAS editor, which a page has not.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from types import CodeType

import pytest

from tests.support.draw_log import DrawLog
from tests.support.game_screens import screens_as_texts
from tests.support.recorded import ACCEPT, hold_against
from tests.support.tas_screens import TasLog, tas_editor, with_rows_once
from tools import ROOT

GOLDEN = Path(__file__).parent / "golden"
NAMES = sorted(f"{path.parent.name}/{path.stem}" for path in GOLDEN.glob("*screens/*.txt"))
DRAWS = re.compile(r"_?(draw|paint)(_|$)")
NOT_SHOWN = {
    "play/lab/figure.py: Figure.draw": "its figures do",
    "play/editor/view.py: Overlay._draw_reach": "needs Numba, which a page has not; test_view.py shows it",
    "play/screen.py: BaseScreen.draw": "its screens do",
    "play/workspace.py: Pane.paint": "its parts do",
    "ui/widgets.py: Widget.draw": "its widgets do",
    "play/lab/screen.py: FigurePicture.draw": "of the pages of Learn; test_learn.py shows it",
    "play/replay/film.py: _Panel.draw": "of films, which tests of their own make",
    "play/replay/paths.py: _draw_speeds": "of the pictures that `compare` writes",
    "tas_editor/roll/part.py: RollMouse._paint": "paints keys with the mouse, not a picture",
    "view/overlays.py: _paint_edges": "kept from the first picture on; test_pictures.py shows it",
    "view/overlays.py: _paint_grid": "kept from the first picture on; test_pictures.py shows it",
}
"""Functions of the front end that draw, and why no state of a screen shows what they draw."""


@pytest.fixture(scope="module")
def logs() -> tuple[DrawLog, TasLog]:
    """Of the two tours."""
    return DrawLog(), TasLog()


@pytest.fixture(scope="module")
def screens(tmp_path_factory: pytest.TempPathFactory, logs: tuple[DrawLog, TasLog]) -> dict[str, str]:
    """The text of each screen by its folder and name."""
    game = screens_as_texts(tmp_path_factory.mktemp("player"), log=logs[0])
    tas = with_rows_once(screens_as_texts(tmp_path_factory.mktemp("player"), steps=tas_editor, log=logs[1]))
    return {f"screens/{name}": text for name, text in game.items()} | {
        f"tas-screens/{name}": text for name, text in tas.items()
    }


def drawing_functions() -> Iterator[tuple[str, CodeType]]:
    """All functions and methods of the front end that draw, by file and name."""
    rooms = ("play", "tas_editor", "ui", "view")
    for path in sorted(path for room in rooms for path in (ROOT / "ninja_game" / room).rglob("*.py")):
        found = [compile(path.read_text("utf-8"), str(path), "exec")]
        while found:
            code = found.pop()
            found += [each for each in code.co_consts if isinstance(each, CodeType)]
            if DRAWS.match(code.co_name):
                yield f"{path.relative_to(ROOT / 'ninja_game')}: {code.co_qualname}", code


def test_every_function_that_draws_is_shown_by_some_screen(
    screens: dict[str, str], logs: tuple[DrawLog, TasLog]
) -> None:
    """A new screen, part or tab is in a tour of tests/support, or here with a reason."""
    assert screens
    called = {(Path(code.co_filename), code.co_firstlineno) for log in logs for code in log.called}
    missing = {
        name for name, code in drawing_functions() if (Path(code.co_filename), code.co_firstlineno) not in called
    }
    assert sorted(missing) == sorted(NOT_SHOWN)


def test_what_changes_is_drawn_again(screens: dict[str, str], logs: tuple[DrawLog, TasLog]) -> None:
    assert screens
    assert [name for log in logs for name in log.stale] == []


def test_recorded_screens_are_those_that_there_are(screens: dict[str, str]) -> None:
    if ACCEPT:
        for path in GOLDEN.glob("*screens/*.txt"):
            path.unlink()
        for name, text in screens.items():
            (GOLDEN / name).parent.mkdir(parents=True, exist_ok=True)
            (GOLDEN / f"{name}.txt").write_text(text, "utf-8")
    else:
        assert sorted(screens) == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_screen_is_drawn_as_recorded(screens: dict[str, str], name: str) -> None:
    if ACCEPT:
        return
    hold_against(GOLDEN / f"{name}.txt", screens.get(name, "").split("\n")[:-1])


def test_a_number_of_seconds_says_whether_it_is_a_time_or_the_clock(screens: dict[str, str]) -> None:
    """A time has three decimals on every screen, the clock one."""
    texts = [text for lines in screens.values() for text in re.findall("text '([^']*)'", lines)]
    numbers = [text for text in texts if re.search(r"[0-9]\.[0-9]+ s\b", text) and not re.search("left|away", text)]
    assert not [each for each in numbers if not re.search(r"[0-9]\.[0-9]{3} s\b", each)]
    assert len(numbers) > 20
