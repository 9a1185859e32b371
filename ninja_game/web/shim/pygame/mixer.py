"""Sound: channels that JavaScript plays."""

from __future__ import annotations

from os import fspath
from typing import Any

from .host import LINK, error


class _Mixer:
    """The state of pygame's module ``mixer``: one for the page."""

    channels: tuple[Channel, ...] = ()
    reserved = 0  # the first channels, which `Sound.play` never uses


def get_init() -> bool:
    """The page opens its sound at the player's first press."""
    return True


init = get_init


def set_num_channels(count: int) -> None:
    _Mixer.channels = tuple(object.__new__(Channel) for _ in range(count))
    for number, channel in enumerate(_Mixer.channels):
        channel.number, channel.sound, channel.endless = number, None, False


def set_reserved(count: int) -> None:
    _Mixer.reserved = count


def stop() -> None:
    for channel in _Mixer.channels:
        if channel.sound:
            channel.stop()


class Sound:
    """A sound of a file. Raises OSError, pygame's error."""

    def __init__(self, path: Any) -> None:
        self.number = LINK.page.sound(fspath(path))
        if self.number < 0:
            raise error(f"{path} is not a sound")

    def get_length(self) -> float:
        """Seconds; 0 until the page can play it."""
        return float(LINK.page.sounds.length(self.number))

    def play(self) -> Channel | None:
        """Play it once on a free channel, and give that channel."""
        free = next((channel for channel in _Mixer.channels[_Mixer.reserved :] if not channel.get_busy()), None)
        if free is not None:
            free.play(self)
        return free


class Channel:
    """``Channel(number)`` plays one sound at a time."""

    number: int
    sound: Sound | None
    endless: bool

    def __new__(cls, number: int) -> Channel:
        return _Mixer.channels[number]

    def play(self, sound: Sound, loops: int = 0, fade_ms: int = 0) -> None:
        self.sound, self.endless = sound, loops < 0
        LINK.page.sounds.play(self.number, sound.number, loops, fade_ms)

    def fadeout(self, ms: int) -> None:
        self.sound = None
        LINK.page.sounds.stop(self.number, ms)

    def stop(self) -> None:
        self.fadeout(0)

    def get_busy(self) -> bool:
        return self.sound is not None and (self.endless or bool(LINK.page.sounds.busy(self.number)))

    def set_volume(self, left: float, right: float | None = None) -> None:
        LINK.page.sounds.volume(self.number, left, left if right is None else right)
