"""Branches: input tracks kept by hand, or when a search result is used, as a tree."""

from __future__ import annotations

import pygame

from ninja_game.play.menu_screen import Question, ask_text
from ninja_game.play.workspace import Commands
from ninja_game.tas.tracks import Branch, Branches
from ninja_game.tas_editor.editor import OtherRun, TasEditor
from ninja_game.tas_editor.tabs.tab import SMALL, UNPLACED, Rows, Tab, put_in_a_row
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Button

_MAX_NAME = 60  # characters of a name

_INDENT, _DEEPEST = 9, 12
_COLUMNS = (174, 112, 64)  # places of end, gold and difference, px from the right of a row


class BranchesTab(Tab):
    """The tree of branches; the one under the mouse is also shown in the level and the roll."""

    name = "Branches"

    def __init__(self, editor: TasEditor) -> None:
        super().__init__(editor)
        self.tree: list[tuple[int, int]] = []
        self._looked_at: OtherRun | None = None
        hint = "Under the mouse, or clicked: shown in level and roll; a second click goes to it"
        self.list = Rows(self._draw_row, lambda _: self.checkout(), hint=hint, opens=True)
        self.list.empty = "B keeps the run as a branch"
        actions = [
            ("Keep", self.keep, "B: keep the run as it is now, as a child of the marked branch"),
            ("Go to it", self.checkout, "The run becomes the chosen branch; undo brings back what was there"),
            ("Compare", self.compare, "The lead of the run over the chosen branch"),
            ("Rename", self.rename, "Another name for the chosen branch"),
            ("Drop", self.drop, "Forget the chosen branch; what was made from it stays"),
        ]
        self._buttons = [Button(UNPLACED, text, action, hint=hint, size=SMALL) for text, action, hint in actions]
        self._for_one = self._buttons[1:]
        self.widgets: list[Rows | Button] = [self.list, *self._buttons]

    def arrange(self, x: float, y: float, w: float, h: float) -> None:
        self.list.area = x + 4, y + 20, w - 8, h - 43
        put_in_a_row((x + 4, y + h - 20, w - 8, 17), self._buttons, (46, 58, 58, 56, 46))

    def commands(self) -> Commands:
        return {"branch": self.keep}

    @property
    def branches(self) -> Branches:
        return self.editor.session.branches

    @property
    def chosen(self) -> int | None:
        return self.tree[self.list.index][0] if self.list.index < len(self.tree) else None

    @property
    def preview(self) -> OtherRun | None:
        at = self.list.looked_at
        if not 0 <= at < len(self.tree):
            return None
        branch = self.branches.all[self.tree[at][0]]
        if branch.track.inputs == self.editor.track.inputs:
            return None
        if self._looked_at is None or (self._looked_at.name, self._looked_at.track) != (branch.name, branch.track):
            self._looked_at = self.editor.other_run(branch.name, branch.track)
        return self._looked_at

    def keep(self) -> None:
        self.editor.tab = self.name
        session = self.editor.session
        name = session.timeline.ending() or f"branch {len(self.branches) + 1}"

        def kept(text: str) -> None:
            number = session.keep_branch(text.strip() or name)
            self.refresh()
            self.list.index = [branch for branch, _ in self.tree].index(number)

        ask_text(self.editor.app, "Keep the run as a branch", "its name", name, "Keep", kept, _MAX_NAME)

    def checkout(self) -> None:
        number = self.chosen
        if number is not None:
            self.editor.attempt(lambda: self.editor.session.checkout_branch(number))

    def compare(self) -> None:
        if self.chosen is not None:
            self.editor.against = self.branches.all[self.chosen].track
            self.editor.tab = "Lead"

    def rename(self) -> None:
        number = self.chosen
        if number is None:
            return
        old = self.branches.all[number].name

        def renamed(text: str) -> None:
            self.editor.session.rename_branch(number, text.strip() or old)

        ask_text(self.editor.app, "Rename the branch", "its name", old, "Rename", renamed, _MAX_NAME)

    def drop(self) -> None:
        number = self.chosen
        if number is not None:
            app, session = self.editor.app, self.editor.session
            title = f"Drop {self.branches.all[number].name}?"
            app.push(Question(app, title, "Drop it", lambda: session.drop_branch(number)))

    def refresh(self) -> None:
        tree = list(self.branches.in_tree())
        if tree != self.tree:
            self.tree = tree
            self.list.fill(tree)
        for button in self._for_one:
            button.enabled = bool(self.tree)

    def render_key(self) -> tuple[object, ...]:
        session = self.editor.session
        tree = tuple(self.branches.all), self.branches.current
        return tree, session.track, session.timeline.end, self.list.over

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        super().paint(surface, theme)
        self.refresh()
        self.list.draw_heads(surface, theme, "Branch", ("Ends in tick", "Gold", "Against the run now"), _COLUMNS)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, _: bool) -> None:
        number, depth = self.tree[index]
        branch, palette = self.branches.all[number], theme.palette
        x, y, w, h = area
        right, left = x + w, x + 16 + _INDENT * min(depth, _DEEPEST)
        current = number == self.branches.current
        if current:
            tip = left - 4
            theme.canvas.polygon(surface, palette.accent, [(tip - 6, y + 4), (tip - 6, y + h - 4), (tip, y + h / 2)])
        changed = " (changed since)" if current and branch.track.inputs != self.editor.track.inputs else ""
        width = right - _COLUMNS[0] - left - 6
        theme.text(surface, branch.name + changed, left, y + 3, size=SMALL, bold=current, width=width)
        cells = (f"{branch.outcome} {branch.end}" if branch.end >= 0 else "no end", str(branch.gold))
        for at, text in zip(_COLUMNS, cells, strict=False):
            theme.text(surface, text, right - at, y + 3, size=SMALL)
        words, ahead = self.difference(branch)
        colour = palette.good if ahead > 0 else palette.bad if ahead < 0 else palette.text
        theme.text(surface, words, right - _COLUMNS[2], y + 3, size=SMALL, bold=bool(ahead), colour=colour)

    def difference(self, branch: Branch) -> tuple[str, int]:
        """The ticks by which a branch is shorter or longer than the run, as text."""
        end, outcome = self.editor.session.timeline.end
        if branch.track.inputs == self.editor.track.inputs:
            return "the same", 0
        if {branch.outcome, outcome} != {"exit"}:
            return "", 0
        ahead = end - branch.end
        text = f"{abs(ahead)} {'shorter' if ahead > 0 else 'longer'}"
        return text if ahead else "as long", ahead
