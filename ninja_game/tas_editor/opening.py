"""Opens the TAS editor, behind a waiting screen if rules must be loaded or compiled first."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING

import pygame

from ninja_game.backend.kernel_cache import before_compiling
from ninja_game.backend.memories import begins_on_plain, compiled_available, has_compiled_twin
from ninja_game.budget import NO_LIMIT
from ninja_game.errors import NinjaGameError, reason
from ninja_game.formats.recording import Recording
from ninja_game.play.app import App, Screen
from ninja_game.runtime import run_in_background
from ninja_game.ui.canvas import HEIGHT, WIDTH
from ninja_game.ui.input.bindings import InputEvent

if TYPE_CHECKING:
    from ninja_game.tas_editor.screen import TasScreen

PATIENCE_MS = 1000  # longer waits are explained


def open_tas_editor(app: App, recording: Recording, others: Sequence[Recording], tick: int) -> None:
    """Open the TAS editor on a run, with others of its level beside it; a notice if that is impossible."""

    def make() -> TasScreen:
        # They import NumPy, which watching does not need.
        from ninja_game.tas.files import open_recording, same_level
        from ninja_game.tas_editor.screen import TasScreen

        opened = open_recording(recording)
        screen = TasScreen(app, opened, [other for other in others if same_level(other, recording)])
        screen.editor.go(tick)
        return screen

    if not is_prepared():
        app.push(OpeningScreen(app, recording, make))
        return
    try:
        screen = make()
    except (NinjaGameError, OSError) as error:
        app.notify(_refusal(error))
    else:
        app.push(screen)


def is_prepared() -> bool:
    from ninja_game.backend.kernels import trace_world

    return not compiled_available() or has_compiled_twin(trace_world) or begins_on_plain("auto", NO_LIMIT)


def prepare_rules(run: Recording) -> None:
    """Load or compile the rules that the TAS editor needs for a run in this process."""
    from ninja_game.simulation import Simulation
    from ninja_game.tas.timeline import Timeline

    # The TAS editor reports errors of the run.
    with suppress(NinjaGameError):
        Timeline(run.level, b"\0", body=run.body).simulate(1)
        Simulation(run.level, body=run.body, memory="auto").step_keys(0)


class OpeningScreen(Screen):
    """A waiting screen until the rules are loaded or compiled; then the result of ``make`` replaces it.

    A NinjaGameError or OSError of ``make`` is reported on the screen below, or raised if there is none.
    """

    def __init__(self, app: App, run: Recording, make: Callable[[], TasScreen]) -> None:
        super().__init__(app)
        self._name = run.name or "the run"
        self._make = make
        self._compiles = False
        self._waited_ms = 0
        self._shown = "", ""
        before_compiling.append(self._note_compiling)
        self.thread = run_in_background(lambda: prepare_rules(run), self._note_problem)

    def _note_compiling(self) -> None:
        self._compiles = True

    def _note_problem(self, why: str) -> None:
        def refuse() -> TasScreen:
            raise NinjaGameError(why)

        self._make = refuse

    @property
    def explanation(self) -> str:
        if self._waited_ms < PATIENCE_MS:
            return ""
        seconds = f"{self._waited_ms // 1000} s"
        if self._compiles:
            return f"Compiling the rules for this machine, only the first time: a minute or two ({seconds})"
        return f"Loading the rules ({seconds})"

    def capture(self, event: InputEvent) -> bool:
        """Only closing the window is possible yet."""
        return True

    def update(self, real_ms: int) -> None:
        self._waited_ms += real_ms
        if self.thread.is_alive() or not self._shown[0]:
            return
        try:
            screen = self._make()
        except (NinjaGameError, OSError) as error:
            if len(self.app.stack) == 1:
                raise
            self.app.pop()
            self.app.notify(_refusal(error))
        else:
            self.app.replace(screen)

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        text, colour = f"Opening {self._name} ...", self.theme.palette.on_tile
        if self._shown == (text, self.explanation) and not self.redraw:
            return []
        self._shown = text, self.explanation
        surface.fill(self.theme.palette.tile)
        write = partial(self.theme.text, surface, x=WIDTH / 2, colour=colour, align="centre", width=WIDTH - 80)
        write(text=text, y=HEIGHT / 2 - 30, size=18, bold=True)
        write(text=self.explanation, y=HEIGHT / 2 + 4, size=11)
        return None


def _refusal(error: Exception) -> str:
    return f"It cannot be edited: {reason(error)}"
