"""The window of `ninja-game play`, without a display: it opens, plays, writes its picture, ends."""

import os
import subprocess
import sys
from pathlib import Path
from unittest.mock import Mock

import pygame
import pytest

from ninja_game.errors import LevelError
from ninja_game.play.app import App, Screen, build_app
from ninja_game.play.main import main
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.replay.playback import RunClock
from ninja_game.play.window import Window, fitting_size
from ninja_game.player.settings import Settings
from ninja_game.ui.audio.player import AudioOutput
from ninja_game.ui.canvas import Canvas
from tests.support.scripted import frames, scripted_app

ROOT = Path(__file__).parent.parent.parent
LEVEL = str(ROOT / "levels" / "00-0-first-steps.txt")


@pytest.fixture(autouse=True)
def _own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NINJA_GAME_HOME", str(tmp_path / "home"))


def test_frames_and_screenshot(tmp_path: Path) -> None:
    picture = tmp_path / "picture.png"
    assert main(LEVEL, frames=5, screenshot=str(picture)) == 0
    assert pygame.image.load(picture).get_size() == (792, 600)


def test_any_size(tmp_path: Path) -> None:
    picture = tmp_path / "picture.png"
    main(LEVEL, frames=2, screenshot=str(picture), size=(1000, 500))
    assert pygame.image.load(picture).get_size() == (1000, 500)


def test_a_replay_is_watched(tmp_path: Path) -> None:
    replay = str(ROOT / "levels" / "certificates" / "00-0-first-steps.exit.replay.txt")
    assert main(replay_path=replay, frames=60, screenshot=str(tmp_path / "picture.png")) == 0


def test_a_broken_level_is_reported_before_a_window_opens(tmp_path: Path) -> None:
    broken = tmp_path / "broken.txt"
    broken.write_text("not a level", "utf-8")
    pygame.display.quit()
    with pytest.raises(LevelError, match=r"broken\.txt"):
        main(str(broken), frames=1)
    assert not pygame.display.get_init()


def test_playing_needs_neither_numba_nor_numpy(tmp_path: Path) -> None:
    program = (
        "import sys; from ninja_game.play.main import main\n"
        f"main({LEVEL!r}, frames=3)\n"
        "assert 'numba' not in sys.modules\n"
        "assert 'numpy' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True, timeout=60, cwd=ROOT)


def test_a_machine_without_a_sound_card_is_silent_on_the_terminal_too(tmp_path: Path) -> None:
    environment = {name: value for name, value in os.environ.items() if name != "SDL_AUDIODRIVER"}
    environment |= {"SDL_VIDEODRIVER": "dummy", "NINJA_GAME_HOME": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-m", "ninja_game", "play", LEVEL, "--frames", "2"],
        env=environment, cwd=ROOT, capture_output=True, text=True, check=True, timeout=60,
    )  # fmt: skip
    assert not done.stderr


@pytest.mark.parametrize("managed", [True, False])
def test_a_window_manager_is_asked_for_full_screen(managed: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    window, shown = Window((800, 600), Settings()), Mock(size=(800, 600), position=(5, 6))
    monkeypatch.setattr(window, "_managed", managed)
    monkeypatch.setattr(pygame, "Window", Mock(from_display_module=lambda: shown))
    window.set_fullscreen(wanted=True)
    assert (shown.set_fullscreen.called, shown.position != (0, 0)) == (managed, managed)


class Probe(Screen):
    """Keeps what it gets."""

    def __init__(self, app: App, *, see_through: bool = False, below_runs: bool = False) -> None:
        super().__init__(app)
        self.see_through, self.below_runs = see_through, below_runs
        self.log: list[str] = []

    def enter(self) -> None:
        self.log.append("enter")

    def leave(self) -> None:
        self.log.append("leave")

    def update(self, real_ms: int) -> None:  # noqa: ARG002
        self.log.append("update")

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:  # noqa: ARG002
        self.log.append("draw" + (" whole" if self.redraw else ""))
        return []


def test_the_stack_draws_what_is_seen_and_runs_what_runs() -> None:
    with scripted_app() as (app, _):
        below, panel, menu = Probe(app), Probe(app, see_through=True, below_runs=True), Probe(app)
        app.push(below)
        frames(app, 2)
        assert below.log == ["enter", "update", "draw whole", "update", "draw"]
        below.log.clear()
        app.push(panel)
        frames(app)
        assert below.log == ["leave", "update", "draw whole"]
        app.push(menu)
        below.log.clear()
        frames(app)
        assert below.log == []
        app.pop()
        assert panel.log[-1] == "enter"
        app.pop()
        app.pop()
        assert not app.running


def test_a_new_palette_or_size_draws_everything_again() -> None:
    with scripted_app() as (app, _):
        probe = Probe(app)
        app.push(probe)
        frames(app, 2)
        app.change_settings(palette="dark")
        frames(app)
        assert probe.log[-1] == "draw whole"
        assert app.theme.palette.name == "dark"


def test_the_clock_keeps_the_remainder_and_drops_stalls() -> None:
    clock = RunClock()
    assert sum(clock.ticks_due(16) for _ in range(1000)) == 640
    clock.reset()
    assert clock.ticks_due(2000) == 80
    assert clock.ticks_due(2001) == 1
    assert clock.fraction == 0.0
    assert clock.ticks_due(20, 15) == 1


def test_the_canvas_letterboxes_and_neighbours_share_edges() -> None:
    canvas = Canvas((1000, 500))
    assert canvas.size == (660, 500)
    assert canvas.origin == (170, 0)
    for column in range(32):
        assert canvas.rect(24 * column, 0, 24, 24).right == canvas.rect(24 * column + 24, 0, 24, 24).left


@pytest.mark.parametrize(
    "desktop, first", [((1366, 768), (792, 600)), ((1920, 1080), (1188, 900)), ((2560, 1440), (1584, 1200))]
)
def test_the_first_size_is_a_multiple_of_half_the_stage(
    desktop: tuple[int, int], first: tuple[int, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pygame.display, "get_desktop_sizes", lambda: [desktop])
    assert fitting_size() == first


@pytest.mark.parametrize(
    "desktop, first", [((800, 600), (792, 600)), ((1366, 768), (1326, 668)), ((1920, 1080), (1880, 980))]
)
def test_the_window_of_the_tas_editor_has_nearly_all_of_the_desktop(
    desktop: tuple[int, int], first: tuple[int, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pygame.display, "get_desktop_sizes", lambda: [desktop])
    assert fitting_size(wide=True) == first
    assert fitting_size((700, 500), wide=True) == (700, 500), "as large as it was made"


def test_the_window_opens_as_large_as_it_was(tmp_path: Path) -> None:
    def closed(size: tuple[int, int] | None, made: tuple[int, int] | None) -> tuple[int, int]:
        """Open the game, make the window so large, close it; the size that it had at first."""
        app = build_app(tmp_path, size=size, audio_output=AudioOutput())
        first: tuple[int, int] = app.surface.get_size()
        app.push(MainMenu(app))
        if made:
            pygame.display.set_mode(made, pygame.RESIZABLE)
            pygame.event.post(pygame.Event(pygame.WINDOWSIZECHANGED))
        app.run(2)
        app.player.close()
        return first

    usual = closed(None, None)
    assert not (tmp_path / "settings.toml").exists()
    assert closed((640, 480), (700, 500)) == (640, 480)
    assert closed(None, (900, 640)) == usual, "one that --size made is not kept"
    assert closed(None, None) == (900, 640)
    assert fitting_size((10**5, 640)) == (pygame.display.get_desktop_sizes()[0][0], 640)


FIRST_PICTURE = """
import sys, time
import pygame
def flip():
    print(time.clock_gettime(time.CLOCK_PROCESS_CPUTIME_ID), *sys.modules)
    sys.stdout.flush()
    raise SystemExit
pygame.display.flip = flip
from ninja_game.cli.main import main
sys.argv = ["ninja-game", "play"]
main()
"""


def test_the_first_picture_comes_before_the_game_is_loaded(root: Path) -> None:
    """Half a second of work at most, whatever the rest takes."""
    program = [sys.executable, "-c", FIRST_PICTURE]
    environment = os.environ | {"PYTHONPATH": str(root), "PYGAME_HIDE_SUPPORT_PROMPT": "1"}
    done = subprocess.run(program, cwd=root, env=environment, capture_output=True, text=True, check=False)
    taken, *modules = done.stdout.split()
    assert float(taken) < 0.5, done.stderr
    assert "ninja_game.play.window" in modules
    assert not {"ninja_game.play.app", "ninja_game.play.main", "ninja_game.sim.world", "sqlite3"} & set(modules)


@pytest.mark.parametrize("limit, waits", [(0, "1"), (144, "")])
def test_pictures_wait_for_the_display_unless_a_rate_was_chosen(
    monkeypatch: pytest.MonkeyPatch, limit: int, waits: str
) -> None:
    monkeypatch.setenv("SDL_RENDER_VSYNC", "")
    monkeypatch.delenv("SDL_RENDER_VSYNC")
    Window((792, 600), Settings(frame_limit=limit))
    assert os.environ.get("SDL_RENDER_VSYNC", "") == waits
