"""Digests of generated levels: a changed one means that seeds make other levels than before."""

from __future__ import annotations

from hashlib import sha256
from pathlib import Path

from ninja_game.formats.ascii.writer import headers_of, write_ascii_level
from ninja_game.generator.generate import Effort, generate

TABLE = Path(__file__).parent.parent / "golden" / "generated.tsv"
SEEDS = ((1, 2), (2, 5), (3, 9))
"""Seed and difficulty of the levels."""

SMALL = Effort(find=1_500_000, shorten=300_000, attempts=6, rounds=8, tries=64)
"""Enough work to certify most levels, little enough for tests."""


def generated_digest(seed: int, wanted: int) -> str:
    """The digest of the text of a level from a small budget."""
    made = generate(seed, wanted, effort=SMALL)
    if made is None:
        return "none"
    return sha256(write_ascii_level(made.named.level, **headers_of(made.named)).encode()).hexdigest()


def read_generated() -> dict[tuple[int, int], str]:
    """The table: digests by seed and difficulty."""
    rows = (line.split("\t") for line in TABLE.read_text("utf-8").splitlines())
    return {(int(seed), int(wanted)): digest for seed, wanted, digest in rows}


def write_generated() -> None:
    """Write the table again."""
    rows = (f"{seed}\t{wanted}\t{generated_digest(seed, wanted)}\n" for seed, wanted in SEEDS)
    TABLE.write_text("".join(rows), "utf-8")
