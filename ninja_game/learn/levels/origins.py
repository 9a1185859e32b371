"""The origins of levels: names, files, generated levels.

>>> level_source("00-1-mind-the-gap").names
['00-1-mind-the-gap']
>>> train, test = level_source("train"), level_source("test")
>>> len(train.levels), len(test.levels), test.names[:2]
(80, 20, ['00-2-the-chimney', '01-3-turnstiles'])
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import TypeAlias

from ninja_game.errors import ArgumentError
from ninja_game.files.bundled import own_levels
from ninja_game.formats.load import load_levels
from ninja_game.formats.named_level import NamedLevel, parse_levels
from ninja_game.formats.pack.index import LEVELS_PER_EPISODE
from ninja_game.learn.levels.source import Curriculum, LevelSource, word_like
from ninja_game.sim.level import Level

DEFAULT_LEVEL = "00-0-first-steps"

Origin: TypeAlias = "str | Path | Level | NamedLevel | LevelSource | Sequence[Origin]"
"""The arguments of ``level_source``."""


def level_source(origin: Origin) -> LevelSource:
    """The levels of an origin.

    ========================  =====================================================================================
    "00-0-first-steps"        a level of the game, by the name of its file
    "set"                     all of the game's levels, in playing order
    "train", "test"           the set in two parts that never change places: of each episode one level is for testing
    "curriculum"              the levels for training from the easiest on (``ninja_game.learn.levels.source``);
                              "curriculum:ORIGIN": those of another origin
    "generated:3:1-8"         generated levels of difficulty 3, seeds 1 to 8; made when they are asked for, in some
                              seconds each (docs/generator.md)
    "packed", "packed:3"      the generated levels that come with the game, all thousand or those of difficulty 3
    "bench:train:easy"        variations of those, made from their numbers (``ninja_game.learn.levels.bench``):
                              "bench:train" 100,000, "bench:val", "bench:test" 1,000; ":easy", ":0-9": of these
    a path                    all levels of a file, folder or pack
    a text                    the levels of a text in any format
    a Level, a NamedLevel     itself
    a sequence of these       all of them
    ========================  =====================================================================================

    Raises ArgumentError for an unknown level, LevelError for one that cannot be read; OSError as it comes.
    """
    if isinstance(origin, LevelSource):
        return origin
    if isinstance(origin, Level):
        return LevelSource(["level"], [origin])
    if isinstance(origin, NamedLevel):
        return _named([origin])
    if isinstance(origin, Path):
        return _named(load_levels(origin))
    if not isinstance(origin, str):
        if not isinstance(origin, Sequence) or not origin:
            raise ArgumentError(f"level is {origin!r:.60}; expected a name, a path, a Level, or several of these")
        parts = [level_source(source) for source in origin]
        if len(parts) == 1:
            return parts[0]
        if any(part.largest is not None for part in parts):
            raise ArgumentError("'bench:…' is a source of its own; expected it alone, not in a list with others")
        return LevelSource([name for p in parts for name in p.names], [level for p in parts for level in p.levels])
    return _level_source_by_text(origin)


def _level_source_by_text(origin: str) -> LevelSource:
    if "\n" in origin or "|" in origin:
        return _named(parse_levels(origin))
    word, _, rest = origin.partition(":")
    if word == "curriculum":
        return Curriculum(level_source(rest or "train"))
    if word == "generated":
        return _generated(rest)
    if word == "bench":
        from ninja_game.learn.levels.bench import bench_source

        return bench_source(rest)
    if word == "packed":
        return _packed(rest)
    files = _own_levels()
    chosen = _split(list(files)).get(origin) or [name for name in files if name == origin]
    if chosen:
        return _named([named for name in chosen for named in load_levels(files[name])])
    if origin and "\0" not in origin and Path(origin).exists():
        return _named(load_levels(origin))
    words = ["set", "train", "test", "curriculum", *files]
    raise ArgumentError(f"there is no level, and no file, {origin!r:.100}; expected such as {word_like(origin, words)}")


_own_levels = cache(own_levels)


def _split(names: Sequence[str]) -> dict[str, list[str]]:
    """The two parts of the set (files EE-L-name). For testing: level 2 of the first episode, 3 of the next etc."""
    episodes = sorted({name[:2] for name in names})
    test = {f"{episode}-{(place + 2) % LEVELS_PER_EPISODE}" for place, episode in enumerate(episodes)}
    return {
        "set": list(names),
        "train": [name for name in names if name[:4] not in test],
        "test": [name for name in names if name[:4] in test],
    }


def _named(levels: Sequence[NamedLevel]) -> LevelSource:
    names = [Path(named.file).stem or named.name or "level" for named in levels]
    return LevelSource(names, [named.level for named in levels])


def _generated(text: str) -> LevelSource:
    """Generated levels: "DIFFICULTY:SEED" or "DIFFICULTY:FIRST-LAST"."""
    from ninja_game.generator.generate import EASIEST, HARDEST

    difficulty, _, seeds = text.partition(":")
    first, _, last = seeds.partition("-")
    numbers = [difficulty, first, last or first]
    if not all(number.isdecimal() for number in numbers) or not EASIEST <= int(difficulty) <= HARDEST:
        expected = f"'generated:DIFFICULTY:FIRST-LAST', {EASIEST} to {HARDEST} and seeds, as 'generated:3:1-8'"
        raise ArgumentError(f"found 'generated:{text:.60}'; expected {expected}")
    return generated_levels(range(int(first), int(last or first) + 1), int(difficulty))


def _packed(difficulty: str) -> LevelSource:
    """The generated levels that come with the game: all, or those of one difficulty."""
    from ninja_game.generator import packed

    if difficulty and difficulty not in map(str, range(1, 11)):
        raise ArgumentError(f"found 'packed:{difficulty:.60}'; expected 'packed', or 'packed:1' to 'packed:10'")
    levels = packed.read_packed_levels(int(difficulty) if difficulty else None)
    return LevelSource(
        [f"generated-{level.wanted}-{level.seed}" for level in levels], [level.level for level in levels]
    )


def generated_levels(seeds: Iterable[int], difficulty: int) -> LevelSource:
    """Make levels by ``generate``, without the seeds that give none. Needs Numba, and seconds per level.

    Raises MemoryUnavailableError without Numba, ArgumentError if no seed gives a level.
    """
    from ninja_game.generator.generate import generate

    generated = [(seed, generate(seed, difficulty)) for seed in seeds]
    levels = [(f"generated-{difficulty}-{seed}", level.named.level) for seed, level in generated if level]
    if not levels:
        raise ArgumentError(f"none of these seeds gives a level of difficulty {difficulty}; try others")
    return LevelSource([name for name, _ in levels], [level for _, level in levels])
