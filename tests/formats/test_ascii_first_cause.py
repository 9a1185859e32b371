"""One slip in the picture of an ASCII level gives one message, not one for every row below it."""

import pytest

from ninja_game.errors import LevelError
from ninja_game.formats.ascii.reader import parse_ascii_level

EMPTY = "." * 31
PLAIN = ["ninja-game level 1", "name: x", *[f"|{EMPTY}|"] * 23, "gold 5.5,5"]
NUMBERED = [*PLAIN[:2], *(f" {row:2d} |{EMPTY}|" for row in range(1, 24)), PLAIN[-1]]


def mistakes(lines: list[str]) -> list[str]:
    with pytest.raises(LevelError) as caught:
        parse_ascii_level("\n".join(lines), file="broken.txt")
    return str(caught.value).splitlines()


@pytest.mark.parametrize("lines", [PLAIN, NUMBERED], ids=["plain", "numbered"])
@pytest.mark.parametrize("row", [1, 7, 23])
def test_a_missing_bar_is_reported_once(row: int, lines: list[str]) -> None:
    line = lines[row + 1]
    for side, broken in (("left", line.replace("|", "", 1)), ("right", line[:-1])):
        (message,) = mistakes([*lines[: row + 1], broken, *lines[row + 2 :]])
        assert message.startswith(f"broken.txt:{row + 2}:")
        assert f"without its {side} frame" in message


def test_a_row_that_was_deleted_or_doubled_is_reported_once() -> None:
    (missing,) = mistakes(NUMBERED[:8] + NUMBERED[9:])
    assert missing.startswith("broken.txt:9: wrong row number; found '8'; expected 7; a row is missing")
    (double,) = mistakes([*NUMBERED[:9], *NUMBERED[8:]])
    assert double.startswith("broken.txt:10: wrong row number; found '7'; expected 8")
