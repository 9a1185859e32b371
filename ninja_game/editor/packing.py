"""A pack made ready to share: certified, measured, looked at, zipped. What is still right is not done again."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from ninja_game.backend.memories import compiled_available
from ninja_game.errors import LinkError, NinjaGameError
from ninja_game.files.tree import Tree
from ninja_game.files.user_folder import how_to_install
from ninja_game.formats.pack.files import PARS, certificate_name
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.pack.pars import write_pars
from ninja_game.levels.findings import PackFinding
from ninja_game.runs.packs import KINDS, lint, make_pars


@dataclass(frozen=True)
class ReadyPack:
    """``findings``: what is odd; ``zipped``: its bytes; ``link``: "" where it is too large; ``notes``: what is not."""

    pack: Pack
    findings: list[PackFinding]
    zipped: bytes
    link: str
    notes: list[str]


def make_ready(path: Path, *, seconds: float, jobs: int, say: Callable[[str], object]) -> ReadyPack:
    """Certify each level to the exit and with all gold, write the par times, lint; the zip and the link.

    ``seconds``: for each search; ``jobs``: levels at a time; ``say`` gets what is being done, and may raise to end it.
    Raises NinjaGameError, OSError.
    """
    pack, notes = Pack(path), list[str]()
    if compiled_available():
        _certify(pack, path, seconds, jobs, say)
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
    findings = list(lint(pack))
    try:
        link = pack.files.link()
    except LinkError as error:
        notes.append(f"No link: {error}")
    return ReadyPack(pack, findings, pack.files.zipped(), link, notes)


def _certify(pack: Pack, path: Path, seconds: float, jobs: int, say: Callable[[str], object]) -> None:
    from ninja_game.search.certify import Wanted, certify_all
    from ninja_game.search.task import Progress

    wanted = Wanted({"exit": 0, "gold": -1}, {"seconds": seconds})
    files = [{kind: path / certificate_name(file, kind) for kind in KINDS} for file in pack.levels]
    done = 0

    def report(name: str, progress: Progress) -> None:
        say(f"Certifying, {done} of {len(files)} levels done. {name}: {progress.seconds:.0f} s")

    say("Certifying; the first time the solver is compiled, for a minute")
    for _ in certify_all(list(pack.levels.values()), files, wanted, jobs=jobs, report=report):
        done += 1
        say(f"Certifying, {done} of {len(files)} levels done")
