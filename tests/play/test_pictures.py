"""Pictures of scenes against those in `tests/play/golden/`, with a tolerance for other rasterisers.

To accept new pictures after a change of drawings run `python3 tools/dev.py accept-pictures`
and look at them. A picture that differs is written beside the accepted one as
`NAME.new.png` (git ignores it).
"""

import re
from dataclasses import replace
from pathlib import Path

import pygame
import pytest

from ninja_game.formats.load import load_levels, load_replays
from ninja_game.play.lab.screen import export_figure
from ninja_game.player.settings import Settings
from ninja_game.sim.death import kill
from ninja_game.sim.kinds import DRONE, LAUNCHER, TURRET
from ninja_game.sim.states import ELECTRIC, EXPLOSIVE
from ninja_game.simulation import Simulation
from ninja_game.ui.theme import PALETTES
from ninja_game.view import level_view
from ninja_game.view.level_view import LevelView, OffscreenContext
from ninja_game.view.overlays import OVERLAY_ACTIONS, Overlays, thinkers
from ninja_game.view.sprites.thumbnail import thumbnail
from tests.support.drawings import paint_things
from tests.support.first_level import STEPS, made_until
from tests.support.own_pack import PACK
from tests.support.recorded import ACCEPT
from tools.draw import how_it_works, screens

HERE = Path(__file__).parent
GOLDEN = HERE / "golden"
ROOT = HERE.parent.parent
SIZE = (528, 400)
MEAN_TOLERANCE = 1.5  # largest mean difference of a colour channel, of 255
BLOCK_TOLERANCE = 30  # largest mean difference in any block of 8 x 8 px


def scene(
    number: int, ticks: int, settings: Settings | None = None, *, overlays: bool = False, fatal: int = -1
) -> pygame.Surface:
    """A bundled replay after some ticks; with ``fatal`` the ninja is killed and seen 5 ticks later."""
    path = sorted(PACK.glob("certificates/*.replay.txt"))[number]
    recording = load_replays(path)[0]
    run = Simulation(recording.level)
    view = LevelView(OffscreenContext(SIZE, settings), run, seed=7)
    if overlays:
        view.overlays = Overlays()
        view.overlays.on = set(OVERLAY_ACTIONS)
    inputs = recording.replay.playback(ticks)
    for frame in inputs:
        run.step_keys(frame)
        view.on_tick()
    if fatal >= 0:
        n = run.world.ninja
        kill(run.world, fatal, 0, 4.0, -3.0, n.x, n.y - 4)
        view.follow_ninja()
        for _ in range(5):
            run.step_keys(0)
            view.on_tick()
    surface = pygame.Surface(SIZE)
    view.draw(surface, 0.5, whole=True)
    return surface


def test_who_thinks_next_is_the_first_of_those_that_think() -> None:
    """One of them every fourth tick, in turn: the first one goes to the end of the row; the overlay shows it."""
    level = load_replays(sorted(PACK.glob("certificates/*.replay.txt"))[6])[0].level
    looking = [each for each in level.objects if each.kind in (TURRET, LAUNCHER, DRONE)]
    run = Simulation(replace(level, objects=(*level.objects, *2 * looking)))
    view = LevelView(OffscreenContext(SIZE, None), run, seed=7)
    view.overlays = Overlays()
    view.overlays.toggle("overlay_thinkers")
    row, pictures = [o.slot for o in thinkers(run.world)], []
    assert len(row) == len(set(row)) == sum(bool(o.thinking) for o in run.world.objects[1 : run.world.slots_used]) > 1
    for place in range(8):
        assert [o.slot for o in thinkers(run.world)] == (row if place < 4 else [*row[1:], row[0]])
        run.step_keys(0)
        surface = pygame.Surface(SIZE)
        view.draw(surface, 1.0, whole=True)
        pictures.append(pygame.image.tobytes(surface, "RGB"))
    view.overlays.toggle("overlay_thinkers")
    view.draw(surface, 1.0, whole=True)
    assert pygame.image.tobytes(surface, "RGB") != pictures[-1]


SCENES = {
    "run-and-hop": lambda: scene(0, 120),
    "wall-to-wall-dark": lambda: scene(2, 150, Settings(palette="dark")),
    "every-switch-safe": lambda: scene(4, 200, Settings(palette="safe")),
    "watch-and-go-contrast": lambda: scene(6, 160, Settings(palette="contrast")),
    "no-hurry-safe-dark": lambda: scene(7, 200, Settings(palette="safe-dark")),
    "no-hurry-overlays": lambda: scene(7, 140, overlays=True),
    "no-hurry-passed": lambda: scene(7, 560),
    "death-explosive": lambda: scene(0, 60, fatal=EXPLOSIVE),
    "death-electric": lambda: scene(0, 60, fatal=ELECTRIC),
    "death-without-gore": lambda: scene(0, 60, Settings(reduced_gore=True, reduced_motion=True), fatal=EXPLOSIVE),
    "drawings": lambda: paint_things(PALETTES["classic"]),
    "thumbnail": lambda: thumbnail(load_levels(PACK / "01-2-no-hurry.txt")[0].level, PALETTES["classic"], 264),
}


def difference(a: pygame.Surface, b: pygame.Surface) -> tuple[float, float]:
    """Mean difference of the channels, over all px and in the worst block."""
    if a.get_size() != b.get_size():
        return 255.0, 255.0
    distance = a.copy()
    other = b.copy()
    distance.blit(b, (0, 0), special_flags=pygame.BLEND_RGB_SUB)
    other.blit(a, (0, 0), special_flags=pygame.BLEND_RGB_SUB)
    distance.blit(other, (0, 0), special_flags=pygame.BLEND_RGB_ADD)
    blocks = pygame.transform.smoothscale(distance, (a.get_width() // 8, a.get_height() // 8))
    worst = max(max(blocks.get_at((x, y))[:3]) for y in range(blocks.get_height()) for x in range(blocks.get_width()))
    mean = pygame.transform.average_color(distance)
    return max(mean[:3]), float(worst)


@pytest.mark.parametrize("name", SCENES)
def test_a_scene_looks_as_accepted(name: str) -> None:
    picture = SCENES[name]()
    accepted, new = GOLDEN / f"{name}.png", GOLDEN / f"{name}.new.png"
    new.unlink(missing_ok=True)
    if ACCEPT:
        GOLDEN.mkdir(exist_ok=True)
        pygame.image.save(picture, str(accepted))
        return
    golden = pygame.Surface(picture.get_size())
    golden.blit(pygame.image.load(accepted), (0, 0))
    shown = pygame.Surface(picture.get_size())
    shown.blit(picture, (0, 0))
    mean, worst = difference(shown, golden)
    if mean > MEAN_TOLERANCE or worst > BLOCK_TOLERANCE:
        pygame.image.save(picture, str(new))
        pytest.fail(f"{name} differs (mean {mean}, worst block {worst}); look at {new}, or accept it (see above)")


@pytest.mark.parametrize("name", screens.SCREENS)
def test_a_picture_of_the_documents_is_of_the_program_as_it_is(name: str) -> None:
    shown = screens.draw(name)
    golden = pygame.Surface(shown.get_size())
    golden.blit(pygame.image.load(screens.PICTURES / name), (0, 0))
    mean, worst = difference(shown, golden)
    assert mean <= MEAN_TOLERANCE, "run `python3 tools/dev.py docs`"
    assert worst <= BLOCK_TOLERANCE, "run `python3 tools/dev.py docs`"


def test_the_steps_of_the_first_level_certify_and_save_it(tmp_path: Path) -> None:
    made_until(STEPS[-1], tmp_path).close()
    assert (tmp_path / "levels" / "certificates" / "first.exit.replay.txt").is_file()


@pytest.mark.parametrize("file", [file for file in how_it_works.FIGURES if file.endswith(".png")])
def test_a_figure_of_the_lab_in_the_documents_is_as_it_is_drawn_now(file: str, tmp_path: Path) -> None:
    export_figure(file.partition(".")[0], tmp_path / file)
    shown, golden = (pygame.image.load(path) for path in (tmp_path / file, screens.PICTURES / f"lab-{file}"))
    mean, worst = difference(shown, golden)
    assert (mean <= MEAN_TOLERANCE, worst <= BLOCK_TOLERANCE) == (True, True), "run `python3 tools/dev.py docs`"


@pytest.mark.parametrize("name", how_it_works.VECTORS)
def test_a_vector_picture_of_the_documents_is_as_it_is_drawn_now(name: str, tmp_path: Path) -> None:
    how_it_works.VECTORS[name]().save(tmp_path / name)
    drawn, kept = ((folder / name).read_text("utf-8") for folder in (tmp_path, screens.PICTURES))
    assert drawn == kept, "run `python3 tools/dev.py docs`"


def test_every_picture_of_the_documents_is_drawn_by_a_tool() -> None:
    pages = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]
    links = [link for page in pages for link in re.findall(r"pictures/([^)\s]+)\)", page.read_text("utf-8"))]
    drawn = {*screens.SCREENS, *how_it_works.VECTORS, *(f"lab-{file}" for file in how_it_works.FIGURES)}
    # By other tools, since they measure, train or take minutes: docs/tools.md, `python3 -m benchmarks`.
    others = {"ninja-game.gif"}, ("good-levels/", "levels/", "performance/", "learn/", "learning/")
    assert not [link for link in links if link not in drawn | others[0] and not link.startswith(others[1])]
    assert drawn <= {*links}, "drawn, and shown nowhere"


def test_comparison_sees_that_the_ninja_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Break what this file guards once: the same picture without its ninja must not pass."""
    with_ninja = scene(0, 120)
    monkeypatch.setattr(level_view, "draw_ninja", lambda *_: None)
    without = scene(0, 120)
    assert difference(with_ninja, without)[1] > BLOCK_TOLERANCE
    monkeypatch.undo()
    assert difference(with_ninja, scene(0, 120)) == (0.0, 0.0)


def test_tiles_cover_what_moves() -> None:
    """An explosion inside a wall is not seen."""
    recording = load_replays(min(PACK.glob("certificates/*.replay.txt")))[0]
    view = LevelView(OffscreenContext(SIZE), Simulation(recording.level), seed=7)
    surface = pygame.Surface(SIZE)
    view.draw(surface, whole=True)
    before = pygame.image.tobytes(surface, "RGB")
    view.effects.explosion(100, 100)
    view.effects.now += 3
    view.draw(surface)
    assert pygame.image.tobytes(surface, "RGB") == before
    view.effects.explosion(396, 160)
    view.draw(surface)
    assert pygame.image.tobytes(surface, "RGB") != before
