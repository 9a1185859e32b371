"""The menus of the screen of packs: the actions on a pack, an episode, a level."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from math import inf
from pathlib import Path

from ninja_game.editor import packs
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN, EpisodeIndex
from ninja_game.formats.pack.pack import Pack
from ninja_game.play.level.screen import play_level
from ninja_game.play.menu_screen import CANCEL, FormPanel, Menu, MenuRow, Question, nothing
from ninja_game.play.menus.episodes import PREVIEW, EpisodeGrid
from ninja_game.play.menus.open_pack import open_pack
from ninja_game.play.menus.pack_desk import PackDesk
from ninja_game.play.menus.pack_shelves import PackCell, called
from ninja_game.play.panels.replays import watch_replays

DELETED = "deleted"  # the folder of deleted packs among the player's files

MADE = "Made, and opened in the editor"


def view(desk: PackDesk) -> None:
    """Show the episodes of the pack; those of the player's own packs as a new player sees them."""
    if desk.pack:
        newcomer = None if desk.is_received else desk.player.newcomer()
        desk.app.push(EpisodeGrid(desk.app, desk.pack.key, newcomer))


def pack_menu(desk: PackDesk) -> None:
    if pack := desk.pack_now():
        desk.app.push(Menu(desk.app, pack.name, [*pack_rows(desk, pack), CANCEL]))


def pack_rows(desk: PackDesk, pack: Pack) -> list[MenuRow]:
    """What can be done with the shown pack; who received it does not change it."""
    key, name = (desk.pack.key, desk.pack.name) if desk.pack else ("", "")
    empty = not pack.episodes
    busy = desk.packer.is_busy and desk.packer.path == desk.path
    deleting = "It is being made ready" if busy else "It goes to the folder deleted, and Undo brings it back"
    without = "No episode has levels" if empty else ""
    play = None if empty else lambda: desk.app.push(EpisodeGrid(desk.app, key))
    own: list[MenuRow] = [
        ("Show it as received", None if empty else lambda: view(desk), without or PREVIEW),
        ("Name, author, version...", lambda: pack_form(desk, pack), ""),
        ("Copy of the pack", lambda: desk.copy_pack(pack), ""),
    ]
    update = partial(open_pack, desk.app, f"Update {shown_text(pack.name)}")
    received: list[MenuRow] = [
        ("Update it...", update, "From the zip or link of a newer version"),
        ("Copy it, to change that", lambda: desk.copy_pack(pack), "What was received stays as it is"),
    ]
    return [
        ("Play it", play, without),
        *(received if desk.is_received else own),
        ("Delete the pack...", None if busy else lambda: _delete(desk, pack, name), deleting),
    ]


def pack_form(
    desk: PackDesk, pack: Pack, first: int = 0, yes: str = "OK", then: Callable[[], object] = nothing, version: str = ""
) -> None:
    """Ask for the texts of the index, from field number ``first`` on, with ``version`` proposed; then call ``then``."""
    index, path = pack.index, pack.files.path
    keys = ("name", "author", "version", "comment")
    author = index.author if index.is_signed else desk.player.settings.name
    signed = replace(index, author=author, version=version or index.version)
    fields = [(key.capitalize(), getattr(signed, key), 200) for key in keys]

    def describe(texts: list[str]) -> None:
        desk.app.remember_author(index.author, texts[1])
        values = {key: text.strip() for key, text in zip(keys, texts, strict=True)}

        def change() -> None:
            packs.describe(path, values)
            then()

        desk.run_step(change, "About the pack")

    form = FormPanel(desk.app, "What players see", fields, yes, describe)
    desk.app.push(form)
    form.focus = form.widgets[first]


def _delete(desk: PackDesk, pack: Pack, name: str) -> None:
    def delete() -> None:
        place = packs.bin_pack(pack.files.path, desk.player.folder / DELETED)
        desk.app.notify(f"{shown_text(name)} is in the folder {place.relative_to(desk.player.folder)} now")

    title = f"Delete {shown_text(name)} with its {counted(len(pack.files.levels), 'level')}?"
    hint = f"All goes to the folder {DELETED}; Undo brings it back"
    step = partial(desk.run_step, delete, f"Delete {shown_text(name)}")
    desk.app.push(Question(desk.app, title, "Delete it", step, hint))


def level_menu(desk: PackDesk, cell: PackCell) -> None:
    level, episode = cell.level, cell.episode
    if level is None:
        return
    file, levels = Path(level.named.file), desk.levels_with(level)
    rename = partial(packs.rename_level, file)
    run, title = desk.player.catalogue.author_run(level), called(levels)

    def copy() -> None:
        names = [packs.duplicate(desk.path, level.named) for level in levels]
        packs.place(desk.path, names, episode.number if episode else None)

    def play() -> None:
        if why := play_level(desk.app, level):
            desk.app.notify(why)

    rows: list[MenuRow] = []
    if len(levels) == 1:
        rows = [
            ("Edit", partial(desk.edit_level, level), ""),
            ("Play", play, ""),
            ("Watch the run", partial(watch_replays, desk.app, [run]) if run else None, "" if run else "None is known"),
        ]
        if file.parent == desk.path:
            rows.append(
                ("Rename...", lambda: desk.ask_text_for(f"Rename {level.named.name}", level.named.name, rename), "")
            )
    rows.append(("Move...", lambda: desk.start_moving(cell), ""))
    if all(Path(level.named.file).parent == desk.path for level in levels):
        rows.append(("Copy", lambda: desk.run_step(copy, f"Copy {title}"), "Another level like it"))
    if removal := removal_of(desk, cell):
        rows.append(("Take out", removal, "Into no episode") if episode else ("Delete", removal, "Undo brings it back"))
    desk.app.push(Menu(desk.app, title, [*rows, CANCEL]))


def removal_of(desk: PackDesk, cell: PackCell) -> Callable[[], object] | None:
    """Takes a level out of its episode, or deletes one of the player's in none; None for any other level."""
    levels = desk.levels_with(cell.level) if cell.level else []
    title = called(levels)
    if levels and all(Path(level.named.file).parent == desk.path and level.episode for level in levels):
        names = [Path(level.named.file).name for level in levels]
        return lambda: desk.set_aside(partial(packs.place, desk.path, names, None), title)
    if not levels or desk.tray_key not in ("none", "yours") or not all(level.named.ascii for level in levels):
        return None

    def delete() -> None:
        for level in levels:
            packs.transfer(level.named, desk.player.folder / DELETED, keep=False)
        desk.app.notify(f"{title}: in the folder {DELETED} now; Ctrl+Z brings back")

    return lambda: desk.run_step(delete, f"Delete {title}")


def ask_for_new_level(desk: PackDesk, number: int) -> None:
    """Ask for the name of a new level of an episode; it is made, and opened in the editor."""
    path = desk.path

    def make(name: str) -> None:
        file = packs.new_level(path, name, desk.player.settings.name)
        packs.place(path, [file], number)
        desk.read_packs()
        if entry := desk.entry_of(file):
            desk.edit(entry, None)

    desk.ask_text_for("New level: its name", "New level", make)


def episode_menu(desk: PackDesk, episode: EpisodeIndex) -> None:
    number, path = episode.number, desk.path
    title = episode.name or f"Episode {number + 1}"
    column = number // EPISODES_PER_COLUMN
    columns = list(desk.pack.columns if desk.pack else ())
    columns += [""] * (column + 1 - len(columns))

    def sort() -> None:
        levels = [cell.level for cell in desk.shelves.cells if cell.level and cell.episode is episode]
        levels.sort(key=lambda level: (level.pars and level.pars.difficulty) or inf)
        names = [Path(level.named.file).name for level in levels]
        desk.run_step(partial(packs.place, path, names, number), f"Sort {title}")

    def name_column(name: str) -> None:
        packs.describe(path, {"columns": [*columns[:column], name, *columns[column + 1 :]]})

    rename, remove = partial(packs.rename_episode, path, number), partial(packs.remove_episode, path, number)
    begin = partial(packs.new_episode, path, column=desk.column + 1)
    rows: list[MenuRow] = [
        ("New level...", lambda: ask_for_new_level(desk, number), MADE),
        ("Rename...", lambda: desk.ask_text_for(f"Rename {episode.name}", episode.name, rename), ""),
        ("Move...", lambda: desk.start_moving(PackCell(episode, head=True)), ""),
        ("Sort by difficulty", sort, "Easiest first, those not measured last"),
        ("Name of the column...", lambda: desk.ask_text_for("Name of the column", columns[column], name_column), ""),
        (
            "Begin a column...",
            lambda: desk.ask_text_for("Column: first episode", desk.next_name, begin),
            "Beside these",
        ),
        ("Remove the episode", lambda: desk.set_aside(remove, title), "Its levels stay, beside the others"),
        CANCEL,
    ]
    desk.app.push(Menu(desk.app, title, rows))
