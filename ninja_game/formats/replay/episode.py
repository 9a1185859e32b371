"""Our episode text: the replays of up to five levels in a row, with the time carried on (docs/replay-format.md)."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Sequence
from dataclasses import replace

from ninja_game.errors import ReplayError
from ninja_game.formats.lines import numbered_lines
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.pack.index import LEVELS_PER_EPISODE
from ninja_game.formats.replay.text import MAGIC as REPLAY, Replay, parse_replay, write_replay
from ninja_game.sim.level import Level
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME

MAGIC = "ninja-game episode"
FIRST_LINE = f"{MAGIC} 1"

_HEAD = re.compile(rf"^{REPLAY}\b", re.MULTILINE)


def is_episode(text: str) -> bool:
    """Whether a text begins as an episode of ours does."""
    return text.lstrip("\ufeff \t\r\n").startswith(MAGIC)


def episode_key(levels: Iterable[Level]) -> str:
    """What an episode is known by: a digest of its levels in their order."""
    return hashlib.sha256(" ".join(level_digest(level) for level in levels).encode()).hexdigest()


def lifetimes(replays: Sequence[Replay]) -> list[int]:
    """The lifetime (ticks) at the start of each level, and behind the last one, its score (game.md §1.4).

    Of replays that pass their levels with the gold and in the tick that they say.
    """
    found = [LIFETIME]
    for each in replays:
        found.append(found[-1] + GOLD_BONUS * each.gold - each.final_tick)
    return found


def parse_episode(text: str, *, file: str = "") -> list[Replay]:
    """The replays of an episode's text, in order. Each says that it passes its level, and there is time left.

    Raises ReplayError or LevelError with the line in the whole text.
    """
    heads = [match.start() for match in _HEAD.finditer(text)]
    above = [line for _, line in numbered_lines(text[: heads[0] if heads else len(text)]) if not line.startswith(";")]
    if [line.rstrip() for line in above] != [FIRST_LINE]:
        found = repr("".join(above[:1])[:40])
        raise ReplayError("not an episode", file, 1, found=found, expected=f"'{FIRST_LINE}', then replays")
    if not 1 <= len(heads) <= LEVELS_PER_EPISODE:
        found, expected = f"{len(heads)} replays", f"1 to {LEVELS_PER_EPISODE}, one for each level"
        raise ReplayError("not the replays of an episode", file, 1, 0, found, expected)
    replays: list[Replay] = []
    for start, end in zip(heads, [*heads[1:], len(text)], strict=True):
        line = text.count("\n", 0, start) + 1
        # Empty lines in front, so that an error tells the line in the whole text.
        replays.append(parse_replay("\n" * (line - 1) + text[start:end], file=file))
        if replays[-1].outcome != "exit":
            found, hint = replays[-1].outcome or "no claims", "write it with `ninja-game convert RUN… OUT.episode.txt`"
            raise ReplayError("a level of an episode that is not passed", file, line, 0, found, "outcome: exit", hint)
        if replays[-1].body != replays[0].body:
            raise ReplayError("an episode with two bodies", file, line, found=replays[-1].body)
        if (left := lifetimes(replays)[-1]) <= 0:
            what = f"the time of the episode has run out in level {len(replays)}"
            raise ReplayError(what, file, line, found=f"{left} ticks", expected="1 or more at its exit")
    return replays


def write_episode(replays: Sequence[Replay]) -> str:
    """The text of an episode's replays. Raises ReplayError for what is none, as ``parse_episode`` does."""
    text = "\n".join([FIRST_LINE, *map(write_replay, replays)])
    try:
        parse_episode(text)
    except ReplayError as error:
        raise replace(error, line=0) from None
    return text
