"""Every event that is heard has its file; sound follows the world and never disturbs it."""

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from time import sleep
from unittest.mock import Mock

import pygame
import pytest

from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.sim import states
from ninja_game.sim.events import DIED, EVENT_NAMES, LANDED
from ninja_game.sim.kinds import DRONE, FLOOR_GUARD, LAUNCHER
from ninja_game.simulation import Simulation
from ninja_game.ui.audio.player import CHAIN_TICKS, LOUDEST, STEP_PX, AudioPlayer, Footsteps, GoldPitches, Variants
from ninja_game.ui.audio.table import (
    BY_DEATH,
    BY_EVENT,
    CORPSE,
    LANDING,
    LOOPS,
    OTHER_DEATH,
    STEPS,
    event_sound,
    has_loop,
    loop_levels,
)
from ninja_game.view.ninja.figure import CYCLE
from tests.support.recorded import hold_against
from tools.sounds.effects import RECIPES

FLAT = parse_level_string("0" * 713 + "|5^100,566!0^140,566!11^400,564,500,564")


@pytest.fixture
def folder(root: Path) -> Path:
    return root / "assets" / "sounds"


def test_every_sound_of_the_tables_has_a_recipe_and_a_file(folder: Path) -> None:
    named = {name for names in [*BY_EVENT.values(), *BY_DEATH.values(), OTHER_DEATH, STEPS] for name in names}
    named |= {name for _, names in (*CORPSE, *LANDING) for name in names}
    named |= {name for names in LOOPS.values() for name in names}
    assert set(RECIPES) - named == {"medal", "menu-choose", "menu-move"}
    assert {path.stem for path in folder.glob("*.ogg")} == set(RECIPES) >= named


SOUNDS = Path(__file__).parent / "golden" / "sounds.txt"


def heard(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """A line for each event, each way to die, each speed of a corpse and each lasting sound."""
    player, played = AudioPlayer(folder), list[str]()
    monkeypatch.setattr(player, "works", True)
    monkeypatch.setattr(player, "play", lambda name, **_: played.append(name))
    monkeypatch.setattr(player, "_loop", lambda *_: None)
    monkeypatch.setattr(player, "_variants", Mock(choose=" or ".join))
    world = Simulation(FLAT).world
    world.event_count = 1
    for kind, name in enumerate(EVENT_NAMES):
        world.events[0].kind = kind
        causes = {
            "LASER": states.LASER, "EXPLOSIVE": states.EXPLOSIVE, "FALL": states.FALL, "ELECTRIC": states.ELECTRIC,
            "any other": 99,
        } if kind == DIED else {"": 0}  # fmt: skip
        for cause, number in causes.items():
            world.events[0].cause = number
            player.play_events(world)
            yield f"{name}{f', {cause.lower()}' * bool(cause)}: {', '.join(played) or 'nothing'}"
            played.clear()
    for speed in (1.0, 1.5, 2.5, 3.5):
        player._corpse_at = -1.0
        player.corpse(speed)
        yield f"corpse at {speed} px/tick: {', '.join(played) or 'nothing'}"
        played.clear()
    lasting = {
        "a rocket that flies": (LAUNCHER, states.LAUNCHER_FLIGHT), "a launcher that waits": (LAUNCHER, 0),
        "a drone that fires": (DRONE, states.DRONE_FIRING), "a drone that moves": (DRONE, 0),
        "a guard that chases": (FLOOR_GUARD, states.GUARD_CHASE), "a guard that waits": (FLOOR_GUARD, 0),
        "a drone with a chaingun that fires": (DRONE, states.DRONE_FIRING),
    }  # fmt: skip
    for name, (kind, routine) in lasting.items():
        weapon = states.WEAPON_CHAINGUN if "chaingun" in name else states.WEAPON_LASER
        machine = Mock(kind=kind, routine=routine, weapon=weapon)
        found = [loop for loop, level in loop_levels(world, [machine] if has_loop(machine) else []).items() if level]
        yield f"{name}: {', '.join(found) or 'nothing'}"


def test_each_event_sounds_as_accepted(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    hold_against(SOUNDS, [*heard(folder, monkeypatch)])


def test_skid_and_slide_follow_the_speed() -> None:
    run = Simulation(FLAT)
    for _ in range(40):
        run.step(right=True)
    assert loop_levels(run.world, ())["skid"] == 0
    run.step()
    run.step()
    levels = [loop_levels(run.world, ())["skid"]]
    for _ in range(20):
        run.step()
        levels.append(loop_levels(run.world, ())["skid"])
    assert levels[0] == 1.0
    assert levels == sorted(levels, reverse=True)
    assert levels[-1] < levels[0]
    down_a_slope = Mock(state=states.SKIDDING, x=0.3, y=0.3, prev_x=0.0, prev_y=0.0, floor_x=0.6, floor_y=-0.8)
    assert loop_levels(Mock(ninja=down_a_slope), ())["skid"] == pytest.approx(0.42)


def test_hearing_plays_the_tick_and_leaves_the_world_alone(folder: Path) -> None:
    sound = AudioPlayer(folder)
    heard, silent = Simulation(FLAT), Simulation(FLAT)
    for tick in range(60):
        for run in (heard, silent):
            run.step(right=True, jump=tick > 30)
        sound.play_events(heard.world)
    assert heard.gold == 1
    assert heard.digest() == silent.digest()
    sound.quiet()


def test_no_sound_device_is_no_error(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def no_device(*_: object) -> None:
        raise pygame.error("no device")

    pygame.quit()
    monkeypatch.setattr(pygame.mixer, "init", no_device)
    sound = AudioPlayer(folder)
    assert not sound.works
    run = Simulation(FLAT)
    run.step(jump=True)
    sound.play_events(run.world)
    sound.corpse(4.0)
    sound.play("gold-1")
    sound.set_volumes(0, 0, 0, 0)
    sound.quiet()


def test_nothing_is_read_once_the_device_is_closed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A thread that still reads then spoils the memory, and any later test ends the whole program."""
    read = list[Path]()

    def slow(file: Path) -> None:
        if tmp_path in file.parents:  # players of other tests may still read theirs
            read.append(file)
        sleep(0.02)
        raise pygame.error("unreadable")

    for number in range(50):
        (tmp_path / f"{number}.ogg").touch()
    monkeypatch.setattr(pygame.mixer, "Sound", slow)
    sound = AudioPlayer(tmp_path)
    sound.set_volumes(LOUDEST, LOUDEST, LOUDEST, LOUDEST)
    sound.music("menu", 1000)
    pygame.quit()
    before = len(read)
    sleep(0.1)
    assert len(read) == before


def test_missing_files_are_silent(tmp_path: Path) -> None:
    sound = AudioPlayer(tmp_path)
    assert sound.works
    sound.play("gold-1")
    sound.corpse(5.0)
    assert not pygame.mixer.get_busy()


def test_a_variant_never_sounds_twice_in_a_row() -> None:
    variants = Variants()
    heard = [variants.choose(STEPS) for _ in range(200)]
    assert all(one != two for one, two in pairwise(heard))
    assert set(heard) == set(STEPS)
    assert {variants.choose(("mine",)) for _ in range(3)} == {"mine"}


def test_gold_climbs_in_a_chain_and_falls_back_after_a_pause_or_a_restart() -> None:
    pitches = GoldPitches(4)
    assert [pitches.next(tick) for tick in (5, 5, 5 + CHAIN_TICKS, 100, 101)] == [0, 1, 2, 3, 3]
    assert pitches.next(102 + CHAIN_TICKS) == 0
    assert pitches.next(103 + CHAIN_TICKS) == 1
    assert pitches.next(20) == 0


def test_gold_of_a_run_is_heard_in_rising_pitches(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    row = "!".join(f"0^{x},566" for x in range(120, 260, 24))
    run, sound, heard = (
        Simulation(parse_level_string("0" * 713 + f"|5^100,566!{row}")),
        AudioPlayer(folder),
        list[str](),
    )
    monkeypatch.setattr(sound, "play", lambda name, **_: heard.append(name))
    for _ in range(120):
        run.step(right=True)
        sound.play_events(run.world)
    assert [name for name in heard if "gold" in name] == [f"gold-{rung}" for rung in range(1, 7)]


def test_steps_follow_the_run_and_its_speed() -> None:
    assert STEP_PX == CYCLE / 2
    run, steps, walked = Simulation(FLAT), Footsteps(), list[float]()
    for _ in range(80):
        run.step(right=True)
        walked.append(steps.loudness(run.world.ninja))
    loud = [level for level in walked if level]
    way = run.world.ninja.x - 100
    assert abs(len(loud) - way / STEP_PX) <= 1
    assert loud[0] < loud[-1]
    for _ in range(60):
        run.step()
    assert steps.loudness(run.world.ninja) == 0


@pytest.mark.parametrize(
    "speed, names", [(0.0, "land-soft"), (1.0, "land-soft"), (3.0, "land-medium"), (9.0, "land-hard")]
)
def test_a_landing_is_as_hard_as_the_hit(speed: float, names: str) -> None:
    ninja, event = Mock(floor_x=0.0, floor_y=-1.0), Mock(kind=LANDED, dx=7.0, dy=speed)
    heard, level = event_sound(event, ninja)
    assert heard[0].startswith(names)
    assert level == min(1.0, 0.5 + speed / 8)
