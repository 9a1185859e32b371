"""The TAS editor in every state: its tabs, what is not saved, a selection, playing, taken over; what it draws."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from shutil import copy
from types import SimpleNamespace
from typing import Any
from unittest.mock import Mock, patch

import numpy as np
import pygame

from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.search.formula.task import SpanResult, SpanTask
from ninja_game.tas.goals import RunPiece, SpanGoal
from ninja_game.tas_editor.level import paths
from ninja_game.tas_editor.level.other_runs import RunFiles
from ninja_game.tas_editor.level.part import LevelPart
from ninja_game.tas_editor.opening import OpeningScreen
from ninja_game.tas_editor.roll.rows import Digits, RowSheet
from ninja_game.tas_editor.tabs.lead_tab import LeadTab
from ninja_game.ui.lettering import Lettering
from tests.support.draw_log import DrawLog, Note, px
from tests.support.menu_driver import MenuDriver
from tests.support.own_pack import PACK
from tests.support.reference import ROOT
from tests.support.tas_driver import TasDriver

RUN = PACK / "certificates" / "00-4-every-switch.exit.replay.txt"


def _points(points: Any) -> str:
    """Where a long line goes: every tenth point and the last one."""
    found = [px(*map(round, point)) for point in points]
    return "  ".join([*found[:-1:10], found[-1]]) if found else ""


class _Sheet(pygame.Surface):
    """A picture that notes what is filled and put into it."""

    note: Callable[[str], None]
    colour: Callable[[Any], str]

    def fill(self, color: Any, rect: Any = None, *more: Any) -> pygame.Rect:
        self.note(f"  fill {self.colour(color)} {px(*rect) if rect else 'all'}")
        return super().fill(color, rect, *more)

    def blit(self, source: pygame.Surface, dest: Any = (0, 0), *more: Any) -> pygame.Rect:
        self.note(f"  ground {self.colour(source.get_at((source.width - 1, source.height - 1)))} {px(*dest)}")
        return super().blit(source, dest, *more)


class TasLog(DrawLog):
    """Notes what the TAS editor draws, too, and what is drawn right into the window.

    Pictures that are kept from one redraw to the next, the rows of a roll and the paths of runs, are drawn again.
    """

    containers = (LevelPart, "paint"), (RowSheet, "draw"), (RowSheet, "_row")

    def notes(self) -> list[Note]:
        """The paths, and the rows of the roll."""
        return [
            *super().notes(),
            (LevelPart, "paint", self._level_part),
            (paths, "draw_path", self._path),
            (RowSheet, "draw", self._rows),
            (RowSheet, "_row", lambda _, row, y: f"row of tick {row.tick} at {y}"),
            (Digits, "blits", lambda _, text, x, y, c: f"  number {text} up to {px(x, y)} {self._colour(c)}"),
        ]

    def alone(self) -> list[Note]:
        """Letters, and shapes that no canvas draws."""
        shapes = ("line", "lines", "rect", "circle", "polygon")
        return [(Lettering, "rendered", self._letters), *((pygame.draw, name, self._shape(name)) for name in shapes)]

    def _shape(self, name: str) -> Callable[..., str]:
        """Of a shape that is drawn right into the window, or into the rows: its colour and where it is."""

        def note(surface: pygame.Surface, color: Any, *rest: Any, **named: Any) -> str:
            if surface.get_abs_parent() is not pygame.display.get_surface() and not isinstance(surface, _Sheet):
                return ""
            rest = *rest, *named.values()
            places = _points(rest[1]) if name == "lines" else "  ".join(map(str, rest))
            return f"{name} {self._colour(color)} from {px(*surface.get_abs_offset())}: {places}"

        return note

    def _letters(self, _: Any, text: str, size: float, colour: Any, *, bold: bool = False) -> str:
        return f"  letters {text!r} size {size:g}{' bold' * bold} {self._colour(colour)}"

    def _path(self, _: Any, __: Any, places: Any, colour: Any, width: float = 1.5) -> str:
        return f"path {self._colour(colour)} width {width:.2f} {_points(places)}"

    def _level_part(self, part: LevelPart, *_: Any) -> str:
        part.paths = None
        return "level of the TAS editor"

    def _rows(self, sheet: RowSheet, *_: Any) -> str:
        sheet._drawn = [None] * len(sheet._drawn)
        sheet._picture = _Sheet(sheet._picture.get_size())
        sheet._picture.note, sheet._picture.colour = self._note, self._colour
        return ""


def with_rows_once(screens: dict[str, str]) -> dict[str, str]:
    """The same without the rows that look as they did in the state before."""
    known: dict[str, str] = {}
    shorter = {}
    for name, text in screens.items():
        blocks = text.replace("\n  ", "\0").splitlines()
        rows = {block: block.split(" at ")[0] for block in blocks if block.startswith("row of tick ")}
        new = [block for block in blocks if block not in rows or known.get(rows[block]) != block]
        known |= {tick: block for block, tick in rows.items()}
        shorter[name] = "\n".join([*new, f"rows as before: {len(blocks) - len(new)}"]).replace("\0", "\n  ") + "\n"
    return shorter


class FixedSearch:
    """A search that has found two results as soon as it starts."""

    def __init__(self, task: SpanTask, *_: object, **__: object) -> None:
        self.done, self.problem = False, ""
        self.ticks_run, self.seconds = 2_500_000, 7.0
        self.own = self._found(task, 28, 1.5)
        self.results = self._found(task, 21, 2.25), self._found(task, 25, -1.5)
        self.miss: SpanResult | None = None

    @staticmethod
    def _found(task: SpanTask, ticks: int, speed: float) -> SpanResult:
        keys = np.full(ticks, 2, np.uint8)
        inputs = task.inputs[: task.first] + keys.tobytes() + task.inputs[task.first + ticks :]
        path = np.full((ticks, 2), 99 * speed)
        return SpanResult(float(ticks), ticks, keys, inputs, 1, (310.0 + ticks, 400.0, speed, 0.0), path=path)

    def start(self) -> None:
        """It has run already."""

    def cancel(self) -> None:
        """End."""
        self.done = True

    def finish(self, _: float = 0) -> None:
        """It has ended already."""


def tas_editor(driver: MenuDriver) -> Iterator[str]:
    """The names of the states, one after the other; in the end the screen below is shown again."""
    run = Path(copy(RUN, driver.player.folder / "every-switch.replay.txt"))
    with patch("ninja_game.tas_editor.span_results.SpanSearch", FixedSearch):
        at = TasDriver.over(driver, run)
        yield "tas"
        yield from _edits(at)
        yield from _level(at)
        yield from _tabs(at)
        yield from _panels(at)
        at.choose_in_menu("Leave")
        yield "tas-leave-unsaved"
        at.choose("Discard changes")
    waiting = OpeningScreen(driver.app, at.session.recording(at.editor.track, "Every Switch"), lambda: at.screen)
    waiting.thread.join()
    waiting.update = Mock()  # type: ignore[method-assign]
    driver.app.push(waiting)
    yield "tas-opening"
    waiting._waited_ms = 3000
    yield "tas-opening-loading"
    waiting._compiles = True
    yield "tas-opening-compiling"
    driver.app.pop()


def _edits(at: TasDriver) -> Iterator[str]:
    """Keys that are changed, selected, named, behind the end, not simulated, beside those of another run."""
    at.press("end")
    at.frames(2)
    yield "tas-run-ended"
    at.press("end")
    at.frames(2)
    yield "tas-behind-the-end"
    other = at.editor.track.replaced(60, 66, [1] * 4).replaced(300, 300, [2] * 12)
    at.editor.select(105, 112)
    at.press("z")
    at.editor.select(96, 101)
    at.press("delete")
    at.editor.edit(lambda track: track.named(98, "the ledge").named(140, "keys"))
    at.frames(2)
    yield "tas-edited"
    at.screen.level.others.open([at.session.recording(other, "Somebody else")])
    at.editor.select(60, 70)
    at.frames(2)
    yield "tas-another-run-beside"
    at.editor.select(200, 201)
    at.session.change(at.editor.track.replaced(201, 205, [0] * 4), ticks=0)
    at.editor.go(230)
    yield "tas-not-simulated"
    at.frames(60)
    at.chord("z", pygame.KMOD_LCTRL)
    at.chord("s", pygame.KMOD_LCTRL)
    at.app.notify("")
    at.frames(2)
    yield "tas-saved"
    at.session.journal.problem = "What you edit cannot be kept safe: No space left"
    yield "tas-journal-problem"
    at.session.journal.problem = ""


def _level(at: TasDriver) -> Iterator[str]:
    """What is pointed at, played, taken over."""
    at.editor.go(100)
    at.frames(2)
    part = at.screen.level
    x, y = part.picture.canvas.point(*at.session.timeline.positions[118])
    left, top, _, _ = part.area
    at.event(pygame.MOUSEMOTION, left + x, top + y)
    yield "tas-pointing-at-a-tick"
    part.point_at(118, part.picture.run.objects[0])
    yield "tas-pointing-at-an-object"
    part.mouse_left()
    at.wheel(4, left + x, top + y)
    yield "tas-zoomed"
    at.press("0", "space")
    at.frames(7)
    yield "tas-playing"
    at.press("space")
    at.editor.go(100)
    at.press("return")
    at.frames(2)
    yield "tas-take-over-waiting"
    at.keys.script = [2] * 8
    at.frames(8)
    yield "tas-take-over"
    at.press("space")
    yield "tas-take-over-still"
    at.press("return")
    at.chord("z", pygame.KMOD_LCTRL)
    at.editor.edit(lambda track: track.replaced(100, len(track), [2] * 300))
    at.frames(2)
    at.press("end")
    at.frames(20)
    yield "tas-no-exit"
    at.chord("z", pygame.KMOD_LCTRL)


def _tabs(at: TasDriver) -> Iterator[str]:
    """Values, branches, lead, search and text, with nothing in them and with something."""
    values, branches, lead, search, text = at.screen.tabs
    at.editor.select(100, 130)
    at.frames(2)
    x, y, _, _ = values.list.row_area(1)  # type: ignore[attr-defined]
    at.event(pygame.MOUSEMOTION, x + 5, y + 5)
    yield "tas-values-row-under-the-mouse"
    for _ in range(5):
        at.press("home")
        values._toggle(0)  # type: ignore[attr-defined]
    at.frames()
    yield "tas-values-fewer"
    at.editor.tab = branches.name
    at.session.drop_branch(0)  # the run as it was opened
    at.frames()
    yield "tas-branches-empty"
    for name in ("first try", "second try"):
        at.press("b")
        at.top().texts[0] = name  # type: ignore[attr-defined]
        if name == "first try":
            yield "tas-keep-a-branch"
        at.choose("Keep")
        at.editor.edit(lambda track: track.replaced(20, 20, [0] * 9))
        at.frames(2)
    yield "tas-branches"
    at.choose("Drop")
    yield "tas-drop-a-branch"
    at.press("escape")
    for name, track in (("ahead", at.session.branches.all[0].track), ("behind", None)):
        assert isinstance(lead, LeadTab)
        at.editor.against = track
        if name == "behind":
            first = at.session.branches.all[0].track
            at.editor.against, at.editor.places = at.editor.track, at.editor.places
            at.editor.edit(lambda _, first=first: first)  # type: ignore[misc]
            at.session.keep_branch("third try")
            at.editor.against = at.session.branches.all[1].track
        at.editor.tab = lead.name
        at.frames(20)
        lead.job.finish()
        at.frames(2)
        yield f"tas-lead-{name}"
    at.editor.tab = search.name
    at.frames(2)
    yield "tas-search-empty"
    at.editor.select(100, 130)
    at.press("f")
    at.write("x > 300")
    at.press("return")
    at.frames(2)
    yield "tas-search-results"
    x, y, _, _ = search.list.row_area(0)  # type: ignore[attr-defined]
    at.event(pygame.MOUSEMOTION, x + 40, y + 5)
    at.frames(2)
    yield "tas-search-result-under-the-mouse"
    search.results.search.problem = "there is not enough memory"  # type: ignore[attr-defined]
    yield "tas-search-problem"
    search.results.search.problem = ""  # type: ignore[attr-defined]
    at.press("return")
    fixed = search.results.search  # type: ignore[attr-defined]
    found, own = fixed.results, fixed.own
    fixed.results, fixed.own, fixed.miss = (), None, replace(fixed.own, score=np.inf, missed_by=14.25)
    held = SimpleNamespace(pieces=(), refresh=lambda: None)  # pieces of a thread come at any time
    search.proposed = held  # type: ignore[attr-defined]
    at.frames(2)
    yield "tas-search-miss"
    pieces = RunPiece(0, 60, "To gold 5", SpanGoal("taken(5)")), RunPiece(60, 130, "To exit", SpanGoal("won"))
    held.pieces = pieces
    at.frames(2)
    yield "tas-search-pieces"
    search.close()
    fixed.results, fixed.own = found, own
    at.frames(2)
    at.press("escape")
    at.editor.edit(lambda track: track.replaced(10, 12, [4, 4]))
    at.frames(2)
    yield "tas-search-run-changed"
    at.editor.tab = text.name
    at.frames(2)
    yield "tas-text"


def _panels(at: TasDriver) -> Iterator[str]:
    """What lies over it."""
    for key, name in (("f1", "help"), ("escape", "menu"), ("v", "watch"), ("m", "marker")):
        at.press(key)
        yield f"tas-{name}"
        at.press("escape")
    at.screen.roll.choose_columns()
    at.frames()
    yield "tas-columns"
    at.press("escape")
    at.screen.tabs[0].show_objects()  # type: ignore[attr-defined]
    at.frames()
    yield "tas-objects"
    at.press("escape")
    at.chord("o", pygame.KMOD_LCTRL)
    at.app.notify("")  # what was undone before
    at.frames(2)
    yield "tas-other-runs"
    at.choose("From a file ...")
    files = at.shown(RunFiles)
    files.title, files.folder = "~/runs", ROOT
    files.paths = [ROOT.parent, ROOT / "levels", ROOT / "theirs.replay.txt"]
    files.list.fill(files.paths)
    files.redraw = True
    yield "tas-runs-from-a-file"
    at.press("escape", "escape")
    at.choose_in_menu("Watch")
    viewer = at.shown(ReplayScreen)
    viewer.toggle_pause()
    viewer.seek(20)
    at.frames(2)
    yield "tas-watched-beside-another"
    at.press("escape")
