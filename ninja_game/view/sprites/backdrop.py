"""Everything that does not move, drawn once and mended where it changes; and the tiles, which cover what moves.

Depth: light fades below the upper edges of the tiles, shade along the lower ones, and they throw a shadow behind them.
"""

from __future__ import annotations

import pygame

from ninja_game.sim.kinds import GOLD, MINE
from ninja_game.sim.memory.schema import TileMap, World
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.scenery import painted
from ninja_game.ui.theme import Palette
from ninja_game.view.sprites.drawing import SpriteBook, is_near
from ninja_game.view.sprites.light import Light, light_of, light_picture
from ninja_game.view.sprites.object_animation import ObjectAnimation
from ninja_game.view.sprites.sketch import Sprite
from ninja_game.view.sprites.static_sprites import SETTLED_TICKS, PlacedSprite, static_sprites_of
from ninja_game.view.sprites.tile_sheet import TileSheet

EDGES = (("bright", 2, 0, 120), ("outline", -3, 0, 80), ("bright", 9, 12, 62))
"""What is left of the tiles in a colour when they are taken away: so much lower, or higher, and so soft, logical px;
how strong it is."""

SHADOW, SHADOW_AT = 76, (4, 6)
"""The shadow's strength, and where it falls, logical px."""


def add_relief(sheet: TileSheet, palette: Palette) -> pygame.Surface:
    """Draw the edges of a level's tiles on their sheet; what is behind, in their shadow."""
    inks = {role: sheet.in_colour(getattr(palette, role)) for role in ("bright", "outline")}
    size = sheet.surface.size
    small = painted(palette).copy()
    # It is soft, since it is painted on the small sheet of the scenery.
    shadow = pygame.transform.smoothscale(inks["outline"], small.get_size())
    shadow.fill((SHADOW,) * 4, special_flags=pygame.BLEND_RGBA_MULT)
    share = sheet.canvas.scale * small.width / size[0]
    small.blit(shadow, [round(share * away) for away in SHADOW_AT], special_flags=pygame.BLEND_PREMULTIPLIED)
    for role, depth, soft, strength in EDGES:
        edge = taken = inks[role]
        step = round(depth * sheet.canvas.scale) or (1 if depth > 0 else -1)
        if soft:
            # Made small and large again.
            few = [max(1, round(length / soft / sheet.canvas.scale)) for length in size]
            for each in ([2 * number for number in few], few, size):
                taken = pygame.transform.smoothscale(taken, each)
        else:
            edge = taken.copy()
        edge.blit(taken, (0, step), special_flags=pygame.BLEND_RGBA_SUB)
        # The tiles go on beyond the edge of the stage.
        edge.fill((0, 0, 0, 0), (0, 0 if step > 0 else size[1] + step, size[0], abs(step)))
        edge.fill((strength,) * 4, special_flags=pygame.BLEND_RGBA_MULT)
        sheet.surface.blit(edge, (0, 0), special_flags=pygame.BLEND_PREMULTIPLIED)
    return pygame.transform.smoothscale(small, size)


class Backdrop:
    """Scenery, light, static sprites and tiles of a level in one size, as far as they are seen.

    Px here count from the upper left corner of what is seen of the stage.
    """

    def __init__(self, canvas: Canvas, palette: Palette, book: SpriteBook, level: TileMap) -> None:
        self.canvas = canvas
        self.palette = palette
        self._book = book
        self._corner = canvas.stage.topleft
        self.picture = pygame.Surface(canvas.size)
        sheet = TileSheet(canvas, palette.tile)
        sheet.show(level)
        if palette.scenery:
            self.ground = add_relief(sheet, palette)
        else:
            self.ground = pygame.Surface(canvas.size)
            self.ground.fill(palette.background)
        self.tiles, self.has_tile = sheet.surface, sheet.has_tile
        self._mines: list[int] = []
        self._mine_places: list[pygame.Rect] = []
        self._blits: dict[int, list[tuple[Sprite, int, int]]] = {}
        self._order: list[int] = []
        self._rects: dict[int, pygame.Rect] = {}
        self._lights: dict[int, tuple[Light, pygame.Surface, pygame.Rect]] = {}
        self._moving: set[int] = set()
        self._drawn = False

    def reset(self, world: World, animation: ObjectAnimation) -> list[pygame.Rect]:
        """Have it as it is in another world, or moment, of this level; the px that changed."""
        self._moving.clear()
        # Walls first, then what lies before them.
        front = {GOLD, MINE}
        order = sorted(animation.static_slots, key=lambda slot: world.objects[slot].kind in front)
        if order != self._order or not self._drawn:
            self._order, self._drawn = order, True
            self._blits.clear()
            self._rects.clear()
            self._lights.clear()
            for slot in order:
                self._place(slot, static_sprites_of(world, slot, animation, 1.0))
                self._light(world, slot)
            self._mines = [slot for slot in order if world.objects[slot].kind == MINE]
            self._mine_places = [self._rects.get(slot, pygame.Rect(0, 0, 0, 0)) for slot in self._mines]
            changed = [self.picture.get_rect()]
        else:
            changed = []
            for slot in order:
                before = self._blits[slot]
                rect = self._place(slot, static_sprites_of(world, slot, animation, 1.0))
                if self._blits[slot] != before:
                    changed.append(rect)
                changed += self._light(world, slot)
        for rect in changed:
            self._mend(rect)
        return changed

    def _place(self, slot: int, sprites: list[PlacedSprite]) -> pygame.Rect:
        """Take down and put up the drawings of an object; the px that it covered and covers."""
        old = self._rects.pop(slot, None)
        blits = []
        rect: pygame.Rect | None = None
        for key, x, y in sprites:
            if not is_near(x, y):
                continue
            sprite = self._book.sprite(key)
            px, py = self.canvas.point(x, y)
            px, py = px - self._corner[0], py - self._corner[1]
            blits.append((sprite, px, py))
            box = sprite.surface.get_rect(topleft=(px - sprite.ax, py - sprite.ay))
            rect = box if rect is None else rect.union(box)
        self._blits[slot] = blits
        if rect is not None:
            self._rects[slot] = rect
        return (rect or old or pygame.Rect(0, 0, 0, 0)).union(old or rect or pygame.Rect(0, 0, 0, 0))

    def _light(self, world: World, slot: int) -> list[pygame.Rect]:
        """Have the light around an object as it is now; the px that changed."""
        light = light_of(world, slot) if self.palette.scenery else None
        before = self._lights.get(slot)
        if light == (before and before[0]):
            return []
        changed = [before[2]] if before else []
        if light is None or not is_near(light.x, light.y):
            self._lights.pop(slot, None)
        else:
            picture = light_picture(light.look, self.canvas.scale, self._book.palette)
            px, py = self.canvas.point(light.x, light.y)
            reach = picture.width // 2
            corner = px - self._corner[0] - reach, py - self._corner[1] - reach
            self._lights[slot] = light, picture, picture.get_rect(topleft=corner)
            changed.append(self._lights[slot][2])
        return changed

    def _mend(self, area: pygame.Rect) -> None:
        """Draw a part of the picture again."""
        self.picture.set_clip(area)
        self.picture.blit(self.ground, area, area)
        for _, glow, place in self._lights.values():
            if place.colliderect(area):
                self.picture.blit(glow, place)
        for slot in self._order:
            rect = self._rects.get(slot)
            if rect is not None and rect.colliderect(area):
                for sprite, px, py in self._blits[slot]:
                    sprite.blit(self.picture, (px, py))
        self.cover(self.picture, area, (0, 0))
        self.picture.set_clip(None)

    def cover(self, surface: pygame.Surface, area: pygame.Rect, corner: tuple[int, int]) -> None:
        """Draw what is in front of all that moves in an area: tiles, and mines, so that no corner hides one."""
        surface.blit(self.tiles, area.move(corner), area, pygame.BLEND_PREMULTIPLIED)
        for number in area.collidelistall(self._mine_places):
            place, part = self._mine_places[number], self._mine_places[number].clip(area)
            for sprite, _, _ in self._blits[self._mines[number]]:
                inside = part.move(-place.x, -place.y)
                surface.blit(sprite.surface, part.move(corner), inside, pygame.BLEND_PREMULTIPLIED)

    def update(self, world: World, animation: ObjectAnimation, fraction: float) -> list[pygame.Rect]:
        """Mend what changed since the last picture; the px that did."""
        self._moving |= animation.changed
        animation.changed.clear()
        mended = []
        for slot in list(self._moving):
            sprites = static_sprites_of(world, slot, animation, fraction)
            if animation.age(slot, fraction) > SETTLED_TICKS:
                self._moving.discard(slot)
            for rect in (self._place(slot, sprites), *self._light(world, slot)):
                if rect.width:
                    self._mend(rect)
                    mended.append(rect)
        return mended
