"""All settings, with the allowed values and the default of each."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator, Mapping, MutableMapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ninja_game.errors import FileError
from ninja_game.files.locking import locked
from ninja_game.files.reading import read_utf8
from ninja_game.files.shown_text import shown_text
from ninja_game.files.untrusted import parse_toml
from ninja_game.files.user_folder import quarantine
from ninja_game.files.writing import write_atomically

if TYPE_CHECKING:
    from tomlkit import TOMLDocument

SETTINGS_VERSION = 1
BINDING_TABLES = {"keys": "keys", "pad": "pad-buttons"}

COMMENT = "Settings of ninja-game. What is missing or wrong here has its default; comments stay."
MAX_SETTINGS_BYTES = 2**16  # a larger file is no file of settings; a number of this many digits is read within 0.1 s

LOCK_SECONDS = 1.0

BY_COLUMN = "by-column"  # the palette that changes with the column of episodes

GHOSTS = ("best", "next", "silver", "gold", "author")
"""Ghosts in play: the player's best run, or the pace of the next medal or of one."""

MAX_INPUTS = 16  # most keys or buttons of one action

InputNames = Mapping[str, tuple[str, ...]]  # action to the names of its inputs (ui/input/bindings.py)


class SettingSpec(NamedTuple):
    """The place of a setting in the file, its allowed values, and its meaning.

    ``span``: of a number, the lowest, the highest and a slider's step. ``convert``: converts a value from a file.
    """

    table: str  #: its table in the file
    fits: Callable[[Any], bool]  #: whether it may have a value
    expected: str  #: its values, in words
    meaning: str  #: for docs/settings.md
    span: tuple[float, float, float] = (0, 0, 0)
    convert: Callable[[Any], Any] = lambda value: value


def _setting(default: Any, table: str, fits: Callable[[Any], bool], expected: str, meaning: str) -> Any:
    return field(default=default, metadata={"spec": SettingSpec(table, fits, expected, meaning)})


def _flag(default: bool, table: str, meaning: str) -> Any:
    return _setting(default, table, lambda value: isinstance(value, bool), "true or false", meaning)


def _number(default: float, table: str, low: float, high: float, meaning: str, step: float = 1) -> Any:
    """A number as a setting; a whole number if its default is one."""
    sort, kind = ("a whole number", int) if isinstance(default, int) else ("a number", (int, float))

    def fits(value: Any) -> bool:
        return isinstance(value, kind) and not isinstance(value, bool) and low <= value <= high

    spec = SettingSpec(table, fits, f"{sort} from {low} to {high}", meaning, (low, high, step), type(default))
    return field(default=default, metadata={"spec": spec})


def _text(default: str, table: str, pattern: str, expected: str, meaning: str) -> Any:
    fits = re.compile(pattern).fullmatch
    return _setting(default, table, lambda value: isinstance(value, str) and bool(fits(value)), expected, meaning)


def _is_name(value: Any) -> bool:
    return isinstance(value, str) and len(value) <= 40 and (not value or value.isprintable())


def _is_bindings(value: Any) -> bool:
    if not isinstance(value, Mapping):
        return False
    return all(isinstance(action, str) and _are_inputs(inputs) for action, inputs in value.items())


def _are_inputs(value: Any) -> bool:
    if not isinstance(value, list | tuple) or len(value) > MAX_INPUTS:
        return False
    return all(isinstance(name, str) and name.isprintable() for name in value)


def _bindings_of(bindings: Mapping[str, Sequence[str]]) -> InputNames:
    return {action: tuple(inputs) for action, inputs in bindings.items()}


def _bindings(what: str, example: str) -> dict[str, SettingSpec]:
    expected = f"lists of names of {what}, such as jump = {example}"
    meaning = f"The {what} of each action that has others than the default ones"
    return {"spec": SettingSpec("", _is_bindings, expected, meaning, convert=_bindings_of)}


@dataclass(frozen=True)
class Settings:
    """Every setting. ``keys`` and ``pad`` hold only the actions without default inputs."""

    # The module that draws knows the palettes.
    palette: str = _text(
        BY_COLUMN,
        "look",
        "[a-z-]{1,24}",
        "the name of a palette, such as 'classic'",
        "The colours; with by-column each column has its own",
    )
    ninja_colour: str = _text(
        "", "look", "|#[0-9a-fA-F]{6}", "'' or a colour such as '#186285'", "The ninja's colour; empty: the palette's"
    )
    fullscreen: bool = _flag(False, "look", "The game fills the whole screen")
    smooth: bool = _flag(True, "look", "Motion is drawn between two ticks, too")
    reduced_motion: bool = _flag(False, "look", "Fewer particles; no shake, wipe or freeze; nothing moves behind menus")
    reduced_gore: bool = _flag(False, "look", "There is no blood")
    shake: int = _number(50, "look", 0, 100, "How far explosions shake the picture, percent", 5)
    particles: int = _number(100, "look", 0, 100, "How many of the particles are shown, percent", 5)
    show_ghost: bool = _flag(True, "look", "A ghost plays along, to race against")
    ghost: str = _text(
        "best",
        "look",
        "|".join(GHOSTS),
        "'best', 'next', 'silver', 'gold' or 'author'",
        "Your best run, or a medal's pace",
    )
    show_keys: bool = _flag(False, "look", "The keys that you hold are shown while you play")
    show_frame_time: bool = _flag(False, "look", "The time that a picture takes, ms, is shown")
    frame_limit: int = _number(0, "look", 0, 1000, "Pictures a second; 0: as many as the display shows")
    window_width: int = _number(0, "look", 0, 16384, "Width of the window, px; 0 fits the screen")
    window_height: int = _number(0, "look", 0, 16384, "Height of the window, px; 0 fits the screen")
    volume: int = _number(70, "sound", 0, 99, "How loud everything is", 3)
    effects_volume: int = _number(99, "sound", 0, 99, "How loud all but the music is, a share of the volume", 3)
    loop_volume: int = _number(99, "sound", 0, 99, "How loud lasting sounds are, a share of the effects", 3)
    music_volume: int = _number(45, "sound", 0, 99, "How loud the music is, a share of the volume", 3)
    music_in_practice: bool = _flag(True, "sound", "Practice mode has music, too")
    text_scale: int = _number(0, "tas", 0, 400, "Size of text in the TAS editor, percent; 0 suits the window")
    level_width: int = _number(0, "tas", 0, 99, "Width of the level in the TAS editor, percent; 0 suits the window")
    tabs_height: int = _number(0, "tas", 0, 99, "Height of the tabs in the TAS editor, percent; 0 suits the window")
    play_speed: int = _number(100, "tas", 10, 800, "How fast the TAS editor plays, percent")
    slopes: bool = _flag(False, "editor", "The level editor adds slopes where you draw full tiles")
    practice: bool = _flag(False, "play", "Practice mode: you can save, rewind and slow down; nothing counts")
    level_texts: bool = _flag(True, "play", "Levels that you have not passed show hints")
    game_speed: int = _number(
        100, "accessibility", 50, 100, "How fast the game runs, percent; below 100 runs are assisted", 5
    )
    invincible: bool = _flag(False, "accessibility", "Nothing that you touch kills you; runs are assisted")
    tap_to_run: bool = _flag(False, "accessibility", "One press of a running key runs until the next press")
    text_size: int = _number(100, "accessibility", 100, 150, "Size of all texts but those of the TAS editor, percent")
    sound_cues: bool = _flag(False, "accessibility", "Rockets, lasers, chases and turrets that sound are marked")
    name: str = _setting("", "play", _is_name, "at most 40 printable characters", "Your name in replays")
    site: str = _text(
        "",
        "play",
        "|(?!.{201})https?://[!-~]+",
        "'' or an address such as 'https://example.org/game/'",
        "The address of the page with the game, to which links lead",
    )
    dead_zone: float = _number(0.35, "pad", 0.05, 0.95, "Share of a stick's way that counts as rest", 0.05)
    keys: InputNames = field(default_factory=dict, metadata=_bindings("keys", "['z', 'lshift']"))
    pad: InputNames = field(default_factory=dict, metadata=_bindings("buttons", "['a']"))

    @property
    def volumes(self) -> tuple[int, int, int, int]:
        return self.volume, self.effects_volume, self.loop_volume, self.music_volume

    def changed(self, **values: Any) -> Settings:
        """These settings with some changes. Raises ValueError for a value that a setting cannot have."""
        for name, value in values.items():
            if not SPECS[name].fits(value):
                raise ValueError(f"{name} is {value!r}; expected {SPECS[name].expected}")
        return replace(self, **values)


SPECS: dict[str, SettingSpec] = {setting.name: setting.metadata["spec"] for setting in fields(Settings)}
"""The specs by setting. Bindings are in tables of their own: ``[keys]`` and ``[pad-buttons]``."""


def read_settings(path: Path) -> tuple[Settings, list[str]]:
    """The settings in a file, and messages about unusable parts.

    A missing file gives the defaults. A file that is not TOML, or from another version of the game, is moved aside; a
    wrong value only falls back to its default.
    """
    try:
        with _long_numbers():
            data = parse_toml(read_utf8(path, MAX_SETTINGS_BYTES), any_number=True)
    except FileNotFoundError:
        return Settings(), []
    except OSError as error:
        return Settings(), [f"The settings cannot be read ({error.strerror}); the defaults are used."]
    except (FileError, ValueError) as error:
        return Settings(), [f"The settings file is damaged ({shown_text(str(error))}). {_put_aside(path, 'damaged')}"]
    if data.get("version", SETTINGS_VERSION) != SETTINGS_VERSION:
        return Settings(), [f"The settings file is from another version of the game. {_put_aside(path, 'other')}"]
    return _settings_of(data)


def read_usable_settings(path: Path) -> Settings:
    """The usable settings in a file, for a caller that cannot wait: no message, no file moved."""
    try:
        with _long_numbers():
            return _settings_of(parse_toml(read_utf8(path, MAX_SETTINGS_BYTES), any_number=True))[0]
    except (OSError, FileError, ValueError):
        return Settings()


@contextmanager
def _long_numbers() -> Iterator[None]:
    """Read numbers of any length, so that a long one only costs its own setting."""
    limit = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(0)
    try:
        yield
    finally:
        sys.set_int_max_str_digits(limit)


def _put_aside(path: Path, why: str) -> str:
    """A message about an unusable file."""
    try:
        return f"It is kept as {quarantine(path, why).name}; the defaults are used."
    except OSError as error:
        return f"It stays where it is ({error.strerror}); the defaults are used."


def _settings_of(data: Mapping[str, Any]) -> tuple[Settings, list[str]]:
    """The settings of a document, and messages about values that cannot be used."""
    values: dict[str, Any] = {}
    wrong: dict[str, tuple[Any, str]] = {}  # by place: what was found, and what is expected
    for name, spec in SPECS.items():
        place = BINDING_TABLES.get(name, spec.table)
        value = data.get(place)
        if value is not None and name not in BINDING_TABLES:
            if not isinstance(value, Mapping):
                wrong[place] = value, f"the table [{place}]"
                continue
            place, value = f"{place}.{setting_key(name)}", value.get(setting_key(name))
        if value is not None and spec.fits(value):
            values[name] = spec.convert(value)
        elif value is not None:
            wrong[place] = value, spec.expected
    return Settings(**values), [
        f"settings.toml: {place} is {_shown(value)}; expected {expected}; the default is used."
        for place, (value, expected) in wrong.items()
    ]


def _shown(value: object) -> str:
    try:
        return shown_text(repr(value), 60)
    except ValueError:
        return "a number of very many digits"


def setting_key(name: str) -> str:
    return name.replace("_", "-")


def write_changes(before: Settings, after: Settings, path: Path) -> None:
    """Write the difference between two settings into a file, whole or not at all; the rest of it stays.

    A missing file gets all settings, an unusable one is moved aside first. Raises OSError, FileError.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    with locked(path, LOCK_SECONDS):
        write_atomically(path, _changed_text(path, before, after) or _new_text(after))


def _changed_text(path: Path, before: Settings, after: Settings) -> str:
    """The file's text with the changes; '' without a usable file."""
    import tomlkit
    from tomlkit.exceptions import TOMLKitError

    changed = [name for name in SPECS if getattr(before, name) != getattr(after, name)]
    why = "damaged"
    try:
        with _long_numbers():
            text = read_utf8(path, MAX_SETTINGS_BYTES)
            parse_toml(text, any_number=True)
            document = tomlkit.parse(text)
            if document.get("version", SETTINGS_VERSION) == SETTINGS_VERSION:
                for name in changed:
                    _put(document, name, getattr(before, name), getattr(after, name))
                text = document.as_string()
                parse_toml(text, any_number=True)
                return text
            why = "other"
    except FileNotFoundError:
        return ""
    except (FileError, TOMLKitError, ValueError, TypeError, KeyError, RecursionError):
        # Not TOML, or the library fails on it: the file is kept under another name, and a new one is begun.
        pass
    quarantine(path, why)
    return ""


def _new_text(settings: Settings) -> str:
    import tomlkit

    document = tomlkit.document()
    document.add(tomlkit.comment(COMMENT))
    document.add("version", tomlkit.item(SETTINGS_VERSION))
    for name in SPECS:
        _put(document, name, {}, getattr(settings, name))
    return document.as_string()


def _put(document: TOMLDocument, name: str, before: Any, after: Any) -> None:
    """Write one setting's new value into the document; of bindings only the changed actions."""
    import tomlkit

    table_name = BINDING_TABLES.get(name, SPECS[name].table)
    table = document.get(table_name)
    if not isinstance(table, MutableMapping):
        document[table_name] = tomlkit.table()
        table = document[table_name]
    if name not in BINDING_TABLES:
        table[setting_key(name)] = after
        return
    for action in {**before, **after}:
        if action not in after:
            table.pop(action, None)
        elif before.get(action) != after[action]:
            table[action] = list(after[action])
