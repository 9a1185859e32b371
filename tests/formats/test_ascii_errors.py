"""Every mistake in an ASCII level: the message names file, line and column, what was found and how to fix it."""

from __future__ import annotations

import pytest

from ninja_game.errors import LevelError
from ninja_game.formats.ascii.problems import LevelTextError
from ninja_game.formats.ascii.reader import parse_ascii_level

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
    "nothing": ("", "broken.txt:1:1: not an ASCII level; found ''; expected 'ninja-game level 1' in the first line"),
    "other text": (
        "$a level##\n",
        "broken.txt:1:1: not an ASCII level; found '$a level##'; expected 'ninja-game level 1' in the first line",
    ),
    "newer version": (
        level_text(header="ninja-game level 2\nname: x"),
        (
            "broken.txt:1: unknown version of the level format; found 2; expected 1; "
            "a level for a newer ninja-game needs a newer ninja-game"
        ),
    ),
    # The header.
    "unknown header": (
        level_text(header="ninja-game level 1\nauthr: x"),
        "broken.txt:2:1: unknown header; found 'authr'; did you mean author?",
    ),
    "header twice": (
        level_text(header="ninja-game level 1\nname: x\nname: y"),
        "broken.txt:3:1: a header given twice; found 'name'; keep one",
    ),
    "no header line": (
        level_text(header="ninja-game level 1\ngold 5,7"),
        (
            "broken.txt:2:1: not a header line; found 'gold 5,7'; "
            "expected key: value, or the first row of the picture, |...|; objects are listed below the picture"
        ),
    ),
    # The picture.
    "no picture": (
        "ninja-game level 1\nname: x\n",
        "broken.txt:3: the picture has too few rows; found 0; expected 23 rows, each |31 characters|",
    ),
    "too few rows": (
        level_text(count=22),
        "broken.txt:25: the picture has too few rows; found 22; expected 23 rows, each |31 characters|",
    ),
    "too many rows": (
        level_text(count=24),
        "broken.txt:26: the picture has too many rows; found 24; expected 23 rows, each |31 characters|",
    ),
    "row too wide": (
        level_text(rows={2: EMPTY + ".."}),
        "broken.txt:4:33: row 2 of the picture has the wrong width; found 33 characters; expected 31; 2 too many",
    ),
    "row too narrow": (
        level_text().replace("|.", "|", 1),
        "broken.txt:3:32: row 1 of the picture has the wrong width; found 30 characters; expected 31; 1 too few",
    ),
    "no right frame": (
        level_text().replace(".|\n", ".\n", 1),
        "broken.txt:3:33: a picture row without its right frame; expected '|' at the end",
    ),
    "after the frame": (
        level_text().replace(".|\n", ".| wall\n", 1),
        (
            "broken.txt:3: a picture row with something after its frame; found 'wall'; "
            "nothing but the row's number may follow the frame"
        ),
    ),
    "row number": (
        level_text().replace("|.", "7 |.", 1),
        (
            "broken.txt:3: wrong row number; found '7'; expected 1; "
            "a row is missing or stands twice above; the numbers may be left out"
        ),
    ),
    "unknown character": (
        level_text(rows={5: "##/##"}),
        (
            "broken.txt:7:4: a character that is not in the legend; found '/'; "
            "expected a tile or an object; did you mean s or q, the 45° slopes?"
        ),
    ),
    "wrong case": (
        level_text(rows={5: ".z"}),
        (
            "broken.txt:7:3: a character that is not in the legend; found 'z'; "
            "expected a tile or an object; did you mean Z (zap drone)?"
        ),
    ),
    "picture in two parts": (
        level_text("gold 5.5,7", "|" + EMPTY + "|"),
        (
            f"broken.txt:27: a picture row below the list; found '|{EMPTY}|'; "
            "the picture is one block; the list of objects stands below it"
        ),
    ),
    # A line of the list.
    "unknown kind": (
        level_text("turret 5,7"),
        "broken.txt:26:1: unknown kind of object; found 'turret'; did you mean gauss turret?",
    ),
    "mistyped kind": (
        level_text("thwomp 5,7 down"),
        "broken.txt:26:1: unknown kind of object; found 'thwomp'; did you mean thwump?",
    ),
    "drone without weapon": (
        level_text("drone 5,7 zap"),
        (
            "broken.txt:26:1: unknown kind of object; found 'drone'; "
            "did you mean zap drone or laser drone or chaingun drone?"
        ),
    ),
    "no place": (level_text("gold"), "broken.txt:26:5: 'gold' without a place; expected gold 5,7 (column,row)"),
    "bad place": (
        level_text("gold 5,7,8"),
        (
            "broken.txt:26:6: not a place; found '5,7,8'; "
            "expected column,row such as 5,7 (or 5.5,7), or exact px such as 60,564px"
        ),
    ),
    "blank in place": (
        level_text("gold 5, 7"),
        "broken.txt:26:6: a place with a blank in it; found '5,'; column and row stand together, as in 5,7",
    ),
    "no number": (
        level_text("gold 5,x7"),
        "broken.txt:26:6: not a number; found 'x7'; expected a decimal such as 12, -0.5 or 408.15",
    ),
    "huge number": (
        level_text("gold 5,1e999px"),
        "broken.txt:26:6: number too large; found '1e999'; write inf if you mean infinity",
    ),
    "outside the grid": (
        level_text("gold 60,564"),
        (
            "broken.txt:26:6: column outside the grid; found 60; expected 1 to 31 (0 and 32 are the border); "
            "if it is meant to be px, write px after it, as in 60,564px"
        ),
    ),
    "odd fraction": (
        level_text("gold 5,7.3"),
        (
            "broken.txt:26:6: row between the quarter cells; found 7.3; expected steps of 0.25 (6 px); "
            "write finer positions in px, as in 60,564px"
        ),
    ),
    "word for what has none": (
        level_text("gold 5.5,7 down"),
        "broken.txt:26:12: unknown word for 'gold'; found 'down'; 'gold' has places only, such as 5,7",
    ),
    "unknown word": (
        level_text("thwump 5.5,7 dwn"),
        "broken.txt:26:14: unknown word for 'thwump'; found 'dwn'; did you mean down?",
    ),
    "word twice": (
        level_text("thwump 5.5,7 down up"),
        "broken.txt:26:19: the direction of 'thwump' is given twice; found 'up'",
    ),
    "word missing": (
        level_text("zap drone 5,7 right"),
        (
            "broken.txt:26:20: 'zap drone' without its movement; "
            "expected surface-cw, surface-ccw, wander-cw, wander-ccw, alternating, random"
        ),
    ),
    "pad without direction": (
        level_text("launch pad 5.5,7"),
        (
            "broken.txt:26:17: 'launch pad' without its direction; expected up, up-right, right, down-right, down, "
            "down-left, left, up-left, or normal 0.6,-0.8"
        ),
    ),
    "pad with two directions": (
        level_text("launch pad 5.5,7 up normal 0.6,-0.8"),
        "broken.txt:26:28: 'launch pad' with both direction and normal; keep one",
    ),
    "bad normal": (
        level_text("launch pad 5.5,7 normal 1"),
        "broken.txt:26:25: not a pair of numbers; found '1'; expected x,y such as 0.6,-0.8",
    ),
    "nothing after switch": (
        level_text("exit 5.5,7 switch"),
        "broken.txt:26:18: nothing after 'switch'; expected switch 3,4 (column,row)",
    ),
    "two exits in a line": (
        level_text("exit 5.5,7 6.5,7"),
        ("broken.txt:26:12: a second place for one 'exit'; write one line for each, or 'switch' before its switch"),
    ),
    "door not at a cell": (
        level_text("automatic door 5.5,7 left"),
        "broken.txt:26:16: not a whole cell; found '5.5,7'; expected column,row such as 20,14",
    ),
    "door without its switch": (
        level_text("locked door 5,7 left"),
        "broken.txt:26:21: 'locked door' without its switch; expected switch 3,4 (column,row)",
    ),
    "side as direction": (
        level_text("automatic door 5,7 up"),
        "broken.txt:26:20: unknown word for 'automatic door'; found 'up'; did you mean top?",
    ),
    "side as point of the compass": (
        level_text("automatic door 5,7 east"),
        "broken.txt:26:20: unknown word for 'automatic door'; found 'east'; did you mean right?",
    ),
    "direction as point of the compass": (
        level_text("thwump 5.5,7 north"),
        "broken.txt:26:14: unknown word for 'thwump'; found 'north'; did you mean up?",
    ),
    "column and row apart": (
        level_text("zap drone 25 5 wander-cw right"),
        ("broken.txt:26:11: unknown word for 'zap drone'; found '25'; column and row stand together: write 25,5"),
    ),
    "automatic door with a switch": (
        level_text("automatic door 5,7 left switch 27,15"),
        (
            "broken.txt:26:25: automatic doors have no switch; it opens for whoever comes near; "
            "write 'locked door' or 'trap door' for one with a switch"
        ),
    ),
    "notes in the header": (
        level_text(header="ninja-game level 1\n# my notes"),
        (
            "broken.txt:2:1: not a header line; found '# my notes'; "
            "expected key: value, or the first row of the picture, |...|; comments begin with ;"
        ),
    ),
    "notes in the list": (
        level_text("# my notes"),
        "broken.txt:26:1: unknown kind of object; found '# my notes'; comments begin with ;",
    ),
    "raw without anything": (
        level_text("raw"),
        (
            "broken.txt:26:1: not a raw record; "
            'expected raw 9 1,2,3 (type and values), or raw "text" for a record that creates nothing'
        ),
    ),
    "raw with too much": (
        level_text('raw 9 1,2 "a" b'),
        (
            "broken.txt:26:15: not a raw record; "
            'expected raw 9 1,2,3 (type and values), or raw "text" for a record that creates nothing'
        ),
    ),
    "raw with a bad text": (
        level_text(r'raw "a\q"'),
        r"""broken.txt:26:5: not a text in double quotes; found '"a\\q"'; expected "text", with \" and \\ as in JSON""",
    ),
    "tile incomplete": (level_text("tile 5,7 70"), "broken.txt:26:1: incomplete tile line; expected tile 5,7 id 70"),
    "tile without number": (
        level_text("tile 5,7 id wall"),
        "broken.txt:26:13: not a tile id; found 'wall'; expected a whole number",
    ),
    # Picture and list together.
    "not drawn": (
        level_text("gold 5,7"),
        "broken.txt:26:6: o (gold) at 5,7 is not in the picture; draw o in line 9, column 6, or correct the place",
    ),
    "not drawn, several places": (
        level_text("gold 5.5,7 6,7"),
        "broken.txt:26:12: o (gold) at 6,7 is not in the picture; draw o in line 9, column 7, or correct the place",
    ),
    "switch not drawn": (
        level_text("exit 5.5,7 switch 9,9"),
        (
            "broken.txt:26:6: x (exit switch) at 9,9 is not in the picture; "
            "draw x in line 11, column 10, or correct the place"
        ),
    ),
    "picture and list disagree": (
        level_text("thwump 1,1 down", rows={1: "M"}),
        (
            "broken.txt:3:2: picture and list disagree at 1,1; found M (thwump up); "
            "expected W (thwump down), as line 26 says"
        ),
    ),
    "drone without its line": (
        level_text(rows={4: "..Z"}),
        (
            "broken.txt:6:4: Z (zap drone) without its line; "
            "add a line below the picture, such as: zap drone 3,4 wander-cw right"
        ),
    ),
    "door switch without its line": (
        level_text(rows={4: "..&"}),
        (
            "broken.txt:6:4: & (locked door switch) without its line; "
            "add a line below the picture, such as: locked door 20,14 left switch 3,4"
        ),
    ),
    "exit without switch": (
        level_text(rows={1: "X"}),
        (
            "broken.txt:3:2: exits and switches that no line mentions and that make no pair; found 1 X and 0 x; "
            "draw x, its switch, or add a line such as: exit 29,21 switch 3.5,4"
        ),
    ),
    "switch without exit": (
        level_text(rows={1: "xx"}),
        (
            "broken.txt:3:2: exits and switches that no line mentions and that make no pair; found 0 X and 2 x; "
            "draw X, its exit, or add a line such as: exit 29,21 switch 3.5,4"
        ),
    ),
    "several pairs": (
        level_text(rows={1: "XX", 3: "xx"}),
        (
            "broken.txt:3:2: exits and switches that no line mentions and that make no pair; found 2 X and 2 x; "
            "say which belong together in lines such as: exit 29,21 switch 3,4"
        ),
    ),
    "odd tile without its line": (
        level_text(rows={1: ".?"}),
        (
            "broken.txt:3:3: an odd tile without its line; found '?'; "
            "add a line below the picture: tile 2,1 id 70, or draw another character"
        ),
    ),
    "tile line without mark": (
        level_text("tile 2,1 id 70"),
        "broken.txt:26:6: a tile line for a cell that is not marked; found 2,1; draw ? in the picture there",
    ),
    "tile with a character": (
        level_text("tile 2,1 id 5", rows={1: ".?"}),
        "broken.txt:26:6: tile 5 has a character; found 2,1; draw q in the picture instead",
    ),
    "tile twice": (
        level_text("tile 2,1 2,1 id 70", rows={1: ".?"}),
        "broken.txt:26:10: a second tile line for one cell; found 2,1; keep one",
    ),
    "tile in the border": (
        level_text("tile 0,0 id 70"),
        "broken.txt:26:6: a tile line for a border cell; found 0,0; only 1,1 to 31,23 have tiles of the level",
    ),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_message(name: str) -> None:
    text, message = MISTAKES[name]
    assert mistakes(text)[0] == message


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
