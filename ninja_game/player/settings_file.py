"""Settings in their file: TOML that a person can edit. Whatever is in it, the game starts."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ninja_game.files.user_folder import quarantine
from ninja_game.files.writing import write_atomically
from ninja_game.player.settings import RULES, Settings
from ninja_game.player.toml_text import Value, write_toml

VERSION = 1
BINDING_TABLES = {"keys": "keys", "pad": "pad-buttons"}
COMMENT = "Settings of ninja-game. What is missing or wrong here has its default."


def write_settings(settings: Settings, path: Path) -> None:
    """Put the settings into their file, whole or not at all. Raises OSError."""
    tables: dict[str, dict[str, Value]] = {"": {"version": VERSION}}
    for name, rule in RULES.items():
        if name in BINDING_TABLES:
            tables[BINDING_TABLES[name]] = dict(getattr(settings, name))
        else:
            tables.setdefault(rule.table, {})[name.replace("_", "-")] = getattr(settings, name)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(path, write_toml(tables, comment=COMMENT))


def read_settings(path: Path) -> tuple[Settings, list[str]]:
    """The settings in a file, and messages about what in it could not be used.

    A missing file gives the defaults. A file that is no TOML, or from a newer game, is set aside; a wrong value only
    falls back to its default.
    """
    try:
        data = tomllib.loads(path.read_text("utf-8"))
    except FileNotFoundError:
        return Settings(), []
    except OSError as error:
        return Settings(), [f"The settings cannot be read ({error.strerror}); the defaults are used."]
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
        return Settings(), [f"The settings file is damaged ({error}). {_put_aside(path, 'damaged')}"]
    version = data.get("version")
    if not isinstance(version, int) or version > VERSION:
        return Settings(), [f"The settings file is from a newer game. {_put_aside(path, 'newer')}"]
    return _settings_of(data)


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
        table_name = BINDING_TABLES.get(name, rule.table)
        table = data.get(table_name, {})
        key = name.replace("_", "-")
        place = table_name if name in BINDING_TABLES else f"{table_name}.{key}"
        found = table if name in BINDING_TABLES else table.get(key) if isinstance(table, Mapping) else table
        if found is None:
            continue
        if not rule.fits(found):
            messages.append(f"settings.toml: {place} is {found!r}; expected {rule.expected}; the default is used.")
        elif name in BINDING_TABLES:
            values[name] = {action: tuple(inputs) for action, inputs in found.items()}
        else:
            values[name] = float(found) if name == "dead_zone" else found
    return Settings(**values), messages
