"""The still part of the picture, drawn once and repaired where it changes; and tiles, which hide moving objects."""

from __future__ import annotations

import pygame

from ninja_game.sim.kinds import GOLD, MINE
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import Palette
from ninja_game.view.sprites.drawing import SpriteBook, is_near
from ninja_game.view.sprites.light import Light, light_of, light_picture
from ninja_game.view.sprites.object_animation import ObjectAnimation
from ninja_game.view.sprites.relief import add_relief
from ninja_game.view.sprites.sketch import Sprite
from ninja_game.view.sprites.static_sprites import SETTLED_TICKS, PlacedSprite, static_sprites_of
from ninja_game.view.sprites.tile_sheet import TileSheet


class Backdrop:
    """Scenery, light, static sprites and tiles of a level at one size, for the visible part.

    Px count from the upper left corner of the visible part of the stage.
    """

    def __init__(self, canvas: Canvas, palette: Palette, book: SpriteBook, tiles: TileMap) -> None:
        self.canvas = canvas
        self.palette = palette
        self._book = book
        self._corner = canvas.stage.topleft
        self.picture = pygame.Surface(canvas.size)
        sheet = TileSheet(canvas, palette.tile)
        sheet.show(tiles.ids)
        if palette.scenery:
            self.ground = add_relief(sheet, palette)
        else:
            self.ground = pygame.Surface(canvas.size)
            self.ground.fill(palette.background)
        self.tiles, self.on_tiles = sheet.surface, sheet.on_tiles
        self._mines: list[int] = []
        self._mine_places: list[pygame.Rect] = []
        self._blits: dict[int, list[tuple[Sprite, int, int]]] = {}
        self._order: list[int] | None = None
        self._rects: dict[int, pygame.Rect] = {}
        self._lights: dict[int, tuple[Light, pygame.Surface, pygame.Rect]] = {}
        self._moving: set[int] = set()

    def reset(self, world: World, animation: ObjectAnimation) -> list[pygame.Rect]:
        """Show another world, or moment, of this level; the px that changed."""
        self._moving.clear()
        # Walls first, then the objects before them.
        front = {GOLD, MINE}
        order = sorted(animation.static_slots, key=lambda slot: world.objects[slot].kind in front)
        fresh, changed = order != self._order, []
        if fresh:
            self._order = order
            self._blits.clear()
            self._rects.clear()
            self._lights.clear()
        for slot in order:
            before = self._blits.get(slot)
            rect = self._place(slot, static_sprites_of(world, slot, animation, 1.0))
            if self._blits[slot] != before:
                changed.append(rect)
            changed += self._light(world, slot)
        if fresh:
            self._mines = [slot for slot in order if world.objects[slot].kind == MINE]
            self._mine_places = [self._rects.get(slot, pygame.Rect(0, 0, 0, 0)) for slot in self._mines]
            changed = [self.picture.get_rect()]
        for rect in changed:
            self._mend(rect)
        return changed

    def _place(self, slot: int, sprites: list[PlacedSprite]) -> pygame.Rect:
        """Replace the drawings of an object; the px that it covered and covers."""
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
        """Update the light around an object; the px that changed."""
        light = light_of(world, slot) if self.palette.scenery else None
        before = self._lights.get(slot)
        if light == (before and before[0]):
            return []
        changed = [before[2]] if before else []
        if light is None or not is_near(light.x, light.y):
            self._lights.pop(slot, None)
        else:
            picture = light_picture(light.style, self.canvas.scale, self._book.palette)
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
        for slot in self._order or ():
            rect = self._rects.get(slot)
            if rect is not None and rect.colliderect(area):
                for sprite, px, py in self._blits[slot]:
                    sprite.blit(self.picture, (px, py))
        self.cover(self.picture, area, (0, 0))
        self.picture.set_clip(None)

    def cover(self, surface: pygame.Surface, area: pygame.Rect, corner: tuple[int, int]) -> None:
        """Draw the foreground of an area again over moving objects: tiles, then mines, so that no corner hides one."""
        surface.blit(self.tiles, area.move(corner), area, pygame.BLEND_PREMULTIPLIED)
        for number in area.collidelistall(self._mine_places):
            place, part = self._mine_places[number], self._mine_places[number].clip(area)
            for sprite, _, _ in self._blits[self._mines[number]]:
                inside = part.move(-place.x, -place.y)
                surface.blit(sprite.surface, part.move(corner), inside, pygame.BLEND_PREMULTIPLIED)

    def update(self, world: World, animation: ObjectAnimation, fraction: float) -> list[pygame.Rect]:
        """Repair what changed since the last picture; the px that changed."""
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
