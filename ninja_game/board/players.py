"""The player of a run: names as people read them, and names that only look like another one."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass, field
from functools import lru_cache

from ninja_game.files.shown_text import INVISIBLE
from ninja_game.formats.lines import MAX_NAME

UNNAMED = "unnamed"

_LATIN = str.maketrans(
    "АВЕЅЈКМНОРСТУХԚԜаеѕјкмнорстухһԁԛԝѵΑΒΕΖΗΚΜΝΟΡΤΥΧαεκνορτυχӀӏІіΙιıIi1|0",  # noqa: RUF001
    "ABESJKMHOPCTYXQWaesjkmhopctyxhdqwvABEZHKMNOPTYXaekvoptuxlllllllllllo",
)
"""Letters that look like a Latin one: Cyrillic, Greek, and others that fonts draw alike."""

_LATIN_FORM = re.compile(r"LATIN LETTER SMALL CAPITAL ([A-Z])|LATIN SMALL LETTER (ALPHA|DOTLESS J|SCRIPT G)")
"""Names of Latin letters with the shape of a plain one."""

_WRITTEN_TOGETHER = frozenset({"CJK", "HIRAGANA", "KATAKANA", "KATAKANA-HIRAGANA", "HANGUL", "BOPOMOFO", "LATIN"})
"""Scripts that may be mixed in one word: none of their letters look alike."""

_DRAWN_AS_LATIN = frozenset({"LISU", "CHEROKEE", "COPTIC", "OSMANYA", "DESERET"})
"""Scripts with so many letters like Latin ones that a whole word can look Latin."""


def player_named(author: str) -> str:
    """An author's name in one line, as typed, truncated to the longest name: some characters expand to many.

    >>> player_named("  Ann "), player_named("")
    ('Ann', 'unnamed')
    """
    return " ".join(unicodedata.normalize("NFKC", author).split())[:MAX_NAME].rstrip() or UNNAMED


@lru_cache(4096)
def folded(player: str) -> str:
    r"""A name as people read it: without case, and without invisible characters.

    >>> folded("Ann") == folded("ANN") == folded("a\u200bnn") == folded("\uff21nn")
    True
    """
    folds = unicodedata.normalize("NFKC", unicodedata.normalize("NFKC", player).casefold())
    visible = "".join(letter for letter in folds if unicodedata.category(letter) != "Cf")
    return player_named(INVISIBLE.sub("", visible))


@lru_cache(4096)
def confusable_form(player: str) -> str:
    r"""A name by its look: equal for names that a reader may confuse.

    >>> confusable_form("\u0410nn") == confusable_form("Ann"), confusable_form("Bill") == confusable_form("Bi\u04c0I")
    (True, True)
    """
    letters = unicodedata.normalize("NFKD", player)
    plain = "".join(_plain(letter) for letter in letters if not unicodedata.category(letter).startswith("M"))
    return folded(plain.translate(_LATIN)).replace("rn", "m").replace("vv", "w")


def _plain(letter: str) -> str:
    """The plain Latin letter with the same shape, if any."""
    form = _LATIN_FORM.fullmatch(unicodedata.name(letter, ""))
    return (form[1] or form[2].split()[-1][0]) if form else letter


@lru_cache(4096)
def mixed_word(player: str) -> bool:
    """Whether a word of a name mixes scripts that look alike, or is of one that looks like Latin."""
    for word in player_named(player).split():
        letters = [letter for letter in word if letter.isalpha() and unicodedata.category(letter) != "Lm"]
        scripts = {unicodedata.name(letter, "").partition(" ")[0] for letter in letters}
        if (len(scripts) > 1 and not scripts <= _WRITTEN_TOGETHER) or scripts & _DRAWN_AS_LATIN:
            return True
    return False


@dataclass
class Players:
    """All players so far, each under the name as it was typed first."""

    alike: dict[str, str] = field(default_factory=dict)  #: the earlier player with a similar name, by player
    _names: dict[str, str] = field(default_factory=dict)
    _looks: dict[str, str] = field(default_factory=dict)

    def meet(self, author: str) -> tuple[str, str]:
        """The player of an author, and a remark if the name looks like that of an earlier player."""
        name = folded(author)
        player = self._names.setdefault(name, name if name == UNNAMED else player_named(author))
        first = self._looks.setdefault(confusable_form(player), player)
        if first != player:
            self.alike[player] = first
            return player, f"the player's name looks like {first} and is another one"
        return player, "letters of the player's name look like those of another script" if mixed_word(player) else ""
