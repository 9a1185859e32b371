"""The figures of the lab, in the order in which they explain the world."""

from __future__ import annotations

from ninja_game.play.lab.bullets import Bullets
from ninja_game.play.lab.cells import CellsTouched, NineCells
from ninja_game.play.lab.drones import WalkingEnemies
from ninja_game.play.lab.edges import EdgeStates
from ninja_game.play.lab.figure import Figure
from ninja_game.play.lab.grids import LooseGrid
from ninja_game.play.lab.one_tick import OneTick
from ninja_game.play.lab.pairs import FiveCells
from ninja_game.play.lab.projection import Projection
from ninja_game.play.lab.rays import Rays

FIGURES: dict[str, type[Figure]] = {
    figure.name: figure
    for figure in (
        CellsTouched, EdgeStates, Projection, LooseGrid, NineCells, FiveCells, Bullets, Rays, WalkingEnemies, OneTick,
    )
}  # fmt: skip
"""By the name that the command line has for each."""
