"""The player's packs: episodes as rows of levels, to drag and to make; a pack is made ready to share."""

from __future__ import annotations

import webbrowser
from collections.abc import Callable, Sequence
from functools import partial
from math import inf
from pathlib import Path

import pygame

from ninja_game.editor import packs
from ninja_game.editor.packs import ReadyPack, missing_run
from ninja_game.errors import NinjaGameError, reason
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.files.user_folder import DAILY, LEVELS, short_path
from ninja_game.formats.links import link_kind
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN, LEVELS_PER_EPISODE, NEVER_ACCEPTED, EpisodeIndex
from ninja_game.formats.pack.pack import INDEX, RECEIVED, Pack
from ninja_game.levels.episodes import GAME, Entry, EpisodeSet
from ninja_game.levels.findings import Finding, PackFinding
from ninja_game.play.app import App
from ninja_game.play.clipboard import copy_link, pasted_text
from ninja_game.play.level.screen import play_level
from ninja_game.play.menus.episodes import PREVIEW, EpisodeGrid
from ninja_game.play.menus.menu_screen import CANCEL, FormPanel, Menu, MenuRow, Question, ask_received, ask_text
from ninja_game.play.menus.pack_list import PackList
from ninja_game.play.menus.pack_shelves import HIGH, WIDE, Marks, PackCell, Rack
from ninja_game.play.menus.packer import NOT_CERTIFIED, NOT_FOUND, PackStatus, packer_of
from ninja_game.play.menus.problems import Problem, ProblemsScreen
from ninja_game.play.menus.replays import watch
from ninja_game.play.menus.thumbnails import ThumbnailScreen
from ninja_game.runs.packs import level_of
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.input.keys import chord
from ninja_game.ui.list_view import BAR
from ninja_game.ui.widgets import Button, Choice, Widget

DELETED = "deleted"
"""The folder of deleted packs among the player's files."""

_NO_PACK = (
    "A pack is a folder with your levels in episodes.",
    "New pack makes one; levels that you have made can be dragged into it then.",
)
_NO_LEVELS = (
    "Click the episode, or a free place, twice: New level makes one here.",
    "Or choose at the right where your levels are, and drag them into the places.",
    "Make ready then certifies all, and gives you a zip and a link to share.",
)

_DRAG = "Drag a level or an episode; Enter or a second click: what can be done. Ctrl or Shift and a click: several"

_MOVES = "Let go where it is to be. The colours of a level go by its place in the pack"

_STOPS = "It can be stopped at any time: what was found is kept."

Edit = Callable[[Entry, Finding | None], object]


class PackScreen(ThumbnailScreen):
    """``pack``: the shown one. ``held``: what is dragged; ``pointer``: the mouse's place during a drag, else None.

    ``edit``: opens a level in the editor, at a finding.
    """

    title = "Packs"

    def __init__(self, app: App, edit: Edit) -> None:
        super().__init__(app)
        self._edit = edit
        self.pack: EpisodeSet | None = None
        self.mine: list[EpisodeSet] = []
        self.sets: list[EpisodeSet] = []
        self.beside = "none"
        self.held: PackCell | None = None
        self.chosen: Widget | None = None
        self.pointer: tuple[float, float] | None = None
        self.marked = Marks()
        self.packer = packer_of(app)
        self.packer.desk = self
        self.status = PackStatus(self.packer, self.player.catalogue)
        rack = partial(Rack, status=self.status, thumbnails=self.thumbnails, marked=self.marked, pull=self._pull)
        self.shelves = rack((36, 96, 6 * WIDE + BAR + 4, 4 * HIGH), 6, choose=self._choose)
        self.tray = rack((622, 126, WIDE + BAR + 24, 4 * HIGH - 28), 1, choose=self._choose)
        self._told: tuple[bool, int, str, str] = False, 0, "", ""

    @property
    def path(self) -> Path:
        return (self.pack and self.pack.path) or self.folder

    @property
    def folder(self) -> Path:
        return self.player.folder / LEVELS

    # --- what there is ---

    def _read(self, shown: Path | None = None, *, news: bool = False) -> None:
        """Read all packs from the disk; show this one, or the one before. ``news``: only if that has changed."""
        before, catalogue = shown or self.path, self.player.catalogue
        catalogue.problems.clear()
        self.sets = catalogue.packs()
        self.mine = [pack for pack in self.sets if pack.changeable and pack.path and pack.path.name != DAILY]
        now = next((pack for pack in self.mine if pack.path == before), None)
        if not (news and now is self.pack):
            self._show(now)

    def _show(self, pack: EpisodeSet | None) -> None:
        self.pack = pack = pack or next(iter(self.mine), None)
        self.status.show(pack)
        if not self.packer.busy:
            self.packer.follow(next((shelf.pack for shelf in self.mine if shelf.path == self.packer.path), None))
        cells: list[PackCell] = []
        if pack and pack.pack:
            for episode in pack.pack.index.episodes:
                levels = pack.episodes[episode.number].levels if episode.number in pack.episodes else ()
                cells += [PackCell(episode, head=True), *(PackCell(episode, level) for level in levels)]
                cells += [PackCell(episode)] * (LEVELS_PER_EPISODE - len(levels))
            cells += [PackCell(None, head=True), *[PackCell(None)] * LEVELS_PER_EPISODE]
        entries: Sequence[Entry] = pack.singles if pack else ()
        if self.beside == "yours":
            entries = self.player.catalogue.own()
        elif self.beside != "none":
            entries = [entry for shelf in self.sets if shelf.key == self.beside for entry in shelf.levels]
        goals = {"none": "take it out of its episode", "yours": "put it into your folder"}
        self.tray.empty = f"Drag a level here to {goals.get(self.beside, 'put it into this pack')}"
        self.shelves.show(cells)
        self.tray.show([PackCell(None, entry) for entry in entries])
        self.marked &= {level.named.file for level in self._levels()}
        self.redraw = True

    def enter(self) -> None:
        self._read()
        super().enter()

    def _pack_now(self) -> Pack | None:
        """The shown pack as it is on the disk; None if its folder is gone, and the screen shows what there is."""
        path = self.path
        self.enter()
        return self.pack.pack if self.pack and self.pack.path == path else None

    def build(self) -> Sequence[Widget]:
        app = self.app
        names = [(pack.pack.index.title if pack.pack and pack.received else pack.name, pack.key) for pack in self.mine]
        have = self.pack and self.pack.pack
        key = self.pack.key if self.pack else ""
        chosen = self.chosen = Choice((36, 60, 164, 28), "", names, lambda: key, self._choose_pack)
        chosen.more = lambda: app.push(PackList(app, self.mine, lambda pack: self._choose_pack(pack.key)))
        received = bool(self.pack and self.pack.received)
        whose = f"{have.index.title}{', received' if received else ''}, in the folder {self.path.name}" if have else ""
        chosen.hint = f"{whose}. Enter, or a click on the name: all your packs"
        tray = [("In no episode", "none"), ("Your folder", "yours")]
        tray += [(pack.name if pack.key else "The game's own", pack.key) for pack in self.sets if pack is not self.pack]
        tray_choice = Choice((622, 96, 134, 26), "", tray, lambda: self.beside, self._choose_tray)
        hint = "Certify all, measure par times, look for problems; zip and link. Only what changed is done again"
        undo = Button((206, 60, 44, 28), "Undo", lambda: self.do(self._undo), size=10)
        steps = self.packer.steps
        undo.enabled, undo.hint = bool(steps), f"Ctrl+Z: {steps[-1].what}" if steps else ""
        new = Button((256, 60, 76, 28), "New pack...", self._new_pack, size=10)
        paste = Button((338, 60, 68, 28), "Paste link", self._paste, size=10)
        paste.hint = "Ctrl+V: the pack whose link is in the clipboard becomes one of yours"
        about = Button(
            (412, 60, 68, 28), "More...", self._about, size=10, hint="Preview, name, copy or delete the pack"
        )
        view = self.view = Button((486, 60, 60, 28), "Play" if received else "Preview", self._view, size=10)
        view.hint = f"{PREVIEW}: what whoever pastes the link sees; nothing is kept"
        if received and have:
            view.hint = shown_text(f"{have.index.title}. {have.index.comment}", 200)
        view.enabled = bool(self.pack and self.pack.episodes)
        problems = Button((552, 60, 66, 28), "Problems", self._show_problems, size=10)
        begin = ("Stop", self.packer.end) if self.packer.busy else ("Make ready", self._make_ready)
        make = Button((624, 60, 132, 28), *begin, hint=hint)
        link = Button((662, 525, 94, 24), "Copy the link", self._copy_link, size=10)
        link.hint = "Whoever opens it, or pastes it in Levels > Packs, gets the pack"
        folder = Button((562, 525, 94, 24), "Open the folder", self._open_folder, size=10, hint="Where the zip is")
        if not have:
            return [new, paste, undo] if steps else [new, paste]
        share = [folder, link] if self._saved else [link]
        first = [self.shelves, chosen, undo, new, paste, about, view, problems, make, tray_choice, self.tray]
        return first if self.packer.busy else [*first, *share]

    def _view(self) -> None:
        """Show the episodes of the pack; those of the player's own packs as a new player sees them."""
        if self.pack:
            newcomer = None if self.pack.received else self.player.newcomer()
            self.app.push(EpisodeGrid(self.app, self.pack.key, newcomer))

    @property
    def _saved(self) -> Path | None:
        """The zip that was just made of this pack."""
        return self.packer.saved if self.packer.path == self.path else None

    def _open_folder(self) -> None:
        if self._saved and not webbrowser.open(self._saved.parent.as_uri()):
            self.app.notify(f"Nothing here opens folders: it is {short_path(self._saved.parent)}")

    def _copy_link(self) -> None:
        """Copy it; of a pack of one's own, first ask whether levels that are not certified are to go along."""
        pack = self._pack_now()
        if not (self.pack and pack):
            return
        copy = partial(copy_link, self.app, pack.files.link, title=self.pack.name)
        levels = [] if self.pack.received else self.pack.levels
        without = [level for level in levels if self.status.state(level) in (*NOT_CERTIFIED, NOT_FOUND)]
        rows: list[MenuRow] = [
            ("Make ready first", self._make_ready, "Certifies them, and gives the link"),
            ("Copy all the same", copy, "Whoever gets it is not told whether they can be passed"),
            CANCEL,
        ]
        if without:
            title = f"The link has {counted(len(without), 'level')} without certificate"
            self.app.push(Menu(self.app, title, rows))
        else:
            copy()

    def _make_ready(self) -> None:
        path, name = self.path, self.player.settings.name

        def sign(author: str) -> None:
            if author.strip():
                self.app.know_author("", author)
                self.do(lambda: packs.describe(path, {"author": author.strip()}), "Author of the pack")
            self.packer.start(path)

        if self.pack and self.pack.pack and self.pack.pack.index.is_signed:
            self.packer.start(path)
        else:
            ask_text(self.app, "Who made this pack?", "Author", name, "Make ready", sign, 40)

    def _choose_pack(self, key: str) -> None:
        self._show(next(pack for pack in self.mine if pack.key == key))
        super().enter()

    def _choose_tray(self, key: str) -> None:
        self.beside = key
        self._show(self.pack)

    # --- what can be done ---

    def do(self, action: Callable[[], object], what: str = "") -> None:
        """Change something on the disk, and show the result. ``what``: its name for undo; "" is no step."""
        try:
            if what and not self.packer.steps.do(what, action):
                return
            if not what:
                action()
        except (NinjaGameError, OSError) as error:
            self.app.notify(reason(error))
        if self.app.top is not self:
            self._read()
        self.app.top.enter()

    def change(self, action: Callable[[], object], what: str) -> None:
        """Change the shown pack; for a received one ask first whether to change a copy."""
        if not (self.pack and self.pack.pack and self.pack.received):
            self.do(action, what)
            return
        pack = self.pack.pack

        def own() -> None:
            packs.make_own(pack.files.path)
            action()

        ask_received(self.app, pack.index.title, partial(self._copy, pack), lambda: self.do(own, what))

    def _copy(self, pack: Pack) -> None:
        def copy() -> None:
            self._read(packs.copy_pack(pack, self.folder, f"{pack.name} copy"))
            self.app.notify("This copy is yours to change")

        self.do(copy, "Copy")

    def _undo(self) -> None:
        self.app.notify(f"Undone: {self.packer.steps.undo()}")

    def ask(self, title: str, text: str, action: Callable[[str], object]) -> None:
        what = shown_text(title.partition(":")[0])
        ask_text(self.app, title, "", text, "OK", lambda typed: self.change(lambda: action(typed), what), 60)

    def _new_pack(self) -> None:
        def make(name: str, author: str = self.player.settings.name) -> None:
            self.app.know_author("", author)
            path = packs.new_pack(self.folder, name, author.strip())
            self.beside = "yours" if self.player.catalogue.own() else "none"
            self._read(path)

        fields, step = [("Name", "My pack", 60)], "New pack"
        if not self.player.settings.name:
            fields.append(("Author", "", 40))
        self.app.push(FormPanel(self.app, step, fields, "OK", lambda texts: self.do(lambda: make(*texts), step)))

    def _paste(self) -> None:
        def take() -> None:
            text = pasted_text()
            if link_kind(text) != "pack":
                raise NinjaGameError("there is no link of a pack in the clipboard: copy all of it first")
            self._take_in(Pack(Path(f"#{text.partition('#')[2]}")))

        self.do(take)

    def _take_in(self, pack: Pack) -> None:
        """Install a received pack among the player's, instead of an older version if the player agrees."""

        def receive(over: Pack | None = None) -> None:
            def copy() -> None:
                said = f": {packs.news(over, pack)}" if over else " is among your packs now: Enter plays it"
                self._read(packs.copy_pack(pack, self.folder, pack.name, received=True, over=over))
                self.app.notify(f"{shown_text(pack.name)}{said}")

            self.do(copy, f"Update {pack.name}" if over else "Paste link")
            self.focus_on(self.view)

        name, author = shown_text(pack.name), pack.index.author
        older = [each.pack for each in self.mine if each.pack and each.received and each.pack.name == pack.name]
        if there := next((each for each in self.mine if each.pack and packs.same_pack(pack, each.pack)), None):
            self._read(there.path)
            rows: list[MenuRow] = [
                ("Play it", self._view, "") if there.received else ("Show it as received", self._view, PREVIEW),
                ("Receive it once more", receive, "Beside this one"),
                CANCEL,
            ]
            self.app.push(Menu(self.app, f"{shown_text(there.name)} is among your packs already", rows))
        elif over := next((each for each in older if each.index.author == author), None):
            rows = [("Update it", partial(receive, over), packs.news(over, pack)), ("Keep both", receive, ""), CANCEL]
            self.app.push(Menu(self.app, f"You have {name} {over.index.version or 'in another version'}", rows))
        else:
            receive()

    def handle(self, event: InputEvent) -> None:
        if event.raw.type == pygame.KEYDOWN and chord(event.raw) == "ctrl+v":
            self._paste()
        elif event.raw.type == pygame.DROPFILE:
            self.do(lambda: self._take_in(Pack(Path(event.raw.file))))
        elif event.raw.type == pygame.KEYDOWN and chord(event.raw) == "ctrl+z":
            self.do(self._undo)
        elif event.raw.type == pygame.KEYDOWN and chord(event.raw) == "ctrl+a":
            self.marked |= {level.named.file for level in self._levels(self.focus)}
            self.redraw = True
        elif event.raw.type == pygame.KEYDOWN and chord(event.raw) == "delete":
            if isinstance(self.focus, Rack) and self.focus.cells and (away := self._away(self.focus.chosen)):
                away()
        else:
            super().handle(event)

    def _form(self, pack: Pack, first: int = 0) -> None:
        """Ask for the texts of the index; the field number ``first`` has the focus."""
        index, path = pack.index, pack.files.path
        keys = ("name", "author", "version", "comment")
        fields = [(key.capitalize(), getattr(index, key), 200) for key in keys]

        def describe(texts: list[str]) -> None:
            self.app.know_author(index.author, texts[1])
            self.change(lambda: packs.describe(path, dict(zip(keys, texts, strict=True))), "About the pack")

        form = FormPanel(self.app, "About the pack", fields, "OK", describe)
        self.app.push(form)
        form.focus = form.widgets[first]

    def _about(self) -> None:
        pack = self._pack_now()
        if not (self.pack and pack):
            return
        key, name, own = self.pack.key, self.pack.name, not self.pack.received
        empty = not pack.episodes
        busy = self.packer.busy and self.packer.path == self.path
        gone = "It is being made ready" if busy else "It goes to the folder deleted, and Undo brings it back"
        without = "No episode has levels" if empty else ""
        rows: list[MenuRow] = [
            ("Play it", None if empty else lambda: self.app.push(EpisodeGrid(self.app, key)), without),
            *[("Show it as received", None if empty else self._view, without or PREVIEW)] * own,
            ("Name, author, version...", lambda: self._form(pack), ""),
            ("Copy of the pack", lambda: self._copy(pack), ""),
            ("Delete the pack...", None if busy else lambda: self._delete(pack, name), gone),
            CANCEL,
        ]
        self.app.push(Menu(self.app, pack.name, rows))

    def _delete(self, pack: Pack, name: str) -> None:
        def delete() -> None:
            there = packs.bin_pack(pack.files.path, self.player.folder / DELETED)
            self.app.notify(f"{shown_text(name)} is in the folder {there.relative_to(self.player.folder)} now")

        title = f"Delete {shown_text(name)} with its {counted(len(pack.files.levels), 'level')}?"
        hint = f"All goes to the folder {DELETED}; Undo brings it back"
        step = partial(self.do, delete, f"Delete {shown_text(name)}")
        self.app.push(Question(self.app, title, "Delete it", step, hint))

    def _choose(self, cell: PackCell) -> None:
        if self.held:
            self._drop(cell if self.focus is self.shelves else None)
        elif cell.level:
            self._level_menu(cell)
        elif cell.episode is None:
            self.ask("New episode: name", self._next_name, partial(packs.new_episode, self.path, column=self._column()))
        else:
            self._episode_menu(cell.episode)

    @property
    def _next_name(self) -> str:
        """The default name of a new episode."""
        return f"Episode {sum(cell.head for cell in self.shelves.cells)}"

    def _column(self) -> int:
        numbers = [cell.episode.number for cell in self.shelves.cells if cell.episode]
        return max(numbers, default=0) // EPISODES_PER_COLUMN

    def _level_menu(self, cell: PackCell) -> None:
        level, episode = cell.level, cell.episode
        if level is None:
            return
        file, levels = Path(level.named.file), self._taken(level)
        rename, edit = partial(packs.rename_level, file), partial(self._edit, level, None)
        run, title = self.player.catalogue.author_run(level), _called(levels)

        def copy() -> None:
            names = [packs.duplicate(self.path, each.named) for each in levels]
            packs.place(self.path, names, episode.number if episode else None)

        def play() -> None:
            if why := play_level(self.app, level):
                self.app.notify(why)

        rows: list[MenuRow] = []
        if len(levels) == 1:
            rows = [
                ("Edit", partial(self.change, edit, "Edit") if file.parent == self.path else edit, ""),
                ("Play", play, ""),
                ("Watch the run", partial(watch, self.app, [run]) if run else None, "" if run else "None is known yet"),
            ]
            if file.parent == self.path:
                rows.append(("Rename...", lambda: self.ask(f"Rename {level.named.name}", level.named.name, rename), ""))
        rows.append(("Move...", lambda: self._hold(cell), ""))
        if all(Path(each.named.file).parent == self.path for each in levels):
            rows.append(("Copy", lambda: self.change(copy, f"Copy {title}"), "Another level like it"))
        if away := self._away(cell):
            rows.append(("Take out", away, "Into no episode") if episode else ("Delete", away, "Undo brings it back"))
        self.app.push(Menu(self.app, title, [*rows, CANCEL]))

    def _away(self, cell: PackCell) -> Callable[[], object] | None:
        """Takes a level out of its episode, or deletes one of the player's in none; None for any other level."""
        levels = self._taken(cell.level) if cell.level else []
        title = _called(levels)
        if levels and all(Path(each.named.file).parent == self.path and each.episode for each in levels):
            names = [Path(each.named.file).name for each in levels]
            return lambda: self._set_aside(partial(packs.place, self.path, names, None), title)
        if not levels or self.beside not in ("none", "yours") or not all(each.named.ascii for each in levels):
            return None

        def delete() -> None:
            for each in levels:
                packs.transfer(each.named, self.player.folder / DELETED, keep=False)
            self.app.notify(f"{title}: in the folder {DELETED} now; Ctrl+Z brings back")

        return lambda: (self.do if self.beside == "yours" else self.change)(delete, f"Delete {title}")

    def _episode_menu(self, episode: EpisodeIndex) -> None:
        number, path, title = episode.number, self.path, episode.name or f"Episode {episode.number + 1}"
        column = number // EPISODES_PER_COLUMN
        columns = list(self.pack.columns if self.pack else ())
        columns += [""] * (column + 1 - len(columns))

        def level(name: str) -> None:
            file = packs.new_level(path, name, self.player.settings.name)
            packs.place(path, [file], number)
            self._read()
            if entry := self._entry(file):
                self._edit(entry, None)

        def sort() -> None:
            levels = [cell.level for cell in self.shelves.cells if cell.level and cell.episode is episode]
            levels.sort(key=lambda each: (each.pars and each.pars.difficulty) or inf)
            names = [Path(each.named.file).name for each in levels]
            self.change(partial(packs.place, path, names, number), f"Sort {title}")

        def name_column(name: str) -> None:
            packs.describe(path, {"columns": [*columns[:column], name, *columns[column + 1 :]]})

        rename, remove = partial(packs.rename_episode, path, number), partial(packs.remove_episode, path, number)
        begin = partial(packs.new_episode, path, column=self._column() + 1)
        rows: list[MenuRow] = [
            ("New level...", lambda: self.ask("New level: its name", "New level", level), "Made, and opened"),
            ("Rename...", lambda: self.ask(f"Rename {episode.name}", episode.name, rename), ""),
            ("Move...", lambda: self._hold(PackCell(episode, head=True)), ""),
            ("Sort by difficulty", sort, "Easiest first, those not measured last"),
            ("Name of the column...", lambda: self.ask("Name of the column", columns[column], name_column), ""),
            ("Begin a column...", lambda: self.ask("Column: first episode", self._next_name, begin), "Beside these"),
            ("Remove the episode", lambda: self._set_aside(remove, title), "Its levels stay, beside the others"),
            CANCEL,
        ]
        self.app.push(Menu(self.app, title, rows))

    def _set_aside(self, action: Callable[[], object], what: str) -> None:
        """Take levels out of their episode, and show them in their new place."""
        self.beside = "none"
        self.change(action, f"Take out {shown_text(what)}")

    # --- several at once ---

    def _levels(self, rack: Widget | None = None) -> list[Entry]:
        """The visible levels, in order, of one row or of both."""
        racks = [each for each in (self.shelves, self.tray) if rack in (None, each)]
        return [cell.level for each in racks for cell in each.cells if cell.level]

    def _taken(self, level: Entry) -> list[Entry]:
        """The levels that an action on this one is for."""
        return self.marked.together(level, self._levels())

    def _mark(self, x: float, y: float) -> bool:
        """Whether a click marks levels."""
        rack = self._at(x, y)
        index = rack.at(x, y) if isinstance(rack, Rack) else None
        if not isinstance(rack, Rack) or index is None or not self.marked.click(rack, index):
            return False
        self.focus, rack.index, self.redraw = rack, index, True
        return True

    # --- moving ---

    def _pull(self, cell: PackCell, pointer: tuple[float, float]) -> None:
        """Begin or continue to drag a cell."""
        if self.held is None and (cell.level or (cell.head and cell.episode)):
            self.held = cell
        self.pointer = pointer if self.held else None
        if (over := self.shelves.at(*pointer)) is not None:
            self.focus, self.shelves.index = self.shelves, over

    def _hold(self, cell: PackCell) -> None:
        self.held = cell
        self.app.notify("Choose its new place; Enter or a click puts it there, Esc leaves it where it is")

    def back(self) -> None:
        if self.held:
            self.held = self.pointer = None
        elif self.marked:
            self.marked.clear()
        else:
            super().back()

    def _drop(self, goal: PackCell | None, *, after: bool = False) -> None:
        held, self.held, self.pointer = self.held, None, None
        levels = self._taken(held.level) if held and held.level else []
        if levels and not (goal and goal.level in levels and len(levels) == 1):
            do = self.do if goal is None and self.beside != "none" else self.change
            do(partial(self._put_levels, levels, goal, after=after), f"Move {_called(levels)}")
        elif held and held.episode and goal and goal.episode:
            numbers = held.episode.number, goal.episode.number
            self.change(partial(packs.move_episode, self.path, *numbers), f"Move episode {numbers[0] + 1}")

    def _is_after(self, index: int) -> bool:
        """Whether the mouse is over the right half of a cell: a dropped level lands behind that cell."""
        left, _, w, _ = self.shelves.row_area(index)
        return self.pointer is not None and self.pointer[0] > left + w / 2

    def _landing(self) -> tuple[int, bool] | None:
        """The cell beside which the dragged level would land, and whether behind it."""
        over = self.shelves.at(*self.pointer) if self.pointer else self.shelves.index
        if over is None or not (self.held and self.held.level):
            return None
        cells, index, after = self.shelves.cells, over, self._is_after(over)
        if not cells[over].level:
            row = [k for k, cell in enumerate(cells) if cell.episode is cells[over].episode]
            index, after = next((k for k in row if not (cells[k].head or cells[k].level)), row[-1]), False
        return index, after

    def _put_levels(self, levels: Sequence[Entry], goal: PackCell | None, *, after: bool) -> None:
        target = self.path
        if goal is None and self.beside != "none":
            target = next((pack.path for pack in self.sets if pack.key == self.beside and pack.path), self.folder)
        if target != self.folder and target not in [pack.path for pack in self.mine]:
            raise NinjaGameError("that pack cannot be changed: it is the game's own, or a zip")
        if target != self.path and (target / RECEIVED).exists():
            raise NinjaGameError("that pack was received, and stays as it is")
        names: list[str] = []
        for level in levels:
            file = Path(level.named.file)
            others = level.source == GAME or self.folder not in file.parents or (file.parent / RECEIVED).exists()
            names.append(file.name if file.parent == target else packs.transfer(level.named, target, keep=others))
        if (target / INDEX).is_file():
            number = goal.episode.number if goal and goal.episode else None
            if goal and number is None:
                number = packs.new_episode(target, self._next_name, self._column())
            row = [cell.level for cell in self.shelves.cells if goal and cell.episode is goal.episode and cell.level]
            behind = row[row.index(goal.level) + after :] if goal and goal.level else []
            before = (Path(entry.named.file).name for entry in behind if entry not in levels)
            packs.place(target, names, number, next(before, ""))

    def _handle_mouse(self, event: pygame.Event) -> None:
        if event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_RIGHT and not self.held:
            place = self.theme.canvas.logical(event.pos)
            widget = self._at(*place)
            if widget and (widget is self.chosen or (isinstance(widget, Rack) and widget.click(*place))):
                self.focus_on(widget)
                (self._about if widget is self.chosen else widget.confirm)()
                return
        left = event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_LEFT and not self.held
        if left and self._mark(*self.theme.canvas.logical(event.pos)):
            return
        dragged = self._dragged
        super()._handle_mouse(event)
        if event.type == pygame.MOUSEBUTTONUP and isinstance(dragged, Rack):
            x, y = self.theme.canvas.logical(event.pos)
            if self.pointer is None:
                dragged.release()
            elif (index := self.shelves.at(x, y)) is not None:
                self.pointer = (x, y)
                self._drop(self.shelves.cells[index], after=self._is_after(index))
            elif self.tray.contains(x, y):
                self._drop(None)
            self.held, self.pointer = (self.held if self.pointer is None else None), None
            self.redraw = True

    # --- problems, and what takes time ---

    def problems(self) -> list[Problem]:
        self._read(news=True)
        pack = self.pack.pack if self.pack else None
        if pack is None:
            return []
        checked = self.status.checked = self.status.now or self.status.check(pack)
        rows = [self._problem(pack, finding) for finding in checked.findings]
        to_do = [Problem(text, _STOPS, to_do=True)] if (text := self.status.to_do()) else []
        return [*rows, *to_do]

    def _entry(self, file: str) -> Entry | None:
        levels = self.pack.levels if self.pack else []
        return next((entry for entry in levels if entry.named.file == str(self.path / file)), None)

    def _problem(self, pack: Pack, finding: PackFinding) -> Problem:
        file, code = finding.file, finding.code
        entry = self._entry(level_of(pack, file))
        values = {name: _as_seen(pack, value) for name, value in finding.values.items()}
        text = finding.text_with(values)
        text = f"{entry.title}: {text}" if entry else text[:1].upper() + text[1:]
        go: Callable[[], object] | None = self._about if file == INDEX else None
        if code == "no-author":
            go = partial(self._form, pack, 1)
        elif entry:
            go = partial(self.change, partial(self._edit, entry, finding.odd), "Edit")
        if finding.reason:
            take_back = partial(packs.take_back, self.path, file, code)
            text = f"{text}. Accepted: {finding.reason}"
            return Problem(text, "", go, lambda: self.change(take_back, "Take it back"), accepted=True)

        def accept(why: str) -> None:
            packs.accept(self.path, file, code, why)

        may = bool(file) and code not in NEVER_ACCEPTED
        accept_it = partial(self.ask, "Accept this warning: why?", "", accept) if may else None
        missing = missing_run(pack, finding) if finding.sought and not self.packer.busy else None
        longer = partial(self.packer.search_longer, self.path, missing) if missing else None
        return Problem(text, finding.hint, go, accept_it, search=longer)

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        packer, before = self.packer, self._told
        self._told = now = packer.busy, len(packer.obstacles), packer.text, self.app.notice
        if now[:2] != before[:2]:
            self.enter()
        elif now != before:
            # A notice may be about a certificate that a search of the editor has found.
            self._read(news=now[3] in ("", before[3]))
        if packer.open_problems and packer.waited_for:
            self._ask_about(packer.open_problems)
        self.redraw = self.status.update() or now != before or self.redraw

    def _show_problems(self) -> None:
        self.app.push(ProblemsScreen(self.app, self.problems))

    def _ask_about(self, ready: ReadyPack) -> None:
        self.packer.open_problems = None
        rows: list[MenuRow] = [
            ("Show the problems", self._show_problems, "Make ready asks again"),
            ("Zip and link all the same", lambda: self.packer.publish(ready), ""),
            CANCEL,
        ]
        title = f"{shown_text(ready.pack.name)}: {counted(len(ready.problems), 'open problem')}"
        self.app.push(Menu(self.app, title, rows, unasked=True))

    def leave(self) -> None:
        super().leave()
        self.held = self.pointer = None
        if not self.packer.busy:
            self.packer.left()

    # --- picture ---

    def draw_frame(self, surface: pygame.Surface) -> None:
        self.shelves.hint = self.tray.hint = _MOVES if self.held else _DRAG
        super().draw_frame(surface)
        theme, faint = self.theme, self.theme.palette.faint
        if not (self.pack and self.pack.levels):
            theme.paragraph(surface, _NO_LEVELS if self.pack else _NO_PACK, (36, 360, 560, 90), 13, 20, align="centre")
        packer = self.packer
        texts = [packer.text or self.status.counts()]
        if packer.text and packer.path != self.path:
            texts = [f"{shown_text(packer.path.name)}: {packer.text}"]
        elif packer.text and not packer.busy:
            texts.append(self.status.counts())
        if self._saved and packer.text.startswith("Saved"):
            texts.append("Send either: a link is pasted, a zip dropped, in Levels > Packs")
        place = (36, 524, 720 if packer.busy else 516, 41)
        theme.paragraph(surface, texts, place, 10, 13.5, colour=faint)
        if packer.busy and packer.share is not None:
            theme.panel(surface, 36, 546, 720, 7)
            theme.canvas.fill_rect(surface, theme.palette.accent, 36, 546, max(1.0, 720 * packer.share), 7, 3)

    def draw_widgets(self, surface: pygame.Surface) -> None:
        landing, held = self._landing(), self.held.level if self.held else None
        lifted = self._taken(held) if held and self.pointer else []
        self.shelves.lifted = self.tray.lifted = {each.named.file for each in lifted}
        self.shelves.gap = landing[0] + landing[1] if landing and self.pointer else 0
        super().draw_widgets(surface)
        if self.held and self.pointer:
            x, y = self.pointer
            if held:
                self.thumbnails.draw(surface, held, x + 6, y + 6, 60)
                if len(lifted) > 1:
                    self.theme.text(surface, _called(lifted), x + 36, y + 54, size=11, bold=True, align="centre")
            else:
                self.theme.row(surface, (x + 6, y + 6, 2 * WIDE, HIGH / 4), chosen=True, focused=True)
        if landing:
            x, y, w, h = self.shelves.row_area(landing[0])
            place = x + w * landing[1] - 2 + self.shelves.shift(self.shelves.gap) / 2, y + 4, 4, h - 8
            self.theme.canvas.fill_rect(surface, self.theme.palette.accent, *place, 2)


def _as_seen(pack: Pack, value: object) -> object:
    """A value of a finding as the desk shows it: files count columns and episodes from 0, and levels have names."""
    if isinstance(value, int):
        return value + 1
    named = pack.levels.get(value) if isinstance(value, str) else None
    return named.name if named else value


def _called(levels: Sequence[Entry]) -> str:
    return shown_text(levels[0].title) if len(levels) == 1 else counted(len(levels), "level")
