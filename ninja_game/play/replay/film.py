"""Films of recordings: their pictures, and how they are written."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import chain, pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pygame

from ninja_game.errors import ArgumentError, MissingExtraError, NinjaGameError
from ninja_game.files.tree import Tree
from ninja_game.files.user_folder import export_path
from ninja_game.files.writing import write_atomically
from ninja_game.formats.recording import Recording
from ninja_game.formats.run_time import seconds_text
from ninja_game.play.replay.playback import Ghost, Playback, draw_names, ghosts_of, names_of
from ninja_game.player.settings import Settings
from ninja_game.runtime import install_hint, require_desktop, run_in_background
from ninja_game.sim.rules import GOLD_BONUS, TICKS_PER_SECOND
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import png_of
from ninja_game.ui.theme import GROUND_ROLES, ROLES, RUN_COLOURS, Palette, mixed, palette_named
from ninja_game.view.hud import Hud
from ninja_game.view.level_view import LevelView, OffscreenContext
from ninja_game.view.sprites.light import EXIT_OPEN, STYLES

if TYPE_CHECKING:
    from ninja_game.runs.splits import RunSplits

_TAIL = TICKS_PER_SECOND  # ticks that a film shows after the end

MAX_PICTURES = 20_000  # most pictures of a film without a given last tick: more than eight minutes


SHOWN_SPLITS = 3  # the last ones of a run, at most
_LETTERS = 12.0  # least size of the letters above and below the level, px: films are small
MAX_LETTER_SIZE = 18.0  # the greatest, for which the border has room, px of the level


class _StoppedError(Exception):
    """The film was cancelled."""


@dataclass(frozen=True)
class Film:
    """The content of a film: a run, and others.

    Raises ArgumentError for a section that is empty or begins after the end, and for one without ``last`` in which the
    runs have more than MAX_PICTURES together.
    """

    run: Recording
    size: tuple[int, int] = (528, 400)  #: size of a run's picture, px
    speed: float = 1.0  #: 1: that of the game
    settings: Settings | None = None
    ghosts: tuple[Recording, ...] = ()  #: runs on the same level in the same picture
    colours: tuple[int, ...] = ()  #: numbers of the ghosts (``run_colour``), if not in order
    keys: bool = False  #: show the keys that are down
    first: int = 0  #: tick
    last: int | None = None  #: tick; None: a second after its end
    beside: tuple[Recording, ...] = ()  #: up to three more runs, each in a picture of its own
    splits: bool = False  #: show time and splits, and by how many ticks other runs are later
    gold: bool = False  #: splits of gold too
    known_moments: range | None = None  #: the result of ``moments``, if it is known

    @property
    def whole_size(self) -> tuple[int, int]:
        others, (w, h) = len(self.beside), self.size
        return w * min(2, 1 + others), h * (1 + others // 2)

    @cached_property
    def moments(self) -> range:
        """The ticks with a picture. Raises LevelError for a level that cannot be played."""
        if self.known_moments is not None:
            return self.known_moments
        runs = self.run, *self.beside
        end_tick = self.first + MAX_PICTURES // len(runs) if self.last is None else self.last
        # Ticks after the last picture are not simulated.
        ends = [
            Playback(Simulation(run.level, body=run.body), run.inputs, spacing=0).find_end(end_tick + 1) for run in runs
        ]
        end = max(end_tick + 1 if tick is None else tick + _TAIL for tick in ends)
        if self.last is None and end > end_tick:
            raise ArgumentError(f"the film has more than {MAX_PICTURES:,} pictures; name its last tick: --to")
        last = min(end_tick, end)
        if self.first > last:
            raise ArgumentError(f"a film from tick {self.first} to {last} has no pictures; the run's last is {end}")
        return range(self.first, last + 1)


def length_of(films: Sequence[Film]) -> int:
    """The number of pictures of films. Raises as ``Film.moments`` does."""
    return sum(len(film.moments) for film in films)


def section_of(films: Sequence[Film], first: int, last: int | None) -> list[Film]:
    """A section of consecutive films between two pictures, counted from 0 over all. ``last``: None: the end.

    Raises ArgumentError for an empty section.
    """
    sections, before = [], 0
    for film in films:
        count = len(film.moments)
        start = max(0, first - before)
        end = count - 1 if last is None else min(count - 1, last - before)
        if start <= end:
            # `known_moments` spares a second simulation of the runs.
            sections.append(replace(film, first=start, last=end, known_moments=film.moments[start : end + 1]))
        before += count
    if not sections:
        raise ArgumentError(f"a film from tick {first} to {last} has no pictures; there are {before:,}")
    return sections


class _Panel:
    """A run in its own picture. ``splits``: tick and text of each of its splits."""

    def __init__(self, film: Film, run: Recording, splits: Sequence[tuple[int, str]]) -> None:
        context = OffscreenContext(film.size, film.settings)
        self.film, self.run, self.splits, self.time = film, run, splits, 0
        alike = [other.title for other in (film.run, *film.beside)].count(run.title) > 1
        self.title = f"{run.title}, {run.place}" if alike and run.place else run.title
        self.playback = Playback(Simulation(run.level, body=run.body), run.inputs, spacing=0)
        self.view = LevelView(context, self.playback.simulation)
        self.hud = Hud(context.theme)
        self.letters = min(MAX_LETTER_SIZE, _LETTERS / context.canvas.scale)
        self.ghosts: list[Ghost] = []

    def step(self) -> None:
        self.playback.step()
        self.view.on_tick()
        simulation = self.playback.simulation
        self.time = simulation.tick if simulation.outcome == "running" else self.time

    def draw(self, surface: pygame.Surface, *, whole: bool) -> None:
        self.view.draw(surface, 1.0, whole=whole)
        hud, run, simulation = self.hud, self.run, self.playback.simulation
        if run.episode:
            covered = hud.time_bar(surface, run.lifetime + GOLD_BONUS * simulation.gold - self.time)
        else:
            covered = [hud.label(surface, self.title, self.letters)]
        words = [self.title] if run.episode else []
        width = 670 if self.film.keys else 744
        if self.film.splits:
            words.append(f"{seconds_text(self.time)} s")
            texts = [text for tick, text in self.splits if tick < simulation.tick][-SHOWN_SPLITS:]
            while len(texts) > 1 and hud.theme.width("; ".join([*words, *texts]), self.letters) > width:
                texts.pop(0)
            words += texts
        if self.view.context.settings.show_ghost:
            covered += draw_names(surface, hud.theme, self.ghosts, 1.0, 0.8 * self.letters)
        covered += hud.foot(surface, hud.theme.fit("; ".join(words), width, self.letters), "", self.letters)
        if self.film.keys:
            covered.append(hud.keys(surface, self.playback.keys_at(simulation.tick - 1), 704))
        for rect in covered:
            self.view.also_covered(rect)


def split_texts(own: RunSplits, others: Sequence[RunSplits]) -> list[tuple[int, str]]:
    """Tick and text of each split of a run: by how many ticks others are later (+) or earlier (-) there."""
    texts = []
    names = names_of([run.recording for run in (own, *others)])[1:]
    for split in own.splits:
        words = [split.name]
        for other, name in zip(others, names, strict=True):
            other_split = other.by_key.get(split.key)
            words.append(f"{name} {other_split.tick - split.tick:+d}" if other_split else f"{name} never")
        texts.append((split.tick, ", ".join(words)))
    return texts


def film_pictures(film: Film) -> Iterator[pygame.Surface]:
    """One picture per tick, always on the same surface. Raises as ``Film.moments`` does."""
    moments = film.moments
    w, h = film.size
    runs = (film.run, *film.beside)
    splits: list[list[tuple[int, str]]] = [[]] * len(runs)
    if film.splits:
        from ninja_game.runs.splits import SPLIT_EVENTS, run_splits

        events = SPLIT_EVENTS if film.gold else SPLIT_EVENTS[1:]

        first, *others = [run_splits(run, events, memory="auto") for run in (*runs, *film.ghosts)]
        splits = [split_texts(first, others), *(split_texts(other, [first]) for other in others[: len(film.beside)])]
    panels = [_Panel(film, *pair) for pair in zip(runs, splits, strict=True)]
    panels[0].view.ghosts = panels[0].ghosts = ghosts_of(film.ghosts, film.colours)
    surface = pygame.Surface(film.whole_size)
    places = [surface.subsurface((number % 2 * w, number // 2 * h, w, h)) for number in range(len(runs))]
    for tick in range(moments.stop):
        for panel, place in zip(panels, places, strict=True):
            if tick:
                panel.step()
            if tick in moments:
                panel.draw(place, whole=tick == moments.start)
        if tick in moments:
            yield surface


def write_film(
    films: Sequence[Film], path: Path, report: Callable[[int, int], bool] = lambda _made, _count: True
) -> bool:
    """Write films, one after the other, to ``path``: a .gif, .webm, .mp4, or a folder of pictures, 00000.png, ….

    Size, speed and colours are those of the first. ``report`` gets the numbers of pictures made and to make; if it
    gives False, the film is cancelled: this gives False and leaves no file. Raises NinjaGameError for another suffix,
    MissingExtraError, OSError, and as ``Film.moments`` does.
    """
    first, count = films[0], length_of(films)

    def pictures() -> Iterator[pygame.Surface]:
        for number, picture in enumerate(chain.from_iterable(map(film_pictures, films))):
            if not report(number, count):
                raise _StoppedError
            yield picture

    try:
        if path.suffix == ".gif":
            palette = palette_named((first.settings or Settings()).palette)
            numbers = first.colours or range(len(first.ghosts))
            write_gif(pictures(), count, path, first.whole_size, first.speed, palette, numbers)
        elif path.suffix in _VIDEO:
            write_video(pictures(), path, first.whole_size, first.speed)
        elif path.suffix:
            raise NinjaGameError(f"{path}: a film is a .gif, .webm, .mp4, or a folder of pictures (no suffix)")
        else:
            folder = Tree(path)
            for number, picture in enumerate(pictures()):
                folder.write(f"{number:05d}.png", png_of(picture))
    except _StoppedError:
        return False
    return True


_MIN_MS = 20  # shortest time of a picture that players of GIFs respect
_LONG_FILM = 600  # a GIF of more ticks has a picture only every second tick
_MAX_PER_SECOND = 60  # most pictures per second of a video; a faster one skips some
_VIDEO: dict[str, tuple[str, dict[str, object]]] = {
    ".webm": ("libvpx-vp9", {"crf": "24", "b:v": "0", "deadline": "good", "cpu-used": "5"}),
    ".mp4": ("libx264", {"crf": "20"}),
}
"""A video's encoder and its options for high quality, by suffix."""


def write_gif(
    pictures: Iterator[pygame.Surface],
    length: int,
    path: Path,
    size: tuple[int, int],
    speed: float,
    palette: Palette,
    ghosts: Sequence[int] = (),
) -> None:
    """Write ``length`` pictures of ``size`` px, one per tick, as a GIF with the colours of a palette and of ghosts.

    ``ghosts``: numbers of their colours. Raises OSError, and NinjaGameError in a page, which has no library for GIFs.
    """
    require_desktop()
    from PIL import Image

    tick_ms = 1000 / TICKS_PER_SECOND / speed
    every = max(2 if length > _LONG_FILM else 1, round(_MIN_MS / tick_ms + 0.49))
    # A GIF counts hundredths of a second: the rounding error of a picture is added to the next one.
    ends = [round(number * every * tick_ms / 10) for number in range(-(-length // every) + 1)]
    durations = [10 * (end - start) for start, end in pairwise(ends)]
    colours = Image.new("P", (1, 1))
    colours.putpalette(film_colours(palette, ghosts))

    def images() -> Iterator[Any]:
        for number, picture in enumerate(pictures):
            if number % every == 0:
                image = Image.frombytes("RGB", size, pygame.image.tobytes(picture, "RGB"))
                yield image.quantize(palette=colours, dither=Image.Dither.NONE)

    frames = images()
    first = next(frames)
    film = io.BytesIO()
    first.save(film, "GIF", save_all=True, append_images=frames, duration=durations, loop=0, optimize=False)
    write_atomically(path, film.getvalue())


def write_video(pictures: Iterator[pygame.Surface], path: Path, size: tuple[int, int], speed: float) -> None:
    """Write pictures of ``size`` px, one per tick, as a WebM (VP9) or MP4 (H.264).

    Raises MissingExtraError without PyAV or its encoder, ArgumentError for an odd width or height, OSError.
    """
    codec, options = _VIDEO[path.suffix]
    try:
        import av
        import numpy as np
    except ImportError:
        raise MissingExtraError(f"a {path.suffix} needs PyAV; {install_hint('film')}") from None
    if codec not in av.codecs_available:
        raise MissingExtraError(f"this PyAV has no encoder {codec}; write a .gif, or install a build with it")
    if size[0] % 2 or size[1] % 2:
        raise ArgumentError(f"a {path.suffix} has a size in even px; found {size[0]}x{size[1]}")
    rate = Fraction(TICKS_PER_SECOND) * Fraction(speed).limit_denominator(1000)
    every = -(-rate // _MAX_PER_SECOND)
    film = io.BytesIO()
    with av.open(film, "w", format=path.suffix[1:]) as container:
        stream: av.VideoStream = container.add_stream(codec, rate=rate / every)  # type: ignore[assignment]
        stream.width, stream.height = size
        stream.pix_fmt = "yuv420p"
        stream.options = options
        for number, picture in enumerate(pictures):
            if number % every == 0:
                shape = size[1], size[0], 3
                pixels = np.frombuffer(pygame.image.tobytes(picture, "RGB"), np.uint8).reshape(shape)
                container.mux(stream.encode(av.VideoFrame.from_ndarray(pixels, format="rgb24")))
        container.mux(stream.encode(None))
    write_atomically(path, film.getvalue())


def film_colours(palette: Palette, ghosts: Sequence[int] = ()) -> list[int]:
    """The 256 colours of a film, as red, green, blue, …: those of palette and ghosts, and blends for edges.

    They are the same in every picture, so that nothing flickers.
    """
    roles = [getattr(palette, role) for role in ROLES]
    colours = [*roles]
    for share in (0.33, 0.66):
        colours += [mixed(colour, palette.background, share) for colour in roles]
    shades = [RUN_COLOURS[number] for number in sorted({number % len(RUN_COLOURS) for number in ghosts})]
    colours += [mixed(colour, palette.background, share) for colour in shades for share in (0.0, 0.55)]
    colours += [mixed(colour, palette.outline, 0.5) for colour in roles]
    colours += [mixed(palette.tile, palette.background, k / 12) for k in range(1, 12)]
    colours += [mixed(palette.tile, palette.on_tile, k / 6) for k in range(1, 6)]
    if palette.scenery:
        behind = [getattr(palette, role) for role in GROUND_ROLES]
        colours += [mixed(one, other, k / 12) for one, other in pairwise(behind) for k in range(1, 12)]
        lights = sorted({style.role for style in (*STYLES.values(), EXIT_OPEN)})
        colours += [mixed(palette.near, getattr(palette, role), k / 16) for role in lights for k in (1, 2, 3, 5, 7)]
    return [channel for colour in colours[:256] for channel in colour[:3]]


class FilmJob:
    """A film made in the background. ``done``, and then ``result``, a sentence for the player.

    ``folder``: the player's.
    """

    def __init__(self, film: Film, folder: Path) -> None:
        self._film, self._folder = film, folder
        self._count = 1
        self._made = 0
        self._wanted = True
        self.done = False
        self.result = ""
        self.thread = run_in_background(self._make, self._fail)

    def cancel(self) -> None:
        self._wanted = False
        if self.thread.is_alive():
            self.thread.join(5)

    @property
    def percent(self) -> int:
        return min(99, 100 * self._made // self._count)

    def _report(self, made: int, count: int) -> bool:
        self._made, self._count = made, count
        return self._wanted

    def _make(self) -> None:
        film = self._film
        names = dict.fromkeys((film.run.replay.name, *names_of([film.run, *film.ghosts])))
        path = export_path(self._folder, " - ".join(filter(None, names)), ".gif")
        if write_film([self._film], path, self._report):
            self.result = f"Saved: {path}"
        self.done = True

    def _fail(self, why: str) -> None:
        self.result, self.done = f"No film: {why}", True
