"""Every action with what it is called, and the keys and buttons that mean it unless the player says otherwise."""

from __future__ import annotations

from typing import NamedTuple

from ninja_game.runtime import only_in_a_page


class Action(NamedTuple):
    """``label``: for the settings screen; ``keys`` and ``pad``: names of the default inputs."""

    label: str
    keys: tuple[str, ...]
    pad: tuple[str, ...] = ()


ACTIONS: dict[str, Action] = {
    "left": Action("Run left", ("left", "a"), ("dpad-left", "leftx-", "hat-left", "axis-0-")),
    "right": Action("Run right", ("right", "d"), ("dpad-right", "leftx+", "hat-right", "axis-0+")),
    "jump": Action("Jump", ("lshift", "rshift", "z", "up", "w"), ("a", "button-0")),
    "confirm": Action("Begin, continue", ("space", "return"), ("a", "button-0")),
    "back": Action("Back", ("escape",), ("b", "button-1")),
    "pause": Action("Pause", ("p",), ("start", "button-7")),
    "retry": Action("Retry", ("r",), ("x", "button-2")),
    "suicide": Action("Give up", ("k",), ("back", "button-6")),
    "replay": Action("Watch the replay", ("v",), ("y", "button-3")),
    "quit": Action("Leave to the menu", ("q",)),
    "skip": Action("Skip the level (practice)", ("n",)),
    "boss": Action("Hide the game", ("tab",)),
    "ghost": Action("Ghost on or off", ("g",), ("rightshoulder",)),
    "quick_save": Action("Quick save (practice)", ("f5",), ("leftstick",)),
    "quick_load": Action("Quick load (practice)", ("f9",), ("rightstick",)),
    "rewind": Action("Rewind (practice)", ("backspace",), ("lefttrigger+",)),
    "slow": Action("Slow motion (practice)", ("lctrl",), ("righttrigger+",)),
    "step": Action("Single step (practice)", ("period",), ("leftshoulder",)),
    "overlay_hitboxes": Action("Show hit boxes", ("1",)),
    "overlay_grid": Action("Show the grid", ("2",)),
    "overlay_edges": Action("Show edges", ("3",)),
    "overlay_rays": Action("Show rays", ("4",)),
    "overlay_cells": Action("Show cells", ("5",)),
    "faster": Action("Replay: faster", ("equals", "kp_plus"), ("rightshoulder",)),
    "slower": Action("Replay: slower", ("minus", "kp_minus"), ("leftshoulder",)),
    "frame_back": Action("Replay: a tick back", ("comma",)),
    "frame_forward": Action("Replay: a tick on", ("period",)),
    "export": Action("Replay: export", ("e",)),
    "edit": Action("Replay: edit", ("t",)),
    "link": Action("Copy a link", ("c",)),
    "screenshot": Action("Save a picture", ("f12",)),
    "fullscreen": Action("Full screen", ("f11",)),
}

PAGE_KEYS = {"slow": ("x",), "screenshot": ("f10",)}
"""Keys in a page instead of those that the browser has its own use for: Ctrl with W, a jump, closes the tab."""

ACTIONS |= {action: ACTIONS[action]._replace(keys=keys) for action, keys in only_in_a_page(PAGE_KEYS).items()}

MENU_KEYS: dict[str, str] = {
    "left": "left", "right": "right", "up": "up", "down": "down", "return": "confirm", "kp_enter": "confirm",
    "space": "confirm", "escape": "back", "backspace": "back", "pageup": "page_up", "pagedown": "page_down",
    "home": "first", "end": "last", "delete": "delete",
}  # fmt: skip
"""Keys in menus; they cannot be rebound, so that nobody locks themselves out."""

MENU_PAD: dict[str, str] = {
    "dpad-left": "left", "dpad-right": "right", "dpad-up": "up", "dpad-down": "down", "leftx-": "left",
    "leftx+": "right", "lefty-": "up", "lefty+": "down", "a": "confirm", "b": "back", "start": "confirm",
    "leftshoulder": "page_up", "rightshoulder": "page_down", "y": "delete", "x": "next",
    "hat-left": "left", "hat-right": "right", "hat-up": "up", "hat-down": "down", "axis-0-": "left",
    "axis-0+": "right", "axis-1-": "up", "axis-1+": "down", "button-0": "confirm", "button-1": "back",
}  # fmt: skip
