"""Which format a text has: it shows that itself, whatever its file is called."""

from __future__ import annotations

from typing import Literal

from ninja_game.formats.ascii.reader import is_ascii_level
from ninja_game.formats.n14.level_file import MARKER, is_demo
from ninja_game.formats.replay.episode import is_episode
from ninja_game.formats.replay.text import is_replay
from ninja_game.formats.tas_lines import is_tas_text

Form = Literal["replay", "episode", "ascii", "file", "demo", "inputs", "string"]
"""A replay of ours, several that are an episode, a readable level of ours, a file of N's records, a demo of N alone,
inputs in another tool's notation, in-game strings of levels or anything else."""


def form_of(text: str) -> Form:
    """The format of a text, sound or not.

    >>> form_of("ninja-game level 1"), form_of("$hill#us##0|5^60,540#"), form_of("3:12|0|1"), form_of("0|5^60,540")
    ('ascii', 'file', 'demo', 'string')
    """
    if is_replay(text):
        return "replay"
    if is_episode(text):
        return "episode"
    if is_ascii_level(text):
        return "ascii"
    if MARKER in text or ("#" in text and "$" in text):
        return "file"
    # Labels and comments of CelesteTAS begin with # too; N's own texts have | in them.
    if text.lstrip().startswith("#") and ("|" in text or not is_tas_text(text)):
        return "file"
    if is_demo("".join(text.split())):
        return "demo"
    return "inputs" if is_tas_text(text) else "string"
