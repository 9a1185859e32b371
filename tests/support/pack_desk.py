"""What tests of packs share: the program with a pack of the player's, the places of its cards, and its problems."""

import shutil
from collections.abc import Sequence
from pathlib import Path
from unittest.mock import patch

import pygame

from ninja_game.editor.ready_pack import ReadyPack
from ninja_game.formats.pack.pack import Pack
from ninja_game.levels.findings import PackFinding
from ninja_game.play.menus import pack_sharing
from ninja_game.play.menus.pack_shelves import Rack
from ninja_game.play.menus.packs import PackScreen
from ninja_game.play.menus.problems import Problem, ProblemsScreen
from ninja_game.ui.theme import Area
from tests.support.draw_log import drawn
from tests.support.menu_driver import MenuDriver
from tests.support.own_pack import PACK, rewrite


def texts_of(folder: Path) -> dict[str, bytes]:
    """All files below a folder, by their paths from it."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def titles(rack: Rack) -> list[str]:
    """The names of the levels that a rack shows."""
    return [cell.level.title for cell in rack.cells if cell.level]


class Desk(MenuDriver):
    """The program with the screen of packs."""

    screen: PackScreen  #: as it was opened last

    @property
    def path(self) -> Path:
        """The player's pack, where it has come into the folder."""
        return self.player.folder / "levels" / "laundry"

    @property
    def first(self) -> Path:
        """The file of the pack's first level."""
        return self.path / "00-0-run-and-hop.txt"

    def add_pack(self) -> None:
        """The tests' pack, by another name, comes into the player's folder."""
        shutil.copytree(PACK, self.path, ignore=shutil.ignore_patterns("gallery", "README.md"))
        rewrite(self.path / "pack.toml", "test pack", "Laundry")

    def open_packs(self) -> PackScreen:
        """The desk, opened from the main menu."""
        self.open("Levels")
        self.choose("Packs")
        self.frames(2)
        self.screen = self.shown(PackScreen)
        return self.screen

    def layout(self, path: Path | None = None) -> dict[int, list[str]]:
        """The episodes of a pack by their numbers: the first four letters of each level's file."""
        pack = Pack(path or self.path)
        return {each.number: [file[:4] for file in each.files(pack.files.levels)] for each in pack.index.episodes}

    def place(self, index: int) -> Area:
        """A cell on the shelves."""
        return self.screen.shelves.row_area(index)

    def half(self, index: int, *, right: bool = False) -> Area:
        """A half of a cell on the shelves."""
        x, y, w, h = self.place(index)
        return x + right * w / 2, y, w / 2, h

    def let_go(self, area: Area, mods: int = 0) -> None:
        """Let the button go over a place, with modifiers."""
        pygame.key.set_mods(mods)
        self.mouse_up(area)
        pygame.key.set_mods(0)

    def click(self, area: Area, mods: int = 0) -> None:
        """Click the middle of a place, with modifiers."""
        x, y, w, h = area
        pygame.key.set_mods(mods)
        self.mouse(x + w / 2, y + h / 2)
        self.let_go(area, mods)

    def wait_for_check(self) -> None:
        """Let pictures pass until the problems of the shown pack are known."""
        self.wait(lambda: self.screen.status.present, "the problems are known")

    def problems(self) -> Sequence[Problem]:
        """The problems of the shown pack, once they are known."""
        self.wait(lambda: pack_sharing.problems(self.screen) is not None, "the problems are known")
        self.wait_for_check()
        return pack_sharing.problems(self.screen) or []

    def problem_page(self) -> ProblemsScreen:
        """The page of problems on top, once they are known."""
        page = self.shown(ProblemsScreen)
        self.wait(lambda: "Looking for problems" not in drawn(self.app), "the problems are known")
        return page

    def made(self, problems: Sequence[PackFinding] = (), *notes: str) -> ReadyPack:
        """The pack as it is when it was made ready; ``problems``: those that are left."""
        pack = Pack(self.path)
        return ReadyPack(pack, [*problems], pack.files.zipped(), pack.files.link(), [*notes])

    def paste(self, text: str) -> None:
        """Click *Paste link* with a text in the clipboard."""
        with patch("pygame.scrap.get_text", lambda: text):
            self.choose("Paste link")

    def copied_links(self) -> list[str]:
        """The links that a click on the button puts into the clipboard."""
        links: list[str] = []
        with patch("pygame.scrap.put_text", links.append):
            self.choose("Copy the link")
        return links
