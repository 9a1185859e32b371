"""Names are data: whatever stands in them, what is shown is one line of printable characters."""

from pathlib import Path

import pytest

from ninja_game.errors import LevelError
from ninja_game.files.shown_text import file_stem, shown_text

HOSTILE = ["a\nFAIL row", "a\rb", "\x1b[2J\x1b]0;title\x07", "\0", "\ud800", "\u202egnp.exe", "\u2028", "x" * 100_000]


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_names_become_one_short_printable_line(text: str) -> None:
    shown = shown_text(text)
    assert shown.isprintable()
    assert shown.encode()
    assert 0 < len(shown) <= 203


def test_a_common_name_stays_as_it_is() -> None:
    assert shown_text("Žluťoučký kůň (日本語) 🦊") == "Žluťoučký kůň (日本語) 🦊"


@pytest.mark.parametrize("text", [*HOSTILE, "../../etc/passwd", ".hidden", "con\\aux:", "日" * 300])
def test_any_text_names_a_file_in_its_folder(text: str, tmp_path: Path) -> None:
    path = tmp_path / f"{file_stem(text, 'replay')}-1.replay.txt"
    path.write_text("")
    assert list(tmp_path.iterdir()) == [path]
    assert not path.name.startswith(".")


def test_an_error_shows_the_name_of_its_file_in_one_line() -> None:
    assert str(LevelError("no level", "a\nb: fine\x1b[0m.txt", 3)) == "'a\\nb: fine\\x1b[0m.txt':3: no level"
