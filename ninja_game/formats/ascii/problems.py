"""Many mistakes of one text, reported together: a level maker mends them in one go."""

from __future__ import annotations

from collections.abc import Sequence

from ninja_game.errors import LevelError

_SHOWN = 20
_ENOUGH = 1000


class LevelTextError(LevelError):
    """The first mistake of a level, with ``further`` ones after it; the message has a line for each."""

    further: tuple[LevelError, ...] = ()

    def __str__(self) -> str:
        lines = [super().__str__(), *map(str, self.further[: _SHOWN - 1])]
        left = len(self.further) - (_SHOWN - 1)
        if left > 0:
            lines.append(f"... and {left} more")
        return "\n".join(lines)


class Problems:
    """Collects the mistakes found in one file."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.found: list[LevelError] = []

    def add(
        self, what: str, line: int, column: int = 0, *, found: str = "", expected: str = "", hint: str = ""
    ) -> None:
        """Note a mistake at a line and column (from 1)."""
        self.found.append(LevelError(what, self.file, line, column, found, expected, hint))

    def add_error(self, error: LevelError, line: int) -> None:
        """Note an error that was raised without file and line."""
        error.file, error.line = self.file, line
        self.found.append(error)

    @property
    def full(self) -> bool:
        """Whether there are so many mistakes that looking for more is not worth the time."""
        return len(self.found) >= _ENOUGH

    def raise_if_any(self) -> None:
        """Raise what was noted, in the order of the lines; do nothing if all is well."""
        if self.found:
            raise _joined(sorted(self.found, key=lambda error: (error.line, error.column)))


def _joined(errors: Sequence[LevelError]) -> LevelError:
    first = errors[0]
    joined = LevelTextError(first.what, first.file, first.line, first.column, first.found, first.expected, first.hint)
    joined.further = tuple(errors[1:])
    return joined
