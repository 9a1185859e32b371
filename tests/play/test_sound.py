"""Every event that is heard has its file; sound follows the world and never disturbs it."""

from __future__ import annotations

import wave
from collections.abc import Iterator
from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pygame
import pytest

from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.sim import states
from ninja_game.sim.events import DIED, EVENT_NAMES
from ninja_game.sim.kinds import DRONE, FLOOR_GUARD, LAUNCHER
from ninja_game.simulation import Simulation
from ninja_game.ui.audio.player import (
    BY_DEATH,
    BY_EVENT,
    CORPSE,
    LOOPS,
    OTHER_DEATH,
    AudioPlayer,
    _has_loop,
    loop_levels,
)
from tests.support.recorded import hold_against
from tools.make_sounds import RATE, RECIPES, samples

FLAT = parse_level_string("0" * 713 + "|5^100,566!0^140,566!11^400,564,500,564")


@pytest.fixture
def folder(root: Path) -> Path:
    return root / "assets" / "sounds"


def test_every_sound_of_the_tables_has_a_recipe_and_a_file(folder: Path) -> None:
    named = {name for names in [*BY_EVENT.values(), *BY_DEATH.values(), OTHER_DEATH] for name in names}
    named |= {name for _, names in CORPSE for name in names} | set(LOOPS)
    assert named <= set(RECIPES)
    assert {path.stem for path in folder.glob("*.wav")} == set(RECIPES)


@pytest.mark.parametrize("name", RECIPES)
def test_file_is_what_the_script_makes(folder: Path, name: str) -> None:
    """Regenerate with `python3 tools/dev.py tool make_sounds`."""
    with wave.open(str(folder / f"{name}.wav"), "rb") as file:
        found = np.frombuffer(file.readframes(file.getnframes()), "<i2").astype(int)
    made = np.frombuffer(samples(name), "<i2").astype(int)
    assert len(found) == len(made)
    # Other NumPy builds may round a sine differently.
    assert np.abs(found - made).max() <= 4


@pytest.mark.parametrize("name", LOOPS)
def test_loops_end_as_they_begin(name: str) -> None:
    made = np.frombuffer(samples(name), "<i2").astype(float)
    steps = np.abs(np.diff(made))
    assert abs(made[0] - made[-1]) <= steps.max()


@pytest.mark.parametrize("name", sorted(set(RECIPES) - set(LOOPS)))
def test_other_sounds_die_away_before_they_end(name: str) -> None:
    made = np.abs(np.frombuffer(samples(name), "<i2").astype(float))
    assert made[-RATE // 100 :].max() <= 0.3 * made.max()


SOUNDS = Path(__file__).parent / "golden" / "sounds.txt"


def heard(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """A line for each event, each way to die, each speed of a corpse and each lasting sound."""
    player, played = AudioPlayer(folder), list[str]()
    monkeypatch.setattr(player, "works", True)
    monkeypatch.setattr(player, "play", lambda name, **_: played.append(name))
    monkeypatch.setattr(player, "_loop", lambda *_: None)
    monkeypatch.setattr(player, "_rng", Mock(choice=" or ".join))
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
        found = [loop for loop, level in loop_levels(world, [machine] if _has_loop(machine) else []).items() if level]
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

    pygame.mixer.quit()
    monkeypatch.setattr(pygame.mixer, "init", no_device)
    sound = AudioPlayer(folder)
    assert not sound.works
    run = Simulation(FLAT)
    run.step(jump=True)
    sound.play_events(run.world)
    sound.corpse(4.0)
    sound.play("gold")
    sound.set_volumes(0, 0)
    sound.quiet()


def test_missing_files_are_silent(tmp_path: Path) -> None:
    sound = AudioPlayer(tmp_path)
    sound.play("gold")
    sound.corpse(5.0)
