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
    "rings": ("Rings", "Clock", "Moat", "Onion"),
    "bowl": ("Bowl", "Organ", "Stalactites", "Basin"),
    "wheel": ("Wheel", "Planetarium", "Dial", "Satellites"),
    "shafts": ("Shafts", "Chimneys", "Wells", "Lifts"),
    "pyramid": ("Pyramid", "Tomb", "Tent", "Summit"),
    "hourglass": ("Hourglass", "Funnel", "Neck", "Bottle"),
    "star": ("Star", "Compass", "Crossing", "Windmill"),
    "tower": ("Tower", "Keep", "Lighthouse", "Silo"),
    "galleries": ("Galleries", "Caves", "Storeys", "Mines"),
    "comb": ("Comb", "Teeth", "Jaws", "Colonnade"),
    "eights": ("Spectacles", "Lungs", "Barbell", "Twins"),
    "diamonds": ("Diamonds", "Flock", "Stepping Stones", "Constellation"),
    "chambers": ("Chambers", "Butterfly", "Rooms", "Clover"),
    "hive": ("Hive", "Honeycomb", "Nest", "Cells"),
    "castle": ("Castle", "Gate", "Skyline", "Bridge"),
}
"""Names of places for each ground plan."""


def name_for(layout: str, rng: Random) -> str:
    """A name for a level of a ground plan."""
    return f"{rng.choice(MOODS)} {rng.choice(PLACES[layout])}"
