"""The programs that break the program fit it as it is."""

import ast
import json
from pathlib import Path
from queue import Queue

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


@pytest.mark.parametrize(
    "after, result, failed",
    [
        ("NAME, LIMIT = 'there', 1", "survived", ["test_a.py::there"]),
        ("NAME, LIMIT = 'gone', 1", "survived", ["test_a.py::there"]),
        ("NAME, LIMIT = 'gone', 2", "noticed", ["test_a.py::test_limit"]),
    ],
)
def test_a_break_that_only_renames_a_test_is_not_noticed(
    after: str, result: str, failed: list[str], tmp_path: Path
) -> None:
    before = "NAME, LIMIT = 'there', 1"
    (tmp_path / "pytest.ini").write_text("[pytest]\npython_functions = there gone test_*\n")
    (tmp_path / "a.py").write_text(before)
    (tmp_path / "test_a.py").write_text(
        "import a\ndef test_limit(): assert a.LIMIT == 1\ndef test_odd(): assert 0\nglobals()[a.NAME] = lambda: None"
    )
    trees = Queue[Path]()
    trees.put(tmp_path)
    sound = {"test_a.py::test_odd": False}
    broken = breaks.Break("a.py", 0, len(before), after)
    found = breaks.try_out(broken, lambda _: ["test_a.py::there"], trees, sound)
    assert found[:2] == (result, failed)
    assert (trees.get(block=False) / "a.py").read_text() == before


def test_a_worktree_is_given_back_whole_after_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(breaks, "run_tests", interrupt)
    (tmp_path / "a.py").write_text("LIMIT = 1")
    trees = Queue[Path]()
    trees.put(tmp_path)
    with pytest.raises(KeyboardInterrupt):
        breaks.try_out(breaks.Break("a.py", 8, 9, "2"), lambda _: [], trees, {})
    assert (trees.get(block=False) / "a.py").read_text() == "LIMIT = 1"


def test_a_break_is_tried_on_the_tests_of_its_module() -> None:
    assert "tests/learn/test_rewards.py" in breaks.tests_near("ninja_game/learn/rewards.py")
    assert all(test.startswith("tests/web/") for test in breaks.tests_near("ninja_game/board/judge.py")[:3])
