"""The level of a day, stored as a pack in the player's folder of levels.

The levels of the first hundred weeks come with the game (``generator.packed``), so that nobody waits for them; later
ones are generated from the date.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import date
from pathlib import Path
from threading import Event

from ninja_game.files.bundled import data_folder
from ninja_game.files.reading import read_text
from ninja_game.files.tree import Tree
from ninja_game.files.user_folder import DAILY
from ninja_game.formats.ascii.writer import headers_of, write_ascii_level
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.pack import INDEX, PARS, certificate_name
from ninja_game.formats.pack.pars import DIGEST_DIGITS, Pars, parse_pars, write_pars
from ninja_game.formats.recording import parse_replays
from ninja_game.formats.replay.text import Replay, write_replay
from ninja_game.generator.packed import AUTHOR, PACKED, read_packed_levels

FIRST_DAY = date(2026, 11, 23)  # the Monday of the first packed level; a week has seven levels of seven difficulties

_INDEX = f'name = "Daily levels"\nauthor = "{AUTHOR}"\ncomment = "A level a day, from the date"\n'
_MONDAY = 2
_OTHER_SEEDS = 9  # number of further seeds that are tried for a day
_NEXT_SEED = 10**8  # distance between these seeds: greater than any date as a number


def daily_file(levels: Path, day: date) -> Path:
    """The file of a day's level, in the player's folder of levels."""
    return levels / DAILY / f"{day.isoformat()}.txt"


def daily_difficulty(day: date) -> int:
    """The difficulty wanted for a day: 2 on a Monday, 8 on a Sunday."""
    return _MONDAY + day.weekday()


def daily_seed(day: date) -> int:
    """The date as a number: 20261122 for 22 November 2026."""
    return day.year * 10_000 + day.month * 100 + day.day


def take_packed(levels: Path, day: date) -> bool:
    """Store the level of a day as ``make_daily`` does, if it came with the game; tells whether it did.

    Raises NinjaGameError or OSError if it cannot be stored.
    """
    week = (day - FIRST_DAY).days // 7
    # Pages do not have them: they would be a sixth of the download.
    if week < 0 or not (data_folder("assets") / PACKED).exists():
        return False
    levels_of_day = read_packed_levels(daily_difficulty(day))
    if week >= len(levels_of_day):
        return False
    from ninja_game.search.certificate import verified_run  # pages have no search

    packed = levels_of_day[week]
    run = verified_run(packed.level, packed.inputs)
    _keep(daily_file(levels, day), packed.named, run, packed.difficulty)
    return True


def make_daily(levels: Path, day: date, *, report: Callable[[str], None], stop: Event) -> bool:
    """Generate the level of a day and store it with certificate, par times and difficulty; False if it was stopped.

    Raises MemoryUnavailableError without Numba, another NinjaGameError or OSError if it cannot be stored.
    """
    # Imported here since it needs NumPy, and a packed level does not.
    from ninja_game.generator.generate import generate

    for turn in range(_OTHER_SEEDS + 1):
        seed = daily_seed(day) + turn * _NEXT_SEED
        generated = generate(seed, daily_difficulty(day), report=report, stop=stop)
        if stop.is_set():
            return False
        if generated:
            _keep(daily_file(levels, day), generated.named, generated.run, generated.difficulty)
            return True
    return False


def _keep(file: Path, named: NamedLevel, run: Replay, difficulty: float) -> None:
    """Write a level into the pack and add a line to its table of pars."""
    from ninja_game.runs.verify import verify_recording
    from ninja_game.search.certificate import named_replay

    replay = write_replay(named_replay(run, "generate", name=named.name, author=AUTHOR, level_author=AUTHOR))
    verdict = verify_recording(parse_replays(replay, file=file.stem, level=named.level)[0])
    digests = level_digest(named.level)[:DIGEST_DIGITS], verdict.xy_sha256[:DIGEST_DIGITS]
    pars = Pars(*digests, run.end_tick, None, difficulty)
    pack, tree = file.parent, Tree(file.parent)
    if not (pack / INDEX).exists():
        tree.write(INDEX, _INDEX)
    tree.write(certificate_name(file.name, "exit"), replay)
    table = pack / PARS
    lines = parse_pars(read_text(table), file=str(table)) if table.exists() else {}
    tree.write(PARS, write_pars({**lines, file.name: pars}))
    # The level is written last: where it exists, the rest is complete.
    tree.write(file.name, write_ascii_level(named.level, **headers_of(named)))
