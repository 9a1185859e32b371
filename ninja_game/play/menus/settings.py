"""The settings: pages of choices, and the tables of keys and buttons."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from itertools import count

import pygame

from ninja_game.files.user_folder import LEVELS, short_path
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN
from ninja_game.play.app import App, Screen
from ninja_game.play.menus.menu_screen import CANCEL, Menu, MenuRow
from ninja_game.play.menus.thumbnails import ThumbnailScreen
from ninja_game.player.progress import FASTEST_TICK_GAIN, custom_colour_unlocked, overclock_unlocked, unlocked_colours
from ninja_game.player.settings import BY_COLUMN, GHOSTS, SPECS
from ninja_game.ui.canvas import WIDTH
from ninja_game.ui.input.bindings import ACTIONS, MENU_KEYS, MENU_PAD, InputEvent, bindable
from ninja_game.ui.input.gamepad import pad_label
from ninja_game.ui.input.keys import key_label
from ninja_game.ui.list_view import ListView
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import NINJA_COLOURS, PALETTES, TEXT_SIZES, Area, Theme
from ninja_game.ui.widgets import TEXT, Button, Choice, Label, Slider, Widget


def clash(first: str, second: str) -> bool:
    """Whether two actions must not share an input: both are read on one screen, and share none by default."""
    a, b = ACTIONS[first], ACTIONS[second]
    if first == second or {a.where, b.where} == {"level", "replay"}:
        return False
    return not (set(a.keys) & set(b.keys) or set(a.pad) & set(b.pad))


def input_label(device: str, name: str) -> str:
    return key_label(name) if device == "keys" else pad_label(name)


class Capture(Screen):
    """Waits for one press, which becomes the input. Esc cancels."""

    see_through = True

    def __init__(self, table: BindingTable, action: str, slot: int) -> None:
        super().__init__(table.screen.app)
        self.table = table
        self.action = action
        self.slot = slot

    def capture(self, event: InputEvent) -> bool:
        if event.raw.type == pygame.MOUSEBUTTONDOWN:
            self.app.pop()
            return True
        if event.source is None:
            return False
        device, name = event.source
        if device == "keys" and name == "escape":
            self.app.pop()
        elif device == self.table.device:
            self.app.pop()
            self.table.taken(self.action, self.slot, name)
        return True

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        if not self.redraw:
            return []
        theme = self.app.theme
        theme.window(surface, 206, 240, 380, 110)
        what = "key" if self.table.device == "keys" else "button, or move a stick,"
        theme.text(surface, ACTIONS[self.action].label, 396, 262, size=16, align="centre", bold=True)
        theme.text(surface, f"Press a {what} now", 396, 292, size=12, align="centre")
        theme.text(surface, "Esc cancels", 396, 318, size=10, colour=theme.palette.faint, align="centre")
        return None


SLOTS = {"keys": 6, "pad": 5}
ROW = 30
LIST: Area = (216, 72, 540, 13 * ROW)
LABEL_SHARE = 0.34


def binding_widgets(screen: SettingsScreen, device: str) -> list[Widget]:
    actions = [name for name in ACTIONS if device == "keys" or ACTIONS[name].pad or name in ("quit", "skip", "boss")]
    # The same table after a press, so that the selection stays.
    table = screen.tables.setdefault(device, BindingTable(screen, device, actions))
    widgets: list[Widget] = [
        table,
        Button((216, 478, 260, 30), "Reset to defaults", lambda: screen.change(**{device: {}})),
    ]
    if device == "pad":
        pads = screen.app.controls.pads.count
        zone = Slider(
            (216, 514, 540, 30),
            "Dead zone of sticks",
            SPECS["dead_zone"].span,
            lambda: screen.player.settings.dead_zone,
            lambda value: screen.change(dead_zone=round(value, 2)),
            show="{:.0%}".format,
            hint=f"{pads or 'No'} gamepads are plugged in" if pads != 1 else "One gamepad is plugged in",
        )
        widgets.append(zone)
    return widgets


class BindingTable(ListView):
    """A row per action, a cell per input. Left and right choose the cell, Enter waits for a press, Delete clears."""

    def __init__(self, screen: SettingsScreen, device: str, actions: list[str]) -> None:
        super().__init__(LIST, ROW, self._draw_action, self._capture)
        self.screen = screen
        self.device = device
        self.actions = actions
        self.slots = SLOTS[device]
        self.slot = 0
        self.hint = "Left and right to choose a slot, Enter to set it, Delete to clear it"
        self.fill(actions)

    def inputs(self, action: str) -> tuple[str, ...]:
        return tuple(getattr(self.screen.player.settings, self.device).get(action, self._default(action)))

    def _default(self, action: str) -> tuple[str, ...]:
        return ACTIONS[action].keys if self.device == "keys" else ACTIONS[action].pad

    def bind(self, action: str, inputs: tuple[str, ...]) -> None:
        """Give an action other inputs; default ones are not stored."""
        changed = {**getattr(self.screen.player.settings, self.device), action: inputs}
        if inputs == self._default(action):
            del changed[action]
        self.screen.change(**{self.device: changed})

    def nudge(self, action: str) -> bool:
        if action in ("left", "right"):
            slot = self.slot + (1 if action == "right" else -1)
            if not 0 <= slot < self.slots:
                return False
            self.slot = slot
            return True
        if action == "delete":
            name = self.actions[self.index]
            inputs = self.inputs(name)
            self.bind(name, inputs[: self.slot] + inputs[self.slot + 1 :])
            return True
        return super().nudge(action)

    def click(self, x: float, y: float) -> bool:
        left, width = self._cells()
        if x < left:  # the row's name, which waits for no press
            return self.hover(x, y)
        if x < left + self.slots * width:
            self.slot = int((x - left) // width)
        return super().click(x, y)

    def _cells(self) -> tuple[float, float]:
        x, _, w, _ = self.area
        return x + w * LABEL_SHARE, (w * (1 - LABEL_SHARE) - 12) / self.slots

    def _capture(self, index: int) -> None:
        self.screen.app.push(Capture(self, self.actions[index], self.slot))

    def taken(self, action: str, slot: int, name: str) -> None:
        """Use a pressed input for an action; if other actions have it, the player chooses.

        Cancel comes first, against hasty keys.
        """
        if not bindable(action, name, MENU_KEYS if self.device == "keys" else MENU_PAD):
            self.screen.app.notify(f"{input_label(self.device, name)} works the menus: choose another one")
            return
        others = [other for other in ACTIONS if name in self.inputs(other) and clash(action, other)]
        share = partial(self.put, action, slot, name)

        def take() -> None:
            for other in others:
                self.bind(other, tuple(input_ for input_ in self.inputs(other) if input_ != name))
            share()

        if not others:
            share()
            return
        labels = " and ".join(ACTIONS[other].label for other in others)
        rows: list[MenuRow] = [CANCEL, (f"Only {ACTIONS[action].label}", take, ""), ("Use it for both", share, "")]
        self.screen.app.push(Menu(self.screen.app, f"{input_label(self.device, name)} already means {labels}", rows))

    def put(self, action: str, slot: int, name: str) -> None:
        """Put an input in its place; one that is twice in a row is kept once."""
        inputs = [input_ for input_ in self.inputs(action) if input_ != name]
        inputs[slot : slot + 1] = [name]
        self.bind(action, tuple(inputs[: self.slots]))

    def _draw_action(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        _, y, _, h = area
        action = self.actions[index]
        top = y + (h - TEXT) / 2
        left, width = self._cells()
        theme.text(surface, ACTIONS[action].label, area[0] + 2, top, size=TEXT, bold=focused, width=left - area[0] - 8)
        inputs = self.inputs(action)
        for slot in range(self.slots):
            x = left + slot * width
            here = focused and slot == self.slot
            if slot > len(inputs) - 1 + focused and not here:
                continue
            theme.row(surface, (x + 2, y + 2, width - 4, h - 4), chosen=here, focused=here, radius=3)
            if slot < len(inputs):
                text = input_label(self.device, inputs[slot])
                theme.text(surface, text, x + width / 2, top + 0.5, size=10, align="centre", width=width - 10)


SWITCH = [("off", False), ("on", True)]
RACED = [("your best run", "best"), ("your next medal", "next"), *((f"{medal} medal", medal) for medal in GHOSTS[2:])]
RATES = [("same as display", 0), ("30", 30), ("60", 60), ("120", 120), ("144", 144), ("240", 240)]
COLOUR_NAMES = ("default", "pink", "olive", "teal", "mauve", "maroon", "white", "gold", "slate", "silver")
PRACTICE_HINT = "No clock and no records, but you can save, rewind and slow down"
LEFT, TOP, STEP, HEIGHT_OF_ROW = 216, 72, 42, 32
WIDTH_OF_ROW = WIDTH - 36 - LEFT - 12


class SettingsScreen(ThumbnailScreen):
    title = "Settings"
    music = ""

    def __init__(self, app: App) -> None:
        super().__init__(app)
        self.pages: dict[str, Callable[[], list[Widget]]] = {
            "Picture": self._picture, "Sound": self._sound, "Play": self._play, "Accessibility": self._accessibility,
            "Keyboard": partial(binding_widgets, self, "keys"), "Gamepad": partial(binding_widgets, self, "pad"),
        }  # fmt: skip
        self.titles = list(self.pages)
        self.page = self.titles[0]
        self.tables: dict[str, BindingTable] = {}
        self.tabs = ListView(
            (40, TOP - 4, 158, 40 * len(self.titles)), 40, self._draw_tab, self._go_in, selected=self._show
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

    def change(self, **values: object) -> None:
        self.app.change_settings(**values)

    def _area(self) -> Area:
        """The area of the next row of the page."""
        return LEFT, TOP + STEP * next(self._rows), WIDTH_OF_ROW, HEIGHT_OF_ROW

    def _choice(
        self, text: str, name: str, options: Sequence[tuple[str, object]] = SWITCH, hint: str = ""
    ) -> Choice[object]:
        return Choice(
            self._area(),
            text,
            options,
            lambda: getattr(self.player.settings, name),
            lambda value: self.change(**{name: value}),
            hint=hint,
        )

    def _slider(self, text: str, name: str, hint: str = "") -> Slider:
        """A slider for a number; volumes, stored as 0 to 99, are heard at once."""
        volume = name.endswith("volume")

        def put(value: float) -> None:
            self.change(**{name: round(value)})
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
        known = len(NINJA_COLOURS) if custom_colour_unlocked(columns, present) else 1 + unlocked_colours(columns)
        named = [(name.replace("-", " ").title(), name) for name in PALETTES]
        palettes = [("By column (default)", BY_COLUMN), *named]
        colours = list(zip(COLOUR_NAMES, NINJA_COLOURS, strict=True))[:known]
        looks = "Classic is plain grey. Contrast and Safe mark everything deadly with spikes"
        more = "Finish a whole column of episodes for more" if known < len(NINJA_COLOURS) else ""
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

    def _play(self) -> list[Widget]:
        widgets: list[Widget] = [
            self._choice("Practice mode", "practice", hint=PRACTICE_HINT),
            *self._name_row(),
            self._choice("Hints in levels", "level_texts", hint="Shown until you pass the level"),
            self._choice("Race against", "ghost", RACED, f"A ghost; {self.app.controls.name('ghost')} hides it"),
            self._choice("Show keys in play", "show_keys"),
        ]
        if overclock_unlocked(self.player.columns_complete, self.player.columns_present):
            widgets.append(
                Slider(
                    self._area(),
                    "Overclock, ms",
                    (0, FASTEST_TICK_GAIN, 1),
                    lambda: self.app.overclock,
                    lambda value: setattr(self.app, "overclock", round(value)),
                    hint="Speeds the game up until you quit",
                )
            )
        folder = short_path(self.player.folder / LEVELS)
        texts = ("Put level files into this folder, and they appear under Levels:", folder)
        below = TOP + STEP * 9
        return [*widgets, *(Label((LEFT, below + 20 * k, WIDTH_OF_ROW, 14), text) for k, text in enumerate(texts))]

    def _name_row(self) -> list[Widget]:
        x, y, w, h = self._area()
        name, put = self.player.settings.name, lambda text: self.change(name=text)
        entry = TextEntry((x + 220, y, w - 220, h), "unnamed", name, put)
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

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        canvas, palette = self.app.canvas, self.app.theme.palette
        canvas.fill_rect(surface, palette.panel_edge, 204, 64, 1, 490)
        if self.page == "Picture":
            # A preview of the palette: the first level of each column.
            episodes = self.player.catalogue.episodes
            firsts = [episodes[episode].levels[0] for episode in sorted(episodes) if episode % EPISODES_PER_COLUMN == 0]
            for place, entry in enumerate(firsts[:5]):
                if self.thumbnails.get(entry, 100) is None:
                    self.thumbnails.work()
                self.thumbnails.draw(surface, entry, LEFT + 106 * place, TOP + STEP * 8 + 20, 100)

    def _draw_tab(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        x, y, w, h = area
        theme.row(surface, (x + 4, y + 4, w, h - 8), chosen=index == self.tabs.index, focused=focused)
        theme.text(surface, self.titles[index], x + 4 + w / 2, y + h / 2 - 6, size=12, align="centre", bold=focused)
