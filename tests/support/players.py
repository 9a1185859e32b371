"""What the session's tests share: small levels, and attempts at them that are played to their end."""

from pathlib import Path

from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.named_level import NamedLevel
from ninja_game.levels.episodes import Entry, Episode, EpisodeSet
from ninja_game.player.attempt import Attempt
from ninja_game.player.catalogue import Catalogue
from ninja_game.player.player_data import PlayerData
from ninja_game.sim.level import Level
from ninja_game.sim.rules import LIFETIME

RIGHT = 2
EXIT_TICK = 23  # when a ninja that runs right from the start touches the exit of ``short_level``


def short_level(number: int = 0, *, gold: int = 0) -> Level:
    """A flat level whose exit is two steps to the right; ``number`` makes levels differ, gold lies on the way."""
    pieces = "".join(f"!0^{120 + piece},566" for piece in range(gold))
    return parse_level_string("0" * 713 + f"|5^100,566!11^160,564,130,564{pieces}!0^{300 + number},100")


def deadly_level() -> Level:
    """A mine waits to the right of the start."""
    return parse_level_string("0" * 713 + "|5^100,566!12^130,566!11^400,564,500,564")


def entry(level: Level, name: str = "short") -> Entry:
    """A level as lists have it."""
    return Entry(NamedLevel(name, "tester", "", level, f"{name}.txt"), "game")


def episode(number: int = 0, levels: int = 5) -> Episode:
    """An episode of short levels."""
    return Episode(number, "tests", tuple(entry(short_level(number * 5 + k), f"level {k}") for k in range(levels)))


def player_data(folder: Path, *episodes: Episode) -> PlayerData:
    """A player's data with only these episodes in the catalogue."""
    data = PlayerData(folder)
    catalogue = Catalogue(folder / "levels")
    catalogue.__dict__["ours"] = EpisodeSet("", "tests", (), {each.number: each for each in episodes}, ())
    data.catalogue = catalogue
    return data


def played(level: Level, *, lifetime: int = LIFETIME, practice: bool = False, wait: int = 0) -> Attempt:
    """An attempt that runs right, after ``wait`` ticks of standing, until it passes or dies."""
    attempt = Attempt(level, lifetime=lifetime, practice_mode=practice)
    for tick in range(400):
        attempt.tick(RIGHT if tick >= wait else 0)
        if attempt.outcome != "running":
            return attempt
    raise AssertionError("the attempt does not end")
