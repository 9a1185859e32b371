"""The draft that is being edited, with every edit that led to it: undo and redo without limit."""

from __future__ import annotations

from ninja_game.editor.draft import Draft, Edit, difference


class History:
    """``draft``: the present one. A *stroke* is several changes that are undone as one, such as a line of tiles."""

    def __init__(self, draft: Draft) -> None:
        self.draft = draft
        self._done: list[Edit] = []
        self._undone: list[Edit] = []
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

    def begin(self) -> None:
        """A stroke begins."""
        self.end()
        self._began = self.draft

    def change(self, draft: Draft) -> bool:
        """Another draft, as a part of the stroke or as an edit of its own; whether it differs."""
        if draft == self.draft:
            return False
        if self._began is None:
            self.begin()
            self.draft = draft
            self.end()
        else:
            self.draft = draft
        return True

    def end(self) -> None:
        """The stroke ends."""
        began, self._began = self._began, None
        edit = difference(began, self.draft) if began is not None else None
        if edit:
            self._done.append(edit)
            self._undone.clear()

    def abandon(self) -> None:
        """The stroke ends and leaves nothing."""
        if self._began is not None:
            self.draft, self._began = self._began, None

    def undo(self) -> bool:
        """Take the last edit back; whether there was one."""
        self.end()
        return self._step(self._done, self._undone)

    def redo(self) -> bool:
        """Do again what was taken back last; whether there was anything."""
        self.end()
        return self._step(self._undone, self._done)

    def _step(self, source: list[Edit], target: list[Edit]) -> bool:
        if not source:
            return False
        edit = source.pop().inverse()
        self.draft = edit.applied(self.draft)
        target.append(edit)
        return True
