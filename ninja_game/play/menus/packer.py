"""Makes a pack ready to share, in the background under any screen; and the state of that work."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from time import monotonic

from ninja_game.editor import packs
from ninja_game.editor.pack_steps import Steps
from ninja_game.editor.ready_pack import MADE_READY, Obstacles, ReadyPack, prepare_pack, problems_of_pack
from ninja_game.errors import NinjaGameError
from ninja_game.files.shown_text import counted, file_stem, shown_text
from ninja_game.files.user_folder import EXPORTS
from ninja_game.formats.pack.pack import Pack, certificate_name
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import Entry, EpisodeSet
from ninja_game.levels.findings import PackFinding
from ninja_game.play.app import App, Screen
from ninja_game.play.clipboard import copy_link
from ninja_game.play.screen import BackgroundTask
from ninja_game.player.catalogue import Catalogue
from ninja_game.runtime import NewestJob, cores
from ninja_game.sim.level import Level

SECONDS, LONGER = 20.0, 300.0  # time for each search of a run; for one whose earlier search failed
NOT_FOUND = "no run found"  # the state of a level whose search has failed
NOT_CERTIFIED = ("changed", "no run yet", "stopped")  # states of levels that may be impossible as they are


class Packer(BackgroundTask):
    """Makes a pack ready to share in the background, and keeps the steps done at the desk of packs."""

    def __init__(self, app: App) -> None:
        self.app = app
        self.path = Path()  #: the pack that is or was made ready
        self._seconds = SECONDS
        self._known: dict[Path, set[tuple[str, str]]] = {}  #: accepted problems (file, code), by pack
        self._asks_first = True  #: whether problems are asked about before the work
        self._watching: tuple[Screen, Path | None] | None = None  #: the desk, and the pack that it shows
        self.obstacles: Obstacles = {}
        self.steps = Steps(app.player.folder)  #: changes made at the desk
        self.is_busy = self._stopped = False
        self.text = ""  #: progress, or result
        self._result_text = ""
        self.share: float | None = None  #: finished share of the present step; None: unknown
        self._zips: dict[Path, tuple[Pack, Path | None, bool]] = {}  #: answers of ``zip_of``, by pack
        self._open_problems: ReadyPack | None = None  #: ready but for problems, about which the desk asks
        self._step: tuple[str, float | None, float] = "", None, 0.0  #: text, share and start, s
        self.job: NewestJob[Path, ReadyPack] = NewestJob(self._make_ready)

    @property
    def waited_for(self) -> bool:
        """Whether the player looks at the pack that is made ready."""
        return self._watching == (self.app.top, self.path)

    def watch(self, desk: Screen, shown: Path | None) -> None:
        """The desk shows this pack from now on."""
        self._watching = desk, shown

    def zip_of(self, pack: Pack) -> tuple[Path | None, bool]:
        """The newest zip of a pack among the exports, and whether it has all that is in the pack now."""
        known, path, is_fresh = self._zips.get(pack.files.path, (None, None, False))
        if known is not pack:
            zipped = next(self._zips_of(pack), None)
            path = zipped.files.path if zipped else None
            is_fresh = zipped is not None and packs.same_pack(zipped, pack, whole=True)
            self._zips[pack.files.path] = pack, path, is_fresh
        return path, is_fresh

    def _zips_of(self, pack: Pack) -> Iterator[Pack]:
        """The zips of a pack, the newest first; what cannot be read is none."""
        with suppress(OSError):
            paths = (self.app.player.folder / EXPORTS).glob(f"{file_stem(pack.name, 'replay')}*.zip")
            for path in sorted(paths, key=lambda path: path.stat().st_mtime_ns, reverse=True):
                with suppress(NinjaGameError, OSError):
                    zipped = Pack(path)
                    if zipped.files.folder == pack.files.folder:
                        yield zipped

    def start(self, path: Path, *, seconds: float = SECONDS, known: Sequence[PackFinding] | None = None) -> None:
        """Make a pack ready. ``known``: problems with which the player goes on, and is not asked about again.

        With None, all problems are looked for before, and asked about.
        """
        self._asks_first = known is None
        self.path = path
        self.is_busy, self._stopped = True, False
        self._know(known or ())
        self._open_problems = None
        self._seconds = seconds
        self._say("Beginning", 0.0)
        self.job.ask(path)

    def _know(self, problems: Sequence[PackFinding]) -> None:
        self._known.setdefault(self.path, set()).update((odd.file, odd.code) for odd in problems)

    def news(self, problems: Sequence[PackFinding]) -> list[PackFinding]:
        """The problems that the player has not accepted yet."""
        return [odd for odd in problems if (odd.file, odd.code) not in self._known[self.path]]

    def search_longer(self, path: Path, missing: tuple[Level, str]) -> None:
        """Make the pack ready with a longer search of a run that was not found."""
        self.obstacles.pop(missing, None)
        self.start(path, seconds=LONGER, known=())

    def end(self) -> None:
        """Stop; results are on the disk already."""
        if not self.is_busy:
            return
        self._stopped = True
        with suppress(NinjaGameError, OSError):
            pack = Pack(self.path)
            levels = pack.levels.items()
            self.app.solver.stopped.update(e.level for file, e in levels if not pack.certificate(file, "exit"))

    def _say(self, text: str, share: float | None) -> None:
        if self._stopped:
            raise NinjaGameError("Stopped; what was found is kept")
        self._step = text, share, monotonic()

    def _make_ready(self, path: Path) -> ReadyPack:
        if self._asks_first:
            self._say("Looking for problems", None)
            checked = Checked.of(Pack(path), self.obstacles)
            if self.news(checked.problems):
                return ReadyPack(checked.pack, checked.findings, b"", "", [])
        jobs = max(1, cores() - 1)
        return prepare_pack(path, seconds=self._seconds, jobs=jobs, say=self._say, obstacles=self.obstacles)

    def update(self) -> None:
        if not self.is_busy:
            return
        text, share, start = self._step
        seconds = monotonic() - start
        self.text = text if share is not None else f"{text}: {seconds:.0f} s"
        if self._stopped:
            self.text = "Stopping"
        self.share = share
        if self.job.is_idle:
            self.is_busy, self.text = False, self.job.problem
            if self.app.stack:
                self.app.top.look_again()
            ready = None if self.text else self.job.result
            if ready and self.news(ready.problems):
                self._open_problems = ready
                self.text = f"Neither zip nor link yet: {counted(len(ready.problems), 'open problem')}"
                if not self.waited_for:
                    self.app.notify(f"{shown_text(ready.pack.name)}: {self.text}")
            elif ready:
                self.publish(ready)

    def take_problems(self) -> ReadyPack | None:
        """The pack about whose problems the player is to be asked, once; None while they look at something else."""
        problems = self._open_problems if self.waited_for else None
        self._open_problems = None if problems else self._open_problems
        return problems

    def publish(self, ready: ReadyPack) -> None:
        """Write the zip; copy the link if the player looks at the pack, and notify them."""
        self._know(ready.problems)
        app, name, waited_for = self.app, ready.pack.name, self.waited_for
        title = f"{name} {ready.pack.index.version}".strip()
        over = self._earlier(title, ready.pack)
        app.write_export(title, ".zip", ready.zipped, first=1, over=over.files.path if over else None)
        self._zips.clear()
        notices = [app.notice]
        if ready.link and waited_for:
            copy_link(app, lambda: ready.link, title=name)
            notices.append("the link is in the clipboard")
        app.notify("; ".join(notices) if waited_for else f"{shown_text(name)} is ready to share", here=waited_for)
        if codes := dict.fromkeys(finding.code.replace("-", " ") for finding in ready.problems):
            notices[0] += f", with {counted(len(ready.problems), 'open problem')} ({', '.join(codes)})"
        self.text = self._result_text = "; ".join([*notices, *ready.notes])

    def _earlier(self, title: str, pack: Pack) -> Pack | None:
        """The export with this title if it is of the same pack: there is one zip of each version."""
        path = self.app.player.folder / EXPORTS / f"{file_stem(title, 'replay')}.zip"
        with suppress(NinjaGameError, OSError):
            zipped = Pack(path)
            return zipped if zipped.index.title == pack.index.title else None
        return None

    def next_version(self, pack: Pack) -> str:
        """The version to propose: 1, the pack's own, or the number after it if its zip has something else."""
        version = pack.index.version
        zipped = self._earlier(f"{pack.name} {version}", pack) if version.isdecimal() else None
        return str(int(version) + 1) if zipped and not packs.same_pack(zipped, pack) else version or "1"

    def follow(self, pack: Pack | None) -> None:
        """Drop the result of the work once the pack has changed since, or (None) is gone."""
        if pack is None or (self.text == self._result_text and not self.zip_of(pack)[1]):
            self.text = ""

    def drop_notices(self) -> None:
        """Drop texts that hold only while the desk is open, such as that the link was copied."""
        self.text = "" if self.text == self._result_text else self.text
        self._zips.clear()


@dataclass(frozen=True)
class Checked:
    """The findings about a pack."""

    pack: Pack
    findings: list[PackFinding]  #: accepted or not, without those below
    to_do: list[PackFinding]  #: findings that *Make ready* removes

    @classmethod
    def of(cls, pack: Pack, obstacles: Obstacles) -> Checked:
        findings = problems_of_pack(pack, obstacles)
        to_do = [odd for odd in findings if odd.code in MADE_READY and not (odd.reason or odd.sought)]
        return cls(pack, [finding for finding in findings if finding not in to_do], to_do)

    @cached_property
    def problems(self) -> list[PackFinding]:
        return [finding for finding in self.findings if not finding.reason]

    @cached_property
    def places(self) -> set[str]:
        """Files with problems."""
        return {self.pack.files.place(finding.file) for finding in self.problems}


class PackStatus:
    """The state of the pack that the desk shows, and of its levels."""

    def __init__(self, packer: Packer, catalogue: Catalogue) -> None:
        self.packer, self.catalogue = packer, catalogue
        self.pack: EpisodeSet | None = None
        self.checked: Checked | None = None  #: findings about it, or about the pack as it was before a change
        self.failure = ""  #: why the last check found out nothing
        self._states: dict[int, str] = {}
        self._asked_for: tuple[Pack | None, int] = None, 0  #: the pack of the last check, and the number of obstacles
        self._checks: NewestJob[Pack, Checked] = NewestJob(lambda pack: Checked.of(pack, packer.obstacles))

    def show(self, pack: EpisodeSet | None) -> None:
        """Show a pack as it is now. A failed search changes no file, but the findings: it is checked again."""
        self.pack = pack
        self._states.clear()
        question = pack and pack.pack, len(self.packer.obstacles)
        if question[0] and question != self._asked_for:
            self.checked = self.checked if question[1] == self._asked_for[1] else None
            self._asked_for, self.failure = question, ""
            self._checks.ask(question[0])

    def update(self) -> bool:
        """Whether there are new findings, or a new reason why there are none."""
        checked, failure = self.checked, self.failure
        if self._checks.is_idle:
            self.checked, self.failure = self._checks.result, self._checks.problem
        return self.checked is not checked or self.failure != failure

    @property
    def present(self) -> Checked | None:
        """The findings about the pack as it is now; None until they are known."""
        checked = self.checked
        return checked if checked and self.pack and checked.pack is self.pack.pack else None

    def to_do(self) -> str:
        """The work that *Make ready* will do, in words; "" for none."""
        levels = self.pack.levels if self.pack else []
        states = [self.state(level) for level in levels]
        to_do = self.present.to_do if self.present else []
        certify = sum(map(states.count, NOT_CERTIFIED))
        gold = [finding.code for finding in to_do].count("no-gold-run")
        work = {"certify": (certify, "level"), "measure": (certify + states.count("certified"), "medal time")}
        work["look for all gold in"] = gold, "level"
        parts = [f"{verb} {counted(*count)}" for verb, count in work.items() if count[0]]
        parts = parts or (["renew the medal times"] if to_do else [])
        running = self.packer.is_busy and self.pack is not None and self.packer.path == self.pack.path
        will = "Make ready is at work, and will" if running else "Make ready will"
        if len(parts) < 2:
            return f"{will} {parts[0]}" if parts else ""
        return f"{will} {', '.join(parts[:-1])} and {parts[-1]}"

    def state(self, level: Entry) -> str:
        """The state of a level in a word: its time if it is measured."""
        state = self._states.get(id(level))
        if state is None:
            file = Path(level.named.file)
            has_certificate = (file.parent / certificate_name(file.name, "exit")).is_file()
            if level.pars and (has_certificate or file.parent != (self.pack and self.pack.path)):
                state = f"{seconds_text(level.pars.exit)} s"
            else:
                state = "changed" if has_certificate else "no run yet"
                if self.catalogue.author_run(level):
                    state = "certified"
                elif (level.named.level, "exit") in self.packer.obstacles:
                    state = NOT_FOUND
                elif level.named.level in self.packer.app.solver.stopped and not self.packer.is_busy:
                    state = "stopped"
            self._states[id(level)] = state
        return state

    def counts(self) -> str:
        """The pack in a line."""
        if self.pack is None or self.pack.pack is None:
            return ""
        levels, index = self.pack.levels, self.pack.pack.index
        vain = [self.state(level) for level in levels].count(NOT_FOUND)
        to_do = self.to_do() or (f"{vain} without a run" if vain else "All certified and measured")
        alone = f", {len(self.pack.singles)} in none" if self.pack.singles else ""
        size = f"{counted(len(levels), 'level')} in {counted(len(index.episodes), 'episode')}{alone}"
        present, unknown = self.present, self.failure or "Looking for problems"
        problems = counted(len(present.problems), "problem") if present else unknown
        return f"{size}. {to_do}. {problems}" if levels else size


def packer_of(app: App) -> Packer:
    for task in app.background_tasks:
        if isinstance(task, Packer):
            return task
    app.background_tasks.append(packer := Packer(app))
    return packer
