"""The base of all figures: a handle or cells to paint, live numbers, controls, a demonstration, a reset."""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Callable, Iterable, Sequence
from functools import cache, partial
from itertools import product
from math import atan2, cos, pi, sin
from pathlib import Path
from types import FrameType
from typing import Any, Generic, NamedTuple, TypeVar

import pygame

from ninja_game import sim
from ninja_game.backend.plain import load_plain
from ninja_game.files.bundled import asset_text
from ninja_game.formats.ascii.reader import room_level
from ninja_game.player.settings import Settings
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, EXISTS, UNIT_X, UNIT_Y
from ninja_game.sim.grid import Point, cell_at
from ninja_game.sim.rules import CELL, HALF, INTERESTING, OFF
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import HEIGHT, WIDTH, Colour, Lens
from ninja_game.ui.theme import Area, Palette, Theme
from ninja_game.ui.widgets import Choice, Slider, Widget
from ninja_game.view.level_view import LevelView, OffscreenContext
from ninja_game.view.sprites.tile_sheet import outline

_RULES = str(Path(sim.__file__).parent)


class Call(NamedTuple):
    """A call of a rule. ``depth``: 0 for the watched function.

    ``arguments``: numbers by name; an object is its slot. ``result``: None before the call ends.
    """

    name: str
    caller: str
    depth: int
    arguments: dict[str, float]
    result: list[Any]


def traced(function: Callable[..., Any], *args: Any) -> tuple[Any, list[Call]]:
    """The result of ``function(*args)``, and all calls of the world's rules in it, in order, itself first."""
    calls: list[Call] = []
    running: list[Call] = []

    def note(frame: FrameType, event: str, result: Any) -> None:
        if not frame.f_code.co_filename.startswith(_RULES):
            return
        if event == "call":
            caller = running[-1].name if running else ""
            running.append(Call(frame.f_code.co_name, caller, len(running), _numbers(frame.f_locals), []))
            calls.append(running[-1])
        elif event == "return" and running:
            running.pop().result.append(result)

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        result = function(*args)
    finally:
        sys.setprofile(before)
    return result, calls


def _numbers(values: dict[str, Any]) -> dict[str, float]:
    numbers = {name: getattr(value, "slot", value) for name, value in values.items()}
    return {name: number for name, number in numbers.items() if isinstance(number, (int, float))}


def values_of(local: str, function: Callable[..., Any], *args: Any) -> list[Any]:
    """The values that a local variable of ``function`` has during ``function(*args)``, one per change."""
    values: list[Any] = []
    code = function.__code__

    def follow(frame: FrameType, *_: Any) -> Any:
        if frame.f_code is not code:
            return None
        if local in frame.f_locals and (not values or values[-1] != frame.f_locals[local]):
            values.append(frame.f_locals[local])
        return follow

    before = sys.gettrace()
    sys.settrace(follow)
    try:
        function(*args)
    finally:
        sys.settrace(before)
    return values


FIGURE_AREA: Area = (212, 62, 540, 324)  # the area of a figure on the screen, logical px


ALL_CELLS = range(len(EXISTS))


class View(NamedTuple):
    """The shown part of the world: its upper left corner, px, and its magnification."""

    left: float
    top: float
    zoom: float


CORNER = View(0, 0, 1.5)  # 15 x 9 cells with the border
FIELD = View(CELL, CELL, 0.75)  # 30 x 18 cells


class Sheet:
    """Draws on a surface in px of the world, clipped to the figure's rectangle."""

    def __init__(self, surface: pygame.Surface, theme: Theme, view: View) -> None:
        self.surface = surface
        self.view = view
        x, y = theme.canvas.exact(FIGURE_AREA[0], FIGURE_AREA[1])
        scale = theme.canvas.scale * view.zoom
        corner = round(x - view.left * scale), round(y - view.top * scale)
        self.canvas = Lens(theme.canvas.window, scale, corner)
        self.theme = theme
        self.area = theme.canvas.rect(*FIGURE_AREA)
        surface.set_clip(self.area)
        surface.fill(theme.palette.background, self.area)

    @property
    def palette(self) -> Palette:
        return self.theme.palette

    def text(self, text: str, x: float, y: float, *, size: float = 9, colour: Colour | None = None) -> None:
        """A text centred at a point of the world. ``size``: logical px of the screen."""
        at = self.theme.canvas.logical(self.canvas.point(x, y))
        self.theme.text(
            self.surface, text, at[0], at[1] - size / 2, size=size, colour=colour, align="centre", height=1.1 * size
        )

    def grid(self) -> None:
        upright: list[tuple[Point, Point]] = [((CELL * k, 0), (CELL * k, HEIGHT)) for k in range(34)]
        level: list[tuple[Point, Point]] = [((0, CELL * k), (WIDTH, CELL * k)) for k in range(26)]
        for a, b in upright + level:
            pygame.draw.line(self.surface, self.palette.panel_edge, self.canvas.point(*a), self.canvas.point(*b))

    def shade(self, cell: int, colour: Colour, alpha: int = 70) -> None:
        if EXISTS[cell]:
            ink = pygame.Color(colour)
            self.canvas.fill_rect(
                self.surface, (ink.r, ink.g, ink.b, alpha), CENTRE_X[cell] - HALF, CENTRE_Y[cell] - HALF, CELL, CELL
            )

    def tiles(self, tiles: TileMap) -> None:
        for cell, tile in enumerate(tiles.ids):
            x, y = CENTRE_X[cell], CENTRE_Y[cell]
            corners = [(x + dx, y + dy) for dx, dy in outline(tile)]
            is_seen = self.area.inflate(200, 200).collidepoint(self.canvas.point(x, y))
            if corners and is_seen and EXISTS[cell]:
                self.canvas.polygon(self.surface, self.palette.tile, corners)

    def edges(self, w: World, cells: Iterable[int] = ALL_CELLS) -> None:
        """The edge states of each cell, a little inside it: solid thick, interesting thin, off not drawn."""
        for cell, side in product(cells, range(4)):
            state = w.edges[4 * cell + side]
            if state != OFF and EXISTS[cell]:
                x, y = CENTRE_X[cell] + 10.5 * UNIT_X[side], CENTRE_Y[cell] + 10.5 * UNIT_Y[side]
                a, b = abs(UNIT_Y[side]) * 10, abs(UNIT_X[side]) * 10
                thin = state == INTERESTING
                self.line(
                    self.palette.gold if thin else self.palette.bad, (x - a, y - b), (x + a, y + b), 1 if thin else 2
                )

    def circle(self, colour: Colour, x: float, y: float, radius: float, width: float = 0) -> None:
        self.canvas.circle(self.surface, colour, (x, y), radius, width / self.view.zoom)

    def body(self, colour: Colour, x: float, y: float, half: float, *, box: bool, width: float = 2) -> None:
        """A circle or a box; ``half``: its radius or half side."""
        if box:
            self.canvas.frame_rect(self.surface, colour, x - half, y - half, 2 * half, 2 * half, width / self.view.zoom)
        else:
            self.circle(colour, x, y, half, width)

    def line(self, colour: Colour, a: Point, b: Point, width: float = 1) -> None:
        self.canvas.line(self.surface, colour, a, b, width / self.view.zoom)

    def arrow(self, colour: Colour, a: Point, b: Point, width: float = 2) -> None:
        """A line with a head; nothing for length 0."""
        if a == b:
            return
        self.line(colour, a, b, width)
        angle, size = atan2(b[1] - a[1], b[0] - a[0]), 7 / self.view.zoom
        tips = [(b[0] - size * cos(angle + turn), b[1] - size * sin(angle + turn)) for turn in (0.45, -0.45)]
        self.canvas.polygon(self.surface, colour, [b, *tips])


class Stage:
    """A room with its picture. ``calls``: the world's rules that ran in the last tick."""

    def __init__(self, rows: Sequence[str], objects: Sequence[str]) -> None:
        self.simulation = Simulation(room_level(rows, objects), memory="plain")
        self.world = self.simulation.world
        self.tiles = self.simulation.tiles
        self.calls: list[Call] = []
        self._view: LevelView | None = None
        self._sheet = pygame.Surface((1, 1))
        self._look: tuple[object, ...] = ()

    def step(self, keys: int = 0) -> None:
        _, self.calls = traced(self.simulation.step_keys, keys)
        if self._view is not None:
            self._view.on_tick()

    def draw(self, sheet: Sheet) -> None:
        scale = sheet.theme.canvas.scale * sheet.view.zoom
        look = scale, sheet.palette.name
        if self._view is None or look != self._look:
            self._look = look
            self._sheet = pygame.Surface((round(WIDTH * scale), round(HEIGHT * scale)))
            context = OffscreenContext(self._sheet.get_size(), Settings().changed(palette=sheet.palette.base.name))
            self._view = LevelView(context, self.simulation, audible=False)
            self._view.draw(self._sheet, 1.0, whole=True)
        else:
            self._view.draw(self._sheet, 1.0)
        left, top = round(sheet.view.left * scale), round(sheet.view.top * scale)
        sheet.surface.blit(self._sheet, sheet.area, pygame.Rect((left, top), sheet.area.size))


Control = Callable[[Area], Widget]

_Range = tuple[float, float, float]

Value = TypeVar("Value")


@cache
def figure_texts() -> dict[str, dict[str, Any]]:
    return tomllib.loads(asset_text("lab/figures.toml"))


class FigureSetting(Generic[Value]):
    """A value of a figure with a control. ``then``: name of the method to call after a change."""

    def __init__(self, value: Value, then: str = "reset") -> None:
        self.value, self.then = value, then

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = f"_{name}"

    def __get__(self, figure: object, owner: type | None = None) -> Value:
        return getattr(figure, self.name, self.value)

    def __set__(self, figure: object, value: Value) -> None:
        # A slider gives a float for a whole number too.
        setattr(figure, self.name, type(self.value)(value))  # type: ignore[call-arg]
        getattr(figure, self.then)()


class Figure:
    """A figure. ``name``: for the command line. ``text``: two sentences. ``links``: where to read more.

    ``legend``: the meaning of colours, by their roles in the palette. ``room``, ``objects``: its world. The handle is a
    point of the world, px, that the mouse drags and the arrows move.
    """

    name = ""
    view: View = CORNER
    start: Point = (0.0, 0.0)

    def __init__(self) -> None:
        table = figure_texts()[self.name]
        self.title = str(table["title"])
        self.text: list[str] = table["text"]
        self.links: list[str] = table["links"]
        self.legend: dict[str, str] = table["legend"]
        self.room: list[str] = table.get("room", "").split()
        self.objects: list[str] = table.get("objects", [])
        self.reset()

    def reset(self) -> None:
        self.x, self.y = self.start

    @property
    def cell(self) -> int:
        return cell_at(self.x, self.y)

    def controls(self) -> Sequence[Control]:
        """Sliders and choices, at most four."""
        return ()

    def choice(self, text: str, options: Sequence[tuple[str, object]], name: str) -> Control:
        return lambda area: Choice(area, text, options, partial(getattr, self, name), partial(setattr, self, name))

    def slider(self, text: str, span: _Range, name: str, show: Callable[[float], str] = "{:.0f}".format) -> Control:
        """A control that sets an attribute to a number; ``span``: least, greatest, step."""
        get, put = partial(getattr, self, name), partial(setattr, self, name)
        return lambda area: Slider(area, text, span, get, put, show=show)

    def drag(self, x: float, y: float) -> None:
        """Move the handle to a point of the world, clamped to the shown part; the mouse button is down."""
        left, top, zoom = self.view
        self.x = min(max(x, left + 1), left + FIGURE_AREA[2] / zoom - 1)
        self.y = min(max(y, top + 1), top + FIGURE_AREA[3] / zoom - 1)

    def press(self, x: float, y: float) -> None:
        """The mouse button is pressed at a point of the world."""
        self.drag(x, y)

    def nudge(self, dx: int, dy: int) -> None:
        self.drag(self.x + dx, self.y + dy)

    def demonstrate(self, tick: int) -> None:
        """Set the demonstration to its state after this many ticks; by default the handle moves in a circle."""
        angle = 2 * pi * tick / 240
        (x, y), zoom = self.start, self.view.zoom
        self.drag(x + 60 * cos(angle) / zoom, y + 40 * sin(2 * angle) / zoom)

    def tick(self) -> None:
        """Simulate one tick, 25 ms."""

    def numbers(self) -> list[tuple[str, str]]:
        """Names and live values, at most seven."""
        return []

    def draw(self, sheet: Sheet) -> None:
        raise NotImplementedError

    def show(self, surface: pygame.Surface, theme: Theme) -> None:
        """Draw the figure in its frame."""
        self.draw(Sheet(surface, theme, self.view))
        surface.set_clip(None)
        theme.canvas.frame_rect(surface, theme.palette.panel_edge, *FIGURE_AREA, 1)


ELSEWHERE = "ninja 700,500px"  # every world needs a ninja; this one is outside of the picture


def room_world(rows: Sequence[str], objects: Sequence[str] = ()) -> tuple[TileMap, World]:
    """A world of the plain memory: a room in the upper left corner, solid around it, the ninja elsewhere."""
    return load_plain(room_level(rows, [*objects, ELSEWHERE]), box=False)
