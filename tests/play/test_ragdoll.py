"""The corpse: falls, lies still, stays out of walls, and comes out alike from the same chance."""

from random import Random

from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.kinds import BOUNCE_BLOCK
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.sim.states import BULLET, CELEBRATING, EXPLOSIVE
from ninja_game.simulation import Simulation
from ninja_game.view.ninja.figure import DANCES, SKID, STAND
from ninja_game.view.ninja.ninja_animation import NinjaAnimation
from ninja_game.view.ninja.ragdoll import STICKS, Ragdoll, VerletParticle, _square


def cave(tile: int = 0) -> Simulation:
    """A hall with a slope or another tile in every third cell of its floor."""
    tiles = [0] * 713
    for column in range(0, 31, 3):
        tiles[column * 23 + 22] = tile
    return Simulation(Level(tuple(tiles), (ObjectSpec(5, (396.0, 300.0)),)))


def drop(run: Simulation, ticks: int, *, kind: int = BULLET, seed: int = 3, push: float = 6.0) -> Ragdoll:
    at = STAND.moved(396, 300)
    doll = Ragdoll(at, at, (1.0, -1.0), 1, Random(seed), lambda *_: None)
    doll.shove(kind, (push, -3.0), 296, 300)
    for _ in range(ticks):
        doll.step(run.tiles, run.world)
    return doll


def test_every_dance_is_danced() -> None:
    animation = NinjaAnimation(cave().world, Random(1))
    animation.state = CELEBRATING
    for animation.dance, dance in enumerate(DANCES):
        assert animation.local_pose(0.0) == dance.at(animation.since)[0]


def test_it_comes_to_rest_on_the_floor() -> None:
    run = cave()
    doll = drop(run, 600)
    for particle in doll.particles:
        assert abs(particle.x - particle.sx) < 0.3
        assert particle.y + particle.half <= 576.6
    assert max(particle.y for particle in doll.particles) > 560


def test_sticks_keep_it_together() -> None:
    doll = drop(cave(), 600)
    for stick in STICKS:
        a, b = doll.particles[stick.first], doll.particles[stick.second]
        assert ((a.x - b.x) ** 2 + (a.y - b.y) ** 2) ** 0.5 < stick.longest + 3


def test_it_stays_out_of_every_shape() -> None:
    for tile in range(1, 34):
        run = cave(tile)
        for push in (-9.0, 9.0):
            doll = drop(run, 200, push=push)
            for particle in doll.particles:
                assert 24 <= particle.x <= 768
                assert 24 <= particle.y <= 576
                assert not solid_at(run.tiles, particle.x, particle.y), (tile, push)


def test_a_joint_lies_on_a_block_and_not_in_it() -> None:
    run = Simulation(Level(objects=(ObjectSpec(5, (60.0, 60.0)), ObjectSpec(BOUNCE_BLOCK, (396.0, 300.0)))))
    joint = VerletParticle(396, 300 - 9.6 - 1.6, 0, 0, 2, 0)
    assert list(_square(run.world.objects[2], joint)) == [(0, -1, 0)]


def test_a_hand_that_was_in_the_wall_does_not_hold_it_there() -> None:
    run = cave()
    at = SKID.placed(-1, 0.0).moved(758, 300)
    doll = Ragdoll(at, at, (0.0, 1.0), -1, Random(1), lambda *_: None)
    assert any(solid_at(run.tiles, particle.x, particle.y) for particle in doll.particles)
    for _ in range(300):
        doll.step(run.tiles, run.world)
    for particle in doll.particles:
        assert 24 <= particle.x <= 768
        assert particle.y > 540


def test_it_is_heard_where_it_falls_and_slides_on() -> None:
    run, at, hits = cave(), STAND.moved(396, 540), []
    doll = Ragdoll(at, at, (4.0, 3.0), 1, Random(3), lambda *hit: hits.append(hit))
    for _ in range(20):
        doll.step(run.tiles, run.world)
    assert max(into for _, _, into, _ in hits) > 2
    assert max(abs(along) for _, _, _, along in hits) > 3
    first = min(x for x, *_ in hits)
    assert all(particle.x > first + 10 for particle in doll.particles)


def test_explosions_take_it_apart() -> None:
    doll = drop(cave(), 5, kind=EXPLOSIVE)
    assert doll.dismembered
    assert len(doll.particles) == 10


def test_the_same_chance_gives_the_same_fall() -> None:
    first, second = drop(cave(), 150), drop(cave(), 150)
    assert [(p.x, p.y) for p in first.particles] == [(p.x, p.y) for p in second.particles]


def test_the_world_does_not_notice() -> None:
    run = cave(2)
    before = run.digest()
    drop(run, 100)
    assert run.digest() == before


def test_figure_on_a_slope_keeps_its_feet_on_it_and_its_head_over_them() -> None:
    animation = NinjaAnimation(Simulation(Level((0,) * 713, (ObjectSpec(5, (100.0, 100.0)),))).world, Random(1))
    flat = animation.pose(1.0)
    animation.turn = animation.turn_before = -45.0
    slope = animation.pose(1.0)
    assert (slope.near_foot, slope.far_foot) == flat.placed(1, -45.0)[5:]
    assert abs(slope.head[0] - slope.pelvis[0]) < 0.4 * abs(slope.head[1] - slope.pelvis[1])
