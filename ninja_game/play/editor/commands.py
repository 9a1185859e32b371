"""The editor's commands: their names, their keys, and what they do. The help page shows the same table."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import NamedTuple

from ninja_game.editor.bench import TAKES
from ninja_game.editor.brush import Tool
from ninja_game.editor.draft import Draft, change_text
from ninja_game.editor.examination import UNREACHABLE_CODES
from ninja_game.editor.files import SUFFIX, Source, draft_of, lost_drafts, new_source, open_source
from ninja_game.editor.motion import CLOCKWISE, FLIP, MIRROR
from ninja_game.editor.palette import SNAPS
from ninja_game.editor.playtests import lead_in, place_before, with_ninja_at
from ninja_game.editor.specs import points
from ninja_game.errors import LevelError
from ninja_game.files.shown_text import counted, file_stem
from ninja_game.files.user_folder import LEVELS, free_path
from ninja_game.formats.ascii.writer import headers_of
from ninja_game.formats.messages import Moment, parse_messages
from ninja_game.levels.episodes import GAME, Entry, Mood
from ninja_game.levels.findings import Finding
from ninja_game.play.app import App
from ninja_game.play.clipboard import copy_level_link
from ninja_game.play.editor.messages_screen import MessagesScreen
from ninja_game.play.editor.palette_view import PaletteView
from ninja_game.play.editor.playtest import PlaytestScreen
from ninja_game.play.editor.session import EditorSession
from ninja_game.play.editor.sheet import GRIDS, finding_points
from ninja_game.play.editor.stamp_menu import StampCommands
from ninja_game.play.editor.view import DOUBLE, EditorView
from ninja_game.play.menu_screen import CANCEL, Action, DropDown, FormPanel, Menu, MenuRow, ask_text, nothing
from ninja_game.play.menus.browser import LevelChoice
from ninja_game.play.menus.good_levels import GoodLevelsScreen
from ninja_game.play.panels.help import HelpPage
from ninja_game.play.workspace import CommandMenu, CommandTable, DocumentCommands, bundled_commands, key_text
from ninja_game.runs.message_appearances import appearances
from ninja_game.runtime import in_page_or_not
from ninja_game.sim.grid import Cell, Point, cell_of
from ninja_game.sim.kinds import EXIT, NINJA
from ninja_game.sim.level import COLUMNS, ROWS
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.ui.theme import Area
from ninja_game.ui.widgets import next_option

EDITOR_COMMANDS = CommandTable(bundled_commands("level-editor.txt"))
"""All commands with a key. Other keys choose tiles and objects."""


_HELP = """\
A first level: draw a floor with the left mouse button. Take the ninja from the objects at the right and click where \
it begins; take the exit, click where it is, then where its switch is. Test plays the level, Certify lets the solver \
look for a run, Save (in File) puts it into the menu Levels.
The right button erases, the middle one picks; the wheel zooms, then the middle one drags the level. \
Doors go to the nearest side of a cell, or to the one chosen; then click where the switch is. \
Tiles: 1 to 8 choose a shape, Q W A S its solid corner, 9 is full, 0 empty. Objects: Shift and the letter that the \
palette shows; W A S D turn them. Without a mouse: arrows move the pointer, Space draws, Shift and arrows move \
what is selected."""


NAMELESS = "My level"  # the name of a level to which its maker gave none

_IN_MENU = {"save", "save_as", "open", "new", "about", "messages", "playtest", "certify"}
"""The commands whose keys work in the File menu."""

IN_MORE = ("reach", "playtests", "paths", "lines", "list", "slopes", "next_finding")  # the commands in the menu More

_MIRRORS = {
    "off": "off",
    "left-right": "left-right: what you draw comes again on the other side",
    "up-down": "up-down: what you draw comes again above or below",
    "both": "both: what you draw comes again in all four quarters",
    "point": "point: what you draw comes again, turned half round the middle",
}
"""The symmetries, and what they do."""

_UNDO = "Undo brings back what was here"


def _shown(shown: bool) -> str:
    return "shown" if shown else "hidden"


class Choices(NamedTuple):
    """What a command goes through, one step each time. ``actions``: by the steps' names; ``now``: the present step."""

    actions: dict[str, Action]
    now: str


class EditorCommands(DocumentCommands):
    """Does the commands of ``EDITOR_COMMANDS`` by their names."""

    def __init__(self, app: App, session: EditorSession, view: EditorView, palette: PaletteView) -> None:
        super().__init__(app, session)
        self.session = session
        self.view = view
        self._palette = palette
        self._stamps = StampCommands(app, session.tools)
        view.open_message = self.messages

    def run(self, name: str) -> None:
        steps = self._steps().get(name)
        if name in list(Tool):
            self.session.tools.finish()
            self.session.tools.tool = Tool(name)
        elif steps:
            steps.actions[next_option(list(steps.actions), steps.now)]()
        else:
            self._table()[name]()

    def _steps(self) -> dict[str, Choices]:
        """The steps of the commands that have several, by the commands' names."""
        tools, view, brush = self.session.tools, self.view, self.session.tools.brush
        mirror = _MIRRORS[brush.symmetry]
        return {
            "next_tool": Choices({tool: partial(self.run, tool) for tool in Tool}, tools.tool),
            "takes": Choices({what: partial(tools.take, what) for what in TAKES}, tools.takes),
            "symmetry": Choices({_MIRRORS[name]: partial(self.mirror, name) for name in _MIRRORS}, mirror),
            "grid": Choices({grid.name: partial(view.show_grid, grid) for grid in GRIDS}, view.grid.name),
            "snap_next": Choices({snap: partial(self.snap, snap) for snap in SNAPS}, brush.snap),
        }

    def _table(self) -> dict[str, Action]:
        tools, view = self.session.tools, self.view
        return {
            **{f"snap_{snap}": partial(self.snap, snap) for snap in SNAPS},
            "help": lambda: self.app.push(HelpPage(self.app, "The editor", _HELP, EDITOR_COMMANDS.commands)),
            "menu": self.menu, "file": self.file_menu, "more": self.more,
            "playtest": self.playtest, "playtest_here": lambda: self.playtest(tools.pointer), "certify": self.certify,
            "save": self.save, "save_as": self.save_as, "open": self.open, "new": self.new, "about": self.about,
            "messages": self.messages,
            "undo": self.undo, "redo": self.redo,
            "stamps": self._stamps.choose, "copy": tools.copy, "cut": tools.cut, "paste": tools.paste,
            "choose_all": tools.choose_all, "delete": tools.delete,
            "swap": lambda: tools.pick_up(tools.brush.tile if tools.brush.draws_objects else tools.brush.spec),
            "mirror": lambda: view.turn(MIRROR), "flip": lambda: view.turn(FLIP),
            "turn": lambda: view.turn(CLOCKWISE),
            "zoom_in": lambda: view.zoom(DOUBLE), "zoom_out": lambda: view.zoom(-DOUBLE), "zoom": lambda: view.zoom(0),
            "slopes": self.switch_slopes,
            "list": lambda: self.show_list(not view.listing), "find": lambda: self.show_list(True),
            "lines": self.switch_lines, "paths": self.switch_paths,
            "playtests": self.switch_playtests,
            "reach": self.next_reach,
            "next_finding": lambda: self.go_to_finding(self.view.finding + 1),
            "next_entry": lambda: self._palette.step(1),
            "previous_entry": lambda: self._palette.step(-1),
        }  # fmt: skip

    def undo(self) -> None:
        tools = self.session.tools
        before = tools.draft
        is_done = tools.undo()
        self._tell_step("Undone" if is_done else "Nothing to undo", tools.draft, before, always=not is_done)

    def redo(self) -> None:
        tools = self.session.tools
        before = tools.draft
        is_done = tools.redo()
        self._tell_step("Redone" if is_done else "Nothing to redo", before, tools.draft, always=not is_done)

    def _tell_step(self, done: str, before: Draft, after: Draft, *, always: bool) -> None:
        """Say which change from one draft to the other was undone or redone, and whether the file has the result.

        ``always``: even if nothing has changed.
        """
        saved = self.session.edited.source.path and self.session.is_saved
        text = change_text(before, after)
        if text or always:
            now = ". Now as saved" if text and saved else ""
            self.view.hint = ": ".join(filter(None, (done, text))) + now

    def choose(self, button: Area, name: str) -> None:
        """Do a command; one with several steps shows a list of them below its button."""
        steps = self._steps().get(name)
        if steps:
            rows: list[MenuRow] = [(step.capitalize(), do, "") for step, do in steps.actions.items()]
            self.app.push(DropDown(self.app, button, rows, at=list(steps.actions).index(steps.now)))
        else:
            self.run(name)

    def snap(self, snap: str) -> None:
        self.session.tools.brush.snap = snap

    def mirror(self, symmetry: str) -> None:
        self.session.tools.finish()
        self.session.tools.brush.symmetry = symmetry
        self.view.hint = f"Mirror: {_MIRRORS[symmetry]}"

    def switch_slopes(self) -> None:
        tools = self.session.tools
        self.session.set_slopes(not tools.brush.slopes)
        how = "set themselves where full tiles are drawn or erased" if tools.brush.slopes else "stay as drawn"
        self.view.hint = f"Slopes {how}"

    def show_list(self, listing: bool) -> None:
        self.view.listing = listing

    def switch_lines(self) -> None:
        self.view.lines = not self.view.lines
        self.view.hint = f"Lines from doors and exits to their switches are {_shown(self.view.lines)}"

    def switch_paths(self) -> None:
        self.view.paths = not self.view.paths
        self.view.hint = f"Paths of the last test and of the solver are {_shown(self.view.paths)}"

    def switch_playtests(self) -> None:
        """Show or hide the paths and deaths of all playtests of the level as it is."""
        view, count = self.view, len(self.session.edited.playtests.shown)
        view.playtest_map = not view.playtest_map
        what = f"{counted(count, 'test')}: darker where more of them came, a cross where one died"
        if not count:
            what = "No tests yet: F5 plays the level"
        view.hint = what if view.playtest_map else ""

    def next_reach(self) -> None:
        """Show what can be reached from the pointer with the next of the speeds, or hide it after the last."""
        self.session.edited.at_pointer.next_start()
        asks = self.session.edited.at_pointer.start != "off" and not self.view.hovering
        self.view.hint = "Point at a place in the level: it is shown what the ninja reaches from there" if asks else ""

    def go_to_finding(self, index: int) -> None:
        findings = self.session.examine()
        if not findings:
            self.app.notify("No problems found")
            return
        self.view.finding = index % len(findings)
        self.show_finding(findings[self.view.finding])
        self.view.hint = f"Problem {self.view.finding + 1} of {len(findings)}: the list says how to fix it"

    def show_finding(self, finding: Finding) -> None:
        """Select what a finding is about, and show it; a message on its page."""
        tools = self.session.tools
        places = finding_points(tools.draft.level, finding)
        records = [number for number in finding.records if number < len(tools.draft.objects)]
        tools.choose(frozenset((n, part) for n in records for part in points(tools.draft.objects[n])))
        if records:
            tools.tool = Tool.SELECT
        if places:
            tools.pointer = places[0]
            self.view.follow(*places[0])
            self.view.hovering = True
        self.view.hint = finding.advice
        if finding.message is not None:
            self.messages(finding.message)

    # --- playtesting and certifying ---

    def playtest(self, at: Point | None = None, *, says: str | None = None, lead: bytes = b"", deaths: int = 0) -> None:
        """Play the level. ``at``: where the ninja begins; there, no message of the level's start is shown.

        ``says``: other messages than the level's; ``lead``, ``deaths``: as of ``PlaytestScreen``.
        """
        session, entry = self.session, self._entry()
        session.tools.finish()
        try:
            level = with_ninja_at(session.draft, at) if at else session.draft.level
            says = session.draft.says if says is None else says
            screen = PlaytestScreen(session, level, says=says, there=entry, lead=lead, deaths=deaths)
        except LevelError as error:
            self.app.notify(f"{error.what}: Shift+N and a click places a ninja, F6 tests with one at the pointer")
            return
        if at:
            screen.play.messages.drop_start()
            screen.play.messages.at_start()
        self.app.push(screen)

    def playtest_message(self, number: int, place: Point | None, says: str) -> None:
        """Play the level with these messages from just before one of them; ``place``: where it is said, if known.

        The way there is that of the known run, or of the last playtest; else it begins on a floor before the place.
        """
        session, level = self.session, self.session.draft.level
        messages = parse_messages(says)
        message = messages[number] if messages else None
        if message is None or message.when in {Moment.START, Moment.DEATH}:
            self.playtest(says=says, deaths=int(message.number) if message else 0)
            return
        waits = bytes(int(message.number * TICKS_PER_SECOND) + 1)
        last = [playtest.inputs for playtest in session.edited.playtests.shown[-1:] if playtest.level == level]
        runs = [session.certifying_inputs, *last, waits]
        with suppress(LevelError):  # without a ninja, which the playtest reports
            moments = ((run, appearances(messages, level, run)[number]) for run in filter(None, runs))
            lead = next((lead_in(level, run, moment.due) for run, moment in moments if moment), None)
            if lead is not None:
                self.playtest(says=says, lead=lead)
                return
        at = place and place_before(session.draft, place, message.size, touch=message.when != Moment.AT)
        self.playtest(at, says=says)

    def certify(self) -> None:
        certifier = self.session.certifier
        self.session.tools.finish()
        level = self.session.draft.level
        if certifier.is_compiling and not certifier.is_stale(level):
            self.app.notify("Still preparing: F7 stops the search that follows", here=True)
            return
        if certifier.is_busy and not certifier.is_stale(level):
            certifier.stop()
            self.app.notify(f"{'Stopped. ' if certifier.certification.run else ''}{certifier.text}", here=True)
            return
        start = partial(certifier.start, level)
        findings = self.session.examine()
        odd = [number for finding in findings if finding.code in UNREACHABLE_CODES for number in finding.records]
        if any(finding.code in ("no-ninja", "no-exit") for finding in findings):
            self.app.notify("Place a ninja and an exit with its switch first")
        elif any(level.objects[number].kind == EXIT for number in odd):
            anyway: MenuRow = "Look for a run anyway", start, "It may be reached in a way nobody expects"
            self.app.push(Menu(self.app, "The ninja cannot reach the exit or its switch", [anyway, CANCEL]))
        else:
            start()

    # --- menus ---

    def menu(self) -> None:
        """Cancel one thing: a drawing, the selection, a tool. Show that the next press opens the menu."""
        view, tools = self.view, self.session.tools
        if view.take(None) or tools.cancel():
            return
        if tools.tool not in (Tool.BRUSH, Tool.SELECT):
            tools.tool = Tool.BRUSH
        elif view.offers_menu:
            view.hint = ""
            self.file_menu()
        else:
            view.offer_menu()

    def more(self) -> None:
        """A menu of all commands about playtests and about what is shown, for the mouse."""

        def playtest_at(cell: Cell | None) -> None:
            if cell:
                self.playtest(self.session.tools.pointer)

        def ask() -> None:
            self.view.taker = playtest_at
            self.view.hint = "Click where the ninja begins; Esc cancels"

        here, *commands = (EDITOR_COMMANDS.by_name[name] for name in ("playtest_here", *IN_MORE))
        choose_place = "Test with the ninja at a click", ask, f"Key at the pointer: {key_text(here)}"
        rows = [(command.label, partial(self.run, command.name), f"Key: {key_text(command)}") for command in commands]
        self.app.push(Menu(self.app, "More", [choose_place, *rows, CANCEL]))

    def file_menu(self) -> None:
        """The menu behind the button; a drawing is cancelled first."""
        session = self.session
        self.view.take(None)
        session.tools.cancel()
        rows: list[MenuRow] = [
            ("Save", self.save, "Ctrl+S"), ("Save as...", self.save_as, "Ctrl+Shift+S"),
            ("Open...", self.open, "Ctrl+O"), ("New", self.new, "Ctrl+N"), ("About the level...", self.about, "F2"),
            ("Messages...", self.messages, "What the level says while it is played: Shift+M"),
            ("Copy a link", partial(copy_level_link, self.app, session.draft, session.name), "Opens the level"),
            ("Copy as N level code", session.copy_string, ""),
            ("Paste a level", session.paste_string, "From the clipboard: text in any format, of N too, or a link"),
            ("Export a picture", session.export_picture, "A PNG file among your exports"),
            ("Save the run that was found", session.keep_certificate, "As a replay among yours"),
            ("Ten good levels", self.good_levels, "Ten of the game's, and what makes each of them good"),
            *in_page_or_not([], [("Packs...", self.packs, "Bundle your levels; Back leads here")]),
            ("Leave the editor", self.leave, ""),
        ]  # fmt: skip
        self.app.push(CommandMenu(self.app, "Level", rows, table=EDITOR_COMMANDS, names=_IN_MENU, run=self.run))

    # --- files ---

    @property
    def _levels(self) -> Path:
        return self.app.player.folder / LEVELS

    def own_path(self) -> Path | None:
        """The level's file, or a new path among the player's levels; None for a level without file and name."""
        path, name = self.session.edited.source.path, self.session.draft.name
        if path is None and name:
            return free_path(self._levels, file_stem(name, "level"), SUFFIX)
        return path

    def reload_rows(self, path: Path) -> list[MenuRow]:
        if path != self.session.edited.source.path or not path.exists():
            return []
        return [("Load it again", lambda: self._load(lambda: self.session.take(open_source(path))), _UNDO)]

    def follow_file(self) -> None:
        """Load a level's file that another program has changed; ask first if there are unsaved changes."""
        session = self.session
        saved = session.is_saved
        path = session.edited.source.path

        def follow() -> None:
            source = session.edited.changed_source()
            if source is None:
                return
            if saved:
                session.take(source)
                self.app.notify(f"Another program has changed the file: this is the new level. {_UNDO}")
                return
            rows: list[MenuRow] = [
                ("Keep what is here", nothing, "Saving asks again"),
                ("Load the file", lambda: session.take(source), _UNDO),
            ]
            self.app.push(Menu(self.app, f"Another program has changed {path.name if path else ''}", rows))

        self._load(follow)

    def saved_text(self, path: Path) -> str:
        return f"Saved{', and in the menu Levels' if path.is_relative_to(self._levels) else ''}: {path.name}"

    def save_as(self, then: Action = nothing) -> None:
        """Ask for the level's name, write it into a file of that name, and call ``then``."""
        session = self.session

        def on_accept(text: str) -> None:
            name = text.strip() or NAMELESS
            folder = session.edited.source.path.parent if session.edited.source.path else self._levels
            save = partial(session.save, name=name)
            self.save_to(folder / f"{file_stem(name, 'level')}{SUFFIX}", then, save=save)

        prompt = f"Name of the level, or else {NAMELESS}"
        ask_text(self.app, "Save as", prompt, session.draft.name, "Save", on_accept, 60)

    def about(self) -> None:
        prompts = {"teaches": "What it teaches"}
        about = headers_of(self.session.draft)
        del about["says"]  # messages have a screen of their own
        fields = [(prompts.get(key, key.capitalize()), text, 200) for key, text in about.items()]

        def on_accept(texts: list[str]) -> None:
            tools = self.session.tools
            tools.finish()
            self.app.remember_author(tools.draft.author, texts[1])
            tools.history.change(replace(tools.draft, **(about | dict(zip(about, texts, strict=True)))))

        self.app.push(FormPanel(self.app, "About the level", fields, "OK", on_accept))

    def messages(self, at: int | None = None) -> None:
        """Edit the level's messages, a new place begins at the selection or the ninja.

        ``at``: the number of the message to begin with.
        """
        tools = self.session.tools
        tools.finish()
        selected = [points(tools.draft.objects[number]).get(part) for number, part in tools.selection.parts]
        ninjas = (at for spec in tools.draft.objects if spec.kind == NINJA for at in points(spec).values())
        place = cell_of(*next(filter(None, (*selected, *ninjas)), tools.pointer))
        here = min(max(1, place[0]), COLUMNS), min(max(1, place[1]), ROWS)

        def put(says: str) -> None:
            tools.history.change(replace(tools.draft, says=says))

        entry = self._entry()
        mood = entry.mood if entry else Mood()
        screen = partial(MessagesScreen, self.app, tools.draft, here, put, self.playtest_message, mood)
        self.app.push(screen(lambda: self.session.certifying_inputs, at))

    def _entry(self) -> Entry | None:
        """The level's file as a level to play: in its pack, or alone; None without a file."""
        alone = self.session.entry
        packs = self.app.player.catalogue.packs() if alone else ()
        levels = (level for pack in packs for level in pack.levels)
        return alone and next((level for level in levels if level.named.file == alone.named.file), alone)

    def open(self) -> None:
        self.unless_unsaved(lambda: self.app.push(LevelChoice(self.app, self.edit_entry)))

    def good_levels(self) -> None:
        """Show the screen of good levels; each can be opened here."""
        self.app.push(GoodLevelsScreen(self.app, lambda entry: self.unless_unsaved(lambda: self.edit_entry(entry))))

    def packs(self) -> None:
        """Show the player's packs over the editor, which then edits the level that is chosen there."""
        from ninja_game.play.menus.packs import PackScreen  # it needs NumPy, which takes a moment

        app, editor = self.app, self.app.top

        def edit(entry: Entry, finding: Finding | None = None) -> None:
            while app.top is not editor:
                app.pop()
            self.unless_unsaved(lambda: self.edit_entry(entry, finding))

        app.push(PackScreen(app, edit))

    def edit_entry(self, entry: Entry, finding: Finding | None = None) -> None:
        """Edit a level of the browser: the player's in its file; a copy of the game's or of a zip's. Show a finding."""
        path = Path(entry.named.file)
        if entry.source != GAME and entry.named.ascii and path.is_file():
            self.open_file(path)
        else:
            self.session.begin(Source(draft_of(entry.named)))
        if finding:
            self.show_finding(finding)

    def open_file(self, path: Path) -> None:
        self._load(lambda: self.session.begin(open_source(path)))

    def _load(self, action: Action) -> None:
        """Load or keep something, and show a notice if its file cannot be read or written."""
        with self.app.errors_as_notices():
            action()

    def offer_recovered(self) -> None:
        """Ask what to do with a level that was open when the program crashed."""
        draft = next(lost_drafts(self.app.player.folder), None)
        if draft is not None:
            name = draft.draft.name or (draft.source.path.name if draft.source.path else "a new level")
            about = "As it was at most two seconds before the end"
            self.ask_about_recovered(name, lambda: self.session.begin(draft.source, draft), draft.forget, about=about)

    def new(self) -> None:
        begin, author = self.session.begin, self.app.settings.name
        rows: list[MenuRow] = [
            ("A room", lambda: begin(new_source(author, room=True)), "A floor, the ninja, the exit and its switch"),
            ("Empty", lambda: begin(new_source(author)), "Nothing at all"),
            CANCEL,
        ]
        self.unless_unsaved(lambda: self.app.push(Menu(self.app, "New level from", rows)))
