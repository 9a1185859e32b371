"""Numbers of events, keys and modifiers, as SDL 2 has them."""

from __future__ import annotations

RESIZABLE, FULLSCREEN = 0x10, -0x80000000

QUIT = 0x100
KEYDOWN, KEYUP, TEXTINPUT = 0x300, 0x301, 0x303
MOUSEMOTION, MOUSEBUTTONDOWN, MOUSEBUTTONUP, MOUSEWHEEL = range(0x400, 0x404)
JOYAXISMOTION, JOYHATMOTION, JOYBUTTONDOWN, JOYBUTTONUP = 0x600, 0x602, 0x603, 0x604
JOYDEVICEADDED, JOYDEVICEREMOVED = 0x605, 0x606
CONTROLLERAXISMOTION, CONTROLLERBUTTONDOWN, CONTROLLERBUTTONUP = 0x650, 0x651, 0x652
DROPFILE = 0x1000
VIDEORESIZE = 0x8001
WINDOWEXPOSED, WINDOWSIZECHANGED, WINDOWRESTORED, WINDOWFOCUSGAINED, WINDOWFOCUSLOST = (
    0x8007, 0x800A, 0x800D, 0x8010, 0x8011,
)  # fmt: skip

KMOD_SHIFT, KMOD_CTRL, KMOD_ALT, KMOD_META = 0x3, 0xC0, 0x300, 0xC00

_LETTERS = "A B C D E F G H I J K L M N O P Q R S T U V W X Y Z 1 2 3 4 5 6 7 8 9 0"
_REST = (
    "RETURN ESCAPE BACKSPACE TAB SPACE MINUS EQUALS LEFTBRACKET RIGHTBRACKET BACKSLASH NONUSHASH SEMICOLON APOSTROPHE "
    "GRAVE COMMA PERIOD SLASH CAPSLOCK F1 F2 F3 F4 F5 F6 F7 F8 F9 F10 F11 F12 PRINTSCREEN SCROLLLOCK PAUSE INSERT HOME "
    "PAGEUP DELETE END PAGEDOWN RIGHT LEFT DOWN UP NUMLOCKCLEAR KP_DIVIDE KP_MULTIPLY KP_MINUS KP_PLUS KP_ENTER "
    "KP_1 KP_2 KP_3 KP_4 KP_5 KP_6 KP_7 KP_8 KP_9 KP_0 KP_PERIOD NONUSBACKSLASH"
)
_FROM = {
    4: f"{_LETTERS} {_REST}", 102: "POWER KP_EQUALS F13 F14 F15", 117: "HELP MENU",
    135: " ".join(f"INTERNATIONAL{n}" for n in range(1, 10)) + " " + " ".join(f"LANG{n}" for n in range(1, 10)),
    154: "SYSREQ", 156: "CLEAR", 180: "CURRENCYUNIT CURRENCYSUBUNIT",
    224: "LCTRL LSHIFT LALT LGUI RCTRL RSHIFT RALT RGUI", 257: "MODE", 270: "AC_BACK",
}  # fmt: skip
_OTHER_NAMES = {
    "PRINT": "PRINTSCREEN", "SCROLLOCK": "SCROLLLOCK", "BREAK": "PAUSE", "NUMLOCK": "NUMLOCKCLEAR",
    "EURO": "CURRENCYUNIT", "LMETA": "LGUI", "LSUPER": "LGUI", "RMETA": "RGUI", "RSUPER": "RGUI",
} | {f"KP{n}": f"KP_{n}" for n in range(10)}  # fmt: skip

SCANCODES = {name: first + k for first, names in _FROM.items() for k, name in enumerate(names.split())}
SCANCODES |= {name: SCANCODES[other] for name, other in _OTHER_NAMES.items()} | {"UNKNOWN": 0}
"""Scancode (place on the keyboard) by name."""

PRINTED = {
    "RETURN": 13, "ESCAPE": 27, "BACKSPACE": 8, "TAB": 9, "SPACE": 32, "DELETE": 127, "UNKNOWN": 0,
    "MINUS": 45, "EQUALS": 61, "LEFTBRACKET": 91, "RIGHTBRACKET": 93, "BACKSLASH": 92, "SEMICOLON": 59,
    "COMMA": 44, "PERIOD": 46, "SLASH": 47,
}  # fmt: skip
"""Keycode (what a key means) of the keys that stand for a character; other keys have their scancode plus 2**30."""

_PLACES_ONLY = {"NONUSHASH", "NONUSBACKSLASH", "APOSTROPHE", "GRAVE"}


def _keycode(name: str, scancode: int) -> int:
    return ord(name.lower()) if len(name) == 1 else PRINTED.get(name, scancode | 1 << 30)


KEYCODES = {
    name: _keycode(name, code)
    for name, code in SCANCODES.items()
    if name not in _PLACES_ONLY and not name.startswith(("INTERNATIONAL", "LANG"))
}
"""Keycode by name."""

KEY_CONSTANTS = {f"KSCAN_{name}": code for name, code in SCANCODES.items()} | {
    f"K_{name.lower() if name.isalpha() and len(name) == 1 else name}": code for name, code in KEYCODES.items()
}
"""The constants of these names."""
