"""From events and states of the world to particles, with random numbers that the world never reads."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, hypot, pi, radians, sin
from random import Random

from ninja_game.sim import events as ev, states
from ninja_game.sim.collision.rays import ray_tiles
from ninja_game.sim.kinds import DRONE, LAUNCHER
from ninja_game.sim.rules import FATAL_IMPACT, FLOOR_ALLOWANCE
from ninja_game.sim.schema.world_fields import Event, TileMap, World
from ninja_game.view.effects.particles import Particle, Particles

CONFETTI_FALL = 90.0  # most px that a paper falls

_CHARGED = {states.DRONE_PRE_FIRE, states.DRONE_FIRING}


class Effects:
    """Makes the particles of a view. ``gore``: whether blood is shown; otherwise deaths make sparks."""

    def __init__(self, particles: Particles, rng: Random) -> None:
        self.particles = particles
        self.rng = rng
        self.gore = True
        self._skid_count = 0
        self.now = 0.0

    def reset(self) -> None:
        """A new run, or a jump in time."""
        self.particles.clear()
        self.now = 0.0

    def on_tick(self, tiles: TileMap, world: World) -> None:
        """Make the particles of a tick."""
        self.now += 1.0
        self.particles.expire(self.now)
        for event in world.events[: world.event_count]:
            react = REACTIONS.get(event.kind)
            if react:
                react(self, tiles, world, event)
        self._wall_and_floor(world)
        self._fall(world)
        for slot in range(1, world.id_count + 1):
            o = world.objects[slot]
            if o.kind == LAUNCHER and o.routine == states.LAUNCHER_FLIGHT:
                self._smoke(o.x, o.y, o.heading_x, o.heading_y)
            elif o.kind == DRONE and o.weapon == states.WEAPON_LASER and o.routine in _CHARGED:
                self._charge(o.x, o.y)

    # --- building blocks ---

    def add(
        self, kind: str, x: float, y: float, dx: float = 0.0, dy: float = 0.0, *,
        life: float = 10.0, size: float = 1.0, rear: bool = False,
    ) -> None:  # fmt: skip
        """One particle that starts now. ``life``: frames of 1/120 s."""
        variant = self.rng.randrange(6)
        self.particles.add(Particle(kind, x, y, dx, dy, life / 3, size, variant, self.now), rear=rear)

    def spread(self, kind: str, x: float, y: float, count: int, reach: float, *, life: float) -> None:
        """Some in random directions, 40 to 100 % of ``reach`` px far."""
        for _ in range(count):
            angle = self.rng.uniform(0, 2 * pi)
            far = reach * self.rng.uniform(0.4, 1.0)
            self.add(kind, x, y, far * cos(angle), far * sin(angle), life=life)

    def puffs(self, x: float, y: float, nx: float, ny: float, angle: float, length: float, count: int = 4) -> None:
        """Puffs of dust from a surface with normal (nx, ny), to alternating sides."""
        for k in range(count):
            side = 1 if k % 2 else -1
            turn = radians((angle + self.rng.uniform(-10, 10)) * side)
            tx, ty = -ny * side, nx * side
            dx = tx * cos(turn) + nx * abs(sin(turn))
            dy = ty * cos(turn) + ny * abs(sin(turn))
            far = length * self.rng.uniform(0.6, 1.2)
            self.add("dust", x, y, dx * far, dy * far, life=32, size=0.7, rear=True)

    def explosion(self, x: float, y: float) -> None:
        """A mine's or a rocket's end."""
        self.add("burst", x, y, life=18)
        for _ in range(5):
            angle = self.rng.uniform(0, 2 * pi)
            self.add("fireball", x, y, 11 * cos(angle), 11 * sin(angle), life=self.rng.uniform(14, 26))
        self.spread("debris", x, y, 6, 34, life=24)
        self.spread("smoke", x, y, 4, 18, life=40)

    def blood(self, x: float, y: float, dx: float, dy: float, count: int) -> None:
        """Spurts along an impulse, each in a slightly different direction."""
        kind = "blood" if self.gore else "dust"
        for _ in range(count):
            share = self.rng.uniform(3, 6)
            way = dx * share + self.rng.uniform(-22, 22), dy * share + self.rng.uniform(-26, 16)
            self.add(kind, x, y, *way, life=self.rng.uniform(22, 36))

    # --- while a state lasts ---

    def _wall_and_floor(self, world: World) -> None:
        n = world.ninja
        vx, vy = n.x - n.prev_x, n.y - n.prev_y
        if n.state not in {states.SKIDDING, states.SLIDING}:
            return
        self._skid_count += 1
        if self._skid_count < 3:
            return
        self._skid_count = self.rng.randrange(2)
        if n.state == states.SKIDDING and abs(vx) > 0.4:
            x, y = n.x - n.floor_x * 10, n.y - n.floor_y * 10
            self.add("dust", x, y, -vx * 2.2, -3 - abs(vx), life=32, size=0.8, rear=True)
        elif n.state == states.SLIDING and abs(vy) > 0.3:
            y = n.y + self.rng.uniform(-8, 8)
            self.add("dust", n.x - n.wall_x * 10, y, n.wall_x * 4, -vy * 3, life=32, size=0.7, rear=True)

    def _fall(self, world: World) -> None:
        """Lines in the colour of danger trail behind a ninja so fast that flat ground would kill it."""
        n = world.ninja
        if n.in_air and n.state != states.DEAD and n.y - n.prev_y > FATAL_IMPACT - FLOOR_ALLOWANCE:
            for side in (-1, 1):
                self.add("plunge", n.x + side * self.rng.uniform(2, 11), n.y + 4, 0, -34, life=24, rear=True)

    def _smoke(self, x: float, y: float, hx: float, hy: float) -> None:
        drift = self.rng.uniform(4, 12)
        self.add("smoke", x - hx * 9, y - hy * 9, -hx * drift, -hy * drift - 3, life=27, size=0.8, rear=True)

    def _charge(self, x: float, y: float) -> None:
        angle, far = self.rng.uniform(0, 2 * pi), self.rng.uniform(18, 34)
        dx, dy = far * cos(angle), far * sin(angle)
        self.add("charge", x + dx, y + dy, -dx, -dy, life=15)


# --- reactions to events ---


def _jumped(effects: Effects, tiles: TileMap, world: World, event: Event) -> None:
    # The event comes after the jump's displacement; the dust stays at the place before.
    x, y = event.x - event.dx * 11, event.y - event.dy * 12 + (3 if event.dy else 0)
    effects.puffs(x, y, event.dx, event.dy, 20, 7)


def _landed(effects: Effects, tiles: TileMap, world: World, event: Event) -> None:
    n = world.ninja
    impact = hypot(event.dx, event.dy)
    x, y = event.x - n.floor_x * 10, event.y - n.floor_y * 10
    effects.puffs(x, y, n.floor_x, n.floor_y, 40, 4 + 1.6 * impact, count=2 + min(8, round(impact)))


def _won(effects: Effects, tiles: TileMap, world: World, event: Event) -> None:
    """Light spreads behind the ninja, sparks before it, and papers fly."""
    for k in range(3):
        effects.add("halo", event.x, event.y, life=40 + 14 * k, size=1.0 + 0.35 * k, rear=True)
    effects.spread("spark", event.x, event.y, 12, 60, life=40)
    for _ in range(48):
        angle = effects.rng.uniform(-pi, 0)
        x, y = _free_way(tiles, world, event.x, event.y, angle, effects.rng.uniform(40, 190))
        _, ground = _free_way(tiles, world, x, y, pi / 2, CONFETTI_FALL)
        life, variant = effects.rng.uniform(130, 220) / 3, effects.rng.randrange(6)
        flight = x - event.x, y - event.y
        effects.particles.add(
            Particle("confetti", event.x, event.y, *flight, life, 1.0, variant, effects.now, ground - y)
        )


def _free_way(tiles: TileMap, world: World, x: float, y: float, angle: float, far: float) -> tuple[float, float]:
    """The end of a path of this length, which stops before a wall."""
    dx, dy = cos(angle), sin(angle)
    stopped, to_x, to_y = ray_tiles(tiles, world, x, y, x + dx, y + dy)
    way = min(far, max(0.0, hypot(to_x - x, to_y - y) - 3)) if stopped else far
    return x + dx * way, y + dy * way


def _died(effects: Effects, tiles: TileMap, world: World, event: Event) -> None:
    n = world.ninja
    if event.cause == states.ELECTRIC:
        for _ in range(6):
            angle = effects.rng.uniform(0, 2 * pi)
            effects.add("zap", event.x, event.y, 34 * cos(angle), 34 * sin(angle), life=effects.rng.uniform(12, 24))
        effects.spread("bolt", event.x, event.y, 8, 40, life=22)
    elif event.cause == states.EXPLOSIVE:
        effects.spread("spark", n.x, n.y, 8, 42, life=26)
    elif event.cause == states.FALL:
        effects.puffs(n.x, n.y + 9, 0, -1, 40, 14)
    effects.blood(event.x, event.y, event.dx, event.dy, effects.rng.randint(8, 14))


def _launched(effects: Effects, tiles: TileMap, world: World, event: Event) -> None:
    length = hypot(event.dx, event.dy) or 1.0
    effects.puffs(event.x, event.y + 6, event.dx / length, event.dy / length, 55, 9)


def _thud(effects: Effects, tiles: TileMap, world: World, event: Event) -> None:
    x, y = event.x + event.dx * 9, event.y + event.dy * 9
    effects.puffs(x, y, -event.dx, -event.dy, 25, 9)


def _line_of_fire(tiles: TileMap, world: World, event: Event) -> tuple[float, float]:
    """The end of a shot from an event's place in its direction: a tile, or the ninja before it."""
    hit, x, y = ray_tiles(tiles, world, event.x, event.y, event.x + event.dx, event.y + event.dy)
    return (x, y) if hit else (event.x + 30 * event.dx, event.y + 30 * event.dy)


def _turret_fired(effects: Effects, tiles: TileMap, world: World, event: Event) -> None:
    x, y = _line_of_fire(tiles, world, event)
    effects.add("shot", event.x, event.y, x - event.x, y - event.y, life=14)
    effects.add("muzzle", event.x, event.y, event.dx, event.dy, life=7)
    effects.spread("debris", x, y, 5, 18, life=16)


def _bullet(effects: Effects, tiles: TileMap, world: World, event: Event) -> None:
    x, y = _line_of_fire(tiles, world, event)
    effects.add("bullet", event.x + 12 * event.dx, event.y + 12 * event.dy, x - event.x, y - event.y, life=8)
    effects.add("muzzle", event.x + 11 * event.dx, event.y + 11 * event.dy, event.dx, event.dy, life=8)
    effects.spread("debris", x, y, 3, 14, life=13)


REACTIONS: dict[int, Callable[[Effects, TileMap, World, Event], None]] = {
    ev.JUMPED: _jumped,
    ev.WALL_JUMPED: _jumped,
    ev.LANDED: _landed,
    ev.LAUNCHED: _launched,
    ev.DIED: _died,
    ev.WON: _won,
    ev.GOLD_TAKEN: lambda e, _level, _world, event: e.add("gold", event.x, event.y, life=28),
    ev.MINE_EXPLODED: lambda e, _level, _world, event: e.explosion(event.x, event.y),
    ev.ROCKET_EXPLODED: lambda e, _level, _world, event: e.explosion(event.x, event.y),
    ev.ROCKET_LAUNCHED: lambda e, _level, _world, event: e.spread("smoke", event.x, event.y, 5, 12, life=26),
    ev.THWUMP_LANDED: _thud,
    ev.TURRET_FIRED: _turret_fired,
    ev.CHAINGUN_SHOT: _bullet,
}
"""The particles of each event; other events have only a sound."""
