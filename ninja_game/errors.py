"""The errors that this project raises on purpose.

All are NinjaGameErrors: the input or the request was bad, and the message says how to fix it. Any other one is a bug.
"""

from __future__ import annotations

from dataclasses import dataclass


class NinjaGameError(Exception):
    """The root of all errors that this package raises on purpose."""


def reason(error: BaseException) -> str:
    """The error in words for the user.

    >>> reason(FileNotFoundError(2, "No such file", "a.txt")), reason(MemoryError()), reason(KeyError("x"))
    ('No such file', 'there is not enough memory', "a fault of the program, KeyError: 'x'")
    """
    if isinstance(error, MemoryError):
        return "there is not enough memory"
    expected = isinstance(error, (NinjaGameError, OSError))
    return getattr(error, "strerror", "") or (
        str(error) if expected else f"a fault of the program, {type(error).__name__}: {error}"
    )


class ArgumentError(NinjaGameError, ValueError):
    """An argument that a function of the public API does not take; the message says which ones it takes."""


class MissingExtraError(NinjaGameError, ImportError):
    """A part of the package needs a library that is not installed; says how to install it."""


@dataclass(eq=False)
class FormatError(NinjaGameError):
    """Text that cannot be read: where, what was found, what was expected, how to fix it.

    ``line`` and ``column`` count from 1; 0 means "not known" and is left out of the message.
    """

    what: str  #: the mistake
    file: str = ""
    line: int = 0
    column: int = 0
    found: str = ""  #: the text at that place
    expected: str = ""  #: the valid texts, in words
    hint: str = ""  #: how to fix it

    def __str__(self) -> str:
        file = self.file if self.file.isprintable() else ascii(self.file)
        place = ":".join(str(part) for part in (file, self.line, self.column) if part)
        text = f"{place}: {self.what}" if place else self.what
        if self.found:
            text += f"; found {self.found}"
        if self.expected:
            text += f"; expected {self.expected}"
        if self.hint:
            text += f"; {self.hint}"
        return text


class FileError(FormatError):
    """A file that cannot be read or written: no regular file, too large, no text, or one that must not be replaced."""


class LevelError(FormatError):
    """A level (in-game string, level file or ASCII level) that cannot be loaded."""


class DemoError(FormatError):
    """A demo (a recording's inputs, 4-bit or legacy) that cannot be read."""


class ReplayError(FormatError):
    """A replay text of ours that cannot be read, or does not fit its level."""


@dataclass(eq=False)
class BudgetError(FormatError):
    """A run that costs more work than its budget."""

    option: str = ""  #: the option of a command that lets it run

    def __str__(self) -> str:
        return "; ".join(filter(None, (super().__str__(), self.option)))


class LinkError(FormatError):
    """A link to a level, a pack or a replay that is truncated, changed or too large."""


class PackError(FormatError):
    """A pack of levels whose index is missing or wrong."""


DAMAGED = (ValueError, LookupError, TypeError, AttributeError, ArithmeticError, RecursionError, NinjaGameError)
"""The exceptions of reading JSON that was changed or damaged since the program wrote it."""
