"""Music: a loop in layers for each place; layers fade in with danger, speed and the open exit."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import exp, hypot
from pathlib import Path
from threading import Thread
from typing import NamedTuple

import pygame

from ninja_game.runtime import run_in_background
from ninja_game.sim import states
from ninja_game.sim.kinds import DRONE, EXIT, FLOOR_GUARD, LAUNCHER, TURRET
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import World
from ninja_game.ui.audio.table import warning_of

MENU = "menu"
COLUMN_MUSIC = ("ground", "machines", "places", "trials", "hardest")

SILENCE = "silence"

LAYERS = ("base", "danger", "speed", "exit")
LAYERS_OF: dict[str, tuple[str, ...]] = {MENU: LAYERS[:1], **dict.fromkeys(COLUMN_MUSIC, LAYERS)}

FADE_MS = 350  # from one music to the next, each way
FOLLOW_MS = 700  # time in which a layer goes 63 % of the way to its level
_NEAR = 120.0  # px from a danger to the loudest layer
_FAR = 420.0  # px to where a danger is not heard
FAST = 3.2  # px/tick with the loudest layer of speed; silent at half of it


class MusicLevels(NamedTuple):
    """The level of each layer, 0 to 1."""

    base: float = 1.0
    danger: float = 0.0
    speed: float = 0.0
    exit: float = 0.0


CALM = MusicLevels()


def affects_music(o: Object) -> bool:
    """Whether an object may hunt the ninja, or is an exit."""
    return o.kind in (LAUNCHER, FLOOR_GUARD, DRONE, TURRET, EXIT)


def music_levels(world: World, objects: Iterable[Object]) -> MusicLevels:
    """The levels for a moment of play. ``objects``: those of the world for which ``affects_music`` holds."""
    ninja = world.ninja
    danger, is_open = 0.0, 0.0
    for o in objects:
        if o.kind == EXIT:
            is_open = max(is_open, float(o.is_open))
        elif warning_of(o):
            danger = max(danger, (_FAR - hypot(o.x - ninja.x, o.y - ninja.y)) / (_FAR - _NEAR))
    speed = 2 * hypot(ninja.x - ninja.prev_x, ninja.y - ninja.prev_y) / FAST - 1
    alive = world.outcome == states.OUTCOME_RUNNING
    return MusicLevels(1.0, min(1.0, danger) * alive, min(1.0, max(0.0, speed)) * alive, is_open)


class Music:
    """Plays one music at a time. ``folder``: of its files; ``first``: its first channel, one for each layer.

    All layers start together; only their volumes differ.
    """

    def __init__(self, folder: Path, first: int) -> None:
        self.folder = folder
        self.first = first
        self.levels = CALM
        self.playing = self._requested = ""
        self._sounds: Sequence[pygame.mixer.Sound] | None = None
        self._share = 0.0
        self._heard = list(CALM)
        self._readers: list[Thread] = []

    def update(self, name: str, volume: float, real_ms: int) -> None:
        """Let time pass. ``name``: of the music, "" for the present one; ``volume``: a share."""
        if name == self.playing or not name:
            self._share = min(1.0, self._share + real_ms / FADE_MS)
        else:
            self._share = max(0.0, self._share - real_ms / FADE_MS)
            if self._share == 0.0:
                self._change(name)
        follow = 1 - exp(-real_ms / FOLLOW_MS)
        for layer in range(len(LAYERS_OF.get(self.playing, ()))):
            self._heard[layer] += (self.levels[layer] - self._heard[layer]) * follow
            pygame.mixer.Channel(self.first + layer).set_volume(volume * self._share * self._heard[layer])

    def silence(self) -> None:
        """Stop at once; the next music begins from its start."""
        for layer in range(len(LAYERS)):
            pygame.mixer.Channel(self.first + layer).stop()
        self.playing, self._share = "", 0.0

    def close(self) -> None:
        """Wait until all files are read."""
        for reader in self._readers:
            reader.join()

    def _change(self, name: str) -> None:
        """Begin another music when it has been read; the one before ends."""
        if self._requested != name:
            self._requested, self._sounds = name, None
            reading = run_in_background(lambda: self._read(name), lambda _: None)
            self._readers = [*filter(Thread.is_alive, self._readers), reading]
        sounds = self._sounds
        if sounds is None or not all(sound.get_length() for sound in sounds):
            return
        self.silence()
        self.playing, self._heard = name, list(self.levels)
        for layer, sound in enumerate(sounds):
            channel = pygame.mixer.Channel(self.first + layer)
            channel.play(sound, loops=-1)
            channel.set_volume(0)

    def _read(self, name: str) -> None:
        try:
            files = [self.folder / f"{name}-{layer}.ogg" for layer in LAYERS_OF.get(name, ())]
            sounds = [pygame.mixer.Sound(file) for file in files]
        except (pygame.error, OSError):
            sounds = []
        if self._requested == name:
            self._sounds = sounds
