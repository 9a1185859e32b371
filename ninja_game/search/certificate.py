"""Make a replay of inputs that a search found: smooth them if wanted, play them on the plain memory from tick 0."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import cache
from itertools import groupby
from pathlib import Path

from ninja_game.budget import NO_LIMIT
from ninja_game.errors import ArgumentError, NinjaGameError
from ninja_game.files.reading import read_text
from ninja_game.files.tree import Tree
from ninja_game.files.writing import write_atomically
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.pack import certificate_name
from ninja_game.formats.recording import Recording, parse_replays
from ninja_game.formats.replay.notations import Marker
from ninja_game.formats.replay.text import Replay, write_replay
from ninja_game.runs.deaths import ending_text
from ninja_game.runs.run import record_replay, run_level
from ninja_game.sim.digest import state_digest
from ninja_game.sim.inputs import JUMP_HELD, KEYS_DOWN, with_press_bit, with_press_bits
from ninja_game.sim.level import Body, Level


class UnverifiedRunError(NinjaGameError):
    """A run that the plain memory does not confirm."""


def verified_run(level: Level, inputs: bytes, *, body: Body = "circle", gold: int = 0) -> Replay:
    """Play inputs from the start on the plain memory: gives a replay up to the tick of the exit contact.

    Raises UnverifiedRunError if they do not reach the exit with as much ``gold``.
    """
    if not inputs:
        raise UnverifiedRunError("a run without inputs does not reach the exit")
    run = record_replay(level, inputs, body=body, budget=NO_LIMIT)
    if run.outcome != "exit":
        raise UnverifiedRunError(f"the run does not reach the exit: {ending_text(run.outcome, run.ticks - 1)}")
    if run.gold < gold:
        raise UnverifiedRunError(f"the run collects {run.gold} pieces of gold, {gold} were asked for")
    return run


def with_plain_triggers(level: Level, inputs: bytes, *, body: Body = "circle", gold: int = 0) -> bytes:
    """Set triggers exactly where the jump key goes down, as searches keep them; the run ends at the exit.

    Raises UnverifiedRunError if the run does not reach the exit, or only with triggers that no keyboard makes.
    """
    try:
        return verified_run(level, with_press_bits(inputs), body=body, gold=gold).inputs
    except UnverifiedRunError:
        verified_run(level, inputs, body=body, gold=gold)
        raise UnverifiedRunError("the run triggers jumps without a fresh press, as no keyboard does") from None


def named_replay(run: Replay, command: str, *, name: str = "", author: str = "", level_author: str = "") -> Replay:
    """Name a run that a command found, and its level. The author of a run that a person played stays."""
    made, author = (run.made, run.author) if run.made.played else (run.made.searched(command), author)
    return replace(run, name=name, author=author, level_name=name, level_author=level_author, made=made)


_AUTHOR = "ninja-game check"


def read_certificate(
    level: NamedLevel, path: Path, *, body: Body = "circle", gold: int = 0
) -> tuple[Replay, bool] | None:
    """The run of a replay if it still passes a level with the gold wanted, and whether it was made on this level.

    None if the file is missing, or its run does not pass the level. Raises NinjaGameError for any other file.
    """
    if not path.exists():
        return None
    kept = parse_replays(read_text(path), file=str(path), level=level.level)[0]
    same = level_digest(kept.level) == level_digest(level.level) and kept.body == body
    try:
        run = verified_run(level.level, kept.inputs, body=body, gold=gold)
    except UnverifiedRunError:
        return None
    return replace(run, author=kept.player, made=kept.replay.made), same


def update_certificates(level: NamedLevel, run: Replay) -> None:
    """Make a run of a level file its certificate, for each goal for which it beats the present certificate.

    Raises NinjaGameError for a certificate that cannot be read, and OSError.
    """
    for kind, gold in (("exit", 0), ("gold", level.level.gold)):
        if run.gold < gold:
            continue
        path = Path(level.file).parent / certificate_name(Path(level.file).name, kind)
        kept, of_this_level = read_certificate(level, path, gold=gold) or (None, False)
        if not (kept and of_this_level and kept.end_tick <= run.end_tick):
            write_certificate(level, path, run)


def write_certificate(level: NamedLevel, path: Path, run: Replay) -> None:
    replay = named_replay(run, "check", name=level.name, author=_AUTHOR, level_author=level.author)
    Tree(path.parent).write(path.name, write_replay(replay))


def improved_replay(run: Replay, recording: Recording, command: str) -> Replay:
    """A run that a command made from a recording: names and authors stay, its origin is added."""
    old = recording.replay
    return replace(
        run,
        name=recording.name,
        author=recording.player,
        co_authors=old.co_authors,
        level_name=old.level_name or recording.name,
        level_author=recording.level_author,
        made=old.made.searched(command, begun_by=recording.begun_by),
        markers=moved_markers(recording, run.inputs),
    )


def moved_markers(recording: Recording, inputs: bytes) -> tuple[Marker, ...]:
    """Move the markers of a run to one made from it: to the tick with the ninja at the same place, else as late."""
    old, body = recording.replay.markers, recording.body
    if not old:
        return ()
    from ninja_game.runs.compare import aligned  # pages do not have this module

    runs = [run_level(recording.level, keys, body=body).positions for keys in (recording.inputs, inputs)]
    partners = [-1] * len(runs[0])
    with suppress(ArgumentError):
        partners = aligned(*runs).tolist()
    moved = []
    for tick, name in old:
        place = partners[tick] if tick < len(partners) else -1
        same = inputs[:tick] == recording.inputs[:tick] or place < 0
        moved.append(Marker(min(tick if same else place, len(inputs)), name))
    return tuple(sorted(moved))


def save_replay(path: Path, replay: Replay) -> None:
    """Write a replay, completely or not at all. Raises OSError."""
    write_atomically(path, write_replay(replay))


MAX_SIMPLIFIED_TICKS = 4000  # longer runs keep all their keys: a tick takes some 0.5 ms
_CHOICES = (*range(8), *range(12, 16))  # the inputs that a keyboard can make in one tick


def without_idle_keys(
    level: Level, inputs: bytes, original: bytes, *, body: Body = "circle", first: int = 0, last: int | None = None
) -> bytes:
    """Remove keys that do nothing from a run: every tick's state stays the same.

    - ``original``: the run that ``inputs`` was made from. As long as both have the same states, a tick gets its keys
      where they lead there too; after that, the keys change as seldom as possible.
    - ``first``, ``last``: only ticks before ``last`` change, from ``first`` on; None: to the end.

    Runs over MAX_SIMPLIFIED_TICKS, and runs with triggers that no keyboard makes, stay as they are.
    """
    import numpy as np  # pages do not have it

    from ninja_game.batch.batch import Batch

    last = len(inputs) if last is None else last
    if len(inputs) > MAX_SIMPLIFIED_TICKS or with_press_bits(inputs) != inputs:
        return inputs
    batch = Batch(level, len(_CHOICES), body=body, threads=1)

    @cache
    def state_of(index: int) -> str:
        world = batch.world(index)
        world.ninja.jump_held = 0  # every tick writes it before reading it
        return state_digest(world)

    batch.run(np.repeat(np.frombuffer(inputs[:first], np.uint8)[:, np.newaxis], len(_CHOICES), 1), stop=True)
    needed = np.array(
        [[_CHOICES.index(with_press_bit(keys, before & JUMP_HELD)) for keys in range(8)] for before in range(8)]
    )
    costs = np.full(8, np.inf)
    costs[inputs[first - 1] & KEYS_DOWN if first else 0] = 0
    came_from, aligned = [], original[:first] == inputs[:first]
    for tick in range(first, last):
        present = _CHOICES.index(inputs[tick])
        batch.run(np.array([_CHOICES], np.uint8), stop=True)
        same = (batch.positions == batch.positions[present]).all(1) & (batch.previous == batch.previous[present]).all(1)
        for index in np.flatnonzero(same).tolist():
            same[index] = index == present or state_of(index) == state_of(present)
        original_keys = original[tick] if tick < len(original) else -1
        aligned = aligned and original_keys in _CHOICES and bool(same[_CHOICES.index(original_keys)])
        other = (np.arange(8) != (original_keys & KEYS_DOWN)) * (100 if aligned else 1) * (original_keys >= 0)
        steps = costs[:, np.newaxis] + 4 * (1 - np.eye(8)) + other + np.where(same[needed], 0, np.inf)
        came_from.append(steps.argmin(0))
        costs = steps.min(0)
        state_of.cache_clear()
        batch.copy([present] * len(_CHOICES), range(len(_CHOICES)))
    if last < len(inputs):  # the next tick must trigger as before
        costs += [0 if with_press_bit(inputs[last], keys & JUMP_HELD) == inputs[last] else np.inf for keys in range(8)]
    made = [int(costs.argmin())]
    for before in reversed(came_from):
        made.append(int(before[made[-1]]))
    return with_press_bits(inputs[:first] + bytes(made[-2::-1]) + inputs[last:])


Hold = tuple[int, int]  # keys that are down, and for how many ticks


def rows_of(inputs: bytes) -> list[Hold]:
    """Group inputs into rows of equal keys; triggers follow from them."""
    return [(keys, len(list(ticks))) for keys, ticks in groupby(keys & KEYS_DOWN for keys in inputs)]


def inputs_of_holds(rows: list[Hold]) -> bytes:
    """Turn rows of keys into inputs, with triggers where the jump key goes down."""
    return with_press_bits([keys for keys, ticks in rows for _ in range(ticks)])


def smooth_run(level: Level, inputs: bytes, *, body: Body = "circle", gold: int = 0, price: int = 0) -> bytes:
    """A run to the exit with fewer key changes, at most ``price`` ticks longer than ``inputs``.

    Short rows of keys are merged into their neighbours, the shortest first, as long as the run still reaches the exit.
    """
    limit = len(inputs) + price
    rows = rows_of(inputs)
    longest = 1
    while longest <= 24:
        merged = _without_one(rows, longest, level, body, gold, limit)
        if merged is None:
            longest += 1
        else:
            rows = merged
    run = run_level(level, inputs_of_holds(rows).ljust(limit, b"\0"), body=body)
    return inputs_of_holds(rows).ljust(limit, b"\0")[: run.ticks]


def _without_one(rows: list[Hold], longest: int, level: Level, body: Body, gold: int, limit: int) -> list[Hold] | None:
    """Merge one row of at most ``longest`` ticks into a neighbour; None if no such run passes."""
    for index, (_, ticks) in enumerate(rows):
        if ticks > longest:
            continue
        for neighbour in (index - 1, index + 1):
            if not 0 <= neighbour < len(rows):
                continue
            keys = rows[neighbour][0]
            changed = rows_of(inputs_of_holds([*rows[:index], (keys, ticks), *rows[index + 1 :]]))
            run = run_level(level, inputs_of_holds(changed).ljust(limit, b"\0")[:limit], body=body)
            if run.outcome == "exit" and run.gold >= gold:
                return rows_of(inputs_of_holds(changed)[: run.ticks])
    return None
