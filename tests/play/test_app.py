"""What all screens share: settings, notices, keys that mean the same everywhere, the window."""

from pathlib import Path

import pygame
import pytest

from ninja_game.errors import NinjaGameError
from ninja_game.files.user_folder import export_path
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.play.app import App, build_app
from ninja_game.play.level.screen import PausePanel
from ninja_game.play.main import first_screen, main
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.menu_screen import MenuScreen
from ninja_game.play.panels.replays import watch_recording
from ninja_game.play.window import Window
from ninja_game.player.player_data import PlayerData
from ninja_game.player.settings import Settings
from ninja_game.ui.audio.player import AudioOutput
from tests.support.menu_driver import MenuDriver
from tests.support.samples import NO_NINJA
from tests.support.scripted import frames, scripted_app, tap

LEVEL = Path(__file__).parent.parent.parent / "levels" / "00-0-first-steps.txt"


def start_level(app: App) -> None:
    app.push(first_screen(str(LEVEL), None, body="circle", practice=False)(app))


def test_full_screen_and_ghost_keys_outlast_a_change_of_settings() -> None:
    with scripted_app() as (app, _):
        start_level(app)
        tap(app, "ghost")
        tap(app, "fullscreen")
        app.change_settings(smooth=False)
        assert app.settings.fullscreen
        assert app.window.fullscreen
        assert not app.settings.show_ghost
        assert "fullscreen = true" in (app.player.folder / "settings.toml").read_text()


OTHER = {
    "palette": "dark", "ninja_colour": "#186285", "fullscreen": True, "volume": 11, "effects_volume": 14,
    "loop_volume": 12, "music_volume": 13, "dead_zone": 0.8, "keys": {"jump": ("x",)}, "pad": {"jump": ("b",)},
}  # fmt: skip
"""Another value for each setting that the app hands on; all others are read where they are used."""


class Volumes(AudioOutput):
    """Remembers its volumes."""

    def __init__(self, settings: Settings) -> None:
        self.volumes = settings.volume, settings.effects_volume, settings.loop_volume, settings.music_volume

    def set_volumes(self, volume: int, effects: int, loop_volume: int, music_volume: int) -> None:
        self.volumes = volume, effects, loop_volume, music_volume


def handed_on(app: App) -> dict[str, object]:
    """What the settings have become."""
    stick = pygame.Event(pygame.CONTROLLERAXISMOTION, instance_id=77, axis=0, value=16_000)
    assert isinstance(app.audio_output, Volumes)
    return {
        "palette": app.theme.palette, "fullscreen": app.window.fullscreen, "volumes": app.audio_output.volumes,
        "stick": app.controls.pads.changes(stick), "keys": app.controls.keys, "pad": app.controls.pad,
        "settings": app.settings,
    }  # fmt: skip


def test_a_setting_that_is_changed_is_at_once_as_after_a_new_start(tmp_path: Path) -> None:
    found = []
    for changed in (True, False):
        if changed:
            app = build_app(tmp_path, size=(792, 600), audio_output=Volumes(Settings()))
            before = handed_on(app)
            app.controls.pads.changes(pygame.Event(pygame.CONTROLLERAXISMOTION, instance_id=77, axis=0, value=0))
            app.change_settings(**OTHER)
        else:
            settings = PlayerData(tmp_path).settings
            assert settings == Settings().changed(**OTHER)
            app = build_app(tmp_path, size=(792, 600), audio_output=Volumes(settings))
        found.append(handed_on(app))
        app.window.set_fullscreen(wanted=False)
        app.player.close()
    assert [name for name in before if found[0][name] != found[1][name]] == []
    assert [name for name in before if found[0][name] == before[name]] == [], "some of them say nothing"


def test_level_started_from_the_command_line_has_the_pause_panel() -> None:
    with scripted_app() as (app, _):
        start_level(app)
        tap(app, "confirm")
        pygame.event.post(pygame.Event(pygame.WINDOWFOCUSLOST))
        frames(app)
        assert isinstance(app.top, PausePanel)


def test_damaged_records_are_reported_whatever_the_first_screen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("NINJA_GAME_HOME", str(tmp_path))
    (tmp_path / "records.sqlite").write_bytes(b"rubbish" * 500)
    seen = []
    monkeypatch.setattr(App, "run", lambda app, _: seen.append(app.notice))
    main(str(LEVEL))
    assert "damaged" in seen[0]


@pytest.mark.parametrize("name", ["tab", "f12", "f11"])
def test_key_of_the_app_can_be_bound(tmp_path: Path, name: str) -> None:
    driver = MenuDriver(tmp_path)
    driver.open("Settings")
    screen = driver.settings_page("Keyboard")
    driver.press("return")
    driver.press(name)
    driver.press("down", "return")
    assert driver.player.settings.keys["left"][0] == name
    assert driver.top() is screen
    assert not list((tmp_path / "exports").iterdir())
    assert not driver.app.window.fullscreen
    driver.close()


@pytest.mark.parametrize("entry", ["", "Settings", "Editor"])
def test_tab_moves_the_focus_where_nothing_runs(tmp_path: Path, entry: str) -> None:
    driver = MenuDriver(tmp_path)
    screen = driver.open(entry) if entry else driver.shown(MainMenu)
    assert isinstance(screen, MenuScreen)
    seen = []
    for _ in range(3):
        driver.press("tab")
        seen.append(screen.focus)
    assert driver.top() is screen
    assert len(set(map(id, seen))) == 3
    assert None not in seen
    if entry == "Editor":
        driver.press("escape")
        assert (driver.top(), screen.focus) == (screen, None), "the arrows are the pointer's again"
    driver.close()


def test_letter_typed_into_a_search_is_no_command(tmp_path: Path) -> None:
    driver = MenuDriver(tmp_path)
    driver.app.change_settings(keys={"boss": ("b",)})
    browser = driver.open("Levels")
    browser.focus = browser.entry_field  # type: ignore[attr-defined]
    driver.type("b")
    assert driver.top() is browser
    driver.close()


def test_picture_goes_into_the_exports_with_a_notice() -> None:
    with scripted_app() as (app, _):
        start_level(app)
        tap(app, "screenshot")
        picture = app.player.folder / "exports" / "screenshot-1.png"
        assert pygame.image.load(picture).get_size() == (792, 600)
        assert str(picture) in app.notice
        frames(app, 2, 3000)
        assert not app.notice


def test_picture_that_cannot_be_saved_is_a_notice() -> None:
    with scripted_app() as (app, _):
        start_level(app)
        (app.player.folder / "exports").rmdir()
        (app.player.folder / "exports").write_text("in the way")
        tap(app, "screenshot")
        assert app.notice.startswith("Not written: ")


def test_replay_without_a_ninja_is_refused_with_a_notice() -> None:
    level = parse_level_string(NO_NINJA)
    with scripted_app() as (app, _):
        start_level(app)
        watch_recording(app, Recording(level, Replay.of_inputs(b"", level, name="empty"), file="empty.txt"))
        assert len(app.stack) == 1
        assert "cannot be watched" in app.notice


def test_notice_is_drawn_in_the_border_of_a_level_that_is_played_and_never_for_the_boss() -> None:
    with scripted_app() as (app, _):
        start_level(app)
        frames(app, 300)  # the time bar has filled
        before = app.surface.copy()
        app.notify("A notice")
        frames(app)
        changed = pygame.mask.from_threshold(app.surface, (0, 0, 0), (8, 8, 8, 255), before)
        changed.invert()
        assert changed.count()
        assert all(rect.top >= 576 for rect in changed.get_bounding_rects())
        tap(app, "boss")
        assert app.top.hides_game
        hidden = app.surface.copy()
        app.notify("")
        frames(app)
        assert pygame.image.tobytes(app.surface, "RGB") == pygame.image.tobytes(hidden, "RGB")


def test_screenshot_to_a_place_that_is_not_there_names_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NINJA_GAME_HOME", str(tmp_path / "home"))
    with pytest.raises(NinjaGameError, match=r"nowhere/a\.png: the picture cannot be written"):
        main(str(LEVEL), frames=1, screenshot=str(tmp_path / "nowhere" / "a.png"))


def test_no_display_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    pygame.display.quit()
    monkeypatch.delenv("SDL_VIDEODRIVER")
    monkeypatch.setattr(pygame.display, "get_driver", lambda: "offscreen")
    monkeypatch.setattr(pygame.display, "init", lambda: None)
    with pytest.raises(NinjaGameError, match="no display"):
        Window((792, 600), Settings())


def test_names_of_exports_are_free_short_and_plain(tmp_path: Path) -> None:
    assert export_path(tmp_path, "A / b", ".gif").name == "a-b-1.gif"
    export_path(tmp_path, "A / b", ".gif").touch()
    assert export_path(tmp_path, "A / b", ".gif").name == "a-b-2.gif"
    export_path(tmp_path, "é" * 300, ".replay.txt").touch()
    assert export_path(tmp_path, "../..", ".gif").parent == tmp_path / "exports"


def test_unknown_palette_is_reported_and_the_game_starts(tmp_path: Path) -> None:
    (tmp_path / "settings.toml").write_text('[look]\npalette = "drak"\n')
    driver = MenuDriver(tmp_path)
    assert driver.app.theme.palette.base.name == "morning"
    assert "drak" in driver.app.notice
    driver.close()


@pytest.mark.parametrize(
    "name, before, typed, known",
    [("", "", " Ida ", "Ida"), ("", "Ida", "Ida", ""), ("Bo", "", "Ida", "Bo"), ("", "", "x" * 50, "x" * 40)],
)
def test_an_author_who_is_typed_is_the_player_where_none_is_set(name: str, before: str, typed: str, known: str) -> None:
    with scripted_app() as (app, _):
        app.change_settings(name=name)
        app.remember_author(before, typed)
        assert app.settings.name == known
