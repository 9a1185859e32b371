"""What a pass and a death look like: a freeze, a stamped medal, the failed tries, a wipe; all of it can be off."""

from unittest.mock import patch

import pygame
import pytest

from ninja_game.formats.ascii.reader import room_level
from ninja_game.formats.run_time import rounded_text, seconds_text
from ninja_game.play.level.hud_view import hud_view
from ninja_game.play.level.level_play import DEATH_PAUSE, STAMP_TICKS, TRIES_FROM, TRIES_TICKS, Phase
from ninja_game.play.level.passed import FEAST_TICKS, EpisodePassed
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.window import WIPE_MS
from ninja_game.player.episode_playthrough import EpisodePlaythrough
from ninja_game.player.playthrough import LevelPlaythrough
from ninja_game.sim.events import LANDED, MINE_EXPLODED
from ninja_game.sim.kinds import EXIT
from ninja_game.simulation import Simulation
from ninja_game.view.hud import END_MEDAL_SIZE, EndPanel, Hud, HudView, PlacedMessage
from ninja_game.view.level_view import DANCE_TICKS, DOOR_STEP, ENTER_TICKS, LevelView
from ninja_game.view.places import MUST
from tests.support.draw_log import DrawLog
from tests.support.menu_driver import FRAME_MS, MenuDriver
from tests.support.players import deadly_level, entry


@pytest.fixture
def heard(driver: MenuDriver, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of the sounds that were asked for."""
    names: list[str] = []
    monkeypatch.setattr(driver.app.audio_output, "play", lambda name, **_: names.append(name))
    return names


def passed_level(driver: MenuDriver, *, failures: int = 0) -> LevelScreen:
    """The first level, in the tick of its exit contact."""
    level = driver.open_level()
    first = driver.player.catalogue.episodes[0].levels[0]
    for ticks in range(30, 30 + failures):
        level.begin()
        driver.keys.script = [2] * ticks
        driver.frames(ticks)
        level.retry()
    level.begin()
    run = driver.player.catalogue.author_run(first)
    assert run is not None
    driver.keys.script = list(run.inputs)
    for _ in range(len(run.inputs) + 5):
        driver.frames(1)
        if level.attempt.outcome != "running":
            return level
    raise AssertionError("the level is not passed")


def picture(driver: MenuDriver) -> bytes:
    return pygame.image.tobytes(driver.app.surface, "RGB")


def test_picture_stands_still_for_two_frames_and_the_run_is_not_touched(driver: MenuDriver) -> None:
    level = passed_level(driver)
    tick, inputs = level.attempt.simulation.tick, bytes(level.attempt.inputs)
    driver.frames(2)
    assert level.attempt.simulation.tick == tick
    driver.frames(1)
    assert level.attempt.simulation.tick == tick + 1
    assert bytes(level.attempt.inputs) == inputs


def test_medal_comes_down_and_is_heard_when_it_lands(driver: MenuDriver, heard: list[str]) -> None:
    level = passed_level(driver)
    stamps = []
    for _ in range(40):
        stamps.append((level.play.after_end, level.play.stamp, heard.count("medal")))
        driver.frames(1)
    assert stamps == sorted(stamps)
    assert next(ticks for ticks, _, sounds in stamps if sounds) == STAMP_TICKS
    assert all((stamp == 1.0) == (ticks >= STAMP_TICKS) for ticks, stamp, _ in stamps)
    assert heard.count("medal") == 1
    assert hud_view(level.play).medal == "author"


def test_card_says_one_thing_large_one_next_and_the_rest_short(driver: MenuDriver) -> None:
    level = passed_level(driver)
    assert level.playthrough.pars
    par = level.playthrough.pars.par("gold")
    level.attempt.ended_tick = par + 1
    title, (medal, following, rest, clock, _), *_ = hud_view(level.play).end or EndPanel("", [""], (), ())
    assert title == f"Time {seconds_text(level.attempt.ended_tick)} s"
    assert (medal, following) == ("Silver medal", f"Gold medal: {seconds_text(par)} s, 0.025 s to go")
    assert rest == "1 of 5 gold"
    assert clock == f"{rounded_text(level.attempt.lifetime)} s left on the clock, for the next level"
    level.play.notices = ["New medal", "All gold"]
    assert "1 of 5 gold    New medal" in hud_view(level.play).end.lines  # type: ignore[union-attr]
    level.play.all_gold = 0
    assert "New medal" in hud_view(level.play).end.lines  # type: ignore[union-attr]
    level.play.notices = []
    assert len(hud_view(level.play).end.lines) == 4, "without gold no line is about it"  # type: ignore[union-attr]


def test_panel_of_an_end_has_one_place_unless_it_would_hide_that_end_or_an_exit(driver: MenuDriver) -> None:
    hud, surface = Hud(driver.app.theme), pygame.Surface((792, 600))

    def top_of(*things: tuple[float, float, int]) -> int:
        end = EndPanel("Time 1 s", ["Go on"], (0,) * 713, things)
        return hud.end_panel(surface, HudView(0, "", ("", ""), end=end), end).y

    assert top_of((396, 90, MUST)) == top_of() == top_of((396, 500, 9 * MUST))
    assert top_of((396, 90, 9 * MUST)) != top_of()
    level = passed_level(driver)
    _, _, _, things = hud_view(level.play).end or EndPanel("", [], (), ())
    exits = [(o.x, o.y, 9 * MUST) for o in level.attempt.simulation.world.objects[1:] if o.kind == EXIT]
    assert set(exits) <= set(things)


def test_an_episode_passed_is_a_feast_unless_motion_is_reduced(driver: MenuDriver, heard: list[str]) -> None:
    episode = driver.player.catalogue.episodes[0]
    for each in episode.levels:
        assert each.pars
        driver.player.marks.passed(each.digest, each.pars.par("silver"), 0)
    run = EpisodePlaythrough(driver.player, episode)
    screen = EpisodePassed(driver.app, run, lambda _: None)
    driver.app.push(screen)
    driver.frames(FEAST_TICKS + 2)
    assert screen.medal == "silver"
    assert heard == [*(f"gold-{place}" for place in range(1, 6)), "medal"]
    assert len(screen.particles.front) > 30
    seen = picture(driver)
    driver.frames(3)
    assert picture(driver) == seen, "it comes to rest"
    heard.clear()
    driver.app.pop()
    driver.app.change_settings(reduced_motion=True)
    screen = EpisodePassed(driver.app, run, lambda _: None)
    driver.app.push(screen)
    driver.frames(3)
    assert (heard, len(screen.particles.front)) == (["medal"], 0)


def test_a_text_in_the_border_leaves_room_for_the_name_of_the_level(driver: MenuDriver) -> None:
    placed = PlacedMessage(
        "Some words that say a lot about a level in which there is no rock at all",
        (0,) * 713,
        tuple((24.0 * column, 24.0 * row, MUST) for column in range(33) for row in range(25)),
        (396.0, 300.0),
        covers=False,
    )
    view = HudView(3600, "", ("Episode 1.1, level 1: Long Name", "gold 0 / 5"), name="Long Name", message=placed)
    log = DrawLog()
    with log.installed(), log.recording(driver.app.theme.palette) as lines:
        Hud(driver.app.theme).draw(pygame.Surface((792, 600)), view)
    drawn = "\n".join(lines)
    assert "text 'Long Name' at 24" in drawn
    assert "Episode 1.1" not in drawn


@pytest.mark.parametrize("cells, warned", [(5, False), (17, True)])
def test_lines_trail_behind_who_falls_too_fast_for_flat_ground(driver: MenuDriver, cells: int, warned: bool) -> None:
    simulation = Simulation(room_level([".@" + "." * 18, "###" + "." * 17, *["###" + "." * 17] * cells, "#" * 20], []))
    view = LevelView(driver.app, simulation)
    lines = 0
    for _ in range(120):
        simulation.step_keys(2)
        view.on_tick()
        trails = [each for each in view.particles.rear if each.kind == "plunge"]
        lines += bool(trails)
        if len(trails) > 8 and simulation.outcome == "running":
            surface = pygame.Surface(driver.app.surface.get_size())
            view.draw(surface, 1.0, whole=True)
            ink, (x, y) = driver.app.theme.palette.mine, driver.app.canvas.point(trails[-1].x, trails[-1].y - 20)
            seen = [surface.get_at((x + dx, y)) for dx in range(-3, 4)]
            assert any(max(abs(each[k] - ink[k]) for k in range(3)) < 60 for each in seen), "red, at the ninja"
    assert (lines > 0) == warned
    assert (simulation.outcome == "dead") == warned


def test_papers_fly_in_open_space_only(driver: MenuDriver) -> None:
    """At the exit beside a wall."""
    simulation = Simulation(room_level(["#####", "##@xX", "#####", "###.."], []))
    view = LevelView(driver.app, simulation)
    for _ in range(60):
        simulation.step_keys(2)
        view.on_tick()
        if simulation.outcome == "exit":
            break
    papers = [each for each in view.particles.front if each.kind == "confetti"]
    assert len(papers) > 30
    assert max(each.y + each.dy + each.fall for each in papers) <= 24 * 3
    assert min(each.x + each.dx for each in papers) >= 24 * 3


def test_failed_tries_run_together_for_two_seconds(driver: MenuDriver) -> None:
    level = passed_level(driver, failures=3)
    shown = []
    for _ in range(TRIES_FROM + TRIES_TICKS + 10):
        driver.frames(1)
        shown.append(len(level.play.view.ghosts))
    assert shown.count(3) == TRIES_TICKS
    assert shown[-1] == 0
    assert len(level.play.tries) == 3


def test_reduced_motion_has_none_of_it(driver: MenuDriver) -> None:
    driver.app.change_settings(reduced_motion=True)
    driver.app.wipes = True
    level = passed_level(driver, failures=2)
    tick = level.attempt.simulation.tick
    driver.frames(1)
    assert level.attempt.simulation.tick == tick + 1
    assert level.play.stamp == 1.0
    driver.frames(TRIES_FROM + 5)
    assert not level.play.view.ghosts
    level.go_on()
    driver.frames(1)
    assert driver.app.wipe.before is None


def test_wipe_shows_both_pictures_and_delays_no_key(driver: MenuDriver) -> None:
    driver.app.wipes = True
    before = picture(driver)
    level = driver.open_level()
    middle = picture(driver)
    driver.frames(WIPE_MS // FRAME_MS)
    after = picture(driver)
    right = [slice(3 * (792 * row + 700), 3 * 792 * (row + 1)) for row in range(600)]
    assert [middle[part] for part in right] == [before[part] for part in right] != [after[part] for part in right]
    level.go_on()
    level.begin()
    driver.keys.script = [2] * 4
    driver.frames(4)
    assert driver.app.wipe.before is not None
    assert bytes(level.attempt.inputs) == b"\2\2\2\2"


def test_cause_of_death_stands_large_at_once(driver: MenuDriver) -> None:
    driver.app.push(LevelScreen(driver.app, LevelPlaythrough(driver.player, entry(deadly_level()))))
    level = driver.shown(LevelScreen)
    level.begin()
    driver.keys.script = [2] * 60
    driver.frames(60)
    assert level.phase is Phase.DEAD
    title, lines, *_ = hud_view(level.play).end or EndPanel("", [], (), ())
    assert (title, lines[0]) == ("Killed by a mine", "Mines never move: give them some room.")
    for level.play.after_end in (0, DEATH_PAUSE + 1):
        end = hud_view(level.play).end or EndPanel("", [], (), ())
        assert end.lines == [lines[0], "Space or Z: try again    V: watch it"], "the panel has its size at once"


def test_panel_of_an_end_fades_in_as_a_whole_and_its_medal_hides_no_word(driver: MenuDriver) -> None:
    hud, empty = Hud(driver.app.theme), pygame.Surface((792, 600))
    end = EndPanel("Time 123456.8 s", ["Gold medal", "Go on"], (1,) * 713, ())

    def drawn(stamp: float, seen: float) -> tuple[pygame.Surface, pygame.Rect]:
        surface = empty.copy()
        view = HudView(0, "", ("", ""), end=end, medal="gold", stamp=stamp, end_opacity=seen)
        return surface, hud.end_panel(surface, view, end)

    whole, box = drawn(1.0, 1.0)
    assert pygame.image.tobytes(drawn(1.0, 0.0)[0], "RGB") == pygame.image.tobytes(empty, "RGB")
    half = drawn(1.0, 0.5)[0]
    assert abs(2 * half.get_at(box.center).r - whole.get_at(box.center).r) <= 2
    words = box.move(int(END_MEDAL_SIZE) + 30, 0).clip(box)
    for k in range(1, 10):
        surface, same = drawn(k / 10, 1.0)
        assert same == box
        assert pygame.image.tobytes(surface.subsurface(words), "RGB") == pygame.image.tobytes(
            whole.subsurface(words), "RGB"
        )
        surface.fill("black", box)
        assert pygame.image.tobytes(surface, "RGB") == pygame.image.tobytes(empty, "RGB"), "nothing sticks out of it"


@pytest.mark.parametrize("size", [100, 150])
def test_panel_of_an_end_leaves_free_where_the_run_ended(driver: MenuDriver, size: int) -> None:
    driver.app.change_settings(text_size=size)
    level = driver.open_level()
    hud, ninja = Hud(driver.app.theme), level.attempt.simulation.world.ninja
    for ninja.x in range(40, 792, 120):
        for ninja.y in range(40, 560, 90):
            level.begin()
            level.give_up()
            view = hud_view(level.play)
            assert view.end
            panel = hud.end_panel(driver.app.surface, view, view.end)
            assert not panel.colliderect(driver.app.canvas.rect(ninja.x - 30, ninja.y - 30, 60, 60))
            level.retry()
            ninja = level.attempt.simulation.world.ninja


@pytest.mark.parametrize("shake", [0, 100])
def test_explosion_shakes_the_picture_as_much_as_is_wished(driver: MenuDriver, shake: int) -> None:
    driver.app.change_settings(shake=shake)
    driver.app.push(LevelScreen(driver.app, LevelPlaythrough(driver.player, entry(deadly_level()))))
    level = driver.shown(LevelScreen)
    level.begin()
    driver.keys.script = [2] * 60
    until(driver, level, MINE_EXPLODED)
    assert (level.play.view.shake > 0) is bool(shake)
    pictures = []
    for _ in range(2):
        driver.app.stack.redraw_all()
        driver.frames(1, ms=0)
        pictures.append(picture(driver))
        level.play.view.shake = 0.0
    assert (pictures[0] != pictures[1]) is bool(shake)


def test_landing_presses_the_figure_together_by_its_impact(driver: MenuDriver) -> None:
    level = driver.open_level()
    squashes = []
    for held in (2, 40):
        level.retry()
        level.begin()
        driver.keys.script = [0] * 10 + [4] * held + [0] * 200
        driver.frames(14)
        until(driver, level, LANDED)
        squashes.append(level.play.view.ninja_animation.squash)
    assert 0 < squashes[0] < squashes[1]


def until(driver: MenuDriver, level: LevelScreen, kind: int) -> None:
    """Go on until an event of a kind has happened."""
    world = level.attempt.simulation.world
    for _ in range(300):
        driver.frames(1)
        if kind in {event.kind for event in world.events[: world.event_count]}:
            return
    raise AssertionError("the event does not come")


@pytest.mark.parametrize("reduced", [False, True])
def test_ninja_steps_into_its_exit_which_closes(driver: MenuDriver, reduced: bool) -> None:
    driver.app.change_settings(reduced_motion=reduced)
    level = passed_level(driver)
    world, view = level.attempt.simulation.world, level.play.view
    places: list[tuple[float, float]] = []
    with patch("ninja_game.view.level_view.draw_ninja", lambda _target, _animation, at, *_: places.append(at)):
        driver.frames(DANCE_TICKS)
        seen = len(places)
        driver.frames(3 * ENTER_TICKS)
        before = len(places)
        driver.frames(5)
    (slot,) = (k for k, each in enumerate(world.objects) if each.kind == EXIT and each.is_open)
    assert seen > DANCE_TICKS / 2
    assert (len(places) == before) is not reduced, "it is behind the door"
    assert view.object_animation.closing == (0 if reduced else slot)
    if not reduced:
        assert places[seen - 1] == (world.objects[slot].x, world.objects[slot].y + DOOR_STEP)
