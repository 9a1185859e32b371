"""What a release keeps: the public API, commands and options, exit codes, versions of the formats."""

import inspect
from collections.abc import Callable, Iterator
from dataclasses import MISSING, fields, is_dataclass
from enum import Enum
from pathlib import Path

import click

import ninja_game
from ninja_game.board import report
from ninja_game.cli import commands
from ninja_game.cli.main import cli
from ninja_game.errors import FormatError
from ninja_game.formats import links
from ninja_game.formats.ascii import writer
from ninja_game.formats.replay import text
from ninja_game.player import schema, settings
from ninja_game.sim import rules
from tests.support.samples import WALK

SHORT = ninja_game.parse_level(WALK)
RECORDED = Path(__file__).parents[1] / "golden" / "promises.txt"

MADE: dict[str, Callable[[], object]] = {
    "Simulation": lambda: ninja_game.Simulation(SHORT),
    "Batch": lambda: ninja_game.Batch(SHORT, 1, memory="plain"),
}
"""Classes whose instances have more than the class shows."""

VERSIONS = {
    "rules": rules.RULES_VERSION,
    "replay text": text.REPLAY_VERSION,
    "level text": writer.ASCII_VERSION,
    "link": links.LINK_VERSION,
    "settings": settings.SETTINGS_VERSION,
    "records": schema.SCHEMA_VERSION,
    "board ledger": report.VERSION,
}

EXIT_CODES = ("FAILED", "BAD_INPUT", "INTERNAL_ERROR", "INTERRUPTED", "BROKEN_PIPE", "TERMINATED")


def promised() -> str:
    """All of it as lines, sorted within their part."""
    api = (line for name in ninja_game.__all__ if name != "__version__" for line in _api(name))
    parts = {
        "Python": sorted(api),
        "Commands": list(_command(cli, "ninja-game")),
        "Exit codes": [f"{name}: {getattr(commands, name)}" for name in EXIT_CODES],
        "Formats": [f"{name}: {version}" for name, version in VERSIONS.items()],
    }
    return "\n".join(f"# {title}\n\n" + "\n".join(lines) + "\n" for title, lines in parts.items())


def _api(name: str) -> Iterator[str]:
    value = getattr(ninja_game, name)
    if not inspect.isclass(value):
        yield f"{name}{inspect.signature(value)}"
        return
    bases = ", ".join(base.__name__ for base in value.__bases__ if base is not object)
    yield f"class {name}({bases})"
    if is_dataclass(value):
        for each in fields(value) if not issubclass(value, FormatError) or value is FormatError else ():
            optional = each.default is not MISSING or each.default_factory is not MISSING
            yield f"{name}.{each.name}: {each.type}{' (optional)' if optional else ''}"
    elif isinstance(value, type) and issubclass(value, Enum):
        yield from (f"{name}.{each.name} = {each.value}" for each in value)
    elif issubclass(value, tuple):
        yield from (f"{name}.{field}" for field in value.__annotations__)
    elif not issubclass(value, Exception):
        yield f"{name}{inspect.signature(value)}"
    if name in MADE:
        yield from (f"{name}.{member}" for member in vars(MADE[name]()) if not member.startswith("_"))
    for member, found in vars(value).items():
        if member.startswith("_") or issubclass(value, Enum):
            continue
        if isinstance(found, property) or type(found).__name__ == "cached_property":
            yield f"{name}.{member}"
        elif inspect.isfunction(found := getattr(found, "__func__", found)):
            yield f"{name}.{member}{inspect.signature(found)}"


def _command(command: click.Command, words: str) -> Iterator[str]:
    """A command with its arguments and options, then those below it."""
    yield " ".join([words, *sorted(map(_parameter, command.params))])
    if isinstance(command, click.Group):
        context = click.Context(command)
        for name in command.list_commands(context):
            below = command.get_command(context, name)
            assert below, name
            yield from _command(below, f"{words} {name}")


def _parameter(parameter: click.Parameter) -> str:
    if isinstance(parameter, click.Argument):
        return parameter.make_metavar(click.Context(cli)).rstrip(".") + "..." * (parameter.nargs < 0)
    flags = "/".join([*parameter.opts, *parameter.secondary_opts])
    choices = getattr(parameter.type, "choices", ())
    kind = "" if getattr(parameter, "is_flag", False) else f"={'|'.join(map(str, choices)) or parameter.type.name}"
    return f"[{flags}{kind}]"


def write_promises() -> None:
    RECORDED.write_text(promised(), "utf-8")
