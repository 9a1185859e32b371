"""Ground plans: pictures over the whole screen, with a vault whose only way in can be locked; and their names.

They are painted in cells: columns 1 to 32, rows 1 to 24, the middle at ``MID``.
"""

from __future__ import annotations

from collections.abc import Callable
from random import Random

from ninja_game.generator.scene import RockBoard, box, disc, dish, path, polygon
from ninja_game.generator.shaping import Ink

Layout = Callable[[RockBoard, Random], None]

MID = 16.5


def dome(x: float, y: float, half_width: float, height: float) -> Ink:
    """A roof with a flat underside; ``half_width``: half its width, ``height``: its height."""
    return disc(x, round(y), half_width, height) & box(1, 1, 32, round(y))


def heart(board: RockBoard, rng: Random) -> None:
    board.dig(disc(9.6, 8.3, 7.9, 7.1), polygon((2.6, 11), (MID, 24.2), (30.4, 11), (MID, 6)))
    board.rock(box(1, 22, 32, 24), disc(12.7, 10.5, 4.5, 3.8), polygon((8.5, 12), (MID, 19.3), (24.5, 12), (MID, 9.5)))
    board.dig(disc(12.9, 10.7, 3.1, 2.4), box(11.5, 10.5, 21.5, 14))
    board.dig_vault(12, 20, 13, gate=21)
    board.rock(dish(5.5, rng.choice((7, 8)), 2, 1.4))
    board.danger_places = [(10, 4.4)]


def mask(board: RockBoard, rng: Random) -> None:
    """A face: eyes with something in them, a mouth full of gold."""
    brow = rng.choice((-1.0, 0.0, 1.0))
    board.dig(disc(MID, 11.5, 15, 9.6), polygon((4.5, 15), (10, 23.5), (23, 23.5), (28.5, 15)))
    board.rock(path(1.3, (7, 5.5 - brow), (12.4, 5.5 + brow)))
    board.rock(disc(9.7, 11, 3.9, 2.9))
    board.dig(disc(9.7, 11, 2.7, 1.8), box(9, 12, 11, 15))
    board.rock(polygon((MID, 8), (14.4, 14), (18.6, 14)))
    board.rock(path(5, (12, 18.5), (21, 18.5)))
    board.dig_vault(11, 21, 19, gate=20)
    board.danger_places = [(9.5, 11.0)]


def web(board: RockBoard, rng: Random) -> None:
    """A ring in a ring, their gates turned against each other."""
    board.dig(disc(MID, 12.5, 15.2, 11.2) & box(1, 1, 32, 23))
    half_width, half_height = rng.choice(((10.6, 7.7), (11.2, 7.4)))
    board.rock(disc(MID, 12.5, half_width, half_height) & ~disc(MID, 12.5, half_width - 1.5, half_height - 1.3))
    board.rock(disc(MID, 12.5, 5.8, 4.0))
    board.dig(disc(MID, 11.6, 4.1, 2.2))
    board.dig_vault(14, 18, 13, gate=19)
    first = rng.random() < 0.5
    board.dig(box(14.5, 3.5, 18.5, 7) if first else polygon((4, 5), (9, 4), (13, 9), (9, 11)))
    board.dig(box(13, 18, 20, 21.4))
    board.danger_places = [(MID, 20.5)]
    if rng.random() < 0.6:
        board.rock(path(1.4, (6.4, 12.5), (11, 12.5)) if first else path(1.4, (MID, 5), (MID, 9)))


def islands(board: RockBoard, rng: Random) -> None:
    """Islands about a crescent, over a mined ground."""
    board.dig(box(2, 2, 31, 22))
    for x in (1.5, 6.5, 11.5, 16.5):
        board.rock(disc(x, 22.8, 2.4, 1.9))
    board.rock(disc(MID, 12.2, 5.4, 4.8))
    board.dig(disc(MID, 11, 3.8, 2.2))
    board.dig_vault(14, 18, 12, gate=18)
    sea = rng.choice(((3.0, 9), (3.5, 7)))
    for x, y in ((sea[0], sea[1]), (6.6, 14), (9.3, rng.choice((5.5, 7))), (9.5, 18.5)):
        half_width = rng.uniform(2.0, 2.7)
        board.rock(dish(x, y, half_width, 1.9), dome(x, y + 0.1, half_width, rng.choice((0.1, 0.1, 1.0))))


def cathedral(board: RockBoard, rng: Random) -> None:
    """A nave with pillars under a steep roof, the treasure under its altar."""
    top = rng.choice((1.5, 2.5))
    board.dig(polygon((2, 24), (2, 8.5), (6, 5.5), (10, 5.5), (MID, top), (23, 5.5), (27, 5.5), (31, 8.5), (31, 24)))
    board.rock(box(1, 23, 32, 24))
    low = rng.choice((0, 1, 2))
    board.rock(
        polygon((7, 7 + low), (9, 9 + low), (9, 14), (8, 16), (8, 18), (7, 20), (6, 18), (6, 16), (5, 14), (5, 9 + low))
    )
    board.rock(polygon((8, 23), (11, 17), (22, 17), (25, 23)))
    board.rock(polygon((12, 17), (11, 15), (11, 13), (13, 11), (15, 13), (15, 15), (14, 17)))
    board.dig(polygon((11, 23), (13, 19), (20, 19), (22, 23)))
    board.dig_vault(11, 21, 22, gate=21)
    board.rock(
        disc(MID, 7, 2.6, 2.6) & ~disc(MID, 7, 1.5, 1.5) & ~box(15, 8, 18, 11)
        if rng.random() < 0.5
        else polygon((MID, 5), (14.6, 7.5), (MID, 10), (18.4, 7.5))
    )


def pyramid(board: RockBoard, rng: Random) -> None:
    """A hollow pyramid, its chamber under a shaft, stars over it."""
    apex = rng.choice((6.0, 7.0))
    board.dig(polygon((2, 24), (2, 9), (6, 2), (27, 2), (31, 9), (31, 24)))
    board.rock(box(1, 23, 32, 24), polygon((MID, apex), (5, 24), (28, 24)))
    board.dig(polygon((MID, apex + 4), (8.2, 23), (24.8, 23)), box(15, 5, 18, 12))
    board.rock(box(8, 17, 25, 19))
    board.rock(polygon((MID, 19.5), (13.4, 24), (19.6, 24)))
    board.dig_vault(11, 21, 22, gate=23)
    board.rock(polygon((5, 9.4), (7.4, 9.4), (6.2, 11)), dish(rng.choice((11, 12)), 5.5, 1.6, 1.1))
    board.rock(dish(3.6, 17, 1.4, 1.2))
    board.danger_places = [(MID, 14.5)]


def hive(board: RockBoard, rng: Random) -> None:
    """Round chambers with doorways between them, about a great one with a core."""
    board.dig(*(disc(x, y, 3.5, 3.3) for x, y in ((5.5, 6.2), (12.7, 5.2), (4.9, 12.5), (5.5, 18.8), (12.7, 19.8))))
    board.dig(path(2.2, (5.5, 6), (12.7, 5.2), (MID, 5.2)), path(2.2, (5.5, 6), (4.8, 12), (5.5, 18.8), (12.7, 20.2)))
    board.dig(disc(MID, 12.5, 7.6, 5.3))
    board.dig(path(2.4, *(((12.7, 19), (12.7, 14)) if rng.random() < 0.5 else ((12.7, 5), (12.7, 11)))))
    board.rock(box(1, 22, 32, 24), disc(MID, 12.5, 4.5, 3.2))
    board.dig(disc(MID, 12, 3, 1.8))
    board.dig_vault(14, 18, 13, gate=18)
    board.rock(disc(5, rng.choice((12, 13)), 1.2, 1.2))
    board.danger_places = rng.sample([(5.5, 18.5), (12.5, 19.5), (12.5, 5.5)], 2)
    board.rock(dish(5.5, 7.4, 1.6, 1.0), box(15.8, 18, 17.2, 23))


def cascade(board: RockBoard, rng: Random) -> None:
    """Bowls, each lower than the one before, over the way back; not mirrored."""
    board.even = False
    board.dig(polygon((2, 23), (2, 2.5), (15, 2.5), (20, 5), (26, 7), (31, 11), (31, 23)))
    drop = rng.choice((1.6, 2.2))
    for k, x in enumerate((8.4, 16.2, 24.2)):
        y = 6.2 + drop * k
        board.rock(disc(x, y, 3.9, 4) & box(1, y, 32, 24) & ~disc(x, y - 0.6, 2.6, 2.8))
        board.danger_places.append((x, y - 0.5))
    board.rock(polygon((1, 11.5), (5, 12.6), (9, 14.6), (18, 17), (18, 19), (1, 19)), box(10, 19, 12, 24))
    board.rock(box(1, 6, 4, 12), dome(20.5, 23.2, 3, 1.7), dome(27.5, 23.2, 2, 1.2))
    board.dig_vault(3, 9, 22, gate=10)


def umbrellas(board: RockBoard, rng: Random) -> None:
    """Trees with round crowns, a den at the foot of the greatest."""
    board.dig(box(2, 2, 31, 23), disc(MID, 4, 10, 2.6))
    board.rock(dome(MID, 10, 6.6, 4.6), box(15, 10, 18, 19))
    x, y = rng.choice((6.5, 7.5)), rng.choice((13.0, 14.0))
    board.rock(dome(x, y, 2.9, 2.4), box(x - 0.5, y - 1, x + 0.5, 23.2) if rng.random() < 0.5 else dish(x, y, 1, 1.2))
    board.rock(dome(11.4, 19.4, 1.8, 1.4), dome(4, 23.2, 2.2, 1.2), dome(x - 1, 6.6, 2, 1.3))
    board.rock(dome(MID, 23.2, 6.4, 5.4))
    board.dig(dome(MID, 23, 5, 3.6))
    board.dig_vault(13, 19, 22, gate=20)


def skull(board: RockBoard, rng: Random) -> None:
    """A skull: great eyes, teeth, and a vault behind its forehead."""
    board.dig(disc(MID, 10.5, 15, 8.8), polygon((7, 16), (9, 23.4), (24, 23.4), (26, 16)))
    size = rng.choice((2.4, 2.8))
    board.rock(disc(9, 12, size + 0.7, size), polygon((MID, 12.4), (14.8, 16), (18.2, 16)), box(1, 23, 32, 24))
    board.rock(disc(MID, 7.2, 5.6, 3.4))
    board.dig(dome(MID, 8, 4.2, 2.4))
    board.dig_vault(13, 19, 8, gate=19)
    for k in range(2):
        board.rock(polygon((9.8 + 3.6 * k, 24), (10.1 + 3.6 * k, 20.2), (11.7 + 3.6 * k, 20.2), (12 + 3.6 * k, 24)))
    board.rock(path(1.3, (6.4, 17.2), (10.4, 17.4)))


def hourglass(board: RockBoard, rng: Random) -> None:
    """Two wide chambers and the neck between them; the sand covers a vault."""
    waist = rng.choice((10.5, 11.5))
    board.dig(box(2, 2, 31, 23))
    board.rock(disc(2, waist, 12.2, 6.0), box(1, waist - 2, 6, waist + 2))
    board.dig(path(2.4, (4, 5), (5, waist), (4, 19)))
    board.rock(polygon((MID, 15.4), (14.5, 17), (9.5, 24), (23.5, 24), (18.5, 17)))
    board.dig(polygon((MID, 18), (11.8, 23), (21.2, 23)))
    board.dig_vault(12, 20, 22, gate=21)
    board.rock(dish(MID, rng.choice((5, 6)), 2.2, 1.6), dish(8, 4.2, 1.7, 1.1))
    board.rock(dish(5.5, 20, 1.8, 1.2))


def wheel(board: RockBoard, rng: Random) -> None:
    """Spokes about a hub, in a round hall."""
    board.dig(disc(MID, 12.5, 15, 11) & box(1, 1, 32, 22))
    board.rock(disc(MID, 12.5, 5.2, 4.4))
    board.dig(disc(MID, 11.8, 3.6, 2.6))
    board.dig_vault(14, 18, 13, gate=18)
    near, far = rng.choice(((0.6, 0.8), (0.56, 0.76)))
    wide = rng.random() < 0.5
    spokes = (
        ((0, 11), (10.6, 7.8), (15, 0), (10.6, -7.8))
        if wide
        else ((5.8, 10.2), (13.8, 4.2), (13.8, -4.2), (5.8, -10.2))
    )
    for x, y in spokes:
        board.rock(path(1.7, (MID - near * x, 12.5 - near * y), (MID - far * x, 12.5 - far * y)))
    board.danger_places = [(MID, 19.5), (12, 5) if wide else (8.5, 6.5)]


def volcano(board: RockBoard, rng: Random) -> None:
    """A mountain with a shaft in it, clouds of rock on both sides."""
    board.dig(box(2, 2, 31, 23))
    board.rock(polygon((7, 24), (10, 18), (12, 11), (13, 8), (20, 8), (21, 11), (23, 18), (26, 24)))
    board.dig(polygon((14.8, 6), (18.2, 6), (17.8, 16), (15.2, 16)))
    board.dig(disc(MID, 15.4, 2.8, 1.8), disc(MID, 21, 5.4, 2.6))
    board.rock(box(9, 23, 24, 24), box(10, 17, 23, 19))
    board.dig(path(2.2, (14, 15.8), (9, rng.choice((13.6, 14.8)))))
    board.dig_vault(12, 20, 22, gate=22)
    board.rock(dish(rng.choice((5, 6)), 6, 2.6, 1.4), dish(10.6, rng.choice((4, 5)), 1.6, 1.1), dish(3.4, 12, 2, 1.5))
    board.rock(dish(7.2, 12.6, 1.5, 1.2))
    board.danger_places = [(MID, 15.5)]


def rock_eye(board: RockBoard, rng: Random) -> None:
    """An eye: the iris a ring of rock, the vault in the pupil, lashes over it."""
    board.dig(disc(MID, 19, 17.5, 16) & disc(MID, 5.5, 17.5, 16.5))
    board.rock(disc(MID, 12.2, 7.8, 6.6) & ~disc(MID, 12.2, 6.5, 5.4))
    board.dig(box(14, 16, 19, 19.6), box(8, 11, 11, 14) if rng.random() < 0.5 else box(15, 5, 18, 8))
    board.rock(disc(MID, 12, 4.8, 3.3))
    board.dig(dome(MID, 13, 3.4, 2.8))
    board.dig_vault(14, 18, 12, gate=19)
    board.danger_places = [(MID, 18.5)]
    board.rock(polygon((4.4, 12.3), (7, 11.3), (7, 13.3)), dish(10, 19, 1.7, 1.1))


def waves(board: RockBoard, rng: Random) -> None:
    """Three long waves over each other, holes between them."""
    board.even = False
    for number, y in enumerate((5.2, 12.4, 19.6)):
        turn = 1.3 if number % 2 else -1.3
        crest = [(3.6 + 2.15 * k, y + turn * (0, 0.7, 1, 0.7, 0, -0.7, -1, -0.7)[k % 8]) for k in range(13)]
        board.dig(path(rng.uniform(4.4, 5.0), *crest))
        board.rock(*(disc(x, y + 0.4, 1.6, 0.9) for x in rng.sample((9, 13, 18, 23), 2)))
    board.dig(path(2.6, (28, 6), (28, 11)), path(2.6, (27, 13), (27, 19)))
    board.dig(path(2.6, (rng.choice((12, 14)), 12), (15, 20)) if rng.random() < 0.5 else path(2.6, (15, 6), (14, 13)))
    board.danger_places = [(27.5, 12.5), (rng.choice((5.5, 27.5)), 5.5)]
    board.rock(box(1, 16, 12, 24))
    board.dig(box(3, 18, 10, 21))
    board.dig_vault(3, 9, 20, gate=10)


LAYOUTS: dict[str, Layout] = {
    "heart": heart, "cascade": cascade, "web": web, "cathedral": cathedral, "islands": islands, "mask": mask,
    "pyramid": pyramid, "hive": hive, "volcano": volcano, "eye": rock_eye, "umbrellas": umbrellas,
    "hourglass": hourglass, "waves": waves, "skull": skull, "wheel": wheel,
}  # fmt: skip
"""The ground plans by name."""

_MOODS = (
    "Quiet", "Copper", "Hollow", "Crooked", "Sleepless", "Paper", "Salt", "Borrowed", "Northern", "Patient", "Velvet",
    "Rusty", "Second", "Hidden", "Restless", "Lunar", "Brittle", "Tidal", "Sunken", "Amber", "Narrow", "Distant",
    "Folded", "Idle", "Wired", "Granite", "Silent", "Spare", "Winter", "Lost", "Painted", "Minor",
)  # fmt: skip
PLACE_NAMES = {
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
    return f"{rng.choice(_MOODS)} {rng.choice(PLACE_NAMES[layout])}"
