"""The editor's commands: what they are called, and which keys and buttons mean them. The help page is this table."""

from __future__ import annotations

from ninja_game.editor.brush import FAMILIES, OBJECT_TYPES, QUARTERS
from ninja_game.play.workspace.commands import Command, CommandTable

COMMANDS = (
    Command("help", "This page", ("f1",)),
    Command("menu", "File menu; gives up what is half done", ("escape",), "b"),
    Command("test", "Test: play it; Esc comes back", ("f5",), "start"),
    Command("test_here", "Test with the ninja at the pointer", ("f6",)),
    Command("certify", "Certify: the solver looks for a run", ("f7",)),
    Command("save", "Save", ("ctrl+s",)),
    Command("save_as", "Save under another name", ("ctrl+shift+s",)),
    Command("open", "Open a level", ("ctrl+o",)),
    Command("new", "New level", ("ctrl+n",)),
    Command("about", "Name, author, comment, teaches", ("f2",)),
    Command("messages", "Messages to the player", ("shift+m",)),
    Command("undo", "Undo", ("ctrl+z",), "lefttrigger+"),
    Command("redo", "Redo", ("ctrl+y", "ctrl+shift+z"), "righttrigger+"),
    Command("copy", "Copy", ("ctrl+c",)),
    Command("cut", "Cut", ("ctrl+x",)),
    Command("paste", "Paste at the pointer", ("ctrl+v",)),
    Command("choose_all", "Select everything", ("ctrl+a",)),
    Command("delete", "Delete what is selected, or pointed at", ("delete", "backspace"), "x"),
    Command("brush", "Brush", ("b",)),
    Command("rectangle", "Box: fill a rectangle", ("r",)),
    Command("line", "Line; the wheel bends it", ("shift+l",)),
    Command("ellipse", "Ellipse", ("shift+e",)),
    Command("fill", "Fill with a tile or objects", ("f",)),
    Command("select", "Select and move", ("v",)),
    Command("pick", "Pick: draw with what is there", ("k",), "y"),
    Command("next_tool", "Next tool", (), "rightstick"),
    Command("swap", "Tiles or objects", ("grave", "insert"), "leftstick"),
    Command("mirror", "Mirror left-right", ("h",)),
    Command("flip", "Flip up-down", ("j",)),
    Command("turn", "Turn by a quarter", ("u",)),
    Command("symmetry", "Mirror: next symmetry", ("m",)),
    Command("grid", "Next grid", ("g",)),
    Command("snap_next", "Next snap for objects"),
    Command("snap_cell", "Snap to cells", ("l",)),
    Command("snap_half", "Snap to half cells", ("x",)),
    Command("snap_quarter", "Snap to quarter cells", ("c",)),
    Command("snap_px", "Snap to px", ("z",)),
    Command("slopes", "Slopes set themselves, on or off", ("shift+s",)),
    Command("list", "List of objects, or the palette", ("f3",)),
    Command("lines", "Lines from switches, on or off", ("t",)),
    Command("paths", "Paths of the last test and of the solver", ("f8",)),
    Command("tests", "Map of tests: where they went and died", ("f9",)),
    Command("reach", "What can be reached from the pointer", ("y",)),
    Command("next_finding", "Go to the next problem", ("f4",)),
    Command("next_entry", "Next tile or object", ("pagedown",), "rightshoulder"),
    Command("previous_entry", "Tile or object before", ("pageup",), "leftshoulder"),
)
"""Everything that a key does by itself. Other keys choose tiles and objects."""

TABLE = CommandTable(COMMANDS, repeating=dict.fromkeys(("undo", "redo"), 100))

DIRECTION_KEYS = {"w": "up", "a": "left", "s": "down", "d": "right"}
"""Directions of objects, as in Ned."""

OBJECT_TYPE_OF_KEY = {object_type.key: object_type for object_type in OBJECT_TYPES}
"""Objects by their keys."""

_FAMILY_OF_KEY = {family.key: family for family in FAMILIES}


def tile_of_key(name: str, present: int) -> int | None:
    """The tile that a key chooses in tile mode, beside the one in hand: a digit its family, a letter its quarter."""
    if name in ("e", "d"):
        return int(name == "e")
    family = next((each for each in FAMILIES if present in each.tiles), FAMILIES[0])
    place = family.tiles.index(present) if present in family.tiles else 0
    if name in _FAMILY_OF_KEY:
        return _FAMILY_OF_KEY[name].tiles[place]
    return family.tiles[QUARTERS.index(name)] if name in QUARTERS else None
