"""The programs that break the program fit it as it is."""

import ast
import json
from pathlib import Path

import pytest
from coverage import CoverageData

from tools import ROOT, breaks


def test_every_break_of_the_rules_can_be_made() -> None:
    assert breaks.rule_breaks()


@pytest.mark.slow
def test_every_random_break_is_a_program() -> None:
    file = "tools/breaks.py"
    source = (ROOT / file).read_bytes()
    drawn = list(breaks.breaks_of(file))
    assert len(drawn) > 50
    for _, start, end, new in drawn:
        broken = ast.parse(source[:start] + new.encode() + source[end:])
        assert ast.dump(broken) != ast.dump(ast.parse(source))


@pytest.mark.parametrize(
    "text, drawn",
    [
        ("def f() -> bool:\n    return False", {"True"}),
        ("def f() -> bool | None:\n    return False", {"True", "return None"}),
        ("def f() -> bool:\n    return True", {"False", "return None"}),
        ("def __repr__(self):\n    return 1", set()),
        ("f(repr=False)", {"pass"}),
        ("zip(a, b, strict=True)", {"pass"}),
        ("zip(a, b, strict=False)", {"pass", "True"}),
        ("f(a, strict=True)", {"pass", "False"}),
        ("while monotonic() - start < end: f()", {"(monotonic() + start)", "pass"}),
    ],
)
def test_what_changes_nothing_is_not_drawn(
    text: str, drawn: set[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.py").write_text(text)
    monkeypatch.setattr(breaks, "ROOT", tmp_path)
    assert {broken.new for broken in breaks.breaks_of("a.py")} == drawn


def test_a_break_is_tried_on_the_tests_that_execute_its_line_fastest_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = "LIMIT = 3\n\ndef f(x):\n    return (\n        x + 1)\n\ndef g(x):\n    return x < LIMIT\n"
    file = "ninja_game/a.py"
    (tmp_path / "ninja_game").mkdir()
    (tmp_path / file).write_text(source)
    monkeypatch.setattr(breaks, "ROOT", tmp_path)
    monkeypatch.setattr(breaks, "imports", lambda: {file: set()})
    monkeypatch.setattr(breaks, "tests_near", lambda _: ["near"])
    data = CoverageData(str(tmp_path / "lines"))
    # A line that a shared fixture executes belongs to all tests of the file.
    for test, lines in {"slow": {4, 5}, "fast": {4, 5}, "shared": {8}, "": {1, 3, 7}}.items():
        data.set_context(test)
        data.add_lines({file: lines})
    data.write()
    data.close()
    (tmp_path / "seconds.json").write_text(
        json.dumps({"slow": 110.0, "fast": 11.0, "shared::two": 2.0, "shared::one": 1.0})
    )
    executed = breaks.Executed(tmp_path, tmp_path, 1)
    chosen = {source[b.start : b.end]: executed.tests_of(b) for b in breaks.breaks_of(file)}
    assert chosen["x + 1"] == ["fast"]  # the other one would be too long
    assert chosen["x < LIMIT"] == chosen["3"] == ["shared::one", "shared::two"]
    assert executed.tests_of(breaks.Break(file, source.index("def g"), source.index("def g"), "")) == ["near"]


def test_a_break_is_tried_on_the_tests_of_its_module() -> None:
    assert "tests/learn/test_rewards.py" in breaks.tests_near("ninja_game/learn/rewards.py")
    assert all(test.startswith("tests/web/") for test in breaks.tests_near("ninja_game/board/judge.py")[:3])
