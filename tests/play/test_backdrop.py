"""The backdrop is mended piece by piece; what it shows is what it would show if it were painted again."""

from collections import deque
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pygame
import pytest

from ninja_game.formats.load import load_levels, load_replays
from ninja_game.sim.events import EXIT_OPENED
from ninja_game.sim.kinds import EXIT, NINJA, SWITCH
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import CLASSIC, MOODS, PALETTES, Palette
from ninja_game.view.level_view import LevelView, OffscreenContext
from ninja_game.view.sprites import moving_sprites
from ninja_game.view.sprites.backdrop import Backdrop
from ninja_game.view.sprites.drawing import DrawTarget, SpriteBook
from ninja_game.view.sprites.object_animation import ObjectAnimation
from ninja_game.view.sprites.static_sprites import exit_door
from tests.support.own_pack import PACK

REPLAYS = sorted(PACK.glob("certificates/*.replay.txt"))
CANVAS = Canvas((396, 300))


def painted(run: Simulation, animation: ObjectAnimation, book: SpriteBook) -> Backdrop:
    backdrop = Backdrop(CANVAS, book.palette, book, run.tiles)
    backdrop.reset(run.world, animation)
    return backdrop


def pictures(path: Path, palette: Palette) -> Iterator[tuple[Simulation, ObjectAnimation, Backdrop]]:
    """A run and its backdrop before its first tick, then after every one."""
    recording = load_replays(path)[0]
    run = Simulation(recording.level)
    animation = ObjectAnimation(run.world)
    backdrop = painted(run, animation, SpriteBook(CANVAS.scale, palette))
    yield run, animation, backdrop
    for keys in recording.inputs:
        run.step_keys(keys)
        animation.on_tick(run.world)
        backdrop.update(run.world, animation, 1.0)
        yield run, animation, backdrop


def pixels(backdrop: Backdrop) -> bytes:
    return pygame.image.tobytes(backdrop.picture, "RGB")


@pytest.mark.parametrize("path", REPLAYS, ids=lambda path: path.name.split(".")[0])
def test_mended_backdrop_is_the_backdrop_painted_again(path: Path) -> None:
    palette = (CLASSIC, *MOODS)[REPLAYS.index(path) % 6]
    book = SpriteBook(CANVAS.scale, palette)
    for tick, (run, animation, backdrop) in enumerate(pictures(path, palette)):
        if tick % 15 == 1:
            assert pixels(backdrop) == pixels(painted(run, animation, book)), tick


def test_exit_switch_looks_pressed_from_its_tick_on() -> None:
    pictured = pictures(REPLAYS[0], CLASSIC)
    run, _, backdrop = next(pictured)
    switch = next(o for o in run.world.objects[: run.world.slots_used] if o.kind == SWITCH)
    place = pygame.Rect(CANVAS.point(switch.x - 4, switch.y - 2), (4, 2))
    lit = pygame.transform.average_color(backdrop.picture, place)
    for _ in pictured:
        if any(event.kind == EXIT_OPENED for event in run.world.events[: run.world.event_count]):
            break
        assert pygame.transform.average_color(backdrop.picture, place) == lit
    assert pygame.transform.average_color(backdrop.picture, place) != lit


@pytest.mark.parametrize("name", ["classic", "contrast", "night", "safe"])
def test_light_goes_from_the_switch_to_the_open_exit_where_there_is_a_scenery(name: str) -> None:
    palette = PALETTES[name]
    pictured = pictures(REPLAYS[0], palette)
    run, _, backdrop = next(pictured)
    slots = {o.kind: o for o in run.world.objects[: run.world.slots_used] if o.kind in {SWITCH, EXIT}}
    beside = {kind: pygame.Rect(CANVAS.point(o.x - 4, o.y - 26), (4, 4)) for kind, o in slots.items()}

    def brightness(kind: int) -> int:
        return sum(pygame.transform.average_color(backdrop.picture, beside[kind])[:3])

    before = {kind: brightness(kind) for kind in beside}
    deque(pictured, maxlen=0)
    change = {kind: brightness(kind) - light for kind, light in before.items()}
    assert (change[SWITCH] < 0 < change[EXIT]) if palette.scenery else not any(change.values())


def test_whatever_is_drawn_lies_in_what_is_told_to_be_covered() -> None:
    """What moves is erased there before the next picture."""
    target = DrawTarget(CANVAS, CLASSIC, SpriteBook(CANVAS.scale, CLASSIC))
    for draw in (
        partial(target.line, CLASSIC.ninja, 300.3, 200.2, 402.7, 333.1, 1.5),
        partial(target.disc, CLASSIC.ninja, 300.3, 200.2, 7.7),
        partial(target.sprite, moving_sprites.thwump(0, 0), 300.3, 200.2),
        partial(target.picture, target.book.sprite(moving_sprites.thwump(0, 0)), 300.3, 200.2),
    ):
        target.begin(pygame.Surface(CANVAS.size))
        draw()
        drawn = pygame.mask.from_threshold(target.surface, (0, 0, 0), (1, 1, 1, 255))
        drawn.invert()
        assert any(rect.contains(drawn.get_bounding_rects()[0]) for rect in target.covered)


def test_an_open_exit_needs_no_more_room_than_a_closed_one() -> None:
    """Beside it there may be rock, which is in front."""
    book = SpriteBook(4.0, CLASSIC)
    closed, opened = (pygame.mask.from_surface(book.sprite(exit_door(step)).surface) for step in (0, 8))
    assert opened.get_bounding_rects() == closed.get_bounding_rects()


def test_no_corner_hides_a_mine(tmp_path: Path) -> None:
    """Half of it lies in the rock, and is seen; nor does rock hide it again when something has moved there."""
    file = tmp_path / "corner.txt"
    rows = [f"|{'#' * 8}{'.' * 23}|" for _ in range(22)]
    lines = ["ninja-game level 1", "name: Corner", *rows, f"|{'#' * 20}@{'.' * 10}|", "mine 216,300px"]
    file.write_text("\n".join(lines), "utf-8")
    view = LevelView(OffscreenContext((792, 600)), Simulation(load_levels(file)[0].level))
    surface = pygame.Surface((792, 600))
    view.draw(surface, whole=True)
    mine = surface.get_at((213, 300))
    view.also_covered(pygame.Rect(200, 290, 30, 30))
    view.draw(surface)
    surface.set_clip(None)
    view.backdrop.cover(surface, pygame.Rect(200, 290, 30, 30), (0, 0))
    assert surface.get_at((213, 300)) == mine
    assert mine.r > 2 * mine.b


def test_what_lies_within_what_was_drawn_before_it_is_covered_with_that() -> None:
    """A drone's eye needs no rectangle of its own; what reaches beyond has one."""
    target = DrawTarget(CANVAS, CLASSIC, SpriteBook(CANVAS.scale, CLASSIC))
    target.begin(pygame.Surface(CANVAS.size))
    for key, x, count in ((moving_sprites.drone(0, 0, 0, 0), 200, 1), (moving_sprites.eye(0), 204, 1),
                          (moving_sprites.eye(0), 240, 2)):  # fmt: skip
        target.sprite(key, x, 200)
        assert len(target.covered) == count


def test_only_areas_with_tiles_are_drawn_over() -> None:
    level = Level(tuple(int(place == 2 * 23 + 3) for place in range(713)), (ObjectSpec(NINJA, (400.0, 300.0)),))
    backdrop = Backdrop(CANVAS, CLASSIC, SpriteBook(CANVAS.scale, CLASSIC), Simulation(level).tiles)
    cell = pygame.Rect(3 * 12, 4 * 12, 12, 12)
    on, off = cell.move(11, -11), cell.move(-14, 0)
    assert backdrop.on_tiles([off, on, off.move(0, 30), cell]) == [on, cell]
    assert backdrop.on_tiles([pygame.Rect(-40, -40, 20, 20), pygame.Rect(600, 500, 9, 9)]) == []


def test_a_shaken_picture_is_the_still_one_elsewhere_and_its_edges_stay() -> None:
    run = Simulation(load_replays(REPLAYS[0])[0].level)
    still, shaken = pygame.Surface((396, 320)), pygame.Surface((396, 320))
    view = LevelView(OffscreenContext(still.size), run, audible=False)
    view.draw(still)
    view.effects.now, view.shake = 1.0, 9.0
    assert view.draw(shaken) is None
    dx, dy = view._origin[0], view._origin[1] - 10
    assert dx < 0 < dy
    inner = view.canvas.stage.inflate(-20, -20)
    assert pygame.image.tobytes(shaken.subsurface(inner.move(dx, dy)), "RGB") == pygame.image.tobytes(
        still.subsurface(inner), "RGB"
    )
    for edge in (pygame.Rect(0, 0, 396, 10 + dy), pygame.Rect(396 + dx, 10, -dx, 300)):
        assert pygame.image.tobytes(shaken.subsurface(edge), "RGB") == pygame.image.tobytes(
            still.subsurface(edge), "RGB"
        )
    view.shake = 0.0
    assert view.draw(shaken) is None
    assert pygame.image.tobytes(shaken, "RGB") == pygame.image.tobytes(still, "RGB")
