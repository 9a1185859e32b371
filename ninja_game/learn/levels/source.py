"""Where levels come from, and which of them an episode is played in.

>>> level_source("00-1-mind-the-gap").names
['00-1-mind-the-gap']
>>> train, test = level_source("train"), level_source("test")
>>> len(train.levels), len(test.levels), test.names[:2]
(80, 20, ['00-2-rolling-hills', '01-3-turnstiles'])
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ninja_game.errors import ArgumentError
from ninja_game.files.resources import bundled_levels
from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.named_level import NamedLevel, parse_levels
from ninja_game.sim.level import Level

DEFAULT_LEVEL = "00-0-first-steps"

LEVELS_PER_EPISODE = 5
"""Of each episode of the set one level is for testing: level 2 of the first episode, 3 of the next, and so on."""


Which: TypeAlias = str | int | Sequence[str | int] | NDArray[np.integer]
"""Levels of a source, by name or number."""


class LevelSource:
    """Levels with their names; each is as likely as any other. ``names`` and ``levels`` are lists of one length.

    Names that are there twice get a number: "level#0", "level#1".
    """

    def __init__(self, names: Sequence[str], levels: Sequence[Level]) -> None:
        if not levels or len(names) != len(levels):
            raise ArgumentError(f"{len(names)} names for {len(levels)} levels; expected at least one level, named")
        count = Counter(names)
        seen: Counter[str] = Counter()
        self.names = []
        for name in names:
            self.names.append(f"{name}#{seen[name]}" if count[name] > 1 else name)
            seen[name] += 1
        self.levels = list(levels)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {len(self.levels)} levels: {', '.join(self.names):.60}>"

    def choose(self, draws: NDArray[np.uint64]) -> NDArray[np.intp]:
        """The number of the level of each episode, (k,), by a random number of 64 bits for each."""
        return (draws % np.uint64(len(self.levels))).astype(np.intp)

    def report(self, numbers: NDArray[np.intp], passed: NDArray[np.bool_]) -> None:
        """Take note of episodes that have ended: the numbers of their levels (k,), whether they were passed (k,)."""

    def numbers(self, which: Which, count: int = 1) -> NDArray[np.intp]:
        """The numbers (count,) of levels chosen by name or number, one for all or one for each.

        Raises ArgumentError for others.
        """
        chosen = list(which) if isinstance(which, Sequence | np.ndarray) and not isinstance(which, str) else [which]
        found = [self.names.index(each) if each in self.names else each for each in chosen]
        for each in found:
            if not isinstance(each, int | np.integer) or not 0 <= each < len(self.levels):
                expected = f"0 to {len(self.levels) - 1} or a name: {_nearest(str(each), self.names)}"
                raise ArgumentError(f"there is no level {each!r:.60}; expected {expected}")
        if len(found) not in (1, count):
            raise ArgumentError(f"{len(found)} levels for {count} worlds; expected one, or one for each")
        return np.resize(np.array(found, np.intp), count)

    @property
    def digest(self) -> str:
        """Sha256 (hex) of the levels in their order: equal for equal levels, whatever they are called."""
        return sha256("".join(map(level_digest, self.levels)).encode()).hexdigest()


Origin: TypeAlias = "str | Path | Level | NamedLevel | LevelSource | Sequence[Origin]"
"""What ``level_source`` takes."""


def level_source(origin: Origin) -> LevelSource:
    """The levels of an origin.

    ========================  =====================================================================================
    "00-0-first-steps"        a level of the game, by the name of its file
    "set"                     all of the game's levels, in playing order
    "train", "test"           the set in two parts that never change places: of each episode one level is for testing
    "curriculum"              the levels for training from the easiest on (``ninja_game.learn.levels.curriculum``);
                              "curriculum:ORIGIN": those of another origin
    "generated:3:1-8"         generated levels of difficulty 3, seeds 1 to 8; made when they are asked for, in some
                              seconds each (docs/generator.md)
    a path                    all levels of a file, folder or pack
    a text                    the levels of a text in any format
    a Level, a NamedLevel     itself
    a sequence of these       all of them
    ========================  =====================================================================================

    Raises ArgumentError for a level that there is not, LevelError for one that cannot be read; OSError as it comes.
    """
    if isinstance(origin, LevelSource):
        return origin
    if isinstance(origin, Level):
        return LevelSource(["level"], [origin])
    if isinstance(origin, NamedLevel):
        return _named([origin])
    if isinstance(origin, Path):
        return _named(load_levels(origin))
    if not isinstance(origin, str | Sequence):
        raise ArgumentError(f"level is {origin!r:.60}; expected a name, a path, a Level, or several of these")
    if not isinstance(origin, str):
        parts = [level_source(each) for each in origin]
        return LevelSource([n for p in parts for n in p.names], [level for p in parts for level in p.levels])
    if "\n" in origin or "|" in origin:
        return _named(parse_levels(origin))
    word, _, rest = origin.partition(":")
    if word == "curriculum":
        from ninja_game.learn.levels.curriculum import Curriculum

        return Curriculum(rest or "train")
    if word == "generated":
        return _generated(rest)
    files = _own_files()
    chosen = _split(list(files)).get(origin) or [name for name in files if name == origin]
    if chosen:
        return _named([named for name in chosen for named in load_levels(files[name])])
    if origin and "\0" not in origin and Path(origin).exists():
        return _named(load_levels(origin))
    words = ["set", "train", "test", "curriculum", *files]
    raise ArgumentError(f"there is no level, and no file, {origin!r:.100}; expected such as {_nearest(origin, words)}")


@cache
def _own_files() -> dict[str, Path]:
    return {path.stem: path for path in bundled_levels()}


def _split(names: Sequence[str]) -> dict[str, list[str]]:
    """The parts of the set: files EE-L-name, by the rule of LEVELS_PER_EPISODE."""
    episodes = sorted({name[:2] for name in names})
    test = {f"{episode}-{(place + 2) % LEVELS_PER_EPISODE}" for place, episode in enumerate(episodes)}
    return {
        "set": list(names),
        "train": [name for name in names if name[:4] not in test],
        "test": [name for name in names if name[:4] in test],
    }


def _named(found: Sequence[NamedLevel]) -> LevelSource:
    """Levels by the names of their files."""
    names = [Path(named.file).stem or named.name or "level" for named in found]
    return LevelSource(names, [named.level for named in found])


def _generated(text: str) -> LevelSource:
    """Generated levels: "DIFFICULTY:SEED" or "DIFFICULTY:FIRST-LAST"."""
    from ninja_game.generator.generate import EASIEST, HARDEST

    wanted, _, seeds = text.partition(":")
    first, _, last = seeds.partition("-")
    numbers = [wanted, first, last or first]
    if not all(number.isdecimal() for number in numbers) or not EASIEST <= int(wanted) <= HARDEST:
        expected = f"'generated:DIFFICULTY:FIRST-LAST', {EASIEST} to {HARDEST} and seeds, as 'generated:3:1-8'"
        raise ArgumentError(f"found 'generated:{text:.60}'; expected {expected}")
    return generated_levels(range(int(first), int(last or first) + 1), int(wanted))


def generated_levels(seeds: Iterable[int], difficulty: int) -> LevelSource:
    """Levels by ``generate``, those of the seeds that give none left out. Needs Numba; seconds for each.

    Raises MemoryUnavailableError without Numba, ArgumentError where no seed gives a level.
    """
    from ninja_game.generator.generate import generate

    made = [(seed, generate(seed, difficulty)) for seed in seeds]
    found = [(f"generated-{difficulty}-{seed}", level.level) for seed, level in made if level]
    if not found:
        raise ArgumentError(f"none of these seeds gives a level of difficulty {difficulty}; try others")
    return LevelSource([name for name, _ in found], [level for _, level in found])


def _nearest(word: str, words: Sequence[str]) -> str:
    return ", ".join(get_close_matches(word, words, 3, 0.5) or words[:3])
