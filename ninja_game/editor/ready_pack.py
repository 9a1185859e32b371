"""Makes a pack ready to share: certified, measured and linted, as a zip and a link."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import monotonic

from ninja_game.backend.memories import compiled_available
from ninja_game.editor.solver import preparing_text
from ninja_game.errors import LinkError, NinjaGameError
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.files.tree import Tree
from ninja_game.formats.pack.pack import PARS, Pack, certificate_name
from ninja_game.formats.pack.pars import write_pars
from ninja_game.levels.episodes import episode_set
from ninja_game.levels.findings import Finding, PackFinding
from ninja_game.runs.packs import RUN_KINDS, findings, has_gold_out_of_reach, is_certified, level_file_of, make_pars
from ninja_game.runtime import install_hint
from ninja_game.sim.level import Level

Say = Callable[[str, float | None], object]
"""Gets a text about the present work, and its finished share (None: unknown)."""

Obstacles = dict[tuple[Level, str], Finding]
"""By level and kind of certificate ("exit", "gold"): why the solver found no such run."""

_RUN_OF_CODE = {"no-certificate": "exit", "no-gold-run": "gold"}
"""Codes of findings about missing runs, with the kind of run."""

_CAUSES: dict[str, Sequence[str]] = dict.fromkeys(_RUN_OF_CODE, ("no-ninja", "no-exit"))
_CAUSES |= {"no-exit": ("no-ninja",), "same-content": ("no-ninja",), "same-name": ("same-content",)}
"""Codes of findings about a level, with the codes of their causes."""

_SOUGHT = {"exit": "run to the exit", "gold": "run with all gold"}
_GOALS = {"exit": "exit", "gold": "all gold"}

MADE_READY = (*_RUN_OF_CODE, "certificate", "no-pars", "old-pars")
"""Codes of findings that ``prepare_pack`` removes, unless its search fails."""


@dataclass(frozen=True)
class ReadyPack:
    """A pack to share."""

    pack: Pack
    findings: list[PackFinding]  #: accepted or not
    zipped: bytes  #: bytes of its zip; b"" before its problems are known to the player
    link: str  #: "" where it is too large for one
    notes: list[str]  #: what could not be done

    @property
    def problems(self) -> list[PackFinding]:
        """The findings that are not accepted."""
        return [finding for finding in self.findings if not finding.reason]


def prepare_pack(path: Path, *, seconds: float, jobs: int, say: Say, obstacles: Obstacles | None = None) -> ReadyPack:
    """Certify each level to the exit and with all gold, write the par times, lint; the zip and the link.

    ``seconds``: for each search; ``jobs``: levels at a time; ``say`` may raise to end it. ``obstacles``: of earlier
    searches, which are not repeated; those of new ones are added. Raises NinjaGameError, OSError.
    """
    obstacles = {} if obstacles is None else obstacles
    notes = list[str]()
    if compiled_available():
        _certify(path, obstacles, say=say, seconds=seconds, jobs=jobs)
    else:
        notes.append(f"Certifying needs Numba: {install_hint('fast')}")
    pack, pars = Pack(path), {}
    try:
        for file, pars_of_level in make_pars(pack):
            pars[file] = pars_of_level
            measured = f"Measuring medal times: {len(pars)} of {counted(len(pack.levels), 'level')}"
            say(measured, len(pars) / len(pack.levels))
        Tree(path).write(PARS, write_pars(pars))
    except NinjaGameError as error:
        notes.append(f"No par times: {error}")
    say("Looking for problems", 1.0)
    pack, link = Pack(path), ""
    unsigned = [named for named in pack.levels.values() if not named.author]
    if pack.index.is_signed and 0 < len(unsigned) < len(pack.levels):
        names = ", ".join(shown_text(named.name) for named in unsigned)
        notes.append(f"Without an author, so by the pack's, {shown_text(pack.index.author)}: {names}")
    problems = problems_of_pack(pack, obstacles)
    try:
        link = pack.files.link()
    except LinkError as error:
        notes.append(f"No link: {error}")
    return ReadyPack(pack, problems, pack.files.zipped(), link, notes)


def problems_of_pack(pack: Pack, obstacles: Obstacles) -> list[PackFinding]:
    """The findings about a pack, accepted or not; for a run that no search found, with the reason.

    Consequences of another finding are left out, such as a missing run with all gold if there is no run to the exit.
    """
    problems, no_exit = list[PackFinding](), set[Level]()
    for finding in findings(pack, with_gold=True):
        named_finding, missing = finding, missing_run(pack, finding)
        if missing and (why := obstacles.get(missing)):
            level, kind = missing
            if kind == "gold" and level in no_exit:
                continue
            no_exit |= {level} if kind == "exit" else set()
            named_finding = finding._replace(values={}, odd=why, sought=_SOUGHT[kind])
        problems += [named_finding] if named_finding not in problems else []
    named = {(level_file_of(pack, finding.file), finding.code) for finding in problems}

    def follows(finding: PackFinding) -> bool:
        causes = _CAUSES.get("no-certificate" if finding.sought else finding.code, ())
        return any((level_file_of(pack, finding.file), cause) in named for cause in causes)

    return [finding for finding in problems if not follows(finding)]


def missing_run(pack: Pack, finding: PackFinding) -> tuple[Level, str] | None:
    """The level and the kind of the run of which a finding says that it is missing, as ``Obstacles`` have them."""
    file, kind = _missing_run(pack, finding.file, finding.code)
    return (pack.levels[file].level, kind) if kind and file in pack.levels else None


def _missing_run(pack: Pack, file: str, code: str) -> tuple[str, str]:
    """The level file and the kind of the run that a finding about a file misses; no kind for other findings."""
    level = level_file_of(pack, file)
    broken = [kind for kind in RUN_KINDS if code == "certificate" and certificate_name(level, kind) == file]
    return level, next(iter(broken), _RUN_OF_CODE.get(code, ""))


def _certify(path: Path, obstacles: Obstacles, *, say: Say, seconds: float, jobs: int) -> None:
    """Certify the levels with missing runs that are not accepted as missing."""
    from ninja_game.search.certify import CertifyOptions, certify_all
    from ninja_game.search.solve import compile_solver, is_solver_compiled
    from ninja_game.search.task import Progress, obstacle

    pack = Pack(path)
    accepted = {_missing_run(pack, entry.file, entry.code) for entry in pack.index.accepted}

    def is_open(file: str, kind: str) -> bool:
        level, says = pack.levels[file].level, pack.levels[file].says
        settled = (level, kind) in obstacles or (file, kind) in accepted
        vain = kind == "gold" and has_gold_out_of_reach(level, says)
        return not (settled or vain or is_certified(pack, file, kind))

    in_order = [Path(level.named.file).name for level in episode_set(pack, "").levels]
    levels = {file: pack.levels[file] for file in in_order if any(is_open(file, kind) for kind in RUN_KINDS)}
    options = CertifyOptions({"exit": 0, "gold": -1}, {"seconds": seconds})
    files = [{kind: path / certificate_name(file, kind) for kind in RUN_KINDS} for file in levels]
    goals = {
        file: [_GOALS[kind] for kind in RUN_KINDS[: 1 + (named.level.gold > 0)] if not is_certified(pack, file, kind)]
        for file, named in levels.items()
    }
    planned = {Path(file).stem: seconds * len(sought) for file, sought in goals.items()}
    names = [f"{shown_text(levels[file].name)} ({' and '.join(sought)})" for file, sought in goals.items()]
    begun: dict[str, float] = {}
    done, share = 0, 0.0

    def report(name: str, _: Progress) -> None:
        """Estimate the time left from the pace so far, as if the first seconds had gone as planned."""
        nonlocal share
        now = monotonic()
        begun.setdefault(name, now)
        rest = [max(0.0, planned[stem] - now + begun.get(stem, now)) for stem in list(planned)[done:]]
        elapsed, worked = now - min(begun.values()), sum(planned.values()) - sum(rest)
        pace = (elapsed + seconds / min(jobs, len(levels))) / (worked + seconds)
        left = max(pace * sum(rest), *rest, 0.0)
        share = max(share, elapsed / max(elapsed + left, 1.0))
        spent = now - begun.get(list(planned)[done], now)
        about = f"about {left:.0f} s left" if left >= 1 else "nearly done"
        say(f"Certifying level {done + 1} of {len(levels)}, {names[done]}: {spent:.0f} s so far, {about}", share)

    if levels:
        preparing = preparing_text(compiles=not is_solver_compiled())
        say(f"{preparing}. You can go on with something else meanwhile", None)
        compile_solver()
        say("Starting the search", None)
    all_found = certify_all(list(levels.values()), files, options, jobs=jobs, report=report)
    for named, by_goal in zip(levels.values(), all_found, strict=True):
        for kind, certified in by_goal.items() if isinstance(by_goal, dict) else ():
            if not certified.run and certified.progress:
                obstacles[named.level, kind] = obstacle(named.level, certified.gold, certified.progress)
        done += 1
        say(f"Certifying: {done} of {counted(len(levels), 'level')} done", share)
