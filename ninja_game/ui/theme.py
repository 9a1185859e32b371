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

from ninja_game.ui.canvas import Canvas, Colour
from ninja_game.ui.lettering import HEIGHT, Lettering

Area = tuple[float, float, float, float]
"""x, y, width, height, logical px."""


def inside(area: Area, x: float, y: float) -> bool:
    left, top, w, h = area
    return left <= x < left + w and top <= y < top + h


EDGE = 2
"""px that stay free between a text and the window's edge."""

NARROWEST = 0.2
"""Width of the narrowest letter with its space, as a share of the size: longer texts need not be measured."""


TEXT_SIZES = {"normal": 100, "large": 125, "largest": 150}
"""Sizes of text, percent."""


class Theme:
    """Palette and lettering for a canvas; made again when either changes.

    ``text_size``: percent. Every text is as large as that where it fits, else in the next smaller of the sizes; its
    middle stays where it is. What does not fit in the normal size is shortened by dots.
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

        ``width``, ``height``: the room that it has, logical px; without a width it ends at the window's edge, without
        a height it is as high as it likes.
        """
        room = self._room(x, align) if width is None else min(width, self._room(x, align))
        scale = self.largest(text, size, room, bold=bold, height=height)
        text = self._fit(text, room, size * scale, bold=bold)
        y -= (scale - 1) * size * HEIGHT / 2
        return self.lettering.draw(
            surface, text, x, y, size * scale, colour or self.palette.text, align=align, bold=bold
        )

    def _room(self, x: float, align: str) -> float:
        """From a text's place to the window's edges."""
        left, right = self.canvas.logical((0, 0))[0], self.canvas.logical(self.canvas.window)[0]
        beside = {"left": right - x, "right": x - left}
        return beside.get(align, 2 * min(right - x, x - left)) - EDGE

    def largest(
        self, text: str, size: float, width: float, *, bold: bool = False, height: float | None = None
    ) -> float:
        """The largest scale in which a text has room; the smallest where it has none. ``size``: in the normal one."""
        for scale in self.scales[:-1]:
            high = height is None or size * scale * HEIGHT <= height
            if high and self.lettering.width(text, size * scale, bold=bold) <= width:
                return scale
        return self.scales[-1]

    def common_height(self, texts: Iterable[str], size: float, width: float) -> float:
        """The height with which bold texts of a list that is so wide all get the same scale."""
        return size * HEIGHT * min(self.largest(text, size, width, bold=True) for text in texts)

    def width(self, text: str, size: float = 8, *, bold: bool = False) -> float:
        """Width of a text that has room, logical px."""
        return self.lettering.width(text, size * self.scales[0], bold=bold)

    def paragraph(
        self, surface: pygame.Surface, texts: Sequence[str], area: Area, size: float, spacing: float, *,
        colour: Colour | None = None, align: str = "left",
    ) -> None:  # fmt: skip
        """Texts in lines as wide as an area, from its top on, as large as it has room for them; more is left out."""
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
        self, surface: pygame.Surface, area: Area, *,
        chosen: bool, focused: bool, radius: float = 4, filled: bool = True,
    ) -> None:  # fmt: skip
        """The frame of a widget or of a row: accented if it is chosen, thick where it has the focus too."""
        if filled:
            self.canvas.fill_rect(surface, self.palette.panel, *area, radius)
        if filled or chosen:
            edge = self.palette.accent if chosen else self.palette.panel_edge
            self.canvas.frame_rect(surface, edge, *area, 2.5 if focused else 1, radius)


@dataclass(frozen=True, eq=False)
class Palette:
    """Colours by role. ``danger_by_shape``: danger is marked by spikes and bars too, not only by colour.

    ``scenery``: what lies behind levels, one of ``scenery.SCENERIES``; "": nothing but the background.
    """

    name: str
    danger_by_shape: bool

    @property
    def base(self) -> Palette:
        """The mood of a tone, whose colours are the same but for rock and scenery; of any other palette itself."""
        return PALETTES.get(self.name.partition(" ")[0], self)

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
    # Things: outline, fills from dark to light, and one colour each for what must be told apart.
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
    # Behind everything, with the background at the horizon; only where there is a scenery.
    sky: pygame.Color
    far: pygame.Color
    near: pygame.Color

    scenery: str = ""


ROLES = tuple(entry.name for entry in fields(Palette) if entry.name not in {"name", "danger_by_shape", "scenery"})

_CLASSIC = dict(  # noqa: C408 - one form for all palettes
    background="#cacad0", tile="#787887", text="#17171c", faint="#5f5f6b", on_tile="#e4e4ea", panel="#dcdce1",
    panel_edge="#9a9aa6", accent="#a33a2c", good="#2d6a3a", bad="#992222", bar_full="#c0ccff",
    bar_empty="#ffab9f", ninja="#1d1d22", band="#a33a2c", ghost="#5865a0", blood="#990000", outline="#3a3a42",
    dark="#5b5b66", middle="#9a9aa5", light="#b8b8c1", bright="#ebebef", gold="#cc9900", gold_light="#f4dd55",
    gold_dark="#8a6500", exit="#8f6fb0", exit_light="#cbb4dd", switch="#5b7fb0", mine="#990f0f",
    weapon="#882222", laser="#9c1c1c", warning="#cb7679", turret="#7f335a", launcher="#4d0f2c",
    electric="#0099cc", spark="#d8f8ff", drone="#26262c", lock="#6d5a2c", trap="#8f3b3b", flame="#ffe45c",
    ember="#f09022", smoke="#84848c", dust="#8e8e9c",
)  # fmt: skip


def _palette(
    name: str, base: Palette | None = None, *, danger_by_shape: bool = False, scenery: str = "", **colours: str
) -> Palette:
    before = _CLASSIC if base is None else {role: getattr(base, role) for role in ROLES}
    horizon = colours.get("background", _CLASSIC["background"])
    changed = {"sky": horizon, "far": horizon, "near": horizon} | colours
    inks = {role: pygame.Color(colour) for role, colour in (before | changed).items()}
    return Palette(name, danger_by_shape, **inks, scenery=scenery)


CLASSIC = _palette(
    "classic", scenery="paper", sky="#c3c6d4", background="#e4e1dc", tile="#666779", exit_light="#fbf4ff"
)

DARK = _palette(
    "dark", scenery="paper", background="#23252e", sky="#15161c", tile="#565b70", text="#e8e8ee", faint="#9a9eac",
    on_tile="#e8e8ee", panel="#2e313a", panel_edge="#565b69", accent="#ff8f6b", good="#7fd08c", bad="#ff7b74",
    bar_full="#7f92e0", bar_empty="#e06a6a", ninja="#f1f1f5", band="#ff6b4a", ghost="#8fa0ff", blood="#d92626",
    outline="#0f1014", dark="#757a88", middle="#8e93a1", light="#a9aebb", bright="#e4e6ec",
    gold="#e0ae1c", gold_light="#fff08a", gold_dark="#7d5c00", exit="#9c78c8", exit_light="#d9c4ee",
    switch="#7ba4dd", mine="#ff5148", weapon="#e0433c", laser="#ff4a40", warning="#a85456", turret="#d0659c",
    launcher="#b3487c", electric="#22b8f0", spark="#e8fbff", drone="#8a8f9e", lock="#c9a24a", trap="#d06a6a",
    flame="#fff07a", ember="#ffa033", smoke="#6d707a", dust="#7b808e",
)  # fmt: skip

CONTRAST = _palette(
    "contrast", danger_by_shape=True, background="#ffffff", tile="#3a3a3a", text="#000000", faint="#333333",
    on_tile="#ffffff", panel="#ffffff", panel_edge="#000000", accent="#0033cc", good="#006000", bad="#b00000",
    bar_full="#7fb2ff", bar_empty="#ff8080", ninja="#000000", band="#0033cc", ghost="#4a6fff", blood="#c00000",
    outline="#000000", dark="#333333", middle="#888888", light="#c4c4c4", bright="#ffffff",
    gold="#c08000", gold_light="#ffe000", gold_dark="#4d3300", exit="#7a2fc0", exit_light="#d8b0ff",
    switch="#0050d0", mine="#d00000", weapon="#d00000", laser="#d00000", warning="#ff5a5a", turret="#a00060",
    launcher="#600030", electric="#0078d8", spark="#bfe8ff", drone="#000000", lock="#7a5500", trap="#a00000",
    flame="#ffd800", ember="#ff7a00", smoke="#777777", dust="#777777",
)  # fmt: skip

# Blue and orange differ for every common kind of colour blindness; danger is always orange to vermilion, and spiked.
SAFE = _palette(
    "safe", danger_by_shape=True, scenery="paper", background="#eceae4", sky="#c2cfdd", tile="#4f6078", text="#14161a",
    faint="#565c66", on_tile="#eef0f3", panel="#e3e5e8", panel_edge="#8f959f", accent="#0060a8", good="#0060a8",
    bad="#c24a00", bar_full="#a6dcfa", bar_empty="#ffb877", ninja="#101216", band="#0060a8", ghost="#0072b2",
    blood="#8a2c00", gold="#e6c200", gold_light="#fff27a", gold_dark="#6b5900", exit="#56b4e9", exit_light="#f4fbff",
    switch="#0072b2", mine="#d55e00", weapon="#d55e00", laser="#d55e00", warning="#e8a06a", turret="#b04a00",
    launcher="#7a3300", electric="#d55e00", spark="#fff0d8", drone="#202329", lock="#5b5f22", trap="#a34700",
    flame="#ffe9a0", ember="#e69f00",
)  # fmt: skip

SAFE_DARK = _palette(
    "safe-dark", danger_by_shape=True, scenery="paper", background="#232a36", sky="#141920", tile="#4b525c",
    text="#eceff3", faint="#a2a9b3", on_tile="#eceff3", panel="#2a2f36", panel_edge="#5a626d", accent="#56b4e9",
    good="#56b4e9", bad="#ff9a4d", bar_full="#56b4e9", bar_empty="#ff8c33", ninja="#f4f6f8", band="#56b4e9",
    ghost="#56b4e9", blood="#d06a2c", outline="#0c0e10", dark="#78808c", middle="#8f97a3", light="#aab1bc",
    bright="#e6e9ee", gold="#f0e442", gold_light="#fffbc0", gold_dark="#7a7200", exit="#56b4e9",
    exit_light="#d0ecfc", switch="#3a9bdc", mine="#ff8c33", weapon="#ff7a1a", laser="#ff8c33", warning="#a8642e",
    turret="#ff9a4d", launcher="#d0702a", electric="#ff8c33", spark="#fff0d8", drone="#8b939f", lock="#c0c060",
    trap="#ff9a4d", flame="#fff0b0", ember="#f0a820", smoke="#6d737c", dust="#7d848f",
)  # fmt: skip

# A mood for each column of episodes. What lies behind stays near the sky in lightness, the tiles far from both.
MORNING = _palette(
    "morning", scenery="hills", background="#fae3d2", sky="#c9d3f2", far="#e3d3dd", near="#cdbfd6", tile="#46557f",
    text="#1c1730", faint="#5b5472", on_tile="#f6eef2", panel="#fbeee4", panel_edge="#a497b4", ninja="#1b1730",
    accent="#a8324a", band="#d8204c", bar_full="#c0d4ff", dark="#4f4868", middle="#6a6289", light="#857da8",
    gold="#c48a00", exit="#6a3ca4", exit_light="#fff6e0", electric="#0058a8", dust="#a596a8", smoke="#8a8296",
)  # fmt: skip

NOON = _palette(
    "noon", scenery="clouds", background="#e4f5f4", sky="#86c8ee", far="#b5def0", near="#d3edf4", tile="#2b6554",
    text="#0d2026", faint="#3d5c64", on_tile="#eaf6ee", panel="#eff9f7", panel_edge="#86abaf", ninja="#0d1c24",
    accent="#b03a18", band="#d0401c", bar_full="#bfe6ff", dark="#3f5662", middle="#52707e", light="#6c8692",
    exit="#6a3ca4", exit_light="#fff8dc", electric="#0046a0", dust="#8fa8ac", smoke="#86969a",
)  # fmt: skip

AFTERNOON = _palette(
    "afternoon", scenery="dunes", background="#fde6c8", sky="#f3ba94", far="#f4cfa6", near="#e8b98d", tile="#7c3d33",
    text="#2a120c", faint="#6e4a38", on_tile="#fdeedd", panel="#fdefdc", panel_edge="#bd9276", ninja="#22110f",
    accent="#8a1f5c", band="#1f6a8a", bar_full="#cfe0ff", dark="#4a4c58", middle="#6d7180", light="#868da0",
    gold="#b47800", gold_light="#fff3a0", exit="#6a3ca4", exit_light="#fffbe8", electric="#0070b0", dust="#b08a70",
    smoke="#937c70",
)  # fmt: skip

DUSK = _palette(
    "dusk", DARK, scenery="towers", background="#763a5c", sky="#513e7c", far="#6d3f69", near="#56376b", tile="#150e26",
    text="#fbf2ff", faint="#d8c8e2", on_tile="#f0e4f6", panel="#3a2752", panel_edge="#8d6fa0", ninja="#fff4ea",
    accent="#ffb072", band="#ffb072", good="#8fe0a0", bad="#ff9a94", weapon="#ff6f64", middle="#b0a4c6",
    light="#d6cde6", exit="#42c8be", exit_light="#dcfff8", turret="#ffa6d2", launcher="#ffb08a", electric="#5cd2ff",
    drone="#dcd8ec", dust="#b892b0", smoke="#a0869e",
)  # fmt: skip

NIGHT = _palette(
    "night", DARK, scenery="crystals", background="#24406a", sky="#0d1430", far="#1e3560", near="#172750",
    tile="#586c9c", text="#eaf1ff", faint="#a9b8d8", on_tile="#f2f6ff", panel="#1c2747", panel_edge="#5d71a3",
    ninja="#f4f7ff", accent="#7fd8ff", band="#ff8a5c", good="#7fe0b0", bad="#ff8f88", bar_full="#b4c8ff",
    bar_empty="#ff9d90", exit="#a87ce8", exit_light="#e6d6f8", turret="#ff98cc", launcher="#ffa27c",
    electric="#5cd2ff", drone="#c8d2ea",
)  # fmt: skip

MOODS = (MORNING, NOON, AFTERNOON, DUSK, NIGHT)
"""By column of episodes; a pack with more columns begins again."""

GROUND_ROLES = "sky", "background", "far", "near"
"""From the upper edge of the sky to the lower one, then from the farthest layer to the nearest one."""

TONES = (
    ((0, 1.0, 0), (-62, 1.7, -42), (34, 1.5, 52), (-150, 1.3, -96), (62, 1.2, 100)),
    *(tuple((turn * tone, 1.0, turn * tone) for tone in range(5)) for turn in (-16, 9, 15, -16)),
)
"""By mood and tone: degrees in YIQ by which the scenery turns, how much more colourful it is, and degrees by which rock
turns. The levels of an episode go through them, each episode from another one on."""

PALETTES: dict[str, Palette] = {palette.name: palette for palette in (CLASSIC, DARK, CONTRAST, SAFE, SAFE_DARK, *MOODS)}


def palette_named(name: str, column: int = 0, level: int = 0) -> Palette:
    """The palette of a name; for ``settings.BY_COLUMN``, and for an unknown name, that of a level (``Mood``)."""
    return PALETTES.get(name) or _tone(column % len(MOODS), level)


@lru_cache(maxsize=512)
def _tone(column: int, level: int) -> Palette:
    """The mood of a column as it is in its ``level``th level: other hues, as light; its name is the seed of shapes."""
    mood = MOODS[column]
    colours: dict[str, Any] = {}
    tones = TONES[column]
    scenery, colourful, rock = tones[(level + 2 * (level // len(tones))) % len(tones)]
    for role in (*GROUND_ROLES, "tile") if level else ():
        y, i, q = rgb_to_yiq(*(channel / 255 for channel in getattr(mood, role)[:3]))
        turned = complex(i, q) * (rect(1, radians(rock)) if role == "tile" else rect(colourful, radians(scenery)))
        channels = yiq_to_rgb(y, turned.real, turned.imag)
        colours[role] = pygame.Color(*(round(255 * min(1.0, max(0.0, channel))) for channel in channels))
    return replace(mood, name=f"{mood.name} {level}", **colours) if level else mood


NINJA_COLOURS = ("", "#d9127f", "#7d7700", "#1a6488", "#765484", "#6a2424", "#f7f7f7", "#c79400", "#787887", "#bfbfc6")
"""The ninja's colours: the palette's own, then one per completed column (game.md §8)."""

RUN_COLOURS = tuple(map(pygame.Color, ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")))
"""Colours of several runs in turn; people who see few colours can tell them apart."""


def mixed(a: pygame.Color, b: pygame.Color, share: float) -> pygame.Color:
    """A colour between two, ``share`` (0…1) of the way from ``a`` to ``b``.

    >>> mixed(pygame.Color("black"), pygame.Color(200, 100, 0), 0.5)
    Color(100, 50, 0, 255)
    """
    return a.lerp(b, min(1.0, max(0.0, share)))


NARROWER = (0.95, 0.9, 0.85, 0.8, 0.75, 0.7, 0.65, 0.6, 0.55)
"""Shares of the width that are tried to make lines equally long."""


def wrapped(theme: Theme, text: str, width: float, size: float) -> list[str]:
    """The text in as few lines as fit a width, about equally long, so that no word is left alone."""
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
