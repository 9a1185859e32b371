"""Someone with a browser of their own who visits the site."""

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

LOADING = 240_000
"""ms in which what is waited for must be there: the game runs, a page is open, also on a slow, busy machine."""


def eventually(page: Any, condition: Callable[[], object], what: str) -> None:
    """Wait until something is so, while the page goes on and tells what happens in it."""
    end = time.monotonic() + LOADING / 1000
    while not condition():
        assert time.monotonic() < end, what
        page.wait_for_timeout(50)


class Visitor:
    """Someone with a browser of their own. ``page``: the tab; ``problems``: what went wrong in it."""

    def __init__(self, browser: Any, address: str, stack: ExitStack, **about: Any) -> None:
        self.address = address
        self.context = browser.new_context(**{"viewport": {"width": 1188, "height": 900}} | about)
        stack.callback(self.context.close)
        self.context.set_default_timeout(LOADING)
        self.problems: list[str] = []
        self.page = self.new_page()

    def new_page(self) -> Any:
        """Another tab."""
        page = self.context.new_page()
        page.on("console", self._note)
        page.on("pageerror", lambda error: self.problems.append(str(error)))
        return page

    def _note(self, message: Any) -> None:
        if message.type == "error":
            self.problems.append(message.text)

    @contextmanager
    def loading_again(self) -> Iterator[None]:
        """What is done within makes the page load again; afterwards the new one runs."""
        self.page.evaluate("() => (document.body.dataset.old = '')")
        yield
        self.page.locator("body[data-state]:not([data-old])").wait_for(state="attached")

    def visit(self, fragment: str = "") -> None:
        """Open the page, and wait until the game runs or a message says why it does not."""
        self.page.goto(f"{self.address}play.html{fragment}")
        self.page.locator("#trouble[open], body[data-state]").first.wait_for(state="attached")

    def until(self, state: str) -> None:
        """Wait until the game shows that."""
        self.page.locator(f"body[data-state={state}]").wait_for(state="attached")

    def press(self, *keys: str) -> None:
        """Press keys, one after the other, as long as a finger does."""
        for key in keys:
            self.page.keyboard.press(key, delay=60)
            self.page.wait_for_timeout(100)

    def python(self, text: str) -> Any:
        """The value of an expression in the page's Python, in which ``app`` is the game."""
        return self.page.evaluate("text => ninjaGame.python.runPython('import boot; app = boot.app()\\n' + text)", text)

    def eventually(self, text: str) -> None:
        """Wait until an expression as in ``python`` is true."""
        eventually(self.page, lambda: self.python(text), text)

    def menu(self, label: str) -> None:
        """Open the page's own menu and press one of its buttons."""
        self.page.click("#panel-open")
        self.page.get_by_role("button", name=label).click()
