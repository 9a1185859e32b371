"""Every mistake in an ASCII level: the message names file, line and column, what was found and how to fix it."""

from pathlib import Path

import pytest

from ninja_game.errors import LevelError
from ninja_game.formats.ascii.picture import LevelTextError
from ninja_game.formats.ascii.reader import parse_ascii_level
from tests.support.recorded import hold_against

GOLDEN = Path(__file__).parent / "golden" / "mistakes-in-levels.txt"
EMPTY = "." * 31


def level_text(
    *lines: str, rows: dict[int, str] | None = None, header: str = "ninja-game level 1\nname: Broken", count: int = 23
) -> str:
    """A level whose picture begins in line 3 of the file and whose list begins in line 26."""
    picture = ["|" + (rows or {}).get(row, "").ljust(31, ".") + "|" for row in range(1, count + 1)]
    return "\n".join([header, *picture, *lines]) + "\n"


def mistakes(text: str) -> list[str]:
    with pytest.raises(LevelError) as caught:
        parse_ascii_level(text, file="broken.txt")
    return str(caught.value).splitlines()


MISTAKES = {
    # What the text is.
    "nothing": "",
    "other text": "$a level##\n",
    "newer version": level_text(header="ninja-game level 2\nname: x"),
    # The header.
    "unknown header": level_text(header="ninja-game level 1\nauthr: x"),
    "header twice": level_text(header="ninja-game level 1\nname: x\nname: y"),
    "no header line": level_text(header="ninja-game level 1\ngold 5,7"),
    # The picture.
    "no picture": "ninja-game level 1\nname: x\n",
    "too few rows": level_text(count=22),
    "too many rows": level_text(count=24),
    "row too wide": level_text(rows={2: EMPTY + ".."}),
    "row too narrow": level_text().replace("|.", "|", 1),
    "no right frame": level_text().replace(".|\n", ".\n", 1),
    "after the frame": level_text().replace(".|\n", ".| wall\n", 1),
    "row number": level_text().replace("|.", "7 |.", 1),
    "unknown character": level_text(rows={5: "##/##"}),
    "wrong case": level_text(rows={5: ".z"}),
    "picture in two parts": level_text("gold 5.5,7", "|" + EMPTY + "|"),
    # A line of the list.
    "unknown kind": level_text("turret 5,7"),
    "mistyped kind": level_text("thwomp 5,7 down"),
    "drone without weapon": level_text("drone 5,7 zap"),
    "no place": level_text("gold"),
    "bad place": level_text("gold 5,7,8"),
    "blank in place": level_text("gold 5, 7"),
    "no number": level_text("gold 5,x7"),
    "huge number": level_text("gold 5,1e999px"),
    "outside the grid": level_text("gold 60,564"),
    "odd fraction": level_text("gold 5,7.3"),
    "word for what has none": level_text("gold 5.5,7 down"),
    "unknown word": level_text("thwump 5.5,7 dwn"),
    "word twice": level_text("thwump 5.5,7 down up"),
    "word missing": level_text("zap drone 5,7 right"),
    "pad without direction": level_text("launch pad 5.5,7"),
    "pad with two directions": level_text("launch pad 5.5,7 up normal 0.6,-0.8"),
    "bad normal": level_text("launch pad 5.5,7 normal 1"),
    "nothing after switch": level_text("exit 5.5,7 switch"),
    "two exits in a line": level_text("exit 5.5,7 6.5,7"),
    "door not at a cell": level_text("automatic door 5.5,7 left"),
    "door without its switch": level_text("locked door 5,7 left"),
    "side as direction": level_text("automatic door 5,7 up"),
    "side as point of the compass": level_text("automatic door 5,7 east"),
    "direction as point of the compass": level_text("thwump 5.5,7 north"),
    "column and row apart": level_text("zap drone 25 5 wander-cw right"),
    "automatic door with a switch": level_text("automatic door 5,7 left switch 27,15"),
    "notes in the header": level_text(header="ninja-game level 1\n# my notes"),
    "notes in the list": level_text("# my notes"),
    "raw without anything": level_text("raw"),
    "raw with too much": level_text('raw 9 1,2 "a" b'),
    "raw with a bad text": level_text(r'raw "a\q"'),
    "tile incomplete": level_text("tile 5,7 70"),
    "tile without number": level_text("tile 5,7 id wall"),
    # Picture and list together.
    "not drawn": level_text("gold 5,7"),
    "not drawn, several places": level_text("gold 5.5,7 6,7"),
    "switch not drawn": level_text("exit 5.5,7 switch 9,9"),
    "picture and list disagree": level_text("thwump 1,1 down", rows={1: "M"}),
    "drone without its line": level_text(rows={4: "..Z"}),
    "door switch without its line": level_text(rows={4: "..&"}),
    "exit without switch": level_text(rows={1: "X"}),
    "switch without exit": level_text(rows={1: "xx"}),
    "several pairs": level_text(rows={1: "XX", 3: "xx"}),
    "odd tile without its line": level_text(rows={1: ".?"}),
    "tile line without mark": level_text("tile 2,1 id 70"),
    "tile with a character": level_text("tile 2,1 id 5", rows={1: ".?"}),
    "tile twice": level_text("tile 2,1 2,1 id 70", rows={1: ".?"}),
    "tile in the border": level_text("tile 0,0 id 70"),
}


def test_every_mistake_is_reported_as_recorded() -> None:
    hold_against(GOLDEN, [f"{name}: {mistakes(text)[0]}" for name, text in MISTAKES.items()])


def test_several_mistakes_come_in_one_message_in_the_order_of_the_file() -> None:
    text = level_text("thwomp 1,1", "gold 99,1", header="ninja-game level 1\ncolour: red", rows={9: "z"})
    assert [line.split(": ")[0] for line in mistakes(text)] == [
        "broken.txt:2:1",
        "broken.txt:11:2",
        "broken.txt:26:1",
        "broken.txt:27:6",
    ]


def test_a_flood_of_mistakes_is_cut_and_counted() -> None:
    lines = mistakes(level_text(rows=dict.fromkeys(range(1, 24), "~~~")))
    assert len(lines) == 21
    assert lines[-1] == "... and 49 more"


def test_the_further_mistakes_are_attached() -> None:
    with pytest.raises(LevelTextError) as caught:
        parse_ascii_level(level_text("gold", "mine"), file="broken.txt")
    assert caught.value.line == 26
    assert [error.line for error in caught.value.further] == [27]


def test_a_message_without_a_file_begins_with_its_line() -> None:
    with pytest.raises(LevelError) as caught:
        parse_ascii_level(level_text("gold"))
    assert str(caught.value).startswith("26:5: 'gold' without a place")
