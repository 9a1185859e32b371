"""Names of levels: a word for the mood, a word for the ground plan."""

from __future__ import annotations

from random import Random

AUTHOR = "ninja-game generate"
"""Who made the levels."""

MOODS = (
    "Quiet", "Copper", "Hollow", "Crooked", "Sleepless", "Paper", "Salt", "Borrowed", "Northern", "Patient", "Velvet",
    "Rusty", "Second", "Hidden", "Restless", "Lunar", "Brittle", "Tidal", "Sunken", "Amber", "Narrow", "Distant",
    "Folded", "Idle", "Wired", "Granite", "Silent", "Spare", "Winter", "Lost", "Painted", "Minor",
)  # fmt: skip
PLACES = {
    "heart": ("Heart", "Locket", "Shield", "Core"),
    "cascade": ("Cascade", "Basins", "Ladles", "Cradle"),
    "web": ("Web", "Rings", "Moat", "Onion"),
    "cathedral": ("Cathedral", "Choir", "Crypt", "Nave"),
    "islands": ("Islands", "Flock", "Lagoon", "Harbour"),
    "mask": ("Mask", "Clown", "Idol", "Grin"),
    "pyramid": ("Pyramid", "Tomb", "Tent", "Summit"),
    "hive": ("Hive", "Honeycomb", "Nest", "Clover"),
    "volcano": ("Volcano", "Crater", "Mountain", "Chimney"),
    "eye": ("Eye", "Iris", "Lens", "Almond"),
    "umbrellas": ("Umbrellas", "Mushrooms", "Orchard", "Grove"),
    "hourglass": ("Hourglass", "Funnel", "Neck", "Bottle"),
    "waves": ("Waves", "Tide", "Caves", "River"),
    "skull": ("Skull", "Jaws", "Captain", "Thinker"),
    "wheel": ("Wheel", "Clock", "Dial", "Windmill"),
}
"""Names of places for each ground plan."""


def name_for(layout: str, rng: Random) -> str:
    """A name for a level of a ground plan."""
    return f"{rng.choice(MOODS)} {rng.choice(PLACES[layout])}"
