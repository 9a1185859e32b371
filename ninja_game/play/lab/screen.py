"""The lab's screen: a list of figures at the left; the chosen one with its text, numbers and controls at the right."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import pygame

from ninja_game.errors import NinjaGameError
from ninja_game.play.app import App
from ninja_game.play.lab.cells import CellsTouched, GridOfCells, NineCells, RayCast
from ninja_game.play.lab.edges import Doors, EdgeStates, WalkingEnemies
from ninja_game.play.lab.figure import FIGURE_AREA, Figure
from ninja_game.play.lab.grids import Bullets, FiveCells, LooseGrid
from ninja_game.play.lab.one_tick import OneTick
from ninja_game.play.lab.projection import Bodies, Projection, Response
from ninja_game.play.menu_screen import DIRECTIONS, MenuScreen
from ninja_game.play.replay.film import write_gif
from ninja_game.play.replay.playback import RunClock
from ninja_game.play.window import save_picture
from ninja_game.player.settings import Settings
from ninja_game.ui.canvas import HEIGHT, WIDTH
from ninja_game.ui.list_view import NameList
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Button, Choice, Slider, Widget
from ninja_game.view.level_view import OffscreenContext

_LEGEND_TOP, _TEXT_TOP, _NUMBERS_TOP, _LINE = 390.0, 406.0, 452.0, 15.0
CONTROLS: Area = (552, 452, 200, 26)  # the first control; the others are below it


class LabScreen(MenuScreen):
    """Figures about how the world works. ``name``: the first one to show."""

    title = "How it works"
    offers_back = False

    def __init__(self, app: App, name: str = "") -> None:
        super().__init__(app)
        self.figures = [make() for make in FIGURES.values()]
        names = [figure.title for figure in self.figures]
        self.list = NameList((44, 62, 158, 20 * len(FIGURES)), 20, names, 11, self._show, self._choose)
        self.list.hint = "Up and down choose a figure, right goes to it"
        self.list.index = list(FIGURES).index(name) if name else 0
        self.clock = RunClock()
        self.shows = True
        self.ticks = 0
        self.list.fill(self.figures)

    @property
    def figure(self) -> Figure:
        return self.figures[self.list.index]

    def build(self) -> Sequence[Widget]:
        x, y, w, h = CONTROLS
        controls = [make((x, y + (h + 4) * k, w, h)) for k, make in enumerate(self.figure.controls())]
        buttons = [
            Button((52, 352, 142, 26), "Demonstration", self.demonstrate, hint="The figure shows itself"),
            Button((52, 384, 142, 26), "Reset", self.reset, hint="The figure as it was at first"),
            Button((52, 416, 142, 26), "Back", self.back),
        ]
        return [self.list, FigureArea(self), *controls, *buttons]

    def _show(self, index: int) -> None:
        self.demonstrate()
        if self.widgets:
            self.enter()

    def _choose(self, index: int) -> None:
        self.focus_on(next(widget for widget in self.widgets if isinstance(widget, FigureArea)))

    def demonstrate(self) -> None:
        self.reset()
        self.shows, self.ticks = True, 0

    def reset(self) -> None:
        self.figure.reset()
        self.handle_press()

    def act(self, action: str, *, held: bool = False) -> None:
        if action in ("left", "right", "confirm") and isinstance(self.focus, (FigureArea, Slider, Choice)):
            self.shows = False
        super().act(action, held=held)

    def go_on(self) -> None:
        """Move the focus from the figure to its first control, or to the buttons."""
        self.focus_on(self.widgets[self.widgets.index(self.list) + 2])

    def handle_press(self) -> None:
        self.shows = False
        self.redraw = True

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        for _ in range(min(4, self.clock.ticks_due(real_ms))):
            if self.shows:
                self.figure.demonstrate(self.ticks)
                self.ticks += 1
            self.figure.tick()
            self.redraw = True

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme, (x, _, w, _) = self.app.theme, FIGURE_AREA
        at = x
        for role, words in self.figure.legend.items():
            theme.canvas.fill_rect(surface, getattr(theme.palette, role), at, _LEGEND_TOP + 1, 9, 9)
            theme.text(surface, words, at + 13, _LEGEND_TOP, size=9.5)
            at += theme.width(words, 9.5) + 26
        theme.paragraph(surface, [" ".join(self.figure.text)], (x, _TEXT_TOP, w, _NUMBERS_TOP - _TEXT_TOP), 10.5, 13)
        for place, (name, value) in enumerate(self.figure.numbers()):
            y = _NUMBERS_TOP + _LINE * place
            theme.text(surface, name, x, y, size=9.5, colour=theme.palette.faint, width=120)
            theme.text(surface, value, x + 124, y, size=9.5, width=CONTROLS[0] - x - 132)


class FigureArea(Widget):
    """The figure: the mouse drags and the arrows move its handle; Page Down goes on to the controls."""

    def __init__(self, screen: LabScreen) -> None:
        super().__init__(FIGURE_AREA)
        self.screen = screen
        self.hint = f"Drag, or use the arrows; Page Down goes on. More: {', '.join(screen.figure.links)}"

    def _world(self, x: float, y: float) -> tuple[float, float]:
        left, top, zoom = self.screen.figure.view
        return left + (x - FIGURE_AREA[0]) / zoom, top + (y - FIGURE_AREA[1]) / zoom

    def click(self, x: float, y: float) -> bool:
        self.screen.handle_press()
        self.screen.figure.press(*self._world(x, y))
        return True

    def drag(self, x: float, y: float) -> bool:
        self.screen.figure.drag(*self._world(x, y))
        return True

    def confirm(self) -> bool:
        self.screen.handle_press()
        self.screen.figure.press(self.screen.figure.x, self.screen.figure.y)
        return True

    def nudge(self, action: str) -> bool:
        if action == "page_down":
            self.screen.go_on()
            return True
        if action not in DIRECTIONS:
            return False
        self.screen.handle_press()
        self.screen.figure.nudge(*DIRECTIONS[action])
        return True

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        self.screen.figure.show(surface, theme)
        if focused:
            theme.canvas.frame_rect(surface, theme.palette.accent, *FIGURE_AREA, 2.5)


FILM_TICKS = 240
PICTURE_TICK = 60  # the tick of the demonstration that pictures show


class FigurePicture:
    """A picture of only the figure. ``scale``: px of the picture per logical px."""

    def __init__(self, name: str, scale: float, palette: str = "classic") -> None:
        pygame.font.init()
        context = OffscreenContext((round(WIDTH * scale), round(HEIGHT * scale)), Settings().changed(palette=palette))
        self.figure = FIGURES[name]()
        self.theme = context.theme
        self.surface = pygame.Surface(context.canvas.window)
        self.area = context.canvas.rect(*FIGURE_AREA)

    def draw(self) -> None:
        self.figure.show(self.surface, self.theme)

    def demonstrate(self, tick: int) -> None:
        self.figure.demonstrate(tick)
        self.figure.tick()


def figure_pictures(name: str, *, scale: float = 1.0, ticks: int = FILM_TICKS) -> Iterator[pygame.Surface]:
    """The figure after each tick of its demonstration, always on the same surface."""
    picture = FigurePicture(name, scale)
    for tick in range(ticks):
        picture.demonstrate(tick)
        picture.draw()
        yield picture.surface.subsurface(picture.area)


def figure_picture(name: str, *, scale: float = 1.0, palette: str = "classic") -> pygame.Surface:
    """The figure at one tick of its demonstration."""
    picture = FigurePicture(name, scale, palette)
    for tick in range(PICTURE_TICK):
        picture.demonstrate(tick)
    picture.draw()
    return picture.surface.subsurface(picture.area)


def export_figure(name: str, path: Path, *, scale: float = 1.0) -> None:
    """Write a figure as PNG, or its demonstration as GIF. Raises NinjaGameError for another suffix, OSError."""
    if path.suffix == ".png":
        save_picture(figure_picture(name, scale=scale), path)
    elif path.suffix == ".gif":
        pictures = figure_pictures(name, scale=scale)
        context = OffscreenContext((round(WIDTH * scale), round(HEIGHT * scale)))
        palette, size = context.theme.palette, context.canvas.rect(*FIGURE_AREA).size
        write_gif(pictures, FILM_TICKS, path, size, 1.0, palette)
    else:
        raise NinjaGameError(f"{path}: a figure is written as .png or .gif")


FIGURES: dict[str, type[Figure]] = {
    figure.name: figure
    for figure in (
        GridOfCells, Bodies, CellsTouched, Projection, EdgeStates, Doors, Response, LooseGrid, NineCells, FiveCells,
        Bullets, RayCast, WalkingEnemies, OneTick,
    )
}  # fmt: skip
