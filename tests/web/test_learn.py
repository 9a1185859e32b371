"""The figures in the text, as readers meet them: a still picture, then what the world's own functions give."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ninja_game.play.lab.figure import FIGURE, Figure
from ninja_game.play.lab.screen import FIGURES
from tests.support.slow import the_rest_is_slow
from tests.support.visitor import eventually

CHAPTERS = sorted((Path(__file__).parents[2] / "docs" / "learn").glob("[0-9]*.md"))
MOST_TICKS = 120
"""After a reset, in which a figure that moves by itself is looked at."""

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


def moved(name: str, x: float, y: float) -> Figure:
    """The figure of the lab on this machine, dragged to a place."""
    figure = FIGURES[name]()
    left, top, zoom = figure.view
    figure.drag(left + x * FIGURE[2] / zoom, top + y * FIGURE[3] / zoom)
    return figure


@pytest.mark.parametrize("chapter", the_rest_is_slow([each.stem for each in CHAPTERS], 2))
def test_a_figure_shows_what_the_functions_of_the_game_give(new_visitor: Callable[..., Any], chapter: str) -> None:
    visitor = new_visitor(reduced_motion="reduce")
    figures = re.findall(r"lab-([\w-]+)\.", (CHAPTERS[0].parent / f"{chapter}.md").read_text("utf-8"))
    for number, name in enumerate(figures):
        given = FIGURES[name]()
        possible = [given.numbers()[:6]]  # of projection the seventh counts ticks
        for _ in range(MOST_TICKS):
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
    assert figure.locator("output").first.inner_text() == shown(figure)[0][1].removesuffix(" with box")
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
