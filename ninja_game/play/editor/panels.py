"""The palette, the level's findings, and its file."""

from __future__ import annotations

from collections.abc import Callable

import pygame

from ninja_game.files.user_folder import short_path
from ninja_game.levels.findings import Finding
from ninja_game.play.editor.palette_view import PaletteView
from ninja_game.play.editor.part import EditorPart, ToolButton
from ninja_game.play.editor.view import LAYOUT, EditorView
from ninja_game.ui.list_view import ListView
from ninja_game.ui.theme import Area, Theme, wrapped


class PalettePart(EditorPart):
    area = LAYOUT.palette
    panel = (612, 26, 178, 231)

    def __init__(self, view: EditorView, palette: PaletteView, run: Callable[[str], object]) -> None:
        super().__init__(view)
        self._palette = palette
        x, y, w, h = self.area
        listed = ToolButton((x + w - 38, y + h - 15, 34, 14), "list", "List", run, view)
        stamps = ToolButton((x + w - 78, y + h - 15, 39, 14), "stamps", "Stamps", run, view)
        self.widgets = [palette, listed, stamps]

    def render_key(self) -> tuple[object, ...]:
        tools = self.session.tools
        return tools.brush.tile, tools.brush.spec, self._palette.hovered, tools.brush.draws_objects

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        super().paint(surface, theme)
        x, y, w, h = self.area
        theme.text(surface, self._palette.label, x + 5, y + h - 13, size=8, width=w - 83, height=13)

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        used = super().mouse(event, x, y)
        if used:
            self._palette.hover(x, y)
        elif event.type == pygame.MOUSEWHEEL:
            self._palette.step(-event.y)
        return used or event.type == pygame.MOUSEWHEEL

    def mouse_left(self) -> None:
        self._palette.hovered = None


class Findings(EditorPart):
    """The findings about the level. ``go_to``: called with the number of a finding."""

    area = LAYOUT.findings
    panel = LAYOUT.findings

    def __init__(self, view: EditorView, go_to: Callable[[int], object]) -> None:
        super().__init__(view)
        self._shown: list[Finding] = []
        self._gone_to = -1
        self.lines: list[tuple[int, str]] = []
        self.list = ListView(self.area, 19, self._draw_row, lambda row: go_to(self.lines[row][0]))
        self.list.empty, self.list.hint = "No problems found", "A click goes there and selects it"
        self.widgets = [self.list]

    def render_key(self) -> tuple[object, ...]:
        return tuple(self.lines), self.list.first

    def update(self, real_ms: int) -> None:
        if self._shown is not self.session.edited.examination.findings:
            self._shown, theme = self.session.edited.examination.findings, self.view.app.theme
            width = self.area[2] - 32
            accepted = self.session.edited.accepted
            texts = [
                f"{odd.sentence}. Accepted: {accepted[odd.code]}" if odd.code in accepted else odd.advice
                for odd in self._shown
            ]
            self.lines = [(k, line) for k, text in enumerate(texts) for line in wrapped(theme, text, width, 9.5)]
            self.list.fill(self.lines)
        if self._gone_to != self.view.finding:
            self._gone_to = self.view.finding
            rows = [row for row, (number, _) in enumerate(self.lines) if number == self._gone_to]
            for row in reversed(rows):
                self.list.select(row)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        number, line = self.lines[index]
        x, y, w, _ = area
        accepted = self._shown[number].code in self.session.edited.accepted
        if not accepted and (index == 0 or self.lines[index - 1][0] != number):
            theme.text(surface, "!", x + 4, y + 5, size=9.5, bold=True, colour=theme.palette.bad)
        colour = theme.palette.faint if accepted else theme.palette.text
        theme.text(surface, line, x + 14, y + 5, size=9.5, width=w - 16, colour=colour)


class FilePart(EditorPart):
    """The name and file of the level, whether it is saved, and the state of its certificate."""

    area = LAYOUT.file
    panel = LAYOUT.file

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        used, path = super().mouse(event, x, y), self.session.edited.source.path
        self.view.hint = short_path(path) if used and path else self.view.hint
        return used

    def render_key(self) -> tuple[object, ...]:
        session, certifier = self.session, self.session.certifier
        solver = certifier.text, certifier.is_busy, certifier.certification.share, certifier.certification.run is None
        stale = certifier.is_stale(session.draft.level)
        return session.name, session.edited.source.path, session.is_saved, solver, stale

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        super().paint(surface, theme)
        canvas, palette, session = theme.canvas, theme.palette, self.session
        x, y, w, h = self.area
        x, w = x + 4, w - 6
        theme.text(surface, session.name, x, y + 5, size=11, bold=True, width=w)
        path, state = session.edited.source.path, "saved" if session.is_saved else "not saved"
        file = f"{path.name}: {state}" if path else "not in a file yet"
        theme.text(surface, file, x, y + 20, size=9, colour=palette.faint, width=w)
        certifier = session.certifier
        stale, run = certifier.is_stale(session.draft.level), certifier.certification.run
        text = certifier.text or "Not certified yet: F7 looks for a way through it"
        if stale and certifier.is_busy:
            text = "The level has changed: the search starts again once you pause, or now by F7"
        elif stale:
            text = f"{'Certified before' if run else 'Not certified since'} the last change: F7 again"
        elif run and not certifier.is_busy:
            text += f". {session.keeping}"
        for number, line in enumerate(wrapped(theme, text, w, 9)[:3]):
            colour = palette.good if run and not stale else palette.text
            theme.text(surface, line, x, y + 36 + 12 * number, size=9, colour=colour)
        if certifier.is_busy and certifier.certification.progress:
            canvas.fill_rect(surface, palette.panel_edge, x, y + h - 9, w, 5, 2)
            canvas.fill_rect(surface, palette.accent, x, y + h - 9, max(1.0, w * certifier.certification.share), 5, 2)
