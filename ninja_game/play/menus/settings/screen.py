"""Settings: five pages of widgets; every change is saved and shown at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import pygame

from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.play.menus.settings.rebinding import BindingTable, binding_widgets
from ninja_game.play.ui.canvas import WIDTH
from ninja_game.play.ui.list_view import ListView
from ninja_game.play.ui.text_entry import TextEntry
from ninja_game.play.ui.theme import NINJA_COLOURS, PALETTES, Area, Theme
from ninja_game.play.ui.widgets import Choice, Label, Slider, Widget
from ninja_game.player.progress import FASTEST_TICK_GAIN, custom_colour_unlocked, overclock_unlocked, unlocked_colours

if TYPE_CHECKING:
    from ninja_game.play.app import App

PAGES = ("Picture", "Sound", "Play", "Keyboard", "Gamepad")
SWITCH = [("off", False), ("on", True)]
RATES = [("match display", 0), ("30", 30), ("60", 60), ("120", 120), ("144", 144), ("240", 240)]
COLOUR_NAMES = ("default", "pink", "olive", "teal", "mauve", "maroon", "white", "gold", "slate", "silver")
PRACTICE_HINT = "No clock; quick save, rewind, slow motion; no records"
LEFT, TOP, STEP, HEIGHT_OF_ROW = 216, 72, 42, 32
WIDTH_OF_ROW = WIDTH - 36 - LEFT - 12


class SettingsScreen(MenuScreen):
    """Pages at the left, the widgets of the chosen one at the right."""

    title = "Settings"

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.page = PAGES[0]
        self.tables: dict[str, BindingTable] = {}
        self.tabs = ListView((40, TOP - 4, 158, 40 * len(PAGES)), 40, self._draw_tab, self._go_in, selected=self._show)
        self.tabs.hint = "Up and down choose a page, Right goes to it, Esc leaves the settings"
        self.tabs.fill(PAGES)

    def build(self) -> Sequence[Widget]:
        """The pages, and the present page's widgets."""
        return [self.tabs, *self._page_widgets()]

    def _show(self, index: int) -> None:
        """Show the page that is selected."""
        if self.page != PAGES[index]:
            self.page = PAGES[index]
            self.enter()
            self.redraw = True

    def _go_in(self, _index: int) -> None:
        """To the first widget of the page."""
        self.focus_on(next(widget for widget in self.widgets[1:] if widget.focusable))

    def back(self) -> None:
        """One step: from a page to the list of pages, from there out."""
        if self.focus is self.tabs:
            super().back()
        else:
            self.focus_on(self.tabs)

    def _page_widgets(self) -> list[Widget]:
        if self.page in ("Keyboard", "Gamepad"):
            return binding_widgets(self, "keys" if self.page == "Keyboard" else "pad")
        return {"Picture": self._picture, "Sound": self._sound, "Play": self._play}[self.page]()

    # --- changing ---

    def change(self, **values: object) -> None:
        """Take, save and show other values."""
        self.app.change_settings(**values)

    def _area(self, place: int) -> tuple[float, float, float, float]:
        return LEFT, TOP + STEP * place, WIDTH_OF_ROW, HEIGHT_OF_ROW

    def _choice(
        self, place: int, text: str, name: str, options: Sequence[tuple[str, object]], hint: str = ""
    ) -> Choice:
        return Choice(
            self._area(place), text, options, lambda: getattr(self.player.settings, name),
            lambda value: self.change(**{name: value}), hint=hint,
        )  # fmt: skip

    def _picture(self) -> list[Widget]:
        columns, present = self.player.columns_complete, self.player.columns_present
        count = len(NINJA_COLOURS) if custom_colour_unlocked(columns, present) else 1 + unlocked_colours(columns)
        palettes = [(name, name) for name in PALETTES]
        colours = list(zip(COLOUR_NAMES, NINJA_COLOURS, strict=True))[:count]
        more = "Complete columns of episodes for more" if count < len(NINJA_COLOURS) else ""
        return [
            self._choice(0, "Palette", "palette", palettes, "contrast and safe mark danger by shape too"),
            self._choice(1, "Ninja colour", "ninja_colour", colours, more),
            self._choice(2, "Full screen", "fullscreen", SWITCH, "F11 at any time"),
            self._choice(3, "Smooth motion", "smooth", SWITCH, "Draw between the 40 ticks of a second"),
            self._choice(4, "Frame rate", "frame_limit", RATES),
            self._choice(5, "Reduced motion", "reduced_motion", SWITCH, "Fewer particles; nothing plays behind menus"),
            self._choice(6, "Reduced gore", "reduced_gore", SWITCH, "No blood"),
            self._choice(7, "Ghost of your best run", "show_ghost", SWITCH),
            self._choice(8, "Show keys in play", "show_keys", SWITCH),
            self._choice(9, "Show frame time", "show_frame_time", SWITCH),
        ]

    def _sound(self) -> list[Widget]:
        def slider(place: int, text: str, name: str, hint: str) -> Slider:
            return Slider(
                self._area(place), text, (0, 99, 3), lambda: getattr(self.player.settings, name),
                lambda value: self._set_volume(name, value), hint=hint,
            )  # fmt: skip

        return [
            slider(0, "Volume", "volume", "0 is silence"),
            slider(1, "Ambient loops", "loop_volume", "Skids, slides, rockets, lasers: share of the volume"),
        ]

    def _set_volume(self, name: str, value: float) -> None:
        self.change(**{name: round(value)})
        self.chime("gold" if name == "volume" else "menu-move")

    def _play(self) -> list[Widget]:
        widgets: list[Widget] = [
            self._choice(0, "Practice mode", "practice", SWITCH, PRACTICE_HINT),
            Label((LEFT, TOP + STEP + 10, 200, 14), "Your name, in replays:"),
            TextEntry((LEFT + 220, TOP + STEP, WIDTH_OF_ROW - 220, HEIGHT_OF_ROW), "nameless",
                      self.player.settings.name, lambda text: self.change(name=text)),
        ]  # fmt: skip
        if overclock_unlocked(self.player.columns_complete, self.player.columns_present):
            widgets.append(
                Slider(self._area(2), "Overclock, ms", (0, FASTEST_TICK_GAIN, 1), lambda: self.app.overclock,
                       lambda value: setattr(self.app, "overclock", round(value)),
                       hint="Shorter ticks, until the game ends; scores count as ever")
            )  # fmt: skip
        text = f"Your levels: {self.player.folder / 'levels'}"
        return [*widgets, Label((LEFT, TOP + STEP * 10 + 16, 500, 12), text, size=9.5, faint=True)]

    # --- picture ---

    def draw_frame(self, surface: pygame.Surface) -> None:
        """The frame, a line between pages and widgets."""
        super().draw_frame(surface)
        canvas, palette = self.app.canvas, self.app.theme.palette
        canvas.fill_rect(surface, palette.panel_edge, 204, 64, 1, 490)

    def _draw_tab(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        x, y, w, h = area
        theme.row(surface, (x + 4, y + 4, w, h - 8), chosen=index == self.tabs.index, focused=focused)
        theme.text(surface, PAGES[index], x + 4 + w / 2, y + h / 2 - 6, size=12, align="centre", bold=focused)
