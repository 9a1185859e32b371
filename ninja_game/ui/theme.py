"""The look of the interface at one window size: palette and lettering."""

from __future__ import annotations

from bisect import bisect_right
from cmath import rect
from collections.abc import Iterable, Sequence
from colorsys import rgb_to_yiq, yiq_to_rgb
from dataclasses import dataclass, fields, replace
from functools import lru_cache
from math import radians
from typing import Any

import pygame

from ninja_game.files.bundled import asset_lines
from ninja_game.ui.canvas import Canvas, Colour
from ninja_game.ui.lettering import LINE_HEIGHT, Lettering

Area = tuple[float, float, float, float]  # x, y, width, height, logical px


def contains_point(area: Area, x: float, y: float) -> bool:
    left, top, w, h = area
    return left <= x < left + w and top <= y < top + h


_EDGE = 2  # px left free between a text and the window's edge

NARROWEST = 0.2
"""Width of the narrowest letter with its space, as a share of the size: longer texts are shortened before measuring."""


TEXT_SIZES = {"normal": 100, "large": 125, "largest": 150}  # sizes of text, percent


class Theme:
    """Palette and lettering for a canvas; made again when either changes.

    ``text_size``: percent. A text has that size if it fits, else the next smaller of the sizes; its middle stays. A
    text that does not fit in the normal size is shortened by dots.
    """

    def __init__(self, palette: Palette, canvas: Canvas, text_size: int = 100) -> None:
        self.palette = palette
        self.canvas = canvas
        self.lettering = Lettering(canvas)
        self.scales = [
            size / 100 for size in sorted({text_size, *TEXT_SIZES.values()}, reverse=True) if size <= text_size
        ]

    def text(
        self, surface: pygame.Surface | None, text: str, x: float, y: float, *, size: float = 8,
        colour: Colour | None = None, align: str = "left", bold: bool = False, width: float | None = None,
        height: float | None = None,
    ) -> pygame.Rect:  # fmt: skip
        """Draw a text (or, without a surface, only measure it); its px rectangle. ``y``: its top in the normal size.

        ``width``, ``height``: the room for it, logical px; by default up to the window's edge, and unlimited.
        """
        most = self._room(x, align) if width is None else min(width, self._room(x, align))
        scale = self.largest(text, size, most, bold=bold, height=height)
        text = self._fit(text, most, size * scale, bold=bold)
        y -= (scale - 1) * size * LINE_HEIGHT / 2
        return self.lettering.draw(
            surface, text, x, y, size * scale, colour or self.palette.text, align=align, bold=bold
        )

    def _room(self, x: float, align: str) -> float:
        """The room from a text's place to the window's edges."""
        left, right = self.canvas.logical((0, 0))[0], self.canvas.logical(self.canvas.window)[0]
        rooms = {"left": right - x, "right": x - left}
        return rooms.get(align, 2 * min(right - x, x - left)) - _EDGE

    def largest(
        self, text: str, size: float, width: float, *, bold: bool = False, height: float | None = None
    ) -> float:
        """The largest scale in which a text fits; the smallest if none does. ``size``: in the normal one."""
        for scale in self.scales[:-1]:
            low_enough = height is None or size * scale * LINE_HEIGHT <= height
            if low_enough and self.lettering.width(text, size * scale, bold=bold) <= width:
                return scale
        return self.scales[-1]

    def common_height(self, texts: Iterable[str], size: float, width: float) -> float:
        """The height at which all bold texts of a list of that width get the same scale."""
        return size * LINE_HEIGHT * min(self.largest(text, size, width, bold=True) for text in texts)

    def width(self, text: str, size: float = 8, *, bold: bool = False) -> float:
        """Width of a text that fits, logical px."""
        return self.lettering.width(text, size * self.scales[0], bold=bold)

    def paragraph(
        self,
        surface: pygame.Surface,
        texts: Sequence[str],
        area: Area,
        size: float,
        spacing: float,
        *,
        colour: Colour | None = None,
        align: str = "left",
    ) -> float:
        """Texts in lines as wide as an area, from its top on, as large as fits, without surplus lines; their height."""
        x, y, w, h = area
        scale, lines = self.scales[-1], [""]
        for scale in self.scales:
            lines = [line for text in texts for line in wrapped(self, text, w, size * scale / self.scales[0])]
            if len(lines) * spacing * scale <= h:
                break
        most = max(1, int(h / (spacing * scale)))
        if len(lines) > most:
            lines = [*lines[: most - 1], " ".join(lines[most - 1 :])]
        left = x + {"left": 0.0, "centre": w / 2, "right": w}[align]
        for place, line in enumerate(lines):
            drawn = self._fit(line, w, size * scale)
            top = y + spacing * scale * place
            self.lettering.draw(surface, drawn, left, top, size * scale, colour or self.palette.text, align=align)
        return spacing * scale * len(lines)

    def fit(self, text: str, width: float, size: float, *, bold: bool = False) -> str:
        """The text, shortened by dots to fit a width in the normal size."""
        return self._fit(text, width, size * self.scales[-1], bold=bold)

    def _fit(self, text: str, width: float, size: float, *, bold: bool = False) -> str:
        most = int(max(0.0, width) / (NARROWEST * size)) + 1
        if len(text) <= most and self.lettering.width(text, size, bold=bold) <= width:
            return text
        lengths = range(min(len(text), most) + 1)
        kept = bisect_right(lengths, width, key=lambda n: self.lettering.width(text[:n] + "...", size, bold=bold)) - 1
        return text[: max(0, kept)].rstrip() + "..."

    def panel(self, surface: pygame.Surface, x: float, y: float, w: float, h: float, radius: float = 3) -> pygame.Rect:
        """A panel of the interface: filled, with a thin edge; its px rectangle."""
        self.canvas.fill_rect(surface, self.palette.panel, x, y, w, h, radius)
        return self.canvas.frame_rect(surface, self.palette.panel_edge, x, y, w, h, 1, radius)

    def window(self, surface: pygame.Surface, x: float, y: float, w: float, h: float) -> pygame.Rect:
        """A large panel that lies over a level or a screen; its px rectangle."""
        self.canvas.fill_rect(surface, self.palette.base.background, x, y, w, h, 6)
        return self.canvas.frame_rect(surface, self.palette.panel_edge, x, y, w, h, 1.5, 6)

    def row(
        self,
        surface: pygame.Surface,
        area: Area,
        *,
        chosen: bool,
        focused: bool,
        radius: float = 4,
        filled: bool = True,
    ) -> None:
        """The frame of a widget or a row: highlighted if it is selected, thick with the focus."""
        if filled:
            self.canvas.fill_rect(surface, self.palette.panel, *area, radius)
        if filled or chosen:
            edge = self.palette.accent if chosen else self.palette.panel_edge
            self.canvas.frame_rect(surface, edge, *area, 2.5 if focused else 1, radius)


@dataclass(frozen=True, eq=False)
class Palette:
    """Colours by role. ``danger_by_shape``: danger is marked by spikes and bars too, not only by colour.

    ``scenery``: behind levels, one of ``scenery.SCENERIES``; "": only the background. ``mood``: the palette of which
    this one is a tone, or None.
    """

    name: str
    danger_by_shape: bool

    # The stage and the interface.
    background: pygame.Color
    tile: pygame.Color
    text: pygame.Color
    faint: pygame.Color
    on_tile: pygame.Color
    panel: pygame.Color
    panel_edge: pygame.Color
    accent: pygame.Color
    good: pygame.Color
    bad: pygame.Color
    bar_full: pygame.Color
    bar_empty: pygame.Color
    # The ninja.
    ninja: pygame.Color
    band: pygame.Color
    ghost: pygame.Color
    blood: pygame.Color
    # Objects: outline, fills from dark to light, and a colour for each that must be told apart.
    outline: pygame.Color
    dark: pygame.Color
    middle: pygame.Color
    light: pygame.Color
    bright: pygame.Color
    gold: pygame.Color
    gold_light: pygame.Color
    gold_dark: pygame.Color
    exit: pygame.Color
    exit_light: pygame.Color
    switch: pygame.Color
    mine: pygame.Color
    weapon: pygame.Color
    laser: pygame.Color
    warning: pygame.Color
    turret: pygame.Color
    launcher: pygame.Color
    electric: pygame.Color
    spark: pygame.Color
    drone: pygame.Color
    lock: pygame.Color
    trap: pygame.Color
    # Fire, smoke, dust.
    flame: pygame.Color
    ember: pygame.Color
    smoke: pygame.Color
    dust: pygame.Color
    # The scenery, with the background at the horizon; only where there is a scenery.
    sky: pygame.Color
    far: pygame.Color
    near: pygame.Color

    scenery: str = ""
    mood: Palette | None = None

    @property
    def base(self) -> Palette:
        """The mood of a tone, whose colours are the same but for rock and scenery; of any other palette itself."""
        return self.mood or self


ROLES = tuple(entry.name for entry in fields(Palette) if entry.type == "pygame.Color")


def _read_palettes() -> dict[str, Palette]:
    """The palettes of the bundled table, by name: a column each, a row for each role."""
    table = {role: values for role, *values in map(str.split, asset_lines("palettes.txt"))}
    sceneries = ["" if scenery == "none" else scenery for scenery in table["scenery"]]
    columns = zip(table["palette"], table["danger-by-shape"], sceneries, *(table[role] for role in ROLES), strict=True)
    palettes = {}
    for name, danger, scenery, *colours in columns:
        inks: dict[str, Any] = dict(zip(ROLES, map(pygame.Color, colours), strict=True))
        palettes[name] = Palette(name, danger == "yes", **inks, scenery=scenery)
    return palettes


PALETTES = _read_palettes()
CLASSIC = PALETTES["classic"]

MOODS = tuple(PALETTES[name] for name in ("morning", "noon", "afternoon", "dusk", "night"))
"""The moods by column of episodes; a pack with more columns begins again."""

GROUND_ROLES = "sky", "background", "far", "near"
"""From the upper edge of the sky to the lower one, then from the farthest layer to the nearest one."""

TONES = (
    ((0, 1.0, 0), (-62, 1.7, -42), (34, 1.5, 52), (-150, 1.3, -96), (62, 1.2, 100)),
    *(tuple((turn * tone, 1.0, turn * tone) for tone in range(5)) for turn in (-16, 9, 15, -16)),
)
"""Degrees in YIQ by which the scenery turns, factor of its saturation, degrees by which rock turns: by mood and tone.
Consecutive levels of an episode have consecutive tones; each episode begins with another one.
"""


def palette_named(name: str, column: int = 0, level: int = 0) -> Palette:
    """The palette of a name; for ``settings.BY_COLUMN``, and for an unknown name, that of a level (``Mood``)."""
    return PALETTES.get(name) or _tone(column % len(MOODS), level)


@lru_cache(maxsize=512)
def _tone(column: int, level: int) -> Palette:
    """The mood of a column in its ``level``th level: other hues, the same lightness; its name is the seed of shapes."""
    mood = MOODS[column]
    colours: dict[str, Any] = {}
    tones = TONES[column]
    scenery, colourful, rock = tones[(level + 2 * (level // len(tones))) % len(tones)]
    for role in (*GROUND_ROLES, "tile") if level else ():
        y, i, q = rgb_to_yiq(*(channel / 255 for channel in getattr(mood, role)[:3]))
        turned = complex(i, q) * (rect(1, radians(rock)) if role == "tile" else rect(colourful, radians(scenery)))
        channels = yiq_to_rgb(y, turned.real, turned.imag)
        colours[role] = pygame.Color(*(round(255 * min(1.0, max(0.0, channel))) for channel in channels))
    return replace(mood, name=f"{mood.name} {level}", mood=mood, **colours) if level else mood


NINJA_COLOURS = ("", "#d9127f", "#7d7700", "#1a6488", "#765484", "#6a2424", "#f7f7f7", "#c79400", "#787887", "#bfbfc6")
"""The ninja's colours: the palette's own, then one per completed column (game.md §8)."""

RUN_COLOURS = tuple(map(pygame.Color, ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")))
"""Colours of several runs in turn, distinct for colour-blind people too."""


def run_colour(number: int) -> pygame.Color:
    """The colour of a run by its number, from 0; after the last colour they begin again."""
    return RUN_COLOURS[number % len(RUN_COLOURS)]


def plot_colour(number: int, palette: Palette) -> pygame.Color:
    """The colour of a run on a panel: lighter than ``run_colour`` on dark ones, darker on light ones."""
    dark = palette.panel.hsla[2] < 50
    return run_colour(number).lerp("white" if dark else "black", 0.4 if dark else 0.25)


def mixed(a: pygame.Color, b: pygame.Color, share: float) -> pygame.Color:
    """A colour between two, ``share`` (0…1) of the way from ``a`` to ``b``.

    >>> mixed(pygame.Color("black"), pygame.Color(200, 100, 0), 0.5)
    Color(100, 50, 0, 255)
    """
    return a.lerp(b, min(1.0, max(0.0, share)))


NARROWER = (0.95, 0.9, 0.85, 0.8, 0.75, 0.7, 0.65, 0.6, 0.55)
"""Shares of the width that are tried for lines of equal length."""


def wrapped(theme: Theme, text: str, width: float, size: float) -> list[str]:
    """The text in as few lines as fit a width, about equally long, so that no word stands alone."""
    lines = _filled(theme, text, width, size)
    for share in NARROWER:
        narrower = _filled(theme, text, width * share, size)
        if len(narrower) > len(lines):
            break
        lines = narrower
    return lines


def _filled(theme: Theme, text: str, width: float, size: float) -> list[str]:
    lines: list[str] = []
    for word in text.split():
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and theme.width(longer, size) <= width:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines
