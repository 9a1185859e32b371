"""What events throw up: particles that begin and end where they should."""

from random import Random

import pytest

from ninja_game.sim import events
from ninja_game.sim.kinds import LAUNCHER, NINJA
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.sim.schema.world_fields import Event
from ninja_game.simulation import Simulation
from ninja_game.view.effects.effects import REACTIONS, Effects
from ninja_game.view.effects.particles import Particles
from ninja_game.view.sprites.object_animation import ObjectAnimation


@pytest.mark.parametrize("event, line, ahead", [("TURRET_FIRED", "shot", 0), ("CHAINGUN_SHOT", "bullet", 12)])
@pytest.mark.parametrize("facing", [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])
def test_a_shot_begins_at_the_muzzle_and_is_as_long_as_its_way_to_the_rock(
    event: str, line: str, ahead: int, facing: tuple[float, float]
) -> None:
    run = Simulation(Level(objects=(ObjectSpec(NINJA, (60.0, 560.0)),)))
    effects = Effects(Particles(), Random(1))
    fired = Event()
    fired.x, fired.y, (fired.dx, fired.dy) = 396.0, 300.0, facing
    REACTIONS[getattr(events, event)](effects, run.tiles, run.world, fired)
    (shot,) = (each for each in effects.particles.front if each.kind == line)
    assert (shot.x, shot.y) == (396 + ahead * facing[0], 300 + ahead * facing[1])
    reach = (768 - 396 if facing[0] > 0 else 396 - 24) if facing[0] else (576 - 300 if facing[1] > 0 else 300 - 24)
    assert (shot.dx, shot.dy) == pytest.approx((reach * facing[0], reach * facing[1]))
    fired.x = 1000.0
    REACTIONS[getattr(events, event)](effects, run.tiles, run.world, fired)
    *_, shot = (each for each in effects.particles.front if each.kind == line)
    assert (shot.dx, shot.dy) == (30 * facing[0], 30 * facing[1]), "outside the world nothing stops it"


def test_a_rocket_has_a_trail_of_nine_places() -> None:
    run = Simulation(Level(objects=(ObjectSpec(NINJA, (60.0, 560.0)), ObjectSpec(LAUNCHER, (700.0, 100.0)))))
    animation, lengths = ObjectAnimation(run.world), set[int]()
    for _ in range(200):
        run.step()
        animation.on_tick(run.world)
        lengths |= {*map(len, animation.trails.values())}
    assert max(lengths) == 9
