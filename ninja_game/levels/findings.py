"""Findings about levels, packs and runs, by code: text and hint (``assets/findings.toml``)."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from typing import NamedTuple

from ninja_game.files.user_folder import asset_text
from ninja_game.formats.ascii.places import Cell


class Wording(NamedTuple):
    """``text``: what is odd, with {values}; ``hint``: how to fix it. ``about_switch``: whether it is about a switch.

    ``expected``: what a file would have instead, for who edits it as text.
    """

    text: str
    hint: str
    about_switch: bool = False
    expected: str = ""


def _read_wordings() -> dict[str, dict[str, Wording]]:
    """All wordings of the bundled file, by what is examined and by code."""
    tables = tomllib.loads(asset_text("findings.toml"))
    return {part: {code: Wording(**table) for code, table in wordings.items()} for part, wordings in tables.items()}


_WORDINGS = _read_wordings()
LEVEL_WORDINGS, RUN_WORDINGS = _WORDINGS["level"], _WORDINGS["run"]

PACK_WORDINGS = _WORDINGS["pack"]
"""What may be odd about a pack; what is odd about its levels has the codes of levels."""

DESIGN_WORDINGS = _WORDINGS["design"]
"""What good levels have and a level lacks (docs/good-levels.md): reported only where it is asked for."""


class Finding(NamedTuple):
    """Something odd. ``text``: what; ``records``: numbers of the records that it is about; ``cells``: of tiles, places.

    ``names``: how a text calls what it is about, '' where ``text`` says it.
    """

    code: str
    text: str
    records: tuple[int, ...] = ()
    cells: tuple[Cell, ...] = ()
    names: str = ""

    @property
    def sentence(self) -> str:
        """Names and text as one line."""
        return f"{self.names}: {self.text}" if self.names else self.text

    @property
    def advice(self) -> str:
        """What is odd and how to fix it, as sentences."""
        return f"{self.sentence[0].upper()}{self.sentence[1:]}. {self.hint}"

    @property
    def hint(self) -> str:
        """How to fix it, a sentence."""
        return LEVEL_WORDINGS[self.code].hint

    @property
    def about_switch(self) -> bool:
        """Whether it is about the objects' switches rather than about themselves."""
        return LEVEL_WORDINGS[self.code].about_switch


class PackFinding(NamedTuple):
    """Something odd about a pack. ``file``: which, "" for the pack as a whole; ``line``: of it, 0 where none is known.

    ``values``: what its text names, files as the pack has them. ``odd``: the finding about the level that this is, or
    what kept the solver from the run that is ``sought``. ``reason``: why its maker accepts it, "" for an open one.
    """

    code: str
    file: str = ""
    line: int = 0
    values: Mapping[str, object] = {}
    odd: Finding | None = None
    sought: str = ""
    reason: str = ""

    @property
    def place(self) -> str:
        """The file, with the line where one is known."""
        return f"{self.file}:{self.line}" if self.line else self.file

    @property
    def text(self) -> str:
        """What is odd, as its files have it."""
        expected = "" if self.odd else self._wording.expected.format(**self.values)
        return self.text_with(self.values) + (f"; expected {expected}" if expected else "")

    def text_with(self, values: Mapping[str, object]) -> str:
        """What is odd, with values in the words of its reader."""
        if self.odd:
            return f"the search found no {self.sought}: {self.odd.sentence}" if self.sought else self.odd.sentence
        return self._wording.text.format(**values)

    @property
    def hint(self) -> str:
        """How to fix it, a sentence."""
        return self.odd.hint if self.odd else self._wording.hint

    @property
    def _wording(self) -> Wording:
        return (PACK_WORDINGS | DESIGN_WORDINGS)[self.code]


class RunProblem(NamedTuple):
    """Why a run is not what its file says, or not what is demanded of it."""

    code: str
    text: str

    def __str__(self) -> str:
        return self.text

    @property
    def hint(self) -> str:
        """How to fix it, a sentence."""
        return RUN_WORDINGS[self.code].hint


def run_problem(code: str, **values: object) -> RunProblem:
    """A problem of this code about a run; ``values``: what its text names."""
    return RunProblem(code, RUN_WORDINGS[code].text.format(**values))


def pack_finding(code: str, file: str = "", line: int = 0, **values: object) -> PackFinding:
    """A finding of this code about a pack, or about what its level lacks; ``values``: what its text names."""
    return PackFinding(code, file, line, values)


def level_finding(code: str, records: tuple[int, ...] = (), cells: tuple[Cell, ...] = (), **values: object) -> Finding:
    """A finding of this code; ``values``: what its text names."""
    return Finding(code, LEVEL_WORDINGS[code].text.format(**values), records, cells)
