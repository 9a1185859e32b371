"""What a new player reads: texts of levels and causes of death."""

from dataclasses import replace
from math import hypot
from pathlib import Path

import pygame
import pytest

from ninja_game.formats.load import load_levels
from ninja_game.formats.messages import LevelMessage, Moment, parse_messages
from ninja_game.play.level.hud_view import cause_of_death, hud_view
from ninja_game.play.level.level_play import Phase, TextSpot, things_at_start
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.player.playthrough import LevelPlaythrough
from ninja_game.runs.advice import CLIMB, FALL_HELP, QUIET_TICKS, Advice
from ninja_game.runs.deaths import SELF
from ninja_game.runs.message_queue import START_TICKS, MessageQueue
from ninja_game.sim.grid import cell_of, middle_of
from ninja_game.sim.kinds import EXIT, SWITCH
from ninja_game.sim.level import ROWS
from ninja_game.sim.rules import CELL
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import CLASSIC, Theme
from ninja_game.view.hud import BORDER_MESSAGE_TOP, CLEAR_AWAY, Hud, PlacedMessage, placed_message
from ninja_game.view.places import MUST, away_from, hidden_by, solid_place, tag_top
from tests.support.draw_log import DrawLog
from tests.support.menu_driver import MenuDriver
from tests.support.players import deadly_level, entry, short_level


def shown_message(level: LevelScreen) -> str:
    """What the level says on the screen now."""
    shown = hud_view(level.play).message
    return shown[0] if shown else ""


def test_first_level_says_its_goal_with_the_keys_of_whoever_plays(driver: MenuDriver) -> None:
    level = driver.open_level()
    assert shown_message(level).startswith("Left and Right run, ")
    assert "Touch the switch, then go through the exit" in shown_message(level)
    driver.app.controls.pad_used = True
    assert shown_message(level).startswith("D-pad left and ")
    driver.app.change_settings(level_texts=False)
    level.play.messages = MessageQueue(level.playthrough.messages())
    assert shown_message(level) == ""


def test_what_a_text_names_is_pointed_at_while_it_is_shown_and_until_it_is_done(driver: MenuDriver) -> None:
    level = driver.open_level()
    objects = level.attempt.simulation.world.objects
    places = {name: (x, y) for name, x, y in hud_view(level.play).named}
    assert places == {
        name: next((o.x, o.y) for o in objects[1:] if o.kind == kind)
        for name, kind in (("switch", SWITCH), ("exit", EXIT))
    }
    x, y = driver.app.canvas.point(places["switch"][0], places["switch"][1] - 20)
    assert driver.app.surface.get_at((x, y))[:3] == driver.app.theme.palette.accent[:3], "the arrow's tip is over it"
    door = next(o for o in objects[1:] if o.kind == EXIT)
    door.is_open = True
    level.begin()
    assert [name for name, _, _ in hud_view(level.play).named] == ["exit"]
    door.is_open = False
    for level.play.messages.text, names in (("Gold", []), ("The {exit} is above", ["exit"])):
        assert [name for name, _, _ in hud_view(level.play).named] == names, "a hidden switch stays hidden"
    ninja = level.attempt.simulation.world.ninja
    ninja.x, ninja.y = door.x, door.y - 30
    assert not hud_view(level.play).named, "never over the ninja"
    ninja.x -= 100
    level.play.phase = Phase.PASSED
    assert not hud_view(level.play).named
    driver.app.change_settings(level_texts=False)
    level.play.messages = MessageQueue(level.playthrough.messages())
    assert not hud_view(level.play).named


@pytest.mark.parametrize("reduced", [False, True])
def test_switch_sends_out_rings_until_it_is_touched(driver: MenuDriver, reduced: bool) -> None:
    driver.app.change_settings(reduced_motion=reduced)
    level = driver.open_level()
    level.play.messages.text = ""
    objects = level.attempt.simulation.world.objects
    switch = next(o for o in objects[1:] if o.kind == SWITCH)

    def ring() -> bool:
        driver.app.stack.redraw_all()
        driver.frames(1)
        x, y = driver.app.canvas.point(switch.x, switch.y)
        seen, ink = [driver.app.surface.get_at((x, y - 15 + k)) for k in range(4)], driver.app.theme.palette.exit
        return any(max(abs(a - b) for a, b in zip(each[:3], ink[:3], strict=True)) < 16 for each in seen)

    assert ring() is not reduced
    objects[switch.partner].is_open = True
    assert not ring()


def test_text_of_the_start_covers_what_is_solid_and_no_way() -> None:
    block = tuple(int(12 <= column < 30 and 11 <= row < 14) for column in range(31) for row in range(23))
    x, y, *_ = solid_place(block, 360.0, 59.0)
    assert 13 * 24 <= x <= 31 * 24 - 360
    assert 12 * 24 <= y <= 15 * 24 - 59
    assert solid_place((0,) * 713, 300.0, 39.0)[1] > 2 * 24, "in the open it is not along a wall"
    for thing in ((x + 10, y + 10, MUST), (x + 350, y - 8, MUST)):
        left, top, *_ = solid_place(block, 360.0, 59.0, (thing,))
        assert not (left < thing[0] < left + 360 and top < thing[1] < top + 59), "a thing is never covered"
    left, top, *_ = solid_place((1,) * 713, 120.0, 60.0, near=(600.0, 300.0))
    assert hypot(left + 60 - 600, top + 30 - 300) < 40, "of equal places the nearest"


def test_text_of_the_start_hides_neither_a_thing_nor_gold_nor_the_way(driver: MenuDriver) -> None:
    app, hidden, bands, texts = driver.app, [], 0, 0
    for each in app.player.catalogue.ours.levels:
        play = LevelScreen(app, LevelPlaythrough(app.player, each)).play
        shown = hud_view(play).message
        run = app.player.catalogue.author_run(each)
        if shown is None or run is None:
            continue
        hud = Hud(app.theme)
        box = hud.box(shown)
        card = hud.draw_message(app.surface, box)
        bands += abs(box.y - 28) < 1 or abs(box.y + box.line_height * len(box.lines) + 19 - 573) < 1
        texts += 1
        way, places = Simulation(each.named.level), [(o.x, o.y) for o in play.attempt.simulation.world.objects[1:]]
        for keys in run.inputs:
            way.step_keys(keys)
            places.append((way.world.ninja.x, way.world.ninja.y))
        hidden += [(each.title, place) for place in places if card.collidepoint(app.canvas.point(*place))]
    assert not hidden
    assert bands * 4 >= texts * 3, "along the upper or the lower border, but for few"


def test_goal_is_not_shown_again_in_a_level_that_was_passed(driver: MenuDriver) -> None:
    level = driver.open_level()
    level.begin()
    driver.play_replay(1)
    assert level.phase is Phase.PASSED
    assert not level.playthrough.messages()


def test_text_at_a_place_does_not_lie_over_the_ninja_that_has_come_there(driver: MenuDriver) -> None:
    driver.press("return")
    level, hud = driver.shown(LevelScreen), Hud(driver.app.theme)
    level.begin()
    play, (here,) = level.play, parse_messages("at 16,12: Jump up here")
    play.places.text, play.places.message, play.things = here.text, here, ()
    x, y, w, h = hud.box(hud_view(play).bubble or PlacedMessage("", (), (), None, covers=False)).area
    for spot in ((x + 4, y + 4), (x + w - 4, y + h - 4), (x + w / 2, y + h / 2)):
        play.spots[play.places] = TextSpot(spot)
        placed = hud_view(play).bubble
        assert placed
        assert away_from(spot, *hud.box(placed).area) > 10


def test_every_death_says_what_helps_until_the_level_is_passed(driver: MenuDriver) -> None:
    run = LevelPlaythrough(driver.player, entry(deadly_level()))
    driver.app.push(LevelScreen(driver.app, run))
    level = driver.shown(LevelScreen)
    texts = []
    for helps in (True, True, False):
        level.play.helps = helps
        level.begin()
        driver.keys.script = [2] * 60
        driver.frames(60)
        assert level.phase is Phase.DEAD
        texts.append(cause_of_death(level.play))
        level.retry()
    tip = "Killed by a mine", "Mines never move: give them some room."
    assert texts == [tip, tip, ("Killed by a mine", "")]


def test_who_is_still_for_long_reads_once_how_to_try_again_and_nobody_who_moves(driver: MenuDriver) -> None:
    level = driver.open_level()
    for keys, hinted in (([0] * (START_TICKS + QUIET_TICKS), True), ([2, 2, 1, 1] * 400, False)):
        heard = []
        for helps in (True, False):
            level.retry()
            level.play.messages._advice = Advice() if helps else None
            level.begin()
            driver.keys.script = [2] * 50 + list(keys)
            for _ in range(50 + len(keys)):
                driver.frames(1)
                heard.append(shown_message(level))
        assert ("Stuck? R starts the level over" in heard[: 50 + len(keys)]) == hinted
        assert "Stuck? R starts the level over" not in heard[50 + len(keys) :]
        assert heard[START_TICKS] != heard[0], "the text of the start is gone"
        assert "Stuck? R starts the level over" not in heard[: START_TICKS + QUIET_TICKS - 8], "not soon after a text"


@pytest.mark.parametrize("reduced", [False, True])
def test_a_text_under_which_the_ninja_comes_fades_while_it_is_there(driver: MenuDriver, reduced: bool) -> None:
    driver.app.change_settings(reduced_motion=reduced)
    level = driver.open_level()
    view = hud_view(level.play)
    assert view.message
    hud, surface = Hud(driver.app.theme), driver.app.surface
    _, x, y, w, *_ = hud.box(view.message)
    corner = driver.app.canvas.point(x + 8, y + 6)

    def shown(away: float) -> int:
        """How light the panel is over black, the ninja so far below its upper edge."""
        surface.fill("black")
        hud.draw(surface, replace(view, ninja=(x + w / 2, y - away), named=()))
        return surface.get_at(corner)[0]

    solid, near, half, under = map(shown, (60, 20, 16, -5))
    assert solid == driver.app.theme.palette.panel[0]
    assert under == pytest.approx(solid / 5, abs=4)
    assert (near, half) == (under, under) if reduced else under < half < near < solid


def test_texts_of_a_level_come_back_after_its_author_was_watched(driver: MenuDriver) -> None:
    level = driver.stuck_level()
    first = next(message.text for message in level.playthrough.messages() if message.when == "start")
    level.play.messages._shown.update(level.playthrough.messages())
    driver.press("n")
    driver.choose("Watch how")
    driver.shown(ReplayScreen)
    assert driver.app.notice == "Esc: back to your own try"
    driver.press("escape")
    assert first
    assert level.play.messages.text == first


def test_death_by_a_fall_says_what_helps_until_the_level_is_passed(driver: MenuDriver) -> None:
    level = LevelScreen(driver.app, LevelPlaythrough(driver.player, entry(deadly_level())))
    level.play.killer = SELF
    assert cause_of_death(level.play) == ("You hit the ground too hard", FALL_HELP)
    driver.player.marks.passed(level.playthrough.entry.digest, 100, 0)
    level = LevelScreen(driver.app, LevelPlaythrough(driver.player, entry(deadly_level())))
    level.play.killer = SELF
    assert cause_of_death(level.play) == ("You hit the ground too hard", "")


def test_text_in_play_lies_over_rock_near_the_ninja_or_else_in_the_border(driver: MenuDriver) -> None:
    level = driver.open_level()
    level.begin()
    hud = Hud(driver.app.theme)
    (text, tiles, things, _, covers, *_), far = hud_view(level.play).message or ("", (), (), None, False), []
    assert covers, "the text of the start stays where it was"
    level.play.messages._say(("Another one", 99, None))
    level.play.spots[level.play.messages] = TextSpot((40, 500))
    assert hud_view(level.play).message == PlacedMessage("Another one", tiles, things, (40, 500), covers=False)
    for about in ((40.0, 440.0), (750.0, 440.0)):
        lines, left, y, w, high, *_ = hud.box(PlacedMessage(text, tiles, things, about, covers=False))
        assert y < BORDER_MESSAGE_TOP
        cells = {(int(a // 24) - 1, int(b // 24) - 1) for a in (left, left + w) for b in (y, y + high * len(lines))}
        assert all(tiles[column * ROWS + row] == 1 for column, row in cells), "over rock only"
        far.append(left)
    assert far[0] < far[1]
    high_up = PlacedMessage("One" + 9 * " word", (0,) * 713, (), (396.0, 60.0), covers=False)
    shown = hud.draw_message(driver.app.surface, hud.box(high_up))
    assert shown.top < driver.app.canvas.px(120), "near the upper border, in the open too"
    assert not shown.collidepoint(driver.app.canvas.point(396, 60)), "but never over the ninja"
    everywhere = tuple((12.0 + 24 * x, 12.0 + 24 * y, MUST) for x in range(33) for y in range(25))
    assert hud.box(PlacedMessage(text, (0,) * 713, everywhere, None, covers=False)).y == BORDER_MESSAGE_TOP


@pytest.mark.parametrize("place", [(204.0, 516.0), (36.0, 36.0), (756.0, 564.0), (396.0, 300.0), (756.0, 36.0)])
@pytest.mark.parametrize("words", [2, 9, 22])
def test_what_is_said_of_a_place_lies_beside_it_and_points_to_it(
    driver: MenuDriver, place: tuple[float, float], words: int
) -> None:
    level, text = (
        LevelScreen(driver.app, LevelPlaythrough(driver.player, entry(short_level()))),
        " ".join(["word"] * words),
    )
    level.play.places._say((text, 99, LevelMessage(Moment.AT, text, cell=cell_of(*place))))
    level.play.spots[level.play.places] = TextSpot((10.0, 10.0))
    view = hud_view(level.play)
    assert view.bubble
    low = place[1] + 48 if place == (204.0, 516.0) else place[1]  # the floor is as far below as the frame
    assert view.bubble[3:] == ((place[0], low), False, (place[0] - 60, place[1] - 60, 120, 120), None, ())
    place = place[0], low
    hud, surface = Hud(driver.app.theme), driver.app.surface
    everywhere = tuple((12.0 + 24 * x, 12.0 + 24 * y, MUST) for x in range(33) for y in range(25))
    for tiles, things in (((0,) * 713, ()), ((1,) * 713, ()), ((0,) * 713, everywhere)):
        lines, x, y, w, high, margin, _ = hud.box(PlacedMessage(text, tiles, things, *view.bubble[3:]))
        h = high * len(lines) + 2 * margin - 1
        away = hypot(max(x - place[0], 0, place[0] - x - w), max(y - place[1], 0, place[1] - y - h))
        assert CLEAR_AWAY <= away <= 4.2 * CELL, "beside it, and solid while the ninja is there"
        assert 24 <= x < x + w <= 768
        assert 24 <= y < y + h <= 576
        surface.fill("black")
        placed = PlacedMessage(text, tiles, things, *view.bubble[3:])
        covered = hud.draw(surface, replace(view, bubble=placed, named=(), ninja=place))
        there = driver.app.canvas.point(*place)
        assert surface.get_at(there)[:3] == driver.app.theme.palette.accent[:3]
        assert any(rect.collidepoint(there) for rect in covered), "so it is taken away again"


def test_keys_of_the_help_bear_the_letters_that_its_words_name(driver: MenuDriver) -> None:
    level = driver.open_level()
    level.begin()
    level.play.messages.text, level.play.messages.message = CLIMB % ("{right}", "{left}"), None
    view = hud_view(level.play)
    assert view.letters[1] == driver.app.controls.name("jump") == "Z"
    log = DrawLog()
    with log.installed(), log.recording(driver.app.theme.palette) as lines:
        Hud(driver.app.theme).draw(driver.app.surface, view)
    assert sum(line.startswith("text 'Z' at") for line in lines) == 3


def test_text_of_the_start_covers_no_name_of_a_thing(driver: MenuDriver) -> None:
    level = driver.open_level()
    play, hud = level.play, Hud(driver.app.theme)
    text, tiles, *_ = hud_view(play).message or ("", ())
    named = [o for o in play.attempt.simulation.world.objects[1:] if o.kind in {SWITCH, EXIT}]
    assert text
    assert len(named) == 2
    for o in named:
        lines, left, y, w, high, margin, _ = hud.box(PlacedMessage(text, tiles, play.things, None, covers=True))
        middle = tag_top(o.y) + 8
        assert not (left < o.x < left + w and y < middle < y + high * len(lines) + 2 * margin)
        assert (o.x - 12, middle, MUST) in play.things


@pytest.mark.parametrize("near", [False, True])
def test_a_word_without_end_stays_in_the_window_in_the_largest_letters(*, near: bool) -> None:
    surface = pygame.Surface((792, 600))
    hud = Hud(Theme(CLASSIC, Canvas(surface.get_size()), 150))
    frame = (336.0, 240.0, 120.0, 120.0) if near else None
    box = hud.box(PlacedMessage("W" * 120, (0,) * 713, (), (396.0, 300.0), covers=True, frame=frame))
    left, top, w, h = box.area
    assert left >= 24
    assert left + w <= 768
    assert top + h <= 600
    assert surface.get_rect().contains(hud.draw_message(surface, box))


@pytest.mark.parametrize(
    "name, cell", [("03-3-the-zoo", (16, 14)), ("32-1-the-combination", (30, 7)), ("13-2-skyline", (17, 15))]
)
def test_a_short_text_beside_a_place_hides_no_exit_no_switch_and_no_enemy(name: str, cell: tuple[int, int]) -> None:
    level = load_levels(str(Path(__file__).parents[3] / "levels" / f"{name}.txt"))[0].level
    things, place = things_at_start(level, Simulation(level).world, [], b""), middle_of(cell)
    hud, here = Hud(Theme(CLASSIC, Canvas((792, 600)))), LevelMessage(Moment.AT, "Jump here", cell=cell)
    box = hud.box(placed_message(here.text, level.tiles, things, here, place, of_start=False))
    assert MUST not in hidden_by(things, *box.area)
    assert away_from(place, *box.area) <= 4.2 * CELL


@pytest.mark.parametrize(
    "cell, size, things, row",
    [
        ((5, 10), (3, 15), (), 17),
        ((5, 10), (3, 5), (), 10),
        ((5, 10), (3, 15), ((132.0, 252.0, MUST),), 10),
        ((5, 22), (5, 5), (), 22),
    ],
)
def test_a_place_in_the_air_has_its_tail_on_the_floor_of_its_frame(
    cell: tuple[int, int], size: tuple[int, int], things: tuple[tuple[float, float, int], ...], row: int
) -> None:
    """Unless a thing is there that the text can be about, or the floor is below the frame."""
    tiles = tuple(int(row in {17, 22}) for _ in range(31) for row in range(ROWS))
    here = LevelMessage(Moment.AT, "Here", cell=cell, size=size)
    assert placed_message("Here", tiles, things, here, None, of_start=False).place == middle_of((5, row))
