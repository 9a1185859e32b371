"""The figures in the text, as readers meet them: a still picture, then what the world's own functions give."""

import re
import shutil
from collections.abc import Callable
from contextlib import ExitStack
from itertools import islice, product
from pathlib import Path
from typing import Any

import pytest

from ninja_game.files.bundled import data_folder
from ninja_game.levels.published import published_levels
from ninja_game.play.lab.figure import FIGURE_AREA, Figure
from ninja_game.play.lab.screen import FIGURES
from ninja_game.sim.collision.tiles import EDGE_OF_FACES
from ninja_game.sim.grid import cell_at
from ninja_game.view.overlays import touched_cells
from ninja_game.web.pages.gallery import write_gallery
from ninja_game.web.program import MAX_LINES, MAX_OUTPUT, run_program
from tests.support.slow import the_rest_is_slow
from tests.support.visitor import Visitor, eventually
from tests.support.web_page import served

CHAPTERS = sorted((Path(__file__).parents[2] / "docs" / "learn").glob("[0-9]*.md"))[:12]  # those with figures
PROGRAM = re.compile(r"^```python try\n(.*?)^```\n\nIt prints:\n\n^```text\n(.*?)^```", re.MULTILINE | re.DOTALL)
"""A program of a chapter, and what the chapter says that it prints."""

MAX_TICKS = 120  # after a reset, in which a figure that moves by itself is looked at

Numbers = list[tuple[str, str]]


def shown(figure: Any) -> Numbers:
    """The numbers below a figure."""
    return [(name, value) for name, value in figure.locator("dl > div").evaluate_all(
        "all => all.map((each) => [each.querySelector('dt').textContent, each.querySelector('dd').textContent])"
    )]  # fmt: skip


def open_figure(visitor: Any, chapter: str, number: int = 0) -> Any:
    """A figure of a chapter that was touched."""
    visitor.page.goto(f"{visitor.address}learn/{chapter}.html")
    figure = visitor.page.locator("figure.lab").nth(number)
    figure.locator("picture").click()
    figure.locator("canvas").wait_for()
    return figure


def drag_to(page: Any, figure: Any, x: float, y: float) -> tuple[float, float]:
    """Drag with the mouse to a place, shares of the figure; the same place in whole px, as shares again."""
    figure.locator("canvas").scroll_into_view_if_needed()
    box = figure.locator("canvas").bounding_box()
    px, py = round(x * box["width"]), round(y * box["height"])
    page.mouse.move(round(box["x"]) + 5, round(box["y"]) + 5)
    page.mouse.down()
    page.mouse.move(box["x"] + px, box["y"] + py)
    page.mouse.up()
    return px / box["width"], py / box["height"]


def program(chapter: str) -> tuple[str, str]:
    """The program of a chapter, and what it prints."""
    (found,) = PROGRAM.findall((CHAPTERS[0].parent / f"{chapter}.md").read_text("utf-8"))
    return found[0], found[1]


def moved(name: str, x: float, y: float) -> Figure:
    """The figure of the lab on this machine, dragged to a place."""
    figure = FIGURES[name]()
    left, top, zoom = figure.view
    figure.drag(left + x * FIGURE_AREA[2] / zoom, top + y * FIGURE_AREA[3] / zoom)
    return figure


def test_every_chapter_has_a_figure_of_its_own_a_question_with_its_answer_and_the_code() -> None:
    first = []
    for chapter in CHAPTERS:
        text = chapter.read_text("utf-8")
        first.append(re.findall(r"lab-([\w-]+)\.", text)[0])
        assert text.count("**Question.**") == text.count("**Answer.**") >= 1, chapter.stem
        assert "\nCode: " in text, chapter.stem
    assert len(set(first)) == len(CHAPTERS) == 12


@pytest.mark.parametrize("chapter", [each.stem for each in CHAPTERS])
def test_a_program_of_a_chapter_has_thirty_lines_and_prints_what_the_text_says(chapter: str) -> None:
    text, printed = program(chapter)
    assert len(text.splitlines()) <= 30
    assert max(map(len, text.splitlines())) <= 120
    assert run_program(text) == printed


def test_programs_give_what_the_game_gives() -> None:
    grid: dict[str, Any]
    touched: dict[str, Any]
    edges: dict[str, Any]
    grid, touched, edges = {}, {}, {}
    for chapter, names in (("01-grid-and-cells", grid), ("03-touched-cells", touched), ("05-edges", edges)):
        exec(program(chapter)[0], names)
    for x in range(24, 700, 7):
        for y in range(24, 500, 9):
            cell = cell_at(x, y)
            assert grid["cell_of"](x, y) == cell
            cells = {(row + 1) * 35 + column + 1 for column, row in touched["touched"](x, y)}
            assert cells == set(touched_cells(x, y, cell))
    states = ("off", "interesting", "solid")
    shown = [state for row in edges["STATE"] for state in row]
    assert [states[state] for state in EDGE_OF_FACES] == shown


def test_a_ray_of_the_chapter_ends_on_lines_and_in_corners_too() -> None:
    rays: dict[str, Any] = {}
    exec(program("10-rays")[0], rays)
    halves = [half / 2 for half in range(8)]
    for x, y, to_x, to_y in product(halves, repeat=4):
        cells = list(islice(rays["cells_of"](x, y, to_x, to_y), 9))
        assert cells[0] == (int(x), int(y))
        assert cells[-1] == (int(to_x), int(to_y))
        assert len(cells) == 1 + abs(int(to_x) - int(x)) + abs(int(to_y) - int(y))
    assert rays["sees"](1, 0, 1, 3)
    assert not rays["sees"](0, 1, 7, 1)


def test_bodies_of_the_chapter_are_pushed_by_nothing_far_away_and_out_of_the_block_from_within() -> None:
    bodies: dict[str, Any] = {}
    exec(program("02-bodies")[0], bodies)
    for way_out in bodies["circle_out"], bodies["box_out"]:
        assert way_out(150, 60) == way_out(60, 150) == (0, 0)
        assert way_out(101, 100) == (0, -10)


def test_circle_and_box_of_the_chapter_part_at_a_ledge_as_those_of_the_figure() -> None:
    circle, box = FIGURES["bodies"]().numbers()[1:]
    assert circle[1].startswith("over the ledge")
    assert box[1].startswith("stopped")


@pytest.mark.parametrize(
    "text, shown",
    [
        ("print(1)\nprint(x)", "1\nLine 2: NameError: name 'x' is not defined"),
        ("def f():\n    return 1 / 0\n\nf()", "Line 2: ZeroDivisionError: division by zero"),
        ("a = 1\nif a:\nb = 2", "Line 3: IndentationError: expected an indented block after 'if' statement on line 2"),
        ("import sys\nsys.exit(3)", "Line 2: SystemExit: 3"),
        ("while True:\n    pass", f"TimeoutError: stopped after {MAX_LINES:,} lines; does a loop never end?"),
        ("print('x' * 9999)", "x" * MAX_OUTPUT),
        ("a = 1", ""),
    ],
)
def test_what_is_wrong_in_a_readers_program_is_said_plainly(text: str, shown: str) -> None:
    assert run_program(text).endswith(shown)


@pytest.mark.parametrize("chapter", the_rest_is_slow([each.stem for each in CHAPTERS], 1))
def test_a_program_of_a_chapter_runs_in_the_page_is_changed_and_reset(
    new_visitor: Callable[..., Any], chapter: str
) -> None:
    visitor = new_visitor(viewport={"width": 390, "height": 844})
    page, (text, printed) = visitor.page, program(chapter)
    page.goto(f"{visitor.address}learn/{chapter}.html")
    run = page.get_by_role("button", name="Run")
    run.click()
    output = page.locator(".output")
    eventually(page, lambda: output.text_content() == printed, "what it prints")
    page.get_by_role("button", name="Edit").click()
    field = page.get_by_label("Your program")
    assert field.input_value() == text.rstrip()
    field.fill("for number in range(3):\n    print(number)\nprint(wrong)")
    run.click()
    eventually(page, lambda: (output.text_content() or "").startswith("0\n1\n2\nLine 3: NameError"), "an error")
    field.fill("while True:\n    pass")
    run.click()
    eventually(page, lambda: "does a loop never end?" in (output.text_content() or ""), "the end of a loop")
    page.get_by_role("button", name="Reset").first.click()
    assert field.input_value() == text.rstrip()
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert visitor.problems == []


@pytest.mark.parametrize("chapter", the_rest_is_slow([each.stem for each in CHAPTERS], 2))
def test_a_figure_shows_what_the_functions_of_the_game_give(new_visitor: Callable[..., Any], chapter: str) -> None:
    visitor = new_visitor(reduced_motion="reduce")
    figures = re.findall(r"lab-([\w-]+)\.", (CHAPTERS[0].parent / f"{chapter}.md").read_text("utf-8"))
    for number, name in enumerate(figures):
        given = FIGURES[name]()
        possible = [given.numbers()[:6]]  # of projection the seventh counts ticks
        for _ in range(MAX_TICKS):
            given.tick()
            possible.append(given.numbers()[:6])
        figure = open_figure(visitor, chapter, number)

        def fits(figure: Any = figure, possible: list[Numbers] = possible) -> bool:
            figure.get_by_role("button", name="Reset").click()
            return shown(figure)[:6] in possible

        eventually(visitor.page, fits, f"{name}: not the numbers of this machine")
    assert visitor.problems == []


def test_a_figure_follows_mouse_and_keys_and_its_controls(new_visitor: Callable[..., Any]) -> None:
    visitor = new_visitor(viewport={"width": 1000, "height": 900})
    page = visitor.page
    figure = open_figure(visitor, "04-projection")
    place = drag_to(page, figure, 0.52, 0.27)
    eventually(page, lambda: shown(figure)[:6] == moved("projection", *place).numbers()[:6], "the mouse")
    page.keyboard.press("ArrowLeft")
    expected = moved("projection", *place)
    expected.nudge(-1, 0)
    eventually(page, lambda: shown(figure)[:6] == expected.numbers()[:6], "an arrow key")
    figure.get_by_label("Body").select_option("box")
    slider = figure.get_by_label("Tile")
    slider.focus()
    page.keyboard.press("End")
    eventually(page, lambda: shown(figure)[0][1].endswith("with box"), "a choice")
    assert figure.locator("output").first.inner_text() == "33 of 33"
    figure.get_by_role("button", name="Reset").click()
    eventually(page, lambda: shown(figure)[3][1].startswith("1,") or shown(figure)[3][1].startswith("0,"), "a reset")
    figure.get_by_role("button", name="Show me").click()
    before = shown(figure)
    eventually(page, lambda: shown(figure)[1:5] != before[1:5], "the demonstration")
    assert visitor.problems == []


def test_a_chapter_is_read_without_a_script_and_takes_no_lock(new_visitor: Callable[..., Any]) -> None:
    plain = new_visitor(java_script_enabled=False)
    plain.page.goto(f"{plain.address}learn/05-edges.html")
    assert plain.page.locator("figure.lab img").is_visible()
    assert plain.page.locator("figure.lab button").is_hidden()
    plain.page.get_by_text("Show me the code: set_edges").click()
    assert "def set_edges" in plain.page.locator("details[open] pre").inner_text()
    plain.page.get_by_text("Answer").first.click()
    assert plain.problems == []
    # While the game runs in another tab.
    visitor = new_visitor()
    visitor.visit()
    visitor.page = visitor.new_page()
    open_figure(visitor, "01-grid-and-cells")
    assert visitor.problems == []


@pytest.mark.slow
def test_learn_and_gallery_are_there_without_a_network_once_a_figure_has_moved(
    site: Path, chromium: Any, tmp_path: Path
) -> None:
    shutil.copytree(site, tmp_path / "site")
    levels = published_levels(data_folder("levels"))
    write_gallery(tmp_path / "site", levels)
    with served(tmp_path / "site") as address, ExitStack() as stack:
        visitor = Visitor(chromium, address, stack)
        open_figure(visitor, "01-grid-and-cells")
        visitor.page.evaluate("() => navigator.serviceWorker.ready.then(() => 1)")
        visitor.context.set_offline(True)
        open_figure(visitor, "03-touched-cells")
        assert visitor.page.locator("figure.lab dl > div").count() > 0
        visitor.page.goto(f"{address}gallery/index.html")
        assert visitor.page.locator(".card:visible").count() == len(levels.entries)
        visitor.page.get_by_role("link", name="First Steps").click()
        visitor.page.get_by_role("heading", name="Par times").wait_for()
        assert visitor.problems == []
        visitor.page.goto(f"{address}docs/testing.html")
        visitor.page.get_by_role("heading", name="No network").wait_for()
