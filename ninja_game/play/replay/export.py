"""Films of recordings: a GIF (with Pillow), a folder of PNG pictures, or a video (with imageio), one picture a tick.

All of them are optional; what can be made depends on what is installed.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pygame

from ninja_game.errors import NinjaGameError
from ninja_game.files.shown_text import file_stem
from ninja_game.play.level.hud import Hud
from ninja_game.play.replay.playback import Playback, Take
from ninja_game.play.ui.palette import PALETTES, ROLES, Palette, mixed
from ninja_game.play.view.level_view import LevelView
from ninja_game.play.view.render_context import OffscreenContext
from ninja_game.player.settings import Settings
from ninja_game.sim.rules import TICKS_PER_SECOND

if TYPE_CHECKING:
    from ninja_game.player.player_data import PlayerData

GIF_SIZE = (528, 400)
VIDEO_SIZE = (1584, 1200)
_TAIL = TICKS_PER_SECOND
"""Ticks after the end that a film shows."""
_LONG_FILM = 600
"""Pictures beyond which a GIF leaves every second one out."""


def film_pictures(take: Take, size: tuple[int, int], settings: Settings | None = None) -> Iterator[pygame.Surface]:
    """One picture a tick, always the same surface; the first shows the start."""
    sheet = OffscreenContext(size, settings)
    playback = Playback(take)
    view = LevelView(sheet, playback.simulation)
    surface = pygame.Surface(size)
    hud = Hud(sheet.theme)
    for tick in range(film_length(playback)):
        if tick:
            playback.step()
            view.on_tick()
        view.draw(surface, 1.0, whole=tick == 0)
        view.also_covered(hud.label(surface, take.title))
        yield surface


def film_length(playback: Playback) -> int:
    """How many pictures a film of a take has."""
    return playback.end + 1 + _TAIL


def best_form() -> str:
    """The suffix of the best film that can be made here: ".mp4", ".gif" or "" (a folder of pictures)."""
    if find_spec("imageio") and (find_spec("imageio_ffmpeg") or find_spec("av")):
        return ".mp4"
    return ".gif" if find_spec("PIL") else ""


Report = Callable[[int], bool]
"""Told how many pictures are done; False stops the film."""


def export_film(take: Take, path: Path, *, settings: Settings | None = None, report: Report = lambda _: True) -> Path:
    """Write a film to ``path``: .gif, .mp4 (and other videos), or a folder of PNG pictures for a path without suffix.

    Raises NinjaGameError if the library for that form is not installed.
    """
    if path.suffix == ".gif":
        _write_gif(take, path, settings, report)
    elif path.suffix:
        _write_video(take, path, settings, report)
    else:
        path.mkdir(parents=True, exist_ok=True)
        for number, picture in enumerate(film_pictures(take, GIF_SIZE, settings)):
            pygame.image.save(picture, str(path / f"{number:05d}.png"))
            if not report(number):
                break
    return path


def _write_gif(take: Take, path: Path, settings: Settings | None, report: Report) -> None:
    try:
        from PIL import Image
    except ImportError:
        raise NinjaGameError("GIFs need Pillow: pip install 'ninja-game[film]'") from None

    colours = Image.new("P", (1, 1))
    colours.putpalette(film_colours(PALETTES[(settings or Settings()).palette]))
    # Pillow holds a whole film in memory: a long one has a picture every second tick.
    every = 2 if film_length(Playback(take)) > _LONG_FILM else 1

    def images() -> Iterator[Any]:
        for number, picture in enumerate(film_pictures(take, GIF_SIZE, settings)):
            if not report(number):
                return
            if number % every == 0:
                image = Image.frombytes("RGB", GIF_SIZE, pygame.image.tobytes(picture, "RGB"))
                yield image.quantize(palette=colours, dither=Image.Dither.NONE)

    frames = images()
    first = next(frames)
    rest = list(frames)
    # A GIF counts hundredths of a second: two single ticks share the half hundredth.
    durations = [50 if every == 2 else 20 if number % 2 else 30 for number in range(len(rest) + 1)]
    first.save(path, save_all=True, append_images=rest, duration=durations, loop=0, optimize=False)


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


def _write_video(take: Take, path: Path, settings: Settings | None, report: Report) -> None:
    try:
        import imageio.v2 as imageio
    except ImportError:
        raise NinjaGameError("videos need imageio: pip install 'imageio[ffmpeg]'") from None
    # Its stubs know only the readers.
    open_writer: Any = imageio.get_writer
    with open_writer(path, fps=TICKS_PER_SECOND, macro_block_size=1) as writer:
        for number, picture in enumerate(film_pictures(take, VIDEO_SIZE, settings)):
            writer.append_data(pygame.surfarray.array3d(picture).swapaxes(0, 1))
            if not report(number):
                break


class ExportJob:
    """A film made in the background. ``done`` and then ``result``, a sentence for the player."""

    def __init__(self, take: Take, settings: Settings, player: PlayerData | None) -> None:
        self._take = take
        self._settings = settings
        folder = player.replay_folder if player else Path.cwd()
        self.path = _free_path(folder, take.title)
        self._count = 1
        self._made = 0
        self._wanted = True
        self.done = False
        self.result = ""
        self._thread = threading.Thread(target=self._make, daemon=True)

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def cancel(self) -> None:
        """Give up, and wait until it is given up."""
        self._wanted = False
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
            self._count = film_length(Playback(self._take))
            self.path.parent.mkdir(parents=True, exist_ok=True)
            export_film(self._take, self.path, settings=self._settings, report=self._report)
            self.result = f"Saved as {self.path}"
        except (NinjaGameError, OSError) as error:
            self.result = f"No film: {error}"
        self.done = True


def _free_path(folder: Path, title: str) -> Path:
    """A path for a film that is not taken."""
    stem = file_stem(title, "replay")
    suffix = best_form()
    number = 1
    while (folder / f"{stem}-{number}{suffix}").exists():
        number += 1
    return folder / f"{stem}-{number}{suffix}"
