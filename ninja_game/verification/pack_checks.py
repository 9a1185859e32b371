"""The certificates of a pack: judged, and turned into its table of pars."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from ninja_game.batch.difficulty import TRIES, difficulty
from ninja_game.errors import ReplayError
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.pack.files import PARS
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.pack.pars import Pars, parse_pars
from ninja_game.formats.recording import Recording, parse_replays
from ninja_game.runs.verify import Verdict, verify_recording
from ninja_game.sim.kinds import GOLD
from ninja_game.sim.level import Level

DIGITS = 16
"""How much of a digest the table of pars keeps."""


@dataclass(frozen=True)
class Certificate:
    """A replay that shows what can be done in a level. ``kind``: "exit", or "gold" for one with all gold."""

    place: str
    kind: str
    level: Level
    recording: Recording

    @cached_property
    def verdict(self) -> Verdict:
        """The result. Raises LevelError for a level that cannot be played."""
        return verify_recording(self.recording)

    @property
    def problems(self) -> list[str]:
        """Why it certifies nothing; empty where it does."""
        verdict = self.verdict
        if verdict.level_digest != level_digest(self.level):
            return ["it is a run of another level, or the level was changed after it"]
        problems = list(verdict.problems)
        if verdict.outcome != "exit" and not problems:
            problems.append(f"it does not reach the exit: {verdict.outcome}")
        allowed = verdict.body == "circle" and verdict.possible_by_keyboard and verdict.in_time
        if not allowed or verdict.practice:
            problems.append("a player could not do this: body, keys, lifetime or practice (see `verify --strict`)")
        gold = sum(record.kind == GOLD for record in self.level.objects)
        if self.kind == "gold" and verdict.gold < gold:
            problems.append(f"it takes {verdict.gold} of {gold} pieces of gold")
        return problems


def certificate(pack: Pack, file: str, kind: str) -> Certificate | None:
    """The certificate of a level file, None where there is none.

    Raises ReplayError, or another NinjaGameError, where it cannot be read.
    """
    name = pack.certificate(file, kind)
    if name is None:
        return None
    place = pack.files.place(name)
    recordings = parse_replays(pack.files.text(name), file=place)
    if len(recordings) != 1:
        raise ReplayError("a certificate is one replay", place, found=f"{len(recordings)} recordings")
    return Certificate(place, kind, pack.levels[file].level, recordings[0])


def make_pars(pack: Pack, *, tries: int = TRIES) -> Iterator[tuple[str, Pars]]:
    """The pars of every level file with a sound certificate to the exit, one after another.

    What is in the pack's table and still right is not measured again. ``tries``: as ``difficulty`` has them, 0 for no
    difficulty. Raises what ``certificate`` raises.
    """
    known = parse_pars(pack.files.text(PARS), file=pack.files.place(PARS)) if PARS in pack.files.names else {}
    for file, named in pack.levels.items():
        run, rich = certificate(pack, file, "exit"), certificate(pack, file, "gold")
        if run is None or run.problems:
            continue
        pars = Pars(
            level_digest(named.level)[:DIGITS],
            run.verdict.xy_sha256[:DIGITS],
            run.verdict.end_tick,
            rich.verdict.end_tick if rich and not rich.problems else None,
        )
        before = known.get(file)
        if before and (before.level, before.run) == (pars.level, pars.run) and before.difficulty is not None:
            measured: float | None = before.difficulty
        elif tries == 0:
            measured = None
        else:
            inputs = run.recording.inputs[: run.verdict.ticks]
            measured = round(difficulty(named.level, inputs, tries=tries), 2)
        yield file, Pars(pars.level, pars.run, pars.exit, pars.gold, measured)
