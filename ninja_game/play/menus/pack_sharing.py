"""Packs are shared and received: their problems, *Make ready*, zips and links, and packs from others."""

from __future__ import annotations

import webbrowser
from collections.abc import Callable
from functools import partial
from pathlib import Path

from ninja_game.editor import packs
from ninja_game.editor.ready_pack import ReadyPack, missing_run
from ninja_game.errors import NinjaGameError, reason
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.files.user_folder import short_path
from ninja_game.formats.pack.index import NEVER_ACCEPTED
from ninja_game.formats.pack.pack import INDEX, PARS, Pack
from ninja_game.levels.findings import PackFinding
from ninja_game.play.clipboard import copy_link
from ninja_game.play.menu_screen import CANCEL, FormPanel, Menu, MenuRow
from ninja_game.play.menus.episodes import PREVIEW
from ninja_game.play.menus.open_pack import paste_link
from ninja_game.play.menus.pack_desk import PackDesk
from ninja_game.play.menus.pack_menus import pack_form, pack_menu, view
from ninja_game.play.menus.packer import NOT_CERTIFIED, NOT_FOUND
from ninja_game.play.menus.problems import Problem, ProblemsScreen
from ninja_game.runs.packs import level_file_of

_STOPS = "It can be stopped at any time: what was found is kept."


def problems(desk: PackDesk) -> list[Problem] | None:
    """The findings about the shown pack as it is on the disk, then the next step; None until they are known.

    A check that failed is a problem itself.
    """
    desk.read_packs(news=True)
    pack, status = desk.pack and desk.pack.pack, desk.status
    if pack is None:
        return []
    if status.present is None:
        return [Problem(status.failure)] if status.failure else None
    rows = [_problem(desk, pack, finding) for finding in status.present.findings]
    to_do = status.to_do()
    verdict = "" if status.present.problems else "Nothing is wrong"
    if not (verdict or to_do):
        return rows
    text = ". ".join(filter(None, (verdict, to_do)))
    if desk.zipped and desk.is_fresh and not to_do:
        hint = f"Or send the zip: {short_path(desk.zipped)}"
        last = Problem(text, hint, partial(copy_the_link, desk), step="Copy the link")
    else:
        hint = _STOPS if to_do else "It writes the zip and the link."
        last = Problem(text, hint, partial(prepare_shown, desk), step="Make ready")
    return [*rows, last._replace(go=None) if desk.packer.is_busy else last]


def _problem(desk: PackDesk, pack: Pack, finding: PackFinding) -> Problem:
    file, code = finding.file, finding.code
    entry = desk.entry_of(level_file_of(pack, file))
    values = {name: _as_seen(pack, value) for name, value in finding.values.items()}
    text = finding.text_with(values)
    text = f"{entry.title}: {text}" if entry else text[:1].upper() + text[1:]
    go: Callable[[], object] | None = partial(pack_menu, desk) if file == INDEX else None
    if code == "no-author":
        go = partial(pack_form, desk, pack, 1)
    elif entry:
        go = partial(desk.run_step, partial(desk.edit, entry, finding.odd), "Edit")
    if finding.reason:
        take_back = partial(packs.take_back, desk.path, file, code)
        text = f"{text}. Accepted: {finding.reason}"
        return Problem(text, "", go, lambda: desk.run_step(take_back, "Take it back"), accepted=True)

    def accept(why: str) -> None:
        packs.accept(desk.path, file, code, why)

    may = bool(file) and code not in NEVER_ACCEPTED
    accept_it = partial(desk.ask_text_for, "Accept this warning: why?", "", accept, "Write why") if may else None
    missing = missing_run(pack, finding) if finding.sought and not desk.packer.is_busy else None
    longer = partial(desk.packer.search_longer, desk.path, missing) if missing else None
    return Problem(text, finding.hint, go, accept_it, search=longer)


def _as_seen(pack: Pack, value: object) -> object:
    """A value of a finding as the desk shows it: numbers from 1, not from 0; levels by name, not by file."""
    if isinstance(value, int):
        return value + 1
    named = pack.levels.get(value) if isinstance(value, str) else None
    return named.name if named else value


def show_problems(desk: PackDesk) -> None:
    desk.app.push(ProblemsScreen(desk.app, partial(problems, desk), desk.status.update))


def open_folder(desk: PackDesk) -> None:
    if desk.zipped and not webbrowser.open(desk.zipped.parent.as_uri()):
        desk.app.notify(f"Nothing here opens folders: it is {short_path(desk.zipped.parent)}")


def copy_the_link(desk: PackDesk) -> None:
    """Copy the link; for an own pack first ask whether to include levels without certificate."""
    pack = desk.pack_now()
    if not (desk.pack and pack):
        return
    copy = partial(copy_link, desk.app, pack.files.link, title=desk.pack.name)
    own = [] if desk.is_received else desk.pack.levels
    without = [level for level in own if desk.status.state(level) in (*NOT_CERTIFIED, NOT_FOUND)]
    rows: list[MenuRow] = [
        ("Make ready first", partial(prepare_shown, desk), "Certifies them, and gives the link"),
        ("Copy all the same", copy, "Whoever gets it is not told whether they can be passed"),
        CANCEL,
    ]
    if without:
        title = f"The link has {counted(len(without), 'level')} without certificate"
        desk.app.push(Menu(desk.app, title, rows))
    else:
        copy()


def prepare_shown(desk: PackDesk) -> None:
    """Make the shown pack ready; its form comes first without author or comment, or for a new version."""
    pack = desk.pack_now()
    if not (desk.pack and pack):
        return
    start = partial(desk.packer.start, desk.path)
    index = pack.index
    version = desk.packer.next_version(pack)
    follows = bool(index.version) and version != index.version
    is_described = bool(index.comment) or PARS in pack.files.names
    if index.is_signed and not follows and is_described:
        start()
        return
    first = 3
    if not index.is_signed:
        first = 1
    elif follows:
        first = 2
    pack_form(desk, pack, first, "Make ready", start, version)


def ask_for_new_pack(desk: PackDesk) -> None:
    def make(name: str, author: str = desk.player.settings.name) -> None:
        desk.app.remember_author("", author)
        desk.tray_key = "yours" if desk.player.catalogue.own() else "none"
        desk.new_path = packs.new_pack(desk.folder, name, author.strip())

    fields, step = [("Name", "My pack", 60)], "New pack"
    if not desk.player.settings.name:
        fields.append(("Author", "", 40))
    desk.app.push(FormPanel(desk.app, step, fields, "OK", lambda texts: desk.run_step(lambda: make(*texts), step)))


def paste(desk: PackDesk) -> None:
    """Take in the pack whose link is in the clipboard."""
    paste_link(desk.app, partial(install_received, desk))


def install_received(desk: PackDesk, path: Path) -> None:
    """Install a received pack among the player's, instead of an older version if the player agrees."""
    try:
        pack = Pack(path)
    except (NinjaGameError, OSError) as error:
        desk.app.notify(reason(error))
        return

    def receive(over: Pack | None = None) -> None:
        def copy() -> None:
            news = packs.news(over, pack) if over else ""
            desk.new_path = packs.copy_pack(pack, desk.folder, pack.name, received=True, over=over)
            news = news or f"kept among your packs, in {short_path(desk.new_path)}"
            desk.app.notify(f"{shown_text(pack.name)}: {news}")

        desk.run_step(copy, f"Update {pack.name}" if over else "Paste link")
        desk.focus_on(desk.play_button)

    name, author = shown_text(pack.name), pack.index.author
    older = [own.pack for own in desk.own_packs if own.pack and own.received and own.pack.name == pack.name]
    if same := next((own for own in desk.own_packs if own.pack and packs.same_pack(pack, own.pack)), None):
        desk.show(same)
        rows: list[MenuRow] = [
            ("Play it", partial(view, desk), "")
            if same.received
            else ("Show it as received", partial(view, desk), PREVIEW),
            ("Receive it once more", receive, "Beside this one"),
            CANCEL,
        ]
        desk.app.push(Menu(desk.app, f"{shown_text(same.name)} is among your packs already", rows))
    elif over := next((old for old in older if old.index.author == author), None):
        rows = [("Update it", partial(receive, over), packs.news(over, pack)), ("Keep both", receive, ""), CANCEL]
        desk.app.push(Menu(desk.app, f"You have {name} {over.index.version or 'in another version'}", rows))
    else:
        receive()


def ask_about(desk: PackDesk, ready: ReadyPack) -> None:
    rows: list[MenuRow] = [
        ("Show the problems", lambda: show_problems(desk), "Make ready asks about what is left"),
        ("Zip and link all the same", partial(desk.packer.publish, ready), "")
        if ready.zipped
        else ("Make ready all the same", partial(desk.packer.start, desk.path, known=ready.problems), "With these"),
        CANCEL,
    ]
    news, count = len(desk.packer.news(ready.problems)), len(ready.problems)
    summary = counted(count, "open problem") if news == count else f"{counted(news, 'new problem')}, {count} open"
    title = f"{shown_text(ready.pack.name)}: {summary}"
    desk.app.push(Menu(desk.app, title, rows, unasked=True))
