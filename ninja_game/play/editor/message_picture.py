"""The picture of a level with the selected message as in play, where the mouse puts it and its frame."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import partial
from itertools import product
from math import dist

import pygame

from ninja_game.editor.draft import Draft
from ninja_game.editor.message_rows import DETAILS, GRIP, EditedMessages, MessageRow, moved_frame, sizing
from ninja_game.editor.stamp import CellArea, area_between
from ninja_game.errors import LevelError
from ninja_game.formats.messages import FRAME_SIZE, KEYS, LevelMessage, Moment, arrow_targets, level_text
from ninja_game.levels.episodes import Mood
from ninja_game.play.app import App
from ninja_game.play.editor.message_checks import MessageChecks
from ninja_game.play.editor.message_form import MOMENT_TEXTS
from ninja_game.play.editor.sheet import said_at, things_of
from ninja_game.play.level.hud_view import named_in
from ninja_game.sim.grid import Cell, Point, cell_of, is_inside
from ninja_game.sim.level import COLUMNS, ROWS, Level
from ninja_game.sim.rules import CELL, LIFETIME
from ninja_game.sim.schema.world_fields import World
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas
from ninja_game.ui.theme import Area, Palette, Theme, contains_point, mixed
from ninja_game.view.hud import Hud, HudView, PlacedMessage, placed_message
from ninja_game.view.sprites.thumbnail import open_exit, thumbnail

PICTURE: Area = (342, 60, 422, 422 * HEIGHT / WIDTH)
_SCALE = WIDTH / PICTURE[2]  # px of the level in a px of the picture
_HANDLE = 9.0  # side of the handles of the selected frame, px of the level
_NEAR = 1.5 * CELL  # px of the level from a thing or number within which a press is on it


def ninja_place(draft: Draft, row: MessageRow) -> Point | None:
    """Where the ninja is when a message appears, px; None at the start, or where that is unknown."""
    message = row.parsed
    return message and (message.place or said_at(draft, message))


def things_about(draft: Draft, row: MessageRow | None) -> list[Point]:
    """The objects that a message can be about, px: the gold, or the switches of its moment."""
    return things_of(draft, row.when) if row and row.when in DETAILS else []


def _near_place(row: MessageRow | None) -> LevelMessage | None:
    """A message near a place as the level will have it; None for others and without a valid place."""
    return row.parsed if row and row.when == Moment.AT else None


class _Stage:
    """The level's picture and its world; ``opened``: with an open exit; ``shown``: the look in play."""

    def __init__(
        self, level: Level, palette: Palette, width: int, shown: Theme, text_size: int, *, opened: bool
    ) -> None:
        self.picture = thumbnail(level, palette, width, opened=opened)
        self.hud = Hud(Theme(palette, Canvas(self.picture.get_size()), text_size), shown)
        self.world: World | None = None
        with suppress(LevelError):
            self.world = Simulation(level).world
        if self.world and opened:
            open_exit(self.world)


class MessagePicture:
    """The level with the selected message. Presses and drags in it call ``select`` with a number, or ``changed``.

    ``mood``: in which the level is played.
    """

    def __init__(
        self,
        app: App,
        draft: Draft,
        edited: EditedMessages,
        checks: MessageChecks,
        mood: Mood,
        select: Callable[[int], object],
        changed: Callable[[], object],
    ) -> None:
        self.app = app
        self.frame_drag: Callable[[Cell], CellArea] | None = None  #: the frame for the pointer's cell, during a drag
        self._draft = draft
        self._edited = edited
        self._checks = checks
        self._mood = mood
        self._select = select
        self._changed = changed
        self._pressed_cell: Cell | None = None  #: of a press from which no drag has come yet
        self._stages: dict[tuple[object, ...], _Stage] = {}

    def level_point(self, pos: tuple[int, int]) -> Point | None:
        """The point of the level, px, under one of the screen; None outside the picture."""
        x, y = self.app.theme.canvas.logical(pos)
        return ((x - PICTURE[0]) * _SCALE, (y - PICTURE[1]) * _SCALE) if contains_point(PICTURE, x, y) else None

    def handle(self, event: pygame.Event) -> bool:
        """Use a press or a drag with the left button in the picture; whether it was one."""
        is_press = event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_LEFT
        is_drag = event.type == pygame.MOUSEMOTION and event.buttons[0]
        at = self.level_point(event.pos) if is_press or is_drag else None
        if at is None:
            return False
        cell = min(max(1, int(at[0] // CELL)), COLUMNS), min(max(1, int(at[1] // CELL)), ROWS)
        if is_press:
            self._pressed_cell = cell
            self.frame_drag = None
            self._press(at, cell)
        elif self.frame_drag and cell != self._pressed_cell:
            self._pressed_cell = None
            self._put_frame(self.frame_drag(cell))
        return True

    def release(self) -> None:
        self.frame_drag = None

    def _press(self, at: Point, cell: Cell) -> None:
        """A thing under the pointer comes first, then an edge of the selected frame, a number, the place itself."""
        row = self._edited.selected
        message = _near_place(row)
        thing = self._thing_at(at, row)
        distance, number = self._nearest_number(at)
        is_on_number = distance < _NEAR
        edge_drag = sizing(message, *at) if message and distance > GRIP else None
        if row and thing and row.detail != thing:
            row.detail = thing
            self._changed()
        elif edge_drag:
            self.frame_drag = edge_drag
        elif is_on_number and number != self._edited.index:
            self._select(number)
        elif message and _is_in_frame(message, at):
            self.frame_drag = partial(moved_frame, message.frame, cell)
        elif row and row.when == Moment.AT:
            if is_inside(cell_of(*at)):
                self._begin_frame(cell, message.size if message else FRAME_SIZE)
        elif row and not thing and not is_on_number:
            self.app.notify(f"To put it there, choose {MOMENT_TEXTS[Moment.AT][0]} for it")

    def _thing_at(self, at: Point, row: MessageRow | None) -> str:
        """The cell of a thing at a point that a message can be about, as its detail; '' for none."""
        thing = min(things_about(self._draft, row), key=partial(dist, at), default=None)
        return "{},{}".format(*cell_of(*thing)) if thing and dist(thing, at) < _NEAR else ""

    def _nearest_number(self, at: Point) -> tuple[float, int]:
        """The distance to the nearest place where a message is shown, px, and its number; _NEAR, 0 without any."""
        places = [ninja_place(self._draft, row) for row in self._edited.rows]
        distances = [(dist(place, at), number) for number, place in enumerate(places) if place]
        return min(distances, default=(_NEAR, 0))

    def _begin_frame(self, cell: Cell, size: Cell) -> None:
        """Put the middle of the frame at a cell; a drag draws another one from there."""
        self._put_frame(LevelMessage(Moment.AT, "", cell=cell, size=size).frame)
        self.frame_drag = partial(area_between, cell)

    def _put_frame(self, frame: CellArea) -> None:
        """Give the selected message a frame, if its middle is inside the level."""
        left, top, columns, rows = frame
        cell = left + columns // 2, top + rows // 2
        if self._edited.selected and is_inside(cell):
            self._edited.selected.put_at(cell, (min(columns, COLUMNS), min(rows, ROWS)))
            self._changed()

    def draw(self, surface: pygame.Surface) -> None:
        """The level with the selected message as in play, and the places of all."""
        selected = self._edited.selected
        stage = self._stage(selected)
        picture = stage.picture.copy()
        self._draw_frames(picture, stage.hud.theme)
        self._draw_rings(picture, stage.hud.theme)
        foot = self._draft.name, f"gold 0 / {self._draft.level.gold}"
        placed = self._placed(selected, stage) if selected else None
        labels = named_in(stage.world, arrow_targets([selected.text])) if stage.world and selected else ()
        stage.hud.draw(picture, HudView(LIFETIME, "", foot, name=self._draft.name, message=placed, named=labels))
        surface.blit(picture, self.app.theme.canvas.rect(*PICTURE))
        self._draw_numbers(surface)

    def _stage(self, row: MessageRow | None) -> _Stage:
        """The level's picture for a message, painted once for each look."""
        theme = self.app.theme
        width = theme.canvas.rect(*PICTURE).width
        opened = bool(row and row.when == Moment.SWITCH)
        palette = self.app.palette_in(self._mood)
        text_size = self.app.settings.text_size
        look = palette.name, width, theme, text_size
        if (*look, opened) not in self._stages:
            self._stages = {key: stage for key, stage in self._stages.items() if key[:-1] == look}
            stage = _Stage(self._draft.level, palette, width, theme, text_size, opened=opened)
            self._stages[*look, opened] = stage
        return self._stages[*look, opened]

    def _placed(self, row: MessageRow, stage: _Stage) -> PlacedMessage | None:
        """A message as it lies in the level in play; None without a text."""
        text = self._text_in_play(row)
        if not text:
            return None
        message = _near_place(row)
        moment = self._checks.appearance(row)
        spot = None if message else ninja_place(self._draft, row)
        event = None if row.when == Moment.START else spot
        if moment and row.when != Moment.START:
            spot, event = moment.spot, moment.event
        things = self._checks.things if stage.world else ()
        is_start, tiles = row.when == Moment.START, self._draft.level.tiles
        return placed_message(text, tiles, things, message, spot, event, of_start=is_start)

    def _text_in_play(self, row: MessageRow) -> str:
        """A text with the player's keys, and with its numbers when it comes."""
        number = int(row.detail) if row.detail.isdecimal() else 0
        all_gold = self._draft.level.gold
        gold = {Moment.ALL_GOLD: all_gold, Moment.GOLD: number if row.detail.isdecimal() else 1}.get(row.when, 0)
        deaths = number if row.when == Moment.DEATH else 0

        def key(word: str) -> str:
            return self.app.controls.name(word) if word in KEYS else f"{{{word}}}"

        return level_text(row.text.strip(), key, gold, all_gold, deaths)

    def _draw_frames(self, picture: pygame.Surface, theme: Theme) -> None:
        """The frames of all messages near a place; with handles for the selected one."""
        for row in self._edited.rows:
            if message := _near_place(row):
                self._draw_frame(picture, theme, message, chosen=row is self._edited.selected)

    def _draw_frame(self, picture: pygame.Surface, theme: Theme, message: LevelMessage, *, chosen: bool) -> None:
        (x, y), (half_w, half_h) = message.middle, message.reach
        palette = theme.palette
        colour = palette.accent if chosen else mixed(palette.background, palette.accent, 0.4)
        theme.canvas.frame_rect(picture, colour, x - half_w, y - half_h, 2 * half_w, 2 * half_h, 2 if chosen else 1)
        for across, down in product((-1, 0, 1), repeat=2) if chosen else ():
            if across or down:
                left = x + across * half_w - _HANDLE / 2
                top = y + down * half_h - _HANDLE / 2
                theme.canvas.fill_rect(picture, colour, left, top, _HANDLE, _HANDLE)

    def _draw_rings(self, picture: pygame.Surface, theme: Theme) -> None:
        """Rings around the things that the selected message can be about."""
        selected = self._edited.selected
        place = ninja_place(self._draft, selected) if selected else None
        for thing in things_about(self._draft, selected):
            theme.canvas.circle(picture, theme.palette.accent, thing, 13, 3 if thing == place else 1)

    def _draw_numbers(self, surface: pygame.Surface) -> None:
        """The numbers of the messages that are not selected, where they are shown."""
        theme = self.app.theme
        for number, row in enumerate(self._edited.rows):
            place = None if row is self._edited.selected else ninja_place(self._draft, row)
            if place:
                x, y = PICTURE[0] + place[0] / _SCALE, PICTURE[1] + place[1] / _SCALE
                theme.canvas.circle(surface, theme.palette.accent, (x, y), 6)
                colour = theme.palette.background
                theme.text(surface, str(number + 1), x, y - 4.5, size=9, align="centre", colour=colour, width=11)


def _is_in_frame(message: LevelMessage, at: Point) -> bool:
    (x, y), (half_w, half_h) = message.middle, message.reach
    return abs(at[0] - x) < half_w and abs(at[1] - y) < half_h
