"""`ninja-game desktop`: the game in the menu of programs, with its icon and its types of files."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import click

ENTRY = """[Desktop Entry]
Type=Application
Name={name}
Comment=A platformer of single screens: play, edit, replay
Exec={command} {words} %f
Icon=ninja-game
Terminal=false
Categories=Game;ArcadeGame;
StartupWMClass=ninja-game
MimeType={kinds};
NoDisplay={hidden}
"""

LEVEL, REPLAY = "text/x-ninja-game-level", "text/x-ninja-game-replay"

ENTRIES = {
    "ninja-game.desktop": ("ninja-game", "play", LEVEL, "false"),
    "ninja-game-replay.desktop": ("ninja-game: watch", "play --replay", REPLAY, "true"),
}
"""Files of the menu: name, words after the program, type of file, whether the menu leaves it out."""

TYPES = f"""<?xml version="1.0" encoding="UTF-8"?>
<mime-info xmlns="http://www.freedesktop.org/standards/shared-mime-info">
  <mime-type type="{LEVEL}">
    <comment>level of ninja-game</comment>
    <sub-class-of type="text/plain"/>
    <icon name="ninja-game"/>
    <magic priority="60"><match type="string" offset="0" value="ninja-game level "/></magic>
    <glob pattern="*.level"/>
    <glob pattern="*.nlevel"/>
  </mime-type>
  <mime-type type="{REPLAY}">
    <comment>replay of ninja-game</comment>
    <sub-class-of type="text/plain"/>
    <icon name="ninja-game"/>
    <magic priority="60"><match type="string" offset="0" value="ninja-game replay "/></magic>
    <glob pattern="*.replay.txt"/>
    <glob pattern="*.replay"/>
  </mime-type>
</mime-info>
"""

ICON = 256
"""Width and height of the icon, px."""

UPDATES = (("update-mime-database", "mime"), ("update-desktop-database", "applications"))
"""Programs that tell desktops of new files, where they are installed, and the folder that each is given."""


@click.command()
@click.option("--remove", is_flag=True, help="Take it out again.")
def desktop(remove: bool) -> None:
    """Put the game into your menu of programs, with its icon and types of files.

    Levels (*.level, *.nlevel) and replays (*.replay.txt, *.replay) open by a double click.
    For Linux and other systems with freedesktop.org's menus; only for you, below ~/.local/share (XDG_DATA_HOME).

    \b
    Examples:
      ninja-game desktop
      ninja-game desktop --remove
    """
    from ninja_game.errors import NinjaGameError

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
    """How this program is started, from any folder."""
    if getattr(sys, "frozen", False):
        return [sys.executable]
    script = Path(sys.executable).with_name("ninja-game")
    return [str(script)] if script.exists() else [sys.executable, "-P", "-m", "ninja_game"]


def desktop_files(folder: Path, program: list[str]) -> dict[Path, str | bytes]:
    """The files below a folder of data such as ~/.local/share, with what is in each."""
    from ninja_game.play.window import icon, png_of

    command = " ".join(map(_quoted, program))
    files: dict[Path, str | bytes] = {
        folder / "applications" / file: ENTRY.format(name=name, command=command, words=words, kinds=kind, hidden=hidden)
        for file, (name, words, kind, hidden) in ENTRIES.items()
    }
    files[folder / "mime" / "packages" / "ninja-game.xml"] = TYPES
    files[folder / "icons" / "hicolor" / f"{ICON}x{ICON}" / "apps" / "ninja-game.png"] = png_of(icon(ICON))
    return files


def _quoted(word: str) -> str:
    """A word as the key Exec of a menu's file has it."""
    for sign in ("\\", '"', "`", "$"):
        word = word.replace(sign, f"\\{sign}")
    # Texts in such a file have escapes of their own.
    return f'"{word}"'.replace("\\", "\\\\").replace("%", "%%")
