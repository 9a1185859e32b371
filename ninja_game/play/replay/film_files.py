"""Pictures as a film: a GIF, a WebM, or a folder of PNG pictures."""

from __future__ import annotations

import io
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import pygame

from ninja_game.errors import ArgumentError, MissingExtraError
from ninja_game.files.resources import how_to_install
from ninja_game.files.tree import Tree
from ninja_game.files.writing import write_atomically
from ninja_game.play.ui.palette import ROLES, Palette, mixed
from ninja_game.runtime import require_desktop
from ninja_game.sim.rules import TICKS_PER_SECOND

_SHORTEST_MS = 20
"""Players of GIFs show no picture for a shorter time."""
_LONG_FILM = 600
"""Ticks beyond which a GIF leaves every second one out."""
_MOST_A_SECOND = 60
"""Pictures a second of a WebM; a faster one leaves some out."""


def write_gif(
    pictures: Iterator[pygame.Surface], length: int, path: Path, size: tuple[int, int], speed: float, palette: Palette
) -> None:
    """Write ``length`` pictures of ``size`` px, one a tick, as a GIF in the colours of a palette.

    Raises OSError, and NinjaGameError in a page, which has no library for GIFs.
    """
    require_desktop()
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


def write_webm(pictures: Iterator[pygame.Surface], path: Path, size: tuple[int, int], speed: float) -> None:
    """Write pictures of ``size`` px, one a tick, as a WebM (VP9), losing little.

    Raises MissingExtraError without PyAV, ArgumentError for a size in odd px, OSError.
    """
    try:
        import av
        import numpy as np
    except ImportError:
        raise MissingExtraError(f"a WebM needs PyAV; {how_to_install('film')}") from None
    if size[0] % 2 or size[1] % 2:
        raise ArgumentError(f"a WebM has a size in even px; found {size[0]}x{size[1]}")
    rate = Fraction(TICKS_PER_SECOND) * Fraction(speed).limit_denominator(1000)
    every = -(-rate // _MOST_A_SECOND)
    film = io.BytesIO()
    with av.open(film, "w", format="webm") as container:
        stream = container.add_stream("libvpx-vp9", rate=rate / every)
        stream.width, stream.height = size
        stream.pix_fmt = "yuv420p"
        stream.options = {"crf": "24", "b:v": "0", "deadline": "good", "cpu-used": "5"}
        for number, picture in enumerate(pictures):
            if number % every == 0:
                shape = size[1], size[0], 3
                pixels = np.frombuffer(pygame.image.tobytes(picture, "RGB"), np.uint8).reshape(shape)
                container.mux(stream.encode(av.VideoFrame.from_ndarray(pixels, format="rgb24")))
        container.mux(stream.encode(None))
    write_atomically(path, film.getvalue())


def write_folder(pictures: Iterator[pygame.Surface], path: Path) -> None:
    """Write pictures into a folder as 00000.png, 00001.png, … Raises OSError."""
    folder = Tree(path)
    for number, picture in enumerate(pictures):
        png = io.BytesIO()
        pygame.image.save(picture, png, ".png")
        folder.write(f"{number:05d}.png", png.getvalue())


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
