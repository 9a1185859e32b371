"""The text of an ASCII level that a person wrote, changed to another level: comments, order and layout stay."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Sequence
from difflib import SequenceMatcher
from itertools import takewhile
from operator import eq

from ninja_game.editor.draft import Draft
from ninja_game.errors import LevelError
from ninja_game.formats.ascii.legend import visible_parts
from ninja_game.formats.ascii.object_lines import Listed, OddTile, read_object_line
from ninja_game.formats.ascii.picture import Problems
from ninja_game.formats.ascii.reader import parse_ascii_level, sections
from ninja_game.formats.ascii.writer import (
    drawn_only,
    headers_of,
    picture_rows,
    same_record,
    tile_lines,
    write_ascii_level,
    write_object_lines,
)
from ninja_game.formats.lines import UNCOMMENTED, header_text, numbered_lines
from ninja_game.sim.level import ObjectSpec

_ROW = re.compile(r"(\s*+\d*+\s*+\|).*(\|.*)")
_RULER = re.compile(r";[\s\d]*")


def ascii_text(draft: Draft) -> str:
    return write_ascii_level(draft.level, **headers_of(draft))


def updated_text(text: str, opened: Draft, draft: Draft) -> str:
    """The text from which ``opened`` was read, changed so that ``draft`` is read from it.

    Lines that say what is still so stay as they are. A text that cannot be changed line by line is written again, its
    comments at the end.
    """
    if draft == opened:
        return text
    changed = "\n".join(_Lines(text, opened, draft).changed())
    if reads_as(changed, draft, named=draft.name != opened.name):
        return changed
    comments = [line for line in text.split("\n") if line.startswith(";") and not _RULER.fullmatch(line)]
    return ascii_text(draft) + "".join(f"\n{line}" for line in comments) + "\n" * bool(comments)


def reads_as(text: str, draft: Draft, *, named: bool = True) -> bool:
    """Whether a text is just this draft. ``named``: with its name, which a file without one gets from its path."""
    try:
        read = parse_ascii_level(text)
    except LevelError:
        return False
    given = headers_of(read) | ({} if named else {"name": draft.name})
    objects = read.level.objects
    return (
        given == headers_of(draft)
        and read.level.tiles == draft.level.tiles
        and len(objects) == len(draft.objects)
        and all(map(same_record, objects, draft.objects))
    )


class _Lines:
    """The lines of a text, and what becomes of them."""

    def __init__(self, text: str, opened: Draft, draft: Draft) -> None:
        self.lines = text.split("\n")
        self.opened, self.draft = opened, draft
        given = list(numbered_lines(text, UNCOMMENTED))
        self.first = given[0][0]
        self.header, self.rows, self.listed = sections(given[1:], Problems(""))
        self.replaced: dict[int, list[str]] = {}
        self.after: dict[int, list[str]] = defaultdict(list)

    def changed(self) -> Iterator[str]:
        """All lines of the new text."""
        self._change_header()
        self._change_picture()
        self._change_list()
        for number, line in enumerate(self.lines, 1):
            yield from self.replaced.get(number, [line])
            yield from self.after[number]

    def _change_header(self) -> None:
        places = {line.partition(":")[0].strip(): number for number, line in self.header}
        last = max([self.first, *places.values()])
        for key, value in headers_of(self.draft).items():
            before = getattr(self.opened, key)
            if value != before:
                line = f"{key}: {header_text(value)}".rstrip()
                if key in places:
                    self.replaced[places[key]] = [line]
                else:
                    self.after[last].append(line)

    def _change_picture(self) -> None:
        parts = [visible_parts(spec) for spec in self.draft.objects]
        for (number, line), chars in zip(self.rows, picture_rows(self.draft.level, parts), strict=True):
            match = _ROW.fullmatch(line)
            # A blank is as empty as a dot: what a person left blank stays so.
            old = line[match.end(1) : match.start(2)] if match else ""
            kept = "".join(" " if a == "." and b == " " else a for a, b in zip(chars, old, strict=True))
            self.replaced[number] = [f"{match[1]}{kept}{match[2]}"] if match else [line]

    def _change_list(self) -> None:
        """Keep the lines whose objects are still there, in order; put what is new between them."""
        read = {number: read_object_line(line) for number, line in self.listed}
        tiles = [number for number, entries in read.items() if entries and isinstance(entries[0], OddTile)]
        end = self._end_of_picture()
        if tile_lines(self.opened.level) != tile_lines(self.draft.level):
            self.replaced |= {number: [] for number in tiles}
            self.after[end] += tile_lines(self.draft.level)
        owners: list[tuple[int, ObjectSpec]] = [
            (number, entry.record) for number, entries in read.items() for entry in entries if isinstance(entry, Listed)
        ]
        wanted = self.draft.objects[self._count_drawn(len(owners)) :]
        keys = [repr(spec) for _, spec in owners]
        matcher = SequenceMatcher(None, keys, [repr(spec) for spec in wanted], autojunk=False)
        content: dict[int, list[ObjectSpec]] = {number: [] for number, _ in owners}
        touched: set[int] = set()
        for _, i1, i2, j1, j2 in (code for code in matcher.get_opcodes() if code[0] == "equal"):
            for i, j in zip(range(i1, i2), range(j1, j2), strict=True):
                content[owners[i][0]].append(wanted[j])
        for tag, i1, i2, j1, j2 in matcher.get_opcodes():
            if tag == "equal":
                continue
            touched |= {owners[i][0] for i in range(i1, i2)}
            within = i1 > 0 and i1 < len(owners) and owners[i1 - 1][0] == owners[i1][0]
            if within and j2 > j1:
                # New objects between two of one line: this and all behind it are written again.
                self.replaced |= {number: [] for number in content}
                self.replaced[owners[0][0]] = write_object_lines(wanted)
                return
            if j2 > j1:
                self.after[owners[i1 - 1][0] if i1 else end] += write_object_lines(wanted[j1:j2])
        for number in touched:
            self.replaced[number] = self._rewritten(number, content[number])

    def _rewritten(self, number: int, records: Sequence[ObjectSpec]) -> list[str]:
        """A line for those of its objects that are left, with the comment that it ended in."""
        lines = write_object_lines(records)
        _, mark, comment = self.lines[number - 1].partition(";")
        if mark and lines:
            lines[-1] += f"  ;{comment}"
        return lines

    def _end_of_picture(self) -> int:
        """The last line of the picture with the rulers below it."""
        number = self.rows[-1][0]
        while number < len(self.lines) and _RULER.fullmatch(self.lines[number]):
            number += 1
        return number

    def _count_drawn(self, listed: int) -> int:
        """How many of the first objects the picture alone makes: as many as before, where that is possible."""
        objects = self.draft.objects
        most = drawn_only(self.draft.level, [visible_parts(spec) for spec in objects])
        old = self.opened.objects
        before = len(old) - listed
        if not listed or old == objects:
            return most
        at = sum(1 for _ in takewhile(bool, map(eq, old, objects)))
        end = sum(1 for _ in takewhile(bool, map(eq, reversed(old[at:]), reversed(objects[at:]))))
        if at >= before:
            return min(most, before)
        if len(old) - end <= before:
            return min(most, len(objects) - listed)
        return min(most, at)
