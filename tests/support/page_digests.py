"""Digests of runs, for a page and for here alike: Pyodide reads this file too, so it imports only what a page has."""

import json
import struct
from collections.abc import Iterable
from hashlib import sha256
from typing import Any

from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.sim.digest import replay_digest, world_digest
from ninja_game.simulation import Simulation

EVERY = 25  # ticks between two digests of the whole world; the ninja is in the digest after every tick


def digest_of(level: str, body: Any, keys: str) -> str:
    """Sha256 of a run on the plain memory. ``level``: N's string; ``keys``: one byte per tick, in hexadecimal."""
    run = Simulation(parse_level_string(level), body=body, memory="plain")
    seen = sha256()
    for tick, key in enumerate(bytes.fromhex(keys)):
        run.step_keys(key)
        n = run.world.ninja
        seen.update(struct.pack("<4d3i", n.x + 0, n.y + 0, n.prev_x + 0, n.prev_y + 0, n.state, run.world.gold, tick))
        if tick % EVERY == 0:
            seen.update(world_digest(run.world).encode())
    seen.update(world_digest(run.world).encode() + replay_digest(run.world).encode())
    return seen.hexdigest()


def digests(runs: Iterable[tuple[str, str, str, str]]) -> dict[str, str]:
    """By name, the digests of runs: name, level, body, keys."""
    return {name: digest_of(level, body, keys) for name, level, body, keys in runs}


def answer(text: str) -> str:
    """The same from JSON to JSON."""
    return json.dumps(digests(json.loads(text)))
