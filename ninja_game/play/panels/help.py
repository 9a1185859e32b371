"""The help's pages: texts, and small rooms with a demonstration (``assets/help/pages.toml``)."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import pygame

from ninja_game import __version__
from ninja_game.errors import LevelError
from ninja_game.files.bundled import asset_text
from ninja_game.formats.ascii.reader import room_level
from ninja_game.formats.replay.input_text import read_inputs
from ninja_game.play.app import App
from ninja_game.play.menu_screen import MenuScreen
from ninja_game.play.replay.playback import Playback, RunClock
from ninja_game.play.workspace import KeyCommand, key_text
from ninja_game.sim.inputs import MOVES
from ninja_game.sim.level import Level
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas
from ninja_game.ui.input.bindings import ACTIONS
from ninja_game.ui.input.gamepad import pad_label
from ninja_game.ui.list_view import ListView, NameList
from ninja_game.ui.scenery import draw_scenery
from ninja_game.ui.theme import Area, Theme, wrapped
from ninja_game.ui.widgets import Button, Widget
from ninja_game.view.level_view import LevelView

PAGES_FILE = "help/pages.toml"


@dataclass(frozen=True)
class Page:
    """A page of the help. ``inputs``: one byte per tick; ``shows``: names of events that must happen."""

    title: str
    text: tuple[str, ...]
    level: Level
    inputs: bytes
    shows: tuple[str, ...]


def read_pages() -> list[Page]:
    """The pages of the bundled file. Raises LevelError that names an invalid page."""
    return [_page(table, PAGES_FILE) for table in tomllib.loads(asset_text(PAGES_FILE))["page"]]


def _page(table: dict[str, Any], file: str) -> Page:
    try:
        level = room_level(table["room"].strip("\n").split("\n"), table.get("objects", []))
    except LevelError as error:
        raise LevelError(f"the page {table['title']!r}: {error}", file) from error
    inputs = read_inputs([(1, table["keys"])]).keys
    return Page(table["title"], tuple(table["text"]), level, inputs, tuple(table["shows"]))


class HelpPage(MenuScreen):
    """All commands on one page: ``words``, then the table of ``commands``."""

    foot = "Esc goes back"

    def __init__(self, app: App, title: str, words: str, commands: Sequence[KeyCommand]) -> None:
        super().__init__(app)
        self.title = title
        self._words = words
        self._commands = [command for command in commands if command.keys or command.pad]

    def build(self) -> Sequence[Widget]:
        return []

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme = self.app.theme
        lines = [line for text in self._words.split("\n") for line in wrapped(theme, text, WIDTH - 80, 10)]
        for number, line in enumerate(lines):
            theme.text(surface, line, 40, 60 + 15 * number, size=10)
        rows = -(-len(self._commands) // 2)
        top = 70 + 15 * len(lines)
        keys, pads = (84, 86) if any(command.pad for command in self._commands) else (104, 0)
        for number, command in enumerate(self._commands):
            column, row = divmod(number, rows)
            x, y = 40 + 362 * column, top + min(19.0, (530 - top) / rows) * row
            theme.text(surface, key_text(command), x, y, size=10, bold=True, width=keys)
            pad = pad_label(command.pad) if command.pad else ""
            theme.text(surface, pad, x + keys + 2, y, size=9, width=pads, colour=theme.palette.faint)
            theme.text(surface, command.label, x + keys + pads + 4, y, size=10, width=356 - keys - pads)


WINDOW: Area = (240, 66, 504, 288)  # the area of the demonstration: that part of the stage, at its own scale

_MARGIN = 12.0  # px of the stage left out at the left of a room, so that half of its wall is visible

_REST_TICKS = 60  # ticks for which a demonstration stands still after its last input (game.md §4.4)

KEYS_TITLE = "Keys"
KEY_ROW = 22.0
KEY_COLUMNS = (0, 152, 340)  # x of an action's name, its keys and its buttons in their table


class HelpScreen(MenuScreen):
    """Topics at the left; the selected one's demonstration and text at the right."""

    title = "Help"

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.pages = read_pages()
        self.topics = [page.title for page in self.pages] + [KEYS_TITLE]
        x, y, w, _ = WINDOW
        self.list = NameList((44, 66, 190, 18 * 26), 26, self.topics, 11.5, self._show)
        self.list.hint = "Up and down: choose a topic"
        self.works = Button((x + w - 150, 516, 150, 30), "How it works", self._open_lab)
        self.works.hint = "For the curious: how ninja and walls really meet, in figures you can move"
        self.keys = ListView(
            (x, y + 54, w, 17 * KEY_ROW), KEY_ROW, self._draw_action, lambda _: None, selected=self._say_action
        )
        self.keys.fill(list(ACTIONS))
        self.demonstration: DemoRoom | None = None
        self.list.fill(self.topics)

    def build(self) -> Sequence[Widget]:
        return [self.list, self.works] if self.page else [self.list, self.keys, self.works]

    def _open_lab(self) -> None:
        from ninja_game.play.lab.screen import LabScreen

        self.app.push(LabScreen(self.app))

    def _show(self, index: int) -> None:
        page = self.pages[index] if index < len(self.pages) else None
        if page is None or self.demonstration is None or self.demonstration.page is not page:
            had_keys = self.demonstration is None
            self.demonstration = DemoRoom(self.app, page) if page is not None else None
            if self.widgets and had_keys != (page is None):
                self.enter()
        self.redraw = True

    @property
    def page(self) -> Page | None:
        return self.demonstration.page if self.demonstration else None

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        if self.demonstration is not None:
            self.demonstration.update(real_ms)

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        whole = self.redraw
        super().draw(surface)
        if self.demonstration is None:
            return None if whole else []
        rects = [self.demonstration.draw(surface), self._draw_keys_pressed(surface, self.demonstration.keys)]
        return None if whole else rects

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme = self.app.theme
        x, y, w, h = WINDOW
        theme.text(surface, f"version {__version__}", x, 526, size=9, colour=theme.palette.faint)
        if self.page is None:
            self._draw_table_head(surface, theme)
            return
        theme.text(surface, self.page.title, x, y + h + 54, size=18, bold=True)
        theme.paragraph(surface, self.page.text, (x, y + h + 84, w, 64), 12.5, 19)

    def _draw_keys_pressed(self, surface: pygame.Surface, keys: int) -> pygame.Rect:
        canvas, theme, palette = self.app.canvas, self.app.theme, self.app.theme.palette
        x, y, w, h = WINDOW
        row = canvas.rect(x, y + h + 10, w, 32)
        draw_scenery(surface, palette, canvas.stage, row)
        for place, (action, bit) in enumerate(MOVES):
            left = x + place * 92
            lit = bool(keys & bit)
            canvas.fill_rect(surface, palette.accent if lit else palette.panel, left, y + h + 12, 84, 26, 4)
            canvas.frame_rect(surface, palette.panel_edge, left, y + h + 12, 84, 26, 1, 4)
            colour = palette.background if lit else palette.text
            label = self.app.controls.name(action)
            theme.text(surface, label, left + 42, y + h + 19, size=11.5, colour=colour, align="centre")
        return row

    def _draw_table_head(self, surface: pygame.Surface, theme: Theme) -> None:
        x, y, w, _ = WINDOW
        theme.text(surface, KEYS_TITLE, x, y, size=18, bold=True)
        words = "Change them in Settings. The right mouse button goes back"
        theme.text(
            surface, words, x + w, y + 6, size=10, colour=theme.palette.faint, align="right", width=w - KEY_COLUMNS[1]
        )
        for left, text in zip(KEY_COLUMNS, ("Action", "Keyboard", "Gamepad"), strict=True):
            theme.text(surface, text, x + left, y + 34, size=10.5, colour=theme.palette.faint)

    def _draw_action(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        x, y, w, h = area
        action = list(ACTIONS)[index]
        texts = (ACTIONS[action].label, *self.app.controls.all_names(action))
        if focused:
            theme.row(surface, (x - 4, y, w, h), chosen=True, focused=False, radius=3)
        for left, end, text in zip(KEY_COLUMNS, (*KEY_COLUMNS[1:], w), texts, strict=True):
            theme.text(surface, text, x + left, y + 5, size=10.5, bold=not left and focused, width=end - left - 8)

    def _say_action(self, index: int) -> None:
        """Show the chosen action in the foot, which has room for the longest list of keys."""
        action = list(ACTIONS)[index]
        self.keys.hint = f"{ACTIONS[action].label}: {', '.join(filter(None, self.app.controls.all_names(action)))}"


class DemoRoom:
    """A page's room, whose inputs are repeated; drawn on its own sheet, part of which is shown."""

    def __init__(self, app: App, page: Page) -> None:
        self.app = app
        self.page = page
        self.clock = RunClock()
        self.keys = 0
        self._sheet: pygame.Surface | None = None
        self._canvas: Canvas | None = None
        self._begin()

    def _begin(self) -> None:
        self.simulation = Simulation(self.page.level)
        self.playback = Playback(self.simulation, self.page.inputs, spacing=0)
        self.view = LevelView(self.app, self.simulation, audible=False)
        self._whole = True

    def update(self, real_ms: int) -> None:
        for _ in range(self.clock.ticks_due(real_ms)):
            tick = self.playback.tick
            if tick >= len(self.page.inputs) + _REST_TICKS:
                self._begin()
                return
            self.keys = self.playback.keys_at(tick)
            self.playback.step()
            self.view.on_tick()

    def draw(self, surface: pygame.Surface) -> pygame.Rect:
        canvas = self.app.canvas
        if self._sheet is None or self._canvas is not canvas:
            self._sheet = pygame.Surface(surface.get_size())
            self._canvas = canvas
            self._whole = True
        self.view.draw(self._sheet, self.clock.fraction, whole=self._whole)
        self._whole = False
        x, y, w, h = WINDOW
        lowest = HEIGHT - 12 - h
        top = min(max(_MARGIN, self.simulation.world.ninja.y - h + 60), lowest)
        target = canvas.rect(x, y, w, h)
        surface.blit(self._sheet, target, pygame.Rect(canvas.point(_MARGIN, top), target.size))
        canvas.frame_rect(surface, self.app.theme.palette.panel_edge, x, y, w, h, 1)
        return target
