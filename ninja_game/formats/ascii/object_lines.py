"""The list below the picture of an ASCII level: from lines of words to object records (`writer` does the reverse).

The table ``FORMS`` describes every kind of line; the writer uses it, too.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import takewhile
from typing import NamedTuple, TypeVar

from ninja_game.errors import LevelError
from ninja_game.formats.ascii.legend import DIRECTION_WORDS, PAD_NORMALS, SYMBOL_OF_NAME, WEAPONS
from ninja_game.formats.ascii.places import quoted, read_cell, read_number, read_place
from ninja_game.formats.lines import read_quoted
from ninja_game.sim.kinds import DOOR, DRONE, EXIT, FLOOR_GUARD, KINDS, LAUNCH_PAD, ONE_WAY, THWUMP
from ninja_game.sim.level import ObjectSpec
from ninja_game.sim.rules import CELL, HALF

T = TypeVar("T")

MOVEMENTS = {
    "surface-cw": 0.0,
    "surface-ccw": 1.0,
    "wander-cw": 2.0,
    "wander-ccw": 3.0,
    "alternating": 4.0,
    "random": 5.0,
}
"""Movement numbers of drones (objects.md §5)."""

SIDES = {"right": (0.0, 0.0, 0.0), "bottom": (1.0, 0.0, 0.0), "left": (0.0, -1.0, 0.0), "top": (1.0, 0.0, -1.0)}
"""Side of a door's cell: vertical flag, column offset, row offset (objects.md §8.6)."""

DOORS = {"automatic door": (0.0, 0.0), "locked door": (0.0, 1.0), "trap door": (1.0, 0.0)}
"""Trap flag and locked flag of the three kinds of doors."""


@dataclass(frozen=True)
class Token:
    """A word of a line, and its column (from 1)."""

    text: str
    column: int


@dataclass(frozen=True)
class Form:
    """One kind of line: ``keyword PLACE… words``.

    ``words``: the vocabulary of each property. ``takes``: keywords before a value. ``needs``: groups of properties;
    exactly one of a group must be given, properties outside of groups are optional. ``single``: one place a line.
    """

    kind: int
    words: Mapping[str, Mapping[str, object]] = field(default_factory=dict)
    takes: tuple[str, ...] = ()
    needs: tuple[tuple[str, ...], ...] = ()
    single: bool = False


_DIRECTED = {"direction": DIRECTION_WORDS}
_DRONE = Form(
    DRONE,
    {"movement": MOVEMENTS, "direction": DIRECTION_WORDS, "seeker": {"seeker": 1.0}},
    needs=(("movement",), ("direction",)),
)

FORMS: dict[str, Form] = {
    **{kind.name: Form(kind.number) for kind in KINDS if kind.value_count == 2},
    "floor guard": Form(FLOOR_GUARD, takes=("facing",)),
    "one-way": Form(ONE_WAY, _DIRECTED, needs=(("direction",),)),
    "thwump": Form(THWUMP, _DIRECTED, needs=(("direction",),)),
    "launch pad": Form(LAUNCH_PAD, {"direction": PAD_NORMALS}, ("normal",), (("direction", "normal"),)),
    **dict.fromkeys(WEAPONS, _DRONE),
    "exit": Form(EXIT, takes=("switch",), needs=(("switch",),), single=True),
    "automatic door": Form(DOOR, {"side": SIDES}, (), (("side",),), single=True),
    "locked door": Form(DOOR, {"side": SIDES}, ("switch",), (("side",), ("switch",)), single=True),
    "trap door": Form(DOOR, {"side": SIDES}, ("switch",), (("side",), ("switch",)), single=True),
}
"""The keywords of all lines of objects that have a readable form."""


def natural_offset(keyword: str, direction: str = "") -> tuple[float, float]:
    """Offset, px, of an object from the middle of the cell that a line gives: the same as in the picture."""
    symbol = SYMBOL_OF_NAME.get(f"{keyword} {direction}" if direction else keyword)
    return (symbol.dx, symbol.dy) if symbol is not None else (0.0, 0.0)


def door_middle(values: Sequence[float]) -> tuple[float, float]:
    """The middle of a door's bar, px, from the values of its record; an automatic door senses the ninja there."""
    x, y = CELL * (values[4] + values[7]) + HALF, CELL * (values[5] + values[8]) + HALF
    return (x, y + HALF) if values[2] else (x + HALF, y)


def object_values(keyword: str, place: Token, words: Mapping[str, Token]) -> tuple[float, ...]:
    """The values of the record that a line describes; ``words``: the word of each property or keyword.

    Raises LevelError with the column of the word that cannot be read.
    """
    kind = FORMS[keyword].kind
    if kind == DOOR:
        return _door_values(keyword, place, words)
    direction = words["direction"].text if "direction" in words else ""
    x, y = at_token(place, read_place, *natural_offset(keyword, direction))
    if kind in (ONE_WAY, THWUMP):
        return x, y, DIRECTION_WORDS[direction]
    if kind == DRONE:
        move, seeker = MOVEMENTS[words["movement"].text], float("seeker" in words)
        return x, y, move, seeker, WEAPONS[keyword], DIRECTION_WORDS[direction]
    if kind == LAUNCH_PAD:
        return x, y, *(PAD_NORMALS[direction] if direction else at_token(words["normal"], _read_pair))
    if kind == FLOOR_GUARD:
        return x, y, at_token(words["facing"], read_number) if "facing" in words else 1.0
    if kind == EXIT:
        return x, y, *at_token(words["switch"], read_place)
    return x, y


def _door_values(keyword: str, place: Token, words: Mapping[str, Token]) -> tuple[float, ...]:
    column, row = at_token(place, read_cell)
    trap, locked = DOORS[keyword]
    vertical, i, j = SIDES[words["side"].text]
    values = (0.0, 0.0, vertical, trap, float(column), float(row), locked, i, j)
    middle = at_token(words["switch"], read_place) if "switch" in words else door_middle(values)
    return (*middle, *values[2:])


def _read_pair(text: str) -> tuple[float, float]:
    """Two numbers ``a,b``. Raises LevelError."""
    numbers = text.split(",")
    if len(numbers) != 2:
        raise LevelError("not a pair of numbers", found=quoted(text), expected="x,y such as 0.6,-0.8")
    return read_number(numbers[0]), read_number(numbers[1])


def at_token(token: Token, read: Callable[..., T], *offset: float) -> T:
    """Apply ``read`` to a word; an error gets the word's column."""
    try:
        return read(token.text, *offset)
    except LevelError as error:
        error.column = token.column
        raise


_TOKEN = re.compile(r';.*|"(?:[^"\\]|\\.)*+"|[^\s;"]+|".*')

_NUMBER = re.compile(r"\d{1,4}(?:\.\d{1,4})?(?:px)?", re.ASCII)

_SYNONYMS = {
    "east": ("right",), "west": ("left",), "north": ("up", "top"), "south": ("down", "bottom"),
    "up": ("top",), "upper": ("top",), "top": ("up",), "down": ("bottom",), "lower": ("bottom",), "bottom": ("down",),
}  # fmt: skip
"""Synonyms for sides and directions."""


class ListedObject(NamedTuple):
    """An object of a line of the list, with its column, and its line if known."""

    spec: ObjectSpec
    column: int
    line: int = 0


class OddTile(NamedTuple):
    """A cell with a tile id that has no character, with its place in the list, as in ``ListedObject``."""

    cell: tuple[int, int]
    id: int
    column: int
    line: int = 0


def tokens_of(text: str) -> list[Token]:
    """The words of a line, without its comment after a semicolon."""
    tokens = (Token(match.group(), match.start() + 1) for match in _TOKEN.finditer(text))
    return [token for token in tokens if not token.text.startswith(";")]


def suggestion(unknown: str, known: Iterable[str]) -> str:
    """A hint that names the nearest known words, or all of a short list."""
    known = list(known)
    if unknown.startswith(("#", "//")):
        return "comments begin with ;"
    similar = [word for word in _SYNONYMS.get(unknown.lower(), ()) if word in known]
    similar = similar or [word for word in known if unknown and (unknown in word.split() or unknown.startswith(word))]
    similar = similar or difflib.get_close_matches(unknown, known, 3, 0.6)
    if similar:
        return f"did you mean {' or '.join(similar)}?"
    return f"known are {', '.join(known)}"


def read_object_line(text: str) -> list[ListedObject] | list[OddTile]:
    """The objects (or odd tiles) of one line of the list, in order; empty for a blank or comment line.

    Raises LevelError with the column, without file and line.
    """
    tokens = tokens_of(text)
    if not tokens:
        return []
    if tokens[0].text == "raw":
        return [_read_raw(tokens)]
    if tokens[0].text == "tile":
        return _read_tiles(tokens)
    keyword, rest = _split_keyword(tokens)
    places, words = _sort_words(keyword, FORMS[keyword], rest)
    if not places:
        column = tokens[-1].column + len(tokens[-1].text)
        raise LevelError(f"'{keyword}' without a place", column=column, expected=f"{keyword} 5,7 (column,row)")
    return [
        ListedObject(ObjectSpec(FORMS[keyword].kind, object_values(keyword, place, words)), place.column)
        for place in places
    ]


def _split_keyword(tokens: Sequence[Token]) -> tuple[str, Sequence[Token]]:
    """The keyword, of one word or two, and the words behind it. Raises LevelError for an unknown one."""
    for count in (2, 1):
        keyword = " ".join(token.text for token in tokens[:count])
        if keyword in FORMS:
            return keyword, tokens[count:]
    words = takewhile(lambda token: "," not in token.text, tokens)
    found = " ".join(token.text for token in words) or tokens[0].text
    hint = suggestion(found, [*FORMS, "tile", "raw"])
    raise LevelError("unknown kind of object", column=tokens[0].column, found=quoted(found), hint=hint)


def _sort_words(keyword: str, form: Form, tokens: Sequence[Token]) -> tuple[list[Token], dict[str, Token]]:
    """Separate the words that are places from those that are values of properties."""
    places: list[Token] = []
    by_name: dict[str, Token] = {}
    words = iter(tokens)
    for token in words:
        names = [name for name, vocabulary in form.words.items() if token.text in vocabulary]
        if token.text in form.takes:
            name, value = token.text, next(words, None)
            if value is None:
                column = token.column + len(token.text)
                raise LevelError(f"nothing after '{name}'", column=column, expected=_EXAMPLES[name])
        elif names:
            name, value = names[0], token
        elif "," in token.text:
            if token.text.strip(",") != token.text:
                hint = "column and row stand together, as in 5,7"
                raise LevelError("a place with a blank in it", column=token.column, found=quoted(token.text), hint=hint)
            if places and form.single:
                hint = "write one line for each, or 'switch' before its switch" if form.takes else ""
                raise LevelError(f"a second place for one '{keyword}'", column=token.column, hint=hint)
            places.append(token)
            continue
        else:
            raise _unknown_word(keyword, form, token, next(words, None))
        if name in by_name:
            raise LevelError(f"the {name} of '{keyword}' is given twice", column=token.column, found=quoted(token.text))
        by_name[name] = value
    _check_complete(keyword, form, by_name, tokens)
    return places, by_name


def _unknown_word(keyword: str, form: Form, token: Token, following: Token | None) -> LevelError:
    """The error for a word that a form does not have, with the likeliest fix."""
    if keyword == "automatic door" and token.text == "switch":
        hint = "it opens for whoever comes near; write 'locked door' or 'trap door' for one with a switch"
        return LevelError("automatic doors have no switch", column=token.column, hint=hint)
    known = [word for vocabulary in form.words.values() for word in vocabulary] + list(form.takes)
    if following and _NUMBER.fullmatch(token.text) and _NUMBER.fullmatch(following.text):
        hint = f"column and row stand together: write {token.text},{following.text}"
    else:
        hint = suggestion(token.text, known) if known else f"'{keyword}' has places only, such as 5,7"
    return LevelError(f"unknown word for '{keyword}'", column=token.column, found=quoted(token.text), hint=hint)


_EXAMPLES = {"switch": "switch 3,4 (column,row)", "normal": "normal 0.6,-0.8", "facing": "facing 1"}
"""Examples of properties with a value."""


def _check_complete(keyword: str, form: Form, by_name: dict[str, Token], tokens: Sequence[Token]) -> None:
    column = tokens[-1].column + len(tokens[-1].text) if tokens else len(keyword) + 1
    for group in form.needs:
        present = [by_name[name] for name in group if name in by_name]
        if len(present) > 1:
            raise LevelError(f"'{keyword}' with both {' and '.join(group)}", column=present[1].column, hint="keep one")
        if not present:
            words = [", ".join(form.words[name]) if name in form.words else _EXAMPLES[name] for name in group]
            raise LevelError(f"'{keyword}' without its {group[0]}", column=column, expected=", or ".join(words))


def _read_tiles(tokens: Sequence[Token]) -> list[OddTile]:
    if len(tokens) < 4 or tokens[-2].text != "id":
        raise LevelError("incomplete tile line", column=tokens[0].column, expected="tile 5,7 id 70")
    number = tokens[-1]
    if re.fullmatch(r"-?\d{1,18}", number.text, re.ASCII) is None:
        raise LevelError("not a tile id", column=number.column, found=quoted(number.text), expected="a whole number")
    return [OddTile(at_token(token, read_cell), int(number.text), token.column) for token in tokens[1:-2]]


def _read_raw(tokens: Sequence[Token]) -> ListedObject:
    """Read ``raw TYPE V,V,… "text"``; each part may be missing, a missing type is -1."""
    rest = list(tokens[1:])
    kind, text = -1, ""
    values: tuple[float, ...] = ()
    shape = 'raw 9 1,2,3 (type and values), or raw "text" for a record that creates nothing'
    if rest and re.fullmatch(r"-?\d{1,18}", rest[0].text, re.ASCII):
        kind = int(rest.pop(0).text)
    if rest and not rest[0].text.startswith('"'):
        values = at_token(rest.pop(0), lambda text: tuple(map(read_number, text.split(","))))
    if rest:
        text = at_token(rest.pop(0), _read_string)
    if rest or len(tokens) == 1:
        column = rest[0].column if rest else tokens[0].column
        raise LevelError("not a raw record", column=column, expected=shape)
    return ListedObject(ObjectSpec(kind, values, text), tokens[0].column)


def _read_string(text: str) -> str:
    value = read_quoted(text)
    if value is None or value != value.encode("utf-8", "replace").decode():
        raise LevelError(
            "not a text in double quotes", found=quoted(text), expected='"text", with \\" and \\\\ as in JSON'
        )
    return value
