"""The page's side: what JavaScript does for this module. Without a page (tests, Node) nothing happens."""

from __future__ import annotations

from typing import Any


class NoPage:
    """In the place of host.js where there is none."""

    width, height, rate = 792, 600, 60.0

    def paint(self, address: int, count: int) -> None:
        """Paint a display list of ``count`` doubles."""

    def events(self) -> str:
        """What happened since the last call, as JSON."""
        return "[]"

    def ticks(self) -> float:
        """Milliseconds since the start."""
        from time import monotonic

        return 1000 * monotonic()

    def measure(self, text: str, size: int) -> int:
        """Width of a text in the page's own letters, px."""
        return len(text) * size // 2

    def letters(self, text: str) -> int:
        """A number for a text, for the display list."""
        return 0

    def picture(self) -> str:
        """The picture on the screen, a PNG in base 64."""
        return ""

    def fullscreen(self, wanted: bool) -> None:
        """Fill the display with the page, or no longer."""

    def typing(self, wanted: bool) -> None:
        """Whether keys are to give characters."""

    def copy(self, text: str) -> None:
        """Put a text into the clipboard."""

    def pasted(self) -> str:
        """The text of the clipboard, as far as the page was told."""
        return ""

    def sound(self, path: str) -> int:
        """Read a sound; its number, 0 for one that cannot be read."""
        return 0

    def play(self, channel: int, sound: int, loops: int, fade_ms: int) -> None:
        """Play a sound on a channel."""

    def stop(self, channel: int, fade_ms: int) -> None:
        """End what a channel plays."""

    def volume(self, channel: int, left: float, right: float) -> None:
        """How loud a channel is on both sides, 0 to 1."""

    def busy(self, channel: int) -> bool:
        """Whether a channel still plays."""
        return False


class Link:
    """``page``: the host.js of the page."""

    page: Any = NoPage()


LINK = Link()
