"""Plays the sounds of each tick's events and of lasting states. A machine without sound is not an error.

Some sounds depend on earlier ones: variants do not repeat, gold rises in pitch, steps have the pace of a run.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from math import isfinite
from pathlib import Path
from random import Random
from time import monotonic

import pygame

from ninja_game.runtime import run_in_background
from ninja_game.sim.rules import WORLD_WIDTH
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import Ninja, World
from ninja_game.sim.states import RUNNING
from ninja_game.ui.audio.music import CALM, LAYERS, Music, affects_music, music_levels
from ninja_game.ui.audio.table import CORPSE, LOOPS, PING, STEPS, Names, by_hardness, event_sound, has_loop, loop_levels

RATE = 44_100  # samples per second of our files
BUFFER = 512  # samples in the mixer's buffer: 12 ms of delay
CHANNELS = 32
LOUDEST = 99
PAN = 0.35  # how much softer the far side is for a sound at the stage's edge

CORPSE_PAUSE = 0.06  # seconds between two thuds of a corpse


class AudioOutput:
    """The interface of sound output; this class is silent. Presentation only: it reads the world."""

    def play_events(self, world: World) -> None:
        """Called after every visible tick: its events, and loops by state and speed."""

    def corpse(self, speed: float) -> None:
        """A part of the corpse hit something at this speed, px/tick."""

    def play(self, name: str) -> None:
        """Play a sound of the menus once."""

    def music(self, name: str, real_ms: int) -> None:
        """Called for every picture: the name of the music, "" for the present one; ms since the last picture."""

    def set_volumes(self, volume: int, effects: int, loop_volume: int, music_volume: int) -> None:
        """Set other volumes, 0 to 99."""

    def quiet(self) -> None:
        """End all sounds but the music, which becomes calm."""


class AudioPlayer(AudioOutput):
    """Plays the sounds. Volumes: 0 to 99; ``volume`` is the overall one. Without a sound device it is silent.

    ``folder``: of the Ogg files; missing ones are silent.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.volume = self.effects_volume = self.loop_volume = LOUDEST
        self.music_volume = 0
        self.soundtrack = Music(folder / "music", len(LOOPS))
        self._variants = Variants()
        self._gold_pitches = GoldPitches(len(PING))
        self._steps = Footsteps()
        self._sounds: dict[str, pygame.mixer.Sound | None] = {}
        self._world: World | None = None
        self._machines: list[Object] = []
        self._hunters: list[Object] = []
        self._corpse_at = 0.0
        self._closed = False
        self.works = _open_mixer()
        if self.works:
            # Reading while the device is closed corrupts memory: the program would crash later, anywhere.
            pygame.register_quit(self.close)
        self._reader = run_in_background(self._read_all, lambda _: None) if self.works else None

    def play_events(self, world: World) -> None:
        """After a tick: each of its events once, and the loops of lasting states."""
        if not self.works or not self.volume:
            return
        if world is not self._world:
            self._world = world
            self._machines = [o for o in world.objects[1:] if has_loop(o)]
            self._hunters = [o for o in world.objects[1:] if affects_music(o)]
        heard = set()
        for event in world.events[: world.event_count]:
            names, level = event_sound(event, world.ninja)
            if names and names not in heard:
                heard.add(names)
                name = PING[self._gold_pitches.next(world.tick)] if names is PING else self._variants.choose(names)
                self.play(name, x=event.x, level=level)
        if step := self._steps.loudness(world.ninja):
            self.play(self._variants.choose(STEPS), x=world.ninja.x, level=step)
        for name, level in loop_levels(world, self._machines).items():
            self._loop(name, level)
        self.soundtrack.levels = music_levels(world, self._hunters)

    def music(self, name: str, real_ms: int) -> None:
        if self.works and self.volume and self.music_volume:
            self.soundtrack.update(name, self.volume * self.music_volume / LOUDEST**2, real_ms)

    def corpse(self, speed: float) -> None:
        """A part of the corpse hit something, at ``speed`` px/tick into it (presentation.md §4)."""
        now, names = monotonic(), by_hardness(CORPSE, speed)
        if names and now - self._corpse_at >= CORPSE_PAUSE:
            self._corpse_at = now
            self.play(self._variants.choose(names))

    def quiet(self) -> None:
        self.soundtrack.levels = CALM
        if self.works:
            for number in range(CHANNELS):
                if not 0 <= number - len(LOOPS) < len(LAYERS):
                    pygame.mixer.Channel(number).stop()

    def close(self) -> None:
        """Stop reading. Called by ``pygame.quit`` and at the program's end, before the device is closed."""
        self._closed = True
        self.soundtrack.close()
        if self._reader:
            self._reader.join()

    def play(self, name: str, *, x: float = WORLD_WIDTH / 2, level: float = 1.0) -> None:
        """Play a sound once at this share of its loudness, located at ``x`` px of the stage."""
        sound = self._sound(name)
        # Not `find_channel`, which would return the channels that the loops have reserved.
        channel = sound.play() if sound and self.volume else None
        if channel:
            side = max(-1.0, min(1.0, 2 * x / WORLD_WIDTH - 1)) if isfinite(x) else 0.0
            level *= self.volume * self.effects_volume / LOUDEST**2
            channel.set_volume(level * (1 - PAN * max(side, 0.0)), level * (1 + PAN * min(side, 0.0)))

    def set_volumes(self, volume: int, effects: int, loop_volume: int, music_volume: int) -> None:
        self.volume, self.effects_volume, self.loop_volume = volume, effects, loop_volume
        self.music_volume = music_volume
        if not volume:
            self.quiet()
        if self.works and not (volume and music_volume):
            self.soundtrack.silence()

    def _loop(self, name: str, level: float) -> None:
        """Play a loop at this share of its loudness; 0 ends it. Each loop has its own channel."""
        channel = pygame.mixer.Channel([*LOOPS].index(name))
        if level <= 0:
            if channel.get_busy():
                channel.fadeout(60)
            return
        if not channel.get_busy():
            sound = self._sound(self._variants.choose(LOOPS[name]))
            if sound is None:
                return
            channel.play(sound, loops=-1, fade_ms=30)
        channel.set_volume(level * self.volume * self.effects_volume * self.loop_volume / LOUDEST**3)

    def _read_all(self) -> None:
        for path in sorted(self.folder.glob("*.ogg")):
            if self._closed:
                return
            self._sound(path.stem)

    def _sound(self, name: str) -> pygame.mixer.Sound | None:
        """A sound, read once; None if it is missing or cannot be played."""
        if not self.works:
            return None
        if name not in self._sounds:
            try:
                self._sounds[name] = pygame.mixer.Sound(self.folder / f"{name}.ogg")
            except (pygame.error, OSError):
                self._sounds[name] = None
        return self._sounds[name]


@contextmanager
def _quiet_libraries() -> Iterator[None]:
    """Silence stderr: without a sound card, the system's sound library writes many lines there."""
    kept = os.dup(2)
    with Path(os.devnull).open("wb") as silence:
        os.dup2(silence.fileno(), 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)


def _open_mixer() -> bool:
    try:
        if not pygame.mixer.get_init():
            with _quiet_libraries():
                pygame.mixer.init(RATE, -16, 2, BUFFER)
        pygame.mixer.set_num_channels(CHANNELS)
        pygame.mixer.set_reserved(len(LOOPS) + len(LAYERS))
    except (pygame.error, NotImplementedError):
        return False
    return True


CHAIN_TICKS = 60  # between two pieces of gold of a chain, in which the pitch rises

STEP_PX = 32.4  # px between two footsteps: half a cycle of the drawn legs (view/ninja/figure.py)


class Variants:
    """Chooses a variant of a sound, never the same twice in a row."""

    def __init__(self) -> None:
        self._rng = Random()  # noqa: S311 - which thud it is, is no secret
        self._last: dict[Names, str] = {}

    def choose(self, names: Names) -> str:
        others = [name for name in names if name != self._last.get(names)]
        self._last[names] = self._rng.choice(others or names)
        return self._last[names]


class GoldPitches:
    """The pitch of each piece of gold: it rises in a chain, and starts low after a pause or a restart."""

    def __init__(self, pitches: int) -> None:
        self.top = pitches - 1
        self._pitch, self._tick = -1, -1

    def next(self, tick: int) -> int:
        """The pitch of gold collected in this tick, from 0."""
        chained = self._pitch >= 0 and 0 <= tick - self._tick <= CHAIN_TICKS
        self._pitch = min(self._pitch + 1, self.top) if chained else 0
        self._tick = tick
        return self._pitch


class Footsteps:
    """Decides when a foot touches the floor. The first step of a run comes after half a stride."""

    def __init__(self) -> None:
        self._way = STEP_PX / 2

    def loudness(self, ninja: Ninja) -> float:
        """Loudness of the step of this tick, a share by speed, and 0 without one. To be called every tick."""
        if ninja.state != RUNNING:
            self._way = STEP_PX / 2
            return 0.0
        speed = abs((ninja.x - ninja.prev_x) * -ninja.floor_y + (ninja.y - ninja.prev_y) * ninja.floor_x)
        self._way += speed
        if self._way < STEP_PX:
            return 0.0
        self._way -= STEP_PX
        return min(1.0, 0.4 + speed / 6)
