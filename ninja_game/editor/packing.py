"""A pack made ready to share: certified, measured, looked at, zipped. What is still right is not done again."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import monotonic

from ninja_game.backend.memories import compiled_available
from ninja_game.errors import LinkError, NinjaGameError
from ninja_game.files.shown_text import shown_text
from ninja_game.files.tree import Tree
from ninja_game.files.user_folder import how_to_install
from ninja_game.formats.pack.files import PARS, certificate_name
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.pack.pars import write_pars
from ninja_game.levels.findings import Finding, PackFinding
from ninja_game.runs.packs import KINDS, file_of, is_certified, level_of, lint, make_pars
from ninja_game.sim.level import Level

Say = Callable[[str, float | None], object]
"""Gets what is being done, and the share of that which is done, None where nobody knows."""

Obstacles = dict[tuple[Level, str], Finding]
"""By level and kind of certificate ("exit", "gold"): what kept the solver from such a run."""

_MISSING = {"no-certificate": "exit", "no-gold-run": "gold"}
"""Findings that a run is not there, by code: of which kind."""


@dataclass(frozen=True)
class ReadyPack:
    """``findings``: what is odd; ``zipped``: its bytes; ``link``: "" where it is too large; ``notes``: what is not."""

    pack: Pack
    findings: list[PackFinding]
    zipped: bytes
    link: str
    notes: list[str]


def make_ready(path: Path, *, seconds: float, jobs: int, say: Say, obstacles: Obstacles | None = None) -> ReadyPack:
    """Certify each level to the exit and with all gold, write the par times, lint; the zip and the link.

    ``seconds``: for each search; ``jobs``: levels at a time; ``say`` may raise to end it.
    ``obstacles``: of earlier searches, which are not done again; those of the new ones are put there.
    Raises NinjaGameError, OSError.
    """
    pack, notes, obstacles = Pack(path), list[str](), {} if obstacles is None else obstacles
    if compiled_available():
        _certify(pack, path, seconds, jobs, say, obstacles)
    else:
        notes.append(f"Certifying needs Numba: {how_to_install('fast')}")
    pack, made = Pack(path), {}
    try:
        for file, pars in make_pars(pack):
            made[file] = pars
            say(f"Par times: {len(made)} of {len(pack.levels)} levels", len(made) / len(pack.levels))
        Tree(path).write(PARS, write_pars(made))
    except NinjaGameError as error:
        notes.append(f"No par times: {error}")
    say("Looking for problems", 1.0)
    pack, link = Pack(path), ""
    findings = problems_of(pack, obstacles)
    try:
        link = pack.files.link()
    except LinkError as error:
        notes.append(f"No link: {error}")
    return ReadyPack(pack, findings, pack.files.zipped(), link, notes)


def problems_of(pack: Pack, obstacles: Obstacles) -> list[PackFinding]:
    """What is odd about a pack; where a run is missing, with what kept the solver from it."""
    return [finding._replace(text=_with_obstacle(pack, finding, obstacles)) for finding in lint(pack, with_gold=True)]


def obstacle_of(pack: Pack, finding: PackFinding, obstacles: Obstacles) -> Finding | None:
    """What kept the solver from the run that a finding misses."""
    file, kind = _missing(pack, file_of(pack, finding), finding.code)
    return obstacles.get((pack.levels[file].level, kind)) if kind and file in pack.levels else None


def _missing(pack: Pack, file: str, code: str) -> tuple[str, str]:
    """The level file and the kind of the run that a finding about a file misses; no kind where it misses none."""
    level = level_of(pack, file)
    broken = [kind for kind in KINDS if code == "certificate" and certificate_name(level, kind) == file]
    return level, next(iter(broken), _MISSING.get(code, ""))


def _with_obstacle(pack: Pack, finding: PackFinding, obstacles: Obstacles) -> str:
    why = obstacle_of(pack, finding, obstacles)
    return f"{finding.text}. The search found none: {why.sentence}" if why else finding.text


def _certify(pack: Pack, path: Path, seconds: float, jobs: int, say: Say, obstacles: Obstacles) -> None:
    """Certify the levels of which anything is not known yet, nor accepted."""
    from ninja_game.search.certify import Wanted, certify_all
    from ninja_game.search.solve import compile_solver
    from ninja_game.search.task import Progress, obstacle

    accepted = {_missing(pack, each.file, each.code) for each in pack.index.accepted}

    def is_open(file: str, kind: str) -> bool:
        known = (pack.levels[file].level, kind) in obstacles or (file, kind) in accepted
        return not (known or is_certified(pack, file, kind))

    levels = {file: named for file, named in pack.levels.items() if any(is_open(file, kind) for kind in KINDS)}
    wanted = Wanted({"exit": 0, "gold": -1}, {"seconds": seconds})
    files = [{kind: path / certificate_name(file, kind) for kind in KINDS} for file in levels]
    names = {Path(file).stem: shown_text(named.name) for file, named in levels.items()}
    done, longest = 0, max(1.0, -(-len(files) // jobs) * len(KINDS) * seconds)

    def report(name: str, progress: Progress) -> None:
        over = monotonic() - began
        left = f"{names[name]}: {progress.seconds:.0f} s; at most {max(0.0, longest - over):.0f} s left"
        say(f"Certifying, {done} of {len(files)} levels done. {left}", min(1.0, max(done / len(files), over / longest)))

    if levels:
        say("Getting the solver ready, which takes a minute or two the first time", None)
        compile_solver()
    began = monotonic()
    all_found = certify_all(list(levels.values()), files, wanted, jobs=jobs, report=report)
    for named, found in zip(levels.values(), all_found, strict=True):
        for kind, each in found.items() if isinstance(found, dict) else ():
            if not each.run and each.progress:
                obstacles[named.level, kind] = obstacle(named.level, each.gold, each.progress)
        done += 1
        say(f"Certifying, {done} of {len(files)} levels done", done / len(files))
