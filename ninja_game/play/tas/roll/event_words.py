"""Short words for states and events, where there is little room."""

from __future__ import annotations

from typing import NamedTuple

from ninja_game.sim.events import EVENT_NAMES

STATES = ("stand", "run", "skid", "jump", "fall", "slide", "dead", "won")
"""In the order of the state numbers."""


class EventWord(NamedTuple):
    """``rank``: the lower, the more important; ``chip``: the palette's role that it lies on; ``ink``: its own."""

    rank: int
    word: str
    chip: str = ""
    ink: str = "outline"


_WORDS = {
    "died": EventWord(0, "died", "bad", "panel"),
    "won": EventWord(0, "exit", "good", "panel"),
    "exit-opened": EventWord(1, "switch", "exit_light"),
    "gold-taken": EventWord(2, "gold", "gold_light"),
    "lock-opened": EventWord(3, "lock", "exit_light"),
    "trap-closed": EventWord(3, "trap", "warning"),
    "door-opened": EventWord(4, "door"),
    "launched": EventWord(5, "pad"),
    "jumped": EventWord(5, "jump"),
    "wall-jumped": EventWord(5, "wall jump"),
    "mine-exploded": EventWord(6, "mine"),
    "landed": EventWord(7, "land"),
    "rocket-launched": EventWord(8, "rocket"),
    "rocket-exploded": EventWord(8, "blast"),
    "turret-fired": EventWord(8, "turret"),
    "laser-on": EventWord(8, "laser"),
    "chaingun-shot": EventWord(8, "shot"),
    "block-woken": EventWord(9, "block"),
    "thwump-fell": EventWord(9, "thwump"),
    "thwump-landed": EventWord(9, "thwump"),
    "guard-started": EventWord(9, "guard"),
    "chase-started": EventWord(9, "chase"),
    "door-closed": EventWord(9, "door shut"),
}
EVENTS = {name: _WORDS.get(name, EventWord(10, name.replace("-", " "))) for name in EVENT_NAMES}
"""By the names of events."""
