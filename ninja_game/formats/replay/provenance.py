"""The provenance of a run: played, edited or searched, as the tools note it (`docs/replay-format.md`)."""

from __future__ import annotations

import re
from contextlib import suppress
from functools import lru_cache
from typing import NamedTuple, Self

from ninja_game.formats.lines import MAX_NAME

_BEGUN = " from a run by "
_NAMES = "[a-z][a-z -]{0,30}(?:, [a-z][a-z -]{0,30}){0,20}"
_MADE = re.compile(
    rf"(?:played(?: \((?P<assists>{_NAMES})\))?)?(?:(?:^|, )edited (?P<edits>[1-9][0-9]{{0,8}}))?"
    rf"(?:(?:^|, )searched \((?P<searches>{_NAMES})\))?"
)
_MAX_EDITS, _MAX_NAME = 10**9 - 1, 200


class Provenance(NamedTuple):
    """How a run was made; unknown if all fields are empty.

    ``played``: in the game, with the help of ``assists``, such as "practice". ``edits``: number of edits in a TAS
    editor. ``searches``: commands that found keys of it, such as "improve". ``begun_by``: whose run it started from.
    """

    played: bool = False
    assists: tuple[str, ...] = ()
    edits: int = 0
    searches: tuple[str, ...] = ()
    begun_by: str = ""

    @property
    def assisted(self) -> bool | None:
        """Whether more than a person's keys in the game made it; None if nobody knows."""
        if self.assists or self.edits or self.searches:
            return True
        return False if self.played else None

    def __str__(self) -> str:
        """The text in replays.

        >>> str(Provenance(edits=34, searches=("improve", "search"), begun_by="Ann")), str(Provenance())
        ('edited 34, searched (improve, search) from a run by Ann', '')
        """
        played = f"played ({', '.join(self.assists)})" if self.assists else "played"
        parts = [
            played if self.played else "",
            f"edited {self.edits}" if self.edits else "",
            f"searched ({', '.join(self.searches)})" if self.searches else "",
        ]
        return ", ".join(filter(None, parts)) + (_BEGUN + self.begun_by if self.begun_by else "")

    def edited(self, edits: int) -> Self:
        """A copy with this many more edits."""
        return self._replace(edits=min(self.edits + edits, _MAX_EDITS))

    def searched(self, *commands: str, begun_by: str = "") -> Self:
        """A copy with further commands that searched. ``begun_by``: the author so far, unless one is already there."""
        searches = tuple(dict.fromkeys((*self.searches, *commands)))
        return self._replace(searches=searches, begun_by=self.begun_by or " ".join(begun_by.split())[:_MAX_NAME])


UNKNOWN = Provenance()


@lru_cache(4096)
def parse_provenance(text: str) -> Provenance:
    """Parse the ``str`` of a Provenance. Raises ValueError for any other text.

    >>> parse_provenance("played (practice)"), parse_provenance("edited 3 from a run by Ann").begun_by
    (Provenance(played=True, assists=('practice',), edits=0, searches=(), begun_by=''), 'Ann')
    """
    how, _, begun_by = text.partition(_BEGUN)
    if match := _MADE.fullmatch(how):
        assists, searches = (tuple(filter(None, (match[kind] or "").split(", "))) for kind in ("assists", "searches"))
        made = Provenance(how.startswith("played"), assists, int(match["edits"] or 0), searches, begun_by)
        if str(made) == text:
            return made
    raise ValueError(f"{text[:60]!r} does not say how a run was made")


def names_of_text(text: str) -> tuple[str, ...]:
    """The names in a list separated by commas, without repetition.

    >>> names_of_text("Bob,Cy , Bob")
    ('Bob', 'Cy')
    """
    return tuple(dict.fromkeys(filter(None, (" ".join(name.split()) for name in text.split(",")))))


def can_be_written(made: Provenance, co_authors: tuple[str, ...]) -> bool:
    """Whether a replay text can store how a run was made, and its co-authors.

    >>> can_be_written(Provenance(edits=3), ("Bob",)), can_be_written(Provenance(edits=3, begun_by="Ann "), ())
    (True, False)
    """
    how, names = str(made), ", ".join(co_authors)
    with suppress(ValueError):
        whole = max(len(how), len(names)) <= MAX_NAME
        return whole and parse_provenance(how.strip()) == made and names_of_text(names) == co_authors
    return False


_MARK, _WITH = "[made: ", "; co-authors: "


def with_provenance(comment: str, made: Provenance, co_authors: tuple[str, ...]) -> str:
    """Add how the run was made to the comment of a record of N, which has no other place for it.

    >>> with_provenance("all gold", Provenance(edits=3), ("Bob",))
    'all gold [made: edited 3; co-authors: Bob]'
    """
    if not (made.assisted is not None or co_authors):
        return comment
    others = _WITH + ", ".join(co_authors) if co_authors else ""
    return f"{comment} {_MARK}{made}{others}]".strip()


def without_provenance(comment: str) -> tuple[str, Provenance, tuple[str, ...]]:
    """Split what ``with_provenance`` gives: the comment, how the run was made, its co-authors.

    >>> without_provenance("all gold [made: edited 3; co-authors: Bob]")[::2], without_provenance("[made: by me]")[0]
    (('all gold', ('Bob',)), '[made: by me]')
    """
    start = comment.rfind(_MARK)
    if start >= 0 and comment.endswith("]") and len(_MARK) + 1 < len(comment) - start <= 2 * MAX_NAME:
        how, _, names = comment[start + len(_MARK) : -1].partition(_WITH)
        with suppress(ValueError):
            made, co_authors = parse_provenance(how), names_of_text(names)
            if can_be_written(made, co_authors):
                return comment[:start].removesuffix(" "), made, co_authors
    return comment, UNKNOWN, ()
