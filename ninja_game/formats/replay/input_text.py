"""Inputs written by people: runs, comments, repeat blocks, markers, other files (`docs/replay-format.md`)."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from ninja_game.errors import ReplayError
from ninja_game.files.reading import MAX_BYTES, has_folder, read_included
from ninja_game.formats.lines import Line, numbered_lines
from ninja_game.formats.replay.notations import (
    KEY_NAMES,
    Marker,
    in_our_notation,
    is_marker_name,
    is_tas_text,
    sorted_letters,
)
from ninja_game.sim.inputs import JUMP_HELD, JUMP_PRESSED, MAX_TICKS, with_press_bit

MAX_INCLUDES = 100  # most files that a text may include, repetitions counted

MAX_MARKERS = 100_000  # most markers in a text and its included files

_DEEPEST = 8  # most levels of included files, and of nested blocks

_WORD = re.compile(r';.*|#"[^"]*"|\(|\)[^ \t();]*|[^ \t();]+')
_MARKER = re.compile(r'#([\w.-]+)|#"([^"]*)"')
_RUN = re.compile(r"(\.|L?R?J?)([!-]?)(?:\*([1-9][0-9]{0,6}))?")
_BLOCK_END = re.compile(r"\)(?:\*([1-9][0-9]{0,6}))?")
_INCLUDE = re.compile(r"[ \t]*include[ \t]+([^;]*)(?:;.*)?")

_KEY_BITS = {text: keys for keys, text in enumerate(KEY_NAMES)}


class Inputs(NamedTuple):
    """The keys of every tick, one byte each, and the names of ticks."""

    keys: bytes
    markers: tuple[Marker, ...] = ()


Include = Callable[[str], tuple[str, str]]  # Turns a name in a text into a file's path and text. Raises ReplayError.

RepeatedKeys = tuple[int, str, int]  # keys that are down, "!", "-" or "" as mark, number of ticks


def read_inputs(lines: Iterable[Line], *, file: str = "", include: Include | None = None) -> Inputs:
    """Read the inputs in numbered lines. ``include``: reads the files that they name. Without it, they may name none.

    Raises ReplayError with file, line and column for malformed lines, and for more than MAX_TICKS ticks.
    """
    reader = _Reader(include)
    return _as_inputs(reader.block(lines, [file]).items)


def not_a_marker(found: str, file: str = "", line: int = 0, column: int = 0) -> ReplayError:
    expected = "a name of letters, digits, '-', '_' and '.', such as #first-jump, or a text, such as #\"wait here\""
    return ReplayError("not a marker", file, line, column, repr(found[:30]), expected)


@dataclass
class _Block:
    """Runs and names of markers, in order; ``ticks``: of all runs together. ``place``: where the block begins."""

    place: tuple[str, int, int]
    items: list[RepeatedKeys | str] = field(default_factory=list)
    ticks: int = 0

    def add(self, items: Iterable[RepeatedKeys | str], ticks: int, place: tuple[str, int, int]) -> None:
        """Append runs of ``ticks`` ticks. Raises ReplayError for more than MAX_TICKS in all."""
        self.ticks += ticks
        if self.ticks > MAX_TICKS:
            found, expected = f"{self.ticks} ticks", f"at most {MAX_TICKS}"
            raise ReplayError("the replay is too long", *place, found=found, expected=expected)
        self.items += items


class _Reader:
    """Reads the lines of a text and of the files that it includes."""

    def __init__(self, include: Include | None) -> None:
        self._include = include
        self._included = 0
        self._markers = 0
        self._read: dict[str, _Block] = {}

    def block(self, lines: Iterable[Line], files: list[str]) -> _Block:
        """Read a file as one block; ``files``: the chain of includes that led here; the last one is this file."""
        stack = [_Block((files[-1], 0, 0))]
        seen: set[str] = set()
        for number, line in lines:
            named = _INCLUDE.fullmatch(line)
            if named:
                place = files[-1], number, len(line) - len(line.lstrip()) + 1
                read = self._file(named[1].strip(), files, place)
                stack[-1].add(read.items, read.ticks, place)
                continue
            for word in _WORD.finditer(line):
                self._word(word[0], stack, seen, (files[-1], number, word.start() + 1))
        if len(stack) > 1:
            raise ReplayError("a block that does not end", *stack[-1].place, "'('", hint="close it: (R*3 RJ)*4")
        return stack[0]

    def _word(self, text: str, stack: list[_Block], seen: set[str], place: tuple[str, int, int]) -> None:
        if text.startswith(";"):
            return
        if text == "(":
            if len(stack) > _DEEPEST:
                raise ReplayError("too many blocks in blocks", *place, expected=f"at most {_DEEPEST}")
            stack.append(_Block(place))
        elif text.startswith(")"):
            _end_block(text, stack, place)
        elif text.startswith("#"):
            match = _MARKER.fullmatch(text)
            name = (match[1] or match[2]) if match else ""
            if not is_marker_name(name):
                raise not_a_marker(text, *place)
            if name in seen:
                raise ReplayError("a marker given twice", *place, repr(text), hint="choose another name")
            self._markers += 1
            if self._markers > MAX_MARKERS:
                raise ReplayError("too many markers", *place, repr(text), f"at most {MAX_MARKERS:,}")
            seen.add(name)
            stack[-1].items.append(name)
        else:
            match = _RUN.fullmatch(text)
            if match is None or not match[1]:
                raise _bad_run(text, *place)
            count = int(match[3] or 1)
            stack[-1].add([(_KEY_BITS[match[1]], match[2], count)], count, place)

    def _file(self, name: str, files: list[str], place: tuple[str, int, int]) -> _Block:
        self._included += 1
        if self._include is None:
            raise ReplayError("a text that is in no folder takes in no file", *place, repr(name[:40]))
        if self._included > MAX_INCLUDES or len(files) > _DEEPEST:
            expected = f"at most {MAX_INCLUDES}, {_DEEPEST} deep"
            raise ReplayError("too many files taken in", *place, repr(name[:40]), expected)
        try:
            path, text = self._include(name)
        except ReplayError as error:
            error.file, error.line, error.column = place
            raise
        if path in files:
            raise ReplayError("a file that takes in itself", *place, repr(name[:40]))
        if path in self._read:
            return self._read[path]
        lines = in_our_notation(text, path) if is_tas_text(text) else numbered_lines(text)
        block = self.block(lines, [*files, path])
        # Only the first place that includes a file gets its markers; later places reuse the block without them.
        self._read[path] = replace(block, items=[item for item in block.items if not isinstance(item, str)])
        return block


def _end_block(text: str, stack: list[_Block], place: tuple[str, int, int]) -> None:
    """Close the innermost block and repeat it; its markers name ticks of the first pass."""
    match = _BLOCK_END.fullmatch(text)
    if not match:
        raise ReplayError("not the end of a block", *place, repr(text[:30]), "')' and a count, such as )*4")
    if len(stack) == 1:
        raise ReplayError("the end of a block that has not begun", *place, repr(text[:30]), hint="open it with '('")
    block, count = stack.pop(), int(match[1] or 1)
    nested = [item for item in block.items if not isinstance(item, str)]
    ticks = block.ticks * count
    if stack[-1].ticks + ticks <= MAX_TICKS:
        block.items += nested * (count - 1)
    stack[-1].add(block.items, ticks, place)


def _as_inputs(items: Iterable[RepeatedKeys | str]) -> Inputs:
    """Turn runs into ticks: without a mark, jump triggers where it goes down. A name refers to its first place."""
    keys = bytearray()
    markers: dict[str, Marker] = {}
    for item in items:
        if isinstance(item, str):
            markers.setdefault(item, Marker(len(keys), item))
            continue
        down, mark, count = item
        if mark == "!":
            down |= JUMP_PRESSED
        held_before = keys[-1] & JUMP_HELD if keys else 0
        keys.append(down if mark else with_press_bit(down, held_before))
        keys.extend(bytes([down]) * (count - 1))
    return Inputs(bytes(keys), tuple(markers.values()))


def _bad_run(text: str, file: str, line: int, column: int) -> ReplayError:
    """The error for a word that is not a run, with the likeliest fix."""
    keys, star, count = text.partition("*")
    if star and not re.fullmatch("[1-9][0-9]{0,6}", count):
        hint = "a count is a whole number from 1"
    elif star and not keys:
        hint = "a count stands next to its keys, without a blank: R*33"
    elif set(keys.upper()) <= set("LRJ!-."):
        mark = "!" if "!" in keys else "-" if "-" in keys else ""
        hint = f"write {sorted_letters(keys.upper())}{mark}{star}{count}"
    else:
        hint = "L left, R right, J jump, . no key"
    return ReplayError("not an input run", file, line, column, repr(text[:30]), "keys and a count, such as R*30", hint)


def include_reader(file: str) -> Include | None:
    """Make a reader of the files in or below the folder of ``file``; None if there is no such folder."""
    if not has_folder(file):
        return None

    sizes: dict[str, int] = {}

    def include(name: str) -> tuple[str, str]:
        included = read_included(file, name)
        if not included.path:
            expected = "a file in the replay's folder or below it"
            raise ReplayError("a file elsewhere", found=repr(name[:40]), expected=expected)
        if included.text is None:
            hint = included.problem or "no file of this name is there"
            raise ReplayError("a file that cannot be included", found=repr(name[:40]), hint=hint)
        if included.path not in sizes:
            sizes[included.path] = len(included.text.encode("utf-8", "replace"))
        if sum(sizes.values()) > MAX_BYTES:
            raise ReplayError("too much included", found=repr(name[:40]), expected=f"{MAX_BYTES >> 20} MiB in all")
        return included.path, included.text

    return include
