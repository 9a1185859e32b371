"""The program with a window: its loop, its stack of screens, settings, notices and exports."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from operator import attrgetter
from pathlib import Path

import pygame

from ninja_game.editor.solver import Solver
from ninja_game.errors import NinjaGameError, reason
from ninja_game.files.bundled import data_folder
from ninja_game.files.shown_text import shown_text
from ninja_game.files.user_folder import export_path, short_path
from ninja_game.files.writing import write_atomically
from ninja_game.formats.recording import Recording
from ninja_game.levels.episodes import Mood
from ninja_game.play.boss import BossScreen
from ninja_game.play.screen import BackgroundTask, BaseScreen, ScreenStack
from ninja_game.play.window import Window, Wipe, save_picture
from ninja_game.player.player_data import PlayerData
from ninja_game.player.progress import FASTEST_TICK_GAIN
from ninja_game.player.settings import BY_COLUMN, Settings
from ninja_game.runtime import in_page_or_not
from ninja_game.sim.rules import TICK_MS
from ninja_game.ui.audio.player import AudioOutput, AudioPlayer
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.input.bindings import Bindings, InputEvent
from ninja_game.ui.theme import PALETTES, Palette, Theme, palette_named, wrapped


class Screen(BaseScreen):
    """A screen of the program with a window; its ``app`` is an ``App``, where a BaseScreen knows only a ``Host``."""

    app: App


CALM_MOOD = Mood()  # the mood of all menus, whatever level was played before

UNSEEN = {"dummy", "offscreen"}  # SDL drivers without a visible window: no wipe, and no waiting for the next picture

FALLBACK_RATE = 60  # pictures per second where the display does not say its rate

NOTICE = 12.5  # size of the letters of a notice
_IN_BORDER = 10.0  # the same in the border below a level
NOTICE_WIDTH = 764.0  # longest line of a notice, px
NOTICE_LINES = 5  # most lines of a notice
NOTICE_MS = 4000  # how long it is shown
WARNING_MS = 12_000  # how long a warning about the start of the game is shown

SWITCH_S = 0.0005
"""The longest that a thread of Python waits for another one, s: what works in the background, as a compiler, must not
make the window slow."""

TasEditorOpener = Callable[["App", Recording, Sequence[Recording], int], object]


class App:
    """The window with its stack of screens.

    ``size``: px of the window; ``window``: a window that is open already. Raises NinjaGameError without a display.
    """

    def __init__(
        self,
        player: PlayerData,
        controls: Bindings,
        audio_output: AudioOutput,
        *,
        size: tuple[int, int] | None = None,
        tas_editor: TasEditorOpener | None = None,
        window: Window | None = None,
    ) -> None:
        self.player = player  #: its settings are changed by ``change_settings``
        self.controls = controls  #: keys to actions
        self.audio_output = audio_output
        self._apply_settings(self.settings)
        self.overclock = 0  #: ms by which ticks are shorter until the program ends, 0 to 10 (game.md §1.1)
        #: Opens a run in the TAS editor, at a tick, with others to compare; None where there is none, as in a page
        self.tas_editor = tas_editor
        self.stack = ScreenStack()
        self.solver = Solver()  #: shared by all editors; the screen of packs shows stopped searches
        self.background_tasks: list[BackgroundTask] = []
        self.running = True
        self.frame_ms = 0.0
        self.mood = Mood()
        self.notice = ""
        self.notice_refuses = False  #: whether the notice says why something was refused
        self._notice_ms = 0
        self._notice_on: BaseScreen | None = None
        self.window = window or Window(size, self.settings)
        self.wipe = Wipe()
        # In a page, several whole pictures in a row are too slow.
        self.wipes = in_page_or_not(page=False, desktop=pygame.display.get_driver() not in UNSEEN)
        pygame.font.init()
        self.lay_out()

    @property
    def settings(self) -> Settings:
        return self.player.settings

    @property
    def surface(self) -> pygame.Surface:
        return self.window.surface

    @property
    def tick_ms(self) -> int:
        return TICK_MS - min(FASTEST_TICK_GAIN, max(0, self.overclock))

    def change_settings(self, **values: object) -> None:
        """Use and save other settings, and draw again; a notice says why if they could not be saved."""
        before = self.settings
        message = self.player.change_settings(before.changed(**values))
        after = self.settings
        self._apply_settings(after)
        self.window.set_fullscreen(wanted=after.fullscreen)
        look = attrgetter("palette", "fullscreen", "text_size")
        if look(after) != look(before):
            self.lay_out()
        self.stack.redraw_all()
        if message:
            self.notify(message)

    def _apply_settings(self, settings: Settings) -> None:
        """Apply the settings to the controls and the sound."""
        self.controls.bind(settings.keys, settings.pad)
        self.controls.pads.dead_zone = settings.dead_zone
        self.controls.tap_to_run = settings.tap_to_run
        self.audio_output.set_volumes(*settings.volumes)

    def remember_author(self, before: str, author: str) -> None:
        """Remember an author's name that was typed as the player's, if none is set yet; later forms begin with it."""
        if author != before and not self.settings.name:
            self.change_settings(name=author.strip()[:40])

    def notify(self, text: str, *, ms: int = NOTICE_MS, here: bool = False, refuses: bool = False) -> None:
        """Show a text at the foot for a while; ``here``: only while the present screen is on top."""
        self.notice, self.notice_refuses = text, refuses
        self._notice_ms, self._notice_on = ms, self.top if here else None
        self.stack.redraw_all()

    @contextmanager
    def errors_as_notices(self, what: str = "") -> Iterator[None]:
        """Show a notice instead of an error of files or of the program within; ``what`` stands before its reason."""
        try:
            yield
        except (NinjaGameError, OSError) as error:
            self.notify(f"{what}{reason(error)}")

    def report_problems(self) -> None:
        """Show the problems with the player's files that have not been shown yet."""
        text = self.player.new_messages()
        if text:
            self.notify(text, ms=WARNING_MS)

    def lay_out(self) -> None:
        self.canvas = Canvas(self.surface.get_size())
        self.theme = Theme(self.palette_in(self.mood), self.canvas, self.settings.text_size)
        self.menu_theme = Theme(self.palette_in(CALM_MOOD), self.canvas, self.settings.text_size)
        self.stack.redraw_all()

    def palette_in(self, mood: Mood) -> Palette:
        return palette_named(self.settings.palette, *mood)

    def follow_mood(self, mood: Mood) -> None:
        """Use the palette of this mood."""
        self.mood = mood
        if self.palette_in(mood) is not self.theme.palette:
            self.lay_out()

    # --- the screens ---

    @property
    def top(self) -> BaseScreen:
        return self.stack.top

    def push(self, screen: BaseScreen) -> None:
        self.wipe_from(screen)
        self.stack.push(screen)

    def replace(self, screen: BaseScreen) -> None:
        self.wipe_from(screen)
        self.stack.replace(screen)

    def wipe_from(self, screen: BaseScreen) -> None:
        """Begin a wipe from the present picture to another screen or level."""
        wipes = self.wipes and screen.wipes and not screen.see_through and not self.settings.reduced_motion
        if wipes and self.stack:
            self.wipe.begin(self.surface)

    def pop(self) -> None:
        """Go back to the screen below; the lowest screen ends the program."""
        self.wipe_from(self.top)
        self.stack.pop()
        if not self.stack:
            self.running = False

    def quit(self) -> None:
        """End the program after this picture."""
        self.running = False

    # --- the loop ---

    def run(self, frames: int | None = None) -> None:
        """Run until a screen quits, or for ``frames`` pictures. Then, or on a signal, every screen is left.

        Without a real display (SDL's dummy driver) a bounded run counts pictures as time, 60 a second, and does not
        wait: its pictures are always the same.
        """
        sys.setswitchinterval(SWITCH_S)
        clock = pygame.time.Clock()
        simulated = frames is not None and pygame.display.get_driver() in UNSEEN
        last = pygame.time.get_ticks()
        count = 0
        try:
            while self.running and self.stack and (frames is None or count < frames):
                count += 1
                passed = count * 1000 // FALLBACK_RATE - (count - 1) * 1000 // FALLBACK_RATE
                now = last + passed if simulated else pygame.time.get_ticks()
                self.frame(now - last)
                last = now
                if not simulated:
                    clock.tick(self.settings.frame_limit or pygame.display.get_current_refresh_rate() or FALLBACK_RATE)
        finally:
            for task in self.background_tasks:
                task.end()
            self.stack.clear()
            if self.window.was_resized:
                self.change_settings(window_width=self.surface.width, window_height=self.surface.height)

    def frame(self, real_ms: int) -> None:
        """One turn of the loop: events, time, picture."""
        started = time.perf_counter()
        self.advance(real_ms)
        if self.running and self.stack:
            self.draw()
        self.frame_ms = 1000 * (time.perf_counter() - started)

    def advance(self, real_ms: int) -> None:
        """One turn of the loop without drawing."""
        for event in pygame.event.get():
            self._handle(event)
            if not (self.running and self.stack):
                return
        if self.wipe.update(real_ms):
            self.stack.redraw_all()
        for task in self.background_tasks:
            task.update()
        for screen in self.stack.running():
            screen.update(real_ms)
        if self.notice:
            self._notice_ms -= real_ms
            if self._notice_ms <= 0 or (self.stack and self._notice_on not in (None, self.top)):
                self.notify("")
        if self.stack:
            self.audio_output.music(self.top.music, real_ms)

    def _handle(self, raw: pygame.Event) -> None:
        """Handle events of the window; a screen that waits for a key press gets it before the app's own keys.

        Ignored: the buttons 4 and 5, which SDL sends for each notch of the wheel, and the buttons at a mouse's side.
        """
        if raw.type in {pygame.MOUSEBUTTONDOWN, pygame.MOUSEBUTTONUP} and raw.button > pygame.BUTTON_RIGHT:
            return
        if raw.type == pygame.QUIT:
            self.quit()
        elif raw.type in {pygame.VIDEORESIZE, pygame.WINDOWSIZECHANGED}:
            self.lay_out()
        elif raw.type in {pygame.WINDOWEXPOSED, pygame.WINDOWRESTORED}:
            self.stack.redraw_all()
        event = self.controls.decode(raw)
        if not self.top.capture(event) and not self._dispatch(event):
            self.top.handle(event)

    def _dispatch(self, event: InputEvent) -> bool:
        if "fullscreen" in event.pressed:
            self.change_settings(fullscreen=not self.settings.fullscreen)
        elif "screenshot" in event.pressed:
            self.keep_screenshot()
        elif "boss" in event.pressed and self.top.hides_game:
            self.pop()
        elif "boss" in event.pressed:
            self.push(BossScreen(self))
        else:
            return False
        return True

    # --- the picture ---

    def draw(self) -> None:
        self.follow_mood(self.top.mood)
        changed = self.stack.draw(self.surface)
        self.wipe.draw(self.surface, self.theme)
        if self.notice and not self.top.hides_game:
            rect = self._draw_notice(self.top.theme)
            changed = None if changed is None else [*changed, rect]
        if changed is None:
            pygame.display.flip()
        elif changed:
            pygame.display.update(changed)

    def _draw_notice(self, theme: Theme) -> pygame.Rect:
        left, right = self.top.notice_room
        most = min(NOTICE_WIDTH, right - left - 28)
        # In the border: no text covers a level.
        middle, size, margin, height = (left + right) / 2, _IN_BORDER, 1.0, 20.0
        lines = wrapped(theme, self.notice, most, size)
        if len(lines) > 1 or not (self.top.plays or self.top.small_notices):
            size, margin, height = NOTICE, 4.0, 1.5 * NOTICE * theme.scales[0]
            lines = wrapped(theme, self.notice, most, size)[:NOTICE_LINES]
        lower_edge = theme.canvas.logical((0, theme.canvas.stage.bottom))[1] - self.top.foot_height
        y = max(1.0, lower_edge - height * len(lines) - 2 * margin)
        width = min(most, max(theme.width(line, size) for line in lines)) + 28
        rect = theme.window(self.surface, middle - width / 2, y, width, height * len(lines) + 2 * margin)
        for k, line in enumerate(lines):
            top = y + margin + height * (k + 0.5) - size / 2
            theme.text(self.surface, line, middle, top, size=size, align="centre", width=most + 4)
        return rect

    def write_export(
        self,
        title: str,
        suffix: str,
        content: str | bytes | Callable[[Path], object],
        *,
        first: int = 0,
        over: Path | None = None,
    ) -> Path | None:
        """Write a file into the player's exports, and show where; its path, or None if that failed.

        ``content``: text, bytes, or a function that writes to the path. ``first``: as in ``export_path``.
        ``over``: an earlier export, which is replaced.
        """
        try:
            path = over or export_path(self.player.folder, title, suffix, first)
            if callable(content):
                content(path)
            else:
                write_atomically(path, content)
        except (OSError, NinjaGameError) as error:
            self.notify(f"Not written: {reason(error)}")
            return None
        self.notify(f"Saved: {short_path(path)}")
        return path

    def keep_screenshot(self) -> None:
        """Write the picture, without a notice, into the player's exports, and show where."""
        if self.notice:
            self.notify("")
            self.draw()
        self.write_export("screenshot", ".png", lambda path: save_picture(self.surface, path))


def build_app(
    folder: Path | None = None,
    *,
    size: tuple[int, int] | None = None,
    controls: Bindings | None = None,
    audio_output: AudioOutput | None = None,
    tas_editor: TasEditorOpener | None = None,
    window: Window | None = None,
) -> App:
    """The app with the player's settings; a notice shows what is wrong with the player's files.

    ``folder``: the player's folder, by default the usual one. ``controls``: reads keys and pads. ``audio_output``:
    instead of the sound device. ``tas_editor``, ``window``: as in ``App``.

    Raises NinjaGameError where there is no display.
    """
    player = PlayerData(folder)
    sound = audio_output or AudioPlayer(data_folder("assets") / "sounds")
    app = App(player, controls or Bindings(), sound, size=size, tas_editor=tas_editor, window=window)
    player.open_records()
    if unknown := app.controls.unknown:
        player.report(f"settings.toml: no key is called {shown_text(', '.join(unknown), 60)}.")
    palette = app.settings.palette
    if palette not in (BY_COLUMN, *PALETTES):
        player.report(f"settings.toml: there is no palette {palette}: {', '.join((BY_COLUMN, *PALETTES))}.")
    app.report_problems()
    return app
