"""Films of recordings: a GIF, or a folder of PNG pictures."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from threading import Thread
from typing import Any

import pygame

from ninja_game.errors import NinjaGameError
from ninja_game.files.user_folder import export_path
from ninja_game.files.writing import write_atomically
from ninja_game.play.level.hud import Hud
from ninja_game.play.replay.playback import Playback, RecordedRun
from ninja_game.play.ui.palette import ROLES, Palette, mixed, palette_named
from ninja_game.play.view.level_view import LevelView
from ninja_game.play.view.render_context import OffscreenContext
from ninja_game.player.settings import Settings
from ninja_game.runtime import IN_PAGE, ONLY_ON_A_DESKTOP, beside
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.simulation import Simulation

FILM_SIZE = (528, 400)
_TAIL = TICKS_PER_SECOND
"""Ticks after the end that a film shows."""
_SHORTEST_MS = 20
"""Players of GIFs show no picture for a shorter time."""
_LONG_FILM = 600
"""Ticks beyond which a film leaves every second one out."""


class _StoppedError(Exception):
    """The film is not wanted any more."""


def film_pictures(
    run: RecordedRun, size: tuple[int, int] = FILM_SIZE, settings: Settings | None = None
) -> Iterator[pygame.Surface]:
    """One picture a tick, always the same surface; the first shows the start. Raises LevelError."""
    context = OffscreenContext(size, settings)
    length = film_length(run)
    playback = Playback(Simulation(run.level, body=run.body), run.inputs, spacing=0)
    view = LevelView(context, playback.simulation)
    surface = pygame.Surface(size)
    hud = Hud(context.theme)
    for tick in range(length):
        if tick:
            playback.step()
            view.on_tick()
        view.draw(surface, 1.0, whole=tick == 0)
        view.also_covered(hud.label(surface, run.title))
        yield surface


def film_length(run: RecordedRun) -> int:
    """How many ticks a film of a run shows, its start included. Raises LevelError for a level that cannot be played."""
    return Playback(Simulation(run.level, body=run.body), run.inputs, spacing=0).find_end() + 1 + _TAIL


def export_film(
    run: RecordedRun, path: Path, *, size: tuple[int, int] = FILM_SIZE, speed: float = 1.0,
    settings: Settings | None = None, report: Callable[[int], bool] = lambda _: True,
) -> bool:  # fmt: skip
    """Write a film to ``path``: a GIF, or a folder of PNG pictures, one a tick, for a path without suffix.

    ``size``: px. ``speed``: 1 is that of the game. ``report`` is told how many ticks are done; where it gives False,
    the film is given up: then this gives False and leaves no GIF. Raises NinjaGameError for another suffix, OSError.
    """

    def pictures() -> Iterator[pygame.Surface]:
        for number, picture in enumerate(film_pictures(run, size, settings)):
            if not report(number):
                raise _StoppedError
            yield picture

    try:
        if path.suffix == ".gif":
            write_gif(pictures(), film_length(run), path, size, speed, palette_named((settings or Settings()).palette))
        elif path.suffix:
            raise NinjaGameError(f"{path}: a film is a .gif, or a folder of pictures (a path without suffix)")
        else:
            path.mkdir(parents=True, exist_ok=True)
            for number, picture in enumerate(pictures()):
                pygame.image.save(picture, str(path / f"{number:05d}.png"))
    except _StoppedError:
        return False
    return True


def write_gif(
    pictures: Iterator[pygame.Surface], length: int, path: Path, size: tuple[int, int], speed: float, palette: Palette
) -> None:
    """Write ``length`` pictures of ``size`` px, one a tick, as a GIF in the colours of a palette.

    Raises OSError, and NinjaGameError in a page, which has no library for GIFs.
    """
    if IN_PAGE:
        raise NinjaGameError(ONLY_ON_A_DESKTOP)
    from PIL import Image

    tick_ms = 1000 / TICKS_PER_SECOND / speed
    every = max(2 if length > _LONG_FILM else 1, round(_SHORTEST_MS / tick_ms + 0.49))
    # A GIF counts hundredths of a second: what one picture lacks, the next one gets.
    ends = [round(number * every * tick_ms / 10) for number in range(-(-length // every) + 1)]
    durations = [10 * (end - start) for start, end in pairwise(ends)]
    colours = Image.new("P", (1, 1))
    colours.putpalette(film_colours(palette))

    def images() -> Iterator[Any]:
        for number, picture in enumerate(pictures):
            if number % every == 0:
                image = Image.frombytes("RGB", size, pygame.image.tobytes(picture, "RGB"))
                yield image.quantize(palette=colours, dither=Image.Dither.NONE)

    frames = images()
    first = next(frames)
    film = io.BytesIO()
    first.save(
        film, "GIF", save_all=True, append_images=frames, duration=durations, loop=0, optimize=False
    )  # fmt: skip
    write_atomically(path, film.getvalue())


def film_colours(palette: Palette) -> list[int]:
    """The 256 colours of a film, as red, green, blue, …: those of the palette and what lies between them at edges.

    The same ones in every picture, so that nothing flickers.
    """
    roles = [getattr(palette, role) for role in ROLES]
    found = [*roles]
    for share in (0.33, 0.66):
        found += [mixed(colour, palette.background, share) for colour in roles]
    found += [mixed(colour, palette.outline, 0.5) for colour in roles]
    found += [mixed(palette.tile, palette.background, k / 12) for k in range(1, 12)]
    found += [mixed(palette.tile, palette.on_tile, k / 6) for k in range(1, 6)]
    return [channel for colour in found[:256] for channel in colour[:3]]


class ExportJob:
    """A film made in the background. ``done`` and then ``result``, a sentence for the player.

    ``folder``: the player's.
    """

    def __init__(self, run: RecordedRun, settings: Settings, folder: Path) -> None:
        self._run = run
        self._settings = settings
        self._folder = folder
        self._count = 1
        self._made = 0
        self._wanted = True
        self.done = False
        self.result = ""
        self._thread: Thread

    def start(self) -> None:
        """Begin."""
        self._thread = beside(self._make)

    def cancel(self) -> None:
        """Give up, and wait until it is given up."""
        self._wanted = False
        if self._thread.is_alive():
            self._thread.join(5)

    @property
    def percent(self) -> int:
        """How much of it is made."""
        return min(99, 100 * self._made // self._count)

    def _report(self, made: int) -> bool:
        self._made = made
        return self._wanted

    def _make(self) -> None:
        try:
            self._count = film_length(self._run)
            path = export_path(self._folder, self._run.title, ".gif")
            if export_film(self._run, path, settings=self._settings, report=self._report):
                self.result = f"Saved: {path}"
        except OSError as error:
            self.result = f"The film could not be saved: {error.strerror}"
        except NinjaGameError as error:
            self.result = f"No film: {error}"
        self.done = True
