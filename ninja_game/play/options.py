"""What the player can choose about the picture: presentation only."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass
class Options:
    """Choices about the picture and comfort. The settings screen changes them and calls ``App.apply_options``.

    ``palette``: a name of ``palette.PALETTES``. ``flavour``: the ninja's colour "#rrggbb", "" for the palette's.
    ``smooth``: draw between ticks. ``frame_limit``: pictures per second, 0 for the display's rate. ``overclock``: 0…10
    ms shorter ticks (game.md §1.1).
    """

    palette: str = "classic"
    flavour: str = ""
    smooth: bool = True
    reduced_motion: bool = False
    reduced_gore: bool = False
    show_ghost: bool = True
    show_keys: bool = False
    show_frame_time: bool = False
    fullscreen: bool = False
    frame_limit: int = 0
    overclock: int = 0

    @property
    def tick_ms(self) -> int:
        """Length of a tick in real ms."""
        return 25 - min(10, max(0, self.overclock))
