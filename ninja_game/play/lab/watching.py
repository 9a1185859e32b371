"""Run functions of the world and note what they did: which others they called, and how a local value changed."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any, NamedTuple

from ninja_game import sim

_RULES = str(Path(sim.__file__).parent)


class Call(NamedTuple):
    """A call of a rule. ``depth``: 0 for the function that was watched.

    ``arguments``: numbers by name; of an object its slot. ``result``: what it gave, None before it ends.
    """

    name: str
    caller: str
    depth: int
    arguments: dict[str, float]
    result: list[Any]


def watch(function: Callable[..., Any], *args: Any) -> tuple[Any, list[Call]]:
    """The result of ``function(*args)``, and the calls of the world's rules in it, in their order, itself first."""
    calls: list[Call] = []
    running: list[Call] = []

    def note(frame: FrameType, event: str, result: Any) -> None:
        if not frame.f_code.co_filename.startswith(_RULES):
            return
        if event == "call":
            caller = running[-1].name if running else ""
            running.append(Call(frame.f_code.co_name, caller, len(running), _numbers(frame.f_locals), []))
            calls.append(running[-1])
        elif event == "return" and running:
            running.pop().result.append(result)

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        result = function(*args)
    finally:
        sys.setprofile(before)
    return result, calls


def _numbers(values: dict[str, Any]) -> dict[str, float]:
    numbers = {name: getattr(value, "slot", value) for name, value in values.items()}
    return {name: number for name, number in numbers.items() if isinstance(number, (int, float))}


def values_of(local: str, function: Callable[..., Any], *args: Any) -> list[Any]:
    """The values that a local variable of ``function`` takes during ``function(*args)``, each change once."""
    values: list[Any] = []
    code = function.__code__

    def follow(frame: FrameType, *_: Any) -> Any:
        if frame.f_code is not code:
            return None
        if local in frame.f_locals and (not values or values[-1] != frame.f_locals[local]):
            values.append(frame.f_locals[local])
        return follow

    before = sys.gettrace()
    sys.settrace(follow)
    try:
        function(*args)
    finally:
        sys.settrace(before)
    return values
