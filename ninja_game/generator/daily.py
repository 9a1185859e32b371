"""The level of a day: generated from the date, kept as a pack in the player's folder of levels.

Those of some four hundred days come with the game, made in advance by tools/daily_levels.py: nobody waits for them.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import date
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING

from ninja_game.files.reading import read_text
from ninja_game.files.tree import Tree
from ninja_game.files.user_folder import data_folder
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.pack.files import CERTIFICATES, INDEX, PARS, PackFiles
from ninja_game.formats.pack.pars import DIGITS, Pars, parse_pars, write_pars
from ninja_game.formats.recording import parse_replays
from ninja_game.formats.replay.text import write_replay
from ninja_game.generator.naming import AUTHOR

if TYPE_CHECKING:
    from ninja_game.generator.generate import Generated

FOLDER = "daily-levels"
"""Of the pack, in the player's folder of levels."""

PACKED = "daily.zip"
"""A pack of days to come, among the game's assets."""

_INDEX = f'name = "Daily levels"\nauthor = "{AUTHOR}"\ncomment = "A level a day, from the date"\n'
_MONDAY = 2
_OTHER_SEEDS, _NEXT_SEED = 9, 10**8
"""How many more seeds are tried for a day, and how far apart they are: no date has such a number."""


def daily_file(levels: Path, day: date) -> Path:
    """Where the level of a day is kept, below the player's folder of levels."""
    return levels / FOLDER / f"{day.isoformat()}.txt"


def daily_difficulty(day: date) -> int:
    """How hard the level of a day is to be: 2 on a Monday, 8 on a Sunday."""
    return _MONDAY + day.weekday()


def daily_seed(day: date) -> int:
    """The date as a number: 20261122 for 22 November 2026."""
    return day.year * 10_000 + day.month * 100 + day.day


def take_packed(levels: Path, day: date) -> bool:
    """Keep the level of a day, as ``make_daily`` does, if it came with the game; whether it did.

    Raises NinjaGameError or OSError where it cannot be kept.
    """
    path, file = data_folder("assets") / PACKED, daily_file(levels, day)
    # A page is without it: it would be a third of what a visitor loads.
    if not path.exists() or file.name not in (packed := PackFiles(path)).levels:
        return False
    pars = parse_pars(packed.text(PARS))[file.name]
    _keep(file, packed.text(file.name), packed.text(_certificate(file)), pars)
    return True


def make_daily(levels: Path, day: date, *, report: Callable[[str], None], stop: Event) -> bool:
    """Generate the level of a day and keep it, its certificate, par times and difficulty; False if it was stopped.

    Raises MemoryUnavailableError without Numba, another NinjaGameError or OSError where it cannot be kept.
    """
    # Only who makes a level needs NumPy.
    from ninja_game.generator.generate import generate

    for again in range(_OTHER_SEEDS + 1):
        seed = daily_seed(day) + again * _NEXT_SEED
        made = generate(seed, daily_difficulty(day), report=report, stop=stop)
        if stop.is_set():
            return False
        if made:
            _keep_made(daily_file(levels, day), made)
            return True
    return False


def _keep_made(file: Path, made: Generated) -> None:
    from ninja_game.runs.verify import verify_recording
    from ninja_game.search.certificate import named_run

    replay = write_replay(named_run(made.run, name=made.name, author=AUTHOR, level_author=AUTHOR))
    verdict = verify_recording(parse_replays(replay, file=file.stem, level=made.level)[0])
    level, run = level_digest(made.level)[:DIGITS], verdict.xy_sha256[:DIGITS]
    _keep(file, made.text, replay, Pars(level, run, made.run.end_tick, None, made.difficulty))


def _keep(file: Path, level: str, replay: str, pars: Pars) -> None:
    """Write a level into the pack, whose table of pars grows by a line; the level last, so that all of it is there."""
    pack, tree = file.parent, Tree(file.parent)
    if not (pack / INDEX).exists():
        tree.write(INDEX, _INDEX)
    tree.write(_certificate(file), replay)
    table = pack / PARS
    lines = parse_pars(read_text(table), file=str(table)) if table.exists() else {}
    tree.write(PARS, write_pars({**lines, file.name: pars}))
    tree.write(file.name, level)


def _certificate(file: Path) -> str:
    """The name of a level's certificate in its pack."""
    return f"{CERTIFICATES}/{file.stem}.exit.replay.txt"
