"""A figure of the lab in the text of a page, for figures.js: no screen, no player, no records."""

from __future__ import annotations

import json
from typing import Any

from pygame import display
from pygame.host import LINK  # type: ignore[import-not-found]

from ninja_game.play.lab.figure import FIGURE_AREA
from ninja_game.play.lab.screen import FigurePicture
from ninja_game.play.replay.playback import RunClock
from ninja_game.ui.widgets import Choice, Slider


class PageFigure:
    """A figure ``width`` px wide. ``page``: the host that paints, as host.js; ``area``: of the figure."""

    def __init__(self, page: Any, name: str, width: int, palette: str) -> None:
        LINK.page = page
        self._picture = FigurePicture(name, width / FIGURE_AREA[2], palette)
        self.figure = self._picture.figure
        self.area = tuple(self._picture.area)
        self._clock = RunClock()
        self._tick = -1
        widgets = [make((0, 0, 1, 1)) for make in self.figure.controls()]
        self.controls = [widget for widget in widgets if isinstance(widget, (Choice, Slider))]

    @property
    def sheet(self) -> int:
        """The number of the canvas that ``turn`` paints on."""
        return int(self._picture.surface.settle())  # type: ignore[attr-defined] # the page's own surface

    def about(self) -> str:
        """Title and controls, as JSON."""
        controls = [
            {"text": control.text, "span": [control.low, control.high, control.step]}
            if isinstance(control, Slider)
            else {"text": control.text, "options": [text for text, _ in control.options]}
            for control in self.controls
        ]
        return json.dumps({"title": self.figure.title, "controls": controls})

    def turn(self, real_ms: float) -> str:
        """Let time pass and paint; the numbers, and the texts and values of the controls, as JSON."""
        for _ in range(min(4, self._clock.ticks_due(round(real_ms)))):
            if self._tick >= 0:
                self.figure.demonstrate(self._tick)
                self._tick += 1
            self.figure.tick()
        self._picture.draw()
        display.flip()
        values = [
            (control.get(), control.show(control.get())) if isinstance(control, Slider) else (control.index, "")
            for control in self.controls
        ]
        return json.dumps({"numbers": self.figure.numbers(), "values": values})

    def set(self, control: int, value: float) -> None:
        """Change a control: a slider to a number, a choice to one of its options."""
        self._tick = -1
        widget = self.controls[control]
        widget.put(value if isinstance(widget, Slider) else widget.options[int(value)][1])

    def touch(self, what: str, x: float, y: float) -> None:
        """``press`` or ``drag`` at a place, shares of the figure's width and height; ``nudge`` by -1, 0 or 1."""
        self._tick = -1
        if what == "nudge":
            self.figure.nudge(int(x), int(y))
            return
        left, top, zoom = self.figure.view
        act = self.figure.press if what == "press" else self.figure.drag
        act(left + x * FIGURE_AREA[2] / zoom, top + y * FIGURE_AREA[3] / zoom)

    def reset(self, *, demonstrate: bool) -> None:
        """Reset the figure; its demonstration runs if that is wanted."""
        self.figure.reset()
        self._tick = 0 if demonstrate else -1
