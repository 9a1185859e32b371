"""The picture of a running world: reads it, draws between its ticks, and reports the px that changed."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from math import cos, hypot, sin
from random import Random
from typing import TYPE_CHECKING, Protocol

import pygame

from ninja_game.player.settings import Settings
from ninja_game.sim.events import DIED, MINE_EXPLODED, ROCKET_EXPLODED
from ninja_game.sim.grid import Point
from ninja_game.sim.kinds import EXIT
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import CELEBRATING, DEAD
from ninja_game.simulation import Simulation
from ninja_game.ui.audio.player import AudioOutput
from ninja_game.ui.audio.table import warning_of
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas
from ninja_game.ui.theme import Palette, Theme, palette_named
from ninja_game.view.effects.effects import Effects
from ninja_game.view.effects.particles import Particles
from ninja_game.view.ninja.ninja_animation import NinjaAnimation, draw_ninja, draw_ragdoll
from ninja_game.view.ninja.ragdoll import Ragdoll
from ninja_game.view.sprites.backdrop import Backdrop
from ninja_game.view.sprites.drawing import DrawTarget, drawn_within, shared_book
from ninja_game.view.sprites.moving_sprites import draw_moving, draw_pulses
from ninja_game.view.sprites.object_animation import ObjectAnimation
from ninja_game.view.sprites.sketch import Sketch

if TYPE_CHECKING:
    from ninja_game.view.overlays import Overlays


SHAKE = 9.0  # greatest shake by an explosion at the ninja, px
SHAKE_KEPT = 0.78  # share of the shake that is left a tick later
SHAKE_REACH = 200.0  # px from an explosion to where it does not shake

DANCE_TICKS = 36  # ticks for which the ninja dances before its exit
ENTER_TICKS = 10  # ticks in which it steps through the exit
DOOR_STEP = 2.0  # px from the exit's middle down to where it stands

CUE_ABOVE = 24.0  # height of a mark over its source, px
_CUE_BORDER = 14.0

_CUE_SHAPES: dict[str, list[Point]] = {
    "rocket": [(0, -6), (5, 5), (0, 2), (-5, 5)],
    "weapon": [(1, -6), (-5, 1), (-1, 1), (-1, 6), (5, -1), (1, -1)],
    "chase": [(-1.6, -6), (1.6, -6), (0.8, 2), (-0.8, 2)],
    "turret": [(0, -6), (6, 0), (0, 6), (-6, 0)],
}


@drawn_within(10)
def cue(s: Sketch, p: Palette, warning: str) -> None:
    """A disc with the shape of a warning."""
    s.disc(p.outline, 0, 0, 9)
    s.disc(p.bright, 0, 0, 7.8)
    s.polygon(p.mine, _CUE_SHAPES[warning])
    if warning == "chase":
        s.disc(p.mine, 0, 4.6, 1.4)
    elif warning == "turret":
        s.disc(p.bright, 0, 0, 2.4)


def draw_sound_cues(target: DrawTarget, world: World) -> None:
    """The marks of a world, above their sources and always within the stage."""
    for o in world.objects[1 : world.id_count + 1]:
        warning = warning_of(o)
        if warning:
            x = min(WIDTH - _CUE_BORDER, max(_CUE_BORDER, o.x))
            y = min(HEIGHT - _CUE_BORDER, max(_CUE_BORDER, o.y - CUE_ABOVE))
            target.sprite(cue(warning), x, y)


class DrawnGhost(Protocol):
    """The ninja of another run in the same picture. ``shade``: its colour, None: the palette's for ghosts."""

    ninja_animation: NinjaAnimation
    shade: pygame.Color | None

    def on_tick(self) -> None:
        """One more tick."""

    def on_seek(self, tick: int) -> None:
        """Show the moment of the run after that many ticks."""

    def place(self, fraction: float) -> Point:
        """Its position in the level, px."""


class LevelView:
    """Draws a world in the whole window.

    Call ``on_tick`` after every tick of the simulation, ``on_seek`` after any other change of it (restart, restore).
    ``seed``: for the random numbers. ``audible``: whether its events are played as sounds.
    """

    def __init__(self, context: RenderContext, simulation: Simulation, *, seed: int = 0, audible: bool = True) -> None:
        self.context = context
        self.simulation = simulation
        self.audible = audible
        self._rng = Random(seed)  # noqa: S311 - presentation
        self.ghosts: Sequence[DrawnGhost] = ()
        self.overlays: Overlays | None = None
        self.particles = Particles()
        self.effects = Effects(self.particles, self._rng)
        self.object_animation = ObjectAnimation(simulation.world)
        self.ninja_animation = NinjaAnimation(simulation.world, self._rng)
        self.ragdoll: Ragdoll | None = None
        self.shake = 0.0
        self._won = self._door = 0
        self._covered: list[pygame.Rect] = []
        self._look: tuple[object, ...] = ()
        self._layout()

    # --- ticks ---

    def on_tick(self) -> None:
        """Update after a tick: its events become particles, animations, a corpse, sound."""
        world = self.simulation.world
        self._follow_options()
        self.object_animation.on_tick(world)
        self.follow_ninja()
        self._follow_blasts(world)
        self._follow_win(world)
        for ghost in self.ghosts:
            ghost.on_tick()

    def follow_ninja(self) -> None:
        """Update the ninja after a tick, or between two ticks: when time is out, or after the suicide key."""
        world = self.simulation.world
        self.ninja_animation.on_tick(world)
        self.effects.on_tick(self.simulation.tiles, world)
        self._follow_death(world)
        if self.audible:
            self.context.audio_output.play_events(world)

    def on_seek(self) -> None:
        """Forget earlier ticks: the world was restarted or set to another moment."""
        world = self.simulation.world
        self.object_animation.reset(world)
        self.ninja_animation.reset(world)
        self.effects.reset()
        self.ragdoll = None
        self.shake = 0.0
        self._won = 0
        self._mended += self.backdrop.reset(world, self.object_animation)
        for ghost in self.ghosts:
            ghost.on_seek(world.tick)
        if world.ninja.state == DEAD:
            self._fall_down(world)

    def _follow_options(self) -> None:
        options = self.context.settings
        self.effects.gore = not options.reduced_gore
        self.particles.share_shown = (0.35 if options.reduced_motion else 1.0) * options.particles / 100
        self.ninja_animation.squashes = not options.reduced_motion

    def _follow_blasts(self, world: World) -> None:
        """Explosions shake the picture, the more the nearer they are to the ninja."""
        self.shake *= SHAKE_KEPT
        options = self.context.settings
        for event in world.events[: world.event_count]:
            if event.kind in (MINE_EXPLODED, ROCKET_EXPLODED) and not options.reduced_motion:
                far = hypot(event.x - world.ninja.x, event.y - world.ninja.y)
                self.shake = max(self.shake, SHAKE * options.shake / 100 * max(0.0, 1 - far / SHAKE_REACH))

    def _follow_win(self, world: World) -> None:
        """The ninja dances before its exit, steps into it, and the exit closes: only in the picture."""
        won = world.ninja.state == CELEBRATING and not self.context.settings.reduced_motion
        self._won = self._won + 1 if won else 0
        if self._won == 1:
            n = world.ninja
            exits = (k for k, o in enumerate(world.objects) if o.kind == EXIT and o.is_open)
            self._door = min(exits, key=lambda k: hypot(world.objects[k].x - n.x, world.objects[k].y - n.y))
        if self._won == DANCE_TICKS + ENTER_TICKS:
            self.object_animation.close(self._door)

    def _follow_death(self, world: World) -> None:
        """Start or continue the corpse; a revived ninja (objects.md §3) gets up."""
        if world.ninja.state != DEAD:
            self.ragdoll = None
            return
        if self.ragdoll is None:
            self._fall_down(world)
        if self.ragdoll is not None:
            self.ragdoll.step(self.simulation.tiles, world)

    def _fall_down(self, world: World) -> None:
        n = world.ninja
        before, now = (self.ninja_animation.pose(fraction).moved(n.x, n.y) for fraction in (0.5, 1.0))
        velocity = n.x - n.prev_x, n.y - n.prev_y
        self.ragdoll = Ragdoll(now, before, velocity, self.ninja_animation.facing, self._rng, self._corpse_hit)
        for event in world.events[: world.event_count]:
            if event.kind == DIED:
                gory = not self.context.settings.reduced_gore
                self.ragdoll.shove(event.cause, (event.dx, event.dy), event.y, n.y, whole=not gory)
                if self.ragdoll.dismembered:
                    self.effects.blood(n.x, n.y, 0.0, -2.0, 12)

    def _corpse_hit(self, x: float, y: float, into: float, along: float) -> None:
        if into > 1.0 and self.audible:
            self.context.audio_output.corpse(into)
        if into > 3.0:
            self.effects.blood(x, y, 0.0, -1.0, 1)
        if along * along > 0.3 and self._rng.random() < 0.12:
            self.effects.add("dust", x, y, -along, -4, life=32, size=0.6, rear=True)

    # --- the picture ---

    def _layout(self) -> None:
        """Build all that depends on the window's size and the palette."""
        self.canvas = self.context.canvas
        palette = self.context.theme.palette
        book = shared_book(self.canvas.scale, palette.base)
        self.target = DrawTarget(self.canvas, palette.base, book)
        self.backdrop = Backdrop(self.canvas, palette, book, self.simulation.tiles)
        self.backdrop.reset(self.simulation.world, self.object_animation)
        self._look = self._wanted_look()
        self._mended: list[pygame.Rect] = []
        self._whole = True

    def _wanted_look(self) -> tuple[object, ...]:
        return self.context.canvas, self.context.theme.palette.name

    @property
    def colour(self) -> pygame.Color:
        chosen = self.context.settings.ninja_colour
        return pygame.Color(chosen) if chosen else self.target.palette.ninja

    def draw(self, surface: pygame.Surface, fraction: float = 1.0, *, whole: bool = False) -> list[pygame.Rect] | None:
        """Draw the world ``fraction`` of a tick after the last but one; the px that changed, None for all.

        ``whole``: the surface no longer holds the last picture.
        """
        if self._look != self._wanted_look():
            self._layout()
        if not self.context.settings.smooth:
            fraction = 1.0
        shaken = self.shake > 0.25
        whole = whole or self._whole or shaken
        # A shaken picture is offset: every px changes in the next one.
        self._whole = shaken
        self._shift(shaken=shaken)
        mended = self._restore(surface, whole, fraction)
        surface.set_clip(self.canvas.stage)
        self._draw_moving(surface, fraction)
        self._cover_by_tiles(surface)
        if not self.context.settings.reduced_motion:
            draw_pulses(self.target, self.simulation.world, self.object_animation, fraction)
        if self.overlays is not None:
            self.overlays.draw(self.target, self.simulation)
        surface.set_clip(None)
        changed = self._covered + self.target.covered + mended
        self._covered = self.target.covered
        return None if whole else changed

    def _shift(self, *, shaken: bool) -> None:
        """Offset all drawing on the stage while the picture shakes."""
        turn, reach = 2.4 * self.effects.now, self.shake * self.canvas.scale * shaken
        dx, dy = round(reach * cos(turn)), round(reach * sin(turn))
        self._origin = self.canvas.stage.move(dx, dy).topleft
        self.target.canvas = self.canvas
        if shaken:
            self.target.canvas = copy(self.canvas)
            self.target.canvas.origin = self.canvas.origin[0] + dx, self.canvas.origin[1] + dy

    def _restore(self, surface: pygame.Surface, whole: bool, fraction: float) -> list[pygame.Rect]:
        """Restore the backdrop under the last moving objects, and where it changed."""
        origin, stage, picture = self._origin, self.canvas.stage, self.backdrop.picture
        self._mended += self.backdrop.update(self.simulation.world, self.object_animation, fraction)
        mended = [rect.move(origin) for rect in self._mended]
        self._mended.clear()
        if whole:
            if stage != surface.get_rect():
                surface.fill(self.backdrop.palette.tile)
            surface.set_clip(stage)
            surface.blit(picture, origin)
            # A shaken picture leaves two edges free, which stay as they are.
            dx, dy = origin[0] - stage.x, origin[1] - stage.y
            left = 0 if dx > 0 else stage.width + dx
            top = 0 if dy > 0 else stage.height + dy
            for edge in ((left, 0, abs(dx), stage.height), (0, top, stage.width, abs(dy))):
                surface.blit(picture, stage.move(edge[:2]), edge)
            return mended
        for rect in self._covered + mended:
            surface.blit(picture, rect, rect.move(-origin[0], -origin[1]))
        return mended

    def _draw_moving(self, surface: pygame.Surface, fraction: float) -> None:
        """From back to front, in the order of presentation.md §1."""
        target, now = self.target, self.effects.now + fraction - 1
        target.begin(surface)
        Particles.draw(self.particles.rear, target, now)
        draw_moving(target, self.simulation.world, self.object_animation, fraction)
        if self.context.settings.show_ghost:
            for ghost in self.ghosts:
                at, colour = ghost.place(fraction), ghost.shade or target.palette.ghost
                draw_ninja(target, ghost.ninja_animation, at, fraction, colour, ghost=True)
        self._draw_ninja(fraction)
        Particles.draw(self.particles.front, target, now)
        if self.context.settings.sound_cues:
            draw_sound_cues(target, self.simulation.world)

    def _draw_ninja(self, fraction: float) -> None:
        if self.ragdoll is not None:
            draw_ragdoll(self.target, self.ragdoll, fraction, self.colour)
        else:
            (x, y), alpha = self.object_animation.ninja_place(fraction), 1.0
            if self._won:
                ticks, door = self._won + fraction - 1, self.simulation.world.objects[self._door]
                share = min(1.0, ticks / ENTER_TICKS)
                x, y = x + (door.x - x) * share, y + (door.y + DOOR_STEP - y) * share
                alpha = 1 - max(0.0, min(1.0, (ticks - DANCE_TICKS) / ENTER_TICKS))
            if alpha > 0:
                draw_ninja(self.target, self.ninja_animation, (x, y), fraction, self.colour, alpha)

    def draw_ninja_over(self, surface: pygame.Surface, fraction: float) -> None:
        """Draw the ninja once more, over a copy of the picture with something drawn on it."""
        self.target.begin(surface)
        self._draw_ninja(fraction)

    def _cover_by_tiles(self, surface: pygame.Surface) -> None:
        """Tiles are in front of all moving objects."""
        (x, y), backdrop = self._origin, self.backdrop
        for area in backdrop.on_tiles([rect.move(-x, -y) for rect in self.target.covered]):
            backdrop.cover(surface, area, (x, y))

    def also_covered(self, rect: pygame.Rect) -> None:
        """Another drawing over the level covers this area; the next picture removes it."""
        self._covered.append(rect)


class RenderContext(Protocol):
    """The interface of the screen or program that shows a level."""

    theme: Theme
    canvas: Canvas
    audio_output: AudioOutput

    @property
    def settings(self) -> Settings:
        """The player's settings."""


class OffscreenContext:
    """A silent context without a window, for pictures and films. ``size``: px."""

    def __init__(self, size: tuple[int, int], settings: Settings | None = None) -> None:
        self.settings = settings or Settings()
        self.canvas = Canvas(size)
        self.theme = Theme(palette_named(self.settings.palette), self.canvas)
        self.audio_output = AudioOutput()
