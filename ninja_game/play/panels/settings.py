"""The settings: pages of choices."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from itertools import count

import pygame

from ninja_game.files.user_folder import LEVELS, short_path
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN
from ninja_game.play.app import App
from ninja_game.play.panels.bindings import BindingTable
from ninja_game.play.thumbnails import ThumbnailScreen
from ninja_game.player.progress import FASTEST_TICK_GAIN, custom_colour_unlocked, overclock_unlocked, unlocked_colours
from ninja_game.player.settings import BY_COLUMN, GHOSTS, SPECS
from ninja_game.ui.canvas import WIDTH
from ninja_game.ui.list_view import ListView
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import NINJA_COLOURS, PALETTES, TEXT_SIZES, Area, Theme
from ninja_game.ui.widgets import Button, Choice, Label, Slider, Widget

_SWITCH = [("off", False), ("on", True)]
RACED = [("your best run", "best"), ("your next medal", "next"), *((f"{medal} medal", medal) for medal in GHOSTS[2:])]
RATES = [("same as display", 0), ("30", 30), ("60", 60), ("120", 120), ("144", 144), ("240", 240)]
COLOUR_NAMES = ("default", "pink", "olive", "teal", "mauve", "maroon", "white", "gold", "slate", "silver")
PRACTICE_HINT = "No clock and no records, but you can save, rewind and slow down"
_LEFT, _TOP, _STEP, _HEIGHT_OF_ROW = 216, 72, 42, 32
PALETTE_PREVIEW = _LEFT, _TOP + _STEP * 8 + 20
WIDTH_OF_ROW = WIDTH - 36 - _LEFT - 12


def setting_choice(
    app: App, area: Area, text: str, name: str, options: Sequence[tuple[str, object]] = _SWITCH, hint: str = ""
) -> Choice[object]:
    """A choice of the values of a setting."""

    def put(value: object) -> None:
        app.change_settings(**{name: value})

    return Choice(area, text, options, lambda: getattr(app.settings, name), put, hint=hint)


class SettingsScreen(ThumbnailScreen):
    """All settings, by page. A change has effect at once."""

    title = "Settings"
    music = ""

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.pages: dict[str, Callable[[], list[Widget]]] = {
            "Picture": self._picture, "Sound": self._sound, "Play": self._play, "Accessibility": self._accessibility,
            "Keyboard": partial(self._bindings, "keys"), "Gamepad": partial(self._bindings, "pad"),
        }  # fmt: skip
        self.titles = list(self.pages)
        self.page = self.titles[0]
        self.tables: dict[str, BindingTable] = {}
        self.tabs = ListView(
            (40, _TOP - 4, 158, 40 * len(self.titles)), 40, self._draw_tab, self._go_in, selected=self._show
        )
        self.tabs.hint = "Up and down to choose a page, Right to open it"
        self.tabs.fill(self.titles)

    def build(self) -> Sequence[Widget]:
        self._rows = count()
        return [self.tabs, *self.pages[self.page]()]

    def _show(self, index: int) -> None:
        if self.page != self.titles[index]:
            self.page = self.titles[index]
            self.enter()
            self.redraw = True

    def _go_in(self, _index: int) -> None:
        self.focus_on(next(widget for widget in self.widgets[1:] if widget.focusable))

    def back(self) -> None:
        """One step back: from a page to the list of pages, from there out."""
        if self.focus is self.tabs:
            super().back()
        else:
            self.focus_on(self.tabs)

    def _area(self) -> Area:
        """The area of the next row of the page."""
        return _LEFT, _TOP + _STEP * next(self._rows), WIDTH_OF_ROW, _HEIGHT_OF_ROW

    def _choice(
        self, text: str, name: str, options: Sequence[tuple[str, object]] = _SWITCH, hint: str = ""
    ) -> Choice[object]:
        return setting_choice(self.app, self._area(), text, name, options, hint)

    def _slider(self, text: str, name: str, hint: str = "") -> Slider:
        """A slider for a number; volumes, stored as 0 to 99, are heard at once."""
        volume = name.endswith("volume")

        def put(value: float) -> None:
            self.app.change_settings(**{name: round(value)})
            if volume:
                self.chime("gold-1" if name == "volume" else "menu-move")

        span = SPECS[name].span
        share = 100 / span[1]
        return Slider(
            self._area(),
            text,
            span,
            lambda: getattr(self.player.settings, name),
            put,
            show=lambda value: f"{share * value:.0f}%",
            hint=hint,
        )

    def _picture(self) -> list[Widget]:
        columns, present = self.player.columns_complete, self.player.columns_present
        unlocked = len(NINJA_COLOURS) if custom_colour_unlocked(columns, present) else 1 + unlocked_colours(columns)
        named = [(name.replace("-", " ").title(), name) for name in PALETTES]
        palettes = [("By column (default)", BY_COLUMN), *named]
        colours = list(zip(COLOUR_NAMES, NINJA_COLOURS, strict=True))[:unlocked]
        looks = "Classic is plain grey. Contrast and Safe mark everything deadly with spikes"
        more = "Finish a whole column of episodes for more" if unlocked < len(NINJA_COLOURS) else ""
        return [
            self._choice("Palette", "palette", palettes, looks),
            self._choice("Ninja colour", "ninja_colour", colours, more),
            self._choice("Full screen", "fullscreen", hint="F11 at any time"),
            self._choice("Smooth motion", "smooth", hint="Draws more than the 40 ticks a second of the game"),
            self._choice("Frame rate", "frame_limit", RATES),
            self._choice("Show frame time", "show_frame_time"),
        ]

    def _sound(self) -> list[Widget]:
        return [
            self._slider("Volume", "volume", "Everything you hear"),
            self._slider("Effects", "effects_volume", "Everything but the music"),
            self._slider("Slides, rockets, lasers", "loop_volume", "The effects that go on and on"),
            self._slider("Music", "music_volume", "A tune for each column of episodes"),
            self._choice("Music in practice", "music_in_practice"),
        ]

    def _overclock(self, gain: float) -> None:
        self.app.overclock = round(gain)

    def _play(self) -> list[Widget]:
        widgets: list[Widget] = [
            self._choice("Practice mode", "practice", hint=PRACTICE_HINT),
            *self._name_row(),
            self._choice("Hints in levels", "level_texts", hint="Shown until you pass the level"),
            self._choice("Race against", "ghost", RACED, f"A ghost; {self.app.controls.name('ghost')} hides it"),
            self._choice("Show keys in play", "show_keys"),
        ]
        if overclock_unlocked(self.player.columns_complete, self.player.columns_present):
            span = 0, FASTEST_TICK_GAIN, 1
            faster = Slider(self._area(), "Overclock, ms", span, lambda: self.app.overclock, self._overclock)
            faster.hint = "Speeds the game up until you quit"
            widgets.append(faster)
        folder = short_path(self.player.folder / LEVELS)
        texts = ("Put level files into this folder, and they appear under Levels:", folder)
        below = _TOP + _STEP * 9
        return [*widgets, *(Label((_LEFT, below + 20 * k, WIDTH_OF_ROW, 14), text) for k, text in enumerate(texts))]

    def _name_row(self) -> list[Widget]:
        x, y, w, h = self._area()
        area = x + 220, y, w - 220, h
        name = self.player.settings.name
        entry = TextEntry(area, "unnamed", name, lambda text: self.app.change_settings(name=text))
        return [Label((x, y + 10, 212, 14), "Your name in replays"), entry]

    def _accessibility(self) -> list[Widget]:
        return [
            self._choice("Text size", "text_size", list(TEXT_SIZES.items())),
            self._slider("Game speed", "game_speed", "Slower is easier, but earns no medal"),
            self._choice("Invincible", "invincible",
                         hint="Only being crushed or running out of time can stop you. Earns no medal"),
            self._choice("Running keys", "tap_to_run", [("hold", False), ("tap", True)],
                         "Tap: one press keeps you running until the next"),
            self._choice("Show warning sounds", "sound_cues", hint="Marks every rocket, laser, chase and turret"),
            self._choice("Reduced motion", "reduced_motion", hint="Fewer particles; no shakes, freezes or wipes"),
            self._choice("Reduced gore", "reduced_gore", hint="No blood"),
            self._slider("Screen shake", "shake"),
            self._slider("Particles", "particles"),
        ]  # fmt: skip

    def _bindings(self, device: str) -> list[Widget]:
        # The same table after a press, so that the selection stays.
        table = self.tables.setdefault(device, BindingTable(self.app, device))
        reset = Button((216, 478, 260, 30), "Reset to defaults", lambda: self.app.change_settings(**{device: {}}))
        if device == "keys":
            return [table, reset]
        pads = self.app.controls.pads.count
        zone = Slider(
            (216, 514, 540, 30),
            "Dead zone of sticks",
            SPECS["dead_zone"].span,
            lambda: self.player.settings.dead_zone,
            lambda value: self.app.change_settings(dead_zone=round(value, 2)),
            show="{:.0%}".format,
            hint=f"{pads or 'No'} gamepads are plugged in" if pads != 1 else "One gamepad is plugged in",
        )
        return [table, reset, zone]

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        canvas, palette = self.app.canvas, self.app.theme.palette
        canvas.fill_rect(surface, palette.panel_edge, 204, 64, 1, 490)
        if self.pages[self.page] == self._picture:
            # A preview of the palette: the first level of each column.
            episodes = self.player.catalogue.episodes
            firsts = [episodes[episode].levels[0] for episode in sorted(episodes) if episode % EPISODES_PER_COLUMN == 0]
            x, y = PALETTE_PREVIEW
            for place, entry in enumerate(firsts[:5]):
                if self.thumbnails.get(entry, 100) is None:
                    self.thumbnails.work()
                self.thumbnails.draw(surface, entry, x + 106 * place, y, 100)

    def _draw_tab(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        x, y, w, h = area
        theme.row(surface, (x + 4, y + 4, w, h - 8), chosen=index == self.tabs.index, focused=focused)
        theme.text(surface, self.titles[index], x + 4 + w / 2, y + h / 2 - 6, size=12, align="centre", bold=focused)
