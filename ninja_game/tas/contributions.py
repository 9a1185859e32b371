"""The people and programs that contributed to the keys of a run under edit."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Self

from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.provenance import names_of_text


@dataclass(frozen=True)
class Contributions:
    """The origins of the keys of a run under edit. ``edits``: number of edits of keys.

    ``commands``: searches whose keys were used, by command; ``names``: other contributors.
    """

    edits: int = 0
    commands: tuple[str, ...] = ()
    names: tuple[str, ...] = ()

    @classmethod
    def of(cls, recording: Recording) -> Self:
        """The contributions of a run whose keys are used; an unknown author is named by the file."""
        replay = recording.replay
        return cls(0, replay.made.searches, names_of_text(", ".join((recording.begun_by, *replay.co_authors))))

    def __add__(self, other: Contributions) -> Contributions:
        """The union: each command and name once."""
        commands, names = (
            tuple(dict.fromkeys((*ours, *theirs)))
            for ours, theirs in ((self.commands, other.commands), (self.names, other.names))
        )
        return Contributions(self.edits + other.edits, commands, names)

    def credited(self, origin: Recording, player: str) -> Recording:
        """A recording as it was opened, with a player's later contributions."""
        old, author = origin.replay, origin.author or player
        names = names_of_text(", ".join((*old.co_authors, player, *self.names)))
        # An empty run of the editor's was nobody's before; else its origin stays known, also if nobody says who edits.
        begun_by = "" if player == origin.author != "" or not old.inputs else origin.begun_by
        made = old.made.edited(self.edits).searched(*self.commands, begun_by=begun_by)
        others = tuple(name for name in names if name != author)
        return replace(origin, replay=replace(old, author=author, made=made, co_authors=others))

    def as_json(self) -> dict[str, Any]:
        return {"edits": self.edits, "commands": list(self.commands), "names": list(self.names)}

    @classmethod
    def of_json(cls, kept: dict[str, Any]) -> Self:
        """The inverse of ``as_json``. Raises one of DAMAGED for anything else."""
        return cls(int(kept["edits"]), tuple(map(str, kept["commands"])), tuple(map(str, kept["names"])))


NONE = Contributions()
