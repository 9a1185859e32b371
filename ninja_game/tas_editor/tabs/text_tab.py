"""The run as text, in step with the roll: a line for each span of equal keys, and a field to edit a line."""

from __future__ import annotations

import re
from bisect import bisect_right
from functools import lru_cache

import numpy as np
import pygame
from numpy.typing import NDArray

from ninja_game.errors import FormatError
from ninja_game.files.shown_text import counted
from ninja_game.formats.replay.input_text import Inputs
from ninja_game.formats.replay.notations import KEY_NAMES, Marker, marker_word
from ninja_game.sim.inputs import JUMP_HELD, JUMP_PRESSED, KEYS_DOWN, with_press_bit, with_press_bits
from ninja_game.tas.files import inputs_of_text
from ninja_game.tas.tracks import InputTrack
from ninja_game.tas_editor.editor import Span, TasEditor
from ninja_game.tas_editor.tabs.tab import SMALL, UNPLACED, EntryField, Rows, Tab, put_in_a_row
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Button

MAX_LINE = 2000  # characters of what is typed, for one line or several
_NAMED_END = re.compile(r'(?<=\s)#\s*([^"#]+)$')
_NAME_AND_COMMENT = re.compile(r'(?<=\s)#([^\s"#]+\s+#\s+[^"]+)$')
_WORD = re.compile(r'#"[^"]*"|\S+')


@lru_cache(maxsize=1)
def starts_of(track: InputTrack, unfolded: Span | None = None, kept: int = 0) -> NDArray[np.int64]:
    """The first ticks of a run's lines, in order; the last line is empty and begins behind the end.

    ``unfolded``: the section whose lines are shown, of each other one the first; None: all. ``kept``: a tick that
    begins a line though its keys are those before.
    """
    inputs = np.frombuffer(track.inputs, np.uint8)
    odd = inputs != np.frombuffer(with_press_bits(track.inputs), np.uint8)
    # The keys that are down; 16 and 8 mark a jump that no keyboard makes, and its press.
    keys = inputs & np.uint8(KEYS_DOWN) | (odd * (inputs & np.uint8(JUMP_PRESSED) | np.uint8(16))).astype(np.uint8)
    markers = [tick for tick, _ in track.markers]
    starts = np.unique([0, min(kept, len(inputs)), *(np.flatnonzero(keys[1:] != keys[:-1]) + 1), *markers, len(inputs)])
    if unfolded is None:
        return starts
    inside = (starts >= unfolded[0]) & (starts <= unfolded[1])
    return starts[inside | np.isin(starts, [0, *markers, len(inputs)])]


def section_at(track: InputTrack, tick: int) -> Span:
    """The ticks from a marker, or the start, to the next marker, or the end, around a tick."""
    bounds = sorted({0, *(marker for marker, _ in track.markers), len(track)})
    number = max(0, min(bisect_right(bounds, tick), len(bounds) - 1) - 1)
    return bounds[number], bounds[min(number + 1, len(bounds) - 1)]


def text_of(track: InputTrack, first: int, last: int, *, celeste: bool) -> str:
    """The line of the ticks ``first`` … ``last`` - 1; a jump that no keyboard makes is in our notation in both.

    >>> text_of(InputTrack(bytes([2, 2, 14, 6])), 2, 4, celeste=True)
    '2,R,J'
    """
    name = next((marker_word(name) for tick, name in track.markers if tick == first), "")
    if first == last:
        return name
    keys, held = track.inputs[first], track.keys_at(first - 1) & JUMP_HELD
    mark = "" if keys == with_press_bit(keys, held) else "!" if keys & JUMP_PRESSED else "-"
    word, count = KEY_NAMES[keys & KEYS_DOWN] + mark, last - first
    frames = ",".join([str(count), *word.strip(".")]) if celeste and not mark else f"{word}*{count}"
    return f"{name} {frames}".lstrip()


def _parsed(text: str) -> Inputs:
    words = _WORD.findall(text)
    return inputs_of_text("\n".join(words), "") if words else Inputs(b"")


def _named_in_line(typed: Inputs) -> Inputs:
    """A marker behind the last keys names these, as a comment behind a line does, unless they have a name."""
    *before, last = typed.markers or [None]
    if not typed.keys or last is None or last.tick < len(typed.keys):
        return typed
    line = int(starts_of(InputTrack(typed.keys, typed.markers))[-2])
    has_name = any(marker.tick == line for marker in typed.markers)
    return typed if has_name else typed._replace(markers=(*before, last._replace(tick=line)))


class TextTab(Tab):
    """The lines; the field holds that of the cursor's tick, or all that are selected, and Enter replaces them."""

    name = "Text"

    def __init__(self, editor: TasEditor) -> None:
        super().__init__(editor)
        self.celeste = self.folded = False
        self._track = InputTrack(b"")
        self._unfolded: Span | None = None
        self._typed_until = -1
        self._clicked = False
        self.starts = starts_of(self._track)
        self._seen: tuple[object, ...] = ()
        self._lines: Span | None = None  #: ticks of the selected lines, if there are several
        self._anchor: Span = (0, 1)  #: ticks of the line where that selection began
        self.list = Rows(self._draw_row, self._choose, hint="A click selects a line, with Shift those between")
        hint = "R*30 RJ*10 or 30,R,J, several; #name: a marker; # any text: a comment; nothing: no such ticks. Enter"
        self.field = EntryField("the line of the cursor's tick", self.put, longest=MAX_LINE, hint=hint, step=self._step)
        self.notation = Button(UNPLACED, "R*30", self._switch_notation, hint="A click: the other notation", size=SMALL)
        hint = "Only the lines from the marker before the cursor to the next one"
        self.fold = Button(UNPLACED, "Fold", self._fold, hint=hint, size=SMALL)
        self.widgets: list[Rows | EntryField | Button] = [self.field, self.fold, self.notation, self.list]

    def arrange(self, x: float, y: float, w: float, h: float) -> None:
        put_in_a_row((x + 4, y + 4, w - 8, 18), [self.field, self.fold, self.notation], (0, 44, 60))
        self.list.area = x + 4, y + 26, w - 8, h - 30

    def update(self, real_ms: int) -> None:
        self._lines = self._lines if self._lines == self.editor.selection else None
        state = self.editor.track, self.editor.cursor, self._lines, self.celeste, self.folded
        if self.editor.tab == self.name and state != self._seen:
            self._seen, self._track = state, self.editor.track
            self._unfolded = section_at(self._track, self.editor.cursor) if self.folded else None
            # Typing continues behind the last typed line, even if the keys there are equal.
            end = self.editor.cursor if self.editor.cursor == self._typed_until else 0
            self._typed_until = end or -1
            self.starts = starts_of(self._track, self._unfolded, end)
            self.list.index = int(np.searchsorted(self.starts, self.editor.cursor, "right")) - 1
            self.list.fill(range(len(self.starts)))
            if not self._clicked:  # a clicked line stays under the mouse
                self.list.show_around()
            self.field.show(self._shown_text)
        self._clicked = False

    def left(self) -> None:
        """Escape: drop the typed text and show the run's again."""
        self._seen = ()

    @property
    def _edited(self) -> Span:
        """The ticks of the lines in the field."""
        return self._lines or self.span(self.list.index)

    @property
    def _shown_text(self) -> str:
        return self._text_between(*self._lines) if self._lines else self.text(self.list.index)

    def _text_between(self, first: int, last: int) -> str:
        """All lines between the first tick and the last one, in a row."""
        within = range(int(np.searchsorted(self.starts, first)), int(np.searchsorted(self.starts, last)))
        return " ".join(map(self.text, within))

    def span(self, index: int) -> Span:
        return int(self.starts[index]), int(self.starts[index + 1 :][:1].sum() or self.starts[index])

    def text(self, index: int) -> str:
        first, last = self.span(index)
        if first < last and self._unfolded and not self._unfolded[0] <= first < self._unfolded[1]:
            name = next((marker_word(name) for tick, name in self._track.markers if tick == first), "the start")
            return f"{name}: {counted(last - first, 'tick')}"
        return text_of(self._track, first, last, celeste=self.celeste)

    def _step(self, direction: int) -> None:
        """Go to the line above or below; typed text is put in before."""
        first, last = self.span(self.list.index)
        if self.field.text.strip() == self._shown_text or self.put():
            self.editor.go(first - 1 if direction < 0 else max(last, self.editor.cursor))

    def put(self) -> bool:
        """Replace the lines by the text of the field, and go to the next one.

        Its marker stays unless the keys come with another one. A comment, ``# any text``, is the marker of the same
        keys. Whether it was done.
        """
        text, (first, last) = self.field.text.strip(), self._edited
        if text[:2].strip() == "#":
            if is_changed := self.editor.edit_selected(lambda track: track.named(first, text[1:])):
                self._go_on(last)
            return is_changed
        commented = _NAME_AND_COMMENT.search(text)
        text = text[: commented.start()] if commented else text
        try:
            try:
                typed = _parsed(text)
            except FormatError:
                # A text of several words, up to the line's end, is the name of the ticks that follow.
                if (named := _NAMED_END.sub(r'#"\1"', text)) == text:
                    raise
                typed = _parsed(named)
        except FormatError as error:
            place = f"word {error.line}: " if error.line else ""
            error.line = error.column = 0
            self.editor.refuse(f"Not changed: {place}{error}")
            return False
        if commented:  # the only name of its tick, comment included
            typed = typed._replace(markers=(*typed.markers, Marker(len(typed.keys), commented[1])))
        typed = _named_in_line(typed)

        def changed(track: InputTrack) -> InputTrack:
            left = first + bool(typed.keys and not typed.markers)
            others = tuple(marker for marker in track.markers if not left <= marker.tick < max(last, first + 1))
            result = InputTrack(track.inputs, others).replaced(first, last, typed.keys)
            for tick, name in typed.markers:
                result = result.named(first + tick, name)
            return result

        if is_changed := self.editor.edit_selected(changed):
            self._go_on(first + len(typed.keys))
        return is_changed

    def _go_on(self, tick: int) -> None:
        """Go to the line behind the typed one; it is shown before the next key, which may come at once."""
        self.editor.go(tick)
        self._typed_until = tick
        self.update(0)

    def _choose(self, index: int) -> None:
        first, last = self.span(index)
        self._clicked = True
        if pygame.key.get_mods() & pygame.KMOD_SHIFT:
            self._anchor = self._anchor if self._lines else self.editor.selection
            first, last = min(first, self._anchor[0]), min(max(last, self._anchor[1]), len(self._track))
            first = int(self.starts[np.searchsorted(self.starts, first, "right") - 1])
            last = int(self.starts[np.searchsorted(self.starts, last)])
            self.editor.select(first, last)
            if self._unfolded or len(self._text_between(first, last)) > MAX_LINE:
                self.editor.refuse(f"Selected, but edited as text line by line: over {MAX_LINE} characters, or folded")
            else:
                self._lines = self.editor.selection
        elif self._unfolded and not self._unfolded[0] <= first <= self._unfolded[1]:
            self.editor.go(first)
        else:
            self.editor.select(first, last)

    def _fold(self) -> None:
        self.folded = not self.folded
        self.fold.text = "Unfold" if self.folded else "Fold"

    def _switch_notation(self) -> None:
        self.celeste = not self.celeste
        self.notation.text = "30,R,J" if self.celeste else "R*30"

    def render_key(self) -> tuple[object, ...]:
        return self._seen, self.list.over, self.list.first

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, chosen: bool) -> None:
        x, y, w, _ = area
        number, width = str(self.starts[index]), w - 70
        if self._lines and self._lines[0] <= self.starts[index] < self._lines[1]:
            theme.canvas.frame_rect(surface, theme.palette.accent, *area, 0.75, 2)
        theme.text(surface, number, x + 44, y + 3, size=SMALL, colour=theme.palette.faint, align="right")
        theme.text(surface, self.text(index) or "(the end)", x + 56, y + 3, size=SMALL, bold=chosen, width=width)
