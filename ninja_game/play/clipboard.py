"""Copies texts and links to the clipboard; without a clipboard into a file in the folder ``exports``."""

from __future__ import annotations

from collections.abc import Callable

import pygame

from ninja_game.editor.draft import Draft
from ninja_game.errors import NinjaGameError
from ninja_game.formats.ascii.writer import headers_of
from ninja_game.formats.links import level_link
from ninja_game.formats.named_level import NamedLevel
from ninja_game.play.app import App


def copy_text(app: App, text: str, *, title: str, suffix: str, notice: str = "") -> None:
    """Put a text into the clipboard and show ``notice``; else write it into a file called ``title`` + ``suffix``."""
    try:
        pygame.scrap.put_text(text)
    except pygame.error:
        app.write_export(title, suffix, text + "\n")
    else:
        app.notify(notice or f"In the clipboard: {len(text):,} characters")


def pasted_text() -> str:
    """The text in the clipboard. Raises NinjaGameError for an empty one."""
    try:
        text: str = pygame.scrap.get_text()
    except pygame.error:
        text = ""
    if not text.strip():
        raise NinjaGameError("there is no text in the clipboard: copy it first")
    return text


def copy_link(app: App, make: Callable[[], str], *, title: str) -> None:
    """Put a link into the clipboard: the address of the player's page with the text that ``make`` gives."""
    with app.errors_as_notices("No link: "):
        link = app.settings.site + make()
        copy_text(app, link, title=title, suffix=".link.txt", notice="Link copied")


def copy_level_link(app: App, named: NamedLevel | Draft, title: str) -> None:
    copy_link(app, lambda: level_link(named.level, **headers_of(named) | {"name": title}), title=title)
