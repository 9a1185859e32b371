"""What tests of the board share: files of runs, and the pages that come of them."""

import os
import re
from html.parser import HTMLParser
from pathlib import Path

from click.testing import CliRunner

from ninja_game.cli.main import cli
from ninja_game.formats.n14.level_string import level_digest, parse_level_string
from tests.support.forgeries import WALKING, replay
from tests.support.samples import WALK

DIGEST = level_digest(parse_level_string(WALK))
HOSTILE = "<script>document.title='owned'</script><img src=x onerror=\"document.title='owned'\">\"'`&amp;\u202e"


def put(folder: Path, name: str, text: str, *, day: int = 1) -> Path:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, "utf-8")
    os.utime(path, (86_400 * day, 86_400 * day))
    return path


def slow_walk(wait: int = 5, *, author: str) -> str:
    """The walk, begun some ticks later."""
    return replay(bytes(wait) + WALKING + b"\2", author=author)


def board(folder: Path, pack: Path, *words: str) -> str:
    """The output of a command on the board that goes well."""
    result = CliRunner().invoke(cli, ["board", str(folder), "--levels", str(pack), "--jobs", "1", *words])
    assert result.exit_code == 0, result.output
    return result.stdout


def words_of(page: str) -> str:
    """What a page says, without its tags."""
    return " ".join(re.sub("<[^>]*>", " ", page).split())


def taken_in_earlier(runs: Path, levels: Path, data: Path) -> None:
    """All that is there comes into the ledger with a date of long ago."""
    board(runs, levels, "--json", str(data))
    then = re.sub('"added": "[^"]*"', '"added": "2026-01-31T12:00:00Z"', data.read_text("utf-8"))
    data.write_text(then, "utf-8")


class Tags(HTMLParser):
    """The elements and attributes of a page, and whatever is wrong about its nesting."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs)))
        if tag not in {"meta", "link", "img", "input"}:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag
