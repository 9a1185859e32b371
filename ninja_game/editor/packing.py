"""A pack made ready to share: certified, measured, looked at, zipped. What is still right is not done again."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ninja_game.backend.memories import compiled_available
from ninja_game.errors import LinkError, NinjaGameError
from ninja_game.files.tree import Tree
from ninja_game.files.user_folder import how_to_install
from ninja_game.formats.pack.files import PARS, certificate_name
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.pack.pars import write_pars
from ninja_game.levels.findings import Finding, PackFinding
from ninja_game.runs.packs import KINDS, lint, make_pars
from ninja_game.sim.level import Level


@dataclass(frozen=True)
class ReadyPack:
    """``findings``: what is odd; ``zipped``: its bytes; ``link``: "" where it is too large; ``notes``: what is not.

    ``obstacles``: by level, what kept the solver from a run to the exit.
    """

    pack: Pack
    findings: list[PackFinding]
    zipped: bytes
    link: str
    notes: list[str]
    obstacles: Mapping[Level, Finding] = field(default_factory=dict)


def make_ready(path: Path, *, seconds: float, jobs: int, say: Callable[[str], object]) -> ReadyPack:
    """Certify each level to the exit and with all gold, write the par times, lint; the zip and the link.

    ``seconds``: for each search; ``jobs``: levels at a time; ``say`` gets what is being done, and may raise to end it.
    Raises NinjaGameError, OSError.
    """
    pack, notes, obstacles = Pack(path), list[str](), dict[Level, Finding]()
    if compiled_available():
        obstacles = _certify(pack, path, seconds, jobs, say, notes)
    else:
        notes.append(f"Certifying needs Numba: {how_to_install('fast')}")
    pack, made = Pack(path), {}
    try:
        for file, pars in make_pars(pack):
            made[file] = pars
            say(f"Par times: {len(made)} of {len(pack.levels)} levels")
        Tree(path).write(PARS, write_pars(made))
    except NinjaGameError as error:
        notes.append(f"No par times: {error}")
    say("Looking for problems")
    pack, link = Pack(path), ""
    findings = problems_of(pack, obstacles)
    try:
        link = pack.files.link()
    except LinkError as error:
        notes.append(f"No link: {error}")
    return ReadyPack(pack, findings, pack.files.zipped(), link, notes, obstacles)


def problems_of(pack: Pack, obstacles: Mapping[Level, Finding]) -> list[PackFinding]:
    """What is odd about a pack, and what kept the solver from a run to the exit where that is still missing."""
    found = list(lint(pack))
    missing = [str(finding) for finding in found if finding.code in ("no-certificate", "certificate")]
    left = [(file, obstacles[named.level]) for file, named in pack.levels.items() if named.level in obstacles]
    for file, why in left:
        if any(Path(file).stem in text for text in missing):
            found.append(PackFinding(pack.files.place(file), why.code, f"no run to the exit found: {why.sentence}"))
    return found


def _certify(
    pack: Pack, path: Path, seconds: float, jobs: int, say: Callable[[str], object], notes: list[str]
) -> dict[Level, Finding]:
    """Certify all levels; by level, what kept the solver from a run to the exit. For gold that is a note."""
    from ninja_game.search.certify import Wanted, certify_all
    from ninja_game.search.task import Progress, obstacle

    wanted = Wanted({"exit": 0, "gold": -1}, {"seconds": seconds})
    files = [{kind: path / certificate_name(file, kind) for kind in KINDS} for file in pack.levels]
    done, obstacles = 0, dict[Level, Finding]()

    def report(name: str, progress: Progress) -> None:
        say(f"Certifying, {done} of {len(files)} levels done. {name}: {progress.seconds:.0f} s")

    say("Certifying; the first time the solver is compiled, for a minute")
    all_found = certify_all(list(pack.levels.values()), files, wanted, jobs=jobs, report=report)
    for (file, named), found in zip(pack.levels.items(), all_found, strict=True):
        for goal, each in found.items() if isinstance(found, dict) else ():
            why = None if each.run or not each.progress else obstacle(named.level, each.gold, each.progress)
            if why and goal == "exit":
                obstacles[named.level] = why
            elif why and named.level not in obstacles:
                notes.append(f"{file}: no run with all gold in {seconds:.0f} s: {why.sentence}")
        done += 1
        say(f"Certifying, {done} of {len(files)} levels done")
    return obstacles
