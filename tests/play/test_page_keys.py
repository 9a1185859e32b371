"""Keys in a page: none that a browser keeps to itself, and each with one meaning in play."""

from ninja_game.ui.input.bindings import ACTIONS, PAGE_KEYS
from ninja_game.ui.input.keys import scancode_named


def test_no_key_of_the_page_is_one_of_the_browsers_or_means_two_things() -> None:
    keys = {action: PAGE_KEYS.get(action, about.keys) for action, about in ACTIONS.items()}
    assert not {key for names in keys.values() for key in names} & {"lctrl", "rctrl", "lalt", "ralt", "lgui", "f12"}
    for action, names in PAGE_KEYS.items():
        others = {key for other, used in keys.items() if other != action for key in used}
        assert not others & set(names)
        assert all(scancode_named(name) for name in names)
