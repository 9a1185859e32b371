"""What each command of the editor does: tools, files, tests, views."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from ninja_game.editor.autosave import Recovered, recovered
from ninja_game.editor.brush import SNAPS
from ninja_game.editor.draft import Draft
from ninja_game.editor.files import SUFFIX, OccupiedError, Source, draft_of, new_source, open_source
from ninja_game.editor.motion import CLOCKWISE, FLIP, MIRROR, SYMMETRIES
from ninja_game.editor.records import points
from ninja_game.editor.stamp import everything
from ninja_game.editor.tools import TOOLS
from ninja_game.errors import LevelError, NinjaGameError, reason
from ninja_game.files.shown_text import file_stem
from ninja_game.formats.ascii.writer import HEADER_KEYS
from ninja_game.play.editor.marks import finding_points
from ninja_game.play.editor.panels import LevelChoice, help_page
from ninja_game.play.editor.session import EditorSession
from ninja_game.play.editor.trying import TryScreen
from ninja_game.play.editor.view import EditorView
from ninja_game.play.menus.panels import CANCEL, Form, Menu, nothing
from ninja_game.player.catalogue import Entry

if TYPE_CHECKING:
    from ninja_game.play.app import App

Action = Callable[[], object]

NAMELESS = "My level"
"""What a level is called if its maker gives it no name."""


class EditorCommands:
    """Runs commands by name (``controls.COMMANDS``). ``step_palette``: goes on in the palette."""

    def __init__(self, app: App, session: EditorSession, view: EditorView) -> None:
        self.app = app
        self.session = session
        self.view = view
        self.step_palette: Callable[[int], object] = lambda _: None
        self._finding = -1

    def run(self, name: str) -> None:
        """Do what a command says."""
        tools = self.session.tools
        if name in TOOLS:
            tools.finish()
            tools.tool = name
        elif name.startswith("snap_"):
            names = list(SNAPS)
            tools.snap = names[(names.index(tools.snap) + 1) % len(names)] if name == "snap_next" else name[5:]
        else:
            self._table()[name]()

    def _table(self) -> dict[str, Action]:
        tools, view = self.session.tools, self.view
        return {
            "help": lambda: self.app.push(help_page(self.app)), "menu": self.menu,
            "test": self.test, "test_here": lambda: self.test(here=True), "certify": self.certify,
            "save": self.save, "save_as": self.save_as, "open": self.open, "new": self.new, "about": self.about,
            "undo": tools.undo, "redo": lambda: tools.undo(again=True),
            "copy": tools.copy, "cut": tools.cut, "paste": tools.paste,
            "choose_all": self.choose_all, "delete": tools.delete,
            "next_tool": lambda: self.run(TOOLS[(TOOLS.index(tools.tool) + 1) % len(TOOLS)]),
            "swap": lambda: tools.pick_up(tools.tile if tools.objects else tools.record),
            "mirror": lambda: tools.turn(MIRROR), "flip": lambda: tools.turn(FLIP),
            "turn": lambda: tools.turn(CLOCKWISE), "symmetry": self.next_symmetry, "grid": view.next_grid,
            "lines": lambda: setattr(view, "lines", not view.lines),
            "paths": lambda: setattr(view, "paths", not view.paths),
            "next_finding": lambda: self.go_to_finding(self._finding + 1),
            "next_entry": lambda: self.step_palette(1), "previous_entry": lambda: self.step_palette(-1),
        }  # fmt: skip

    def next_symmetry(self) -> None:
        """Another symmetry."""
        names = list(SYMMETRIES)
        tools = self.session.tools
        tools.finish()
        tools.symmetry = names[(names.index(tools.symmetry) + 1) % len(names)]

    def choose_all(self) -> None:
        """Select everything."""
        tools = self.session.tools
        tools.finish()
        tools.tool, tools.selection = "select", everything(tools.draft)

    def go_to_finding(self, index: int) -> None:
        """Put the pointer at a problem and select what it is about."""
        findings, tools = self.session.findings, self.session.tools
        if not findings:
            self.app.notify("No problems found")
            return
        self._finding = index % len(findings)
        finding = findings[self._finding]
        places = finding_points(tools.draft.level, finding)
        records = [number for number in finding.records if number < len(tools.draft.objects)]
        tools.choose(frozenset((n, part) for n in records for part in points(tools.draft.objects[n])))
        if records:
            tools.tool = "select"
        if places:
            tools.pointer = places[0]
            self.view.hovering = True
        self.view.hint = f"{finding.sentence}. {finding.hint}"

    # --- trying and certifying ---

    def test(self, *, here: bool = False) -> None:
        """Play the level; ``here``: with the ninja at the pointer."""
        session = self.session
        level = session.level_to_test(here=here)
        try:
            screen = TryScreen(self.app, session.name, level, lambda inputs: session.tried(level, inputs))
        except LevelError as error:
            self.app.notify(f"{error.what}: key 9 among the objects places a ninja, F6 tests with one at the pointer")
            return
        self.app.push(screen)

    def certify(self) -> None:
        """Start the solver, or stop it."""
        certifier = self.session.certifier
        self.session.tools.finish()
        if certifier.busy:
            certifier.stop()
        elif any(finding.text.startswith("there is no") for finding in self.session.findings):
            self.app.notify("Place a ninja and an exit with its switch first")
        else:
            certifier.start(self.session.draft.level)

    # --- files ---

    def menu(self) -> None:
        """Give up what is half done, or open the file menu."""
        session = self.session
        if session.tools.cancel():
            return
        rows = [
            ("Save", self.save, "Ctrl+S"), ("Save as...", self.save_as, "Ctrl+Shift+S"),
            ("Open...", self.open, "Ctrl+O"), ("New", self.new, "Ctrl+N"), ("About the level...", self.about, "F2"),
            ("Copy a link", session.copy_link, "Opens the level"), ("Copy as an N string", session.copy_string, ""),
            ("Paste an N string", session.paste_string, "From the clipboard; any format of levels, or a link"),
            ("Export a picture", session.export_picture, "A PNG file among your exports"),
            ("Keep the solver's run", session.keep_certificate, "As a replay among yours"),
            ("Leave the editor", self.leave, ""),
        ]  # fmt: skip
        self.app.push(Menu(self.app, "Level", rows))

    def save(self, then: Action = nothing) -> None:
        """Write the level into its file, or into a new one of the player's, and do ``then``."""
        if self.session.source.path is None and not self.session.draft.name:
            self.save_as(then)
        else:
            self.save_to(self.session.own_path, then)

    def save_to(self, path: Path, then: Action = nothing, *, replacing: bool = False) -> None:
        """Write the level, and do ``then``; ask before anything is replaced."""
        try:
            self.session.save(path, replacing=replacing)
        except OccupiedError as error:
            text = str(error)
            rows = [
                ("Save under another name", lambda: self.save_as(then), ""),
                ("Replace it", lambda: self.save_to(path, then, replacing=True), "What it holds now is lost"), CANCEL,
            ]  # fmt: skip
            self.app.push(Menu(self.app, text[0].upper() + text[1:], rows))
        except (NinjaGameError, OSError) as error:
            self.app.notify(f"Not saved: {reason(error)}")
        else:
            then()

    def save_as(self, then: Action = nothing) -> None:
        """Ask for the level's name, write it into a file of that name, and do ``then``."""
        session = self.session
        fields = [(f"Name of the level, or else {NAMELESS}", session.draft.name, 60)]

        def on_accept(texts: list[str]) -> None:
            name = texts[0].strip() or NAMELESS
            folder = session.source.path.parent if session.source.path else self.app.player.folder / "levels"
            session.tools.finish()
            session.tools.history.change(replace(session.draft, name=name))
            self.save_to(folder / f"{file_stem(name, 'level')}{SUFFIX}", then)

        self.app.push(Form(self.app, "Save as", fields, "Save", on_accept))

    def about(self) -> None:
        """Name, author, comment, what the level teaches."""
        about = zip(HEADER_KEYS, self.session.draft.about, strict=True)
        fields = [(key.capitalize(), text, 200) for key, text in about]

        def on_accept(texts: list[str]) -> None:
            tools = self.session.tools
            tools.finish()
            tools.history.change(Draft(tools.draft.level, *texts))

        self.app.push(Form(self.app, "About the level", fields, "OK", on_accept))

    def open(self) -> None:
        """Choose a level to edit."""
        self.unless_unsaved(lambda: self.app.push(LevelChoice(self.app, self.edit_entry)))

    def edit_entry(self, entry: Entry) -> None:
        """Edit a level of the browser: the player's in its file, the game's as a new one."""
        try:
            own = entry.source == "yours" and entry.named.ascii
            self.edit(open_source(Path(entry.named.file)) if own else Source(draft_of(entry.named)))
        except (NinjaGameError, OSError) as error:
            self.app.notify(str(error))

    def edit(self, source: Source, found: Recovered | None = None) -> None:
        """Edit this level, or one that was found again."""
        self.session.begin(source, found)
        self.view.stale = True

    def offer_recovered(self) -> None:
        """Ask what to do with a level that was being edited when the program died."""
        found = next(recovered(self.app.player.folder), None)
        if found is None:
            return
        name = found.draft.name or (found.source.path.name if found.source.path else "a new level")
        rows = [
            ("Recover", lambda: self.edit(found.source, found), "As it was at most two seconds before the end"),
            ("Keep for later", nothing, "It is offered again"),
            ("Discard", found.forget, "It is lost"),
        ]
        self.app.push(Menu(self.app, f"Not saved last time: {name}", rows))

    def new(self) -> None:
        """An empty level."""
        self.unless_unsaved(lambda: self.edit(new_source(self.app.settings.name)))

    def leave(self) -> None:
        """Back to where the editor was opened."""

        def go() -> None:
            self.session.close()
            self.app.pop()

        self.unless_unsaved(go)

    def unless_unsaved(self, action: Action) -> None:
        """Do something after which the present level is gone; ask first if it is not saved."""
        self.session.tools.finish()
        if self.session.is_saved:
            action()
            return
        rows = [CANCEL, ("Save", lambda: self.save(action), ""), ("Discard changes", action, "")]
        self.app.push(Menu(self.app, f"{self.session.name} is not saved", rows))
