"""Every figure of the lab shows what the world's functions do: its numbers are held against a plain reading."""

import re
from collections.abc import Iterator
from itertools import combinations
from math import dist
from pathlib import Path
from typing import Any

import pygame
import pytest
from PIL import Image

from ninja_game.errors import NinjaGameError
from ninja_game.formats.ascii.reader import room_level
from ninja_game.play.lab.cells import CellsTouched, GridOfCells, NineCells, RayCast
from ninja_game.play.lab.edges import EDGE_WORDS, Doors, EdgeStates, WalkingEnemies
from ninja_game.play.lab.figure import FIGURE_AREA, Figure, Sheet, room_world
from ninja_game.play.lab.grids import Bullets, FiveCells, LooseGrid
from ninja_game.play.lab.one_tick import LAB_INPUTS, PHASES, OneTick
from ninja_game.play.lab.projection import PUSH_RULE, Bodies, Projection, Response, candidates
from ninja_game.play.lab.screen import FIGURES, FILM_TICKS, FigureArea, LabScreen, export_figure, figure_pictures
from ninja_game.sim.collision.box import collide_box
from ninja_game.sim.collision.circle import collide_circle
from ninja_game.sim.collision.rays import ray_circle, sees
from ninja_game.sim.collision.tiles import EDGE_OF_FACES, FACE, NEIGHBOUR_OFFSET
from ninja_game.sim.digest import world_digest
from ninja_game.sim.grid import cell_at
from ninja_game.sim.kinds import DOOR, DRONE
from ninja_game.sim.level import BODIES
from ninja_game.sim.rules import GOLD_RADIUS, STRIDE
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import PALETTES, Theme
from ninja_game.web.pages.documents import slug
from tests.support.menu_driver import MenuDriver
from tests.support.recorded import hold_against
from tools import ROOT


def demonstrated(figure: Figure, ticks: int) -> Iterator[int]:
    """A figure in each tick of its demonstration."""
    for tick in range(ticks):
        figure.demonstrate(tick)
        figure.tick()
        yield tick


def numbers(figure: Figure) -> dict[str, str]:
    return dict(figure.numbers())


# --- all of them ---


@pytest.mark.parametrize("name", FIGURES)
def test_every_figure_has_two_sentences_and_links_to_sections_that_exist(name: str) -> None:
    figure = FIGURES[name]()
    assert len(figure.text) == 2
    assert len(figure.legend) > 1
    assert all(isinstance(getattr(PALETTES["classic"], role), pygame.Color) for role in figure.legend)
    assert len(figure.links) == 2
    for link in figure.links:
        file, anchor = link.split("#")
        titles = re.findall(r"^#+ (.*)$", (ROOT / file).read_text("utf-8"), flags=re.MULTILINE)
        assert anchor in map(slug, titles)
    assert len(figure.numbers()) <= 8
    assert len(figure.controls()) <= 4


@pytest.mark.parametrize("name", FIGURES)
def test_a_figure_writes_itself(name: str, tmp_path: Path) -> None:
    export_figure(name, tmp_path / "figure.png")
    with Image.open(tmp_path / "figure.png") as picture:
        assert list(picture.size) == list(FIGURE_AREA[2:])
        assert len(picture.convert("RGB").getcolors(1 << 24) or []) > 5
    first, *_, last = (pygame.image.tobytes(each, "RGB") for each in figure_pictures(name, ticks=60))
    assert first != last, "its demonstration stands still"


def lines_of_demonstrations() -> Iterator[str]:
    for name, kind in FIGURES.items():
        figure = kind()
        yield f"{name} begins at {figure.x:.1f}, {figure.y:.1f} px"
        for tick in demonstrated(figure, 541):
            if tick % 90 == 0:
                yield f"{name} at {figure.x:.1f}, {figure.y:.1f} px after {tick} ticks"
                yield from (f"  {text}: {value}" for text, value in figure.numbers())


def test_demonstrations_show_what_they_showed() -> None:
    hold_against(Path(__file__).parent.parent / "golden" / "lab.txt", [*lines_of_demonstrations()])


def test_a_film_of_a_figure(tmp_path: Path) -> None:
    export_figure("pairs", tmp_path / "pairs.gif", scale=0.5)
    with Image.open(tmp_path / "pairs.gif") as film:
        assert list(film.size) == [FIGURE_AREA[2] / 2, FIGURE_AREA[3] / 2]
        assert getattr(film, "n_frames", 0) > FILM_TICKS / 4
    with pytest.raises(NinjaGameError, match=r"\.png or \.gif"):
        export_figure("pairs", tmp_path / "pairs.bmp")


# --- one by one ---


def test_the_grid_names_the_cell_and_its_neighbours() -> None:
    figure = GridOfCells()
    for x, y, column, row in ((30.0, 30.0, 1, 1), (23.9, 24.0, 0, 1), (168.0, 100.0, 7, 4), (-3.0, 50.0, -1, 2)):
        figure.drag(x, y)
        shown = numbers(figure)
        assert shown["column"].endswith(f"= {column}")
        assert shown["row"].endswith(f"= {row}")
        cell = cell_at(x, y)
        assert shown["number in the list"] == (str(cell) if column >= 0 else "0: there is no cell")
        if cell:
            right, below = cell_at(x + 24, y), cell_at(x, y + 24)
            assert shown["right of it, below it"] == f"{cell} + 1 = {right}, {cell} + 35 = {below}"


def test_no_body_gets_into_the_border() -> None:
    figure = CellsTouched()
    figure.drag(2, 2)
    assert numbers(figure)["cells touched"] == "1: (1, 1)"


def test_a_circle_passes_the_ledge_at_which_a_box_stops_as_in_the_game() -> None:
    figure = Bodies()
    assert numbers(figure)["circle"].startswith("over the ledge")
    assert numbers(figure)["box"].startswith("stopped")
    for y in (126.0, 140.0, 132.0):
        figure.drag(120.0, y)
        for body, path in zip(BODIES, figure.paths, strict=True):
            plain = Simulation(figure.runs[0].level, body=body)
            n = plain.world.ninja
            n.x, n.y, n.prev_x, n.prev_y = 120.0, y, 116.0, y
            for _ in range(figure.ticks):
                plain.step(right=True)
            assert path[-1] == (n.x, n.y)


def test_a_door_stops_body_ray_and_drone_and_lets_them_pass_when_open() -> None:
    figure = Doors()
    figure.drag(199.0, 108.0)
    assert [value for _, value in figure.numbers()] == ["solid", "solid", "(+3.0, +0.0) px", "no", "left"]
    figure.is_open = True
    assert [value for _, value in figure.numbers()] == ["off", "off", "(+0.0, +0.0) px", "yes", "right"]
    figure.press(300.0, 108.0)
    assert (figure.x, figure.y) == (300.0, 108.0), "a press moves the body and paints nothing"


def test_response_is_the_difference_of_two_places_and_names_the_contact() -> None:
    figure = Response()
    for tile, place, words in (
        (1, (198.0, 115.0), "floor"), (1, (185.0, 132.0), "wall"), (1, (200.0, 150.0), "a push only"),
        (1, (200.0, 125.0), "crushed: a push of over 8.9 px"), (2, (150.0, 90.0), "none"),
    ):  # fmt: skip
        figure.tile = tile
        figure.drag(*place)
        shown, (x, y) = numbers(figure), figure.push().points[-1]
        assert shown["contacts"] == words
        assert shown["speed after"] == f"({x - figure.origin[0]:+.2f}, {y - figure.origin[1]:+.2f}) px/tick"
    assert numbers(figure)["speed before"] == shown["speed after"], "nothing was touched"


def test_one_tick_waits_and_goes_call_by_call_both_ways() -> None:
    figure = OneTick()
    figure.nudge(1, 0)
    figure.nudge(1, 0)
    assert (figure.at, figure.speed) == (2, 0)
    for _ in range(40):
        figure.tick()
    figure.nudge(-1, 0)
    assert figure.at == 1
    figure.press(100, 100)
    assert figure.at == 2
    for _ in range(5):
        figure.nudge(-1, 0)
    assert figure.at == 0, "not before the tick"
    figure.reset()
    assert figure.speed > 0


def test_cells_touched() -> None:
    figure = CellsTouched()
    for x, y, count in ((60, 60, 1), (60, 71, 2), (71, 60, 2), (71, 71, 4), (62.1, 62.1, 4)):
        figure.drag(x, y)
        assert numbers(figure)["cells touched"].startswith(f"{count}:")
    assert numbers(figure)["current cell"] == f"column 2, row 2, index {cell_at(62.1, 62.1)}"


def test_edge_states_follow_paint_and_door() -> None:
    figure = EdgeStates()
    before = list(figure.world.edges)
    figure.is_open = True
    changed = [index for index, state in enumerate(figure.world.edges) if state != before[index]]
    door = figure.world.objects[figure._door]
    assert sorted(changed) == sorted((door.edge_1, door.edge_2))

    figure.tile = 5
    figure.press(60, 60)
    for side in range(4):
        figure.side = side
        cell, neighbour = figure.cell, figure.cell + NEIGHBOUR_OFFSET[side]
        assert figure.tiles.ids[cell] == 5
        own, other = FACE[4 * 5 + side], FACE[4 * figure.tiles.ids[neighbour] + (side ^ 2)]
        assert numbers(figure)["3. the state"] == EDGE_WORDS[EDGE_OF_FACES[3 * own + other]]
    assert figure.is_open, "painting moves no door"
    figure.press(60, 60)
    assert figure.tiles.ids[figure.cell] == 0


@pytest.mark.parametrize("box", [False, True])
def test_projection_shows_what_the_collision_does(box: bool) -> None:
    figure = Projection()
    figure.box = box
    for tile in range(1, 34):
        figure.tile = tile
        for x, y in ((190.0, 122.0), (181.0, 108.0), (215.0, 140.0), (170.0, 132.0), (204.0, 150.0)):
            figure.drag(x, y)
            push = figure.push()
            _, world = room_world(["." * 14] * 9)
            n = world.ninja
            n.x, n.y, n.prev_x, n.prev_y, n.box = x, y, x, y, int(box)
            world.edges[:] = figure.world.edges
            (collide_box if box else collide_circle)(figure.tiles, world)
            assert push.points[-1] == pytest.approx((n.x, n.y), abs=1e-9)
            assert len(push.points) - 1 == sum(call.name == PUSH_RULE for call in push.calls)


def test_projection_counts_edges_and_shapes() -> None:
    figure = Projection()
    figure.tile = 1
    figure.drag(204, 114)
    assert (figure.push().edge_pushes, figure.push().shape_tests) == (1, 0), "a full tile's top is a solid edge"
    figure.tile = 2
    assert figure.push().shape_tests == 1, "a slope's is interesting"
    figure.tick()
    assert figure.shape_tests == 1


@pytest.mark.parametrize("tile", [3, 14])
def test_arrows_lead_from_a_body_to_every_way_out(tile: int, monkeypatch: pytest.MonkeyPatch) -> None:
    figure, arrows = Projection(), list[Any]()
    figure.tile = tile
    figure.drag(190, 122)
    ways = [way for call in figure.push().calls for way in candidates(call)]
    monkeypatch.setattr(Sheet, "arrow", lambda _, colour, a, b, width=2: arrows.append((colour, a, b)))
    theme = Theme(PALETTES["classic"], Canvas((792, 600)))
    figure.draw(Sheet(pygame.Surface((792, 600)), theme, figure.view))
    x, y = figure.x, figure.y
    assert ways
    assert [(a, b) for colour, a, b in arrows if colour == theme.palette.faint] == [
        ((x, y), (x + dx, y + dy)) for dx, dy in ways
    ]


def test_loose_and_normal_grid_are_counted_as_a_plain_reading_counts() -> None:
    figure = LooseGrid()
    figure.count = 80
    crowd = figure.crowd
    for _ in range(5):
        before = {o.slot: (o.cell, crowd.cells_of(o)) for o in crowd.objects}
        figure.tick()
        loose = sum(2 for o in crowd.objects if o.cell != before[o.slot][0])
        normal = sum(len(before[o.slot][1] ^ crowd.cells_of(o)) for o in crowd.objects)
        around = {(dx, dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)}
        offsets = {dx + STRIDE * dy for dx, dy in around}
        loose_tests = sum(b.cell - a.cell in offsets for a in crowd.objects for b in crowd.objects if a is not b)
        normal_tests = sum(
            len(crowd.cells_of(a) & crowd.cells_of(b)) for a in crowd.objects for b in crowd.objects if a is not b
        )
        assert figure.works == ((loose, loose_tests), (normal, normal_tests))
        assert all(o.cell == cell_at(o.x, o.y) for o in crowd.objects)
    assert loose < normal


def test_nine_cells_tell_those_and_leave_the_world_alone() -> None:
    figure = NineCells()
    digest = world_digest(figure.world)
    for tick in demonstrated(figure, 60):
        tested, events = figure.objects_tested()
        centre = cell_at(figure.x, figure.y)
        near = {centre + dx + STRIDE * dy for dx in (-1, 0, 1) for dy in (-1, 0, 1)}
        objects = figure.world.objects[1 : figure.world.slots_used]
        reached = {o.slot for o in objects if o.in_grid and o.cell in near}
        # Gold that is taken ends the walk of its list: the quirk is the world's, and so the figure's.
        if tick > 40:
            assert set(tested) < reached
            assert events == ["gold-taken", "gold-taken"]
        else:
            assert set(tested) == reached
    assert world_digest(figure.world) == digest
    gold, mine = figure.world.objects[1:3]
    figure.drag(gold.x, gold.y)
    assert numbers(figure)["events"] == "gold-taken"
    figure.drag(mine.x, mine.y)
    assert numbers(figure)["events"] == "died, mine-exploded"


def test_five_cells_find_every_pair_once() -> None:
    figure = FiveCells()
    figure.count, figure.speed = 150, 40
    while not figure.done:
        figure.tick()
    objects = figure.crowd.objects
    truth = {(a.slot, b.slot) for a, b in combinations(objects, 2) if dist((a.x, a.y), (b.x, b.y)) < 22}
    assert len(truth) > 20
    assert sorted(figure.found) == sorted(truth)
    shown = numbers(figure)
    assert (shown["found twice"], shown["missed"]) == ("0", "0")
    assert len(figure.tested) < 150 * 149 / 4


def test_bullets_hit_the_same_filed_or_not() -> None:
    reading, filed = Bullets(), Bullets()
    filed.filed = True
    for _ in range(20):
        reading.tick()
        filed.tick()
        assert reading.hits == filed.hits
        truth = sum(dist((b.x, b.y), (t.x, t.y)) < 10 for b in reading.bullets.objects for t in reading.targets.objects)
        assert reading.hits == truth
        assert reading.list_changes < filed.list_changes
        assert reading.tests < filed.tests


def test_rays_visit_the_cells_between_and_name_what_a_loose_grid_misses() -> None:
    figure, missed_ever = RayCast(), 0
    for _ in demonstrated(figure, 240):
        tested, stopped, end = figure.shapes_tested()
        reach = end if stopped else (figure.x, figure.y)
        start = figure.from_x, figure.from_y
        along = [
            cell_at(start[0] + (reach[0] - start[0]) * k / 4000, start[1] + (reach[1] - start[1]) * k / 4000)
            for k in range(4000)
        ]
        assert set(along) <= set(figure.visited)
        assert set(tested) <= set(figure.visited)
        seen = sees(figure.tiles, figure.world, *start, figure.x, figure.y)[0]
        assert numbers(figure)["sees the ninja"] == ("yes" if seen else "no")
        _, missed = figure.met()
        missed_ever += len(missed)
        for slot in missed:
            o = figure.world.objects[slot]
            length = dist(start, (figure.x, figure.y))
            direction = (figure.x - start[0]) / length, (figure.y - start[1]) / length
            assert ray_circle(*start, *direction, o.x, o.y, GOLD_RADIUS)[0]
            assert o.cell not in along
    assert missed_ever


def test_drones_walk_as_in_the_game_and_react_to_doors() -> None:
    figure = WalkingEnemies()
    plain = Simulation(figure.stage.simulation.level, memory="plain")
    for _ in range(200):
        figure.tick()
        plain.step()
    assert world_digest(plain.world) == world_digest(figure.stage.world)
    for o in figure.of_kind(DRONE):
        tried = figure.tried(o)
        assert tried[-1][1] == 0, "it goes where the edge is off"
        assert all(state for _, state in tried[:-1])
    inside = figure.of_kind(DRONE)[1]
    assert 72 < inside.x < 264
    for door in figure.of_kind(DOOR):
        figure.press(24 * (door.edge_1 // 4 % STRIDE - 1) + 12, 24 * (door.edge_1 // 4 // STRIDE - 1) + 12)
    assert numbers(figure)["doors open"] == "2 of 2"
    for _ in range(600):
        figure.tick()
        if not (72 < inside.x < 264 and 72 < inside.y < 168):
            break
    else:
        pytest.fail("it never went out by the open door")


def test_one_tick_shows_every_call_of_the_real_world() -> None:
    figure = OneTick()
    plain = Simulation(room_level(figure.room, figure.objects), memory="plain")
    seen = set()
    for tick in range(len(LAB_INPUTS)):
        plain.step_keys(LAB_INPUTS[tick])
        assert world_digest(plain.world) == world_digest(figure.stage.world)
        phases = []
        for at in range(len(figure.calls)):
            figure.at = at
            phases.append(figure.phase)
        begun = [number for number, _ in phases if number]
        assert begun == sorted(begun), "phases come in their order"
        seen |= set(phases)
        figure.nudge(0, 1)
    assert set(PHASES.values()) <= seen


# --- the screen ---


def test_the_lab_by_keys_and_mouse(driver: MenuDriver) -> None:
    driver.open("Help")
    driver.choose("How it works")
    screen = driver.shown(LabScreen)
    driver.frames(10)
    driver.press("down", "down", "down")
    assert screen.figure.name == "projection"
    driver.press("return")
    assert isinstance(screen.focus, FigureArea)
    x = screen.figure.x
    driver.press("right", "right")
    assert screen.figure.x == x + 2
    assert not screen.shows
    for kind, place in (
        (pygame.MOUSEBUTTONDOWN, (400, 200)),
        (pygame.MOUSEMOTION, (420, 220)),
        (pygame.MOUSEBUTTONUP, (420, 220)),
    ):
        pygame.event.post(pygame.Event(kind, pos=place, button=1, rel=(0, 0), buttons=(1, 0, 0)))
        driver.frames(1)
    left, top, zoom = screen.figure.view
    assert (screen.figure.x, screen.figure.y) == (
        left + (420 - FIGURE_AREA[0]) / zoom,
        top + (220 - FIGURE_AREA[1]) / zoom,
    )
    driver.press("pagedown", "right")
    assert isinstance(screen.figure, Projection)
    assert screen.figure.tile == 3
    screen.reset()
    assert (screen.figure.x, screen.figure.y) == screen.figure.start
    driver.press("escape")
    assert driver.top() is not screen


def test_the_mouse_presses_and_drags_a_figure_in_its_own_px(
    driver: MenuDriver, monkeypatch: pytest.MonkeyPatch
) -> None:
    driver.open("Help")
    driver.choose("How it works")
    screen = driver.shown(LabScreen)
    left, top, zoom = screen.figure.view
    x, y = FIGURE_AREA[0] + 30 * zoom, FIGURE_AREA[1] + 40 * zoom
    called: list[tuple[str, float, float]] = []
    for name in ("press", "drag"):
        monkeypatch.setattr(screen.figure, name, lambda x, y, name=name: called.append((name, x, y)))
    area = next(each for each in screen.widgets if isinstance(each, FigureArea))
    area.click(x, y)
    area.drag(x + zoom, y - zoom)
    assert called == [("press", left + 30, top + 40), ("drag", left + 31, top + 39)]
