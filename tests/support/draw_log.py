"""What is drawn, as lines of text: every text, shape, sprite and picture of one whole redraw, in its order.

Numbers are logical px, colours are roles of the palette. ``DrawLog.called``: the functions of the front end that drew;
``DrawLog.stale``: the screens on which something had not been drawn again that had changed.
"""

import re
import sys
from ast import literal_eval
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from types import CodeType, FrameType
from typing import Any, ClassVar, NamedTuple
from unittest.mock import patch

import pygame
import pytest

from ninja_game.play.app import App
from ninja_game.play.editor.view import EditorView, Overlay
from ninja_game.play.thumbnails import Thumbnails
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.lettering import Lettering
from ninja_game.ui.theme import ROLES, Palette, Theme
from ninja_game.view.sprites.backdrop import Backdrop
from ninja_game.view.sprites.drawing import DrawTarget, SpriteKey


def px(*values: float) -> str:
    return ",".join(f"{value:.1f}".removesuffix(".0") for value in values)


def role_of(colour: Any, palette: Palette) -> str:
    """The name of a colour in a palette; a mixed one by its numbers."""
    found = pygame.Color(colour)
    alpha = "" if found.a == 255 else f"/{found.a}"
    for role in ROLES:
        if getattr(palette, role)[:3] == found[:3]:
            return role + alpha
    return f"#{found.r:02x}{found.g:02x}{found.b:02x}{alpha}"


def _sprite_name(key: SpriteKey) -> str:
    name = getattr(key.drawing.paint, "__name__", "?")
    turn = f" turned {key.turn}" if key.turn else ""
    faded = f" faded {key.alpha}/8" if key.alpha != 8 else ""
    return f"{name}({', '.join(map(str, key.parameters))}){turn}{faded}"


Note = tuple[Any, str, Callable[..., str]]  # a class or module, the name of its method, and the line of a call


class _NotedWindow(pygame.Surface):
    """In place of the window, with its picture: ``note`` gets each picture that is put into it, and where."""

    note: Callable[[str], None]

    def blit(self, source: pygame.Surface, dest: Any = (0, 0), area: Any = None, special_flags: int = 0) -> pygame.Rect:
        part = f" from {px(*area)}" if area else ""
        self.note(f"picture {px(*source.get_size())} at {px(*dest[:2])}{part}")
        return super().blit(source, dest, area, special_flags)


class DrawLog:
    """The lines of what is drawn while ``recording`` lasts, between ``installed`` and its end."""

    containers: ClassVar[Sequence[tuple[type, str]]] = ()  #: methods whose parts are noted as well

    def __init__(self) -> None:
        self.called: set[CodeType] = set()
        self.stale: list[str] = []
        self._depth = 0
        self._lines: list[str] | None = None
        self._palette: Palette | None = None
        self._static: dict[Backdrop, dict[int, list[tuple[SpriteKey, float, float]]]] = {}

    @contextmanager
    def recording(self, palette: Palette) -> Iterator[list[str]]:
        """The lines of what is drawn meanwhile, in colours of a palette."""
        self._palette = palette
        lines: list[str] = []
        window = pygame.display.get_surface()
        assert window
        _NotedWindow.note = self._note_alone
        noted = _NotedWindow(window.get_size())
        pygame.Surface.blit(noted, window, (0, 0))
        self._lines = lines
        try:
            with patch("pygame.display.get_surface", lambda: noted), self.noting_calls():
                yield lines
        finally:
            self._lines = None
            window.blit(noted, (0, 0))

    @contextmanager
    def noting_calls(self) -> Iterator[None]:
        """What is called meanwhile is among ``called``."""
        sys.setprofile(self._note_call)
        try:
            yield
        finally:
            sys.setprofile(None)

    def _note_call(self, frame: FrameType, event: str, _: Any) -> None:
        if event == "call":
            self.called.add(frame.f_code)

    def notes(self) -> list[Note]:
        """What is watched, and the line that is noted of a call."""
        return [
            (Lettering, "draw", self._text),
            (Canvas, "fill_rect", self._fill),
            (Canvas, "frame_rect", self._frame),
            (Canvas, "line", lambda _, __, c, a, b, w=1: f"line {self._colour(c)} {px(*a)} to {px(*b)} width {w:g}"),
            (Canvas, "circle", lambda _, __, c, at, r, w=0: f"circle {self._colour(c)} {px(*at)} r {r:g} width {w:g}"),
            (Canvas, "polygon", lambda _, __, c, at: f"polygon {self._colour(c)} {'  '.join(px(*p) for p in at)}"),
            (DrawTarget, "sprite", lambda _, key, x, y: f"sprite {_sprite_name(key)} at {px(x, y)}"),
            (DrawTarget, "picture", lambda _, __, x, y: f"figure at {px(x, y)}"),
            (DrawTarget, "line", self._beam),
            (
                DrawTarget,
                "disc",
                lambda _, c, x, y, r, w=0: f"disc {self._colour(c)} at {px(x, y)} r {r:g} width {w:g}",
            ),
            (Thumbnails, "draw", lambda _, __, e, x, y, w: f"thumbnail of {e.title!r} at {px(x, y)} width {w:g}"),
            (Backdrop, "_place", self._place),
            (Backdrop, "update", self._backdrop),
            (EditorView, "draw", self._view),
            (Overlay, "_frame", lambda _, area, c: f"frame {self._colour(c)} round cells {px(*area)}"),
            (Overlay, "_ghost_tile", lambda _, cell, tile: f"ghost of tile {tile} in cell {px(*cell)}"),
        ]

    def alone(self) -> list[Note]:
        """Those that are noted only where they are no part of others."""
        return []

    @contextmanager
    def installed(self) -> Iterator[None]:
        """The methods that draw are watched."""
        with ExitStack() as stack:
            for note in self.notes():
                stack.enter_context(self._watched(*note, alone=False))
            for note in self.alone():
                stack.enter_context(self._watched(*note, alone=True))
            yield

    def _watched(self, owner: Any, method: str, note: Callable[..., str], *, alone: bool) -> Any:
        """Patch a method: note its call, then do it."""
        original = getattr(owner, method)

        def noted(*args: Any, **named: Any) -> Any:
            if (self._lines is not None and not (alone and self._depth)) or method == "_place":
                self._note(note(*args, **named))
            inner = (owner, method) not in self.containers
            self._depth += inner
            try:
                return original(*args, **named)
            finally:
                self._depth -= inner

        return patch.object(owner, method, noted)

    def _note(self, line: str) -> None:
        if line and self._lines is not None:
            self._lines.append(line)

    def _note_alone(self, line: str) -> None:
        self._note(line * (not self._depth))

    def _colour(self, colour: Any) -> str:
        assert self._palette
        return role_of(colour, self._palette)

    # --- lines of what has many parameters ---

    def _view(self, view: EditorView, *_: Any, **__: Any) -> str:
        """The level with its marks is painted again, too."""
        view.repaint()
        return ""

    def _text(self, _: Any, surface: Any, text: str, x: float, y: float, size: float, colour: Any,
              *, align: str = "left", bold: bool = False) -> str:  # fmt: skip
        style = (" bold" if bold else "") + (f" {align}" if align != "left" else "")
        return f"text {text!r} at {px(x, y)} size {size:g}{style} {self._colour(colour)}" if surface else ""

    def _fill(self, _: Any, __: Any, c: Any, x: float, y: float, w: float, h: float, radius: float = 0) -> str:
        return f"fill {self._colour(c)} {px(x, y)} {px(w)} x {px(h)} radius {radius:g}"

    def _frame(self, _: Any, __: Any, c: Any, x: float, y: float, w: float, h: float,
               width: float = 1, radius: float = 0) -> str:  # fmt: skip
        return f"frame {self._colour(c)} {px(x, y)} {px(w)} x {px(h)} width {width:g} radius {radius:g}"

    def _beam(self, _: Any, c: Any, ax: float, ay: float, bx: float, by: float, width: float = 0) -> str:
        return f"beam {self._colour(c)} {px(ax, ay)} to {px(bx, by)} width {width:.1f}"

    def _place(self, backdrop: Backdrop, slot: int, sprites: Any) -> str:
        self._static.setdefault(backdrop, {})[slot] = list(sprites)
        return ""

    def _backdrop(self, backdrop: Backdrop, *_: Any) -> str:
        places: dict[str, list[str]] = {}
        for sprites in self._static.get(backdrop, {}).values():
            for key, x, y in sprites:
                places.setdefault(_sprite_name(key), []).append(px(x, y))
        return "\n".join(f"static {name} at {'  '.join(where)}" for name, where in places.items())


def drawn(app: App) -> str:
    """The lines of all that is drawn now."""
    log = DrawLog()
    with log.installed(), log.recording(app.theme.palette) as lines:
        app.stack.redraw_all()
        app.draw()
    return "\n".join(lines)


class DrawnText(NamedTuple):
    """A text on the window. ``at``: where it begins, logical px; ``colour``: its role in the palette."""

    text: str
    at: tuple[float, float]
    bold: bool
    colour: str


def drawn_texts(app: App) -> list[DrawnText]:
    """The texts of all that is drawn now."""
    found = re.findall(
        r"^text (.+) at ([-\d.]+),([-\d.]+) size \S+( bold)?(?: (?!bold)\S+)? (\S+)$", drawn(app), re.MULTILINE
    )
    return [DrawnText(literal_eval(text), (float(x), float(y)), bool(bold), ink) for text, x, y, bold, ink in found]


def notice_box(app: App) -> pygame.Rect:
    """The place of the notice on the window, px, as it is drawn now: over all else."""
    boxes: list[pygame.Rect] = []
    window = Theme.window

    def noted(theme: Theme, *where: Any, **more: Any) -> pygame.Rect:
        boxes.append(window(theme, *where, **more))
        return boxes[-1]

    with patch.object(Theme, "window", noted):
        app.draw()
    assert app.notice
    return boxes[-1]


def noted_texts(monkeypatch: pytest.MonkeyPatch) -> dict[str, pygame.Rect]:
    """Every text that is drawn from now on, and its last place on the window, px; unlike ``drawn``, redraws nothing."""
    places: dict[str, pygame.Rect] = {}
    write = Theme.text

    def noted(theme: Theme, surface: pygame.Surface | None, text: str, *rest: Any, **more: Any) -> pygame.Rect:
        place = write(theme, surface, text, *rest, **more)
        places.update({text: place} if surface else {})
        return place

    monkeypatch.setattr(Theme, "text", noted)
    return places
