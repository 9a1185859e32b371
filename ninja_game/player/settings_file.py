"""Settings in their file: TOML that a person can edit. Whatever is in it, the game starts, and comments stay.

Only what the player has changed is written into a file that is there, so that two games at once, or a person with an
editor, do not undo each other's changes.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, MutableMapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ninja_game.errors import FileError
from ninja_game.files.locking import locked
from ninja_game.files.reading import read_utf8
from ninja_game.files.shown_text import shown_text
from ninja_game.files.toml import parse_toml
from ninja_game.files.user_folder import quarantine
from ninja_game.files.writing import write_atomically
from ninja_game.player.settings import RULES, Settings

if TYPE_CHECKING:
    from tomlkit import TOMLDocument

VERSION = 1
BINDING_TABLES = {"keys": "keys", "pad": "pad-buttons"}
OLD_KEYS = {"ninja_colour": "flavour"}
"""What a setting was once called in its table; the old key is read, and goes when the setting is written."""

COMMENT = "Settings of ninja-game. What is missing or wrong here has its default; comments stay."
MAX_BYTES = 2**16
"""More than this is not a file of settings; a number of so many digits is read within 0.1 s."""

LOCK_SECONDS = 1.0


# --- reading ---


def read_settings(path: Path) -> tuple[Settings, list[str]]:
    """The settings in a file, and messages about what in it could not be used.

    A missing file gives the defaults. A file that is not TOML, or from a newer game, is moved aside; a wrong value only
    falls back to its default.
    """
    try:
        with _long_numbers():
            data = parse_toml(read_utf8(path, MAX_BYTES), any_number=True)
    except FileNotFoundError:
        return Settings(), []
    except OSError as error:
        return Settings(), [f"The settings cannot be read ({error.strerror}); the defaults are used."]
    except (FileError, ValueError) as error:
        return Settings(), [f"The settings file is damaged ({shown_text(str(error))}). {_put_aside(path, 'damaged')}"]
    version = data.get("version", VERSION)
    if not isinstance(version, int) or version > VERSION:
        return Settings(), [f"The settings file is from a newer game. {_put_aside(path, 'newer')}"]
    return _settings_of(data)


@contextmanager
def _long_numbers() -> Iterator[None]:
    """Numbers of any length are read within, so that one only costs its own setting."""
    limit = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(0)
    try:
        yield
    finally:
        sys.set_int_max_str_digits(limit)


def _put_aside(path: Path, why: str) -> str:
    """What was done about an unusable file."""
    try:
        return f"It is kept as {quarantine(path, why).name}; the defaults are used."
    except OSError as error:
        return f"It stays where it is ({error.strerror}); the defaults are used."


def _settings_of(data: Mapping[str, Any]) -> tuple[Settings, list[str]]:
    """The settings in a parsed file, value by value."""
    values: dict[str, Any] = {}
    messages = []
    for name, rule in RULES.items():
        place = BINDING_TABLES.get(name, rule.table)
        found = data.get(place)
        expected = rule.expected
        if name not in BINDING_TABLES:
            if isinstance(found, Mapping):
                place = f"{place}.{_key(name)}"
                found = found.get(_key(name), found.get(OLD_KEYS.get(name, "")))
            else:
                expected = f"the table [{place}]"
        if found is None:
            continue
        if expected != rule.expected or not rule.fits(found):
            text = f"settings.toml: {place} is {_shown(found)}; expected {expected}; the default is used."
            messages += [text] * (text not in messages)
        elif name in BINDING_TABLES:
            values[name] = {action: tuple(inputs) for action, inputs in found.items()}
        else:
            values[name] = float(found) if name == "dead_zone" else found
    return Settings(**values), messages


def _shown(value: object) -> str:
    """A wrong value for a message."""
    try:
        return shown_text(repr(value), 60)
    except ValueError:
        return "a number of very many digits"


def _key(name: str) -> str:
    return name.replace("_", "-")


# --- writing ---


def write_changes(before: Settings, after: Settings, path: Path) -> None:
    """Put what differs between two settings into a file, whole or not at all; everything else in it stays.

    A missing file gets all settings, an unusable one is moved aside first. Raises OSError, FileError.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    with locked(path, LOCK_SECONDS):
        write_atomically(path, _changed_text(path, before, after) or _new_text(after))


def _changed_text(path: Path, before: Settings, after: Settings) -> str:
    """The file's text with the changes; '' where there is none, or no longer."""
    import tomlkit
    from tomlkit.exceptions import TOMLKitError

    why = "damaged"
    try:
        with _long_numbers():
            text = read_utf8(path, MAX_BYTES)
            parse_toml(text, any_number=True)
            document = tomlkit.parse(text)
            if document.get("version", VERSION) == VERSION:
                for name in RULES:
                    if getattr(before, name) != getattr(after, name):
                        _put(document, name, getattr(before, name), getattr(after, name))
                text = document.as_string()
                parse_toml(text, any_number=True)
                return text
            why = "newer"
    except FileNotFoundError:
        return ""
    except (FileError, TOMLKitError, ValueError, TypeError, KeyError, RecursionError):
        # No TOML, or too odd for the library: it is kept, and a new one begun.
        pass
    quarantine(path, why)
    return ""


def _new_text(settings: Settings) -> str:
    """A file with all settings."""
    import tomlkit

    document = tomlkit.document()
    document.add(tomlkit.comment(COMMENT))
    document.add("version", tomlkit.item(VERSION))
    for name in RULES:
        _put(document, name, {}, getattr(settings, name))
    return document.as_string()


def _put(document: TOMLDocument, name: str, before: Any, after: Any) -> None:
    """Bring one setting in the document to its new value; of bindings only the actions that have changed."""
    import tomlkit

    table_name = BINDING_TABLES.get(name, RULES[name].table)
    table = document.get(table_name)
    if not isinstance(table, MutableMapping):
        document[table_name] = tomlkit.table()
        table = document[table_name]
    if name not in BINDING_TABLES:
        table[_key(name)] = after
        table.pop(OLD_KEYS.get(name, ""), None)
        return
    for action in {**before, **after}:
        if action not in after:
            table.pop(action, None)
        elif before.get(action) != after[action]:
            table[action] = list(after[action])
