"""What a release promises (docs/stability.md): nothing in it changes unseen."""

from difflib import unified_diff

from tests.support.promises import RECORDED, promised


def test_what_is_promised_is_as_recorded() -> None:
    """A change that is meant: `python3 tools/dev.py golden` writes the list again, CHANGELOG.md names it."""
    recorded, now = (text.splitlines() for text in (RECORDED.read_text("utf-8"), promised()))
    assert not [*unified_diff(recorded, now, "recorded", "now", lineterm="", n=0)]
