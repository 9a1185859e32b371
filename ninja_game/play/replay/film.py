"""Films of recordings: what is in their pictures, and how they are written."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import pygame

from ninja_game.errors import ArgumentError, NinjaGameError
from ninja_game.formats.recording import Recording
from ninja_game.play.level.ghosts import Ghost
from ninja_game.play.level.hud import Hud
from ninja_game.play.replay.film_files import write_folder, write_gif, write_webm
from ninja_game.play.replay.playback import Playback
from ninja_game.play.ui.palette import palette_named
from ninja_game.play.view.level_view import LevelView
from ninja_game.play.view.render_context import OffscreenContext
from ninja_game.player.level_context import GhostRun
from ninja_game.player.settings import Settings
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.simulation import Simulation

_TAIL = TICKS_PER_SECOND
"""Ticks after the end that a film shows."""

MOST_PICTURES = 20_000
"""Of a film whose last tick nobody named: more than eight minutes."""


class _StoppedError(Exception):
    """The film is not wanted any more."""


@dataclass(frozen=True)
class Film:
    """What a film shows: a run from the moment after ``first`` ticks to that after ``last`` (None: to its end and on).

    ``size``: px. ``speed``: 1 is that of the game. ``ghosts``: runs on the same level that go along. ``keys``: whether
    the keys that are down are shown. Raises ArgumentError for a section that is empty or begins after the end, and for
    one without ``last`` that is longer than MOST_PICTURES.
    """

    run: Recording
    size: tuple[int, int] = (528, 400)
    speed: float = 1.0
    settings: Settings | None = None
    ghosts: tuple[Recording, ...] = ()
    keys: bool = False
    first: int = 0
    last: int | None = None

    @cached_property
    def moments(self) -> range:
        """The ticks after which there is a picture. Raises LevelError for a level that cannot be played."""
        wanted = self.first + MOST_PICTURES if self.last is None else self.last
        playback = Playback(Simulation(self.run.level, body=self.run.body), self.run.inputs, spacing=0)
        # What comes after the last picture is not run.
        found = playback.find_end(wanted + 1)
        end = wanted + 1 if found is None else found + _TAIL
        if self.last is None and end > wanted:
            raise ArgumentError(f"the film has more than {MOST_PICTURES:,} pictures; name its last tick: --to")
        last = min(wanted, end)
        if self.first > last:
            raise ArgumentError(f"a film from tick {self.first} to {last} has no pictures; the run's last is {end}")
        return range(self.first, last + 1)


def film_pictures(film: Film) -> Iterator[pygame.Surface]:
    """One picture a tick, always the same surface. Raises what ``Film.moments`` does."""
    context = OffscreenContext(film.size, film.settings)
    moments = film.moments
    playback = Playback(Simulation(film.run.level, body=film.run.body), film.run.inputs, spacing=0)
    view = LevelView(context, playback.simulation)
    view.ghosts = [Ghost(GhostRun(other.title, other.inputs), other.level, other.body) for other in film.ghosts]
    surface = pygame.Surface(film.size)
    hud = Hud(context.theme)
    for tick in range(moments.stop):
        if tick:
            playback.step()
            view.on_tick()
        if tick in moments:
            view.draw(surface, 1.0, whole=tick == moments.start)
            view.also_covered(hud.label(surface, film.run.title))
            if film.keys:
                view.also_covered(hud.keys(surface, playback.keys_at(tick - 1), 604))
            yield surface


def write_film(film: Film, path: Path, report: Callable[[int], bool] = lambda _: True) -> bool:
    """Write a film to ``path``: a .gif, a .webm, or for a path without suffix a folder of PNG pictures, one a tick.

    ``report`` gets the number of pictures made so far; where it gives False, the film is given up: then this gives
    False and leaves no file. Raises NinjaGameError for another suffix, MissingExtraError, OSError, what
    ``Film.moments`` does.
    """

    def pictures() -> Iterator[pygame.Surface]:
        for number, picture in enumerate(film_pictures(film)):
            if not report(number):
                raise _StoppedError
            yield picture

    try:
        if path.suffix == ".gif":
            palette = palette_named((film.settings or Settings()).palette)
            write_gif(pictures(), len(film.moments), path, film.size, film.speed, palette)
        elif path.suffix == ".webm":
            write_webm(pictures(), path, film.size, film.speed)
        elif path.suffix:
            raise NinjaGameError(f"{path}: a film is a .gif, a .webm, or a folder of pictures (a path without suffix)")
        else:
            write_folder(pictures(), path)
    except _StoppedError:
        return False
    return True
