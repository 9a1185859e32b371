"""The run as text, in step with the roll: a line for each span of the same keys, with a field to type another one."""

from __future__ import annotations

from bisect import bisect_right
from functools import lru_cache
from itertools import accumulate, groupby
from typing import NamedTuple

import pygame

from ninja_game.errors import NinjaGameError
from ninja_game.formats.replay.input_runs import ticks_as_text
from ninja_game.formats.replay.input_text import Inputs
from ninja_game.tas.files import inputs_of_text
from ninja_game.tas.input_track import InputTrack
from ninja_game.tas_editor.editor import TasEditor
from ninja_game.tas_editor.tabs.tab import SMALL, UNPLACED, EntryField, Rows, Tab
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Button

LONGEST = 300
"""Characters of a line that is typed."""


class Line(NamedTuple):
    """The text of the ticks ``first`` … ``last`` - 1, with the marker at its beginning."""

    first: int
    last: int
    text: str


@lru_cache(maxsize=1)
def lines_of(track: InputTrack, *, celeste: bool) -> list[Line]:
    """A run's lines, and an empty one behind its end; a jump that no keyboard makes is in our notation in both.

    >>> [line.text for line in lines_of(InputTrack(bytes([2, 2, 14, 6])), celeste=True)]
    ['2,R', '2,R,J', '']
    """
    words, names = list(ticks_as_text(track.inputs)), dict(track.markers)
    parts = accumulate(tick in names for tick in range(len(words)))
    found, at = [], 0
    for (_, word), ticks in groupby(zip(parts, words, strict=True)):
        count = len(list(ticks))
        frames = ",".join([str(count), *word.strip(".")]) if celeste and word[-1] not in "!-" else f"{word}*{count}"
        found.append(Line(at, at + count, f"#{names[at]} {frames}" if at in names else frames))
        at += count
    return [*found, Line(at, at, "")]


class TextTab(Tab):
    """The lines; that of the cursor's tick stands in the field, and Enter puts what is typed there in its place."""

    name = "Text"

    def __init__(self, editor: TasEditor) -> None:
        super().__init__(editor)
        self.celeste = False
        self.lines: list[Line] = []
        self._seen: tuple[object, ...] = ()
        self.list = Rows(self._draw_row, self._choose, hint="A click selects the ticks of a line")
        hint = "R*30 RJ*10 or 30,R,J, several with blanks between; #name: a marker; nothing: without these ticks. Enter"
        self.field = EntryField("the line of the cursor's tick", self.put, longest=LONGEST, hint=hint)
        self.notation = Button(UNPLACED, "30,R,J", self._turn, hint="The other notation", size=SMALL)
        self.widgets: list[Rows | EntryField | Button] = [self.field, self.notation, self.list]

    def arrange(self, x: float, y: float, w: float, h: float) -> None:
        self.field.area = x + 4, y + 4, w - 72, 18
        self.notation.area = x + w - 64, y + 4, 60, 18
        self.list.area = x + 4, y + 26, w - 8, h - 30

    def update(self, real_ms: int) -> None:
        """While it is shown: have the lines of the run as it is, and the one of the cursor's tick in the field."""
        seen = self.editor.track, self.editor.cursor, self.celeste
        if self.editor.tab == self.name and seen != self._seen:
            self._seen, self.lines = seen, lines_of(self.editor.track, celeste=self.celeste)
            self.list.index = bisect_right(self.lines, self.editor.cursor, key=lambda line: line.first) - 1
            self.list.fill(self.lines)
            self.field.show(self.lines[self.list.index].text)

    def put(self) -> None:
        """What is in the field instead of its line; the markers there are those that it names."""
        words, (first, last, _) = self.field.text.split(), self.lines[self.list.index]
        try:
            typed = inputs_of_text("\n".join(words), "the line") if words else Inputs(b"")
        except NinjaGameError as error:
            self.editor.app.notify(f"Not changed: {error}")
            return

        def changed(track: InputTrack) -> InputTrack:
            others = tuple(each for each in track.markers if not first <= each.tick < last)
            made = InputTrack(track.inputs, others).replaced(first, last, typed.keys)
            for tick, name in typed.markers:
                made = made.named(first + tick, name)
            return made

        if self.editor.edit_selected(changed):
            self.editor.go(first)

    def _choose(self, index: int) -> None:
        self.editor.select(*self.lines[index][:2])

    def _turn(self) -> None:
        self.celeste = not self.celeste
        self.notation.text = "R*30" if self.celeste else "30,R,J"

    def render_key(self) -> tuple[object, ...]:
        return self._seen, self.list.over, self.list.first

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, chosen: bool) -> None:
        x, y, w, _ = area
        line = self.lines[index]
        number, room = str(line.first), w - 70
        theme.text(surface, number, x + 44, y + 3, size=SMALL, colour=theme.palette.faint, align="right")
        theme.text(surface, line.text or "(the end)", x + 56, y + 3, size=SMALL, bold=chosen, width=room)
