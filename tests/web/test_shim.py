"""The module named pygame that pages have does what pygame-ce does: the same calls on both give the same."""

import importlib.util
import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from random import Random
from types import ModuleType
from typing import Any

import pygame
import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
FOLDER = ROOT / "ninja_game" / "web" / "shim" / "pygame"
RECORDED = ROOT / "tests" / "play" / "golden" / "screens"
SIZE = (300, 200)


def load_shim() -> ModuleType:
    """The shim, under a name that does not hide pygame-ce."""
    name = "page_pygame"
    if name not in sys.modules:
        spec = importlib.util.spec_from_file_location(
            name, FOLDER / "__init__.py", submodule_search_locations=[str(FOLDER)]
        )
        assert spec is not None
        assert spec.loader is not None
        sys.modules[name] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(sys.modules[name])
    return sys.modules[name]


shim = load_shim()
BOTH = pygame, shim


def on_both(call: Callable[[Any], Any]) -> tuple[Any, Any]:
    """What a call gives with pygame-ce, and what with the shim."""
    return call(pygame), call(shim)


def plain(value: Any) -> Any:
    """A rectangle or colour as a tuple."""
    return tuple(value) if type(value).__name__ in {"Rect", "Color"} else value


def assert_alike(call: Callable[[Any], Any]) -> None:
    theirs, ours = on_both(call)
    assert plain(ours) == plain(theirs)


def test_the_painter_of_the_page_knows_the_same_kinds_of_entries() -> None:
    text = (FOLDER.parent.parent / "page" / "painter.js").read_text("utf-8")
    theirs = {name: int(number) for name, number in re.findall(r"^const ([A-Z]+) = (\d+);", text, re.MULTILINE)}
    numbers = vars(shim.surface).items()
    ours = {name: value for name, value in numbers if name.isalpha() and name.isupper() and type(value) is int}
    del theirs["GRAIN"], ours["SRCALPHA"]
    assert ours == theirs
    assert len(ours) == shim.surface.LIMB + 1, "every kind, and the number of the screen"


def test_it_has_every_name_that_the_game_asks_for() -> None:
    used = set()
    for path in (path for room in ("play", "ui", "view") for path in (ROOT / "ninja_game" / room).rglob("*.py")):
        used |= set(re.findall(r"\bpygame\.((?:[a-z_]+\.)?[A-Za-z_0-9]+)", path.read_text("utf-8")))
    used -= {"image.tobytes", "Window"}
    missing = []
    for name in sorted(used):
        value: Any = shim
        for part in name.split("."):
            if part == "_sdl2":
                break
            value = getattr(value, part, None)
        if value is None:
            missing.append(name)
    assert not missing


def test_its_rectangles_have_what_the_game_asks_of_rectangles() -> None:
    of_others = {"fit", "normalize", "update"}  # names that are of Theme, Canvas, dictionaries and text here
    missing = {name for name in dir(pygame.Rect) if name[0] != "_" and not hasattr(shim.Rect, name)} - of_others
    asked = re.compile(rf"\.({'|'.join(missing)})\b")
    rooms = (ROOT / "ninja_game" / room for room in ("play", "ui", "view"))
    files = (path for room in rooms for path in room.rglob("*.py"))
    assert not {path.name: names for path in files if (names := asked.findall(path.read_text("utf-8")))}


def test_constants_are_those_of_sdl() -> None:
    names = [name for name in dir(shim.constants) if name.isupper() and isinstance(getattr(shim.constants, name), int)]
    places = [name for name in dir(pygame) if name.startswith("KSCAN_")]
    assert len(names) > 25
    assert len(places) > 150
    for name in [*names, *places]:
        assert getattr(shim, name) == getattr(pygame, name), name
    assert [shim.key.name(code) for code in (97, 39)] == [pygame.key.name(code) for code in (97, 39)]


def test_colours_are_the_same() -> None:
    for value in ("#123456", "#12345678", (1, 2, 3), (1, 2, 3, 4), [5, 6, 7]):
        assert_alike(lambda module: module.Color(value))  # noqa: B023
    rng = Random(1)
    for _ in range(300):
        a, b = ([rng.randrange(256) for _ in range(4)] for _ in range(2))
        theirs, ours = on_both(lambda module: module.Color(*a).lerp(module.Color(*b), sum(a) / 1020))  # noqa: B023
        assert tuple(ours) == tuple(theirs)
    for wrong in ("#12", "nothing", (1, 2), (1, 2, 300)):
        with pytest.raises(ValueError, match="color"):
            shim.Color(wrong)


def rects(rng: Random) -> list[float]:
    return [rng.randrange(-30, 60), rng.randrange(-30, 60), rng.randrange(0, 50), rng.randrange(0, 50)]


def moved(rect: Any, **sides: Any) -> Any:
    for name, value in sides.items():
        setattr(rect, name, value)
    return rect


RECT_CALLS: dict[str, Callable[[Any, Any, list[float]], Any]] = {
    "move": lambda a, b, v: a.move(v[0], v[1]),
    "move by a pair": lambda a, b, v: a.move((v[0], v[1])),
    "inflate": lambda a, b, v: a.inflate(v[0] / 2, v[1] / 2),
    "union": lambda a, b, v: a.union(b),
    "union of many": lambda a, b, v: a.unionall([b, b.move(v[0], v[1])]),
    "union in place": lambda a, b, v: (a.union_ip(b), a)[1],
    "clip": lambda a, b, v: a.clip(b),
    "collide": lambda a, b, v: bool(a.colliderect(b)),
    "collide with one of a list": lambda a, b, v: (a.collidelist([b, a]), a.collidelistall([b, a, b])),
    "point": lambda a, b, v: (bool(a.collidepoint(v[0], v[1])), bool(a.collidepoint((v[2], v[3])))),
    "contains": lambda a, b, v: bool(a.contains(b)),
    "sides": lambda a, b, v: (a.left, a.top, a.right, a.bottom, a.width, a.height, a.topleft, a.size),
    "moved by its sides": lambda a, b, v: moved(a, right=v[0], bottom=v[1]),
    "moved by a corner": lambda a, b, v: moved(a, topleft=(v[0] + 0.7, v[1])),
    "as a sequence": lambda a, b, v: (list(a), a[1], bool(a), a == b, a == tuple(a)),
}


@pytest.mark.parametrize("name", RECT_CALLS)
def test_rectangles_are_the_same(name: str) -> None:
    rng = Random(name)
    for _ in range(300):
        a, b, values = rects(rng), rects(rng), rects(rng)
        assert_alike(lambda module: RECT_CALLS[name](module.Rect(a), module.Rect(*b), values))  # noqa: B023


def size(rng: Random) -> tuple[int, int]:
    return rng.randrange(18, 50), rng.randrange(18, 50)


DRAW_CALLS: dict[str, Callable[[Any, Any, Random], Any]] = {
    "polygon": lambda draw, s, c: draw.polygon(s, "#102030", [point(c) for _ in range(c.randrange(3, 7))]),
    "circle": lambda draw, s, c: draw.circle(s, "#102030", point(c), c.uniform(0.5, 20), c.choice((0, 0, 1, 2, 5))),
    "aacircle": lambda draw, s, c: draw.aacircle(s, "#102030", point(c), c.randrange(25), c.choice((0, 0, 1, 2, 5))),
    # pygame-ce draws beside a rectangle whose corners are rounder than it is high.
    "rect": lambda draw, s, c: draw.rect(s, "#102030", (*point(c), *size(c)), c.randrange(4), c.randrange(9)),
    "line": lambda draw, s, c: draw.line(s, "#102030", point(c), point(c), c.randrange(1, 6)),
    "lines": lambda draw, s, c: draw.lines(s, "#102030", False, [point(c) for _ in range(4)], c.randrange(1, 3)),
    "aaline": lambda draw, s, c: draw.aaline(s, "#102030", point(c), point(c), c.randrange(1, 6)),
}


def point(rng: Random, *, margin: float = 45) -> tuple[float, float]:
    """A point well within the surface, in eighths of a px, as both C's floats and Python's hold exactly."""
    width, height = SIZE
    return (round(8 * rng.uniform(margin, width - margin)) / 8, round(8 * rng.uniform(margin, height - margin)) / 8)


@pytest.mark.parametrize("name", sorted(DRAW_CALLS.keys() - {"polygon"}))
def test_shapes_give_the_same_rectangles(name: str) -> None:
    wrong = []
    for seed in range(400):
        theirs, ours = on_both(lambda module: DRAW_CALLS[name](module.draw, module.Surface(SIZE), Random(seed)))  # noqa: B023
        if plain(theirs) != plain(ours):
            wrong.append((seed, theirs, ours))
    assert not wrong, f"{len(wrong)} of 400, first {wrong[0]}"


def test_polygons_give_rectangles_at_most_some_px_larger() -> None:
    larger = 0
    for seed in range(400):
        theirs, ours = on_both(lambda module: DRAW_CALLS["polygon"](module.draw, module.Surface(SIZE), Random(seed)))  # noqa: B023
        assert pygame.Rect(*ours).contains(theirs), (seed, theirs, ours)
        larger += tuple(theirs) != tuple(ours)
    # pygame-ce leaves the very tips of some slanted corners out.
    assert larger < 80


@pytest.mark.parametrize("name", DRAW_CALLS)
def test_cut_shapes_give_rectangles_that_hold_those_of_pygame(name: str) -> None:
    for seed in range(400):
        clip = pygame.Rect(rects(Random(seed))).move(80, 60)

        def call(module: Any) -> Any:
            surface = module.Surface(SIZE)
            surface.set_clip(tuple(clip))  # noqa: B023
            return DRAW_CALLS[name](module.draw, surface, Random(seed))  # noqa: B023

        theirs, ours = on_both(call)
        if theirs.w and theirs.h:
            assert pygame.Rect(*ours).contains(theirs), (seed, theirs, ours)
            assert clip.contains(tuple(ours)), (seed, clip, ours)


def test_pictures_give_the_same_rectangles() -> None:
    rng = Random(3)
    for _ in range(1000):
        source, dest, area, clip = rects(rng)[2:], rects(rng), rects(rng), rects(rng)
        cut, part = rng.random() < 0.3, rng.random() < 0.5

        def call(module: Any) -> Any:
            surface = module.Surface((40, 40))
            if cut:  # noqa: B023
                surface.set_clip(clip)  # noqa: B023
            place = module.Rect(dest) if dest[0] % 2 else dest[:2]  # noqa: B023
            return surface.blit(module.Surface(source), place, area if part else None), surface.fill("#ff0000", area)  # noqa: B023

        theirs, ours = on_both(call)
        assert [tuple(rect) for rect in ours] == [tuple(rect) for rect in theirs]


def test_events_carry_what_they_are_given() -> None:
    for module in BOTH:
        event = module.Event(module.KEYDOWN, {"key": 97}, mod=1)
        assert (event.type, event.key, event.mod) == (768, 97, 1)
        with pytest.raises(AttributeError):
            event.pos  # noqa: B018


@pytest.mark.slow
def test_every_screen_draws_over_it_what_it_draws_over_pygame(tmp_path: Path) -> None:
    environment = os.environ | {"PYTHONPATH": os.pathsep.join((str(FOLDER.parent), str(ROOT)))}
    command = [sys.executable, "-m", "tests.support.shim_tour", str(tmp_path)]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-3000:]
    shown = json.loads(done.stdout)
    recorded = {path.stem: path.read_text("utf-8") for path in RECORDED.glob("*.txt")}
    assert shown.keys() == recorded.keys()

    def own(text: str) -> str:
        """Without ready pictures: a page wipes from screen to screen, and its letters have other extents."""
        return re.sub("^picture .*\n", "", text, flags=re.MULTILINE)

    assert [name for name in recorded if own(shown[name]) != own(recorded[name])] == []


def test_only_one_module_knows_that_it_runs_in_a_page() -> None:
    files = [path for path in (ROOT / "ninja_game").rglob("*.py") if not {"cli", "web"} & {*path.parts}]
    knowing = [path.name for path in files if re.search(r"IN_PAGE|emscripten|pyodide", path.read_text("utf-8"))]
    assert knowing == ["runtime.py"]
