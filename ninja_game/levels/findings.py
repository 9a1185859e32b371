"""Findings about levels, packs and runs: a code, and its text and hint from ``assets/findings.toml``."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from typing import NamedTuple

from ninja_game.files.bundled import asset_text
from ninja_game.sim.grid import Cell


class Wording(NamedTuple):
    """The words of a finding. ``text``: the oddity, with {values}; ``hint``: how to fix it.

    ``about_switch``: whether a switch is odd. ``expected``: the right content, for makers who edit the file as text.
    """

    text: str
    hint: str
    about_switch: bool = False
    expected: str = ""


def _read_wordings() -> dict[str, dict[str, Wording]]:
    """Read all wordings of the bundled file, by the thing examined and by code."""
    tables = tomllib.loads(asset_text("findings.toml"))
    return {part: {code: Wording(**table) for code, table in wordings.items()} for part, wordings in tables.items()}


_WORDINGS = _read_wordings()
LEVEL_WORDINGS, RUN_WORDINGS = _WORDINGS["level"], _WORDINGS["run"]

PACK_WORDINGS = _WORDINGS["pack"]  # oddities of a pack as a whole; those of its levels have the codes of levels

DESIGN_WORDINGS = _WORDINGS["design"]
"""Features of good levels that a level lacks (docs/good-levels.md): reported only on request."""


class Finding(NamedTuple):
    """An oddity. ``text``: the oddity; ``records``: numbers of the odd records; ``cells``: of odd tiles and places.

    ``names``: the names of the odd objects in texts, '' if ``text`` has them. ``message``: the odd message's number.
    """

    code: str  #: its name in docs/findings.md
    text: str
    records: tuple[int, ...] = ()
    cells: tuple[Cell, ...] = ()
    names: str = ""
    message: int | None = None

    @property
    def sentence(self) -> str:
        """Names and text as one line."""
        return f"{self.names}: {self.text}" if self.names else self.text

    @property
    def advice(self) -> str:
        """The oddity and its fix, as sentences."""
        return f"{self.sentence[0].upper()}{self.sentence[1:]}. {self.hint}"

    @property
    def hint(self) -> str:
        """How to fix it, as a sentence."""
        return LEVEL_WORDINGS[self.code].hint

    @property
    def about_switch(self) -> bool:
        """Whether the switches of the objects are odd, not the objects."""
        return LEVEL_WORDINGS[self.code].about_switch


class PackFinding(NamedTuple):
    """An oddity of a pack. ``file``: its file, "" for the whole pack; ``line``: line of the file, 0 if unknown.

    ``values``: the values of its text, with files named as in the pack. ``odd``: the finding about a level that it
    reports, or what kept the solver from the run that is ``sought``. ``reason``: why its maker accepts it, or "".
    """

    code: str  #: its name in docs/findings.md
    file: str = ""
    line: int = 0
    values: Mapping[str, object] = {}
    odd: Finding | None = None
    sought: str = ""
    reason: str = ""

    @property
    def place(self) -> str:
        """The file, with the line if known."""
        return f"{self.file}:{self.line}" if self.line else self.file

    @property
    def text(self) -> str:
        """The oddity, with the pack's names of files."""
        expected = "" if self.odd else self._wording.expected.format(**self.values)
        return self.text_with(self.values) + (f"; expected {expected}" if expected else "")

    def text_with(self, values: Mapping[str, object]) -> str:
        """The oddity, with values in the words of its reader."""
        if self.odd:
            return f"the search found no {self.sought}: {self.odd.sentence}" if self.sought else self.odd.sentence
        return self._wording.text.format(**values)

    @property
    def hint(self) -> str:
        """How to fix it, as a sentence."""
        return self.odd.hint if self.odd else self._wording.hint

    @property
    def _wording(self) -> Wording:
        return (PACK_WORDINGS | DESIGN_WORDINGS)[self.code]


class RunProblem(NamedTuple):
    """Why a run does not match its file, or a demand on it."""

    code: str
    text: str

    def __str__(self) -> str:
        return self.text

    @property
    def hint(self) -> str:
        """How to fix it, as a sentence."""
        return RUN_WORDINGS[self.code].hint


def run_problem(code: str, **values: object) -> RunProblem:
    """Make a problem of a run; ``values``: the values of its text."""
    return RunProblem(code, RUN_WORDINGS[code].text.format(**values))


def pack_finding(code: str, file: str = "", line: int = 0, **values: object) -> PackFinding:
    """Make a finding about a pack, or about a feature that its level lacks; ``values``: the values of its text."""
    return PackFinding(code, file, line, values)


def level_finding(
    code: str, records: tuple[int, ...] = (), cells: tuple[Cell, ...] = (), message: int | None = None, **values: object
) -> Finding:
    """Make a finding about a level; ``values``: the values of its text."""
    return Finding(code, LEVEL_WORDINGS[code].text.format(**values), records, cells, message=message)
