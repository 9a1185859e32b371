"""What all figures share: a thing to drag or paint, live numbers, controls, a demonstration, a reset."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Sequence
from functools import cache
from math import cos, pi, sin
from typing import Any, Generic, TypeVar

from ninja_game.files.resources import data_folder
from ninja_game.play.lab.sheet import CORNER, FIGURE, Sheet, View
from ninja_game.play.menus.help.pages import room_level
from ninja_game.play.ui.canvas import Point
from ninja_game.play.ui.theme import Area
from ninja_game.play.ui.widgets import Choice, Slider, Widget
from ninja_game.sim.memory.plain import load_plain
from ninja_game.sim.memory.schema import TileMap, World

Control = Callable[[Area], Widget]
"""Makes a widget in an area."""

Value = TypeVar("Value")


@cache
def figure_texts() -> dict[str, dict[str, Any]]:
    """What the bundled file says of each figure, by name."""
    return tomllib.loads((data_folder("assets") / "lab" / "figures.toml").read_text("utf-8"))


class Setting(Generic[Value]):
    """A value of a figure that a control changes. ``then``: the method that follows a change, by name."""

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
    """One figure. ``name``: as the command line has it. ``text``: two sentences. ``links``: where to read more.

    ``room``, ``objects``: what is in its world. The handle is a point of the world, px, that the mouse drags and the
    arrows move.
    """

    name = ""
    view: View = CORNER
    start: Point = (0.0, 0.0)

    def __init__(self) -> None:
        table = figure_texts()[self.name]
        self.title = str(table["title"])
        self.text: list[str] = table["text"]
        self.links: list[str] = table["links"]
        self.room: list[str] = table.get("room", "").split()
        self.objects: list[str] = table.get("objects", [])
        self.reset()

    def reset(self) -> None:
        """Begin again."""
        self.x, self.y = self.start

    def controls(self) -> Sequence[Control]:
        """Sliders and choices, at most four."""
        return ()

    def drag(self, x: float, y: float) -> None:
        """The mouse is at a point of the world with its button down: the handle goes there, within what is seen."""
        left, top, zoom = self.view
        self.x = min(max(x, left + 1), left + FIGURE[2] / zoom - 1)
        self.y = min(max(y, top + 1), top + FIGURE[3] / zoom - 1)

    def press(self, x: float, y: float) -> None:
        """The mouse button goes down there."""
        self.drag(x, y)

    def nudge(self, dx: int, dy: int) -> None:
        """An arrow key: the handle moves by a px."""
        self.drag(self.x + dx, self.y + dy)

    def demonstrate(self, tick: int) -> None:
        """Put the figure where its demonstration is after this many ticks; by default the handle goes round."""
        angle = 2 * pi * tick / 240
        (x, y), zoom = self.start, self.view.zoom
        self.drag(x + 60 * cos(angle) / zoom, y + 40 * sin(2 * angle) / zoom)

    def tick(self) -> None:
        """Let 25 ms pass."""

    def numbers(self) -> list[tuple[str, str]]:
        """Names and values, live, at most seven."""
        return []

    def draw(self, sheet: Sheet) -> None:
        """Show it."""
        raise NotImplementedError


ELSEWHERE = "ninja 700,500px"
"""Every world needs a ninja; this one is not seen."""


def room_world(rows: Sequence[str], objects: Sequence[str] = ()) -> tuple[TileMap, World]:
    """A world of the plain memory: a room in the upper left corner, solid all around, the ninja elsewhere."""
    return load_plain(room_level(rows, [*objects, ELSEWHERE]), box=False)


def choice(text: str, options: Sequence[tuple[str, object]], figure: object, name: str) -> Control:
    """A control that sets an attribute of a figure to one of several values."""
    return lambda area: Choice(
        area, text, options, lambda: getattr(figure, name), lambda value: setattr(figure, name, value)
    )


def slider(
    text: str,
    span: tuple[float, float, float],
    figure: object,
    name: str,
    show: Callable[[float], str] = "{:.0f}".format,
) -> Control:
    """A control that sets an attribute of a figure to a number: least, greatest, step."""
    return lambda area: Slider(
        area, text, span, lambda: getattr(figure, name), lambda value: setattr(figure, name, value), show=show
    )
