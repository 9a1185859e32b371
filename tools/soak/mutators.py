"""Inputs made odd, by their structure: texts by tokens and lines, JSON by its tree, zips by what lies in them."""

import io
import json
import random
import re
import unicodedata
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from typing import Any
from zipfile import ZIP_BZIP2, ZIP_DEFLATED, ZIP_STORED, ZipFile

import numpy as np

MAX_BYTES = 150_000  # longest input, bytes: more than this is a question of limits, not of forms

NUMBERS = (
    *("0", "-0", "00", "1", "-1", "0.5", "-0.0", "33", "34", "712", "713", "999999", "1000000", "1000001", "65535"),
    *("2147483647", "2147483648", "-2147483649", "4294967296", "9223372036854775808", "-9223372036854775809"),
    *("1e308", "-1e309", "1e-320", "4.9e-324", "1e", ".", "-", "NaN", "Infinity", "-inf", "0x1F", "1_000", "٣", "²"),
    *("0.1000000000000000055511151231257827", "9" * 400, "9" * 5000, "0" * 713),
)
WORDS = (
    *("#", "$", "##", "|", "^", "!", ",", "*", ":", ";", "&userdata=", "%24", "%zz", "\n\n", "\r", "\r\n", "\t", "  "),
    *("ninja-game level 1\n", "ninja-game replay 2\n", "ninja-game replay 3\n", "inputs:\n"),
    *("level-data:\n", "waypoints:\n", "end\n", "include part.inputs.txt\n", "include ../part\n", "level: level\n"),
    *("Read,part.inputs.txt\n", "Repeat 9\n", "EndRepeat\n", "***", "(R*9 ", ")*9", "R*1000000 ", "J!", "--- part\n"),
    *("[[episode]]\n", "number = 0\n", "a.b.c = 1\n", '"""', "'''", "{", "}", "[", "]", "null", "true", '"', "\\u0000"),
    *("mine 5.5,5\n", "thwump 1,1 left\n", "and", "or", "not", "distance(1,2)", "<=", "#level=1.", "&replay=1."),
    *("../../x", "/etc/hostname", "CON", "x" * 300, "\x1b[31m", "\ud800", "\0", "\ufeff", "\U0001f600", "e\u0301" * 9),
)
VALUES: tuple[Any, ...] = (
    *(None, True, False, 0, -1, 1.5, 10**20, -(10**9), 2**63, float("nan"), float("inf"), "", "x", "\ud800", "0" * 713),
    *([], [[]], {}, {"": None}, ["a", 1], "9" * 400, [0] * 1000),
)
"""What stands in JSON in the place of something else."""

KINDS = ("<f8", ">f8", "|S0", "<U0", "<U9", "|u1", "<i4", "<i8", "|O", "<M8[s]", [("x", "<f8"), ("s", "<i4")])
SHAPES = ((), (0,), (1,), (2,), (6,), (6, 2), (2, 6), (10**7,), (10**6, 10), (2**62,), (2**40, 2**40), (-1,))
"""What headers of damaged arrays claim."""

_TOKEN = re.compile(r"[-+]?[0-9][0-9.eE]*|\w+|\s+|[^\w\s]")
_NUMBER = re.compile(r"[-+]?[0-9]+(?:\.[0-9]+)?")
_ARRAY = b"\x93NUMPY"


def mutated(data: bytes, other: bytes, rng: random.Random) -> bytes:
    """An input with one to six things wrong; ``other``: another input, to take parts from."""
    for _ in range(rng.choice((1, 1, 1, 2, 3, 6))):
        with suppress(Exception):  # what is odd already cannot always be taken apart
            data = _once(data, other, rng)[:MAX_BYTES]
    return data


def _once(data: bytes, other: bytes, rng: random.Random) -> bytes:
    if rng.random() < 0.06:
        return _bytes(data, other, rng)
    if data.startswith(b"PK") and rng.random() < 0.9:
        return _zip(data, other, rng)
    if data.startswith(_ARRAY):
        return _array(data, rng)
    if b"\0" in data[:400]:
        return _bytes(data, other, rng)
    text = as_text(data)
    if text[:1] in {"{", "["} and rng.random() < 0.75:
        return _json(text, other, rng).encode("utf-8", "surrogatepass")
    return rng.choice(_OF_TEXT)(text, as_text(other), rng).encode("utf-8", "surrogatepass")


def as_text(data: bytes) -> str:
    """Bytes as a text: lone halves of surrogate pairs may be in it, two make a character; no UTF-8: Latin-1."""
    try:
        text = data.decode("utf-8", "surrogatepass")
        return text.encode("utf-16", "surrogatepass").decode("utf-16", "surrogatepass")
    except UnicodeDecodeError:
        return data.decode("latin-1")


# --- texts ---


def _splice(text: str, other: str, rng: random.Random) -> str:
    """The beginning of one text and the end of another, cut at tokens of the same kind."""
    ours, theirs = [*_TOKEN.finditer(text)], [*_TOKEN.finditer(other)]
    if not ours or not theirs:
        return text + other
    here = rng.choice(ours)
    fitting = [each for each in theirs if _kind(each[0]) == _kind(here[0])] or theirs
    return text[: here.start()] + other[rng.choice(fitting).start() :]


def _kind(token: str) -> str:
    return "word" if token[0].isalpha() else "number" if token[-1].isdigit() else token[:1]


def _tokens(text: str, other: str, rng: random.Random) -> str:
    """Tokens taken out, moved, exchanged, or doubled many times."""
    return "".join(_rearranged(_TOKEN.findall(text) or [""], _TOKEN.findall(other) or [""], rng))


def _blocks(text: str, other: str, rng: random.Random) -> str:
    """Lines or fields, the same; or put into brackets."""
    divider = rng.choice(("\n", "\n", "\n", "#", "!", ",", "|", " ", ":", "&", "\n\n"))
    parts = text.split(divider)
    if rng.random() < 0.2:
        place = rng.randrange(len(parts))
        opened, closed = rng.choice(("()", "[]", "{}", '""', ("Repeat 2\n", "\nEndRepeat"), ("not ", ""), ("(", ")*2")))
        deep = rng.choice((1, 2, 39, 41, 200, 5000))
        parts[place] = opened * deep + parts[place] + closed * deep
    return divider.join(_rearranged(parts, other.split(divider), rng))


def _rearranged(parts: list[str], theirs: list[str], rng: random.Random) -> list[str]:
    """Some parts in a row doubled many times, taken out, moved, indented, or replaced by those of another text."""
    place = rng.randrange(len(parts))
    end = place + rng.choice((1, 1, 2, 5, 30))
    piece = parts[place:end]
    what = rng.randrange(7)
    if what == 0:
        piece *= rng.choice((2, 3, 100, 1 + min(30_000, MAX_BYTES // (1 + sum(map(len, piece))))))
    elif what == 1:
        piece = []
    elif what == 2:
        rng.shuffle(piece)
    elif what == 3:
        piece = [rng.choice(WORDS)]
    elif what == 4:
        start = rng.randrange(len(theirs))
        piece = theirs[start : start + len(piece)]
    elif what == 5:
        piece.insert(0, rng.choice(parts))
    else:
        piece = [" " * rng.choice((1, 2, 9)) + each.strip() for each in piece]
    return [*parts[:place], *piece, *parts[end:]]


def _numbers(text: str, _: str, rng: random.Random) -> str:
    """Numbers at the limits of what numbers can be; one, some or all of them, or one that is a little different."""
    found = [*_NUMBER.finditer(text)]
    if not found:
        return text + rng.choice(NUMBERS)
    if rng.random() < 0.5:
        here = rng.choice(found)
        near = str(int(float(here[0])) + rng.choice((-1, 1))) if len(here[0]) < 15 else "0"
        return text[: here.start()] + rng.choice((near, rng.choice(NUMBERS))) + text[here.end() :]
    share = rng.choice((0.01, 0.2, 1.0))
    return _NUMBER.sub(lambda match: rng.choice(NUMBERS[:-3]) if rng.random() < share else str(match[0]), text)


@cache
def _characters() -> dict[str, list[str]]:
    """Characters by their class in Unicode."""
    found: dict[str, list[str]] = {}
    for code in [*range(0x3100), *range(0xD7F0, 0xE010), *range(0xFE00, 0x10120), *range(0xE0000, 0xE0080)]:
        found.setdefault(unicodedata.category(chr(code)), []).append(chr(code))
    return found


def _unicode(text: str, _: str, rng: random.Random) -> str:
    """Characters of any class put in, or in the place of others; or a part in other letters that look the same."""
    place = rng.randrange(len(text) + 1)
    end = min(len(text), place + rng.choice((0, 1, 1, 8)))
    what = rng.randrange(4)
    if what == 0:
        form = rng.choice((str.upper, str.casefold, str.title, lambda part: unicodedata.normalize("NFKD", part)))
        return text[:place] + form(text[place : place + 40]) + text[place + 40 :]
    if what == 1:
        wide = "".join(chr(ord(each) + 0xFEE0) if "!" <= each <= "~" else each for each in text[place:end])
        return text[:place] + wide + text[end:]
    group = rng.choice([*_characters().values()])
    return text[:place] + "".join(rng.choices(group, k=rng.choice((1, 1, 3, 50)))) + text[end:]


def _cut(text: str, other: str, rng: random.Random) -> str:
    """A text that ends too early, at a line or anywhere, or that begins too late."""
    if rng.random() < 0.5:
        lines = text.splitlines(keepends=True) or [""]
        place = rng.randrange(len(lines))
        return "".join(rng.choice((lines[:place], lines[place:])))
    place = rng.randrange(len(text) + 1)
    return rng.choice((text[:place], text[place:], text[:place] + rng.choice(WORDS), text + other))


def _key(text: str, other: str, rng: random.Random) -> str:
    """A line ``key: value`` or ``key = value`` with another value, or with another line's key."""
    pairs = [*re.finditer(r"(?m)^([ \t]*[\w.-]+[ \t]*[:=][ \t]*)(.*)$", text)]
    if not pairs:
        return _tokens(text, other, rng)
    here = rng.choice(pairs)
    value = rng.choice((rng.choice(pairs)[2], rng.choice(NUMBERS), rng.choice(WORDS), json.dumps(rng.choice(VALUES))))
    return text[: here.start()] + rng.choice((here, rng.choice(pairs)))[1] + value + text[here.end() :]


_OF_TEXT: list[Callable[[str, str, random.Random], str]] = [
    _splice, _tokens, _tokens, _numbers, _numbers, _unicode, _cut, _blocks, _blocks, _key,
]  # fmt: skip


# --- other forms ---


def _bytes(data: bytes, other: bytes, rng: random.Random) -> bytes:
    """Bytes changed, cut, doubled, or taken from another input."""
    place = rng.randrange(len(data) + 1)
    end = place + rng.choice((0, 1, 2, 4, 64, 4096))
    start = rng.randrange(len(other) + 1)
    piece = rng.choice((b"", rng.randbytes(end - place), data[place:end] * 3, other[start : start + end - place]))
    if rng.random() < 0.3:
        piece = rng.choice((0, 1, 255, 256, 2**31, 2**32 - 1)).to_bytes(4, rng.choice(("big", "little")))
        end = place + 4
    return data[:place] + piece + (data[end:] if rng.random() < 0.9 else b"")


def _json(text: str, other: bytes, rng: random.Random) -> str:
    """JSON, or a line of JSON lines, of which one value is another one, doubled, or gone; a text in it is made odd."""
    try:
        whole = json.loads(text)
        before = after = ""
    except ValueError:
        lines = text.split("\n")
        place = rng.randrange(len(lines))
        whole = json.loads(lines[place])
        before = "".join(f"{line}\n" for line in lines[:place])
        after = "".join(f"\n{line}" for line in lines[place + 1 :])
    places: list[tuple[Any, Any]] = []
    waiting = [whole]
    while waiting:
        each = waiting.pop()
        keys = list(each) if isinstance(each, dict) else range(len(each)) if isinstance(each, list) else []
        places += [(each, key) for key in keys]
        waiting += [each[key] for key in keys]
    if not places:
        return before + json.dumps(rng.choice(VALUES)) + after
    inside, key = rng.choice(places)
    value = inside[key]
    what = rng.randrange(6)
    if isinstance(value, str) and rng.random() < 0.6:
        inside[key] = as_text(mutated(value.encode("utf-8", "surrogatepass"), other, rng))
    elif what == 0:
        del inside[key]
    elif what == 1:
        deeper, at = rng.choice(places)
        inside[key] = json.loads(json.dumps(deeper[at])) if at in deeper or isinstance(deeper, list) else None
    elif what == 2 and isinstance(inside, list):
        inside[key:key] = [value] * rng.choice((1, 3, 500))
    elif what == 3 and isinstance(inside, dict):
        inside[rng.choice((f"{key} ", str(key).upper(), "x"))] = inside.pop(key)
    elif what == 4:
        inside[key] = rng.choice(([value], {"x": value}, str(value), json.loads("[" * 90 + "]" * 90)))
    else:
        inside[key] = rng.choice(VALUES)
    return before + json.dumps(whole) + after


def _zip(data: bytes, other: bytes, rng: random.Random) -> bytes:
    """A zip with odd files in it, or odd names, or files doubled, gone or packed in another way."""
    out = io.BytesIO()
    with ZipFile(io.BytesIO(data)) as source, ZipFile(out, "w") as target:
        files = [(info.filename, source.read(info)) for info in source.infolist()]
        place = rng.randrange(len(files) or 1)
        name, inside = files[place] if files else ("pack.toml", b"")
        what = rng.randrange(9)
        if what == 0:
            files.pop(place)
        elif what == 1:
            new = rng.choice(
                (f"a/{name}", f"../{name}", f"/{name}", name.upper(), rng.choice(WORDS), rng.choice(files)[0])
            )
            files[place] = new, inside
        elif what == 2:
            files += [(f"{number}-{name}", inside[:99]) for number in range(rng.choice((1, 5, 300)))]
        else:
            files[place] = name, mutated(inside, rng.choice((other, rng.choice(files)[1])), rng)
        packing = rng.choice((ZIP_STORED, ZIP_DEFLATED, ZIP_DEFLATED, ZIP_DEFLATED, ZIP_BZIP2))
        for filename, content in files:
            target.writestr(filename.replace("\0", "") or "x", content, packing)
    return out.getvalue()


def _array(data: bytes, rng: random.Random) -> bytes:
    """An array whose header claims another kind or shape, or whose numbers are others."""
    length = int.from_bytes(data[8:10], "little")
    content = data[10 + length :]
    if rng.random() < 0.3:
        return data[: 10 + length] + _bytes(content, content, rng)
    header = io.BytesIO()
    about: dict[str, Any] = {
        "descr": rng.choice(KINDS),
        "fortran_order": rng.random() < 0.1,
        "shape": rng.choice(SHAPES),
    }
    with suppress(ValueError, SyntaxError, TypeError):
        shape, _, kind = np.lib.format.read_array_header_1_0(io.BytesIO(data[8:]))
        about |= rng.choice(({"shape": shape}, {"descr": np.lib.format.dtype_to_descr(kind)}, {}))
    np.lib.format.write_array_header_1_0(header, about)
    return header.getvalue() + rng.choice((content, content * 2, content[:-8], b"", rng.randbytes(120)))
