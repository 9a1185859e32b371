"""The content of the roll's rows: keys and values of each tick, and differences from another run."""

from __future__ import annotations

from difflib import SequenceMatcher
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import pygame
from numpy.typing import NDArray

from ninja_game.formats.replay.notations import KEY_NAMES
from ninja_game.sim.inputs import KEYS_DOWN, fit_inputs
from ninja_game.sim.states import STATE_NAMES
from ninja_game.tas.timeline import exit_distance
from ninja_game.tas.tracks import InputTrack, first_different_index
from ninja_game.tas_editor.editor import TasEditor
from ninja_game.ui.theme import Palette, plot_colour

_PREVIEW, BEFORE = -1, -2  # values of ``Compared.number`` for a run that is not among the other runs


class Compared(NamedTuple):
    """A run whose keys are compared with those of the one under edit. ``number``: of another run, PREVIEW or BEFORE."""

    track: InputTrack
    name: str
    number: int

    def colour(self, palette: Palette) -> pygame.Color:
        if self.number == BEFORE:
            return palette.ghost
        return palette.exit if self.number == _PREVIEW else plot_colour(self.number, palette)


def compared_run(editor: TasEditor) -> Compared | None:
    """The previewed result or branch, else the chosen other run, else the run before the last edit.

    None if other runs are not shown.
    """
    if not editor.ghosts:
        return None
    if editor.preview is not None:
        return Compared(editor.preview.track, editor.preview.name, _PREVIEW)
    if editor.others:
        number = editor.chosen % len(editor.others)
        return Compared(editor.others[number].track, editor.others[number].name, number)
    return Compared(editor.session.before_track, "before the edit", BEFORE)


@lru_cache(maxsize=4)
def different_keys(ours: bytes, theirs: bytes) -> NDArray[np.uint8]:
    """The keys that are down in only one of two runs, as a sum per tick of the longer run."""
    first, second = _keys(ours, theirs)
    return first ^ second


@lru_cache(maxsize=4)
def differing_ticks(ours: bytes, theirs: bytes) -> NDArray[np.intp]:
    """The ticks with different keys, except those equal to the tick before."""
    both = np.stack(_keys(ours, theirs))
    moved = np.ones(both.shape[1], bool)
    moved[1:] = (both[:, 1:] != both[:, :-1]).any(axis=0)
    return np.flatnonzero(moved & (both[0] != both[1]))


@lru_cache(maxsize=4)
def different_rows(ours: bytes, theirs: bytes, ticks: int, height: int) -> list[int]:
    """The px of a bar of this height, for this many ticks, that contain ticks with different keys."""
    different = np.flatnonzero(different_keys(ours, theirs)[:ticks])
    return np.flatnonzero(np.bincount(different * height // ticks)).tolist()


def _keys(*runs: bytes) -> list[NDArray[np.uint8]]:
    """The keys that are down in each tick of the longest of some runs."""
    ticks = max(map(len, runs))
    return [np.frombuffer(fit_inputs(inputs, ticks), np.uint8) & np.uint8(KEYS_DOWN) for inputs in runs]


FLOOR, WALL_LEFT, WALL_RIGHT = 1, 2, 4  # contacts, as a sum


class Values(NamedTuple):
    """Values of the world after a tick: px, px/tick, numbers; ``contacts``: a sum of FLOOR, WALL_LEFT, WALL_RIGHT."""

    x: float
    y: float
    vx: float
    vy: float
    state: int
    jump_timer: int
    contacts: int
    gold: int
    exit: float


class RowFacts(NamedTuple):
    """The data of a row."""

    tick: int
    keys: int  #: inputs of the tick
    before: int  #: inputs of the tick before it
    differs: int  #: the keys that are down either here or in the compared run
    values: Values | None  #: None if the tick is not simulated
    events: str
    death: str  #: killer of the ninja in this tick, "" without a death
    lead: int | None  #: ticks ahead of the other run at an event of both; None in other ticks
    name: str
    beyond: bool  #: whether it is after the last input
    over: bool  #: whether it is after the exit or the death
    changed: bool  #: whether its keys differ from the saved ones
    selected: bool
    cursor: bool


def row_facts(editor: TasEditor, first: int, last: int) -> list[RowFacts]:
    track, timeline = editor.track, editor.session.timeline
    values: list[Values | None] = [*_values(editor, first, last)]
    values += [None] * (last - first - len(values))
    end = timeline.end[0]
    begin, behind = editor.selection
    changed = changed_ticks(track, editor.session.saved)
    names = {tick: name for tick, name in track.markers if first <= tick < last}
    count, inputs = len(track), track.inputs
    other = compared_run(editor)
    differs = different_keys(inputs, other.track.inputs)[first:last].tolist() if other else []
    differs += [0] * (last - first - len(differs))
    return [
        RowFacts(
            tick,
            inputs[tick] if tick < count else 0,
            inputs[tick - 1] if 0 < tick <= count else 0,
            differs[tick - first],
            values[tick - first],
            timeline.events(tick),
            timeline.death() if tick == end else "",
            editor.leads.get(tick),
            names.get(tick, ""),
            tick >= count,
            0 <= end < tick,
            tick < count and bool(changed[tick]),
            begin <= tick < behind,
            tick == editor.cursor,
        )
        for tick in range(first, last)
    ]


def _values(editor: TasEditor, first: int, last: int) -> list[Values]:
    timeline = editor.session.timeline
    span = slice(first, min(last, timeline.simulated_until))
    column = timeline.column
    x, y = column("x")[span], column("y")[span]
    wall = np.where(column("wall_x")[span] > 0, WALL_LEFT, WALL_RIGHT) * column("near_wall")[span]
    contacts = wall + FLOOR * (column("floor_contacts")[span] > 0)
    rows = (
        x, y, x - column("prev_x")[span], y - column("prev_y")[span], column("state")[span],
        column("jump_timer")[span], contacts, column("gold")[span], exit_distance(timeline, span),
    )  # fmt: skip
    return [Values(*row) for row in zip(*(values.tolist() for values in rows), strict=True)]


_MAX_ROWS = 400  # most spans of equal keys whose changes are found one by one


def _spans(inputs: bytes) -> tuple[list[tuple[int, int]], list[int]]:
    """Keys and length of each span of equal keys, and the spans' borders."""
    keys = np.frombuffer(b"\xff" + inputs + b"\xfe", np.uint8)
    borders = np.flatnonzero(keys[1:] != keys[:-1])
    return [*zip(keys[1:][borders[:-1]].tolist(), np.diff(borders).tolist(), strict=True)], borders.tolist()


@lru_cache(maxsize=2)
def changed_ticks(track: InputTrack, saved: InputTrack) -> bytes:
    """Whether each tick of a track differs from the saved track; ticks that only moved do not."""
    ours, theirs = track.inputs, saved.inputs
    if len(ours) == len(theirs):
        return bytes(np.frombuffer(ours, np.uint8) != np.frombuffer(theirs, np.uint8))
    (old_rows, rows), starts = zip(*map(_spans, (theirs, ours)), strict=True)
    spans: list[tuple[str, int, int, int, int]] = [("replace", 0, len(old_rows), 0, len(rows))]
    if max(len(old_rows), len(rows)) <= _MAX_ROWS:
        spans = list(SequenceMatcher(None, old_rows, rows, autojunk=False).get_opcodes())
    changed = bytearray(len(ours))
    for what, *bounds in spans:
        before, first, now, last = (starts[k // 2][bound] for k, bound in enumerate(bounds))
        if what != "equal":
            old, new = theirs[before:first], ours[now:last]
            begin = first_different_index(old, new)
            end = first_different_index(old[begin:][::-1], new[begin:][::-1])
            changed[now + begin : last - end] = bytes([1]) * (last - end - now - begin)
    return bytes(changed)


def key_difference_text(row: RowFacts, other: str) -> str:
    """The keys of a row and of the compared run, named ``other``, as text."""
    ours, theirs = (KEY_NAMES[keys & KEYS_DOWN] for keys in (row.keys, row.keys ^ row.differs))
    return f"{row.tick}: {ours}; {other}: {theirs}"


def row_text(row: RowFacts, *, numbers: bool) -> str:
    """The full text of a row: places and speeds to the last digit, or the rest."""
    name = f"#{row.name}  " if row.name else ""
    if row.values is None:
        return f"{name}{row.tick}: not simulated yet"
    values = row.values
    if numbers:
        places = "  ".join(f"{key} {getattr(values, key)!r}" for key in ("x", "y", "vx", "vy"))
        events = row.events.replace(" ", ", ").replace("died", f"died: {row.death}")
        return f"{name}{row.tick}:  {places}  {events}"
    touched = [
        word
        for bit, word in ((FLOOR, "on a floor"), (WALL_LEFT, "wall at the left"), (WALL_RIGHT, "wall at the right"))
        if values.contacts & bit
    ]
    words = [STATE_NAMES[values.state], f"jump timer {values.jump_timer}", *touched, f"gold {values.gold}"]
    far = f", {values.exit!r} px to the exit's disc" if np.isfinite(values.exit) else ""
    return f"{name}{row.tick}:  {', '.join(words)}{far}"
