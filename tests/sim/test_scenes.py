"""The scenes: small levels, each made to show one rule, compared with whole traces."""

import pytest

from tests.support import reference
from tests.support.comparing import scene_difference
from tests.support.memories import BOTH

RULES = sorted({scene.rule for scene in reference.scenes()}) if reference.reference_folder() else []


@pytest.mark.parametrize("memory", BOTH)
@pytest.mark.parametrize("rule", RULES)
def test_every_scene_of_the_rule_is_exact(rule: str, memory: str) -> None:
    found = [scene_difference(scene, memory) for scene in reference.scenes() if scene.rule == rule]
    wrong = [difference for difference in found if difference]
    assert not wrong, "\n".join(wrong)


def test_the_scenes_are_there() -> None:
    assert len([scene.name for scene in reference.scenes()]) == 1142
