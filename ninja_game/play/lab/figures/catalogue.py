"""The figures of the lab, in the order in which they explain the world."""

from __future__ import annotations

from ninja_game.play.lab.figure import Figure
from ninja_game.play.lab.figures.cells import CellsTouched, NineCells
from ninja_game.play.lab.figures.drones import WalkingEnemies
from ninja_game.play.lab.figures.edges import EdgeStates
from ninja_game.play.lab.figures.grids import Bullets, FiveCells, LooseGrid
from ninja_game.play.lab.figures.one_tick import OneTick
from ninja_game.play.lab.figures.projection import Projection
from ninja_game.play.lab.figures.rays import RayCast

FIGURES: dict[str, type[Figure]] = {
    figure.name: figure
    for figure in (
        CellsTouched, EdgeStates, Projection, LooseGrid, NineCells, FiveCells, Bullets, RayCast, WalkingEnemies,
        OneTick,
    )
}  # fmt: skip
"""By the name that the command line has for each."""
