"""What an editor does with the document that is edited: save, save as, leave, what was not saved last time."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Protocol

from ninja_game.document import OccupiedError
from ninja_game.errors import NinjaGameError, reason
from ninja_game.play.app import App
from ninja_game.play.menus.panels import CANCEL, Action, Menu, Row, nothing


class Document(Protocol):
    """A level or a run under edit, and its file."""

    @property
    def name(self) -> str:
        """What to call it."""

    @property
    def is_saved(self) -> bool:
        """Whether its file holds what is here."""

    def end(self) -> None:
        """Whatever is half done is done now."""

    def save(self, path: Path, *, replacing: bool = False) -> object:
        """Write it. Raises OccupiedError where that would replace another file, or one changed by others; OSError."""

    def close(self) -> None:
        """Leave it; what is not saved is discarded."""


class DocumentCommands:
    """Saving and leaving. Subclasses say where a document is saved, and ask for a name."""

    def __init__(self, app: App, document: Document) -> None:
        self.app = app
        self.document = document

    def own_path(self) -> Path | None:
        """Where the document is saved without a question; None: ask."""
        raise NotImplementedError

    def save_as(self, then: Action = nothing) -> None:
        """Ask for a name, save under it, and do ``then``."""
        raise NotImplementedError

    def reload_rows(self, path: Path) -> list[Row]:
        """What else to offer where the document's file was changed by another program."""
        return []

    def saved_text(self, path: Path) -> str:
        raise NotImplementedError

    def save(self, then: Action = nothing) -> None:
        """Write the document into its file, and do ``then``; ask for a name where it has none."""
        path = self.own_path()
        if path is None:
            self.save_as(then)
        else:
            self.save_to(path, then)

    def save_to(
        self, path: Path, then: Action = nothing, *, save: Callable[..., object] | None = None, replacing: bool = False
    ) -> None:
        """Write the document, and do ``then``; ask before anything is replaced. ``save``: instead of the document's."""
        try:
            (save or self.document.save)(path, replacing=replacing)
        except OccupiedError as error:
            text, replace_it = str(error), partial(self.save_to, path, then, save=save, replacing=True)
            rows: list[Row] = [
                ("Save under another name", lambda: self.save_as(then), ""),
                *self.reload_rows(path),
                ("Replace it", replace_it, "What it holds now is lost"),
                CANCEL,
            ]
            self.app.push(Menu(self.app, text[0].upper() + text[1:], rows))
        except (NinjaGameError, OSError) as error:
            self.app.notify(f"Not saved: {reason(error)}")
        else:
            self.app.notify(self.saved_text(path), here=True)
            then()

    def unless_unsaved(self, action: Action) -> None:
        """Do something after which the present document is gone; ask first if it is not saved."""
        self.document.end()
        if self.document.is_saved:
            action()
            return
        rows: list[Row] = [CANCEL, ("Save", lambda: self.save(action), ""), ("Discard changes", action, "")]
        self.app.push(Menu(self.app, f"{self.document.name} is not saved", rows))

    def leave(self) -> None:
        """Back to where the editor was opened; ask first if the document is not saved."""
        self.unless_unsaved(self.close)

    def close(self) -> None:
        """Back to where the editor was opened, whatever is not saved."""
        self.document.close()
        self.app.pop()

    def ask_about_recovered(self, name: str, recover: Action, forget: Callable[[], bool], *, about: str) -> None:
        """Ask what to do with a document that was being edited when the program died. ``about``: how it was left."""

        def discard() -> None:
            if not forget():
                self.app.notify("It stays: another window continues with it")

        def ask() -> None:
            sure: list[Row] = [("Keep for later", nothing, "It is offered again"), ("Discard", discard, "It is lost")]
            self.app.push(Menu(self.app, f"Discard {name}?", sure))

        def try_to_recover() -> None:
            try:
                recover()
            except (NinjaGameError, OSError) as error:
                self.app.notify(reason(error))

        rows: list[Row] = [
            ("Recover", try_to_recover, about), ("Keep for later", nothing, "It is offered again"),
            ("Discard...", ask, ""),
        ]  # fmt: skip
        self.app.push(Menu(self.app, f"Not saved last time: {name}", rows))
