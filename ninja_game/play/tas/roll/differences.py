"""Where the keys of the run are not those of the run that it is compared to."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
import pygame
from numpy.typing import NDArray

from ninja_game.play.tas.editor import TasEditor
from ninja_game.play.tas.tabs.plot import colour_of
from ninja_game.play.ui.theme import Palette
from ninja_game.sim.inputs import KEYS_DOWN, fitted_inputs
from ninja_game.tas.input_track import InputTrack

PREVIEW, BEFORE = -1, -2
"""Instead of the number of another run."""


class Compared(NamedTuple):
    """A run whose keys are marked beside those of the one under edit. ``number``: of another run, or which it is."""

    track: InputTrack
    name: str
    number: int

    def colour(self, palette: Palette) -> pygame.Color:
        """That of its ghost in the level."""
        if self.number == BEFORE:
            return palette.ghost
        return palette.exit if self.number == PREVIEW else colour_of(self.number, palette)


def compared(editor: TasEditor) -> Compared | None:
    """The result of a search that is looked at, else the chosen other run, else the run before the last edit.

    None where other runs are not shown.
    """
    if not editor.ghosts:
        return None
    if editor.preview is not None:
        return Compared(editor.preview.track, "the result", PREVIEW)
    if editor.others:
        number = editor.chosen % len(editor.others)
        return Compared(editor.others[number].track, editor.others[number].name, number)
    return Compared(editor.session.before_track, "before the edit", BEFORE)


@lru_cache(maxsize=4)
def different_keys(ours: bytes, theirs: bytes) -> NDArray[np.uint8]:
    """In each tick of the longer one of two runs the keys that are down in one of them only, as a sum."""
    first, second = _keys(ours, theirs)
    return first ^ second


@lru_cache(maxsize=4)
def changes(ours: bytes, theirs: bytes) -> NDArray[np.intp]:
    """The ticks with different keys, without those in which all is as in the tick before."""
    both = np.stack(_keys(ours, theirs))
    moved = np.ones(both.shape[1], bool)
    moved[1:] = (both[:, 1:] != both[:, :-1]).any(axis=0)
    return np.flatnonzero(moved & (both[0] != both[1]))


@lru_cache(maxsize=4)
def different_rows(ours: bytes, theirs: bytes, ticks: int, height: int) -> list[int]:
    """The px of a bar of this height, for this many ticks, in which there are ticks with different keys."""
    found = np.flatnonzero(different_keys(ours, theirs)[:ticks])
    return np.flatnonzero(np.bincount(found * height // ticks)).tolist()


def _keys(*runs: bytes) -> list[NDArray[np.uint8]]:
    """The keys that are down in each tick of the longest of some runs."""
    ticks = max(map(len, runs))
    return [np.frombuffer(fitted_inputs(inputs, ticks), np.uint8) & np.uint8(KEYS_DOWN) for inputs in runs]
