"""Packs: their certificates, the pars made from them, and findings for the pack's maker."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from pathlib import PurePath

from ninja_game.batch.difficulty import TRIES, difficulty
from ninja_game.errors import NinjaGameError, ReplayError
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN
from ninja_game.formats.pack.pack import CERTIFICATES, INDEX, PARS, Pack, certificate_name
from ninja_game.formats.pack.pars import DIFFICULTY_GRADES, DIGEST_DIGITS, Pars
from ninja_game.formats.recording import Recording, parse_replays
from ninja_game.levels.findings import PackFinding, pack_finding
from ninja_game.runs.level_design import design_findings, measure_design
from ninja_game.runs.problems import level_problems
from ninja_game.runs.verify import Verdict, verify_recording, with_demands
from ninja_game.sim.kinds import GOLD
from ninja_game.sim.level import Level

_cached_verdict = lru_cache(maxsize=1024)(verify_recording)
"""Each of the checks here needs a pack's certificates, and again after each change of the pack."""


@dataclass(frozen=True)
class Certificate:
    """A replay that proves something about a level. ``kind``: "exit", or "gold" for one with all gold."""

    place: str
    kind: str
    level: Level
    recording: Recording

    @cached_property
    def verdict(self) -> Verdict:
        """The result. Raises LevelError for a level that cannot be played."""
        return _cached_verdict(self.recording)

    @property
    def problems(self) -> list[str]:
        """Reasons why the replay certifies nothing; empty if it is a sound certificate."""
        digest = level_digest(self.level)
        verdict = with_demands(self.verdict, {digest: self.place}, only_these=True, strict=True)
        if verdict.level_digest != digest:
            return ["the certificate is of an older version of the level, or of another level"]
        problems = [str(problem) for problem in verdict.problems]
        gold = self.level.gold
        if self.kind == "gold" and verdict.gold < gold:
            problems.append(f"it takes {verdict.gold} of {gold} pieces of gold")
        return problems


def read_pack_certificate(pack: Pack, file: str, kind: str) -> Certificate | None:
    """The certificate of a level file, or None. Raises ReplayError, or another NinjaGameError, if it cannot be read."""
    name = pack.certificate(file, kind)
    if name is None:
        return None
    place = pack.files.place(name)
    recordings = parse_replays(pack.files.text(name), file=place, level=pack.levels[file].level)
    if len(recordings) != 1:
        raise ReplayError("a certificate is one replay", place, found=f"{len(recordings)} recordings")
    return Certificate(place, kind, pack.levels[file].level, recordings[0])


def sound_certificate(pack: Pack, file: str, kind: str) -> Certificate | None:
    """The certificate of a level file if it certifies the level, else None."""
    with suppress(NinjaGameError):
        run = read_pack_certificate(pack, file, kind)
        return run if run and not run.problems else None
    return None


def is_certified(pack: Pack, file: str, kind: str) -> bool:
    return sound_certificate(pack, file, kind) is not None


def has_gold_out_of_reach(level: Level, says: str = "") -> bool:
    """Whether a finding about the level says that a piece can never be touched, so that no run takes all gold."""
    barred = {
        number for finding in level_problems(level, says) if finding.code == "unreachable" for number in finding.records
    }
    return any(level.objects[number].kind == GOLD for number in barred)


def make_pars(pack: Pack, *, tries: int = TRIES) -> Iterator[tuple[str, Pars]]:
    """The pars of every level file with a sound certificate to the exit, one after another.

    Valid entries of the pack's table are not measured again. ``tries``: as in ``difficulty``, 0 for no difficulty.
    Raises as ``read_pack_certificate`` does.
    """
    known_pars = pack.read_pars()
    for file, named in pack.levels.items():
        run, gold_run = read_pack_certificate(pack, file, "exit"), read_pack_certificate(pack, file, "gold")
        if run is None or run.problems:
            continue
        pars = Pars(
            level_digest(named.level)[:DIGEST_DIGITS],
            run.verdict.xy_sha256[:DIGEST_DIGITS],
            run.verdict.end_tick,
            gold_run.verdict.end_tick if gold_run and not gold_run.problems else None,
        )
        old_pars = known_pars.get(file)
        if old_pars and (old_pars.level, old_pars.run) == (pars.level, pars.run) and old_pars.difficulty is not None:
            measured_difficulty: float | None = old_pars.difficulty
        elif tries == 0:
            measured_difficulty = None
        else:
            inputs = run.recording.inputs[: run.verdict.ticks]
            measured_difficulty = round(difficulty(named.level, inputs, tries=tries), 2)
        yield file, Pars(pars.level, pars.run, pars.exit, pars.gold, measured_difficulty)


RUN_KINDS = ("exit", "gold")


def level_file_of(pack: Pack, file: str) -> str:
    """The level file that a file is, or that it certifies; else the file."""
    if not file.startswith(CERTIFICATES):
        return file
    return next(
        (level for level in pack.files.levels for kind in RUN_KINDS if certificate_name(level, kind) == file), file
    )


def lint(pack: Pack, *, with_design: bool = False, with_gold: bool = False) -> Iterator[PackFinding]:
    """The open findings about the pack: all ``findings`` but those that the pack accepts."""
    return (finding for finding in findings(pack, with_design=with_design, with_gold=with_gold) if not finding.reason)


def findings(pack: Pack, *, with_design: bool = False, with_gold: bool = False) -> Iterator[PackFinding]:
    """All findings about the pack, also those that its index accepts, with the reason; none for a proper pack.

    ``with_design``: also findings about the design of its levels (docs/good-levels.md); ``with_gold``: also missing
    runs with all gold, for levels in which no piece is out of reach.
    """
    reasons = pack.index.reasons
    for finding in _findings(pack, with_design=with_design, with_gold=with_gold):
        yield finding._replace(reason=reasons.get((finding.file, finding.code), ""))


def _findings(pack: Pack, *, with_design: bool, with_gold: bool) -> Iterator[PackFinding]:
    in_episodes = {level.file for levels in pack.episodes.values() for level in levels}
    yield from (pack_finding("unreadable", why=problem) for problem in pack.problems)
    yield from _index_findings(pack)
    for file, named in pack.levels.items():
        if named.file not in in_episodes:
            yield pack_finding("single-level", file)
    yield from _level_findings(pack)
    yield from _order_findings(pack)
    for file, named in pack.levels.items() if with_gold else ():
        settled = (
            pack.certificate(file, "gold") or not named.level.gold or has_gold_out_of_reach(named.level, named.says)
        )
        if not settled and is_certified(pack, file, "exit"):
            yield pack_finding("no-gold-run", file)
    all_certify = True
    for finding in _certificate_findings(pack):
        all_certify = False
        yield finding
    if all_certify:
        yield from _pars_findings(pack)
    if all_certify and with_design:
        for file in pack.levels:
            if run := read_pack_certificate(pack, file, "exit"):
                counts = measure_design(run.level, run.recording.inputs[: run.verdict.ticks])
                yield from design_findings(counts, file)


def _index_findings(pack: Pack) -> Iterator[PackFinding]:
    index = pack.index
    if not index.is_signed:
        yield pack_finding("no-author", INDEX)
    used = {episode.number // EPISODES_PER_COLUMN for episode in index.episodes}
    if used and index.columns and max(used) >= len(index.columns):
        yield pack_finding("column-without-name", INDEX, column=max(used), needed=max(used) + 1)
    names: dict[str, int] = {}
    for episode in index.episodes:
        where, number = (INDEX, episode.line), episode.number
        if not episode.name:
            yield pack_finding("episode-name", *where, number=number)
        elif episode.name in names:
            yield pack_finding("same-episode-name", *where, number=number, other=names[episode.name])
        names[episode.name] = number
        if episode not in pack.episodes:
            yield pack_finding("empty-episode", *where, number=number)
    if not index.episodes:
        yield pack_finding("no-episodes", INDEX)


def _level_findings(pack: Pack) -> Iterator[PackFinding]:
    names: dict[str, str] = {}  # as people read them
    levels: dict[str, str] = {}
    places: dict[str, str] = {}
    for file, named in pack.levels.items():
        if named.form == "ascii" and named.name == PurePath(file).stem:
            yield pack_finding("no-name", file)
        digest = level_digest(named.level)
        for code, key, seen in (("same-name", named.name.casefold().strip(), names), ("same-content", digest, levels)):
            if key in seen:
                yield pack_finding(code, file, other=seen[key])
            seen.setdefault(key, file)
        if file[:2].isdecimal() and file[2:3] == "-" and file[4:5] == "-":
            if file[:4] in places:
                yield pack_finding("same-place", file, number=file[:4], other=places[file[:4]])
            places.setdefault(file[:4], file)
        run = sound_certificate(pack, file, "exit") if named.says else None
        for finding in level_problems(named.level, named.says, run.recording.inputs if run else b""):
            yield PackFinding(finding.code, file, odd=finding)


def _certificate_findings(pack: Pack) -> Iterator[PackFinding]:
    named = {pack.certificate(file, kind) for file in pack.files.levels for kind in RUN_KINDS}
    for name in pack.files.names:
        if name.startswith(CERTIFICATES) and name not in named:
            yield pack_finding("stray-certificate", name)
    for file in pack.levels:
        for kind in RUN_KINDS:
            try:
                run, name = read_pack_certificate(pack, file, kind), certificate_name(file, kind)
                if run:
                    yield from (pack_finding("certificate", name, why=problem) for problem in run.problems)
                elif kind == "exit":
                    yield pack_finding("no-certificate", file)
            except NinjaGameError as error:
                yield pack_finding("unreadable", why=str(error))


def _order_findings(pack: Pack) -> Iterator[PackFinding]:
    pars = {named.file: pack.pars[file] for file, named in pack.levels.items() if file in pack.pars}
    for levels in pack.episodes.values():
        for one, other in pairwise(levels):
            hard, easy = pars.get(one.file), pars.get(other.file)
            if hard and easy and hard.grade not in ("", "easy", "medium") and easy.grade == "easy":
                file, next_name = PurePath(one.file).name, PurePath(other.file).name
                yield pack_finding("hard-before-easy", file, grade=hard.grade, other=next_name, easier=easy.grade)
    first, *later = [pars.get(level.file) for levels in pack.episodes.values() for level in levels] or [None]
    known = [measured.difficulty for measured in later if measured and measured.difficulty is not None]
    if first and first.grade not in ("", "easy") and len(known) > 1 and (first.difficulty or 0.0) > max(known):
        file = PurePath(next(iter(pack.episodes.values()))[0].file).name
        yield pack_finding("hardest-first", file, grade=first.grade)
    ranks = {file: list(DIFFICULTY_GRADES.values()).index(known.grade) for file, known in pars.items() if known.grade}
    for before, after in pairwise(pack.episodes.values()):
        high, low = ([ranks[level.file] for level in some if level.file in ranks] for some in (before, after))
        if high and low and min(high) > max(low):
            yield pack_finding("easier-episode", PurePath(after[0].file).name)


def _pars_findings(pack: Pack) -> Iterator[PackFinding]:
    if PARS not in pack.files.names:
        yield pack_finding("no-pars", PARS)
        return
    try:
        if pack.read_pars() != dict(make_pars(pack, tries=0)):
            yield pack_finding("old-pars", PARS)
    except NinjaGameError as error:
        yield pack_finding("unreadable", why=str(error))
