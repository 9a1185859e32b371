"""The TAS editor's commands: what they are called, and which keys mean them. The help page is this table."""

from __future__ import annotations

from ninja_game.play.workspace.commands import Command, CommandTable
from ninja_game.ui.input.bindings import ACTIONS
from ninja_game.view.overlays import OVERLAY_ACTIONS

COMMANDS = (
    Command("help", "This page", ("f1",)),
    Command("menu", "File menu; ends playing, and a search that is shown", ("escape",)),
    Command("save", "Save", ("ctrl+s",)),
    Command("save_as", "Save under another name", ("ctrl+shift+s",)),
    Command("open_other", "Open another run beside this one", ("ctrl+o",)),
    Command("undo", "Undo", ("ctrl+z",)),
    Command("redo", "Redo", ("ctrl+y", "ctrl+shift+z")),
    Command("up", "A tick up", ("up",)),
    Command("down", "A tick down", ("down",)),
    Command("page_up", "A page up", ("pageup",)),
    Command("page_down", "A page down", ("pagedown",)),
    Command("first", "First tick", ("home",)),
    Command("last", "Exit or death, then the last tick", ("end",)),
    Command("select_up", "Select upwards", ("shift+up",)),
    Command("select_down", "Select downwards", ("shift+down",)),
    Command("select_page_up", "Select a page upwards", ("shift+pageup",)),
    Command("select_page_down", "Select a page downwards", ("shift+pagedown",)),
    Command("select_first", "Select up to the first tick", ("shift+home",)),
    Command("select_last", "Select to the last tick", ("shift+end",)),
    Command("select_all", "Select everything", ("ctrl+a",)),
    Command("go_to", "Go to a tick or marker", ("ctrl+g",)),
    Command("key_left", "Left: down or up in the selected ticks", ("left", "a")),
    Command("key_right", "Right: down or up in the selected ticks", ("right", "d")),
    Command("key_jump", "Jump: down or up in the selected ticks", ("z", "w")),
    Command("clear", "All keys up in the selected ticks", ("delete",)),
    Command("insert", "Insert ticks without a key, as many as are selected", ("insert", "i")),
    Command("remove", "Take the selected ticks out", ("backspace", "ctrl+delete")),
    Command("copy", "Copy", ("ctrl+c",)),
    Command("cut", "Copy and take out", ("ctrl+x",)),
    Command("paste", "Paste over what is there", ("ctrl+v",)),
    Command("paste_insert", "Paste between", ("ctrl+shift+v",)),
    Command("cut_end", "Take out everything behind the exit or death", ("ctrl+e",)),
    Command("marker", "Set or rename a marker", ("m",)),
    Command("next_marker", "Next marker", ("n",)),
    Command("previous_marker", "Previous marker", ("shift+n",)),
    Command("next_difference", "Next difference to the other run", ("k",)),
    Command("previous_difference", "Previous difference to the other run", ("shift+k",)),
    Command("play", "Play and stop", ("space",)),
    Command("step_back", "A tick back", ("comma",)),
    Command("step", "A tick on; taken over: with the keys that are down", ("period",)),
    Command("faster", "Faster", ("equals", "kp_plus")),
    Command("slower", "Slower", ("minus", "kp_minus")),
    Command("take_over", "Take over: play on yourself from here", ("return", "kp_enter")),
    Command("ghosts", "Other runs, on or off", ("g",)),
    Command("whole_level", "All of the level, after the wheel has zoomed", ("0", "kp_0")),
    *(Command(name, ACTIONS[name].label, ACTIONS[name].keys) for name in OVERLAY_ACTIONS),
    Command("splice", "The selected ticks from the other run", ("ctrl+p",)),
    Command("splice_here", "The rest from the other run, from its nearest tick", ("ctrl+shift+p",)),
    Command("next_other", "Next other run", ("o",)),
    Command("zoom_in", "Zoom in", ("ctrl+equals", "ctrl+kp_plus")),
    Command("zoom_out", "Zoom out", ("ctrl+minus", "ctrl+kp_minus")),
    Command("reset_layout", "Reset layout", ("ctrl+0", "ctrl+kp_0")),
    Command("next_tab", "Next tab", ("f6",)),
    Command("watch", "Watch another value", ("v",)),
    Command("branch", "Keep this run as a branch", ("b",)),
    Command("search", "Search the selected ticks for something better", ("f",)),
)
"""Everything that a key does, unless the run is taken over: then the keys of the game play."""

REPEATING = {
    **dict.fromkeys(("up", "down", "select_up", "select_down", "step", "step_back"), 25),
    **dict.fromkeys(("page_up", "page_down", "select_page_up", "select_page_down", "undo", "redo"), 100),
}
"""The commands that are repeated, and then how often, ms. 25: as the run goes."""

BY_PAD = {
    "start": "take_over", "y": "play", "leftshoulder": "step_back", "rightshoulder": "step", "x": "undo",
    "dpad-up": "up", "dpad-down": "down",
}  # fmt: skip
"""Commands by buttons of a pad; of a run that is taken over, only those that step."""

TABLE = CommandTable(COMMANDS, repeating=REPEATING, pads=BY_PAD)
