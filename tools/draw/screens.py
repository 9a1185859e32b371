"""Draw the pictures of screens in docs/, and write the chapter of docs/good-levels.md: `python3 tools/dev.py docs`."""

import re
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from random import Random
from shutil import copy
from unittest.mock import patch

import pygame

from ninja_game.editor.files import open_source
from ninja_game.files.bundled import CHECKOUT
from ninja_game.formats.load import load_replays
from ninja_game.play.menus.good_levels import LEVEL_AREA, GoodLevel, GoodLevelsScreen
from ninja_game.play.replay.paths import paths_picture
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.runs.splits import run_splits
from ninja_game.ui.theme import PALETTES
from tests.support.first_level import STEPS, made_until
from tests.support.level_maker import Maker, examine
from tests.support.menu_driver import MenuDriver
from tests.support.tas_driver import TasDriver
from tools import ROOT

PAGE, PICTURES = ROOT / "docs" / "good-levels.md", ROOT / "docs" / "pictures"
LEVELS, RUNS = ROOT / "levels", ROOT / "levels" / "certificates"
HEAD = "## Ten of ours, read closely\n"


def editor_picture(folder: Path) -> Maker:
    """A level in the editor after a test, with a drone in a wall, drawn in mirror images."""
    maker = Maker(folder, (1188, 900))
    maker.open("Editor")
    editor = maker.editor
    editor.session.begin(open_source(Path(copy(LEVELS / "03-1-locksmith.txt", folder / "levels"))))
    run = load_replays(RUNS / "03-1-locksmith.exit.replay.txt")[0]
    editor.session.add_playtest(run.level, run.inputs, over=False)
    maker.frames()
    maker.press("shift+z")
    maker.mouse(*maker.at(132, 252))
    maker.press("m")
    examine(editor)
    maker.frames()
    editor.commands.go_to_finding(0)
    maker.frames(2)
    return maker


def menu_picture(folder: Path) -> MenuDriver:
    """The main menu, over the attract mode."""
    driver = MenuDriver(folder)
    driver.frames(80)
    return driver


def viewer_picture(folder: Path) -> MenuDriver:
    """A run in the replay viewer, paused in the middle, with its keys."""
    driver = MenuDriver(folder)
    driver.app.push(ReplayScreen(driver.app, load_replays(RUNS / "23-4-the-works.exit.replay.txt")))
    driver.frames(180)
    driver.press("p")
    driver.frames(2)
    return driver


def splits_picture(_: Path) -> pygame.Surface:
    """What `ninja-game splits --picture` draws of the two certificates of Springtime."""
    names = {"exit": "to the exit", "gold": "with all gold"}
    runs = [load_replays(RUNS / f"10-0-springtime.{goal}.replay.txt")[0] for goal in names]
    paths = [(name, run_splits(run).positions) for name, run in zip(names.values(), runs, strict=True)]
    return paths_picture(runs[0].level, paths, PALETTES["classic"], 792)


def tas_editor_picture(folder: Path) -> TasDriver:
    """A run in the TAS editor, some ticks selected, next to it one that goes another way from there on."""
    name = "10-0-springtime.exit.replay.txt"
    at = TasDriver(folder, Path(copy(RUNS / name, folder)), (1280, 800))
    at.screen.level.others.open([at.session.recording(at.editor.track.replaced(150, 190, [6] * 25), "Somebody else")])
    at.editor.edit(lambda track: track.named(146, "the ramp"))
    at.chord("s", pygame.KMOD_LCTRL)
    at.app.notify("")
    at.editor.select(150, 163)
    at.frames(3)
    return at


SCREENS: dict[str, Callable[[Path], pygame.Surface | MenuDriver]] = {
    "menu.png": menu_picture,
    "viewer.png": viewer_picture,
    "splits.png": splits_picture,
    "editor.png": editor_picture,
    "tas-editor.png": tas_editor_picture,
    **{f"first-level-{step}.png": partial(made_until, step) for step in STEPS},
}


def draw(name: str) -> pygame.Surface:
    """One of them, by a new player with the game's own levels, also in tests; the menu begins alike."""
    chance = patch("ninja_game.play.main_menu.Random", lambda: Random(1))
    with tempfile.TemporaryDirectory() as folder, patch.dict(CHECKOUT, levels=LEVELS), chance:
        drawn = SCREENS[name](Path(folder))
        if isinstance(drawn, pygame.Surface):
            return drawn
        picture = drawn.app.surface.copy()
        drawn.close()
        return picture


def name_of(level: GoodLevel) -> str:
    """The level's file without its ending, which is that of its picture too."""
    return Path(level.entry.named.file).stem


def chapter(levels: list[GoodLevel]) -> str:
    """The chapter of the page."""
    parts = [HEAD, "The editor has this chapter too (*File > Ten good levels*) and opens a copy of each.\n"]
    for level in levels:
        title = level.entry.named.name
        notes = "\n".join(f"{number}. {text}" for number, (_, _, text) in enumerate(level.notes, 1))
        picture = f"![{title} with the numbers of the notes](pictures/good-levels/{name_of(level)}.png)"
        parts.append(f"### {title}\n\n{level.about}\n\n{picture}\n\n{notes}\n")
    return "\n".join(parts)


def written(page: str, levels: list[GoodLevel]) -> str:
    """The page with the chapter as it is now, in its place."""
    return re.sub(rf"{HEAD}.*?(?=^## |\Z)", lambda _: f"{chapter(levels)}\n", page, flags=re.DOTALL | re.MULTILINE)


def good_levels(folder: Path) -> None:
    """Draw the ten levels with the numbers of their notes, and write the chapter."""
    driver = MenuDriver(folder, (792, 600))
    screen = GoodLevelsScreen(driver.app, lambda _: None)
    driver.app.push(screen)
    for number, level in enumerate(screen.levels):
        screen.list.index = number
        screen.redraw = True
        driver.frames(3)
        picture = driver.app.surface.subsurface(driver.app.canvas.rect(*LEVEL_AREA))
        pygame.image.save(picture, str(PICTURES / "good-levels" / f"{name_of(level)}.png"))
    driver.close()
    PAGE.write_text(written(PAGE.read_text("utf-8"), screen.levels), "utf-8")


if __name__ == "__main__":
    for name in SCREENS:
        pygame.image.save(draw(name), str(PICTURES / name))
    with tempfile.TemporaryDirectory() as temporary:
        good_levels(Path(temporary))
    print(f"drew {len(SCREENS)} pictures into docs/pictures, and those of docs/good-levels.md")
