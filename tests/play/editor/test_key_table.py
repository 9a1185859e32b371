"""The table of keys in the editor's panel: for the tool, and for what is in hand or selected."""

import pygame
import pytest

from ninja_game.editor.brush import Tool
from ninja_game.editor.palette import OBJECT_TYPES
from ninja_game.play.editor.properties import key_table
from ninja_game.ui.widgets import Label
from tests.support.draw_log import drawn
from tests.support.level_maker import Maker


def table(room: Maker) -> dict[str, str]:
    """The table, each line of which is drawn as a pair of aligned texts inside the panel."""
    lines, panel = key_table(room.editor.session.tools), room.editor.properties
    labels = [widget for widget in panel.widgets if isinstance(widget, Label)][-2 * len(lines) :]
    assert [label.text for label in labels] == [text for line in lines.items() for text in line]
    assert [len({label.area[0] for label in labels[column::2]}) for column in (0, 1)] == [1, 1]
    bottom = panel.area[1] + panel.area[3]
    assert all(label.area[1] + label.area[3] <= bottom for label in labels), "it leaves the panel"
    seen = drawn(room.app)
    assert all(f"text '{text}'" in seen for line in lines.items() for text in line)
    return lines


@pytest.mark.parametrize("tool, letter", tuple(zip(Tool, "briofvk", strict=True)))
def test_each_tool_has_its_keys_beside_those_of_what_is_in_hand(room: Maker, tool: str, letter: str) -> None:
    for key in ("9", *(f"shift+{kind.key}" for kind in OBJECT_TYPES)):
        room.press(key, letter)
        assert room.editor.session.tools.tool == tool
        lines = table(room)
        assert ("Q W A S" in lines) == (key == "9")
        assert ("Right click" in lines) == (tool not in ("select", "pick"))


def test_what_is_selected_or_pasted_has_other_keys(room: Maker) -> None:
    room.press("v")
    room.mouse(*room.at(180, 540))
    assert table(room) == {"Drag": "moves", "Ctrl+drag": "copies", "Del": "deletes"}
    room.chord("c", pygame.KMOD_LCTRL)
    room.chord("v", pygame.KMOD_LCTRL)
    assert table(room) == {"H J U": "mirror, flip, turn", "Esc": "gives it up"}
