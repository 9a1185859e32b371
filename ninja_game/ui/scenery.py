"""The far background of a level: a sky and still layers of soft shapes, in colours and style of a palette."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache, partial
from math import cos, pi, sin

import pygame

from ninja_game.sim.grid import Point
from ninja_game.ui.canvas import Colour
from ninja_game.ui.theme import GROUND_ROLES, Palette, mixed

# The sheet for painting the layers, px.
_WIDTH = 396
_HEIGHT = 300

_LAYERS = ((0.0, 5.0), (0.35, 4.0), (0.7, 3.0), (1.0, 2.0))
"""Nearness of each layer, 0…1, and width of its haze, px of the sheet: farther layers are softer."""

_COPIES = 6  # copies of a shape in a circle around it: its haze
_FAINT = (255, 255, 255, 60)  # colour of each copy
_BAND = 3  # height of the bands of the sky's colours, px of the sheet
_HORIZON = 140  # lower end of the sky's bands, px of the sheet
_KEPT = 4  # cached grounds: one as large as a 4K screen takes 33 MB
_SHEETS = 24  # cached small sheets
_LIFT = 40  # greatest difference in the layers' height between two levels, px of the sheet

Numbers = Iterator[float]


def draw_scenery(surface: pygame.Surface, palette: Palette, stage: pygame.Rect, area: pygame.Rect) -> None:
    """Draw the scenery into the part ``area`` of a stage, px."""
    if palette.scenery:
        surface.blit(ground(stage.size, palette), area, area.move(-stage.x, -stage.y))
    else:
        surface.fill(palette.background, area)


@lru_cache(maxsize=_KEPT)
def ground(size: tuple[int, int], palette: Palette) -> pygame.Surface:
    """The sky and the layers of a palette with scenery, painted once; it is shared, so never draw on it."""
    return pygame.transform.smoothscale(scenery_sheet(palette), size)


@lru_cache(maxsize=_SHEETS)
def scenery_sheet(palette: Palette) -> pygame.Surface:
    """The ground on its small sheet: sky, sun or moon, layers; it is shared, so never draw on it."""
    scenery = palette.scenery
    sky, horizon, far, near = (getattr(palette, role) for role in GROUND_ROLES)
    sheet = pygame.Surface((_WIDTH, _HEIGHT))
    for band in range(0, _HEIGHT, _BAND):
        sheet.fill(mixed(sky, horizon, band / _HORIZON), (0, band, _WIDTH, _BAND))
    numbers = _numbers(palette.name)
    if scenery != "paper":
        x, y, radius = _WIDTH * next(numbers), _HEIGHT * (0.06 + 0.2 * next(numbers)), 14 + 20 * next(numbers)
        for size, share in ((1.3, 0.3), (1.14, 0.5), (1.0, 0.8)):
            pygame.draw.circle(sheet, mixed(sky, horizon, max(share, y / _HORIZON)), (x, y), size * radius)
    lift = _LIFT * (next(numbers) - 0.5)
    for nearness, width in _LAYERS:
        layer = pygame.Surface((_WIDTH, _HEIGHT), pygame.SRCALPHA)
        SCENERIES[scenery](layer, mixed(far, near, nearness), _HEIGHT * (0.3 + 0.5 * nearness) + lift, numbers)
        haze = layer.copy()
        haze.fill(_FAINT, special_flags=pygame.BLEND_RGBA_MULT)
        for copy in range(_COPIES):
            turn = 2 * pi * copy / _COPIES
            sheet.blit(haze, (round(width * cos(turn)), round(width * sin(turn))))
        sheet.blit(layer, (0, 0))
    return sheet


@lru_cache(maxsize=_SHEETS)
def grain(palette: Palette, role: str) -> pygame.Surface:
    """The picture to subtract from rock in a role's colour, for a palette with scenery, so that the rock's marks stay.

    It is shared, so never draw on it.
    """
    sheet = pygame.Surface((_WIDTH, _HEIGHT), pygame.SRCALPHA)
    GRAINS[palette.scenery](sheet, _numbers(f"rock of {palette.name}"))
    sheet.fill(getattr(palette, role), special_flags=pygame.BLEND_RGBA_MULT)
    # Scaling down and up again blurs it.
    small = pygame.transform.smoothscale(sheet, (_WIDTH // 2, _HEIGHT // 2))
    return pygame.transform.smoothscale(small, (_WIDTH, _HEIGHT))


def _white(numbers: Numbers) -> tuple[int, int, int, int]:
    """White with an alpha, premultiplied."""
    return (round(255 * next(numbers)),) * 4


def _layer(top: float, start: float, slant: float, wave: float, x: float) -> float:
    """The height of a layer of earth at ``x``."""
    return top + slant * x + wave * sin(start + top / 60 + x / 45)


def _strata(sheet: pygame.Surface, numbers: Numbers, slant: float = 0.1, wave: float = 7.0) -> None:
    """Layers of earth, one on another."""
    top, start = -160.0, 2 * pi * next(numbers)
    while top < _HEIGHT:
        _ridge(sheet, _white(numbers), partial(_layer, top, start, slant, wave))
        top += 9 + 26 * next(numbers)
    for _ in range(70):
        # Stones lie in it, and cracks run down from some of them.
        x, y, width = _WIDTH * next(numbers), _HEIGHT * next(numbers), 3 + 5 * next(numbers)
        rim = [(x + width * cos(turn), y + 0.6 * width * sin(turn)) for turn in range(6)]
        pygame.draw.polygon(sheet, _white(numbers), rim)
        if next(numbers) < 0.3:
            line = [(x + 14 * (next(numbers) - 0.5), y + 9 * down) for down in range(5)]
            pygame.draw.lines(sheet, (0, 0, 0, 0), False, line, 2)


def _stones(sheet: pygame.Surface, numbers: Numbers) -> None:
    """Round stones, large and small."""
    for _ in range(260):
        place = _WIDTH * next(numbers), _HEIGHT * next(numbers)
        pygame.draw.circle(sheet, _white(numbers), place, 7 + 20 * next(numbers) ** 2)


def _bricks(sheet: pygame.Surface, numbers: Numbers) -> None:
    """Rows of blocks."""
    for y in range(0, _HEIGHT, 12):
        x = -24.0 * next(numbers)
        while x < _WIDTH:
            width = 14 + 24 * next(numbers)
            pygame.draw.rect(sheet, _white(numbers), (x + 1, y + 1, width - 2, 10))
            x += width


def _facets(sheet: pygame.Surface, numbers: Numbers) -> None:
    """Broken faces that catch the light."""
    for y in range(0, _HEIGHT, 30):
        for x in range(0, _WIDTH, 30):
            a, b, c = ((x + 50 * next(numbers) - 10, y + 50 * next(numbers) - 10) for _ in range(3))
            pygame.draw.polygon(sheet, _white(numbers), [a, b, c])


GRAINS: dict[str, Callable[[pygame.Surface, Numbers], None]] = {
    "hills": _strata, "clouds": _stones, "dunes": lambda sheet, numbers: _strata(sheet, numbers, 0.45, 3.0),
    "towers": _bricks, "crystals": _facets,
}  # fmt: skip
"""Marks on rock, by the kinds of scenery: each function leaves plain rock white."""


def _numbers(name: str) -> Numbers:
    """Numbers from 0 to 1, the same for a name on every machine and in the page."""
    state = int.from_bytes(name.encode(), "big") % 2**31
    while True:
        state = (state * 1103515245 + 12345) % 2**31
        yield (state >> 8) / 2**23


def _ridge(sheet: pygame.Surface, colour: Colour, height: Callable[[float], float]) -> None:
    """Everything below a line."""
    line: list[Point] = [(x, height(x)) for x in range(-4, _WIDTH + 8, 4)]
    pygame.draw.polygon(sheet, colour, [*line, (_WIDTH + 4, _HEIGHT), (-4, _HEIGHT)])


def _hills(sheet: pygame.Surface, colour: pygame.Color, base: float, numbers: Numbers) -> None:
    waves = [
        ((12 + 26 * next(numbers)) / k, 2 * pi * next(numbers), k * (0.008 + 0.004 * next(numbers))) for k in (1, 2, 3)
    ]
    _ridge(sheet, colour, lambda x: base - sum(rise * sin(start + fast * x) for rise, start, fast in waves))


def _dunes(sheet: pygame.Surface, colour: pygame.Color, base: float, numbers: Numbers) -> None:
    """Dunes: each rises slowly and falls steeply behind its crest."""
    width, crest_height = 150 + 120 * next(numbers), 34 + 26 * next(numbers)
    start, crest = next(numbers), 0.62 + 0.2 * next(numbers)

    def height(x: float) -> float:
        along = (x / width + start) % 1
        risen = along / crest if along < crest else (1 - along) / (1 - crest)
        return base - crest_height * risen * risen * (3 - 2 * risen) - 6 * sin(x / 47)

    _ridge(sheet, colour, height)


def _clouds(sheet: pygame.Surface, colour: pygame.Color, base: float, numbers: Numbers) -> None:
    """A bank of clouds: towers of discs of changing size."""
    start = 2 * pi * next(numbers)

    def height(x: float) -> float:
        return base - 26 * sin(start + x / 38) - 18 * sin(2 * start + x / 21)

    for x in range(-20, _WIDTH + 20, 9):
        pygame.draw.circle(sheet, colour, (x, height(x) + 8 * next(numbers)), 16 + 16 * next(numbers))
    _ridge(sheet, colour, lambda x: height(x) + 8)


def _towers(sheet: pygame.Surface, colour: pygame.Color, base: float, numbers: Numbers) -> None:
    """Houses and towers with flat or pointed roofs."""
    x = -20.0 * next(numbers)
    while x < _WIDTH:
        width, top = 14 + 26 * next(numbers), base + 30 - 110 * next(numbers) ** 2
        pygame.draw.rect(sheet, colour, (x, top, width + 1, _HEIGHT - top))
        if next(numbers) < 0.45:
            pygame.draw.polygon(sheet, colour, [(x - 2, top), (x + width / 2, top - width), (x + width + 2, top)])
        x += width + (10 * next(numbers) if next(numbers) < 0.4 else 0)


def _crystals(sheet: pygame.Surface, colour: pygame.Color, base: float, numbers: Numbers) -> None:
    """Spikes from the ground that lean to either side."""
    _ridge(sheet, colour, lambda x: base + 44 - 10 * sin(x / 31 + base))
    x = 10 * next(numbers)
    while x < _WIDTH + 20:
        width = 10 + 18 * next(numbers)
        top = base + 20 - 100 * next(numbers)
        lean = 70 * (next(numbers) - 0.5)
        tip = x + lean, top
        shoulder = width * 0.5
        left, right = (tip[0] - shoulder, top + 24), (tip[0] + shoulder, top + 34)
        pygame.draw.polygon(sheet, colour, [(x - width, _HEIGHT), left, tip, right, (x + width, _HEIGHT)])
        x += 16 + 30 * next(numbers)


SCENERIES: dict[str, Callable[[pygame.Surface, pygame.Color, float, Numbers], None]] = {
    "hills": _hills, "clouds": _clouds, "dunes": _dunes, "towers": _towers, "crystals": _crystals,
    "paper": lambda *_: None,
}  # fmt: skip
"""The shapes of layers, by kind: each function draws one in a colour, at about a height (px of the sheet)."""
