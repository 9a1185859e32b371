"""Screens of widgets: focus by keyboard, gamepad and mouse; the frame of all menus; panels over other screens."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import pygame

from ninja_game.files.shown_text import shown_text
from ninja_game.levels.episodes import Mood
from ninja_game.play.app import CALM_MOOD, App, Screen
from ninja_game.player.player_data import PlayerData
from ninja_game.ui.canvas import HEIGHT, WIDTH
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.input.keys import HeldKey, scancode_of
from ninja_game.ui.list_view import ListView
from ninja_game.ui.scenery import draw_scenery
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import Area, Theme, contains_point, wrapped
from ninja_game.ui.widgets import Button, Label, Widget

_FIRST_REPEAT_MS, _REPEAT_MS, _TEXT_REPEAT_MS = 350, 70, 40
"""A held direction or a key in a text repeats: after the first time, then at the other intervals, ms."""

DIRECTIONS = {"left": (-1, 0), "right": (1, 0), "up": (0, -1), "down": (0, 1)}
MOUSE = (pygame.MOUSEMOTION, pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP, pygame.MOUSEWHEEL)
REPEATING = frozenset({*DIRECTIONS, "page_up", "page_down"})

TITLE_SIZE = 22
BACK: Area = (WIDTH - 24 - 84, 15, 84, 26)  # the place beside the title where the mouse goes back


class MenuScreen(Screen):
    """Widgets, one of which has the focus. Subclasses fill ``widgets`` in ``build`` and set their ``title``.

    ``foot``: the line at the bottom if the focused widget has no hint. ``offers_back``: the frame has a place where the
    mouse goes back; keys and pads have their own, so it takes no focus. ``wraps``: up from the first widget leads to
    the last. ``says_full``: a notice says that no more letters fit into a field. ``search``: the field that typed
    letters go to, wherever the focus is.
    """

    title = ""
    offers_back = True
    wraps = True
    says_full = True
    foot = "Arrows to move, Enter to choose, Esc to go back"

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.player: PlayerData = app.player
        self.widgets: list[Widget] = []
        self.focus: Widget | None = None
        self.search: TextEntry | None = None
        self._direction: HeldKey[str] = HeldKey()
        self._typed: HeldKey[pygame.Event] = HeldKey()
        self._dragged: Widget | None = None

    @property
    def mood(self) -> Mood:
        return CALM_MOOD

    def build(self) -> Sequence[Widget]:
        """The widgets; the first that can have the focus gets it."""
        raise NotImplementedError

    def enter(self) -> None:
        """Build the widgets again, since what they show may have changed. The focus keeps its place."""
        place = self.widgets.index(self.focus) if self.focus in self.widgets else 0
        self.widgets = list(self.build())
        able = [widget for widget in self.widgets if widget.focusable]
        focus = self.widgets[place] if place < len(self.widgets) else None
        self.focus = focus if focus in able else next(iter(able), None)
        self._direction.end()
        self.await_text()
        self.app.report_problems()

    def show_episodes(self, pack: str) -> None:
        """Called after an episode that was begun here. Screens with episodes show those of the pack."""

    def await_text(self) -> None:
        """Switch text input on where there is a field for it."""
        if any(isinstance(widget, TextEntry) for widget in self.widgets):
            pygame.key.start_text_input()
        else:
            pygame.key.stop_text_input()

    def widgets_changed(self) -> None:
        """A widget shows something else, or another one has the focus."""
        self.redraw = True

    def capture(self, event: InputEvent) -> bool:
        """While a text is typed, a key is a letter before anything else; Tab leads to the next widget.

        The key that hides the program therefore works only where nothing is typed.
        """
        if event.raw.type == pygame.KEYDOWN and event.source == ("keys", "tab"):
            self._next(-1 if event.raw.mod & pygame.KMOD_SHIFT else 1)
            return True
        if event.raw.type == pygame.TEXTINPUT and event.raw.text.strip():
            self.focus_on(self.search)
        is_used = self.focus is not None and self.focus.text_event(event.raw)
        self._typed.follow(event.raw)
        if event.raw.type == pygame.KEYDOWN:
            self._typed.end()
            if is_used:
                self._typed.begin(event.raw, scancode_of(event.raw), first=_FIRST_REPEAT_MS, every=_TEXT_REPEAT_MS)
        if is_used:
            self.widgets_changed()
        if isinstance(self.focus, TextEntry) and self.focus.edited.was_full:
            self.focus.edited.was_full = False
            if self.says_full:
                self.app.notify(f"At most {self.focus.edited.longest} letters")
        return is_used

    def handle(self, event: InputEvent) -> None:
        if event.raw.type in MOUSE:
            self._handle_mouse(event.raw)
            return
        if event.menu_released and event.menu_released == self._direction.what:
            self._direction.end()
        if event.menu:
            if event.menu in REPEATING:
                self._direction.begin(event.menu, first=_FIRST_REPEAT_MS, every=_REPEAT_MS)
            self.act(event.menu)

    def act(self, action: str, *, held: bool = False) -> None:
        """Do a menu action: the focused widget first, then the screen. ``held``: it repeats."""
        self.widgets_changed()
        if action == "back":
            self.chime("menu-choose")
            self.back()
        elif action == "confirm":
            self.chime("menu-choose")
            if self.focus is not None:
                self.focus.confirm()
        elif self.focus is not None and self.focus.nudge(action):
            self.chime("menu-move")
        elif action in DIRECTIONS and not (held and action in ("left", "right")):
            # A held key that brings a slider to its end does not move the focus on.
            self._move(*DIRECTIONS[action])
        elif action == "next":
            self._next()

    def back(self) -> None:
        self.close()

    def close(self) -> None:
        self.app.pop()

    def chime(self, name: str) -> None:
        self.app.audio_output.play(name)

    def focus_on(self, widget: Widget | None) -> None:
        if widget is not None and widget is not self.focus:
            self.focus = widget
            self.chime("menu-move")
            self.widgets_changed()

    def _next(self, step: int = 1) -> None:
        able = [widget for widget in self.widgets if widget.focusable]
        if able:
            place = able.index(self.focus) if self.focus in able else -1
            widget = able[(place + step) % len(able)]
            if isinstance(widget, TextEntry):
                widget.edited.select_all()
            self.focus_on(widget)

    def _move(self, dx: int, dy: int) -> None:
        """The focus goes to the nearest widget in a direction.

        Up and down stay among the widgets above each other; from the last they lead to the first if ``wraps``.
        """
        focus = self.focus
        if focus is None:
            return
        others = [widget for widget in self.widgets if widget.focusable and widget is not focus]
        if dy:
            others = [widget for widget in others if _aside(focus, widget, dx) == 0]
        ahead = [widget for widget in others if _ahead(focus, widget, dx, dy) > 0]

        def distance(widget: Widget) -> float:
            # Of several at one distance the one with the most similar upper edge: the first of a page.
            edges = abs(widget.area[1] - focus.area[1])
            return _ahead(focus, widget, dx, dy) + 3 * _aside(focus, widget, dx) + 0.01 * edges

        if ahead:
            self.focus_on(min(ahead, key=distance))
        elif others and dy and self.wraps:
            self.focus_on(max(others, key=lambda w: -dy * w.centre[1]))

    def _handle_mouse(self, event: pygame.Event) -> None:
        if event.type == pygame.MOUSEWHEEL:
            widget = self._at(*self.theme.canvas.logical(pygame.mouse.get_pos()))
            if widget is not None and widget.wheel(event.y):
                self.widgets_changed()
            return
        x, y = self.theme.canvas.logical(event.pos)
        if event.type == pygame.MOUSEMOTION:
            if self._dragged is not None:
                if self._dragged.drag(x, y):
                    self.widgets_changed()
                return
            widget = self._at(x, y)
            self.focus_on(widget)
            if isinstance(widget, ListView) and widget.hover(x, y):
                self.widgets_changed()
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_RIGHT:
            self.act("back")
        elif event.type == pygame.MOUSEBUTTONDOWN and self.offers_back and contains_point(BACK, x, y):
            self.chime("menu-choose")
            self.close()
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_LEFT:
            widget = self._at(x, y)
            if widget is not None:
                self._dragged = widget
                self.focus_on(widget)
                widget.click(x, y)
                self.widgets_changed()
        elif event.type == pygame.MOUSEBUTTONUP:
            self._dragged = None

    def _at(self, x: float, y: float) -> Widget | None:
        return next((widget for widget in self.widgets if widget.focusable and widget.contains(x, y)), None)

    def update(self, real_ms: int) -> None:
        for typed in self._typed.due(real_ms):
            if self.focus is not None and self.focus.text_event(typed):
                self.widgets_changed()
        for direction in self._direction.due(real_ms):
            self.act(direction, held=True)

    def leave(self) -> None:
        self._typed.end()
        self._direction.end()
        self._dragged = None

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        if not self.redraw:
            return []
        self.draw_frame(surface)
        self.draw_widgets(surface)
        return None

    def draw_frame(self, surface: pygame.Surface) -> None:
        theme, canvas, palette = self.theme, self.theme.canvas, self.theme.palette
        surface.fill(palette.tile)
        draw_scenery(surface, palette, canvas.stage, canvas.rect(24, 52, WIDTH - 48, HEIGHT - 52 - 36))
        canvas.frame_rect(surface, palette.tile, 18, 46, WIDTH - 36, HEIGHT - 52 - 24, 6, 12)
        width = (BACK[0] if self.offers_back else WIDTH - 36) - 48
        theme.text(surface, self.title, 36, 17, size=TITLE_SIZE, colour=palette.on_tile, bold=True, width=width)
        if self.offers_back:
            x, y, w, h = BACK
            theme.row(surface, BACK, chosen=False, focused=False)
            theme.text(surface, "Back", x + w / 2, y + h / 2 - 5, size=10, align="centre", width=w, height=h)
        hint = (self.focus.hint if self.focus is not None else "") or self.foot
        theme.text(
            surface, hint, WIDTH / 2, HEIGHT - 25, size=10.5, colour=palette.on_tile, align="centre", width=WIDTH - 48
        )

    def draw_widgets(self, surface: pygame.Surface) -> None:
        """Draw the widgets, the focused one last because of its mark."""
        for widget in sorted(self.widgets, key=lambda widget: widget is self.focus):
            widget.draw(surface, self.theme, focused=widget is self.focus)


def _ahead(start: Widget, goal: Widget, dx: int, dy: int) -> float:
    """Distance to a widget in a direction, px, from edge to edge; not positive: not in that direction."""
    (ax, ay), (bx, by) = start.centre, goal.centre
    along = (bx - ax) * dx + (by - ay) * dy
    gap = (start.area[2] + goal.area[2]) / 2 if dx else (start.area[3] + goal.area[3]) / 2
    return along - gap + 4 if along > 0 and along > gap / 2 else 0.0


def _aside(start: Widget, goal: Widget, dx: int) -> float:
    """Distance of two widgets across a direction, px; 0 where they overlap."""
    side = 1 if dx else 0
    low, high = start.area[side], start.area[side] + start.area[side + 2]
    other_low, other_high = goal.area[side], goal.area[side] + goal.area[side + 2]
    return max(0.0, other_low - high, low - other_high)


PANEL_WIDTH = 300

Action = Callable[[], object]
MenuRow = tuple[str, Action | None, str]
"""Text, action, hint; without an action the row is disabled, and the hint says why."""


def nothing() -> None:
    """The action of a button that only closes; the usual action after saving."""


CANCEL: MenuRow = ("Cancel", nothing, "")


class Panel(MenuScreen):
    """Rows over another screen. ``row_height``: px, with the gap; ``veil``: alpha of the shade over what is below.

    ``head``, ``side``: px above the rows, and beside them; ``size``: of their texts.
    """

    see_through = True
    offers_back = False
    row_height = 40.0
    veil = 130
    head, side, size = 48, 30, 12.0

    def __init__(self, app: App, title: str) -> None:
        super().__init__(app)
        self.title = title
        self._mood = app.mood

    @property
    def mood(self) -> Mood:
        """The mood of the screen below, which is visible; the panel itself looks like all menus."""
        return self._mood

    @property
    def theme(self) -> Theme:
        return self.app.menu_theme

    def rows(self) -> list[MenuRow]:
        raise NotImplementedError

    @property
    def _box(self) -> Area:
        height = self.head + 16 + self.row_height * len(self.rows())
        return (WIDTH - PANEL_WIDTH) / 2, (HEIGHT - height) / 2, PANEL_WIDTH, height

    def build(self) -> Sequence[Widget]:
        (x, y, w, _), row_height, side = self._box, self.row_height, self.side
        width, height = w - 2 * side, 0.8 * row_height
        return [
            Button((x + side, y + self.head + row_height * k, width, height), text, action, hint=hint, size=self.size)
            for k, (text, action, hint) in enumerate(self.rows())
        ]

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        if not self.redraw:
            return []
        canvas, theme, palette = self.app.canvas, self.theme, self.theme.palette
        veil = pygame.Color(palette.tile.r, palette.tile.g, palette.tile.b, self.veil)
        (left, top), (right, bottom) = canvas.logical((0, 0)), canvas.logical(canvas.window)
        canvas.fill_rect(surface, veil, left, top, right - left, bottom - top)
        x, y, w, h = self._box
        theme.window(surface, x, y, w, h)
        if theme.width(self.title, 17, bold=True) < w - 24:
            theme.text(surface, self.title, x + w / 2, y + 17, size=17, align="centre", bold=True)
        else:
            lines = wrapped(theme, self.title, w - 40, 12)
            for line, text in enumerate([*lines[:1], " ".join(lines[1:])]):
                top = y + (10 if len(lines) > 1 else 17) + 16 * line
                theme.text(surface, text, x + w / 2, top, size=12, align="centre", bold=True, width=w - 24)
        hint = self.focus.hint if self.focus is not None else ""
        theme.text(surface, hint, x + w / 2, y + h - 17, size=9.5, colour=palette.faint, align="centre", width=w - 16)
        self.draw_widgets(surface)
        return None


class Menu(Panel):
    """A panel of actions; each of them closes the panel first. ``then``: called when the back key closes it.

    ``at``: the row with the focus at first. ``unasked``: it opens by itself, so keys and mouse
    are ignored in its first half second: they were meant for the screen before.
    """

    def __init__(
        self,
        app: App,
        title: str,
        rows: Sequence[MenuRow],
        then: Action = nothing,
        *,
        at: int = 0,
        unasked: bool = False,
    ) -> None:
        super().__init__(app, title)
        self.row_height = min(self.row_height, (HEIGHT - 80) / max(1, len(rows)))  # fourteen rows have room
        self._deaf_ms = 500 if unasked else 0
        self._then, self._begins = then, at
        self._rows: list[MenuRow] = [
            (text, action and partial(self._close_and_do, action), hint) for text, action, hint in rows
        ]

    def enter(self) -> None:
        first = self.focus is None
        super().enter()
        if first and self._begins:
            self.focus = self.widgets[self._begins]

    def update(self, real_ms: int) -> None:
        self._deaf_ms = max(0, self._deaf_ms - real_ms)
        super().update(real_ms)

    def handle(self, event: InputEvent) -> None:
        if not self._deaf_ms:
            super().handle(event)

    def back(self) -> None:
        super().back()
        self._then()

    def _close_and_do(self, action: Action) -> None:
        self.app.pop()
        action()

    def rows(self) -> list[MenuRow]:
        return self._rows


class DropDown(Menu):
    """A menu below a ``button``, which a click elsewhere closes."""

    veil, row_height, head, side, size = 0, 23, 4, 4, 9.5

    def __init__(self, app: App, button: Area, rows: Sequence[MenuRow], *, at: int = 0) -> None:
        super().__init__(app, "", rows, at=at)
        self._button = button

    @property
    def _box(self) -> Area:
        x, y, w, h = self._button
        width = max(self.theme.width(text, self.size, bold=True) + 16 for text, _, _ in self.rows())
        return x, y + h + 1, max(w, 110.0, width), 4 + self.row_height * len(self.rows())

    def _handle_mouse(self, event: pygame.Event) -> None:
        if event.type == pygame.MOUSEBUTTONDOWN and not self._at(*self.theme.canvas.logical(event.pos)):
            self.back()
        else:
            super()._handle_mouse(event)


def ask_received(app: App, pack: str, copy: Action, change: Action) -> None:
    """Ask whether to change a copy of what came by a link, or the original."""
    rows: list[MenuRow] = [
        ("Copy it, to change that", copy, "What was received stays as it is"),
        ("Change it all the same", change, "It is yours from now on"),
        CANCEL,
    ]
    app.push(Menu(app, f"Received: {shown_text(pack)}", rows))


def ask_to_keep(app: App, title: str, keep: Action) -> None:
    """Ask whether the changes of the screen on top are kept; if not, it is closed."""
    app.push(Menu(app, title, [("Keep the changes", keep, ""), ("Discard changes", app.pop, ""), CANCEL]))


class Question(Menu):
    """Asks before an action that is hard to undo. No comes first and up does not wrap, against hasty keys."""

    wraps = False

    def __init__(self, app: App, title: str, yes: str, action: Callable[[], object], hint: str = "") -> None:
        super().__init__(app, title, [(CANCEL[0], nothing, hint), (yes, action, hint)])


_LABEL = 16  # px above a field, for its prompt


class FormPanel(Menu):
    """Fields to fill in above two buttons. ``fields``: prompt, text, most characters; prompts stand above the fields.

    The text of the first field is a proposal. Several fields are not left without a question once they are changed.
    """

    def __init__(
        self,
        app: App,
        title: str,
        fields: Sequence[tuple[str, str, int]],
        yes: str,
        action: Callable[[list[str]], object],
    ) -> None:
        self.texts = [text for _, text, _ in fields]
        self._fields = fields
        self._label = _LABEL if any(prompt for prompt, _, _ in fields) else 0
        self.head = Menu.head + (40 + self._label) * len(fields)
        super().__init__(app, title, [(yes, lambda: action(self.texts), ""), CANCEL])

    def build(self) -> Sequence[Widget]:
        (x, y, w, _), side = self._box, self.side
        entries, labels = [], []
        for k, ((prompt, text, longest), now) in enumerate(zip(self._fields, self.texts, strict=True)):
            left, top, wide = x + side, y + Menu.head + (40 + self._label) * k, w - 2 * side
            area, put = (left, top + self._label, wide, 30), partial(self.texts.__setitem__, k)
            entries.append(TextEntry(area, "", now, put, longest=longest, proposed=k == 0 and now == text))
            labels.append(Label((left, top, wide, self._label), prompt, size=9.5, faint=True))
        return [*entries, *super().build(), *labels]

    def act(self, action: str, *, held: bool = False) -> None:
        if action == "confirm" and isinstance(self.focus, TextEntry):
            self.widgets[len(self._fields)].confirm()
        else:
            super().act(action, held=held)

    def close(self) -> None:
        if len(self.texts) > 1 and self.texts != [text for _, text, _ in self._fields]:
            ask_to_keep(self.app, f"{self.title}: changed", self.widgets[len(self._fields)].confirm)
        else:
            super().close()


def ask_text(
    app: App, title: str, prompt: str, text: str, yes: str, action: Callable[[str], object], longest: int = 100
) -> None:
    """Ask for one text, at most ``longest`` characters, and call a function with it."""
    app.push(FormPanel(app, title, [(prompt, text, longest)], yes, lambda texts: action(texts[0])))
