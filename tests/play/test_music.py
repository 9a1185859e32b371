"""Music follows the place and what happens, never restarts on a retry, and is silent where it is not wanted."""

from dataclasses import replace
from pathlib import Path
from time import monotonic, sleep
from unittest.mock import Mock

import pygame
import pytest

from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.play.editor.playtest import PlaytestScreen
from ninja_game.play.editor.session import EditorSession
from ninja_game.play.level.screen import play_level
from ninja_game.play.main_menu import MainMenu
from ninja_game.sim import states
from ninja_game.sim.kinds import DRONE, EXIT, FLOOR_GUARD, LAUNCHER, TURRET
from ninja_game.simulation import Simulation
from ninja_game.ui.audio.music import (
    _FAR,
    _NEAR,
    CALM,
    COLUMN_MUSIC,
    LAYERS_OF,
    MENU,
    SILENCE,
    Music,
    MusicLevels,
    music_levels,
)
from ninja_game.ui.audio.player import AudioPlayer
from tests.support.scripted import scripted_app
from tests.support.waiting import LONGEST
from tools.sounds.music import BEDS, TRACKS

FLAT = parse_level_string("0" * 713 + "|5^100,566!11^400,564,500,564")


@pytest.fixture
def folder(root: Path) -> Path:
    return root / "assets" / "sounds"


def volumes(music: Music) -> list[float]:
    return [round(pygame.mixer.Channel(music.first + layer).get_volume(), 2) for layer in range(4)]


def busy(music: Music) -> list[bool]:
    return [pygame.mixer.Channel(music.first + layer).get_busy() for layer in range(4)]


@pytest.fixture
def player(folder: Path) -> AudioPlayer:
    sound = AudioPlayer(folder)
    sound.set_volumes(99, 99, 99, 99)
    pygame.mixer.stop()
    return sound


def begin(sound: AudioPlayer, name: str) -> None:
    """Let time pass until this music plays."""
    end = monotonic() + LONGEST
    while sound.soundtrack.playing != name:
        assert monotonic() < end, f"{name} does not begin"
        sound.music(name, 100)
        sleep(0.01)


def test_every_place_has_its_files(folder: Path) -> None:
    assert set(LAYERS_OF) == set(BEDS) == {MENU, *COLUMN_MUSIC}
    assert {f"{name}-{layer}" for name, layers in LAYERS_OF.items() for layer in layers} == set(TRACKS)
    assert {path.stem for path in (folder / "music").glob("*.ogg")} == set(TRACKS)


def test_layers_come_in_with_what_happens_and_leave_again(player: AudioPlayer) -> None:
    begin(player, "ground")
    for _ in range(20):
        player.music("", 100)
    assert volumes(player.soundtrack) == [1.0, 0.0, 0.0, 0.0]
    player.soundtrack.levels = MusicLevels(1.0, 0.5, 0.0, 1.0)
    player.music("ground", 200)
    early = volumes(player.soundtrack)
    assert 0 < early[1] < 0.25
    for _ in range(50):
        player.music("ground", 100)
    assert volumes(player.soundtrack) == pytest.approx([1.0, 0.5, 0.0, 1.0], abs=0.02)
    assert busy(player.soundtrack) == [True] * 4
    player.quiet()
    assert busy(player.soundtrack) == [True] * 4, "what ends the sounds of a try leaves the music alone"
    assert player.soundtrack.levels == CALM


def test_one_music_fades_before_the_next_begins(player: AudioPlayer) -> None:
    begin(player, "ground")
    for _ in range(10):
        player.music("ground", 100)
    player.music(MENU, 100)
    assert player.soundtrack.playing == "ground"
    assert 0 < volumes(player.soundtrack)[0] < 1
    begin(player, MENU)
    assert busy(player.soundtrack) == [True, False, False, False]
    begin(player, SILENCE)
    assert busy(player.soundtrack) == [False] * 4


def test_no_volume_is_no_music(player: AudioPlayer) -> None:
    begin(player, MENU)
    player.set_volumes(70, 99, 99, 0)
    assert busy(player.soundtrack) == [False] * 4
    player.music(MENU, 1000)
    assert busy(player.soundtrack) == [False] * 4
    player.set_volumes(70, 0, 99, 99)
    begin(player, MENU)
    assert busy(player.soundtrack)[0]


def test_missing_music_is_silent(tmp_path: Path) -> None:
    sound = AudioPlayer(tmp_path)
    sound.set_volumes(99, 99, 99, 99)
    begin(sound, "ground")
    assert not any(busy(sound.soundtrack))


@pytest.mark.parametrize(
    "about",
    [
        {"kind": DRONE, "routine": states.DRONE_MOVE, "chasing": 1},
        {"kind": DRONE, "routine": states.DRONE_FIRING, "chasing": 0},
        {"kind": LAUNCHER, "routine": states.LAUNCHER_FLIGHT},
        {"kind": FLOOR_GUARD, "routine": states.GUARD_CHASE},
        {"kind": TURRET, "think": states.TURRET_TARGETING},
    ],
)
def test_danger_grows_as_it_comes_near(about: dict[str, int]) -> None:
    world = Simulation(FLAT).world
    ninja = world.ninja

    def danger(distance: float, **other: int) -> float:
        return music_levels(world, [Mock(x=ninja.x + distance, y=ninja.y, **(about | other))]).danger

    assert danger(_NEAR) == danger(0) == 1
    assert danger(_FAR) == 0
    assert 0 < danger(300) < danger(200) < 1
    assert danger(0, routine=0, chasing=0, think=0) == 0


def test_speed_and_the_open_exit_are_heard() -> None:
    run = Simulation(FLAT)
    door = Mock(kind=EXIT, is_open=0)
    assert music_levels(run.world, [door]) == CALM
    door.is_open = 1
    assert music_levels(run.world, [door]).exit == 1
    for _ in range(60):
        run.step(right=True)
    assert music_levels(run.world, []).speed > 0.5


def test_each_screen_asks_for_its_music() -> None:
    with scripted_app() as (app, _):
        app.push(MainMenu(app))
        assert app.top.music == MENU
        entry = app.player.catalogue.ours.levels[0]
        for episode, music in (("00-0", COLUMN_MUSIC[0]), ("19-4", COLUMN_MUSIC[1]), ("43-4", COLUMN_MUSIC[4])):
            assert play_level(app, replace(entry, episode=episode)) == ""
            assert app.top.music == music
            app.pop()
        play_level(app, replace(entry, episode=""))
        assert app.top.music in COLUMN_MUSIC
        app.pop()
        app.push(PlaytestScreen(EditorSession(app), entry.named.level))
        assert app.top.music == SILENCE
        app.pop()
        play_level(app, entry, practice=True)
        assert app.top.music == COLUMN_MUSIC[0]
        app.change_settings(music_in_practice=False)
        assert app.top.music == SILENCE
