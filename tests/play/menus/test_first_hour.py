"""What a new player learns and is offered: texts of levels, causes of death, open levels, runs to race against."""

from collections.abc import Callable
from dataclasses import replace
from math import hypot
from pathlib import Path
from unittest.mock import patch

import pygame
import pytest

from ninja_game.formats.ascii.reader import room_level
from ninja_game.formats.load import load_levels
from ninja_game.formats.messages import LevelMessage, Moment, parse_messages
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.replay.input_text import read_inputs
from ninja_game.play.level.hud_view import cause_of_death, hud_view
from ninja_game.play.level.level_play import DEATH_PAUSE, STUCK_AFTER, Phase, things_at_start
from ninja_game.play.level.screen import LevelScreen, PausePanel, play_level
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.menu_screen import Menu
from ninja_game.play.menus.browser import Browser
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.player.episode_playthrough import EpisodePlaythrough
from ninja_game.player.playthrough import LevelPlaythrough
from ninja_game.runs.advice import CLIMB, CLIMBED, FALL_HELP, QUIET_TICKS, Advice
from ninja_game.runs.deaths import SELF
from ninja_game.runs.message_queue import _FADE_TICKS, START_TICKS, USUAL_TICKS, MessageQueue, in_two, read_ticks
from ninja_game.sim.events import EXIT_OPENED, GOLD_TAKEN, LOCK_OPENED, TRAP_CLOSED
from ninja_game.sim.grid import cell_of, middle_of
from ninja_game.sim.kinds import EXIT, SWITCH
from ninja_game.sim.level import ROWS
from ninja_game.sim.rules import CELL, TICKS_PER_SECOND
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import CLASSIC, Theme
from ninja_game.ui.widgets import Button
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


def test_each_text_has_its_moment(driver: MenuDriver) -> None:
    says = parse_messages("start: go | switch: open | gold: gold | death 2: wait")
    messages = MessageQueue(says)
    simulation = Simulation(short_level(gold=1))
    seen = [messages.text]
    for _ in range(60 + USUAL_TICKS):
        simulation.step_keys(2)
        if messages.on_tick(simulation.world):
            seen.append(messages.text)
    assert seen in (["go", "gold", "open"], ["go", "open", "gold"])
    for _ in range(START_TICKS + USUAL_TICKS):
        messages.on_tick(simulation.world)
    assert messages.text == ""
    messages.at_start()
    assert messages.text == "", "the switch was touched: the start needs no words any more"
    messages.on_death()
    messages.on_death()
    messages.at_start()
    assert messages.text == "wait"


def test_what_interrupts_a_text_of_the_start_ends_it_till_the_next_start() -> None:
    messages = MessageQueue(parse_messages("start: go | gold: gold"))
    simulation = Simulation(parse_level_string("0" * 713 + "|5^100,566!0^120,566!11^400,564,500,564"))
    seen = []
    for tick in range(START_TICKS + USUAL_TICKS + 1):
        simulation.step_keys(2 if tick < 8 else 0)
        if messages.on_tick(simulation.world):
            seen.append((tick, messages.text))
    assert [text for _, text in seen] == ["gold", ""]
    messages.at_start()
    assert messages.text == "go"
    messages = MessageQueue(parse_messages("start: go | death 1: again"))
    messages.on_death()
    messages.at_start()
    assert messages.text == "again"
    simulation.reset()
    assert [messages.text for _ in range(START_TICKS) if messages.on_tick(simulation.world)] == ["go", ""]


def test_several_texts_of_one_moment_are_said_one_after_the_other() -> None:
    says = "start: one | start: two | switch: three | switch: four"
    simulation = Simulation(parse_level_string("0" * 713 + "|5^100,566!0^120,566!11^400,564,700,564"))
    messages = MessageQueue(parse_messages(says))
    heard = [(0, messages.text)]
    simulation.step_keys(0)
    ticks = range(1, START_TICKS + 9)
    heard += [(tick, messages.text) for tick in ticks if messages.on_tick(simulation.world)]
    assert heard == [(0, "one"), (START_TICKS // 2, "two"), (START_TICKS, "")]
    messages.at_start()
    simulation.world.events[0].kind, simulation.world.event_count = EXIT_OPENED, 1
    assert messages.on_tick(simulation.world)
    simulation.world.event_count = 0
    heard = [(tick, messages.text) for tick in range(START_TICKS) if messages.on_tick(simulation.world)]
    assert messages.text == ""
    assert [text for _, text in heard] == ["four", ""], "and no more of the start, which is understood"
    quick = MessageQueue(parse_messages("switch: one | switch: two | gold: three"))
    texts = []
    for kind in (EXIT_OPENED, GOLD_TAKEN, None):
        simulation.world.event_count = int(kind is not None)
        simulation.world.events[0].kind = kind or 0
        texts += [quick.text for _ in range(1 if kind else 2 * START_TICKS) if quick.on_tick(simulation.world)]
    assert texts == ["one", "three", "two", ""], "what has just happened comes at once, and takes nothing away"


def test_a_place_has_its_bubble_beside_what_just_happened_and_neither_waits() -> None:
    long = "Gold adds two seconds to the clock; " * 3
    says = parse_messages(f"start: go | gold: {long} | lock: open | at 3,22: Here | trap: shut")
    queues = [MessageQueue(messages) for messages in in_two(says)]
    world = Simulation(room_level(["#@..#"], ())).world
    heard: list[list[tuple[int, str]]] = [[], []]
    for tick in range(2 * START_TICKS):
        world.event_count = int(tick in (0, 40, 50))
        world.events[0].kind = {0: GOLD_TAKEN, 40: TRAP_CLOSED}.get(tick, LOCK_OPENED)
        world.ninja.x = 84.0 if 60 < tick < 300 else 400.0
        world.ninja.y = 540.0
        for queue, texts in zip(queues, heard, strict=True):
            if queue.on_tick(world):
                texts.append((tick, queue.text))
    assert read_ticks(long.strip()) == 8 * TICKS_PER_SECOND
    assert heard[0][:3] == [(0, long.strip()), (40, "shut"), (50, "open")], "the newest, at once"
    assert heard[1] == [(61, "Here"), (299 + _FADE_TICKS, "")], "as long as the ninja is there"


def places_heard(says: str, cell_in_tick: Callable[[int], float], ticks: int) -> list[tuple[int, str]]:
    """The texts of places, and when they come, while the ninja stands in such columns of row 22."""
    queued, world = MessageQueue(parse_messages(says)), Simulation(room_level(["#@..#"], ())).world
    heard = []
    for tick in range(ticks):
        world.ninja.x, world.ninja.y = 24 * cell_in_tick(tick) + 12, 540.0
        heard += [(tick, queued.text)] if queued.on_tick(world) else []
    return heard


def test_who_runs_past_two_places_sees_both_and_the_first_again_on_the_way_back() -> None:
    """At three cells in ten ticks; both need three seconds to be read."""
    heard = places_heard("at 5,22: One | at 11,22: Two", lambda tick: min(tick, 80 - tick) * 0.3, 80)
    assert heard == [(9, "One"), (29, "Two"), (55, "One")], "at the edges of their frames"


@pytest.mark.parametrize("marks, texts", [("", ["One", "Two", "One", ""]), ("!", ["One", "Two", ""])])
def test_of_two_places_with_the_ninja_the_one_reached_last_comes_first_unless_one_is_important(
    marks: str, texts: list[str]
) -> None:
    heard = places_heard(f"at 5,22{marks}: One | at 7,22: Two", lambda tick: 4 if tick < 20 else 6, 1000)
    read = read_ticks("One")
    assert heard[:2] == [(0, "One"), (read if marks else 20, "Two")]
    assert [text for _, text in heard][: len(texts) - 1] == texts[:-1]
    if not marks:
        assert heard[2] == (20 + read, "One"), "it was not read, and the ninja is still there"


def test_two_texts_of_one_place_come_one_after_the_other() -> None:
    heard = places_heard("at 3,22: One | at 3,22: Two", lambda _: 3, 600)
    assert heard == [(0, "One"), (USUAL_TICKS, "Two")]


def test_what_a_death_kept_from_being_said_is_said_when_it_happens_again() -> None:
    queued, world = MessageQueue(parse_messages("gold: one | gold: two")), Simulation(short_level()).world
    world.event_count, world.events[0].kind = 1, GOLD_TAKEN
    queued.on_tick(world)
    assert queued.text == "one"
    queued.on_death()
    queued.at_start()
    assert queued.text == ""
    assert queued.on_tick(world)
    assert queued.text == "two"


def test_a_time_that_was_replaced_before_it_was_read_comes_again() -> None:
    queued = MessageQueue(parse_messages("after 1 s: Time | gold: Gold | trap: Shut"))
    run, seen, need = Simulation(room_level(["#@..#"], ())), [], read_ticks("Gold")
    for tick in range(1, 5 * USUAL_TICKS):
        run.step_keys(0)
        run.world.event_count = int(tick in (1, 150))
        run.world.events[0].kind = GOLD_TAKEN if tick == 1 else TRAP_CLOSED
        seen += [(tick, queued.text)] if queued.on_tick(run.world) else []
    assert seen[:4] == [(1, "Gold"), (1 + need, "Time"), (150, "Shut"), (150 + need, "Time")]


def test_what_just_happened_waits_until_an_important_message_was_read() -> None:
    told = MessageQueue(parse_messages("start: Go on | lock!: One | gold: Gold | trap!: Shut"))
    world = Simulation(room_level(["#@..#"], ())).world
    seen, kinds = [], {0: LOCK_OPENED, 20: GOLD_TAKEN, 40: TRAP_CLOSED}
    for tick in range(9 * USUAL_TICKS):
        world.event_count, world.events[0].kind = int(tick in kinds), kinds.get(tick, 0)
        seen += [(tick, told.text)] if told.on_tick(world) else []
    assert seen[:2] == [(0, "One"), (40, "Shut")], "another important one replaces it, no gold"
    assert [text for _, text in seen[2:]] == ["Gold", ""]


def test_all_gold_and_a_number_of_gold_have_their_moments() -> None:
    level = parse_level_string("0" * 713 + "|5^100,566!0^200,566!0^300,566!0^400,566!11^700,64,700,264")
    run, came = Simulation(level), dict[str, int]()
    queues = [MessageQueue([message]) for message in parse_messages("all gold: All | gold 2: Two | gold: One")]
    for _ in range(200):
        run.step_keys(2)
        came |= {queue.text: run.world.gold for queue in queues if queue.on_tick(run.world)}
    assert came == {"One": 1, "Two": 2, "All": 3}


def test_text_comes_after_its_seconds_once_and_stays_as_long_as_it_says() -> None:
    messages = MessageQueue(parse_messages("after 2 s for 3 s: slide"))
    simulation = Simulation(parse_level_string("0" * 713 + "|5^100,566!11^400,564,700,564"))
    for times in (1, 0):
        heard = []
        for tick in range(1, 10 * TICKS_PER_SECOND):
            simulation.step_keys(0)
            heard += [(tick, messages.text)] if messages.on_tick(simulation.world) else []
        assert heard == [(2 * TICKS_PER_SECOND, "slide"), (5 * TICKS_PER_SECOND, "")] * times
        simulation.reset()
        messages.at_start()


def test_text_at_a_place_does_not_lie_over_the_ninja_that_has_come_there(driver: MenuDriver) -> None:
    driver.press("return")
    level, hud = driver.shown(LevelScreen), Hud(driver.app.theme)
    level.begin()
    play, (here,) = level.play, parse_messages("at 16,12: Jump up here")
    play.places.text, play.places.message, play.things = here.text, here, ()
    x, y, w, h = hud.box(hud_view(play).bubble or PlacedMessage("", (), (), None, covers=False)).area
    for spot in ((x + 4, y + 4), (x + w - 4, y + h - 4), (x + w / 2, y + h / 2)):
        play.places.spot = spot
        placed = hud_view(play).bubble
        assert placed
        assert away_from(spot, *hud.box(placed).area) > 10


def test_text_at_a_place_is_said_there_once() -> None:
    simulation = Simulation(short_level())
    column = int(simulation.world.ninja.x // 24)
    row = int(simulation.world.ninja.y // 24)
    near, far = (
        MessageQueue(parse_messages(f"at {column},{row}: here")),
        MessageQueue(parse_messages(f"at {column + 5},{row}: there")),
    )
    simulation.step_keys(0)
    assert near.on_tick(simulation.world)
    assert not far.on_tick(simulation.world)
    assert (near.text, far.text) == ("here", "")


@pytest.mark.parametrize(
    "source, stays, ticks",
    [
        ("", 0, read_ticks("Here") + _FADE_TICKS), ("", 500, 500 + _FADE_TICKS),
        (" for 1.5 s", 0, 60), (" for 1.5 s", 500, 60),
    ],
)  # fmt: skip
def test_text_at_a_place_fades_when_the_ninja_has_left_and_it_was_read(source: str, stays: int, ticks: int) -> None:
    queued = MessageQueue(parse_messages(f"at 3,22{source}: Here"))
    ninja = (world := Simulation(room_level(["#@..#"], ())).world).ninja
    ninja.x, ninja.y = 84.0, 540.0
    assert queued.on_tick(world)
    solid: list[float] = []
    while queued.text:
        ninja.x = 84.0 + 61 * (len(solid) >= stays)
        solid.append(queued.opacity)
        queued.on_tick(world)
    assert len(solid) == pytest.approx(ticks, abs=2)
    assert solid[:-_FADE_TICKS] == [1.0] * (len(solid) - _FADE_TICKS)
    assert solid[-_FADE_TICKS:] == sorted(solid[-_FADE_TICKS:], reverse=True)
    assert solid[-1] < 0.1


def test_a_place_has_a_frame_of_its_size_and_a_wall_hides_it() -> None:
    room = Simulation(room_level(["#........#", "##########", "#@.......#"], ()))
    ninja = room.world.ninja
    middle, floor, above = 24 * 6 + 12.0, ninja.y, ninja.y - 48
    for source, x, y, seen in (
        ("at 6,3", middle, above, False), ("at 6,3", middle, floor, True), ("at 6,3", middle - 50, floor, True),
        ("at 6,3 3x1", middle - 50, floor, False), ("at 6,3 3x1", middle + 30, floor, True),
        ("at 6,2", middle + 30, above, True), ("at 6,3", middle - 70, floor, False),
        ("at 6,3 7x1", middle - 70, floor, True),
    ):  # fmt: skip
        queued = MessageQueue(parse_messages(f"{source}: Here"), room.tiles)
        ninja.x, ninja.y = x, y
        assert queued.on_tick(room.world) is seen, (source, x, y)


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
    level = stuck_level(driver)
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


def test_levels_of_a_locked_episode_are_locked_everywhere(driver: MenuDriver) -> None:
    browser = driver.opened("Levels", Browser)
    place = next(k for k, each in enumerate(browser.shown) if each.episode == "01-0")
    browser.list.select(place)
    assert not browser.play_button.enabled
    assert not browser.practice.enabled
    assert browser.practice.hint == "Finish 5 more levels of episode 1.1 first"
    browser.play(place)
    assert browser.message == "Finish 5 more levels of episode 1.1 first"
    assert driver.top() is browser
    for level in range(5):
        driver.player.progress.level_passed((0, level), legitimate=True)
        assert driver.player.lock_of(browser.shown[place]) == [
            *(f"Finish {left} more levels of episode 1.1 first" for left in (4, 3, 2)),
            "Finish 1 more level of episode 1.1 first", "",
        ][level]  # fmt: skip
    browser.play(place)
    assert isinstance(driver.top(), LevelScreen)


def test_play_goes_on_with_the_next_level(driver: MenuDriver) -> None:
    menu = driver.shown(MainMenu)
    assert isinstance(menu.focus, Button)
    assert (menu.focus.detail, menu.focus.hint) == ("Begin with First Steps", "Start at the very beginning")
    level = driver.open_level()
    level.begin()
    driver.play_replay(1)
    driver.press("q")
    assert driver.top() is menu
    assert isinstance(menu.focus, Button)
    assert (menu.focus.detail, menu.focus.hint) == ("Go on with Mind the Gap", "Go on where you left off")
    driver.press("return")
    assert driver.shown(LevelScreen).playthrough.lifetime > 3000, "with the time that was left"


@pytest.mark.parametrize("rows, title", [(0, "level 2: Mind the Gap"), (1, "level 1: First Steps")])
def test_episode_left_half_way_goes_on_or_begins_again(driver: MenuDriver, rows: int, title: str) -> None:
    driver.press("return")
    driver.shown(LevelScreen).begin()
    driver.play_replay(1)
    driver.press("q")
    driver.open("Episodes")
    driver.press("return", *["down"] * rows, "return")
    assert driver.shown(LevelScreen).playthrough.title == f"Episode 1.1, {title}"


@pytest.mark.parametrize("wanted, medal", [("silver", "silver"), ("author", "author"), ("next", "silver")])
def test_ghost_of_a_medal_just_earns_it(driver: MenuDriver, wanted: str, medal: str) -> None:
    driver.app.change_settings(ghost=wanted)
    first = driver.player.catalogue.episodes[0].levels[0]
    assert first.pars is not None
    assert play_level(driver.app, first) == ""
    level = driver.shown(LevelScreen)
    level.begin()
    (ghost,) = level.play.ghosts
    ticks = 0
    while not ghost.over:
        ghost.on_tick()
        ticks += 1
    assert ticks <= first.pars.par(medal) + 2
    assert ticks >= first.pars.par(medal) - 2


def test_gold_medal_opens_the_authors_run(driver: MenuDriver) -> None:
    browser = driver.opened("Levels", Browser)
    first = browser.shown[0]
    assert first.pars is not None
    opened = []
    for late in (1, 0):
        driver.player.marks.passed(first.digest, first.pars.par("gold") + late, 0)
        browser.enter()
        opened.append(browser.watch_author.enabled)
    assert opened == [False, True]
    browser.watch_author.confirm()
    driver.shown(ReplayScreen)


def test_level_without_its_certificate_races_the_best_run(driver: MenuDriver) -> None:
    driver.app.change_settings(ghost="gold")
    own = replace(entry(short_level()), source="yours")
    assert LevelPlaythrough(driver.player, own).ghosts() == []


def stuck_level(driver: MenuDriver) -> LevelScreen:
    """The first level, after this many deaths that help is offered."""
    level = driver.open_level()
    for number in range(STUCK_AFTER):
        if number:
            level.retry()
        level.begin()
        driver.keys.script = [0] * 30
        driver.frames(30)
        assert not level.play.is_stuck
        level.give_up()
    driver.frames(DEATH_PAUSE + 3)
    return level


def test_nobody_is_stopped_by_one_level(driver: MenuDriver) -> None:
    level = stuck_level(driver)
    end = hud_view(level.play).end
    assert end
    assert end.lines[-1].endswith("N: get help")
    driver.press("n")
    assert [getattr(each, "text", "") for each in driver.shown(Menu).widgets] == [
        "Try again", "Watch how", "Slow down to 70%", "Skip this level",
    ]  # fmt: skip
    driver.choose("Skip this level")
    run = level.playthrough
    assert isinstance(run, EpisodePlaythrough)
    assert driver.top() is level
    assert run.position == 1
    assert not run.whole
    driver.press("q")
    driver.press("return")
    assert driver.shown(LevelScreen).playthrough.title.endswith("Mind the Gap"), "play goes on behind it"


def test_slower_play_opens_what_follows_without_a_record(driver: MenuDriver) -> None:
    level = stuck_level(driver)
    driver.press("n")
    driver.choose("Slow down to 70%")
    assert driver.player.settings.game_speed == 70
    driver.press("n")
    driver.choose("Full speed")
    assert driver.player.settings.game_speed == 100
    level.attempt.assists.add("slow motion")
    level.playthrough.passed(level.attempt)
    assert driver.player.progress.columns[0].beaten == (0, 1)
    assert driver.player.marks.of(level.playthrough.entry.digest) is None


def test_help_with_a_level_can_always_be_asked_for_and_says_what_is_not_possible(driver: MenuDriver) -> None:
    level = driver.open_level()
    for begun, keys in ((False, ["n"]), (True, ["n"]), (True, ["escape", "down", "down", "return"])):
        level.retry()
        if begun:
            level.begin()
        driver.press(*keys)
        menu = driver.shown(Menu)
        hints = {each.text: each.hint for each in menu.widgets if isinstance(each, Button)}
        assert f"Watch how (after {STUCK_AFTER} failed tries)" in hints
        assert hints["Skip this level"] == "The next one opens. This one counts only once you pass it"
        tick = level.attempt.simulation.tick
        driver.frames(5)
        assert level.attempt.simulation.tick == tick
        driver.press("escape")
        if begun:
            assert isinstance(driver.top(), PausePanel), "play does not go on by itself"
            assert level.phase is Phase.PAUSED
            driver.press("escape")
        assert driver.top() is level
        assert level.phase is (Phase.PLAY if begun else Phase.READY)
    level.retry()
    driver.press("escape", "down", "down", "return", "escape")
    panel = driver.shown(PausePanel)
    assert panel.focus is panel.widgets[2], "help goes back to where it was asked for"
    driver.press("escape")
    assert level.phase is Phase.READY
    driver.press("n", "down", "return")
    assert driver.shown(Menu).focus, "what is off does nothing"


def test_a_win_in_levels_leads_to_the_next_one_that_is_open(driver: MenuDriver) -> None:
    browser = driver.opened("Levels", Browser)
    level = driver.open_level()
    titles = []
    for number in (1, 2):
        level.begin()
        driver.play_replay(number)
        assert level.phase is Phase.PASSED
        titles.append(level.playthrough.title)
        end = hud_view(level.play).end
        assert end
        assert end.lines[-1].startswith("Space: next level    R: play again")
        driver.press("return")
    assert titles == ["First Steps", "Mind the Gap"]
    driver.press("q")
    last = next(k for k, each in enumerate(browser.shown) if each.place == "Episode 1.1, level 5")
    browser.play(last)
    playthrough = driver.shown(LevelScreen).playthrough
    assert playthrough.has_next == any(not driver.player.lock_of(each) for each in browser.shown[last + 1 :])


def test_text_in_play_lies_over_rock_near_the_ninja_or_else_in_the_border(driver: MenuDriver) -> None:
    level = driver.open_level()
    level.begin()
    hud = Hud(driver.app.theme)
    (text, tiles, things, _, covers, *_), far = hud_view(level.play).message or ("", (), (), None, False), []
    assert covers, "the text of the start stays where it was"
    level.play.messages._say(("Another one", 99, None))
    level.play.messages.spot = (40, 500)
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
    level.play.places.spot = (10.0, 10.0)
    view = hud_view(level.play)
    assert view.bubble
    assert view.bubble[3:] == (place, False, (place[0] - 60, place[1] - 60, 120, 120), None, ())
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


def test_a_place_is_said_once_and_again_only_if_the_try_ended_before_it_was_read() -> None:
    queued = MessageQueue(parse_messages("at 3,22: Here"))
    assert queued.place is None
    simulation = Simulation(room_level(["#@..#"], ()))
    simulation.world.ninja.x, simulation.world.ninja.y = 84.0, 540.0
    came = []
    for ticks in (20, 70, 50, 20):
        came.append([queued.text for _ in range(ticks) if queued.on_tick(simulation.world)])
        assert queued.place == ((84.0, 540.0) if came[-1] else None)
        queued.on_death()
        queued.at_start()
        assert (queued.text, queued.place) == ("", None)
    assert came == [["Here"], ["Here"], ["Here"], []], "the third try was long enough"
    queued.say_again()
    assert queued.on_tick(simulation.world)


WELL = room_level(["#...#"] * 10 + ["#@..#"], ())


def climb(keys: str) -> tuple[list[str], float]:
    """The messages in a well with these keys, and the greatest height, px."""
    simulation, messages = Simulation(WELL), MessageQueue((), advice=Advice())
    seen, floor, height = [], simulation.world.ninja.y, 0.0
    for each in read_inputs([(1, keys)]).keys:
        simulation.step_keys(each)
        height = max(height, floor - simulation.world.ninja.y)
        if messages.on_tick(simulation.world) and messages.text:
            seen.append(messages.text)
    return seen, height


SLIP = ".*40 R*12 RJ*20 R*20 L*60 "


def test_who_slips_down_a_wall_twice_sees_what_the_keys_do_at_it() -> None:
    right, left = (CLIMB % names for names in (("{right}", "{left}"), ("{left}", "{right}")))
    assert climb(SLIP)[0] == []
    assert climb(SLIP * 2)[0] == [right]
    assert climb(SLIP * 2 + ".*500 " + SLIP * 2)[0] == [right, right], "it comes back"
    assert climb(2 * ".*40 L*12 LJ*20 L*20 R*60 ")[0] == [left]
    assert climb(".*40 R*12 RJ*20 R*20 L*60 " + ".*40 RJ*30 .*40 " * 6)[0] == []


def test_help_with_walls_is_gone_once_the_climb_is_done() -> None:
    simulation, messages = Simulation(WELL), MessageQueue((), advice=Advice())
    for each in read_inputs([(1, SLIP * 2)]).keys:
        simulation.step_keys(each)
        messages.on_tick(simulation.world)
    assert messages.text
    floor = simulation.world.ninja.y
    for each in read_inputs([(1, "R*12 RJ*20 R*18 " + "RJ*20 R*8 " * 5)]).keys:
        simulation.step_keys(each)
        messages.on_tick(simulation.world)
        if not messages.text:
            break
    assert floor - simulation.world.ninja.y == pytest.approx(CLIMBED, abs=CELL), "not after so long, but there"


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


def test_last_level_of_an_episode_left_out_leads_to_the_next_episode(driver: MenuDriver) -> None:
    level = driver.open_level()
    run = level.playthrough
    assert isinstance(run, EpisodePlaythrough)
    count = len(run.episode.levels)
    for _ in range(count):
        driver.press("n")
        driver.choose("Skip this level")
    following = driver.player.catalogue.following(run.episode)
    assert following
    after = driver.shown(LevelScreen).playthrough
    assert isinstance(after, EpisodePlaythrough)
    assert (after.episode.key, after.position) == (following.key, 0)
    assert driver.app.notice == f"Skipped. Now episode {following.code}: {following.name}"
    last = driver.shown(LevelScreen)
    with patch.object(driver.player.catalogue, "following", lambda _: None):
        for _ in range(len(following.levels)):
            last.go_on()
    assert driver.app.notice == "That was the last episode"
    assert driver.top() is not last


def test_climbing_as_the_hint_says_works_and_away_from_the_wall_first_does_not() -> None:
    _, once = climb(".*40 R*12 RJ*20 R*20")
    assert climb(".*40 R*12 RJ*20 R*18 " + "RJ*20 R*8 " * 6)[1] > once + 100, (
        "towards the wall, jump held at each touch"
    )
    assert climb(".*40 R*12 RJ*20 R*18 " + "L*3 LJ*20 L*30 ")[1] <= once, "away first: no jump at all"
    assert climb(".*40 R*12 RJ*20 R*18 J*20 L*20")[1] > once + 10, "jump alone"


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
