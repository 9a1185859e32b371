"""The draft that is being edited, with every one that led to it: undo and redo without limit."""

from __future__ import annotations

from typing import Generic, TypeVar

Draft = TypeVar("Draft")
"""A level or a run under edit: never changed, equal to another one that says the same."""


class History(Generic[Draft]):
    """``draft``: the present one. A *stroke* is several changes that are undone as one, such as a line of tiles."""

    def __init__(self, draft: Draft) -> None:
        self.draft = draft
        self._done: list[Draft] = []
        self._undone: list[Draft] = []
        self._began: Draft | None = None

    @property
    def can_undo(self) -> bool:
        """Whether there is anything to take back."""
        return bool(self._done) or self._began not in (None, self.draft)

    @property
    def can_redo(self) -> bool:
        """Whether there is anything to do again."""
        return bool(self._undone)

    @property
    def began(self) -> Draft:
        """The draft at the begin of the stroke; the present one outside of strokes."""
        return self.draft if self._began is None else self._began

    @property
    def in_stroke(self) -> bool:
        """Whether a stroke has begun."""
        return self._began is not None

    def begin(self) -> None:
        """A stroke begins."""
        self.end()
        self._began = self.draft

    def change(self, draft: Draft) -> None:
        """Another draft, as a part of the stroke or as an edit of its own."""
        if draft == self.draft:
            return
        alone = self._began is None
        self._began = self.began
        self.draft = draft
        if alone:
            self.end()

    def end(self) -> None:
        """The stroke ends."""
        began, self._began = self._began, None
        if began not in (None, self.draft):
            self._done.append(began)
            self._undone.clear()

    def abandon(self) -> None:
        """The stroke ends and leaves nothing."""
        self.draft, self._began = self.began, None

    def undo(self) -> bool:
        """Take the last edit back; whether there was one."""
        return self._step(self._done, self._undone)

    def redo(self) -> bool:
        """Do again what was taken back last; whether there was anything."""
        return self._step(self._undone, self._done)

    def _step(self, source: list[Draft], target: list[Draft]) -> bool:
        self.end()
        if not source:
            return False
        target.append(self.draft)
        self.draft = source.pop()
        return True
