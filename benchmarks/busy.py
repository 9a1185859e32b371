"""A busy level with a restless player, on which pictures are measured; pages read this file too."""

from __future__ import annotations

from collections.abc import Iterator
from random import Random

from ninja_game.formats.named_level import NamedLevel
from ninja_game.levels.episodes import Entry
from ninja_game.play.app import App
from ninja_game.play.level.level_play import Phase
from ninja_game.play.level.screen import LevelScreen
from ninja_game.player.playthrough import LevelPlaythrough, PacedRun
from ninja_game.sim import kinds
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.ui.input.bindings import Bindings


def busy_level() -> Level:
    """Halls full of everything that moves; the ninja runs about in a niche where little reaches it."""
    tiles = [0] * 713

    def put(column: int, row: int, tile: int) -> None:
        tiles[(column - 1) * 23 + row - 1] = tile

    for row in (6, 12, 18):
        for column in range(1, 32):
            if column % 8:
                put(column, row, (1, 2, 3, 10, 18, 26, 30)[(column + row) % 7] if column % 3 == 0 else 1)
    for row in range(19, 24):
        put(8, row, 1)
    records = [ObjectSpec(kinds.NINJA, (60.0, 560.0)), ObjectSpec(kinds.EXIT, (744.0, 60.0, 744.0, 200.0))]
    rng = Random(1)
    for k in range(24):
        x, y = 36.0 + 24 * (k + 3), (60.0, 204.0, 348.0)[k % 3]
        records.append(ObjectSpec(kinds.DRONE, (x, y, float(k % 6), float(k % 2), float(k % 3), float(k % 4))))
    records += [ObjectSpec(kinds.THWUMP, (300.0 + 48 * k, 454.0, 1.0)) for k in range(9)]
    records += [ObjectSpec(kinds.FLOOR_GUARD, (250.0 + 60 * k, 570.0, 1.0)) for k in range(6)]
    records += [ObjectSpec(kinds.BOUNCE_BLOCK, (100.0 + 40 * k, 250.0)) for k in range(14)]
    records += [ObjectSpec(kinds.TURRET, (180.0 * k + 90, 36.0)) for k in range(4)]
    records += [ObjectSpec(kinds.LAUNCHER, (150.0 * k + 90, 470.0)) for k in range(4)]
    records += [ObjectSpec(kinds.MINE, (rng.uniform(250, 750), 576.0)) for _ in range(12)]
    records += [ObjectSpec(kinds.GOLD, (36.0 + 12 * (k % 60), 100.0 + 40 * (k // 60))) for k in range(180)]
    return Level(tuple(tiles), tuple(records))


class Restless(Bindings):
    """Keys at random, held for some ticks."""

    def __init__(self) -> None:
        super().__init__()
        self._keys = self._random_keys()

    @staticmethod
    def _random_keys() -> Iterator[int]:
        rng = Random(3)
        while True:
            bits = rng.choice((1, 2, 1, 2, 5, 6, 4))
            for _ in range(rng.randrange(4, 20)):
                yield bits

    def poll(self) -> int:
        """The next of the keys."""
        return next(self._keys)


class BusyRun(LevelPlaythrough):
    """A level with a ghost."""

    def ghosts(self) -> list[PacedRun]:
        """One that runs back and forth."""
        return [PacedRun(bytes(2 if k % 90 < 60 else 1 for k in range(600)))]


def busy_screen(app: App, level: Level | None = None) -> LevelScreen:
    """Open the busy level, or another, as it is played."""
    run = BusyRun(app.player, Entry(NamedLevel("busy", "", "", level or busy_level(), ""), "yours"))
    screen = LevelScreen(app, run)
    app.push(screen)
    app.frame(0)
    screen.begin()
    return screen


def go_on(screen: LevelScreen) -> None:
    """Try again, a while after the end."""
    if screen.phase is not Phase.PLAY and screen.play.after_end > 60:
        screen.retry()
        screen.begin()
