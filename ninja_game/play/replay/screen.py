"""The replay viewer: play, pause, seek, speed, single ticks, the pressed keys, ghosts, export."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import pygame

from ninja_game.budget import TURN_WORK, affordable_ticks, tick_cost
from ninja_game.formats.links import replay_link
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import Mood
from ninja_game.play.app import App, Screen
from ninja_game.play.clipboard import copy_link
from ninja_game.play.replay.playback import Playback, RunClock, draw_names, ghosts_of
from ninja_game.sim.rules import TICK_MS, TICKS_PER_SECOND
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.theme import Theme, mixed
from ninja_game.view.hud import Hud
from ninja_game.view.level_view import LevelView
from ninja_game.view.overlays import Overlays

if TYPE_CHECKING:
    from ninja_game.play.replay.film import FilmJob

SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0)
NORMAL_SPEED = SPEEDS.index(1.0)
SHOWN_AFTER_END = 130  # ticks shown after the end (game.md §2)
MAX_GHOSTS = 8
_WARM = 12  # ticks played with animations before the sought one, so that it looks as if played
_STILL_MS = 500  # ms before a replay starts (20 of the classic game's video frames)


class ReplayScreen(Screen):
    """Shows a recording; others on the same level are ghosts. Raises LevelError for one that cannot be played.

    ``end``: the tick of the exit contact or death, or the last one of the recording; ``outcome``: at the end.
    ``length``: ticks to show. ``editable``: the TAS editor may be opened from here, if the app has one.

    A picture simulates at most a turn's work: the end of a long run is searched during playback, and until it is found
    ``end`` is the last tick of the recording; seeking far ahead takes several turns.
    """

    foot_height = 26.0  #: height of the bar, logical px

    def __init__(
        self, app: App, runs: Sequence[Recording], colours: Sequence[int] = (), *, editable: bool = True
    ) -> None:
        super().__init__(app)
        self.tas_editor = app.tas_editor if editable else None
        self.runs = runs
        self._colours = colours if len(colours) == len(runs) else range(len(runs))
        self.clock = RunClock()
        self.overlays = Overlays()
        self.bar = ReplayBar()
        self.speed = NORMAL_SPEED
        self.show(0)

    @property
    def mood(self) -> Mood:
        return super().mood if self._mood is None else self._mood

    def show(self, index: int) -> None:
        self.index = index % len(self.runs)
        self.run = run = self.runs[self.index]
        self._mood = self.app.player.catalogue.mood_of(run.level)
        self.app.follow_mood(self.mood)
        inputs = run.inputs[: affordable_ticks(run.level)]
        if len(inputs) < len(run.inputs):
            self.app.notify(f"This run costs too much work: it is shown up to tick {len(inputs):,}")
        self._turn = self._left = max(1, TURN_WORK // tick_cost(run.level))
        self._way: tuple[int, int] | None = None
        self.playback = Playback(Simulation(run.level, body=run.body), inputs)
        self._scout: Playback | None = self.playback
        self.end = len(inputs)
        self.outcome = "running"
        self.length = len(inputs) + SHOWN_AFTER_END
        self._look_ahead(self._turn)
        if self._scout:
            self._scout = self.playback.beside()
        self.playback.seek(0)
        self.view = LevelView(self.app, self.playback.simulation)
        self.view.overlays = self.overlays
        both = zip(self.runs, self._colours, strict=True)
        others = [other for other in both if other[0] is not run and other[0].level == run.level][:MAX_GHOSTS]
        self._beside, self._shades = tuple(other for other, _ in others), tuple(colour for _, colour in others)
        self.view.ghosts = self.ghosts = ghosts_of(self._beside, self._shades, alone=False)
        self.paused = False
        self.still_ms = _STILL_MS
        self.export: FilmJob | None = None
        self.redraw = True

    def enter(self) -> None:
        self.clock.reset()
        pygame.key.stop_text_input()

    def leave(self) -> None:
        """End looped sounds, and cancel a film that is being made."""
        self.app.audio_output.quiet()
        if self.export:
            self.export.cancel()

    @property
    def tick(self) -> int:
        return self.playback.simulation.tick

    @property
    def is_settled(self) -> bool:
        """Whether the end of the run is known, and all runs have reached the sought moment."""
        return self._scout is None and self._way is None and not any(ghost.behind for ghost in self.ghosts)

    # --- moving in time ---

    def _look_ahead(self, ticks: int) -> None:
        end = self._scout.find_end(ticks) if self._scout else None
        if self._scout and end is not None:
            self.end = end
            self.outcome = self._scout.simulation.outcome
            self.length = end + SHOWN_AFTER_END
            self._scout = None
            self.redraw = True

    def seek(self, tick: int) -> None:
        """Show the moment after this many ticks, exactly; the corpse and particles are those of the last moments.

        A moment beyond a turn's work is reached in the next turns.
        """
        tick = min(max(0, tick), self.length)
        start = max(0, tick - _WARM)
        if self.outcome == "dead" and start > self.end:
            # The ragdoll depends on its whole fall: simulate it again.
            start = self.end
        self._way = start, tick
        self._go_on()

    def _go_on(self) -> None:
        if self._way is None or not self._left:
            return
        start, tick = self._way
        if start >= 0:
            self._left = self.playback.seek(start, self._left)
            self.view.on_seek()
            # The rest is played with animations, only forward.
            self._way = -1 if self.tick == start else start, tick
        self.view.audible = False
        try:
            while self._way[0] < 0 and self.tick < tick and self._left:
                self.playback.step()
                self.view.on_tick()
                self._left = max(0, self._left - 1 - len(self.ghosts))
        finally:
            self.view.audible = True
        if self.tick == tick:
            self._way = None
        self._gather_ghosts()
        self.clock.reset()
        self.redraw = True

    def _play_tick(self) -> None:
        self.playback.step()
        self.view.on_tick()
        if self.tick >= self.length:
            self.seek(0)
            self.still_ms = _STILL_MS
            self.app.audio_output.quiet()

    def update(self, real_ms: int) -> None:
        if self.export and self.export.done:
            self.app.notify(self.export.result)
            self.export = None
        if self._way:
            self._go_on()
        else:
            if not self._gather_ghosts():
                self._play(real_ms)
            self._look_ahead(max(1, self._left))
        self._left = self._turn

    def _gather_ghosts(self) -> bool:
        """Let ghosts catch up after a seek; whether any had to."""
        late = [ghost for ghost in self.ghosts if ghost.behind]
        for ghost in late:
            self._left -= ghost.catch_up(self._left)
            self.redraw = True
        return bool(late)

    def _play(self, real_ms: int) -> None:
        if self.paused or self.bar.dragging:
            return
        if self.still_ms > 0:
            self.still_ms -= real_ms
            self.clock.reset()
            return
        tick_ms = max(1, round(TICK_MS / SPEEDS[self.speed]))
        runs = 1 + len(self.ghosts)
        due = min(self.clock.ticks_due(real_ms, tick_ms), max(1, self._left // runs))
        for _ in range(due):
            if not self._way:
                self._play_tick()
        self._left = max(0, self._left - due * runs)

    # --- keys and mouse ---

    def handle(self, event: InputEvent) -> None:
        target = self.bar.handle(event.raw, self.app.canvas, self.length)
        if target is not None:
            self.seek(target)
        if event.menu in {"first", "last"}:
            self.seek(0 if event.menu == "first" else self.end)
            return
        right = event.raw.type == pygame.MOUSEBUTTONDOWN and event.raw.button == pygame.BUTTON_RIGHT
        for action in ("back",) if right else event.pressed:
            if self._act(action):
                break

    def _act(self, action: str) -> bool:
        deed = {
            "confirm": self.toggle_pause, "pause": self.toggle_pause,
            "left": lambda: self.seek(self.tick - TICKS_PER_SECOND),
            "right": lambda: self.seek(self.tick + TICKS_PER_SECOND),
            "frame_back": lambda: self.step(-1), "frame_forward": lambda: self.step(1),
            "faster": lambda: self._change_speed(1), "slower": lambda: self._change_speed(-1),
            "retry": lambda: self.show(self.index), "jump": lambda: self.show(self.index + 1),
            "export": self.start_export, "link": self.copy_link, "edit": self.edit,
            "ghost": lambda: self.app.change_settings(show_ghost=not self.app.settings.show_ghost),
            "back": self.app.pop, "quit": self.app.pop,
        }.get(action)  # fmt: skip
        if deed is not None:
            deed()
        elif self.overlays.toggle(action):
            self.redraw = True
        return deed is not None

    def toggle_pause(self) -> None:
        self.paused = not self.paused
        self.still_ms = 0
        self.clock.reset()
        self.app.audio_output.quiet()
        self.redraw = True

    def step(self, ticks: int) -> None:
        self.paused = True
        self.app.audio_output.quiet()
        self.seek(self.tick + ticks)

    def _change_speed(self, by: int) -> None:
        self.speed = min(len(SPEEDS) - 1, max(0, self.speed + by))
        self.clock.reset()
        self.redraw = True

    def start_export(self) -> None:
        if self.export is None:
            from ninja_game.play.replay.film import Film, FilmJob  # few replays are filmed

            settings = self.app.settings.changed(palette=self.theme.palette.base.name)
            ghosts, colours = (self._beside, self._shades) if settings.show_ghost else ((), ())
            film = Film(self.run, settings=settings, ghosts=ghosts, colours=colours)
            self.export = FilmJob(film, self.app.player.folder)

    def copy_link(self) -> None:
        copy_link(self.app, lambda: replay_link([_with_claims(self.run)]), title=self.run.title)

    def edit(self) -> None:
        """Open the TAS editor on this run, at this tick, with the other runs."""
        if self.tas_editor:
            self.tas_editor(
                self.app, self.run, [run for run in self.runs if run is not self.run], max(0, self.tick - 1)
            )

    # --- picture ---

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        still = self.paused or self.bar.dragging or self.still_ms > 0
        fraction = 1.0 if still else self.clock.fraction
        changed = self.view.draw(surface, fraction, whole=self.redraw)
        theme, bar = self.app.theme, self.bar
        hud = Hud(theme)
        written = [
            bar.draw(surface, theme, self.tick, self.end, self.length, self.outcome),
            bar.write(surface, theme, self.tick, self.end, f"x {SPEEDS[self.speed]:g}", still=still),
            *hud.head(surface, self.run.title, self._hint()),
            hud.keys(surface, self.playback.keys_at(self.tick - 1), 444),
            *(draw_names(surface, theme, self.ghosts, fraction) if self.app.settings.show_ghost else ()),
        ]
        for rect in written:
            self.view.also_covered(rect)
        return None if changed is None else changed + written

    def _hint(self) -> str:
        if self.export:
            return f"Making a film: {self.export.percent}%"
        if self._way:
            return f"Going to tick {self._way[1]:,}: {100 * self.tick // max(1, self._way[1])}%"
        if not self.paused:
            return ""
        key = self.app.controls.name
        return (
            f"{key('frame_back')} {key('frame_forward')}: tick by tick    {key('left')} {key('right')}: a second    "
            f"{key('slower')} {key('faster')}: speed    {key('export')}: film    "
            + (f"{key('edit')}: edit    " if self.tas_editor else "")
            + f"{key('link')}: link    {key('back')}: leave"
        )


def _with_claims(run: Recording) -> Replay:
    """A run to share: with its result, where it was only played or comes from N."""
    if not run.replay.unclaimed:
        return replace(run.replay, level=run.level)
    # It imports modules that play does not need.
    from ninja_game.runs.conversion import recorded_again

    return recorded_again(run)


_LEFT, _WIDTH, _Y = 24.0, 400.0, 588.0


class ReplayBar:
    """The bar below a replay: a press or a drag seeks. ``dragging``: a drag is going on."""

    def __init__(self) -> None:
        self.dragging = False

    def handle(self, event: pygame.Event, canvas: Canvas, length: int) -> int | None:
        if event.type == pygame.MOUSEBUTTONUP:
            self.dragging = False
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
            x, y = canvas.logical(event.pos)
            self.dragging = abs(y - _Y) < 9 and _LEFT - 6 < x < _LEFT + _WIDTH + 6
        elif event.type != pygame.MOUSEMOTION:
            return None
        if not self.dragging:
            return None
        share = (canvas.logical(event.pos)[0] - _LEFT) / _WIDTH
        return round(min(1.0, max(0.0, share)) * length)

    @staticmethod
    def draw(surface: pygame.Surface, theme: Theme, tick: int, end: int, length: int, outcome: str) -> pygame.Rect:
        palette, canvas = theme.palette, theme.canvas
        trough = mixed(palette.tile, palette.outline, 0.35)
        rect = canvas.fill_rect(surface, trough, _LEFT, _Y - 2, _WIDTH, 4, 2)
        filled_to = _LEFT + _WIDTH * min(1.0, tick / max(1, length))
        canvas.fill_rect(surface, palette.on_tile, _LEFT, _Y - 2, filled_to - _LEFT, 4, 2)
        mark = _LEFT + _WIDTH * end / max(1, length)
        colour = {"exit": palette.bar_full, "dead": palette.bar_empty}.get(outcome, palette.accent)
        canvas.fill_rect(surface, colour, mark - 1, _Y - 5, 2, 10)
        knob = canvas.circle(surface, palette.on_tile, (filled_to, _Y), 5)
        return rect.union(knob).inflate(canvas.px(10), canvas.px(10))

    @staticmethod
    def write(surface: pygame.Surface, theme: Theme, tick: int, end: int, speed: str, *, still: bool) -> pygame.Rect:
        at = min(tick, end)
        text = f"{seconds_text(at)} / {seconds_text(end)} s    {speed}" + (f"    tick {at}" if still else "")
        return theme.text(surface, text, 768, 583, size=9, colour=theme.palette.on_tile, align="right")
