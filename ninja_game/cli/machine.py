"""Commands about this machine: the menu of programs, compiled rules, the player's data."""

from __future__ import annotations

import os
import shutil
import sqlite3
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ninja_game.cli.options import NEW_FILE, OLD_FILE
from ninja_game.cli.progress import heartbeat
from ninja_game.errors import FileError, NinjaGameError
from ninja_game.files.bundled import asset_text
from ninja_game.files.shown_text import shown_text
from ninja_game.runtime import cores

if TYPE_CHECKING:
    from ninja_game.player.player_data import PlayerData

_ICON = 256  # width and height of the icon, px

UPDATES = (("update-mime-database", "mime"), ("update-desktop-database", "applications"))
"""Programs that announce new files to desktops, if installed, and the folder for each."""


@click.command()
@click.option("--remove", is_flag=True, help="Remove it again.")
def desktop(remove: bool) -> None:
    """Put the game into your menu of programs, with its icon and types of files.

    Levels (*.level, *.nlevel) and replays (*.replay.txt, *.replay) open by a double click.
    For Linux and other systems with freedesktop.org's menus; only for you, below ~/.local/share (XDG_DATA_HOME).

    \b
    Examples:
      ninja-game desktop
      ninja-game desktop --remove
    """
    if sys.platform in ("win32", "darwin"):
        raise NinjaGameError("this system's menu of programs is not known here; `ninja-game play` starts the game")
    from platformdirs import user_data_path

    folder = user_data_path()
    for path, content in desktop_files(folder, program_words()).items():
        if remove:
            path.unlink(missing_ok=True)
        else:
            from ninja_game.files.writing import write_atomically

            path.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(path, content)
    for name, part in UPDATES:
        if (program := shutil.which(name)) and (folder / part).is_dir():
            subprocess.run([program, str(folder / part)], capture_output=True, check=False)  # noqa: S603
    click.echo(f"{'Removed from' if remove else 'In'} the menu of programs: {folder / 'applications'}")


def program_words() -> list[str]:
    """The words that start this program from any folder."""
    if getattr(sys, "frozen", False):
        return [sys.executable]
    script = Path(sys.executable).with_name("ninja-game")
    return [str(script)] if script.exists() else [sys.executable, "-P", "-m", "ninja_game"]


def desktop_files(folder: Path, program: list[str]) -> dict[Path, str | bytes]:
    """The files below a folder of data such as ~/.local/share, with their contents."""
    from ninja_game.ui.canvas import png_of
    from ninja_game.view.ninja.figure import icon

    command = " ".join(map(_quoted, program))
    files: dict[Path, str | bytes] = {
        folder / "applications" / name: asset_text(f"desktop/{name}").format(command=command)
        for name in ("ninja-game.desktop", "ninja-game-replay.desktop")
    }
    files[folder / "mime" / "packages" / "ninja-game.xml"] = asset_text("desktop/ninja-game.xml")
    files[folder / "icons" / "hicolor" / f"{_ICON}x{_ICON}" / "apps" / "ninja-game.png"] = png_of(icon(_ICON))
    return files


def _quoted(word: str) -> str:
    """A word in the syntax of the key Exec of a menu's file."""
    for sign in ("\\", '"', "`", "$"):
        word = word.replace(sign, f"\\{sign}")
    # Desktop files have their own rules for escaping.
    return f'"{word}"'.replace("\\", "\\\\").replace("%", "%%")


MAX_PROCESSES = 2  # each process compiles the rules again; more processes would only wait for each other

_EVERY = 0.5  # seconds between two looks whether another process is done


@click.command(name="compile")
@click.option("--background", is_flag=True, help="At low priority; does nothing if another process compiles already.")
def compile(background: bool) -> None:  # noqa: A001 - the name of the command
    """Compile the rules for this machine now, so that no other command waits for it.

    Compiled rules are kept, and not compiled again. Other commands and the game start this in the background; with
    NINJA_GAME_BACKGROUND_COMPILER=0 in the environment they compile what they need themselves, and wait for it.

    \b
    Examples:
      ninja-game compile
      NINJA_GAME_BACKGROUND_COMPILER=0 ninja-game verify levels/certificates
    """
    from ninja_game.backend.background_compiler import lock_compilation, lower_priority
    from ninja_game.backend.kernel_cache import before_compiling

    # This command reports its own progress.
    before_compiling.clear()
    handle = lock_compilation()
    if background:
        if handle is None:
            return
        lower_priority()
    elif handle is None:
        click.echo("Another process compiles; waiting for it", err=True)
        while (handle := lock_compilation()) is None:
            time.sleep(_EVERY)
    try:
        compile_everything(min(MAX_PROCESSES, cores()), quiet=background)
    finally:
        os.close(handle)


def compile_everything(processes: int, *, quiet: bool) -> None:
    """Do a little of all work that needs kernels, most wanted first, in this many processes.

    Raises NinjaGameError where nothing is kept.
    """
    from ninja_game.backend.kernel_cache import are_cached, code_folder
    from ninja_game.backend.kernels import run_world
    from ninja_game.runs.workers import open_workers, results_of

    began = time.monotonic()
    with open_workers(processes, processes=processes > 1) as pool:
        for number, (name, lost) in enumerate(results_of(pool, compile_for, WORK), 1):
            if lost is not None:
                raise lost
            if number == 1 and not any(are_cached([run_world], checked) for checked in (False, True)):
                where = code_folder()
                raise NinjaGameError(f"compiled code is not kept in {where}: make room there, or let it be written")
            if not quiet:
                click.echo(f"{number} of {len(WORK)} compiled: {name}", err=True)
    if not quiet:
        click.echo(f"All is compiled, in {time.monotonic() - began:.0f} s: {code_folder()}")


WORK = ("runs and traces", "verdicts", "many worlds", "the solver", "searches in spans of runs", "what agents observe")
"""The jobs of ``compile_for``, in this order."""


def compile_for(name: str) -> None:
    """Do a little work of that name: its kernels are in the cache then."""
    from ninja_game.formats.n14.level_string import parse_level_string
    from ninja_game.search.solve import SMALL_LEVEL, compile_solver

    level = parse_level_string(SMALL_LEVEL)
    match name:
        case "runs and traces":
            from ninja_game.backend.memories import open_worlds
            from ninja_game.sim.states import NO_CAUSE

            worlds = open_worlds("compiled", level, box=False)
            worlds.run(b"\0")
            worlds.trace(b"\0", [worlds.observe(1)[0]], events=True)
            worlds.step(0)
            worlds.kill(NO_CAUSE, 0.0, 0.0)
        case "verdicts":
            from ninja_game.backend.memories import proven_memory

            proven_memory("compiled")
        case "many worlds":
            from ninja_game.batch.difficulty import difficulty

            difficulty(level, b"\2" * 20, tries=1)
        case "the solver":
            compile_solver()
        case "searches in spans of runs":
            from ninja_game.search.formula.methods import search_span
            from ninja_game.search.formula.task import SpanTask

            search_span(SpanTask(level, b"\2" * 9, 0, 9, measure="x"), lambda *_: False)
        case "what agents observe" if find_spec("gymnasium"):
            import numpy as np

            from ninja_game.learn.worlds import EnvWorlds

            environments = EnvWorlds(level, 1)
            environments.reset()
            environments.step(np.zeros(1, np.uint8))


@click.group()
def player() -> None:
    """Export all data of a player to one file, or import such a file.

    Settings, records, own levels and replays. The game in a browser writes and reads the same file (its page menu), so
    that records move between a page and this machine.

    \b
    Examples:
      ninja-game player export my-data.zip
      ninja-game player import my-data.zip
    """


@player.command("export")
@click.argument("file", type=NEW_FILE)
def export(file: Path) -> None:
    """Write all data of the player into FILE, a zip."""
    from ninja_game.player.backup import write_backup

    with _player() as data:
        for line in write_backup(data, file):
            click.echo(line, err=True)


@player.command("import")
@click.argument("file", type=OLD_FILE)
def import_backup(file: Path) -> None:
    """Import FILE. Better runs replace worse ones; nothing of yours is overwritten."""
    from ninja_game.files.reading import read_bytes
    from ninja_game.player.backup import MAX_BACKUP_BYTES, read_backup

    with _player() as data, heartbeat(lambda: "runs the replays of the backup again"):
        for line in read_backup(data, read_bytes(file, MAX_BACKUP_BYTES)):
            click.echo(shown_text(line))


@contextmanager
def _player() -> Iterator[PlayerData]:
    """The player's data, closed afterwards. Raises FileError for records that cannot be used."""
    from ninja_game.player.player_data import PlayerData

    data = PlayerData()
    try:
        data.open_records()
        if data.store.problem:
            raise FileError(data.store.problem, str(data.folder))
        yield data
    except sqlite3.Error as error:
        raise FileError("the records cannot be used now", str(data.folder), found=str(error)) from None
    finally:
        data.close()
