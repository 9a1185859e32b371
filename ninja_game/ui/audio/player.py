"""Sound: hears the events of each tick and what goes on, and plays it. A machine without sound is not an error."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from math import floor, isfinite
from pathlib import Path
from random import Random
from time import monotonic

import pygame

from ninja_game.sim import events, states
from ninja_game.sim.events import DIED
from ninja_game.sim.kinds import DRONE, FLOOR_GUARD, LAUNCHER
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.memory.schema import World
from ninja_game.sim.rules import WORLD_WIDTH
from ninja_game.sim.states import WEAPON_LASER

RATE, BUFFER = 22_050, 256
"""Samples a second, those of our files; and in the mixer's buffer: 12 ms of delay."""

CHANNELS = 32
LOUDEST = 99
PAN = 0.35
"""How much softer the far side gets for a sound at the stage's edge."""

CORPSE_PAUSE = 0.06
"""Seconds between two thuds of a corpse."""


class AudioOutput:
    """Plays what happens; this one is silent. Presentation only: it reads the world."""

    def play_events(self, world: World) -> None:
        """Called after every tick that is seen: its events, and loops by state and speed."""

    def corpse(self, speed: float) -> None:
        """A part of the corpse hit something at this speed, px/tick."""

    def play(self, name: str) -> None:
        """Play a sound of the menus once."""

    def set_volumes(self, volume: int, loop_volume: int) -> None:
        """Take other volumes, 0 to 99."""

    def quiet(self) -> None:
        """End all sounds."""


class AudioPlayer(AudioOutput):
    """Plays what happens. ``volume`` and ``loop_volume``: 0 to 99. Without a sound device it is silent.

    ``folder``: where the WAV files are; missing ones are silent.
    """

    def __init__(self, folder: Path, *, volume: int = LOUDEST, loop_volume: int = LOUDEST) -> None:
        self.folder = folder
        self.volume = volume
        self.loop_volume = loop_volume
        self._rng = Random()  # noqa: S311 - which thud it is, is no secret
        self._sounds: dict[str, pygame.mixer.Sound | None] = {}
        self._world: World | None = None
        self._machines: list[Object] = []
        self._corpse_at = 0.0
        self.works = _open_mixer()
        for path in sorted(folder.glob("*.wav")):
            self._sound(path.stem)

    # --- what is heard ---

    def play_events(self, world: World) -> None:
        """After a tick: its events once each, and the loops of what goes on."""
        if not self.works or not self.volume:
            return
        if world is not self._world:
            self._world = world
            self._machines = [o for o in world.objects[1:] if _has_loop(o)]
        heard = set()
        for event in world.events[: world.event_count]:
            names = BY_DEATH.get(event.cause, OTHER_DEATH) if event.kind == DIED else BY_EVENT.get(event.kind, ())
            if names and names not in heard:
                heard.add(names)
                self.play(self._rng.choice(names), x=event.x)
        for name, level in loop_levels(world, self._machines).items():
            self._loop(name, level)

    def corpse(self, speed: float) -> None:
        """A part of the corpse hit something, at ``speed`` px/tick into it (presentation.md §4)."""
        now = monotonic()
        if now - self._corpse_at < CORPSE_PAUSE:
            return
        for slowest, names in CORPSE:
            if speed > slowest:
                self._corpse_at = now
                self.play(self._rng.choice(names))
                return

    def quiet(self) -> None:
        if self.works:
            pygame.mixer.stop()

    def play(self, name: str, *, x: float = WORLD_WIDTH / 2) -> None:
        """Play a sound once, heard from ``x`` px of the stage."""
        sound = self._sound(name)
        # Not `find_channel`, which would give away the channels that the loops have reserved.
        channel = sound.play() if sound and self.volume else None
        if channel:
            side = max(-1.0, min(1.0, 2 * x / WORLD_WIDTH - 1)) if isfinite(x) else 0.0
            level = self.volume / LOUDEST
            channel.set_volume(level * (1 - PAN * max(side, 0.0)), level * (1 + PAN * min(side, 0.0)))

    # --- how ---

    def set_volumes(self, volume: int, loop_volume: int) -> None:
        """Take other volumes, 0 to 99."""
        self.volume, self.loop_volume = volume, loop_volume
        if not volume:
            self.quiet()

    def _loop(self, name: str, level: float) -> None:
        """Keep a loop going at this share of its loudness; 0 ends it. Each loop has a channel of its own."""
        channel = pygame.mixer.Channel(LOOPS.index(name))
        if level <= 0:
            if channel.get_busy():
                channel.fadeout(60)
            return
        sound = self._sound(name)
        if sound is None:
            return
        if channel.get_sound() is not sound or not channel.get_busy():
            channel.play(sound, loops=-1, fade_ms=30)
        channel.set_volume(level * self.volume * self.loop_volume / LOUDEST**2)

    def _sound(self, name: str) -> pygame.mixer.Sound | None:
        """A sound, read once; None if it is missing or cannot be played."""
        if not self.works:
            return None
        if name not in self._sounds:
            try:
                self._sounds[name] = pygame.mixer.Sound(self.folder / f"{name}.wav")
            except (pygame.error, OSError):
                self._sounds[name] = None
        return self._sounds[name]


def _has_loop(o: Object) -> bool:
    """Whether an object makes a lasting sound at times."""
    return o.kind in (LAUNCHER, FLOOR_GUARD) or (o.kind == DRONE and o.weapon == WEAPON_LASER)


@contextmanager
def _quiet_libraries() -> Iterator[None]:
    """Nothing on stderr: where there is no sound card, the system's sound library complains there in many lines."""
    kept = os.dup(2)
    silence = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silence, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(silence)


def _open_mixer() -> bool:
    """Whether there is a sound device that can be used."""
    try:
        if not pygame.mixer.get_init():
            with _quiet_libraries():
                pygame.mixer.init(RATE, -16, 2, BUFFER)
        pygame.mixer.set_num_channels(CHANNELS)
        pygame.mixer.set_reserved(len(LOOPS))
    except (pygame.error, NotImplementedError):
        return False
    return True


Names = tuple[str, ...]
"""Sounds of which one is chosen by chance."""

BY_EVENT: dict[int, Names] = {
    events.JUMPED: ("jump",),
    events.WALL_JUMPED: ("jump",),
    events.LANDED: ("land",),
    events.LAUNCHED: ("launch",),
    events.WON: ("passed",),
    events.GOLD_TAKEN: ("gold",),
    events.MINE_EXPLODED: ("mine",),
    events.EXIT_OPENED: ("exit-open",),
    events.DOOR_OPENED: ("door-open",),
    events.DOOR_CLOSED: ("door-close",),
    events.LOCK_OPENED: ("lock-open",),
    events.TRAP_CLOSED: ("trap-close",),
    events.CHASE_STARTED: ("chase",),
    events.ROCKET_LAUNCHED: ("rocket-launch",),
    events.ROCKET_EXPLODED: ("rocket-explode",),
    events.TURRET_LOCKED: ("turret-lock",),
    events.TURRET_FIRED: ("turret-fire",),
    events.LASER_CHARGING: ("laser-charge",),
    events.CHAINGUN_CHARGING: ("chaingun-charge",),
    events.CHAINGUN_SHOT: ("chaingun-shot",),
    events.CHAINGUN_OFF: ("chaingun-off",),
}

BY_DEATH: dict[int, Names] = {
    states.EXPLOSIVE: ("death-explosive-1", "death-explosive-2"),
    states.FALL: ("death-fall",),
    states.LASER: ("death-laser",),
    states.ELECTRIC: ("death-electric",),
}
OTHER_DEATH: Names = ("death-bullet-1", "death-bullet-2")

CORPSE: tuple[tuple[float, Names], ...] = (
    (3.0, ("corpse-hard-1", "corpse-hard-2", "corpse-hard-3")),
    (2.0, ("corpse-medium-1", "corpse-medium-2")),
    (1.2, ("corpse-soft-1", "corpse-soft-2")),
)
"""Slowest speed (px/tick) of each hardness, hardest first."""

LOOPS = ("skid", "slide", "rocket-flight", "laser-beam", "guard")

_LASTING = {
    LAUNCHER: (states.LAUNCHER_FLIGHT, "rocket-flight"),
    DRONE: (states.DRONE_FIRING, "laser-beam"),
    FLOOR_GUARD: (states.GUARD_CHASE, "guard"),
}
"""By kind: the routine that lasts, and its loop."""


def loop_levels(world: World, machines: Iterable[Object]) -> dict[str, float]:
    """How loud each loop is, 0 to 1. ``machines``: the launchers, floor guards and laser drones of the world."""
    levels = dict.fromkeys(LOOPS, 0.0)
    ninja = world.ninja
    vx, vy = ninja.x - ninja.prev_x, ninja.y - ninja.prev_y
    if ninja.state == states.SKIDDING:
        levels["skid"] = _percent(100 * abs(vx * -ninja.floor_y + vy * ninja.floor_x))
    elif ninja.state == states.SLIDING:
        levels["slide"] = _percent(70 * abs(vy))
    for machine in machines:
        routine, name = _LASTING[machine.kind]
        if machine.routine == routine:
            levels[name] = 1.0
    return levels


def _percent(value: float) -> float:
    """A volume in whole per cent, as a share."""
    return min(100, floor(value)) / 100
