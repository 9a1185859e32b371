"""A real world in a figure: a simulation on the plain memory, drawn as the game draws it, magnified."""

from __future__ import annotations

from collections.abc import Sequence

import pygame

from ninja_game.play.lab.sheet import Sheet
from ninja_game.play.lab.watching import Call, watch
from ninja_game.play.menus.help.pages import room_level
from ninja_game.play.ui.canvas import HEIGHT, WIDTH
from ninja_game.play.view.level_view import LevelView
from ninja_game.play.view.render_context import OffscreenContext
from ninja_game.player.settings import Settings
from ninja_game.simulation import Simulation


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
        """One tick, watched."""
        _, self.calls = watch(self.simulation.step_keys, keys)
        if self._view is not None:
            self._view.on_tick()

    def draw(self, sheet: Sheet) -> None:
        """The part of the world that the figure shows."""
        scale = sheet.theme.canvas.scale * sheet.view.zoom
        look = scale, sheet.palette.name
        if self._view is None or look != self._look:
            self._look = look
            self._sheet = pygame.Surface((round(WIDTH * scale), round(HEIGHT * scale)))
            context = OffscreenContext(self._sheet.get_size(), Settings().changed(palette=sheet.palette.name))
            self._view = LevelView(context, self.simulation, audible=False)
            self._view.draw(self._sheet, 1.0, whole=True)
        else:
            self._view.draw(self._sheet, 1.0)
        left, top = round(sheet.view.left * scale), round(sheet.view.top * scale)
        sheet.surface.blit(self._sheet, sheet.area, pygame.Rect((left, top), sheet.area.size))
