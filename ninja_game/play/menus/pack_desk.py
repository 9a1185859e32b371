"""A pack of the player's as rows of levels, which the mouse or keys move; every change can be undone."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import pygame

from ninja_game.editor import packs
from ninja_game.errors import NinjaGameError
from ninja_game.files.shown_text import shown_text
from ninja_game.files.user_folder import LEVELS
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN, LEVELS_PER_EPISODE
from ninja_game.formats.pack.pack import INDEX, Pack
from ninja_game.levels.episodes import GAME, YOURS, Entry, EpisodeSet
from ninja_game.levels.findings import Finding
from ninja_game.play.app import App
from ninja_game.play.menu_screen import ask_text
from ninja_game.play.menus.pack_shelves import CELL_HEIGHT, CELL_WIDTH, Marks, PackCell, Rack, called
from ninja_game.play.menus.packer import PackStatus, packer_of
from ninja_game.play.thumbnails import ThumbnailScreen
from ninja_game.ui.list_view import BAR_WIDTH
from ninja_game.ui.widgets import Widget

Edit = Callable[[Entry, Finding | None], object]

_BACK = "Undo, or Ctrl+Z, takes it back"
_COLOURS = "colours follow the place"


class PackDesk(ThumbnailScreen):
    """Shows a pack, and changes it by steps that can be undone."""

    title = "Packs"

    def __init__(self, app: App, edit: Edit) -> None:
        super().__init__(app)
        self.edit = edit  #: opens a level in the editor, at a finding
        self.pack: EpisodeSet | None = None  #: the shown one
        self.own_packs: list[EpisodeSet] = []
        self.sets: list[EpisodeSet] = []  #: all packs, and the game's own levels
        self.tray_key = "none"  #: the list at the right: "none" (levels in no episode), "yours", or the key of a pack
        self.moving: PackCell | None = None  #: the cell that gets a new place
        self.new_path: Path | None = None  #: a new pack, to be shown
        self.pack_choice: Widget | None = None
        self.play_button: Widget | None = None
        self.pointer: tuple[float, float] | None = None  #: the mouse's place during a drag, else None
        self.marked = Marks()
        self.packer = packer_of(app)
        self.status = PackStatus(self.packer, self.player.catalogue)
        rack = partial(Rack, status=self.status, thumbnails=self.thumbnails, marked=self.marked, pull=self._pull)
        self.shelves = rack((36, 96, 0, 0), 6, choose=self.choose)
        self.tray = rack((622, 126, CELL_WIDTH + BAR_WIDTH + 24, 4 * CELL_HEIGHT - 28), 1, choose=self.choose)

    @property
    def path(self) -> Path:
        return (self.pack and self.pack.path) or self.folder

    @property
    def folder(self) -> Path:
        return self.player.folder / LEVELS

    @property
    def is_received(self) -> bool:
        """Whether the shown pack is somebody else's: it is played, not changed."""
        return bool(self.pack and self.pack.received)

    @property
    def zipped(self) -> Path | None:
        """The newest zip of this pack."""
        return self._zip[0]

    @property
    def is_fresh(self) -> bool:
        """Whether the newest zip has all that is in the pack now."""
        return self._zip[1]

    @property
    def _zip(self) -> tuple[Path | None, bool]:
        pack = self.pack and self.pack.pack
        return self.packer.zip_of(pack) if pack and not self.is_received else (None, False)

    def read_packs(self, shown: Path | None = None, *, news: bool = False) -> None:
        """Read all packs from the disk; show this one, or the one before. ``news``: only if that has changed."""
        before = shown or self.new_path or self.path
        self.new_path = None
        self.player.catalogue.problems.clear()
        self.sets = self.player.catalogue.packs()
        self.own_packs = [pack for pack in self.sets if pack.is_changeable]
        pack = next((pack for pack in self.own_packs if pack.path == before), None)
        if not (news and pack is self.pack):
            self.show(pack)

    def show(self, pack: EpisodeSet | None) -> None:
        self.pack = pack = pack or next(iter(self.own_packs), None)
        self.packer.watch(self, pack and pack.path)
        own = None if self.is_received else pack
        self.status.show(own)
        if not self.packer.is_busy:
            self.packer.follow(next((shelf.pack for shelf in self.own_packs if shelf.path == self.packer.path), None))
        cells: list[PackCell] = []
        if own and pack and pack.pack:
            for episode in pack.pack.index.episodes:
                levels = pack.episodes[episode.number].levels if episode.number in pack.episodes else ()
                cells += [PackCell(episode, head=True), *(PackCell(episode, level) for level in levels)]
                cells += [PackCell(episode)] * (LEVELS_PER_EPISODE - len(levels))
            cells += [PackCell(None, head=True), *[PackCell(None)] * LEVELS_PER_EPISODE]
        entries: Sequence[Entry] = own.singles if own else ()
        if self.tray_key == "yours":
            entries = self.player.catalogue.own()
        elif self.tray_key != "none":
            entries = [entry for shelf in self.sets if shelf.key == self.tray_key for entry in shelf.levels]
        goals = {"none": "take it out of its episode", "yours": "put it into your folder"}
        self.tray.empty = f"Drag a level here to {goals.get(self.tray_key, 'put it into this pack')}"
        self.shelves.area = (36, 96, 6 * CELL_WIDTH + BAR_WIDTH + 4, CELL_HEIGHT * min(4, len(cells) // 6))
        self.shelves.show(cells)
        self.tray.show([PackCell(None, entry) for entry in entries])
        self.marked &= {level.named.file for level in self.levels()}
        self.redraw = True

    def enter(self) -> None:
        self.read_packs()
        super().enter()

    def pack_now(self) -> Pack | None:
        """The shown pack as it is on the disk; None if its folder is gone, and the screen shows what there is."""
        path = self.path
        self.enter()
        return self.pack.pack if self.pack and self.pack.path == path else None

    def run_step(self, action: Callable[[], object], name: str = "") -> bool:
        """Change something on the disk, and show the result; whether it was changed, without an error.

        ``name``: for undo; "": it cannot be undone.
        """
        done = False
        with self.app.errors_as_notices():
            if name and not self.packer.steps.run(name, action):
                return False
            if not name:
                action()
            done = True
        self.app.top.enter()
        return done

    def copy_pack(self, pack: Pack) -> None:
        def copy() -> None:
            self.new_path = packs.copy_pack(pack, self.folder, f"{pack.name} copy")
            self.app.notify("This copy is yours to change")

        self.run_step(copy, "Copy")

    def undo(self) -> None:
        self.run_step(lambda: self.app.notify(f"Undone: {self.packer.steps.undo()}"))

    def choose(self, cell: PackCell | None) -> None:
        """Show what can be done with a cell, or with the pack."""
        raise NotImplementedError

    def _open_cell(self, cell: PackCell) -> None:
        """Edit a level; of several levels, or of another cell, show what can be done."""
        if cell.level and not self.moving and self.levels_with(cell.level) == [cell.level]:
            self.edit_level(cell.level)
        else:
            self.choose(cell)

    def edit_level(self, level: Entry) -> None:
        edit = partial(self.edit, level, None)
        if Path(level.named.file).parent == self.path:
            self.run_step(edit, "Edit")
        else:
            edit()

    def ask_text_for(self, title: str, text: str, action: Callable[[str], object], needed: str = "") -> None:
        """Ask for a text, and change the pack with it. ``needed``: a notice where none is typed; then ask again."""
        step = shown_text(title.partition(":")[0])

        def take(typed: str) -> None:
            if needed and not typed.strip():
                self.app.notify(needed)
                self.ask_text_for(title, text, action, needed)
            else:
                self.run_step(lambda: action(typed), step)

        ask_text(self.app, title, "", text, "OK", take, 60)

    def choose_tray(self, key: str) -> None:
        self.tray_key = key
        self.show(self.pack)

    def entry_of(self, file: str) -> Entry | None:
        levels = self.pack.levels if self.pack else []
        return next((entry for entry in levels if entry.named.file == str(self.path / file)), None)

    @property
    def next_name(self) -> str:
        """The default name of a new episode."""
        return f"Episode {sum(cell.head for cell in self.shelves.cells)}"

    @property
    def column(self) -> int:
        numbers = [cell.episode.number for cell in self.shelves.cells if cell.episode]
        return max(numbers, default=0) // EPISODES_PER_COLUMN

    def set_aside(self, action: Callable[[], object], title: str) -> None:
        """Take levels out of their episode, and show them in their new place."""
        self.tray_key = "none"
        self.run_step(action, f"Take out {shown_text(title)}")

    def levels(self, rack: Widget | None = None) -> list[Entry]:
        """The visible levels, in order, of one row or of both."""
        racks = (self.shelves, self.tray)
        return [cell.level for visible in racks if rack in (None, visible) for cell in visible.cells if cell.level]

    def levels_with(self, level: Entry) -> list[Entry]:
        """The levels that an action on this one is for."""
        return self.marked.together(level, self.levels())

    def _mark(self, x: float, y: float) -> bool:
        """Whether a click marks levels."""
        rack = self._at(x, y)
        index = rack.at(x, y) if isinstance(rack, Rack) else None
        if not isinstance(rack, Rack) or index is None or not self.marked.click(rack, index):
            return False
        self.focus, rack.index, self.redraw = rack, index, True
        return True

    def _pull(self, cell: PackCell, pointer: tuple[float, float]) -> None:
        """Begin or continue to drag a cell."""
        if self.moving is None and (cell.level or (cell.head and cell.episode)):
            self.moving = cell
        self.pointer = pointer if self.moving else None
        if (over := self.shelves.at(*pointer)) is not None:
            self.focus, self.shelves.index = self.shelves, over

    def start_moving(self, cell: PackCell) -> None:
        self.moving = cell
        self.app.notify("Choose its new place; Enter or a click puts it there, Esc leaves it where it is")

    def back(self) -> None:
        if self.moving:
            self.moving = self.pointer = None
        elif self.marked:
            self.marked.clear()
        else:
            super().back()

    def drop(self, goal: PackCell | None, *, after: bool = False) -> None:
        moving, self.moving, self.pointer = self.moving, None, None
        levels = self.levels_with(moving.level) if moving and moving.level else []
        if levels and not (goal and goal.level in levels and len(levels) == 1):
            copy = bool(pygame.key.get_mods() & (pygame.KMOD_CTRL | pygame.KMOD_META))
            move = partial(self._move_levels, levels, goal, after=after, copy=copy)
            self.run_step(move, f"{'Copy' if copy else 'Move'} {called(levels)}")
        elif moving and moving.episode and goal and goal.episode:
            numbers = moving.episode.number, goal.episode.number
            self.run_step(partial(self._move_episode, *numbers), f"Move episode {numbers[0] + 1}")

    def _is_after(self, index: int) -> bool:
        """Whether the mouse is over the right half of a cell: a dropped level lands behind that cell."""
        left, _, w, _ = self.shelves.row_area(index)
        return self.pointer is not None and self.pointer[0] > left + w / 2

    def _landing(self) -> tuple[int, bool] | None:
        """The cell beside which the dragged level would land, and whether behind it."""
        over = self.shelves.at(*self.pointer) if self.pointer else self.shelves.index
        if over is None or not (self.moving and self.moving.level):
            return None
        cells = self.shelves.cells
        if cells[over].level:
            return over, self._is_after(over)
        row = [k for k, cell in enumerate(cells) if cell.episode is cells[over].episode]
        return next((k for k in row if not (cells[k].head or cells[k].level)), row[-1]), False

    def _move_levels(self, levels: Sequence[Entry], goal: PackCell | None, *, after: bool, copy: bool) -> None:
        target = self.path
        if goal is None and self.tray_key != "none":
            target = next((pack.path for pack in self.sets if pack.key == self.tray_key and pack.path), self.folder)
        if target != self.folder and target not in [pack.path for pack in self.own_packs]:
            raise NinjaGameError("that pack cannot be changed: it is the game's own, or a zip")
        names = packs.bring([level.named for level in levels], target, self.folder, copy=copy)
        if came := [level for level in levels if copy or Path(level.named.file).parent != target]:
            copied = Path(came[0].named.file).exists()
            source = {YOURS: "your folder", GAME: "the game"}.get(came[0].source, shown_text(came[0].source))
            what = f"{'Copied' if copied else 'Moved'} {called(came)} from {source}"
            self.app.notify(f"{what}{'' if copied else '; Ctrl copies instead'}. {_BACK}")
        if (target / INDEX).is_file():
            number = goal.episode.number if goal and goal.episode else None
            if goal and number is None:
                number = packs.new_episode(target, self.next_name, self.column)
            row = [cell.level for cell in self.shelves.cells if goal and cell.episode is goal.episode and cell.level]
            behind = row[row.index(goal.level) + after :] if goal and goal.level else []
            before = (Path(entry.named.file).name for entry in behind if entry not in levels)
            if packs.place(target, names, number, next(before, "")) and not came:
                where = "out of its episode" if number is None else f"to episode {number + 1}"
                self.app.notify(f"Moved {called(levels)} {where}; {_COLOURS}. {_BACK}")

    def _move_episode(self, number: int, to: int) -> None:
        packs.move_episode(self.path, number, to)
        if number != to:
            self.app.notify(f"Moved episode {number + 1} to the place of {to + 1}; {_COLOURS}. {_BACK}")

    def _handle_mouse(self, event: pygame.Event) -> None:
        if event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_RIGHT and not self.moving:
            place = self.theme.canvas.logical(event.pos)
            widget = self._at(*place)
            if widget and (widget is self.pack_choice or (isinstance(widget, Rack) and widget.click(*place))):
                self.focus_on(widget)
                self.choose(widget.chosen if isinstance(widget, Rack) else None)
                return
        left = event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_LEFT and not self.moving
        if left and self._mark(*self.theme.canvas.logical(event.pos)):
            return
        dragged = self._dragged
        super()._handle_mouse(event)
        if event.type == pygame.MOUSEBUTTONUP and isinstance(dragged, Rack):
            x, y = self.theme.canvas.logical(event.pos)
            if self.pointer is None:
                if dragged.release() or self.moving:
                    self._open_cell(dragged.chosen)
            elif (index := self.shelves.at(x, y)) is not None:
                self.pointer = (x, y)
                self.drop(self.shelves.cells[index], after=self._is_after(index))
            elif self.tray.contains(x, y):
                self.drop(None)
            if self.pointer is not None:
                self.moving = None
            self.pointer = None
            self.redraw = True

    def leave(self) -> None:
        super().leave()
        self.moving = self.pointer = None
        if not self.packer.is_busy:
            self.packer.drop_notices()

    def draw_widgets(self, surface: pygame.Surface) -> None:
        landing = self._landing()
        level = self.moving.level if self.moving else None
        lifted = self.levels_with(level) if level and self.pointer else []
        self.shelves.lifted = self.tray.lifted = {level.named.file for level in lifted}
        self.shelves.gap = landing[0] + landing[1] if landing and self.pointer else 0
        super().draw_widgets(surface)
        if self.moving and self.pointer:
            x, y = self.pointer
            if level:
                self.thumbnails.draw(surface, level, x + 6, y + 6, 60)
                if len(lifted) > 1:
                    self.theme.text(surface, called(lifted), x + 36, y + 54, size=11, bold=True, align="centre")
            else:
                self.theme.row(surface, (x + 6, y + 6, 2 * CELL_WIDTH, CELL_HEIGHT / 4), chosen=True, focused=True)
        if landing:
            x, y, w, h = self.shelves.row_area(landing[0])
            place = x + w * landing[1] - 2 + self.shelves.shift(self.shelves.gap) / 2, y + 4, 4, h - 8
            self.theme.canvas.fill_rect(surface, self.theme.palette.accent, *place, 2)
