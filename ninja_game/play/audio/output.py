"""What screens ask of sound."""

from __future__ import annotations

from ninja_game.sim.memory.schema import World


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
