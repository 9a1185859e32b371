"""The player's packs: episodes as shelves of levels, which are dragged and made; a pack is made ready to share."""

from __future__ import annotations

import re
import webbrowser
from collections.abc import Callable, Sequence
from functools import partial
from math import dist
from pathlib import Path
from typing import NamedTuple

import pygame

from ninja_game.editor import packs
from ninja_game.editor.packs import missing_run, obstacle_of, problems_of
from ninja_game.errors import NinjaGameError, reason
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.files.user_folder import short_path
from ninja_game.formats.links import link_kind
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN, LEVELS_PER_EPISODE, Accepted, EpisodeIndex
from ninja_game.formats.pack.pack import INDEX, Pack, certificate_name
from ninja_game.formats.run_time import seconds_text
from ninja_game.generator.daily import FOLDER as DAILY
from ninja_game.levels.findings import Finding, PackFinding
from ninja_game.levels.warnings import level_findings
from ninja_game.play.app import App
from ninja_game.play.clipboard import copy_link, pasted_text
from ninja_game.play.level.screen import play_level
from ninja_game.play.menus.menu_screen import CANCEL, FormPanel, Menu, Question, Row, ask_text
from ninja_game.play.menus.packer import packer_of
from ninja_game.play.menus.problems import Problem, ProblemsScreen
from ninja_game.play.menus.replays import watch
from ninja_game.play.menus.thumbnails import ThumbnailScreen
from ninja_game.player.catalogue import Entry, EpisodeSet
from ninja_game.runs.packs import NEVER_ACCEPTED, file_of, level_of
from ninja_game.runtime import NewestJob
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.input.keys import chord
from ninja_game.ui.list_view import BAR, ListView
from ninja_game.ui.medals import draw_all_gold
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Button, Choice, Widget

WIDE, HIGH = 93, 106

RENEW_MS = 500
"""How often the pack is read again while it is made ready."""

DELETED = "deleted"
"""The folder among the player's files into which packs go that are deleted."""

NOT_FOUND = "no run found"
"""The state of a level that was searched in vain."""

NOT_CERTIFIED = ("changed", "no run yet")
"""States of levels of which nobody knows whether they can be passed as they are."""

PULL = 6
"""px that the mouse moves with its button down before it takes something along."""

_NO_PACK = (
    "A pack is a folder with your levels in episodes.",
    "New pack makes one; levels that you have made can be dragged into it then.",
)
_NO_LEVELS = (
    "Click the episode, or a free place, twice: New level makes one here.",
    "Or choose at the right where your levels are, and drag them into the places.",
    "Make ready then certifies all, and gives you a zip and a link to share.",
)

_READY_HINT = "It can be stopped at any time: what was found is kept."

Edit = Callable[[Entry, Finding | None], object]


class Cell(NamedTuple):
    """A place on the shelves or beside them. ``episode``: None in the row for a new one; ``level``: None if free."""

    episode: EpisodeIndex | None
    level: Entry | None = None
    head: bool = False


class _Checked(NamedTuple):
    """What was odd about a pack. ``to_do``: what Make ready does; ``places``: the files that the others are about."""

    pack: Pack
    findings: list[PackFinding]
    to_do: list[PackFinding]
    places: frozenset[str]


class Rack(ListView):
    """Cells that the mouse can take along: ``pull`` gets the number of one. A second click that pulls none chooses."""

    def __init__(self, area: Area, columns: int, screen: PackScreen, choose: Callable[[int], object]) -> None:
        super().__init__(area, HIGH, screen.draw_cell, choose, opens=True)
        self.columns = columns
        self.pull = screen.pull
        self._pressed = (0.0, 0.0)
        self._again = False

    def click(self, x: float, y: float) -> bool:
        index = self._index_at(x, y)
        self._again = index is not None and index == self._clicked
        self._clicked, self._pressed = -1, (x, y)
        return super().click(x, y)

    def drag(self, x: float, y: float) -> bool:
        index = self._index_at(*self._pressed)
        if index is None or self._pressed[0] >= self.area[0] + self.area[2] - BAR - 4:
            return super().drag(x, y)
        if dist((x, y), self._pressed) > PULL:
            self._again = False
            self.pull(self, index, (x, y))
        return True

    def release(self) -> None:
        """The button goes up where nothing was taken along."""
        again, self._again = self._again, False
        if again:
            self.choose(self.index)

    def at(self, x: float, y: float) -> int | None:
        return self._index_at(x, y) if self.contains(x, y) else None


class PackScreen(ThumbnailScreen):
    """``pack``: the one on the shelves. ``held``: what is being moved; ``pointer``: where the mouse has it, else None.

    ``edit``: opens a level in the editor, at a finding.
    """

    title = "Packs"
    notice_top = 525.0

    def __init__(self, app: App, edit: Edit) -> None:
        super().__init__(app)
        self._edit = edit
        self.pack: EpisodeSet | None = None
        self.mine: list[EpisodeSet] = []
        self.sets: list[EpisodeSet] = []
        self.beside = "none"
        self.cells: list[Cell] = []
        self.side: list[Cell] = []
        self.states: dict[int, str] = {}
        self.held: Cell | None = None
        self.pointer: tuple[float, float] | None = None
        self.shelves = Rack((36, 96, 6 * WIDE + BAR + 4, 4 * HIGH), 6, self, self._choose)
        self.tray = Rack((622, 126, WIDE + BAR + 24, 4 * HIGH - 28), 1, self, self._choose_beside)
        self.packer = packer_of(app)
        self.packer.desk = self
        self._told = False, ""
        self._vain = 0
        self._since_read = 0
        self._checks: NewestJob[Pack, _Checked] = NewestJob(self._check)
        self._checked: _Checked | None = None
        self._asked: Pack | None = None

    @property
    def path(self) -> Path:
        return (self.pack and self.pack.path) or self.folder

    @property
    def folder(self) -> Path:
        return self.player.folder / "levels"

    # --- what there is ---

    def _read(self, shown: Path | None = None, *, news: bool = False) -> None:
        """All packs as they are now; this one on the shelves, or the one before. ``news``: only if that is another."""
        before, catalogue = shown or self.path, self.player.catalogue
        catalogue.problems.clear()
        self.sets = catalogue.packs()
        self.mine = [each for each in self.sets if each.changeable and each.path and each.path.name != DAILY]
        now = next((each for each in self.mine if each.path == before), None)
        if not (news and now is self.pack):
            self._show(now)

    def _show(self, pack: EpisodeSet | None) -> None:
        self.pack = pack = pack or next(iter(self.mine), None)
        self.cells = []
        self.states.clear()
        if pack and pack.pack is not self._asked and pack.pack:
            self._asked = pack.pack
            self._checks.ask(pack.pack)
        if pack and pack.pack:
            for episode in pack.pack.index.episodes:
                levels = pack.episodes[episode.number].levels if episode.number in pack.episodes else ()
                self.cells += [Cell(episode, head=True), *(Cell(episode, each) for each in levels)]
                self.cells += [Cell(episode)] * (LEVELS_PER_EPISODE - len(levels))
            self.cells += [Cell(None, head=True), *[Cell(None)] * LEVELS_PER_EPISODE]
        entries: Sequence[Entry] = pack.singles if pack else ()
        if self.beside == "yours":
            entries = self.player.catalogue.own()
        elif self.beside != "none":
            entries = [entry for each in self.sets if each.key == self.beside for entry in each.levels]
        self.side = [Cell(None, entry) for entry in entries]
        self.shelves.fill(self.cells)
        self.tray.fill(self.side)
        self.redraw = True

    def enter(self) -> None:
        self._read()
        super().enter()

    def build(self) -> Sequence[Widget]:
        names, have = [(each.name, each.key) for each in self.mine], self.pack and self.pack.pack
        chosen = Choice((36, 60, 228, 28), "", names, lambda: self.pack.key if self.pack else "", self._choose_pack)
        chosen.hint = f"{have.index.title}, in the folder {self.path.name}" if have else ""
        tray = [("In no episode", "none"), ("Your folder", "yours")]
        tray += [(each.name if each.key else "The game's own", each.key) for each in self.sets if each is not self.pack]
        beside = Choice((622, 96, 134, 26), "", tray, lambda: self.beside, self._choose_tray)
        self.shelves.hint = self.tray.hint = "Drag a level or an episode; Enter or a second click: what can be done"
        ready = "Stop" if self.packer.busy else "Make ready"
        hint = "Certify all, measure par times, look for problems; zip and link. Only what changed is done again"
        new = Button((272, 60, 82, 28), "New pack...", self._new_pack, size=10)
        paste = Button((360, 60, 76, 28), "Paste link", self._paste, size=10)
        paste.hint = "Ctrl+V: the pack whose link is in the clipboard becomes one of yours"
        about = Button((442, 60, 78, 28), "About it...", self._about, size=10, hint="Name, author, version, link")
        show = partial(ProblemsScreen, self.app, self.problems)
        problems = Button((526, 60, 78, 28), "Problems", lambda: self.app.push(show()), size=10)
        make = Button((610, 60, 146, 28), ready, self._ready_or_stop, hint=hint)
        link = Button((662, 525, 94, 24), "Copy the link", self._copy_link, size=10)
        link.hint = "Whoever opens it, or pastes it in Levels > Packs, gets the pack"
        folder = Button((562, 525, 94, 24), "Open the folder", self._open_folder, size=10, hint="Where the zip is")
        share = [] if self.packer.busy else [*[folder] * bool(self._saved), link]
        first = [self.shelves, chosen, new, paste, about, problems, make, beside, self.tray]
        return [*first, *share] if have else [new, paste]

    @property
    def _saved(self) -> Path | None:
        """The zip that was just made of this pack."""
        return self.packer.saved if self.packer.path == self.path else None

    def _open_folder(self) -> None:
        if self._saved and not webbrowser.open(self._saved.parent.as_uri()):
            self.app.notify(f"Nothing here opens folders: it is {short_path(self._saved.parent)}")

    def _copy_link(self) -> None:
        copy_link(self.app, Pack(self.path).files.link, title=self.pack.name if self.pack else "")

    def _choose_pack(self, key: str) -> None:
        self._show(next(each for each in self.mine if each.key == key))

    def _choose_tray(self, key: str) -> None:
        self.beside = key
        self._show(self.pack)

    # --- what can be done ---

    def do(self, action: Callable[[], object]) -> None:
        """Change something on the disk, and show all as it is then."""
        try:
            action()
        except (NinjaGameError, OSError) as error:
            self.app.notify(reason(error))
        self._read()
        self.app.top.enter()

    def ask(self, title: str, text: str, action: Callable[[str], object]) -> None:
        ask_text(self.app, title, "", text, "OK", lambda typed: self.do(lambda: action(typed)), 60)

    def _new_pack(self) -> None:
        def make(name: str) -> None:
            path = packs.new_pack(self.folder, name, self.player.settings.name)
            self.beside = "yours" if self.player.catalogue.own() else "none"
            self._read(path)

        self.ask("Name of the pack", "My pack", make)

    def _paste(self) -> None:
        def take() -> None:
            text = pasted_text()
            if link_kind(text) != "pack":
                raise NinjaGameError("there is no link of a pack in the clipboard: copy all of it first")
            pack = Pack(Path(f"#{text.partition('#')[2]}"))
            if there := next((each for each in self.mine if each.pack and packs.same_pack(pack, each.pack)), None):
                self._show(there)
                raise NinjaGameError(f"{shown_text(there.name)} is among your packs already")
            self._read(packs.copy_pack(pack, self.folder, pack.name))
            self.app.notify(f"{shown_text(pack.name)} is among your packs now: Episodes plays it")

        self.do(take)

    def handle(self, event: InputEvent) -> None:
        if event.raw.type == pygame.KEYDOWN and chord(event.raw) == "ctrl+v":
            self._paste()
        else:
            super().handle(event)

    def _form(self, first: int = 0) -> None:
        """Ask for what the index says first; the field number ``first`` has the focus."""
        index = Pack(self.path).index
        keys = ("name", "author", "version", "comment")
        fields = [(key.capitalize(), getattr(index, key), 200) for key in keys]

        def describe(texts: list[str]) -> None:
            self.app.know_author(index.author, texts[1])
            self.do(lambda: packs.describe(self.path, dict(zip(keys, texts, strict=True))))

        form = FormPanel(self.app, "About the pack", fields, "OK", describe)
        self.app.push(form)
        form.focus = form.widgets[first]

    def _about(self) -> None:
        copied = Pack(self.path)
        index = copied.index
        copy = partial(packs.copy_pack, copied, self.folder)
        busy = self.packer.busy and self.packer.path == self.path
        gone = "It is being made ready" if busy else "It goes to a folder beside your levels"
        rows: list[Row] = [
            ("Name, author, version...", self._form, ""),
            ("Copy of the pack...", lambda: self.ask("Name of the copy", f"{index.name} copy", copy), ""),
            ("Delete the pack...", None if busy else self._delete, gone),
            CANCEL,
        ]
        self.app.push(Menu(self.app, index.name, rows))

    def _delete(self) -> None:
        name, path = self.pack.name if self.pack else "", self.path

        def delete() -> None:
            there = packs.bin_pack(path, self.player.folder / DELETED)
            self.app.notify(f"{shown_text(name)} is in the folder {there.relative_to(self.player.folder)} now")

        self.app.push(Question(self.app, f"Delete {shown_text(name)}?", "Delete it", lambda: self.do(delete)))

    def _choose(self, index: int) -> None:
        cell = self.cells[index]
        if self.held:
            self._drop(cell)
        elif cell.level:
            self._level_menu(cell)
        elif cell.episode is None:
            self.ask("Name of the episode", "New episode", partial(packs.new_episode, self.path, column=self._column()))
        else:
            self._episode_menu(cell.episode)

    def _choose_beside(self, index: int) -> None:
        if self.held:
            self._drop(None)
        else:
            self._level_menu(self.side[index])

    def _column(self) -> int:
        return max((cell.episode.number for cell in self.cells if cell.episode), default=0) // EPISODES_PER_COLUMN

    def _level_menu(self, cell: Cell) -> None:
        level, episode = cell.level, cell.episode
        if level is None:
            return
        file = Path(level.named.file)
        rename, take_out = partial(packs.rename_level, file), partial(packs.place, self.path, file.name, None)

        def copy() -> None:
            new = packs.duplicate(self.path, level.named)
            packs.place(self.path, new, episode.number if episode else None)

        run = self.player.catalogue.author_run(level)

        def play() -> None:
            if why := play_level(self.app, level):
                self.app.notify(why)

        rows: list[Row] = [
            ("Edit", lambda: self._edit(level, None), ""), ("Play", play, ""),
            ("Watch the run", partial(watch, self.app, [run]) if run else None, "" if run else "None is known yet"),
            ("Move...", lambda: self._hold(cell), ""),
        ]  # fmt: skip
        if file.parent == self.path:
            rows += [("Rename...", lambda: self.ask("Another name", level.named.name, rename), "")]
            rows += [("Copy", lambda: self.do(copy), "Another level like it")]
            rows += [("Take out", lambda: self.do(take_out), "Into no episode")] * bool(episode)
        self.app.push(Menu(self.app, level.title, [*rows, CANCEL]))

    def _episode_menu(self, episode: EpisodeIndex) -> None:
        number, path = episode.number, self.path
        column = number // EPISODES_PER_COLUMN
        columns = list(self.pack.columns if self.pack else ())
        columns += [""] * (column + 1 - len(columns))

        def level(name: str) -> None:
            file = packs.new_level(path, name, self.player.settings.name)
            packs.place(path, file, number)
            self._read()
            if entry := self._entry(file):
                self._edit(entry, None)

        def name_column(name: str) -> None:
            packs.describe(path, {"columns": [*columns[:column], name, *columns[column + 1 :]]})

        rename, begin = (
            partial(packs.rename_episode, path, number),
            partial(packs.new_episode, path, column=self._column() + 1),
        )
        rows: list[Row] = [
            ("New level...", lambda: self.ask("Name of the level", "New level", level), "Made, and opened"),
            ("Rename...", lambda: self.ask("Another name", episode.name, rename), ""),
            ("Move...", lambda: self._hold(Cell(episode, head=True)), ""),
            ("Name of the column...", lambda: self.ask("Name of the column", columns[column], name_column), ""),
            ("Begin a column...", lambda: self.ask("Its first episode", "New episode", begin), "Beside the others"),
            ("Remove the episode", lambda: self.do(partial(packs.remove_episode, path, number)), "Its levels stay"),
            CANCEL,
        ]
        self.app.push(Menu(self.app, episode.name or f"Episode {number + 1}", rows))

    # --- moving ---

    def pull(self, rack: Rack, index: int, pointer: tuple[float, float]) -> None:
        """The mouse takes a cell along, or moves on with it."""
        cell = (self.cells if rack is self.shelves else self.side)[index]
        if self.held is None and (cell.level or (cell.head and cell.episode)):
            self.held = cell
        self.pointer = pointer if self.held else None
        over = self.shelves.at(*pointer)
        self.shelves.index = self.shelves.index if over is None else over

    def _hold(self, cell: Cell) -> None:
        self.held = cell
        self.app.notify("Choose its new place; Enter or a click puts it there, Esc leaves it where it is")

    def back(self) -> None:
        if self.held:
            self.held = self.pointer = None
        else:
            super().back()

    def _drop(self, goal: Cell | None, *, after: bool = False) -> None:
        held, self.held, self.pointer = self.held, None, None
        if held and held.level and not (goal and goal.level is held.level):
            self.do(partial(self._put_level, held.level, goal, after=after))
        elif held and held.episode and goal and goal.episode:
            self.do(partial(packs.move_episode, self.path, held.episode.number, goal.episode.number))

    def _is_after(self, index: int) -> bool:
        """Whether the mouse is over the right half of a cell: what it has lands behind what is there."""
        left, _, w, _ = self.shelves.row_area(index)
        return self.pointer is not None and self.pointer[0] > left + w / 2

    def _landing(self) -> Area | None:
        """Where a mark shows that the level that is held would land."""
        over = self.shelves.at(*self.pointer) if self.pointer else self.shelves.index
        if over is None or not (self.held and self.held.level):
            return None
        goal, index, after = self.cells[over], over, self._is_after(over)
        if not goal.level:
            row = [k for k, each in enumerate(self.cells) if each.episode is goal.episode]
            index, after = next((k for k in row if not (self.cells[k].head or self.cells[k].level)), row[-1]), False
        x, y, w, h = self.shelves.row_area(index)
        return x + w * after - 2, y + 4, 4, h - 8

    def _put_level(self, level: Entry, goal: Cell | None, *, after: bool) -> None:
        file, target = Path(level.named.file), self.path
        if goal is None and self.beside != "none":
            target = next((each.path for each in self.sets if each.key == self.beside and each.path), self.folder)
        if target != self.folder and target not in [each.path for each in self.mine]:
            raise NinjaGameError("that pack cannot be changed: it is the game's own, or a zip")
        name = file.name
        if file.parent != target:
            name = packs.transfer(level.named, target, keep=level.source == "game" or self.folder not in file.parents)
        if (target / INDEX).is_file():
            number = goal.episode.number if goal and goal.episode else None
            if goal and number is None:
                number = packs.new_episode(target, "New episode", self._column())
            row = [each.level for each in self.cells if goal and each.episode is goal.episode and each.level]
            row = [each for each in row if each is not level]
            behind = row[row.index(goal.level) + after :] if goal and goal.level else []
            packs.place(target, name, number, Path(behind[0].named.file).name if behind else "")

    def _handle_mouse(self, event: pygame.Event) -> None:
        dragged = self._dragged
        super()._handle_mouse(event)
        if event.type == pygame.MOUSEBUTTONUP and isinstance(dragged, Rack):
            x, y = self.theme.canvas.logical(event.pos)
            if self.pointer is None:
                dragged.release()
            elif (index := self.shelves.at(x, y)) is not None:
                self.pointer = (x, y)
                self._drop(self.cells[index], after=self._is_after(index))
            elif self.tray.contains(x, y):
                self._drop(None)
            self.held, self.pointer = (self.held if self.pointer is None else None), None
            self.redraw = True

    # --- problems, and what takes time ---

    def _check(self, pack: Pack) -> _Checked:
        known = self.packer.obstacles
        every = problems_of(pack, known)
        to_do = [each for each in every if each.code in packs.MADE_READY and not obstacle_of(pack, each, known)]
        found = [each for each in every if each not in to_do]
        return _Checked(pack, found, to_do, frozenset(pack.files.place(file_of(pack, each)) for each in found))

    @property
    def findings(self) -> list[PackFinding] | None:
        """What is odd about the pack as it is now; None until that is known."""
        checked = self._checked
        return checked.findings if checked and self.pack and checked.pack is self.pack.pack else None

    def problems(self) -> list[Problem]:
        pack = self.pack.pack if self.pack else None
        if pack is None:
            return []
        if self.findings is None:
            self._checked = self._check(pack)
        to_do = [Problem(text, _READY_HINT, to_do=True)] if (text := self._to_do()) else []
        found = [self._problem(pack, each) for each in self.findings or ()]
        return [*found, *to_do, *map(self._accepted, pack.index.accepted)]

    def _to_do(self) -> str:
        """What Make ready will do; "" for nothing."""
        levels, checked = self.pack.levels if self.pack else [], self._checked
        states = [self.state(each) for each in levels]
        known = checked.to_do if checked and self.findings is not None else []
        certify, gold = sum(map(states.count, NOT_CERTIFIED)), [each.code for each in known].count("no-gold-run")
        work = {"certify": (certify, "level"), "measure": (certify + states.count("certified"), "medal time")}
        work["look for all gold in"] = gold, "level"
        parts = [f"{what} {counted(*count)}" for what, count in work.items() if count[0]]
        parts = parts or ["renew the medal times"] * bool(known)
        return f"Make ready will {', '.join(parts[:-1])}{' and ' * (len(parts) > 1)}{parts[-1]}" if parts else ""

    def _entry(self, file: str) -> Entry | None:
        levels = self.pack.levels if self.pack else []
        return next((each for each in levels if each.named.file == str(self.path / file)), None)

    def _problem(self, pack: Pack, finding: PackFinding) -> Problem:
        file = file_of(pack, finding)
        entry, why = self._entry(level_of(pack, file)), obstacle_of(pack, finding, self.packer.obstacles)
        # Files count columns and episodes from 0; what is behind the semicolon is about files.
        said = re.sub(r"((?:column|episode) )(\d+)", lambda n: f"{n[1]}{int(n[2]) + 1}", finding.text.partition(";")[0])
        text = said[:1].upper() + said[1:]
        go: Callable[[], object] | None = self._about if file == INDEX else None
        if finding.code == "no-author":
            go = partial(self._form, 1)
        elif entry:
            known = why or next((each for each in level_findings(entry.named.level) if each.code == finding.code), None)
            go, text = partial(self._edit, entry, known), f"{entry.title}: {finding.text}"
            for other, named in pack.levels.items():
                text = text.replace(f"as {other}", f"as {named.name}")

        def accept(why: str) -> None:
            packs.accept(self.path, file, finding.code, why)

        may = bool(file) and finding.code not in NEVER_ACCEPTED
        asked = partial(self.ask, "Accept this warning: why?", "", accept) if may else None
        missing = missing_run(pack, finding) if why and not self.packer.busy else None
        longer = partial(self.packer.search_longer, self.path, missing) if missing else None
        return Problem(text, why.hint if why else finding.hint, go, asked, search=longer)

    def _accepted(self, accepted: Accepted) -> Problem:
        entry, code = self._entry(accepted.file), accepted.code.replace("-", " ")
        take_back = partial(packs.take_back, self.path, accepted.file, accepted.code)
        text = f"{entry.title if entry else accepted.file}: {code}. Accepted: {accepted.reason}"
        go = partial(self._edit, entry, None) if entry else None
        return Problem(text, "", go, lambda: self.do(take_back), accepted=True)

    def state(self, level: Entry) -> str:
        """How far a level is, in a word: its time where it is measured."""
        known, file = self.states.get(id(level)), Path(level.named.file)
        if known is None:
            beside = (file.parent / certificate_name(file.name, "exit")).is_file()
            if level.pars and (beside or file.parent != self.path):
                known = f"{seconds_text(level.pars.exit)} s"
            else:
                run = self.player.catalogue.author_run(level)
                vain = (level.named.level, "exit") in self.packer.obstacles
                known = "certified" if run else NOT_FOUND if vain else "changed" if beside else "no run yet"
            self.states[id(level)] = known
        return known

    def _ready_or_stop(self) -> None:
        if self.packer.busy:
            self.packer.end()
        else:
            self.packer.start(self.path)

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        packer, (busy, _) = self.packer, self._told
        self._since_read += real_ms
        if packer.busy != busy or len(packer.obstacles) != self._vain:
            # What was searched in vain changes nothing on the disk.
            self._asked = self._checked = None
            self._vain = len(packer.obstacles)
            self.enter()
        elif busy and self._since_read >= RENEW_MS:
            self._since_read = 0
            self._read(news=True)
        if self._told != (packer.busy, packer.text):
            self._told, self.redraw = (packer.busy, packer.text), True
        if self._checks.result is not self._checked and self._checks.idle:
            self._checked, self.redraw = self._checks.result, True

    def leave(self) -> None:
        super().leave()
        self.held = self.pointer = None
        if not (self.packer.busy or self.packer.saved):
            self.packer.text = ""

    # --- picture ---

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme, faint = self.theme, self.theme.palette.faint
        if not (self.pack and self.pack.levels):
            theme.paragraph(surface, _NO_LEVELS if self.pack else _NO_PACK, (36, 360, 560, 90), 13, 20, align="centre")
        packer = self.packer
        whose = f"{shown_text(packer.path.name)}: " * bool(packer.text and packer.path != self.path)
        texts = [whose + packer.text or self._counts()]
        texts += [self._counts()] * bool(packer.text and not (whose or packer.busy))
        place = (36, 524, 720 if packer.busy else 516, 41)
        theme.paragraph(surface, texts, place, 10, 13.5, colour=faint)
        if packer.busy:
            theme.panel(surface, 36, 546, 720, 7)
            theme.canvas.fill_rect(surface, theme.palette.accent, 36, 546, max(1.0, 720 * packer.share), 7, 3)

    def _counts(self) -> str:
        if self.pack is None:
            return ""
        levels, found = self.pack.levels, self.findings
        vain = [self.state(each) for each in levels].count(NOT_FOUND)
        to_do = self._to_do() or (f"{vain} without a run" if vain else "All certified and measured")
        alone = f", {len(self.pack.singles)} in none" if self.pack.singles else ""
        episodes = sum(cell.head for cell in self.cells) - 1
        where = f"{counted(len(levels), 'level')} in {counted(episodes, 'episode')}{alone}"
        open_ones = "Looking for problems" if found is None else counted(len(found), "problem")
        return f"{where}. {to_do}. {open_ones}" if levels else where

    def draw_widgets(self, surface: pygame.Surface) -> None:
        super().draw_widgets(surface)
        if landing := self._landing():
            self.theme.canvas.fill_rect(surface, self.theme.palette.accent, *landing, 2)
        if self.held and self.pointer:
            x, y = self.pointer
            if self.held.level:
                self.thumbnails.draw(surface, self.held.level, x + 6, y + 6, 60)
            else:
                self.theme.row(surface, (x + 6, y + 6, 2 * WIDE, HIGH / 4), chosen=True, focused=True)

    def draw_cell(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        rack = self.tray if area[0] >= self.tray.area[0] else self.shelves
        cell = (self.side if rack is self.tray else self.cells)[index]
        x, y, w, h = area
        inner = (x + 2, y + 2, w - 4, h - 4)
        chosen = index == rack.index
        focused = focused or (chosen and rack is self.shelves and self.pointer is not None)
        if cell.head:
            self._draw_head(surface, theme, cell, inner)
        elif cell.level:
            theme.row(surface, inner, chosen=chosen and focused, focused=focused)
            self.thumbnails.draw(surface, cell.level, x + 6, y + 6, WIDE - 12)
            theme.text(surface, shown_text(cell.level.title), x + 6, y + 73, size=9.5, width=w - 12)
            self._draw_state(surface, theme, cell.level, x + 6, y + 88, w - 12)
        if chosen and focused:
            theme.canvas.frame_rect(surface, theme.palette.accent, *inner, 2.5, 4)
        elif not (cell.head or cell.level):
            theme.canvas.frame_rect(surface, theme.palette.panel_edge, *inner, 1, 4)

    def _draw_state(self, surface: pygame.Surface, theme: Theme, level: Entry, x: float, y: float, w: float) -> None:
        palette, state = theme.palette, self.state(level)
        done = level.pars and state not in NOT_CERTIFIED
        colour = palette.good if done else palette.bad if state in ("changed", NOT_FOUND) else palette.faint
        theme.text(surface, state, x, y, size=8.5, colour=colour, width=w - 14)
        if done and level.pars and level.pars.gold is not None:
            draw_all_gold(surface, theme, x + w - 5, y + 5, 8)
        if self._checked and level.named.file in self._checked.places:
            theme.text(surface, "!", x + w - 16, y - 1, size=11, bold=True, colour=palette.bad, align="centre")

    def _draw_head(self, surface: pygame.Surface, theme: Theme, cell: Cell, area: Area) -> None:
        x, y, w, h = area
        theme.panel(surface, *area)
        if cell.episode is None:
            theme.paragraph(surface, ["New episode..."], (x + 6, y + h / 2 - 8, w - 12, 24), 10.5, 13)
            return
        number = cell.episode.number
        column = number // EPISODES_PER_COLUMN
        names = self.pack.columns if self.pack else ()
        theme.text(surface, f"Episode {number + 1}", x + 6, y + 6, size=9, colour=theme.palette.faint, width=w - 12)
        theme.paragraph(surface, [shown_text(cell.episode.name)], (x + 6, y + 21, w - 12, 42), 11, 14)
        if column < len(names):
            place, faint = (x + 6, y + 72, w - 12, 26), theme.palette.faint
            theme.paragraph(surface, [f"in {shown_text(names[column])}"], place, 9, 12, colour=faint)
