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
    "terraces": ("Terraces", "Stands", "Arena", "Quarry"),
    "pillars": ("Pillars", "Organ", "Stalactites", "Colonnade"),
    "islands": ("Islands", "Flock", "Shallows", "Stepping Stones"),
    "ring": ("Ring", "Crater", "Clock", "Moat"),
    "storeys": ("Storeys", "Arcade", "Warehouse", "Shelves"),
    "temple": ("Temple", "Portico", "Shrine", "Assembly"),
    "cross": ("Crossing", "Windmill", "Junction", "Compass"),
    "orbits": ("Orbits", "Planetarium", "Dial", "Satellites"),
    "funnel": ("Funnel", "Gorge", "Bowl", "Well"),
    "arches": ("Arches", "Gates", "Viaduct", "Stables"),
    "valley": ("Valley", "Hills", "Cavern", "Skyline"),
    "chevrons": ("Chevrons", "Fir Tree", "Rafters", "Feathers"),
    "rooms": ("Rooms", "Mansion", "Office", "Apartments"),
}
"""Names of places for each ground plan."""


def name_for(layout: str, rng: Random) -> str:
    """A name for a level of a ground plan."""
    return f"{rng.choice(MOODS)} {rng.choice(PLACES[layout])}"
