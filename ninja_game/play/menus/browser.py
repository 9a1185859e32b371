"""The level browser: the game's single levels and the player's own files, searched, sorted, looked at, played."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import pygame

from ninja_game.errors import NinjaGameError, reason
from ninja_game.files.reading import file_stamp, read_bytes
from ninja_game.files.shown_text import name_problem
from ninja_game.files.tree import Tree
from ninja_game.files.user_folder import DAILY, free_path
from ninja_game.formats.load import load_levels
from ninja_game.formats.pack.pack import RECEIVED, is_pack
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import GAME, YOURS, Entry, author_name
from ninja_game.play.app import App
from ninja_game.play.clipboard import copy_level_link
from ninja_game.play.level.screen import play_level
from ninja_game.play.menu_screen import Action, ask_received
from ninja_game.play.menus.episodes import draw_look
from ninja_game.play.menus.problems import Problem, file_problems, problems_button
from ninja_game.play.panels.replays import watch_replays
from ninja_game.play.panels.settings import PRACTICE_HINT
from ninja_game.play.thumbnails import ThumbnailScreen, all_gold_and_medal, draw_pars, tries_text, where_from
from ninja_game.player.progress import Mark, opens_author
from ninja_game.player.records import SavedReplay
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.list_view import ListView
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Button, Choice, Widget

_ROW = 54
_PICTURE_SIZE = 60
_SIDE, SIDE_WIDTH, COMMENT_HEIGHT = 436, 320, 85
_SORT_ORDERS: list[tuple[str, object]] = [
    ("Mine first", "listed"),
    ("Last changed", "changed"),
    ("Name", "name"),
    ("Author", "author"),
    ("Time", "time"),
    ("Difficulty", "difficulty"),
]


class Browser(ThumbnailScreen):
    """A list at the left, the selected level at the right. The list is read again whenever the screen is entered.

    ``edit``: opens a level in the editor; ``packs``: the screen of the player's packs.
    """

    title = "Levels"

    def __init__(self, app: App, edit: Callable[[Entry], object] | None = None, packs: Action | None = None) -> None:
        super().__init__(app)
        self._packs = packs
        self._edit = edit
        self.sort: object = "listed"
        self.message = ""
        self.problems: list[Problem] = []
        self.entries: list[Entry] = []
        self.shown: list[Entry] = []
        self.best_replays: dict[str, SavedReplay] = {}
        self.marks: dict[str, Mark] = {}
        self._count = ""
        self.list = ListView(
            (44, 112, 376, 8 * _ROW), _ROW, self._draw_row, self.play, selected=self._select, opens=True
        )
        self.list.empty, self.list.hint = "No level matches", "Enter to play, Right for more, Up to search"
        self.play_button = Button((_SIDE, 470, 154, 32), "Play", lambda: self.play(self.list.index))
        self.practice = Button(
            (_SIDE + 166, 470, 154, 32), "Practice", lambda: self.play(self.list.index, practice=True)
        )
        self.watch_best = Button((_SIDE, 510, 98, 32), "Watch best", self._watch)
        self.watch_author = Button((_SIDE + 104, 510, 98, 32), "Author's run", self._watch_author)
        self.change = Button((_SIDE + 208, 510, 46, 32), "Edit", self._change)
        self.link = Button((_SIDE + 260, 510, 60, 32), "Link", self._copy_link)
        self.entry_field = TextEntry((44, 66, 194, 32), "Search name or author", "", lambda _: self._arrange())
        self.search = self.entry_field

    def enter(self) -> None:
        catalogue = self.player.catalogue
        catalogue.problems.clear()
        self.entries = catalogue.single_levels()
        self.best_replays = self.player.records.level_bests()
        self.marks = self.player.marks.all()
        self.problems = file_problems(catalogue.shown_problems)
        self.message = ""
        self._arrange()
        super().enter()

    def look_again(self) -> None:
        self.enter()
        self.redraw = True

    def choosers(self) -> list[Widget]:
        sort = Choice((244, 66, 118, 32), "", _SORT_ORDERS, lambda: self.sort, self.sort_by, hint="Sort the list")
        problems = problems_button(self.app, (150, 546, 270, 18), lambda: self.problems)
        return [self.list, self.entry_field, sort, *problems]

    def build(self) -> Sequence[Widget]:
        watch = self.watch_best, self.watch_author
        more = [self.change] if self._edit else []
        if self._packs:
            more.append(Button((368, 66, 52, 32), "Packs", self._packs, hint="Open, make and change packs"))
        return [*self.choosers(), self.play_button, self.practice, *watch, *more, self.link]

    def handle(self, event: InputEvent) -> None:
        """A dropped file is copied into the player's folder, a pack goes to the screen of packs.

        Back in the window the list is read again.
        """
        if event.raw.type == pygame.DROPFILE and self._packs and is_pack(Path(event.raw.file)):
            self._packs()
            self.app.top.handle(event)
        elif event.raw.type == pygame.DROPFILE:
            self._take_in(Path(event.raw.file))
        elif event.raw.type == pygame.WINDOWFOCUSGAINED:
            self.look_again()
        else:
            super().handle(event)

    def _take_in(self, file: Path) -> None:
        folder = self.player.catalogue.folder
        try:
            load_levels(file)
            if problem := name_problem(file.name):
                self.message = f"Give it another name first: {problem}"
            elif folder is None or free_path(folder, file.stem, file.suffix).name != file.name:
                self.message = f"There already is a {file.name}"
            else:
                Tree(folder).write(file.name, read_bytes(file))
                self.enter()
                self.message = ""
        except (NinjaGameError, OSError) as error:
            self.message = reason(error)
        self.redraw = True

    def sort_by(self, value: object) -> None:
        self.sort = value
        self._arrange()

    def _arrange(self) -> None:
        words = self.entry_field.text.casefold().split()
        matching = [entry for entry in self.entries if all(word in _searched_text(entry) for word in words)]
        keys: dict[object, Callable[[Entry], object]] = {
            "name": lambda e: e.title.casefold(),
            "changed": lambda e: 0 if e.source == GAME else -max(file_stamp(e.named.file)[1:2], default=0),
            "author": lambda e: (e.named.author.casefold(), e.title.casefold()),
            "difficulty": lambda e: (e.pars.difficulty if e.pars and e.pars.difficulty is not None else 1e9, e.title),
            "time": lambda e: mark.fastest if (mark := self.marks.get(e.digest)) else 1e9,
        }
        if self.sort in keys:
            matching.sort(key=keys[self.sort])  # type: ignore[arg-type]
        # Matches in names come before those in comments.
        matching.sort(key=lambda e: not all(word in e.title.casefold() for word in words))
        # Daily levels have their own screen.
        counts = (
            sum(Path(entry.named.file).parent.name != DAILY for entry in part) for part in (matching, self.entries)
        )
        self._count = "{} of {} levels".format(*counts)
        if matching != self.shown:
            self.shown = matching
            self.list.index = self.list.first = 0
        self.list.fill(self.shown)
        if not self.shown:
            self._select(0)

    @property
    def selected(self) -> Entry | None:
        return self.shown[self.list.index] if self.list.index < len(self.shown) else None

    def _select(self, _index: int) -> None:
        """Only unlocked levels can be played, only passed ones be watched; a button that is off says why."""
        selected = self.selected
        lock = self.player.lock_of(selected) if selected else "No level"
        self.play_button.enabled = self.practice.enabled = not lock
        self.play_button.hint, self.practice.hint = lock, lock or PRACTICE_HINT
        for button, hint in (self.change, "Open it in the editor"), (self.link, "Copy a link that opens this level"):
            button.enabled, button.hint = selected is not None, hint if selected else lock
        self.watch_best.enabled = selected is not None and selected.digest in self.best_replays
        ours = selected is not None and selected.source == GAME
        by_player = selected is not None and selected.named.author == self.player.settings.name
        is_own = selected is not None and not ours and (selected.source == YOURS or by_player)
        has_run = ours or bool(selected and self.player.catalogue.author_run(selected))
        opened = is_own or (selected is not None and opens_author(selected, self.marks.get(selected.digest)))
        self.watch_author.enabled = has_run and opened
        unknown = "none is known: Certify, in the editor, finds one" if is_own else "none is known"
        lock_hint = "earn a gold medal to watch it" if has_run else unknown
        self.watch_author.hint = "" if self.watch_author.enabled else lock_hint
        self.watch_best.hint = "Your best run" if self.watch_best.enabled else "You have not passed this level yet"

    def play(self, index: int, *, practice: bool = False) -> None:
        if index < len(self.shown):
            entry, *rest = self.shown[index:]
            self.message = self.player.lock_of(entry) or play_level(self.app, entry, practice=practice, following=rest)

    def _change(self) -> None:
        edit, entry = self._edit, self.selected
        if edit is None or entry is None:
            return
        folder = Path(entry.named.file).parent

        def own() -> None:
            from ninja_game.editor.packs import make_own  # it needs NumPy, which takes a moment

            try:
                make_own(folder)
            except (NinjaGameError, OSError) as error:
                self.app.notify(reason(error))
            else:
                edit(entry)

        if (folder / RECEIVED).is_file():
            ask_received(self.app, entry.source, lambda: edit(replace(entry, source=GAME)), own)
        else:
            edit(entry)

    def _copy_link(self) -> None:
        if self.selected is not None:
            copy_level_link(self.app, self.selected.named, self.selected.title)

    def _watch_author(self) -> None:
        if self.selected is not None:
            watch_replays(self.app, [self.player.catalogue.author_run(self.selected)])

    def _watch(self) -> None:
        best = self.best_replays.get(self.selected.digest) if self.selected else None
        if best is not None:
            watch_replays(self.app, [self.player.records.replay(best.id)])

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme, palette = self.app.theme, self.app.theme.palette
        entry = self.selected
        theme.text(surface, self._count, 44, 549, size=9.5, colour=palette.faint)
        hint = "" if self.watch_author.enabled or entry is None else f"Author's run: {self.watch_author.hint}"
        colour = palette.bad if self.message else palette.faint
        theme.text(surface, self.message or hint, _SIDE, 548, size=10, colour=colour, width=SIDE_WIDTH)
        if entry is None:
            return
        self.thumbnails.draw(surface, entry, _SIDE + 28, 66, SIDE_WIDTH - 56)
        theme.text(surface, entry.title, _SIDE, 278, size=17, bold=True, width=SIDE_WIDTH - 44)
        unsigned = "yours" if entry.source == YOURS else "author unknown"
        by = f"by {author_name(entry.named.author)}" if entry.named.author else unsigned
        subtitle = "    ".join(filter(None, (by, where_from(entry))))
        theme.text(surface, subtitle, _SIDE, 303, size=10.5, colour=palette.faint, width=SIDE_WIDTH)
        teaches = [f"Teaches: {entry.named.teaches}"] if entry.named.teaches else []
        theme.paragraph(surface, [entry.named.comment, *teaches], (_SIDE, 321, SIDE_WIDTH, COMMENT_HEIGHT), 10.5, 13.5)
        mark = self.marks.get(entry.digest)
        colour = palette.good if mark else palette.faint
        theme.text(surface, self.player.reached(entry, mark), _SIDE, 408, size=12, colour=colour, width=SIDE_WIDTH)
        played = self.player.statistics.played(entry.digest)
        if played.attempts:
            theme.text(surface, tries_text(played), _SIDE, 425, size=10.5, colour=palette.faint)
        all_gold_and_medal(surface, theme, entry, mark, _SIDE + SIDE_WIDTH - 10, 288)
        draw_pars(surface, theme, entry.pars, mark and mark.fastest, _SIDE, 443)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        entry = self.shown[index]
        palette = theme.palette
        x, y, w, h = area
        chosen = index == self.list.index
        theme.row(surface, (x, y + 1, w, h - 2), chosen=chosen, focused=focused)
        self.thumbnails.draw(surface, entry, x + 4, y + 4, _PICTURE_SIZE)
        left = x + _PICTURE_SIZE + 14
        theme.text(surface, entry.title, left, y + 11, size=12, bold=chosen, width=186)
        if self.player.lock_of(entry):
            draw_look(surface, theme, "locked", (x + 4 + _PICTURE_SIZE / 2 - 11, y + 16, 22, 22))
        by = author_name(entry.named.author) if entry.source == YOURS else ""
        source = "    ".join(filter(None, (by, where_from(entry))))
        theme.text(surface, source, left, y + 32, size=10, colour=palette.faint, width=w - _PICTURE_SIZE - 64)
        mark = self.marks.get(entry.digest)
        if mark:
            time = f"{seconds_text(mark.fastest)} s"
            theme.text(surface, time, x + w - 8, y + 11, size=12, colour=palette.good, align="right", width=100)
        elif self.player.own_certificate(entry):
            theme.text(surface, "certified", x + w - 8, y + 11, size=10, colour=palette.good, align="right", width=100)
        all_gold_and_medal(surface, theme, entry, mark, x + w - 16, y + 37)


class LevelChoice(Browser):
    """The level browser of the editors: ``choose`` gets the level to open."""

    title = "Open a level"

    def __init__(self, app: App, choose: Callable[[Entry], object]) -> None:
        super().__init__(app)
        self._choose, self.sort = choose, "changed"
        self.list.hint = "Enter opens the level in the editor"
        self.change = Button((_SIDE, 470, SIDE_WIDTH, 32), "Edit", lambda: self.play(self.list.index))

    def build(self) -> Sequence[Widget]:
        return [*self.choosers(), self.change]

    def act(self, action: str, *, held: bool = False) -> None:
        if action == "confirm" and self.focus is self.entry_field and len(self.shown) == 1:
            self.play(0)
        else:
            super().act(action, held=held)

    def play(self, index: int, *, practice: bool = False) -> None:
        if index < len(self.shown):
            self.app.pop()
            self._choose(self.shown[index])


def _searched_text(entry: Entry) -> str:
    named = entry.named
    words = entry.title, named.author, named.comment, named.teaches, entry.episode, entry.place, entry.source
    return " ".join(map(str, words)).casefold()
