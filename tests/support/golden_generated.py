"""Digests of generated levels and of ground plans: a changed one means that seeds make other levels than before."""

from functools import cache
from hashlib import sha256
from pathlib import Path
from random import Random

from ninja_game.formats.ascii.writer import headers_of, write_ascii_level
from ninja_game.generator.compose import compose
from ninja_game.generator.generate import Effort, generate
from ninja_game.generator.layouts import LAYOUTS
from ninja_game.generator.obstacles import hazards_beside
from ninja_game.generator.scene import RockBoard, Scene

TABLE = Path(__file__).parent.parent / "golden" / "generated.tsv"
SEEDS = ((1, 2), (2, 5), (3, 9))  # seed and difficulty of the levels

SMALL = Effort(find=1_500_000, shorten=300_000, attempts=6, rounds=8, tries=64)
"""Enough work to certify most levels, little enough for tests."""


def generated_digest(seed: int, wanted: int) -> str:
    """The digest of the text of a level from a small budget."""
    made = generate(seed, wanted, effort=SMALL)
    if made is None:
        return "none"
    return sha256(write_ascii_level(made.named.level, **headers_of(made.named)).encode()).hexdigest()


@cache
def composed(plan: str, difficulty: int) -> Scene:
    """The first scene of a ground plan that is not thrown away."""
    scenes = (compose(plan, Random(f"{plan}/{difficulty}/{attempt}"), difficulty) for attempt in range(200))
    return next(filter(None, scenes))


def plan_digest(plan: str) -> str:
    """The digest of what eight seeds paint for a ground plan and add along a flight, and of one level."""
    scene = composed(plan, 10)
    digest = sha256(write_ascii_level(scene.level).encode())
    flight = [(60.0 + 6.0 * tick, 300.0 + 2.0 * (tick % 60)) for tick in range(110)]
    for seed in range(8):
        digest.update(repr(hazards_beside(scene, flight, 5, Random(seed))).encode())
        board = RockBoard()
        LAYOUTS[plan](board, Random(seed))
        digest.update(f"{board.ink.tobytes()!r} {board.vault_floor} {board.gate} {board.danger_places}".encode())
    return digest.hexdigest()


def read_generated() -> dict[str, str]:
    """The table: digests by seed and difficulty, or by ground plan."""
    return dict(line.split("\t") for line in TABLE.read_text("utf-8").splitlines())


def write_generated() -> None:
    """Write the table again."""
    digests = {f"{seed} {wanted}": generated_digest(seed, wanted) for seed, wanted in SEEDS}
    digests |= {plan: plan_digest(plan) for plan in LAYOUTS}
    TABLE.write_text("".join(f"{name}\t{digest}\n" for name, digest in digests.items()), "utf-8")
