"""The programs that break the program fit it as it is."""

from __future__ import annotations

import ast

from tools import ROOT, breaks


def test_every_break_of_the_rules_can_be_made() -> None:
    assert breaks.rule_breaks()


def test_every_random_break_is_a_program() -> None:
    file = "tools/breaks.py"
    source = (ROOT / file).read_bytes()
    drawn = list(breaks.breaks_of(file))
    assert len(drawn) > 50
    for _, start, end, new in drawn:
        broken = ast.parse(source[:start] + new.encode() + source[end:])
        assert ast.dump(broken) != ast.dump(ast.parse(source))


def test_a_break_is_tried_on_the_tests_of_its_module() -> None:
    assert "tests/learn/test_rewards.py" in breaks.tests_near("ninja_game/learn/rewards.py")
    assert all(test.startswith("tests/web/") for test in breaks.tests_near("ninja_game/web/board/runs.py")[:3])
