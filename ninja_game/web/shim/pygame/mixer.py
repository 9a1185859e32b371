"""Sound: channels that JavaScript plays."""

from __future__ import annotations

from os import fspath
from typing import Any

from .host import LINK


class _Mixer:
    """``channels``: all of them; the first ``reserved`` are never chosen by ``Sound.play``."""

    channels: list[Channel]
    reserved = 0


_MIXER = _Mixer()
_MIXER.channels = []


def init(frequency: int = 0, size: int = 0, channels: int = 0, buffer: int = 0) -> None:
    """The page opens its sound at the player's first press."""


def get_init() -> bool:
    """Always ready."""
    return True


def set_num_channels(count: int) -> None:
    """How many sounds play at once."""
    _MIXER.channels = [_channel(number) for number in range(count)]


def set_reserved(count: int) -> None:
    """Keep the first channels for those who ask for them by number."""
    _MIXER.reserved = count


def stop() -> None:
    """End all sounds."""
    for channel in _MIXER.channels:
        if channel.sound:
            channel.stop()


class Sound:
    """A sound of a file. Raises FileNotFoundError, pygame's error."""

    def __init__(self, path: Any) -> None:
        self.number = LINK.page.sound(fspath(path))

    def play(self) -> Channel | None:
        """Play it once on a free channel, which this gives."""
        for channel in _MIXER.channels[_MIXER.reserved :]:
            if not channel.get_busy():
                channel.play(self)
                return channel
        return None


class Channel:
    """``Channel(number)``: what plays one sound at a time."""

    number: int
    sound: Sound | None
    endless: bool

    def __new__(cls, number: int) -> Channel:
        """One of the mixer's."""
        return _MIXER.channels[number]

    def play(self, sound: Sound, loops: int = 0, fade_ms: int = 0) -> None:
        """Play a sound, ``loops`` times more; -1: without end."""
        self.sound, self.endless = sound, loops < 0
        LINK.page.play(self.number, sound.number, loops, fade_ms)

    def stop(self) -> None:
        """End it."""
        self.fadeout(0)

    def fadeout(self, ms: int) -> None:
        """End it softly."""
        self.sound = None
        LINK.page.stop(self.number, ms)

    def get_busy(self) -> bool:
        """Whether it plays."""
        return self.sound is not None and (self.endless or bool(LINK.page.busy(self.number)))

    def get_sound(self) -> Sound | None:
        """What it plays."""
        return self.sound

    def set_volume(self, left: float, right: float | None = None) -> None:
        """How loud, 0 to 1, on both sides."""
        LINK.page.volume(self.number, left, left if right is None else right)


def _channel(number: int) -> Channel:
    channel = object.__new__(Channel)
    channel.number, channel.sound, channel.endless = number, None, False
    return channel
