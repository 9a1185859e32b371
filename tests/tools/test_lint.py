"""Each rule of `tools.lint` notices what breaks it, and keeps silent about what does not."""

from collections.abc import Callable, Iterator, Mapping
from unittest.mock import patch

import pytest

from tools import lint

RECORD = "class Shot(NamedTuple):\n    {}\n    x: float\n    y: float\n    vx: float\n    vy: float\n"
SKIP = "  # fmt: skip"


def faults(rule: Callable[[Mapping[str, str]], Iterator[str]], file: str, *texts: str) -> list[str]:
    """What a rule finds in files of a folder, the last of which has this name."""
    names = [*(f"{file[:-3]}{number}.py" for number in range(1, len(texts))), file]
    with patch.object(lint, "REASONS", {}):
        return [*rule(dict(zip(names, texts, strict=True)))]


@pytest.mark.parametrize(
    "first, second",
    [
        ("A = 1", "A = 2"),
        ("A, B = range(2)", "B, A = range(2)"),
        ("A: int = 1", "A, B = 2, 3"),
        ("Key = int", "Key = str"),
        ("class Key: pass", "class Key: pass"),
        ("def f(): pass", "def f(): pass"),
    ],
)
def test_two_meanings_of_a_name_are_seen(first: str, second: str) -> None:
    assert faults(lint.two_meanings, "ninja_game/a.py", first, second)
    assert not faults(lint.two_meanings, "ninja_game/a.py", first)


def test_one_meaning_is_no_fault_and_a_reason_that_is_idle_is_one() -> None:
    for text in ("A = 1", "_A = []\n_b = 1", "@command(name)\ndef f(): pass", "T = TypeVar('T')", "def _f(): pass"):
        assert not faults(lint.two_meanings, "ninja_game/a.py", text, text)
    assert sum("strike it out" in fault for fault in lint.two_meanings({})) == len(lint.REASONS)


def test_two_names_of_a_module_that_differ_only_by_case_are_seen() -> None:
    assert faults(lint.like_names, "ninja_game/a.py", "_ROW = 3\ndef _row(): pass")
    assert faults(lint.like_names, "ninja_game/a.py", "class _Row: pass\n_A, _row = 1, 2")
    assert not faults(lint.like_names, "ninja_game/a.py", "_ROW = 3\ndef row(_row): _Row = 1")


@pytest.mark.parametrize(
    "text", ["import a\ndef f(a): b = 1", "def f(): pass\ng = [f for f in x]", "if T:\n    import a\ng = lambda a: a"]
)
def test_a_local_name_that_hides_another_is_seen(text: str) -> None:
    assert faults(lint.hiding_names, "ninja_game/a.py", text)


def test_a_field_that_nothing_explains_is_seen() -> None:
    for field in ("ticks: int", "heat: int  #: of the barrel", '"""``heat``: of the barrel."""\n    heat: int'):
        assert not faults(lint.silent_fields, "ninja_game/sim/a.py", RECORD.format(field))
    assert faults(lint.silent_fields, "ninja_game/sim/a.py", RECORD.format("heat: int"))
    assert not faults(lint.silent_fields, "ninja_game/play/a.py", RECORD.format("heat: int"))


@pytest.mark.parametrize(
    "text",
    ["f'{a + f\"{b}\"}'", '"s" * (n > 1)', "[a] * bool(b)", "x = (a if b else c) if d else e", "f() if a else g()"],
)
def test_a_hidden_decision_is_seen(text: str) -> None:
    assert faults(lint.hidden_decisions, "ninja_game/a.py", text)
    assert not faults(lint.hidden_decisions, "ninja_game/a.py", "x = a if b else c if d else e\n'-' * n\n[a] * len(b)")


@pytest.mark.parametrize("text", ["a, b, c = f(x), g(x), h(x)", "a, b, c = x, 1, f(x)", "a, b, c = x, y, x == y"])
def test_three_values_that_are_made_in_unlike_ways_are_seen(text: str) -> None:
    assert faults(lint.hidden_decisions, "ninja_game/a.py", text)
    like = "a, b = f(x), g(x)\na, b, c = x, y.z, x + 1\na, b, c = x.f(), y.f(), z.f()"
    assert not faults(lint.hidden_decisions, "ninja_game/a.py", like)


@pytest.mark.parametrize(
    "file, text", [("tools/a.py", "from tests.sim import b"), ("tests/support/a.py", "def f():\n    import tools.b")]
)
def test_an_import_that_may_not_be_is_seen(file: str, text: str) -> None:
    assert faults(lint.forbidden_imports, file, text)
    assert not faults(lint.forbidden_imports, file, "from tests.support import b")
    assert not faults(lint.forbidden_imports, "tests/sim/a.py", text)


def test_a_skip_of_the_formatter_that_saves_too_little_is_seen() -> None:
    short, long = (f"A = [\n    {', '.join(['1234'] * count)},\n]{SKIP}\n" for count in (12, 30))
    assert faults(lint.idle_skips, "tests/a.py", short)
    assert not faults(lint.idle_skips, "tests/a.py", short.removesuffix(f"{SKIP}\n"))
    assert not faults(lint.idle_skips, "ninja_game/a.py", long), "a table"
    for count, idle in ((5, True), (9, False)):
        arguments = ", ".join(["'1234567890123456789012'"] * count)
        code = f"f(\n    {arguments},\n){SKIP}\n"
        assert bool(faults(lint.idle_skips, "ninja_game/a.py", code)) == idle, "it must save much"
