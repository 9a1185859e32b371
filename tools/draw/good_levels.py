"""Draw the ten levels of docs/good-levels.md with their numbers, and write what is said about them there."""

from __future__ import annotations

import re
import tempfile
from pathlib import Path

import pygame

from ninja_game.play.menus.good_levels import PICTURE, GoodLevel, GoodLevelsScreen
from tests.support.menu_driver import MenuDriver
from tools import ROOT

PAGE, PICTURES = ROOT / "docs" / "good-levels.md", ROOT / "docs" / "pictures" / "good-levels"
HEAD = "## Ten of ours, read closely\n"


def name_of(level: GoodLevel) -> str:
    """The level's file without its ending, which is that of its picture too."""
    return Path(level.entry.named.file).stem


def chapter(levels: list[GoodLevel]) -> str:
    """The chapter of the page."""
    parts = [HEAD, "The editor has this chapter too (*File > Good levels*) and opens a copy of each.\n"]
    for level in levels:
        title = level.entry.named.name
        notes = "\n".join(f"{number}. {text}" for number, (_, _, text) in enumerate(level.notes, 1))
        picture = f"![{title} with the numbers of the notes](pictures/good-levels/{name_of(level)}.png)"
        parts.append(f"### {title}\n\n{level.about}\n\n{picture}\n\n{notes}\n")
    return "\n".join(parts)


def written(page: str, levels: list[GoodLevel]) -> str:
    """The page with the chapter as it is now, in its place."""
    return re.sub(rf"{HEAD}.*?(?=^## |\Z)", lambda _: f"{chapter(levels)}\n", page, flags=re.DOTALL | re.MULTILINE)


def main() -> None:
    PICTURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        driver = MenuDriver(Path(folder), (792, 600))
        screen = GoodLevelsScreen(driver.app, lambda _: None)
        driver.app.push(screen)
        for number, level in enumerate(screen.levels):
            screen.list.index = number
            screen.redraw = True
            driver.frames(3)
            picture = driver.app.surface.subsurface(driver.app.canvas.rect(*PICTURE))
            pygame.image.save(picture, str(PICTURES / f"{name_of(level)}.png"))
        driver.close()
    PAGE.write_text(written(PAGE.read_text("utf-8"), screen.levels), "utf-8")
    print(f"drew {len(screen.levels)} pictures into docs/pictures/good-levels")


if __name__ == "__main__":
    main()
